/* A mesh that changes its shape: a drop of jelly, whose positions and normals are computed anew for each frame. */
#include "example.h"
#include "shapes.h"

/* Pushes each vertex in and out; the normals lean as the surface does. */
static void wobble(struct shape *s, uint32_t frame)
{
    for (int i = 0; i < 33 * 17; i++) {
        struct fx_vec3 *const p = &s->positions[i];
        const fx_t phase = p->y / 2 + (fx_t)(frame << 10), out = FX_ONE + fx_sin(phase) / 4,
                   lean = fx_cos(phase) / 4; /* d out / d y, about */
        p->x = fx_mul_sat(p->x, out);
        p->z = fx_mul_sat(p->z, out);
        struct fx_vec3 unit, n = {s->normals[i][0] * 4, s->normals[i][1] * 4 - lean, s->normals[i][2] * 4};
        if (fx_vec3_direction_q30(n, &unit)) {
            s->normals[i][0] = (int16_t)(unit.x >> 16);
            s->normals[i][1] = (int16_t)(unit.y >> 16);
            s->normals[i][2] = (int16_t)(unit.z >> 16);
        }
    }
}

static int draw(struct ph_renderer *r, uint32_t frame)
{
    static struct shape ball;
    static uint16_t ramp[PH_RAMP_SIZE];
    const struct ph_material jelly = shape_lit(ramp, 90, 220, 120);
    const struct ph_mesh mesh = shape_ball(&ball, &jelly); /* the mesh points to the arrays that change */
    wobble(&ball, frame);
    const int status = example_look(r, (struct fx_vec3){0, FX_ONE, FX_INT(4)}, (struct fx_vec3){0, 0, 0},
                                    &shapes_daylight, ph_rgb565(40, 20, 50));
    return status != 0 ? status : ph_draw_mesh(r, &mesh, &ph_xform_identity);
}

int main(int argc, char *argv[])
{
    const struct ph_config config = example_config();
    return example_run(argc, argv, &config, draw);
}
