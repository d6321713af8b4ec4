/* asset_options: command lines of pinhole-asset, right ones by what they set and wrong ones by what is said. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "asset_options.h"
#include "stderr_capture.h"
#include "words.h"

#include <string.h>

static struct asset_options o;
static struct stderr_capture said;

static int read_line(const char *line)
{
    char *words[WORDS_MAX];
    const int count = words_of(line, words);
    stderr_capture_begin(&said);
    const int status = asset_options_read(&o, count, words);
    stderr_capture_end(&said);
    return status;
}

static void take(const char *line)
{
    const int status = read_line(line);
    assert_string_equal(said.text, "");
    assert_int_equal(status, 0);
}

static void all_of_a_model_is_kept_where_nothing_is_said(void **state)
{
    (void)state;
    take("m.obj --report");
    assert_string_equal(o.goal.model, "m.obj");
    assert_null(o.goal.board);
    assert_int_equal(o.goal.triangles, UINT32_MAX);
    assert_int_equal(o.goal.flash_bytes, UINT32_MAX);
    assert_int_equal(o.goal.texture_log2, 8);
    assert_true(o.report && !o.help && !o.goal.fit && !o.goal.turntable);
    assert_true(o.out == NULL && o.clip == NULL);
}

static void options_are_taken_before_and_behind_the_model(void **state)
{
    (void)state;
    take("--clip walk -o a.phs --board pico-display m.glb --max-triangles fit --flash 1073741824 --turntable --up y "
         "--allow-outside");
    assert_string_equal(o.goal.model, "m.glb");
    assert_string_equal(o.out, "a.phs");
    assert_string_equal(o.clip, "walk");
    assert_ptr_equal(o.goal.board, board_find("pico-display"));
    assert_true(o.goal.fit && o.goal.turntable && o.model_options.allow_outside);
    assert_int_equal(o.goal.flash_bytes, 1073741824);
    assert_string_equal(o.model_options.up, "y");
    take("m.obj --out b.c --max-triangles 1234 --report --flash 1");
    assert_string_equal(o.out, "b.c");
    assert_int_equal(o.goal.triangles, 1234);
    assert_true(o.report && o.goal.flash_bytes == 1);
    take("m.obj -o -");
    assert_string_equal(o.out, "-");
    take("--help");
    assert_true(o.help);
    take("-h");
    assert_true(o.help);
}

static void sides_of_textures_are_powers_of_two(void **state)
{
    (void)state;
    for (uint32_t log2 = 0; log2 <= 10; log2++) {
        char line[60];
        snprintf(line, sizeof line, "m.obj --report --texture-size %u", 1u << log2);
        take(line);
        assert_int_equal(o.goal.texture_log2, log2);
    }
}

static void what_is_wrong_is_said(void **state)
{
    static const struct {
        const char *line, *part;
    } wrong[] = {
        {"", "no model named (see --help)\n"},
        {"--report", "no model named (see --help)\n"},
        {"m.obj", "nothing to do: give -o FILE.c, --report or --check-bounds (see --help)\n"},
        {"m.obj n.obj --report", "'n.obj': one model at a time, and m.obj is named already\n"},
        {"m.obj -o", "-o needs a value: FILE.c or FILE.phs\n"},
        {"m.obj -o a.h", "-o 'a.h': must be a file that ends in .c or .phs (a binary scene), or -\n"},
        {"m.obj -o .c", "-o '.c': must be a file that ends in .c or .phs (a binary scene), or -\n"},
        {"m.obj --out a.cc", "--out 'a.cc': must be a file that ends in .c or .phs (a binary scene), or -\n"},
        {"m.obj -o - --report", "--report and -o - both want stdout; give -o a file\n"},
        {"m.obj --report --max-triangles fit", "--max-triangles fit: fit what? name a --board\n"},
        {"m.obj --max-triangles 0", "--max-triangles '0': must be a whole number, 1 .. 4000000, all or fit"},
        {"m.obj --texture-size 0", "--texture-size '0': must be a power of two, 1 .. 1024"},
        {"m.obj --texture-size 96", "--texture-size '96': must be a power of two, 1 .. 1024"},
        {"m.obj --texture-size 2048", "--texture-size '2048': must be a power of two, 1 .. 1024"},
        {"m.obj --board pico", "--board 'pico': must be a name that pinhole-sim --list shows"},
        {"m.obj --flash 0", "--flash '0': must be a whole number, 1 .. 1073741824"},
        {"m.obj --flash 1073741825", "--flash '1073741825': must be a whole number, 1 .. 1073741824"},
        {"m.obj --clip=", "--clip"},
        {"m.obj --flush 3", "--flush"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        assert_int_equal(read_line(wrong[i].line), PH_ERR_INVAL);
        if (strstr(said.text, wrong[i].part) == NULL) {
            fail_msg("%s: %s", wrong[i].line, said.text);
        }
        assert_int_equal(stderr_capture_lines(&said), 1);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_of_a_model_is_kept_where_nothing_is_said),
        cmocka_unit_test(options_are_taken_before_and_behind_the_model),
        cmocka_unit_test(sides_of_textures_are_powers_of_two),
        cmocka_unit_test(what_is_wrong_is_said),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
