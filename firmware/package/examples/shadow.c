/* A shadow on the ground, through which the ground is seen. */
#include "example.h"
#include "shapes.h"

#include <pinhole/shadow.h>

static int draw(struct ph_renderer *r, uint32_t frame)
{
    static struct shape torus, ground;
    static uint16_t ramp[PH_RAMP_SIZE], texels[256];
    static struct ph_texture checks;
    static const struct ph_blend half = {.draw = ph_draw_blended, .kind = PH_BLEND_ALPHA, .alpha = 16};
    static const struct ph_plane_equation plane = {.normal_q30 = {0, FX_Q30_ONE, 0}, .d = FX_ONE}; /* y = -1 */
    const struct fx_vec3 lamp = {-FX_INT(2), FX_INT(4), FX_INT(2)};
    const struct ph_scene_light light = {
        .ambient = FX_ONE, .count = 1, .lights = {{.kind = PH_LIGHT_POINT, .intensity = FX_ONE, .position = lamp}}};
    checks = shape_checks(texels, ph_rgb565(200, 200, 190), ph_rgb565(150, 160, 170));
    const struct ph_material violet = shape_lit(ramp, 180, 110, 230),
                             tiles = {.shading = PH_SHADE_TEXTURE, .texture = &checks},
                             dark = {.shading = PH_SHADE_UNLIT, .colour = 0, .blend = &half, .depth_bias = 16};
    const struct ph_mesh mesh = shape_torus(&torus, FX_ONE / 3, &violet), floor = shape_floor(&ground, &tiles);
    const struct ph_xform turn = ph_xform_rotate_y(frame << 25), up = ph_xform_translate(0, FX_HALF, 0),
                          place = ph_xform_mul(&up, &turn);
    int status = example_look(r, (struct fx_vec3){0, FX_INT(2), FX_INT(6)}, (struct fx_vec3){0, 0, 0}, &light,
                              ph_rgb565(90, 120, 160));
    status = status != 0 ? status : ph_draw_mesh(r, &floor, &ph_xform_identity);
    status = status != 0 ? status : ph_draw_mesh(r, &mesh, &place);
    return status != 0 ? status : ph_draw_shadow(r, &mesh, &place, lamp, &plane, &dark);
}

int main(int argc, char *argv[])
{
    const struct ph_config config = example_config();
    return example_run(argc, argv, &config, draw);
}
