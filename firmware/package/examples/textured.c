/* A texture on a cube, filtered between its texels, with the light on it. */
#include "example.h"
#include "shapes.h"

static int draw(struct ph_renderer *r, uint32_t frame)
{
    static struct shape cube;
    static uint16_t texels[256]; /* a texture must stay until the picture is shown */
    static struct ph_texture checks;
    checks = shape_checks(texels, ph_rgb565(240, 200, 120), ph_rgb565(60, 100, 170));
    checks.filter = PH_FILTER_BILINEAR;
    const struct ph_material material = {
        .shading = PH_SHADE_TEXTURE_GOURAUD, .texture = &checks, .ambient = FX_ONE / 3, .diffuse = FX_ONE * 2 / 3};
    const struct ph_mesh mesh = shape_cube(&cube, &material);
    const struct ph_xform turn = ph_xform_rotate_y(frame << 25);
    const int status = example_look(r, (struct fx_vec3){0, FX_INT(2), FX_INT(4)}, (struct fx_vec3){0, 0, 0},
                                    &shapes_daylight, ph_rgb565(24, 28, 36));
    return status != 0 ? status : ph_draw_mesh(r, &mesh, &turn);
}

int main(int argc, char *argv[])
{
    const struct ph_config config = example_config();
    return example_run(argc, argv, &config, draw);
}
