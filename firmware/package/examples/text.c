/* Text over the picture: ph_show_painted calls back for each band before it is shown. */
#include "example.h"
#include "shapes.h"

#include <pinhole/overlay.h>

static struct ph_renderer r;

static int draw(uint32_t frame)
{
    static struct shape torus;
    static uint16_t ramp[PH_RAMP_SIZE];
    const struct ph_material material = shape_lit(ramp, 230, 120, 90);
    const struct ph_mesh mesh = shape_torus(&torus, FX_ONE / 2, &material);
    const struct ph_xform turn = ph_xform_rotate_x(frame << 25);
    const int status = example_look(&r, (struct fx_vec3){0, 0, FX_INT(5)}, (struct fx_vec3){0, 0, 0}, &shapes_daylight,
                                    ph_rgb565(30, 40, 60));
    return status != 0 ? status : ph_draw_mesh(&r, &mesh, &turn);
}

static void paint(void *context, const struct ph_overlay_band *band)
{
    const struct ph_overlay_style large = {.colour = ph_rgb565(255, 255, 255), .scale = 3},
                                  small = {.colour = ph_rgb565(255, 220, 120), .scale = 2};
    char number[PH_TEXT_NUMBER_SIZE];
    (void)context;
    ph_text_number(number, (int32_t)r.stats.triangles_drawn);
    ph_text(band, (WIDTH - ph_text_width("Pinhole", 3)) / 2, 10, "Pinhole", &large);
    ph_text(band, 8, HEIGHT - 22, number, &small);
    ph_text(band, 14 + ph_text_width(number, 2), HEIGHT - 22, "triangles", &small);
}

int main(int argc, char *argv[])
{
    const struct ph_config config = example_config();
    int status = ph_renderer_init(&r, &config);
    status = status != 0 ? status : draw(example_frame(argc, argv));
    status = status != 0 ? status : ph_show_painted(&r, example_flush, NULL, paint);
    return example_save(&r, status);
}
