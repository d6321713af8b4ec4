/* lab_formats: the table has each format of the renderer, in its order and without twins, and a float's bits of
 * exponent are those that its row names or that the renderer takes. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "lab_formats.h"

#include <string.h>

static void each_format_of_the_renderer_comes_first(void **state)
{
    (void)state;
    for (uint32_t i = 0; i + 1 < PH_DEPTH_FORMATS; i++) { /* auto is none */
        const struct lab_format *const f = &lab_formats[i];
        assert_true(f->format == ph_depth_formats[i + 1] && f->kind == LAB_DRAWN && f->exponent == 0);
        assert_string_equal(f->name, f->format->name);
        assert_int_equal(f->bits, f->format->bits);
    }
}

static void floats_have_a_row_for_each_exponent(void **state)
{
    uint32_t rows = 0, floats = 0;
    (void)state;
    for (uint32_t i = 1; i < PH_DEPTH_FORMATS; i++) {
        floats += ph_depth_formats[i]->coding == PH_DEPTH_IS_FLOAT;
    }
    for (uint32_t i = PH_DEPTH_FORMATS - 1; i < lab_format_count; i++) {
        const struct lab_format *const f = &lab_formats[i];
        if (f->kind != LAB_DRAWN) {
            assert_null(f->format);
            continue;
        }
        const size_t n = strlen(f->format->name);
        assert_true(f->format->coding == PH_DEPTH_IS_FLOAT && f->bits == f->format->bits);
        assert_int_equal(f->exponent, 3 + rows++ % 4);
        assert_memory_equal(f->name, f->format->name, n);
        assert_true(f->name[n] == '-' && f->name[n + 1] == 'e' && f->name[n + 2] == '0' + f->exponent);
        assert_int_equal(f->name[n + 3], 0);
    }
    assert_int_equal(rows, 4 * floats);
}

static void others_have_both_widths_and_no_row_has_a_twin(void **state)
{
    uint32_t kinds[2][LAB_LOG + 1] = {{0}};
    (void)state;
    assert_in_range(lab_format_count, 1, 32);
    for (uint32_t i = 0; i < lab_format_count; i++) {
        const struct lab_format *const f = &lab_formats[i];
        assert_true(f->bits == 16 || f->bits == 24);
        kinds[f->bits == 24][f->kind]++;
        for (uint32_t k = 0; k < i; k++) {
            assert_false(strcmp(lab_formats[k].name, f->name) == 0 && lab_formats[k].bits == f->bits);
        }
    }
    for (uint32_t kind = LAB_NDC_Q16; kind <= LAB_LOG; kind++) {
        assert_int_equal(kinds[0][kind], kind != LAB_LINEAR); /* the renderer has linear-w of 16 bits */
        assert_int_equal(kinds[1][kind], 1);
    }
}

static void exponents_are_named_or_the_renderers(void **state)
{
    static const fx_t far_z[] = {FX_INT(2), FX_INT(50), FX_INT(30000)};
    (void)state;
    for (uint32_t i = 0; i < lab_format_count; i++) {
        const struct lab_format *const f = &lab_formats[i];
        for (int k = 0; k < 3; k++) {
            const struct ph_projection p = {.kind = PH_PERSPECTIVE, .near_z = FX_ONE, .far_z = far_z[k]};
            const bool chosen = f->kind == LAB_DRAWN && f->format->coding == PH_DEPTH_IS_FLOAT && f->exponent == 0;
            const int want = chosen ? (int)ph_depth_choose_exponent(&p) : f->kind == LAB_OVER_W ? 4 : f->exponent;
            assert_int_equal(lab_exponent(f, FX_ONE, far_z[k]), want);
            assert_int_equal(want == 0,
                             !(f->kind == LAB_OVER_W || (f->format != NULL && f->format->coding == PH_DEPTH_IS_FLOAT)));
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_format_of_the_renderer_comes_first),
        cmocka_unit_test(floats_have_a_row_for_each_exponent),
        cmocka_unit_test(others_have_both_widths_and_no_row_has_a_twin),
        cmocka_unit_test(exponents_are_named_or_the_renderers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
