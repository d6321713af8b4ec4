/* Light: a torus with a highlight, and a small lamp that goes around it. */
#include "example.h"
#include "shapes.h"

static int draw(struct ph_renderer *r, uint32_t frame)
{
    static struct shape torus, ball;
    static uint16_t ramp[PH_RAMP_SIZE];
    const fx_t turns = (fx_t)(frame << 9); /* 128 frames a turn */
    const struct fx_vec3 lamp = {2 * fx_cos(turns), FX_ONE, 2 * fx_sin(turns)};
    const struct ph_scene_light light = {
        .ambient = FX_ONE,
        .count = 2,
        .lights = {{.kind = PH_LIGHT_POINT, .intensity = FX_ONE * 3 / 2, .position = lamp, .reach = FX_INT(2)},
                   {.intensity = FX_HALF, .to_light_q30 = {-FX_Q30_ONE / 5 * 3, 0, FX_Q30_ONE / 5 * 4}}}};
    const struct ph_material material = shape_lit(ramp, 90, 170, 230),
                             glow = {.shading = PH_SHADE_UNLIT, .colour = ph_rgb565(255, 240, 180)};
    const struct ph_mesh ring = shape_torus(&torus, FX_ONE * 2 / 5, &material), bulb = shape_ball(&ball, &glow);
    const struct ph_xform tilt = ph_xform_rotate_x(0xd8000000), small = ph_xform_scale(FX_ONE / 12);
    struct ph_xform at = small;
    at.t = lamp;
    int status = example_look(r, (struct fx_vec3){0, FX_INT(1), FX_INT(4)}, (struct fx_vec3){0, 0, 0}, &light,
                              ph_rgb565(10, 10, 16));
    status = status != 0 ? status : ph_draw_mesh(r, &ring, &tilt);
    return status != 0 ? status : ph_draw_mesh(r, &bulb, &at);
}

int main(int argc, char *argv[])
{
    const struct ph_config config = example_config();
    return example_run(argc, argv, &config, draw);
}
