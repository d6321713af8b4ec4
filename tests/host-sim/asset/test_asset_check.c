/* asset_check: bounds that hold and bounds that lie, in C scenes of the form that asset_write.c has. */
#include "asset_check.h"
#include "complain.h"
#include "files.h"
#include "model.h"
#include "stderr_capture.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

static struct stderr_capture said;
static int open_status;
static unsigned is_open, opens;

/* In place of model_open.c. */
int model_open(struct model **model, const char *path, const struct model_options *options)
{
    static uint8_t any;
    assert_true(path != NULL && !options->allow_outside);
    *model = (struct model *)(void *)&any;
    opens++;
    is_open += open_status == 0;
    return open_status;
}

void model_close(struct model *model)
{
    assert_non_null(model);
    is_open--;
}

static int check(const char *text)
{
    const char *const path = file_text("scene.c", text);
    stderr_capture_begin(&said);
    const int status = asset_check(path);
    stderr_capture_end(&said);
    return status;
}

#define POSITIONS(n, text) "static const struct fx_vec3 positions_" #n "[] = {\n" text "\n};\n"
#define BOUNDS(n, centre, radius)                                                                                      \
    "static const struct ph_sphere bounds_" #n " = {.centre = " centre ", .radius = " #radius "};\n"

static void holds(const char *text)
{
    if (check(text) != 0) {
        fail_msg("%s: %s", text, said.text);
    }
}

static void lies(const char *text, const char *line)
{
    assert_int_equal(check(text), COMPLAINED);
    if (strstr(said.text, line) == NULL) {
        fail_msg("'%s' is not in '%s'", line, said.text);
    }
}

/* 2, 3 and 6 are 7 long. */
static void vertex_may_lie_on_the_sphere_and_not_outside(void **state)
{
    (void)state;
    holds(POSITIONS(0, "    {12, 23, 36},") BOUNDS(0, "{10, 20, 30}", 7));
    holds(POSITIONS(0, "    {8, 17, 24},") BOUNDS(0, "{10, 20, 30}", 7));
    lies(POSITIONS(0, "    {13, 23, 36},") BOUNDS(0, "{10, 20, 30}", 7),
         "vertex 0 of mesh 0 lies outside of its bounds");
    lies(POSITIONS(0, "    {12, 24, 36},") BOUNDS(0, "{10, 20, 30}", 7), "vertex 0 of mesh 0");
    lies(POSITIONS(0, "    {12, 23, 37},") BOUNDS(0, "{10, 20, 30}", 7), "vertex 0 of mesh 0");
    lies(POSITIONS(0, "    {2, 20, 30},") BOUNDS(0, "{10, 20, 30}", 7), "vertex 0 of mesh 0");
    lies(POSITIONS(0, "    {10, 12, 30},") BOUNDS(0, "{10, 20, 30}", 7), "vertex 0 of mesh 0");
    lies(POSITIONS(0, "    {10, 20, 22},") BOUNDS(0, "{10, 20, 30}", 7), "vertex 0 of mesh 0");
}

static void each_vertex_of_each_line_is_looked_at(void **state)
{
    (void)state;
    holds(POSITIONS(0, "    {1, 0, 0}, {0, 1, 0},\n    {0, 0, 1},") BOUNDS(0, "{0, 0, 0}", 1));
    lies(POSITIONS(0, "    {1, 0, 0}, {0, 2, 0},\n    {0, 0, 1},") BOUNDS(0, "{0, 0, 0}", 1), "vertex 1 of mesh 0");
    lies(POSITIONS(0, "    {1, 0, 0}, {0, 1, 0},\n    {0, 0, 2},") BOUNDS(0, "{0, 0, 0}", 1), "vertex 2 of mesh 0");
    char many[4096] = "static const struct fx_vec3 positions_0[] = {\n";
    for (int i = 0; i < 200; i++) {
        strcat(many, i == 199 ? "{9, 0, 0},\n" : "{0, 0, 1},\n");
    }
    strcat(many, "};\n" BOUNDS(0, "{0, 0, 0}", 1));
    lies(many, "vertex 199 of mesh 0");
}

static void each_mesh_has_its_own_positions(void **state)
{
    (void)state;
    holds(POSITIONS(0, "{9, 0, 0},") BOUNDS(0, "{9, 0, 0}", 1) POSITIONS(12, "{0, 0, 0},") BOUNDS(12, "{0, 0, 1}", 1));
    lies(POSITIONS(0, "{9, 0, 0},") BOUNDS(0, "{9, 0, 0}", 1) POSITIONS(12, "{0, 0, 0},") BOUNDS(12, "{0, 0, 2}", 1),
         "vertex 0 of mesh 12");
    holds(POSITIONS(0, "{9, 0, 0},") "static const int16_t normals_0[][3] = {\n{77, 0, 0},\n};\n" BOUNDS(0, "{9, 0, 0}",
                                                                                                         1));
}

static void ends_of_q16_are_read_and_do_not_overflow(void **state)
{
    (void)state;
    holds(POSITIONS(0, "{INT32_MIN, 0, 2147483647},") BOUNDS(0, "{-2147483648, 0, 2147483646}", 1));
    lies(POSITIONS(0, "{INT32_MIN, -5, 2147483647},") BOUNDS(0, "{2147483647, 0, 0}", 2147483647),
         "vertex 0 of mesh 0");
    lies(POSITIONS(0, "{INT32_MIN, -5, -2147483648},") BOUNDS(0, "{0, 0, 0}", 2147483647), "vertex 0 of mesh 0");
    lies(POSITIONS(0, "{92682, 0, 2147483647},") BOUNDS(0, "{0, 0, INT32_MIN}", 2147483647), /* 2^64 + 18532 */
         "vertex 0 of mesh 0");
    holds(POSITIONS(0, "{INT32_MIN, 5, 5},") BOUNDS(0, "{0, 0, 0}", 0)); /* without bounds it is never culled */
}

static void a_file_of_another_form_is_told(void **state)
{
    (void)state;
    lies(POSITIONS(0, "{0, 0, 0},"), "has no bounds: pinhole-asset has not written it");
    lies("", "has no bounds");
    lies(POSITIONS(0, "{0, 0, 0},") "static const struct ph_sphere bounds_3 = {.radius = 5};\n",
         "the bounds of mesh 3 are none that pinhole-asset has written");
    lies(POSITIONS(0, "{0, 0, 0},") "static const struct ph_sphere bounds_3 = {.centre = {0, 0, 0}};\n",
         "bounds of mesh 3");
    lies(POSITIONS(0, "{0, 0, 0},") BOUNDS(3, "{0, 0, x}", 5), "bounds of mesh 3");
    stderr_capture_begin(&said);
    assert_int_equal(asset_check(file_path("none.c")), COMPLAINED);
    stderr_capture_end(&said);
    assert_non_null(strstr(said.text, "none.c: No such file"));
    assert_int_equal(opens, 0);
}

static void a_binary_scene_is_opened(void **state)
{
    (void)state;
    assert_int_equal(asset_check("scene.phs"), 0);
    assert_true(opens == 1 && is_open == 0);
    open_status = COMPLAINED;
    assert_int_equal(asset_check("scene.phs"), COMPLAINED);
    assert_true(opens == 2 && is_open == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(vertex_may_lie_on_the_sphere_and_not_outside),
        cmocka_unit_test(each_vertex_of_each_line_is_looked_at),
        cmocka_unit_test(each_mesh_has_its_own_positions),
        cmocka_unit_test(ends_of_q16_are_read_and_do_not_overflow),
        cmocka_unit_test(a_file_of_another_form_is_told),
        cmocka_unit_test(a_binary_scene_is_opened),
    };
    return cmocka_run_group_tests(tests, files_begin, files_end);
}
