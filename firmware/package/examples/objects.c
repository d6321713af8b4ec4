/* Many objects: 216 cubes of one mesh. Bounds let the renderer pass over those that are off the picture. */
#include "example.h"
#include "shapes.h"

enum { SIDE = 6 };

static int draw(struct ph_renderer *r, uint32_t frame)
{
    static struct shape cube;
    static struct ph_sphere bounds[PH_BOUNDS(1)];
    static uint16_t ramps[SIDE][PH_RAMP_SIZE];
    struct ph_material paints[SIDE];
    for (int i = 0; i < SIDE; i++) {
        paints[i] = shape_lit(ramps[i], (uint8_t)(60 + 36 * i), 110, (uint8_t)(240 - 36 * i));
    }
    struct ph_mesh mesh = shape_cube(&cube, paints);
    const fx_t turns = (fx_t)(frame << 8);
    if (ph_mesh_bounds(&mesh, bounds) != 0) {
        return PH_ERR_INVAL;
    }
    int status = example_look(r, (struct fx_vec3){8 * fx_sin(turns), FX_INT(4), 8 * fx_cos(turns)},
                              (struct fx_vec3){0, -FX_HALF, 0}, &shapes_daylight, ph_rgb565(16, 16, 24));
    for (int i = 0; i < SIDE * SIDE * SIDE && status == 0; i++) {
        struct ph_xform place = ph_xform_scale(FX_ONE / 5);
        place.t =
            (struct fx_vec3){FX_ONE * (2 * (i % SIDE) - SIDE + 1) / 2, FX_ONE * (2 * (i / SIDE % SIDE) - SIDE + 1) / 2,
                             FX_ONE * (2 * (i / SIDE / SIDE) - SIDE + 1) / 2};
        mesh.materials = &paints[i / SIDE % SIDE];
        status = ph_draw_mesh(r, &mesh, &place);
    }
    return status;
}

int main(int argc, char *argv[])
{
    const struct ph_config config = example_config();
    return example_run(argc, argv, &config, draw);
}
