/* depth_monotone: plateaus and rises of codes that the test plays, and the verdicts on them. */
#define _XOPEN_SOURCE 700 /* open_memstream */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "complain.h"
#include "depth_lab.h"
#include "lab_probe.h"
#include "stderr_capture.h"

#include <stdlib.h>
#include <string.h>

/* ---- a probe whose codes are those of a script, in place of lab_probe.c ---------------------------------------------
 */

/* Runs of distances with one code. */
static const struct run {
    uint32_t code, n;
} * script;
static int refusal;
static fx_t first;

int lab_probe_open(struct lab_probe *p, const struct lab_format *format, fx_t near_z, fx_t far_z)
{
    assert_true(far_z > near_z);
    p->format = format;
    first = near_z;
    return refusal;
}

uint32_t lab_code(struct lab_probe *p, fx_t w)
{
    const struct run *run = script;
    uint32_t behind = run->n;
    (void)p;
    assert_true(w >= first);
    while ((uint32_t)(w - first) >= behind) {
        run++;
        behind += run->n;
        assert_true(run->n > 0); /* not behind the far plane */
    }
    return run->code;
}

/* ---- a run ----------------------------------------------------------------------------------------------------------
 */

static char *csv;
static struct stderr_capture said;

static int measure(const struct run *runs, uint32_t formats)
{
    uint32_t n = 0;
    script = runs;
    while (runs->n > 0) {
        n += runs++->n;
    }
    const struct depth_lab lab = {.near_z = 65536, .far_z = (fx_t)(65536 + n - 1), .formats = formats};
    free(csv);
    stderr_capture_begin(&said);
    const int status = depth_lab_capture(&lab, depth_monotone, &csv);
    stderr_capture_end(&said);
    return status;
}

#define HEAD "format,bits,near,far,distances,codes,rises,longest_m,verdict\n"

static void expect(const char *rows)
{
    char text[1024];
    snprintf(text, sizeof text, HEAD "%s", rows);
    assert_string_equal(csv, text);
}

/* The row of a format that falls, and of one that does not have to. */
static uint32_t row_of(bool is_monotone)
{
    uint32_t i = 0;
    while (lab_is_monotone(&lab_formats[i]) != is_monotone) {
        i++;
    }
    return i;
}

/* 64 distances of 2^-16 m are .0009765625 m. */
static void plateaus_codes_and_rises_are_counted(void **state)
{
    static const struct {
        struct run runs[8];
        const char *row;
    } cases[] = {
        {{{9, 64}, {7, 16}, {3, 48}, {0, 1}}, "1.00195,129,4,0,0.0009765625,pass"},
        {{{9, 16}, {7, 16}, {3, 64}}, "1.00145,96,3,0,0.0009765625,pass"},
        {{{9, 16}, {7, 64}, {3, 16}}, "1.00145,96,3,0,0.0009765625,pass"},
        {{{5, 64}}, "1.00096,64,1,0,0.0009765625,pass"},
        {{{5, 32}, {6, 64}}, "1.00145,96,2,1,0.0009765625,fail"},
        {{{5, 32}, {4, 32}, {5, 16}, {2, 4}, {8, 44}}, "1.00194,128,5,2,0.0006713867188,fail"},
        {{{UINT32_MAX, 8}, {0, 8}}, "1.00023,16,2,0,0.0001220703125,pass"},
    };
    const uint32_t row = row_of(false);
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char text[200];
        assert_int_equal(measure(cases[i].runs, 1U << row), 0);
        snprintf(text, sizeof text, "%s,%d,1,%s\n", lab_formats[row].name, lab_formats[row].bits, cases[i].row);
        expect(text);
        assert_int_equal(said.text[0], 0);
    }
}

static void one_row_for_each_format_that_is_asked_for(void **state)
{
    static const struct run falls[] = {{2, 8}, {1, 8}, {0, 0}}, rises[] = {{1, 8}, {2, 8}, {0, 0}};
    const uint32_t free_row = row_of(false), row = row_of(true);
    char text[400];
    (void)state;
    for (int i = 0; i < 2; i++) {
        const char *verdict = i == 0 ? "0,0.0001220703125,pass" : "1,0.0001220703125,fail";
        snprintf(text, sizeof text, "%s,%d,1,1.00023,16,2,%s\n%s,%d,1,1.00023,16,2,%s\n", lab_formats[row].name,
                 lab_formats[row].bits, verdict, lab_formats[free_row].name, lab_formats[free_row].bits, verdict);
        assert_int_equal(measure(i == 0 ? falls : rises, 1U << row | 1U << free_row), i == 0 ? 0 : COMPLAINED);
        expect(text);
        assert_int_equal(strstr(said.text, "a format of the renderer is not monotone") != NULL, i == 1);
    }
    assert_int_equal(measure(falls, 0), 0);
    expect("");
}

static void a_camera_that_is_refused_ends_it(void **state)
{
    static const struct run falls[] = {{2, 8}, {1, 8}, {0, 0}};
    char text[200];
    (void)state;
    refusal = PH_ERR_INVAL;
    assert_int_equal(measure(falls, 3), COMPLAINED);
    expect("");
    snprintf(text, sizeof text, "%s: the renderer refuses this camera (error %d)", lab_formats[0].name, PH_ERR_INVAL);
    assert_non_null(strstr(said.text, text));
    assert_int_equal(stderr_capture_lines(&said), 1);
    refusal = 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plateaus_codes_and_rises_are_counted),
        cmocka_unit_test(one_row_for_each_format_that_is_asked_for),
        cmocka_unit_test(a_camera_that_is_refused_ends_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
