/* Points: a spiral galaxy of discs, each with its own colour and size, added to what is behind. */
#include "example.h"

enum { STARS = 1000 };

static int draw(struct ph_renderer *r, uint32_t frame)
{
    static struct fx_vec3 positions[STARS];
    static uint16_t colours[STARS];
    static fx_t sizes[STARS];
    static const struct ph_blend added = {.draw = ph_draw_blended, .kind = PH_BLEND_ADD, .alpha = 24};
    const struct ph_material material = {.shading = PH_SHADE_UNLIT, .blend = &added};
    uint32_t seed = 1;
    for (int32_t i = 0; i < STARS; i++) {
        seed = seed * 1664525 + 1013904223;
        const fx_t out = FX_ONE * 3 * i / STARS, angle = out / 2 + (i % 2) * FX_HALF,
                   noise = (fx_t)(seed >> 17) - 16384;
        positions[i] = (struct fx_vec3){fx_mul_sat(out, fx_cos(angle)) + noise / 2, (int16_t)(seed >> 8) / 4,
                                        fx_mul_sat(out, fx_sin(angle)) + (int16_t)(seed >> 3) / 4};
        colours[i] = i < STARS / 3 ? ph_rgb565(255, 210, 150) : ph_rgb565(130, 170, 255);
        sizes[i] = FX_ONE / 30 + (fx_t)(seed >> 20);
    }
    const struct ph_points stars = {
        .positions = positions, .colours = colours, .sizes = sizes, .count = STARS, .in_world = true, .round = true};
    const struct ph_xform turn = ph_xform_rotate_y(frame << 25);
    const int status = example_look(r, (struct fx_vec3){0, FX_INT(4), FX_INT(6)}, (struct fx_vec3){0, -FX_HALF, 0},
                                    NULL, ph_rgb565(4, 4, 12));
    return status != 0 ? status : ph_draw_points(r, &stars, &turn, &material);
}

int main(int argc, char *argv[])
{
    const struct ph_config config = example_config();
    return example_run(argc, argv, &config, draw);
}
