/* Two displays: two renderers with memory of their own draw the same scene from two sides. Here both are halves of one
 * picture. */
#include "example.h"
#include "shapes.h"

enum { HALF = WIDTH / 2 };

/* A display: its renderer, its memory, and where it lies in the picture. */
struct display {
    struct ph_renderer r;
    uint64_t memory[PH_MEMORY(HALF, BAND, 700, 1200)];
    uint32_t left;
};

static int open_display(struct display *d, uint32_t left)
{
    struct ph_config config = {.width = HALF,
                               .height = HEIGHT,
                               .band_height = BAND,
                               .depth_format = PH_DEPTH_FIXED16,
                               .vertex_max = 700,
                               .triangle_max = 1200};
    const int status = ph_config_memory(&config, d->memory, sizeof d->memory);
    d->left = left;
    return status != 0 ? status : ph_renderer_init(&d->r, &config);
}

static int draw(struct display *d, struct fx_vec3 eye, const struct ph_mesh *mesh, uint16_t background)
{
    const struct ph_xform view = ph_view_look_at(eye, (struct fx_vec3){0, 0, 0}, (struct fx_vec3){0, FX_ONE, 0});
    struct ph_projection lens;
    int status = ph_projection_perspective(&lens, FX_INT(60), FX_ONE * HALF / HEIGHT, FX_HALF, FX_INT(20));
    status = status != 0 ? status : ph_frame_begin(&d->r, &view, &lens, &shapes_daylight, background);
    status = status != 0 ? status : ph_draw_mesh(&d->r, mesh, &ph_xform_identity);
    return status != 0 ? status : ph_show(&d->r, example_flush, &d->left);
}

int main(int argc, char *argv[])
{
    static struct display left, right;
    static struct shape torus;
    static uint16_t ramp[PH_RAMP_SIZE];
    const struct ph_material material = shape_lit(ramp, 255, 150, 60);
    const struct ph_mesh mesh = shape_torus(&torus, FX_ONE / 3, &material);
    const fx_t turns = (fx_t)(example_frame(argc, argv) << 9);
    const struct fx_vec3 front = {4 * fx_sin(turns), 0, 4 * fx_cos(turns)}, above = {0, FX_INT(3), FX_INT(3)};
    int status = open_display(&left, 0);
    status = status != 0 ? status : open_display(&right, HALF);
    status = status != 0 ? status : draw(&left, front, &mesh, ph_rgb565(20, 40, 60));
    status = status != 0 ? status : draw(&right, above, &mesh, ph_rgb565(60, 30, 40));
    return example_save(&left.r, status);
}
