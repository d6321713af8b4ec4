/*
 * The vertices of a mesh are those that ph_transform() gives one by one. Projections are of all kinds, focal lengths
 * reach 2^17 pixels, and distances are such that some vertices are beyond each plane and each limit.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "transform.h"
#include "ref_random.h"
#include "ref_rig.h"

#include <math.h>

enum { VERTICES = 64, MESHES = 4000 };

static int32_t any_length(double most)
{
    return (int32_t)ref_uniform(-most, most);
}

static struct ph_xform any_place(double reach)
{
    struct ph_xform x;
    double r[3][3];
    ref_rotation(3.14, r);
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            x.r[i][k] = ref_q30(r[i][k]);
        }
    }
    x.t = (struct fx_vec3){any_length(reach), any_length(reach), any_length(reach)};
    return x;
}

static struct ph_projection any_projection(int i)
{
    static const double fields[] = {.1, 1, 30, 60, 90, 150};
    const fx_t near = 1 + (fx_t)ldexp(1, (int)ref_uniform(0, 17)),
               far = i % 3 == 0 ? FX_MAX : near + FX_ONE + any_length(60000);
    struct ph_projection p;
    if (i % 7 == 0) {
        assert_int_equal(ph_projection_ortho(&p, -FX_ONE, FX_ONE, -FX_ONE, FX_ONE, near, far), 0);
    } else if (i % 7 == 1) {
        assert_int_equal(ph_projection_fisheye(&p, FX_INT(180), near, far), 0);
    } else {
        const fx_t field = (fx_t)ldexp(fields[(int)ref_uniform(0, 6)], 16);
        assert_int_equal(ph_projection_perspective(&p, field, FX_ONE, near, far), 0);
        p.shift_x = any_length(2 * 65536.);
        p.shift_y = i % 2 == 0 ? 0 : any_length(2 * 65536.);
    }
    return p;
}

/* How many of the vertices are projected and in the picture, are projected and beyond it, are neither. */
struct seen {
    unsigned inside, beside, unprojected;
};

static void same_vertices(const struct rig *rig, const struct ph_xform *place, const struct ph_mesh *mesh,
                          struct seen *seen)
{
    const struct ph_xform object_to_view = ph_xform_mul(&rig->r.view, place);
    const struct ph_clip_matrix matrix = ph_clip_matrix(&rig->r.lens, &object_to_view);
    const struct ph_vertex *const got = rig->vertices;
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        struct ph_vertex want;
        ph_transform(&rig->r, &matrix, &mesh->positions[i], &want);
        assert_int_equal(got[i].code, want.code);
        assert_int_equal(got[i].light, PH_LIGHT_ZERO + PH_LIGHT_SPAN);
        if ((want.code & (PH_NEAR | PH_GUARD)) != 0) {
            seen->unprojected++;
            continue;
        }
        assert_true(got[i].x == want.x && got[i].y == want.y && got[i].q == want.q && got[i].s == want.s);
        seen->inside += want.code == 0;
        seen->beside += want.code != 0;
    }
}

static void a_mesh_has_the_vertices_that_come_one_by_one(void **state)
{
    (void)state;
    static const int sizes[][2] = {{320, 240}, {64, 64}, {480, 320}, {1024, 1024}};
    struct seen seen = {0};
    ref_seed(77);
    for (int i = 0; i < MESHES; i++) {
        struct rig rig;
        const int *size = sizes[i % 4];
        rig_open(&rig, size[0], size[1], 1, PH_DEPTH_FLOAT16, VERTICES, 1);
        const double far = ldexp(1, 16 + (int)ref_uniform(0, 15)), reach = ldexp(1, 14 + (int)ref_uniform(0, 17));
        const struct ph_xform view = any_place(far), place = any_place(i % 5 == 0 ? 0 : 65536);
        const struct ph_projection projection = any_projection(i);
        struct fx_vec3 positions[VERTICES];
        for (int k = 0; k < VERTICES; k++) {
            positions[k] = (struct fx_vec3){any_length(reach), any_length(reach), any_length(reach)};
        }
        const struct ph_mesh mesh = {.positions = positions, .vertex_count = VERTICES};
        if (ph_frame_begin(&rig.r, &view, &projection, NULL, 0) == PH_OK) {
            assert_int_equal(ph_draw_mesh(&rig.r, &mesh, &place), PH_OK);
            same_vertices(&rig, &place, &mesh, &seen);
        }
        rig_close(&rig);
    }
    assert_true(seen.inside > 2000 && seen.beside > 2000 && seen.unprojected > 2000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_mesh_has_the_vertices_that_come_one_by_one)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
