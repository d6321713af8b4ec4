/* asset_normals: normals of a few triangles, worked out by hand. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "asset_mesh.h"

#include <math.h>

#define UNIT 16384 /* length of a normal */

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
    int16_t normals[9][3] = {{0}};
    asset_normals(places, 9, normals);
    for (int i = 0; i < 3; i++) {
        expect(normals[i], 0, 0, 1);
        expect(normals[3 + i], 1, 0, 0);
        expect(normals[6 + i], 0, 1, 0);
    }
}

static void a_triangle_without_area_has_no_normal(void **state)
{
    (void)state;
    const struct fx_vec3 places[3] = {at(1, 1, 1), at(2, 2, 2), at(3, 3, 3)};
    int16_t normals[3][3] = {{7, 7, 7}, {7, 7, 7}, {7, 7, 7}};
    asset_normals(places, 3, normals);
    for (int i = 0; i < 9; i++) {
        assert_int_equal(normals[i / 3][i % 3], 0);
    }
    asset_normals(NULL, 0, NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_triangle_faces_by_the_right_hand),
        cmocka_unit_test(a_triangle_without_area_has_no_normal),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
