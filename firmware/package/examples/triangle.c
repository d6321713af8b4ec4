/* A triangle: mesh, material, camera, frame. triangle.h is the same for displays on microcontrollers. */
#include "example.h"

static int draw(struct ph_renderer *r, uint32_t frame)
{
    static const struct fx_vec3 corners[] = {{-FX_ONE, -FX_ONE, 0}, {FX_ONE, -FX_ONE, 0}, {0, FX_ONE, 0}};
    static const uint16_t faces[][3] = {{0, 1, 2}}; /* counter-clockwise, seen from outside */
    static const struct ph_part part = {.count = 1};
    const struct ph_material orange = {.shading = PH_SHADE_UNLIT, .colour = ph_rgb565(255, 160, 0), .two_sided = 1};
    const struct ph_mesh mesh = {.positions = corners,
                                 .triangles = faces,
                                 .parts = &part,
                                 .materials = &orange,
                                 .vertex_count = 3,
                                 .triangle_count = 1,
                                 .part_count = 1};

    const struct ph_xform view = ph_xform_translate(0, 0, FX_INT(-4)); /* the world, 4 before the eye */
    const struct ph_xform turn = ph_xform_rotate_y(frame << 24);
    struct ph_projection lens;
    int status = ph_projection_perspective(&lens, FX_INT(45), FX_ONE * WIDTH / HEIGHT, FX_HALF, FX_INT(10));
    status = status != 0 ? status : ph_frame_begin(r, &view, &lens, NULL, ph_rgb565(20, 24, 40));
    return status != 0 ? status : ph_draw_mesh(r, &mesh, &turn);
}

int main(int argc, char *argv[])
{
    const struct ph_config config = example_config();
    return example_run(argc, argv, &config, draw);
}
