/* asset_reuse: the orders are those of libmeshoptimizer, which does the same by its own code. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "asset_reuse.h"

#include <meshoptimizer.h> /* tests/run.sh skips this program where the library is not installed */
#include <stdint.h>

enum { MOST = 3 * 600 };

static uint32_t state_of_random;

static unsigned below(unsigned n)
{
    state_of_random = state_of_random * 1664525u + 1013904223u;
    return (state_of_random >> 8) % n;
}

/* Compares both orders and the count of fetches. */
static void expect_the_librarys(const unsigned *indices, size_t count, size_t vertices)
{
    unsigned ours[MOST], theirs[MOST], ages[MOST];
    const struct asset_corners from = {indices, count, vertices};
    assert_int_equal(
        asset_reuse_fetches(&from, ages),
        meshopt_analyzeVertexCache(indices, count, vertices, ASSET_REUSE_CACHE, 0, 0).vertices_transformed);
    assert_true(asset_reuse_fans(&from, ours));
    meshopt_optimizeVertexCacheFifo(theirs, indices, count, vertices, ASSET_REUSE_CACHE);
    assert_memory_equal(ours, theirs, count * sizeof *ours);
    assert_true(asset_reuse_scores(&from, ours));
    meshopt_optimizeVertexCache(theirs, indices, count, vertices);
    assert_memory_equal(ours, theirs, count * sizeof *ours);
}

/* Corners of one triangle may also be one vertex; some vertices have none. */
static void triangles_at_random_come_in_the_librarys_order(void **state)
{
    (void)state;
    unsigned indices[MOST];
    state_of_random = 1;
    for (int i = 0; i < 400; i++) {
        const size_t count = 3 * (size_t)(1 + below(MOST / 3 - 1));
        const unsigned vertices = 3 + below(i % 2 == 0 ? 40 : MOST - 3);
        for (size_t k = 0; k < count; k++) {
            indices[k] = below(vertices);
        }
        expect_the_librarys(indices, count, vertices);
    }
}

/* Grids, as most models have them, with their quads in any order. */
static void grids_come_in_the_librarys_order(void **state)
{
    (void)state;
    unsigned indices[MOST], quads[MOST / 6];
    state_of_random = 2;
    for (unsigned side = 1; side * side <= MOST / 6; side++) {
        const unsigned n = side * side;
        for (unsigned i = 0; i < n; i++) {
            const unsigned at = below(i + 1);
            quads[i] = quads[at];
            quads[at] = i;
        }
        for (unsigned i = 0; i < n; i++) {
            const unsigned v = quads[i] / side * (side + 1) + quads[i] % side;
            const unsigned quad[6] = {v, v + 1, v + side + 2, v, v + side + 2, v + side + 1};
            for (unsigned k = 0; k < 6; k++) {
                indices[6 * i + k] = quad[k];
            }
        }
        expect_the_librarys(indices, 6 * (size_t)n, (size_t)(side + 1) * (side + 1));
    }
}

static void no_triangles_are_an_order_too(void **state)
{
    (void)state;
    unsigned to[1] = {7}, ages[1];
    const struct asset_corners none = {to, 0, 0};
    assert_int_equal(asset_reuse_fetches(&none, ages), 0);
    assert_true(asset_reuse_fans(&none, to) && asset_reuse_scores(&none, to));
    assert_int_equal(to[0], 7);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(triangles_at_random_come_in_the_librarys_order),
        cmocka_unit_test(grids_come_in_the_librarys_order),
        cmocka_unit_test(no_triangles_are_an_order_too),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
