/* Colours of vertices: a cube whose corners are the corners of the colour cube. */
#include "example.h"
#include "shapes.h"

static int draw(struct ph_renderer *r, uint32_t frame)
{
    static struct shape cube;
    static uint16_t colours[24];
    const struct ph_material material = {.shading = PH_SHADE_UNLIT};
    struct ph_mesh mesh = shape_cube(&cube, &material);
    for (int i = 0; i < 24; i++) {
        const struct fx_vec3 p = cube.positions[i];
        colours[i] = ph_rgb565(p.x > 0 ? 255 : 0, p.y > 0 ? 255 : 0, p.z > 0 ? 255 : 0);
    }
    mesh.colours = colours;
    const struct ph_xform turn = ph_xform_rotate_y(frame << 25);
    const int status = example_look(r, (struct fx_vec3){0, FX_INT(2), FX_INT(4)}, (struct fx_vec3){0, 0, 0}, NULL,
                                    ph_rgb565(128, 128, 128));
    return status != 0 ? status : ph_draw_mesh(r, &mesh, &turn);
}

int main(int argc, char *argv[])
{
    struct ph_config config = example_config();
    config.colouring = PH_COLOURS; /* a program that does not say this links nothing of colours */
    return example_run(argc, argv, &config, draw);
}
