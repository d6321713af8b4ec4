/*
 * The matvec.h of each CPU gives exactly the sums of 64 bits of ph_matrix_mul, for every point that it takes. The
 * points have all sizes, the matrices reach up to the ends of their range.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "portable/matvec.h"

#undef PH_MATVEC_H
#undef PH_MATVEC_RANGE
#define ph_row             armv6m_row
#define ph_is_within       armv6m_is_within
#define ph_matvec          armv6m_matvec
#define ph_matvec_prepare  armv6m_matvec_prepare
#define ph_matvec_in_range armv6m_matvec_in_range
#define ph_matvec_near     armv6m_matvec_near
#include "armv6m/matvec.h"
#undef ph_row
#undef ph_is_within
#undef ph_matvec
#undef ph_matvec_prepare
#undef ph_matvec_in_range
#undef ph_matvec_near

#include "ref_random.h"

#include <math.h>

static unsigned pick(unsigned n)
{
    return (unsigned)ref_uniform(0, n - 1e-6);
}

/*
 * Elements below 2 in Q4.28, every other time so that those of a row are below 2 together; translation any place that
 * 32 bits hold, or a small one.
 */
static struct ph_clip_matrix any_matrix(int kind)
{
    struct ph_clip_matrix m;
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            const double ends[] = {-(1 << 29), (1 << 29) - 1, 511, 512, -512, -513, 0, 0x7fe00};
            m.m[i][j] = (int32_t)(kind % 4 == 0 ? ends[pick(8)] : ref_uniform(-(1 << 29), (1 << 29) - 1)) /
                        (kind % 2 == 0 ? 1 : 3);
        }
        const double reach = kind % 3 == 0 ? 2147483647. : kind % 3 == 1 ? 1073741823. : 655360.;
        m.t[i] = (int64_t)ref_uniform(-reach, reach) * (1 << 28) + (1 << 27);
    }
    return m;
}

static int32_t any_coordinate(int kind)
{
    const int bits = kind % 2 == 0 ? 20 : (int)pick(32);
    if (kind % 3 == 0) {
        return pick(5) > 0 ? (int32_t)ref_uniform(-(1 << 16), 1 << 16) : pick(2) > 0 ? -(1 << 16) : (1 << 16) - 1;
    }
    if (kind % 5 == 0) {
        const int32_t ends[] = {-(1 << 20), (1 << 20) - 1, 1 << 20, -(1 << 20) - 1, -(1 << 27), (1 << 27) - 1, 1 << 27};
        return ends[pick(7)];
    }
    const double most = ldexp(1, bits);
    return (int32_t)ref_uniform(-most, most - 1);
}

static void every_cpu_gives_the_exact_sums(void **state)
{
    (void)state;
    ref_seed(28);
    uint32_t wide_near = 0, near = 0, very_near = 0;
    for (int i = 0; i < 200000; i++) {
        const struct ph_clip_matrix m = any_matrix(i / 8);
        const struct fx_vec3 p = {any_coordinate(i), any_coordinate(i), any_coordinate(i)};
        struct ph_matvec wide;
        struct armv6m_matvec digits;
        ph_matvec_prepare(&wide, &m);
        armv6m_matvec_prepare(&digits, &m);
        const struct fx_vec3 exact = ph_matrix_mul(&m, &p);
        if (ph_matvec_in_range(&wide, &p)) {
            const struct fx_vec3 a = ph_matvec_near(&wide, &p);
            assert_true(a.x == exact.x && a.y == exact.y && a.z == exact.z);
            wide_near++;
        }
        if (armv6m_matvec_in_range(&digits, &p)) {
            const struct fx_vec3 b = armv6m_matvec_near(&digits, &p);
            assert_true(b.x == exact.x && b.y == exact.y && b.z == exact.z);
            near++;
            very_near += armv6m_is_within(&p, digits.short_range);
        }
    }
    /* Each way was taken often, and so were points that are too far away for it. */
    assert_in_range(wide_near, 20000, 180000);
    assert_in_range(very_near, 20000, near - 20000);
    assert_true(near < 180000);
}

/* ph_matrix_mul itself, where its sums are known. */
static void the_sums_are_those_of_a_matrix(void **state)
{
    (void)state;
    const struct ph_clip_matrix m = {{{1 << 28, 0, 0}, {0, -(1 << 27), 0}, {1 << 28, 1 << 28, -(1 << 28)}},
                                     {1 << 27, ((int64_t)7 << 28) + (1 << 27), 1 << 27}};
    const struct fx_vec3 p = {FX_INT(3), FX_INT(5), -9}, at = ph_matrix_mul(&m, &p);
    assert_int_equal(at.x, FX_INT(3));
    assert_int_equal(at.y, 7 - FX_INT(5) / 2);
    assert_int_equal(at.z, FX_INT(8) + 9);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_cpu_gives_the_exact_sums),
        cmocka_unit_test(the_sums_are_those_of_a_matrix),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
