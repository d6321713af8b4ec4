/* A fisheye of 180 degrees from the middle of a ring of cubes. */
#include "example.h"
#include "shapes.h"

static int draw(struct ph_renderer *r, uint32_t frame)
{
    static struct shape cube, ground;
    static uint16_t ramps[3][PH_RAMP_SIZE], texels[256];
    static struct ph_texture checks;
    struct ph_material paints[3] = {shape_lit(ramps[0], 230, 90, 70), shape_lit(ramps[1], 240, 200, 80),
                                    shape_lit(ramps[2], 80, 150, 220)};
    checks = shape_checks(texels, ph_rgb565(180, 180, 180), ph_rgb565(90, 90, 100));
    const struct ph_material tiles = {.shading = PH_SHADE_TEXTURE, .texture = &checks};
    const struct ph_mesh floor = shape_floor(&ground, &tiles);
    struct ph_mesh block = shape_cube(&cube, paints);
    const struct ph_xform view = ph_view_look_at((struct fx_vec3){0, 0, 0}, (struct fx_vec3){0, -FX_HALF, -FX_ONE},
                                                 (struct fx_vec3){0, FX_ONE, 0});
    struct ph_projection lens;
    int status = ph_projection_fisheye(&lens, FX_INT(180), FX_ONE / 4, FX_INT(30));
    status = status != 0 ? status : ph_frame_begin(r, &view, &lens, &shapes_daylight, ph_rgb565(140, 180, 220));
    status = status != 0 ? status : ph_draw_mesh(r, &floor, &ph_xform_identity);
    for (int32_t i = 0; i < 12 && status == 0; i++) {
        const fx_t turns = FX_ONE * i / 12 + (fx_t)(frame << 7);
        const struct ph_xform small = ph_xform_scale(FX_HALF), turn = ph_xform_rotate_y((uint32_t)-turns << 16);
        struct ph_xform place = ph_xform_mul(&turn, &small);
        place.t = (struct fx_vec3){4 * fx_cos(turns), -FX_HALF, 4 * fx_sin(turns)};
        block.materials = &paints[i % 3];
        status = ph_draw_mesh(r, &block, &place);
    }
    return status;
}

int main(int argc, char *argv[])
{
    struct ph_config config = example_config();
    config.depth_format = PH_DEPTH_FLOAT16; /* far is 120 times as far as near */
    return example_run(argc, argv, &config, draw);
}
