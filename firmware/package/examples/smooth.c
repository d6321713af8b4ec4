/* Smooth edges: the mean of 2 x 2 samples a pixel; it takes four times the depth memory. */
#include "example.h"
#include "shapes.h"

static int draw(struct ph_renderer *r, uint32_t frame)
{
    static struct shape torus;
    static uint16_t ramp[PH_RAMP_SIZE];
    const struct ph_material material = shape_lit(ramp, 250, 210, 90);
    const struct ph_mesh mesh = shape_torus(&torus, FX_ONE / 4, &material);
    const struct ph_xform tilt = ph_xform_rotate_x(0xc8000000), turn = ph_xform_rotate_y(frame << 25);
    const struct ph_xform place = ph_xform_mul(&turn, &tilt);
    const int status = example_look(r, (struct fx_vec3){0, 0, FX_INT(4)}, (struct fx_vec3){0, 0, 0}, &shapes_daylight,
                                    ph_rgb565(10, 30, 50));
    return status != 0 ? status : ph_draw_mesh(r, &mesh, &place);
}

int main(int argc, char *argv[])
{
    static uint32_t depth[WIDTH * BAND * 2], samples[WIDTH * BAND * 2];
    struct ph_config config = example_config();
    config.depth = depth;
    config.samples = (uint16_t *)samples;
    config.antialiasing = PH_ANTIALIAS_2X2;
    return example_run(argc, argv, &config, draw);
}
