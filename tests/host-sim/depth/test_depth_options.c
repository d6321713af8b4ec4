/* depth_options: command lines of pinhole-depth, right ones by what they set and wrong ones by what is said. The
 * commands are made up, but for the two that the module knows. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "depth_ieee.h"
#include "depth_options.h"
#include "stderr_capture.h"
#include "words.h"

#include <string.h>

/* In place of the commands' own sources. */
int depth_plot(const struct depth_lab *lab)
{
    (void)lab;
    return 0;
}

int depth_pairs(const struct depth_lab *lab)
{
    (void)lab;
    return 1;
}

int depth_compare(const struct depth_lab *lab)
{
    (void)lab;
    return 2;
}

static int other(const struct depth_lab *lab)
{
    (void)lab;
    return 3;
}

#define ALL_OPTIONS                                                                                                    \
    " near far depth fov size csv json count spacing at separation tilt azimuth shading separate bits demo view "      \
    "model "                                                                                                           \
    "allow-outside camera start frames out "

static const struct depth_command commands[] = {
    {.name = "pairs", .options = " depth near far ", .run = depth_pairs},
    {.name = "every", .options = ALL_OPTIONS, .run = other},
    {.name = "compare", .options = " kind near ", .run = depth_compare},
    {.name = "drawn", .options = " near far ", .run = depth_plot},
    {.name = "plot", .options = " kind separate outside ", .run = other},
};

static struct depth_lab lab;
static const struct depth_command *command;
static struct stderr_capture said;

static int read_line(const char *line)
{
    char *words[WORDS_MAX];
    const int count = words_of(line, words);
    stderr_capture_begin(&said);
    const int status = depth_options_read(&lab, &command, commands, 5, count, words);
    stderr_capture_end(&said);
    return status;
}

static void take(const char *line)
{
    const int status = read_line(line);
    assert_string_equal(said.text, "");
    assert_int_equal(status, 0);
}

static bool has_format(const char *name)
{
    bool found = false;
    for (uint32_t i = 0; i < lab_format_count; i++) {
        found |= strcmp(lab_formats[i].name, name) == 0 && (lab.formats >> i & 1) != 0;
    }
    return found;
}

static void what_is_not_given_has_its_default(void **state)
{
    (void)state;
    take("every");
    assert_ptr_equal(command, &commands[1]);
    assert_true(lab.near_z == FX_HALF && lab.far_z == FX_INT(100) && lab.fov_deg == FX_INT(60));
    assert_true(lab.width == 240 && lab.height == 240 && lab.count == 10000 && lab.frames == 1 && lab.start == 0);
    assert_true(!lab.near_set && !lab.far_set && !lab.fov_set && !lab.tilt_set && !lab.format_set && lab.at_count == 0);
    assert_true(has_format("fixed16") && has_format("float24") && has_format("log") && !has_format("float16-e5"));
    assert_int_equal(lab.host_formats, (1u << DEPTH_IEEE_FORMATS) - 1);
}

static void each_option_sets_its_own(void **state)
{
    (void)state;
    take("every --near 0.25 --far 8 --fov 170 --size 3x5 --csv a --json b --count 7 --spacing log --at 0.25,1,8 "
         "--separation 0.5 --azimuth -360 --shading flat --bits 24 --out c");
    assert_true(lab.near_z == FX_ONE / 4 && lab.near_set && lab.far_z == FX_INT(8) && lab.far_set);
    assert_true(lab.fov_deg == FX_INT(170) && lab.fov_set && lab.width == 3 && lab.height == 5 && lab.count == 7);
    assert_true(lab.spacing == LAB_LOG_SPACED && lab.at_count == 3 && lab.at[0] == FX_ONE / 4 &&
                lab.at[2] == FX_INT(8));
    assert_true(lab.separation == FX_HALF && lab.azimuth_deg == FX_INT(-360) && lab.bits == 24);
    assert_string_equal(depth_shading_names[lab.shading], "flat");
    assert_string_equal(lab.csv, "a");
    assert_string_equal(lab.json, "b");
    assert_string_equal(lab.out, "c");
    take("drawn --near 0.25,1 --far 8");
    assert_true(lab.near_count == 2 && lab.near_z == FX_ONE / 4 && lab.nears[0] == FX_ONE / 4 &&
                lab.nears[1] == FX_ONE);
    take("every --separate 0.125 --tilt -89 --spacing linear --bits 16 --fov 1");
    assert_true(lab.separate == FX_ONE / 8 && lab.tilt_set && lab.tilt_deg == FX_INT(-89) && lab.bits == 16);
    assert_int_equal(lab.spacing, LAB_LINEAR_SPACED);
    take("every --demo a --view b --start 4 --frames 5 --camera eye=0,0,5");
    assert_string_equal(lab.demo, "a");
    assert_string_equal(lab.view, "b");
    assert_true(lab.start == 4 && lab.frames == 5 && lab.camera.set);
    take("every --model a --allow-outside");
    assert_string_equal(lab.model, "a");
    assert_true(lab.allow_outside);
}

static void formats_are_rows_of_their_names(void **state)
{
    (void)state;
    take("every --depth float16-e5,fixed16");
    assert_true(lab.format_set && has_format("float16-e5") && has_format("fixed16") && !has_format("fixed24"));
    assert_int_equal(lab.host_formats, 0);
    take("every --depth log"); /* two rows, of 16 and 24 bits */
    assert_int_equal(__builtin_popcount(lab.formats), 2);
    char line[64] = "pairs --depth ";
    strcat(line, depth_ieee_name(1));
    take(line);
    assert_true(lab.formats == 0 && lab.host_formats == 2);
    take("every --depth all");
    assert_true(has_format("linear-w") && !has_format("float24-e6"));
}

static void the_kind_is_the_word_behind_the_command(void **state)
{
    (void)state;
    take("plot -");
    assert_string_equal(lab.kind, "-");
    take("compare file --near 1");
    assert_string_equal(lab.kind, "file");
    assert_int_equal(lab.near_z, FX_ONE);
    take("--help");
    assert_null(command);
    take("plot nothing --of this -h");
    assert_null(command);
}

static const struct {
    const char *line, *said;
} wrong_lines[] = {
    {"", "which command?"},
    {"other", "other: no such command"},
    {"plot", "plot needs a KIND"},
    {"compare --near 1", "compare needs a FILE"},
    {"pairs --fov 60", "--fov: pairs does not take it"},
    {"plot x --separation 1", "--separation: plot does not take it"}, /* though it takes --separate */
    {"plot x --out a", "--out: plot does not take it"},
    {"every --near 1 --far 1", "--near must be less than --far"},
    {"drawn --near 1,9 --far 9", "--near must be less than --far"},
    {"every --near 1,2", "--near: every takes one near plane"},
    {"drawn --near 1,2,3,4,5", "--near"},
    {"drawn --near 1,0", "--near"},
    {"drawn --near 1,", "--near"},
    {"every --near 1 --at 0.99", "--at 0.99"},
    {"every --at 1,100.01", "must lie from --near to --far"},
    {"every --demo a --model b", "--demo and --model exclude each other"},
    {"every --view a", "belong to a scene"},
    {"every --camera eye=0,0,5", "belong to a scene"},
    {"every --start 1", "belong to a scene"},
    {"every --frames 2", "belong to a scene"},
    {"every --demo a --allow-outside", "--allow-outside: of which model?"},
    {"every --demo a --at 1", "belong to planes"},
    {"every --demo a --separate 1", "belong to planes"},
    {"every --model a --tilt 0", "belong to planes"},
    {"every --fov 1 --size 1x1024", "no camera can have both"},
    {"every --near 0", "--near"},
    {"every --far -1", "--far"},
    {"every --near 1x", "--near"},
    {"every --depth fixed", "--depth"},
    {"every --depth fixed16,", "--depth"},
    {"every --depth ,fixed16", "--depth"},
    {"every --fov 0.99", "--fov"},
    {"every --fov 170.01", "--fov"},
    {"every --size 1025x1", "--size"},
    {"every --spacing square", "--spacing"},
    {"every --at 1,,2", "--at"},
    {"every --at 1,", "--at"},
    {"every --at 0", "at most 512 numbers"},
    {"every --at 1;2", "--at"},
    {"every --separation 0", "--separation"},
    {"every --separate -1", "--separate"},
    {"every --tilt 89.01", "--tilt"},
    {"every --tilt -89.01", "--tilt"},
    {"every --azimuth 360.01", "--azimuth"},
    {"every --shading round", "--shading"},
    {"every --bits 20", "--bits"},
    {"every --count 0", "--count"},
};

static void wrong_lines_are_told(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof wrong_lines / sizeof wrong_lines[0]; i++) {
        if (read_line(wrong_lines[i].line) != PH_ERR_INVAL || strstr(said.text, wrong_lines[i].said) == NULL) {
            fail_msg("%s: %s", wrong_lines[i].line, said.text);
        }
        assert_int_equal(stderr_capture_lines(&said), 1);
    }
}

static void float32_is_for_pairs(void **state)
{
    char line[64] = "every --depth ";
    (void)state;
    strcat(line, depth_ieee_name(0));
    assert_int_equal(read_line(line), PH_ERR_INVAL);
    assert_non_null(strstr(said.text, "--depth: every measures no float32 format; pairs does"));
}

/* 512 distances are taken and 513 are not. */
static void there_are_at_most_512_distances(void **state)
{
    char text[4096] = "1";
    char *words[4] = {(char[]){"pinhole-depth"}, (char[]){"every"}, (char[]){"--at"}, text};
    (void)state;
    for (int n = 1; n <= 512; n++) {
        stderr_capture_begin(&said);
        const int status = depth_options_read(&lab, &command, commands, 5, 4, words);
        stderr_capture_end(&said);
        assert_int_equal(status, 0);
        assert_int_equal(lab.at_count, n);
        strcat(text, ",2");
    }
    stderr_capture_begin(&said);
    const int status = depth_options_read(&lab, &command, commands, 5, 4, words);
    stderr_capture_end(&said);
    assert_int_equal(status, PH_ERR_INVAL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_not_given_has_its_default),
        cmocka_unit_test(each_option_sets_its_own),
        cmocka_unit_test(formats_are_rows_of_their_names),
        cmocka_unit_test(the_kind_is_the_word_behind_the_command),
        cmocka_unit_test(wrong_lines_are_told),
        cmocka_unit_test(float32_is_for_pairs),
        cmocka_unit_test(there_are_at_most_512_distances),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
