/* asset_normals: normals of a few triangles, worked out by hand: flat, smooth, and on both sides of a crease. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "asset_mesh.h"

#include <math.h>

#define UNIT   16384                               /* length of a normal */
#define CREASE (66 * 3.14159265358979323846 / 180) /* radians */

static struct fx_vec3 at(double x, double y, double z)
{
    return (struct fx_vec3){(fx_t)lround(x * FX_ONE), (fx_t)lround(y * FX_ONE), (fx_t)lround(z * FX_ONE)};
}

static void expect(const int16_t normal[3], double x, double y, double z)
{
    const double length = sqrt(x * x + y * y + z * z), want[3] = {x / length, y / length, z / length};
    for (int i = 0; i < 3; i++) {
        if (fabs(normal[i] - want[i] * UNIT) > 2) { /* corners are rounded to Q16.16, too */
            fail_msg("axis %d: %d, should be %.1f", i, normal[i], want[i] * UNIT);
        }
    }
}

static void a_triangle_faces_by_the_right_hand(void **state)
{
    (void)state;
    const struct fx_vec3 places[9] = {at(0, 0, 0), at(3, 0, 0), at(0, 2, 0), at(5, 0, 0), at(5, 1, 0),
                                      at(5, 0, 1), at(0, 9, 0), at(0, 9, 1), at(1, 9, 0)};
    for (int is_flat = 0; is_flat < 2; is_flat++) {
        int16_t normals[9][3] = {{0}};
        assert_true(asset_normals(places, 9, is_flat, normals));
        for (int i = 0; i < 3; i++) {
            expect(normals[i], 0, 0, 1);
            expect(normals[3 + i], 1, 0, 0);
            expect(normals[6 + i], 0, 1, 0);
        }
    }
}

/* Two triangles on the x axis, one in the plane y, the other folded up from it by an angle; `wide` is how far the
 * second one reaches, which is its weight. */
static void fold(double radians, double wide, bool is_flat, int16_t normals[6][3])
{
    const struct fx_vec3 places[6] = {at(0, 0, 0),  at(10, 0, 0), at(0, 10, 0),
                                      at(10, 0, 0), at(0, 0, 0),  at(0, -wide * cos(radians), wide * sin(radians))};
    assert_true(asset_normals(places, 6, is_flat, normals));
}

static void faces_that_meet_at_a_small_angle_share_a_normal(void **state)
{
    (void)state;
    int16_t normals[6][3];
    const double angle = CREASE - 0.01;
    static const double widths[] = {10, 30};
    for (int i = 0; i < 2; i++) { /* the normal is the mean of both, by their areas */
        const double wide = widths[i], weight = wide / 10;
        fold(angle, wide, false, normals);
        const double y = weight * sin(angle), z = 1 + weight * cos(angle);
        expect(normals[0], 0, y, z);
        expect(normals[1], 0, y, z);
        expect(normals[3], 0, y, z);
        expect(normals[4], 0, y, z);
        expect(normals[2], 0, 0, 1); /* corners that are the face's own */
        expect(normals[5], 0, sin(angle), cos(angle));
    }
}

static void a_crease_keeps_its_edge(void **state)
{
    (void)state;
    int16_t normals[6][3];
    const double angle = CREASE + 0.01;
    fold(angle, 10, false, normals);
    for (int i = 0; i < 3; i++) {
        expect(normals[i], 0, 0, 1);
        expect(normals[3 + i], 0, sin(angle), cos(angle));
    }
    fold(0.1, 10, true, normals); /* flat: no angle is small enough */
    for (int i = 0; i < 3; i++) {
        expect(normals[i], 0, 0, 1);
        expect(normals[3 + i], 0, sin(0.1), cos(0.1));
    }
}

/* Corners that differ in one coordinate alone are two places. */
static void corners_must_be_at_the_same_place(void **state)
{
    (void)state;
    for (int axis = 0; axis < 3; axis++) {
        const double d = 0.5, dx = axis == 0 ? d : 0, dy = axis == 1 ? d : 0, dz = axis == 2 ? d : 0;
        const struct fx_vec3 places[6] = {
            at(0, 0, 0), at(10, 0, 0), at(0, 10, 0), at(dx, dy, dz), at(dx, dy - 10, dz + 1), at(dx + 10, dy, dz)};
        int16_t normals[6][3];
        assert_true(asset_normals(places, 6, false, normals));
        for (int i = 0; i < 3; i++) {
            expect(normals[i], 0, 0, 1);
            expect(normals[3 + i], 0, 1, 10);
        }
    }
}

/* A corner between two that share a place, and only z tells it from them. */
static void corners_are_found_wherever_they_stand(void **state)
{
    (void)state;
    const struct fx_vec3 places[9] = {at(0, 0, 0),  at(10, 0, 0), at(0, 10, 0), at(0, 0, 5),  at(10, 0, 5),
                                      at(0, 10, 5), at(10, 0, 0), at(0, 0, 0),  at(0, -10, 1)};
    int16_t normals[9][3];
    assert_true(asset_normals(places, 9, false, normals));
    const double y = 1 / sqrt(101), z = 10 / sqrt(101), area = sqrt(101) / 10;
    expect(normals[0], 0, y * area, 1 + z * area);
    expect(normals[7], 0, y * area, 1 + z * area);
    expect(normals[3], 0, 0, 1);
    expect(normals[8], 0, y, z);
}

static void a_triangle_without_area_has_no_normal(void **state)
{
    (void)state;
    const struct fx_vec3 places[3] = {at(1, 1, 1), at(2, 2, 2), at(3, 3, 3)};
    int16_t normals[3][3] = {{7, 7, 7}, {7, 7, 7}, {7, 7, 7}};
    assert_true(asset_normals(places, 3, false, normals));
    for (int i = 0; i < 9; i++) {
        assert_int_equal(normals[i / 3][i % 3], 0);
    }
    assert_true(asset_normals(NULL, 0, false, NULL));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_triangle_faces_by_the_right_hand),
        cmocka_unit_test(faces_that_meet_at_a_small_angle_share_a_normal),
        cmocka_unit_test(a_crease_keeps_its_edge),
        cmocka_unit_test(corners_must_be_at_the_same_place),
        cmocka_unit_test(corners_are_found_wherever_they_stand),
        cmocka_unit_test(a_triangle_without_area_has_no_normal),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
