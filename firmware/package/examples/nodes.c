/* A scene of nodes: sun, earth and moon, each turning in the place of its parent. */
#include "example.h"
#include "shapes.h"

#include <pinhole/camera.h>

enum { SUN, ORBIT, EARTH, ORBIT_OF_MOON, MOON, NODES };

static int draw(struct ph_renderer *r, uint32_t frame)
{
    static struct shape ball;
    static uint16_t ramps[2][PH_RAMP_SIZE];
    const struct ph_scene_light light = {
        .ambient = FX_ONE / 3, .count = 1, .lights = {{.kind = PH_LIGHT_POINT, .intensity = FX_ONE}}};
    const struct ph_material paints[NODES] = {[SUN] = {.shading = PH_SHADE_UNLIT, .colour = ph_rgb565(255, 220, 90)},
                                              [EARTH] = shape_lit(ramps[0], 80, 140, 255),
                                              [MOON] = shape_lit(ramps[1], 190, 190, 190)};
    static const fx_t sizes[NODES] = {[SUN] = FX_ONE * 3 / 4, [EARTH] = FX_ONE * 2 / 5, [MOON] = FX_ONE / 6};
    const struct ph_node nodes[NODES] = {[SUN] = {-1, ph_xform_identity},
                                         [ORBIT] = {SUN, ph_xform_rotate_y((frame << 25) + 0xc0000000)},
                                         [EARTH] = {ORBIT, ph_xform_translate(FX_ONE * 17 / 10, 0, 0)},
                                         [ORBIT_OF_MOON] = {EARTH, ph_xform_rotate_y(frame << 27)},
                                         [MOON] = {ORBIT_OF_MOON, ph_xform_translate(FX_ONE * 7 / 10, 0, 0)}};
    struct ph_xform world[NODES];
    struct ph_mesh mesh = shape_ball(&ball, paints);
    int status = ph_nodes_world(nodes, NODES, world);
    status = status != 0 ? status
                         : example_look(r, (struct fx_vec3){0, FX_INT(2), FX_INT(4)}, (struct fx_vec3){0, 0, 0}, &light,
                                        ph_rgb565(6, 6, 16));
    for (int i = 0; i < NODES && status == 0; i++) {
        const struct ph_xform size = ph_xform_scale(sizes[i]), place = ph_xform_mul(&world[i], &size);
        mesh.materials = &paints[i];
        status = sizes[i] == 0 ? 0 : ph_draw_mesh(r, &mesh, &place);
    }
    return status;
}

int main(int argc, char *argv[])
{
    const struct ph_config config = example_config();
    return example_run(argc, argv, &config, draw);
}
