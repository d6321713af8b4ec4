/* depth_plot: kinds and files by their names, the terminal for each, and what fails on the way. The test plays the
 * kinds and gnuplot. */
#define _XOPEN_SOURCE 700 /* fmemopen */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "complain.h"
#include "depth_gnuplot.h"
#include "depth_plot.h"
#include "files.h"
#include "stderr_capture.h"

#include <stdlib.h>
#include <string.h>

/* ---- in place of depth_plot_kinds.c and depth_gnuplot.c -------------------------------------------------------------
 */

static char script[1024]; /* that gnuplot got; "": it did not run */
static int refusal;

int depth_gnuplot_run(const char *text, char **picture, size_t *length)
{
    snprintf(script, sizeof script, "%s", text);
    *picture = refusal == 0 ? malloc(7) : NULL;
    if (*picture != NULL) {
        memcpy(*picture, "picture", 7);
    }
    *length = 7;
    return refusal;
}

static int write_curve(const struct depth_lab *lab, FILE *file)
{
    fprintf(file, "plot %s\n", lab->kind);
    return 0;
}

static int write_nothing(const struct depth_lab *lab, FILE *file)
{
    (void)lab;
    (void)file;
    return COMPLAINED;
}

static int put_row(const struct depth_lab *lab)
{
    fputs("row\n", lab->rows);
    return 0;
}

const struct depth_plot_kind depth_plot_kinds[] = {{"curve", "A curve", 640, 480, write_curve, put_row},
                                                   {"nothing", "Nothing", 1, 2, write_nothing, NULL},
                                                   {"behind", "Another", 3, 4, write_nothing, NULL}};
const uint32_t depth_plot_kind_count = 2;

static struct stderr_capture said;

static int plot(const char *kind, const char *out)
{
    const struct depth_lab lab = {.kind = kind, .out = out};
    script[0] = '\0';
    stderr_capture_begin(&said);
    const int status = depth_plot(&lab);
    stderr_capture_end(&said);
    return status;
}

static void a_name_finds_its_kind(void **state)
{
    (void)state;
    assert_ptr_equal(depth_plot_find("curve"), &depth_plot_kinds[0]);
    assert_ptr_equal(depth_plot_find("nothing"), &depth_plot_kinds[1]);
    assert_null(depth_plot_find("behind")); /* the last */
    assert_null(depth_plot_find("curv"));
    assert_null(depth_plot_find(""));
}

static void the_files_name_chooses_the_terminal(void **state)
{
    static const struct {
        const char *out, *terminal;
    } cases[] = {{"a.png", "set terminal pngcairo size 640,480 "}, {"a.svg", "set terminal svg size 640,480 "}};
    (void)state;
    for (int i = 0; i < 2; i++) {
        size_t n;
        assert_int_equal(plot("curve", file_path(cases[i].out)), 0);
        assert_ptr_equal(strstr(script, cases[i].terminal), script);
        assert_non_null(strstr(script, "\nset encoding utf8\n"));
        assert_string_equal(script + strlen(script) - 12, "\nplot curve\n");
        uint8_t *bytes = file_read(cases[i].out, &n);
        assert_int_equal(n, 7);
        assert_memory_equal(bytes, "picture", 7);
        free(bytes);
        assert_int_equal(said.text[0], 0);
    }
}

static void what_is_wrong_is_told_before_gnuplot_runs(void **state)
{
    static const struct {
        const char *kind, *out;
        int status;
        const char *line;
    } cases[] = {{"curves", "a.png", PH_ERR_INVAL, "plot 'curves': no such kind; there are curve nothing"},
                 {"curve", NULL, PH_ERR_INVAL, "plot needs --out FILE.svg or FILE.png"},
                 {"curve", "a.gif", PH_ERR_INVAL, "--out a.gif: plots are written as .svg or .png"},
                 {"curve", "png", PH_ERR_INVAL, "--out png: plots are"},
                 {"nothing", "a.png", COMPLAINED, ""}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        assert_int_equal(plot(cases[i].kind, cases[i].out), cases[i].status);
        assert_non_null(strstr(said.text, cases[i].line));
        assert_int_equal(script[0], 0);
    }
}

static void nothing_is_saved_without_a_picture(void **state)
{
    FILE *file;
    (void)state;
    refusal = COMPLAINED;
    assert_int_equal(plot("curve", file_path("none.png")), COMPLAINED);
    file = fopen(file_path("none.png"), "r");
    assert_null(file);
    refusal = 0;
    assert_int_equal(plot("curve", file_path("no/folder.png")), COMPLAINED);
    assert_non_null(strstr(said.text, "no/folder.png"));
}

static int rows_of(const char *kind, const char *csv, const char *json, const char *out, char text[16])
{
    memset(text, 0, 16);
    FILE *const file = fmemopen(text, 16, "w");
    assert_non_null(file);
    const struct depth_lab lab = {.kind = kind, .csv = csv, .json = json, .out = out, .rows = file};
    script[0] = '\0';
    stderr_capture_begin(&said);
    const int status = depth_plot(&lab);
    stderr_capture_end(&said);
    fclose(file);
    return status;
}

static void rows_need_no_picture_and_take_one(void **state)
{
    char text[16];
    (void)state;
    assert_int_equal(rows_of("curve", "-", NULL, NULL, text), 0);
    assert_string_equal(text, "row\n");
    assert_string_equal(script, "");
    assert_int_equal(rows_of("curve", NULL, "-", file_path("rows.svg"), text), 0);
    assert_string_equal(text, "row\n");
    assert_true(script[0] != '\0');
    assert_int_equal(rows_of("nothing", "-", NULL, file_path("rows.svg"), text), PH_ERR_INVAL);
    assert_non_null(strstr(said.text, "plot nothing has no --csv"));
    assert_string_equal(script, "");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_name_finds_its_kind),
        cmocka_unit_test(the_files_name_chooses_the_terminal),
        cmocka_unit_test(what_is_wrong_is_told_before_gnuplot_runs),
        cmocka_unit_test(rows_need_no_picture_and_take_one),
        cmocka_unit_test(nothing_is_saved_without_a_picture),
    };
    return cmocka_run_group_tests(tests, files_begin, files_end);
}
