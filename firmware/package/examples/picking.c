/* Picking: which object lies at a pixel? Draw each in a colour of its own, unlit, and read that pixel. */
#include "example.h"
#include "shapes.h"

enum { OBJECTS = 9, PICK_X = 201, PICK_Y = 80 };

static uint16_t picked; /* the pixel's colour, in wire order */

static int read_pixel(void *context, uint32_t x, uint32_t y, uint32_t width, uint32_t height, const void *pixels)
{
    (void)context;
    if (PICK_Y >= y && PICK_Y < y + height) {
        picked = ((const uint16_t *)pixels)[(PICK_Y - y) * width + PICK_X - x];
    }
    return 0;
}

/* Draws all in their own colours, or as numbers: object i has the colour i + 1, and the background 0. */
static int draw(struct ph_renderer *r, uint32_t frame, bool numbers, int found)
{
    static struct shape torus;
    static uint16_t ramps[2][PH_RAMP_SIZE];
    const struct ph_material grey = shape_lit(ramps[0], 130, 140, 160), gold = shape_lit(ramps[1], 255, 190, 60);
    struct ph_mesh mesh = shape_torus(&torus, FX_ONE / 3, &grey);
    int status = example_look(r, (struct fx_vec3){0, FX_ONE, FX_INT(7)}, (struct fx_vec3){0, 0, 0}, &shapes_daylight,
                              numbers ? 0 : ph_rgb565(24, 24, 32));
    for (int i = 0; i < OBJECTS && status == 0; i++) {
        const struct ph_material number = {.shading = PH_SHADE_UNLIT, .colour = (uint16_t)(i + 1)};
        const struct ph_xform small = ph_xform_scale(FX_ONE * 3 / 5), turn = ph_xform_rotate_y((frame + 9 * i) << 25);
        struct ph_xform place = ph_xform_mul(&turn, &small);
        place.t = (struct fx_vec3){FX_INT(i % 3 - 1) * 2, FX_INT(i / 3 - 1) * 3 / 2, 0};
        mesh.materials = numbers ? &number : i == found ? &gold : &grey;
        status = ph_draw_mesh(r, &mesh, &place);
    }
    return status;
}

int main(int argc, char *argv[])
{
    static struct ph_renderer r;
    const struct ph_config config = example_config();
    const uint32_t frame = example_frame(argc, argv);
    int status = ph_renderer_init(&r, &config);
    status = status != 0 ? status : draw(&r, frame, true, -1);
    status = status != 0 ? status : ph_show(&r, read_pixel, NULL);
    fprintf(stderr, "at %d, %d lies object %d\n", PICK_X, PICK_Y, picked - 1);
    status = status != 0 ? status : draw(&r, frame, false, picked - 1);
    status = status != 0 ? status : ph_show(&r, example_flush, NULL);
    return example_save(&r, status);
}
