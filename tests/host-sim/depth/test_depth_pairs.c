/* depth_pairs: what the lab is asked for and the rows that come of it. The test plays the lab and the float32 formats.
 */
#define _XOPEN_SOURCE 700 /* open_memstream */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "complain.h"
#include "depth_ieee.h"
#include "depth_separation.h"
#include "stderr_capture.h"

#include <stdlib.h>
#include <string.h>

/* ---- in place of lab.c and depth_ieee.c -----------------------------------------------------------------------------
 */

static struct depth_lab lab;
static uint32_t fails_at; /* formats, as bits */
static int ieee_refusal;

size_t lab_bytes(const struct lab *asked)
{
    assert_int_equal(asked->count, lab.count);
    return 4711;
}

static int answer(const struct lab *asked, const char *what)
{
    char text[80];
    assert_true(asked->near_z == lab.near_z && asked->far_z == lab.far_z && asked->spacing == lab.spacing);
    assert_true(asked->at_count == lab.at_count && (asked->at != NULL) == (lab.at_count > 0));
    assert_true(asked->at == NULL || memcmp(asked->at, lab.at, sizeof *lab.at * lab.at_count) == 0);
    assert_true(asked->memory != NULL && asked->memory_bytes == 4711);
    memset(asked->memory, 0, asked->memory_bytes);
    asked->put(asked->context, "head\n");
    if (asked->formats != 0) {
        snprintf(text, sizeof text, "%s %x", what, (unsigned)asked->formats);
        asked->put(asked->context, text);
        asked->put(asked->context, "\n");
    }
    return (asked->formats & fails_at) != 0 ? PH_ERR_INVAL : 0;
}

int lab_pairs(const struct lab *asked)
{
    return answer(asked, "pairs");
}

int lab_resolve(const struct lab *asked)
{
    return answer(asked, "resolve");
}

const char *depth_ieee_name(uint32_t format)
{
    static const char names[] = "a\0b\0c\0d\0e\0f\0g\0h\0i\0j\0k\0l";
    assert_true(format < DEPTH_IEEE_FORMATS);
    return names + 2 * format;
}

int depth_ieee_pairs(uint32_t format, double near_z, double far_z, uint8_t spacing, uint32_t count,
                     struct depth_ieee_count *out)
{
    assert_true(near_z == .1 && far_z == 1000); /* as they are printed, not as Q16.16 has them */
    assert_true(spacing == lab.spacing && count == lab.count);
    *out = (struct depth_ieee_count){10 + format, 100 + format, .25};
    return ieee_refusal;
}

double depth_way_px(const struct depth_lab *of)
{
    return of->width;
}

double depth_separation_m(const struct ph_depth_format *format, const struct depth_lab *of, double z, double tilt_deg,
                          double way_px)
{
    assert_true(format != NULL && of->near_z == lab.near_z && z == 1000 && way_px == lab.width);
    return tilt_deg == 0 ? .25 : tilt_deg == 90 ? .75 : 0;
}

void depth_separation_text(double metres, char to[LAB_TEXT_SIZE])
{
    snprintf(to, LAB_TEXT_SIZE, metres == .25 ? ".25" : ".75");
}

static char *csv;
static struct stderr_capture said;

static int run(int (*command)(const struct depth_lab *))
{
    free(csv);
    stderr_capture_begin(&said);
    const int status = depth_lab_capture(&lab, command, &csv);
    stderr_capture_end(&said);
    return status;
}

static int fresh(void **state)
{
    (void)state;
    lab = (struct depth_lab){.near_z = 6554,
                             .far_z = FX_INT(1000),
                             .count = 77,
                             .spacing = LAB_LOG_SPACED,
                             .formats = 1 | 4,
                             .at = {7, 8},
                             .fov_deg = FX_INT(60),
                             .width = 9,
                             .height = 7};
    fails_at = 0;
    ieee_refusal = 0;
    return 0;
}

static void each_format_that_is_asked_for_is_measured_alone(void **state)
{
    (void)state;
    assert_int_equal(run(depth_pairs), 0);
    assert_string_equal(csv, "head\npairs 1\npairs 4\n");
    lab.at_count = 2;
    lab.formats = 1U << (lab_format_count - 1);
    char text[120];
    snprintf(text, sizeof text, "head\nresolve %x\n# float24-e6 (24 bits): enough at every distance are .25 m for",
             (unsigned)lab.formats);
    assert_int_equal(run(depth_resolve), 0);
    assert_memory_equal(csv, text, strlen(text));
    assert_non_null(strstr(csv, " face the camera, .75 m at any tilt (bounds; --fov 60, --size 9x7).\n"));
    lab.formats = 0;
    assert_int_equal(run(depth_pairs), 0);
    assert_string_equal(csv, "head\n");
}

static void float32_formats_follow(void **state)
{
    (void)state;
    lab.formats = 2;
    lab.host_formats = 1 | 1U << 5 | 1U << 6 | 1U << 11;
    assert_int_equal(run(depth_pairs), 0);
    assert_string_equal(csv, "head\npairs 2\n"
                             "a,32,0.1,1000,log,77,10,100,0.25\nf,32,0.1,1000,log,77,15,105,0.25\n"
                             "g,24,0.1,1000,log,77,16,106,0.25\nl,24,0.1,1000,log,77,21,111,0.25\n");
    assert_int_equal(run(depth_resolve), 0);
    assert_memory_equal(csv, "head\nresolve 2\n#", 16);
    lab.spacing = LAB_LINEAR_SPACED, lab.host_formats = 2;
    assert_int_equal(run(depth_pairs), 0);
    assert_string_equal(csv, "head\npairs 2\nb,32,0.1,1000,linear,77,11,101,0.25\n");
}

static void an_error_ends_it_with_one_line(void **state)
{
    char text[120];
    (void)state;
    fails_at = 1;
    lab.host_formats = 1;
    assert_int_equal(run(depth_pairs), COMPLAINED);
    assert_string_equal(csv, "head\npairs 1\n");
    snprintf(text, sizeof text, "%s: the renderer refuses this camera (error %d)", lab_formats[0].name, PH_ERR_INVAL);
    assert_non_null(strstr(said.text, text));
    assert_int_equal(stderr_capture_lines(&said), 1);
    fresh(NULL);
    lab.host_formats = 3, ieee_refusal = PH_ERR_NOMEM;
    assert_int_equal(run(depth_pairs), COMPLAINED);
    assert_string_equal(csv, "head\npairs 1\npairs 4\n");
    assert_non_null(strstr(said.text, "out of memory; make --count smaller"));
    assert_int_equal(stderr_capture_lines(&said), 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(each_format_that_is_asked_for_is_measured_alone, fresh),
        cmocka_unit_test_setup(float32_formats_follow, fresh),
        cmocka_unit_test_setup(an_error_ends_it_with_one_line, fresh),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
