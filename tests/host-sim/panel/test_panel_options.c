/* panel_options: command lines of pinhole-panel, right ones by what they set and wrong ones by what is said. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "panel_options.h"
#include "stderr_capture.h"
#include "words.h"

#include <string.h>

static struct panel_options o;
static struct stderr_capture said;

static int read_line(const char *line)
{
    char *words[WORDS_MAX];
    const int count = words_of(line, words);
    stderr_capture_begin(&said);
    const int status = panel_options_read(&o, count, words);
    stderr_capture_end(&said);
    return status;
}

static void take(const char *line)
{
    const int status = read_line(line);
    assert_string_equal(said.text, "");
    assert_int_equal(status, 0);
}

static void the_first_word_is_a_command(void **state)
{
    static const struct {
        const char *line;
        enum panel_command command;
    } commands[] = {{"--board a", PANEL_RUN},
                    {"run --board a", PANEL_RUN},
                    {"list", PANEL_LIST},
                    {"doctor", PANEL_DOCTOR},
                    {"probe --board a", PANEL_PROBE},
                    {"testcard --board a", PANEL_TESTCARD},
                    {"speedtest --panel a", PANEL_SPEEDTEST},
                    {"report --board a", PANEL_REPORT},
                    {"identify --board a", PANEL_IDENTIFY},
                    {"--list", PANEL_LIST},
                    {"--help", PANEL_HELP},
                    {"-h", PANEL_HELP},
                    {"--demo a --model b --help", PANEL_HELP}};
    (void)state;
    for (size_t i = 0; i < sizeof commands / sizeof commands[0]; i++) {
        take(commands[i].line);
        assert_int_equal(o.command, commands[i].command);
    }
}

static void what_is_not_given_is_the_boards(void **state)
{
    (void)state;
    take("--board a");
    static const struct panel_wiring none = {.board = NULL};
    struct panel_wiring first = o.kits[0];
    assert_string_equal(first.board, "a");
    first.board = NULL;
    assert_memory_equal(&first, &none, sizeof none);
    assert_int_equal(o.kit_count, 1);
    assert_int_equal(o.depth.format, PH_DEPTH_AUTO);
    assert_true(o.demo == NULL && o.view == NULL && o.model == NULL && o.start == 0 && o.frames == 0 && o.fps == 0);
    assert_false(o.band != 0 || o.diff || o.refresh != 0 || o.stats || o.overlay);
}

static void a_display_is_described_by_its_wires(void **state)
{
    (void)state;
    take("--panel p --spi /dev/s --dc d --reset r --backlight - --te t --mode 3 --speed 200000000 --rotate 270");
    const struct panel_wiring *const w = &o.kits[0];
    assert_null(w->board);
    assert_string_equal(w->panel, "p");
    assert_string_equal(w->spi, "/dev/s");
    assert_string_equal(w->lines[PANEL_DC], "d");
    assert_string_equal(w->lines[PANEL_RESET], "r");
    assert_string_equal(w->lines[PANEL_BACKLIGHT], "-");
    assert_string_equal(w->lines[PANEL_TE], "t");
    assert_true(w->mode_set && w->mode == 3 && w->rotate_set && w->rotate == 3);
    assert_int_equal(w->speed_hz, 200000000);
    assert_false(w->usb || w->drm);
    take("--panel p --mode 0 --rotate 0 --speed 1");
    assert_true(w->mode_set && w->mode == 0 && w->rotate_set && w->rotate == 0 && w->speed_hz == 1);
    take("--usb");
    assert_true(w->usb && w->serial == NULL && o.kit_count == 1);
    take("--usb=123");
    assert_string_equal(w->serial, "123");
    take("--drm");
    assert_true(w->drm && w->card == NULL);
    take("--drm=card1:HDMI-A-1 --rotate 90");
    assert_string_equal(w->card, "card1:HDMI-A-1");
}

static void each_further_board_is_another_display(void **state)
{
    (void)state;
    take("--speed 5 --board a --speed 7 --board b --mode 3 --board c --board d --dc x");
    assert_int_equal(o.kit_count, 4);
    assert_string_equal(o.kits[0].board, "a"); /* what was said before it is for it, too */
    assert_string_equal(o.kits[1].board, "b");
    assert_string_equal(o.kits[3].board, "d");
    assert_int_equal(o.kits[0].speed_hz, 7);
    assert_int_equal(o.kits[1].speed_hz, 0);
    assert_true(!o.kits[0].mode_set && o.kits[1].mode_set);
    assert_string_equal(o.kits[3].lines[PANEL_DC], "x");
    take("doctor --board a --board b");
    assert_int_equal(o.kit_count, 2);
}

static void a_scene_is_described(void **state)
{
    (void)state;
    take("--board a --demo d --view v --frames 1000000000 --start 0 --fps 1000 --band 1024 --depth fixed16 --overlay "
         "--stats --diff on --refresh 1");
    assert_string_equal(o.demo, "d");
    assert_string_equal(o.view, "v");
    assert_int_equal(o.frames, 1000000000);
    assert_int_equal(o.fps, 1000);
    assert_int_equal(o.band, 1024);
    assert_int_equal(o.depth.format, PH_DEPTH_FIXED16);
    assert_true(o.overlay && o.stats && o.diff && o.refresh == 1);
    take("--board a --model m --start 1000000000 --fps 1 --band 1 --format float16 --diff off --two-sided --up z");
    assert_string_equal(o.model, "m");
    assert_int_equal(o.start, 1000000000);
    assert_int_equal(o.depth.format, PH_DEPTH_FLOAT16);
    assert_false(o.diff || o.stats || o.overlay);
    assert_true(o.model_options.two_sided);
    assert_string_equal(o.model_options.up, "z");
    take("--drm --demo d");
    take("testcard --drm");
    take("report --drm");
}

static const struct {
    const char *line, *part;
} wrong[] = {
    {"fly", "'fly': no such command; run, list, doctor, probe, testcard, speedtest, report or identify"},
    {"", "no display: give --board NAME"},
    {"testcard", "no display: give --board NAME"},
    {"--board a --board b --board c --board d --board e", "--board 'e': must be a name"},
    {"--board=", "--board"},
    {"--panel=", "--panel"},
    {"--spi=", "--spi"},
    {"--usb=", "--usb"},
    {"--drm=", "--drm"},
    {"--reset=", "--reset"},
    {"--backlight=", "--backlight"},
    {"--te=", "--te"},
    {"--dc -", "--dc '-': must be a line: GPIO25"},
    {"--mode 1", "--mode '1': must be 0 or 3"},
    {"--speed 0", "--speed '0': must be a whole number, 1 .. 200000000"},
    {"--speed 200000001", "--speed '200000001': must be"},
    {"--rotate 45", "--rotate '45': must be 0, 90, 180 or 270 degrees"},
    {"--frames 0", "--frames '0'"},
    {"--frames 1000000001", "--frames '1000000001'"},
    {"--start 1000000001", "--start '1000000001'"},
    {"--fps 0", "--fps '0'"},
    {"--fps 1001", "--fps '1001'"},
    {"--diff yes", "--diff 'yes': must be on or off"},
    {"--refresh 0", "--refresh '0'"},
    {"--band 0", "--band '0'"},
    {"--band 1025", "--band '1025'"},
    {"--depth float17", "--depth 'float17'"},
    {"--board a --demo d --model m", "--demo and --model exclude each other"},
    {"doctor --demo d", "--demo, --view and --model are for showing a scene"},
    {"testcard --board a --view v", "--demo, --view and --model are for showing a scene"},
    {"list --model m", "--demo, --view and --model are for showing a scene"},
    {"--board a --refresh 3", "--refresh is for --diff on"},
    {"probe", "one display at a time"},
    {"speedtest --board a --board b", "one display at a time"},
    {"report", "one display at a time"},
    {"identify --board a --board b", "one display at a time"},
    {"--drm --board a", "--drm: the kernel has this display's wires"},
    {"--drm --panel a", "--drm: the kernel has"},
    {"--drm --spi a", "--drm: the kernel has"},
    {"--drm --usb", "--drm: the kernel has"},
    {"--drm --mode 0", "--drm: the kernel has"},
    {"--drm --speed 1", "--drm: the kernel has"},
    {"--drm --dc a", "--drm: the kernel has"},
    {"--drm --te a", "--drm: the kernel has"},
    {"--drm --board a --board b", "--drm: the kernel has"},
    {"--drm --diff on", "--drm and --diff exclude each other"},
    {"doctor --drm", "--drm is for showing a scene, for testcard and report, not for this command"},
    {"probe --drm", "--drm is for showing"},
    {"speedtest --drm", "--drm is for showing"},
    {"list --drm", "--drm is for showing"},
};

static void what_is_wrong_is_said(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        assert_int_equal(read_line(wrong[i].line), PH_ERR_INVAL);
        if (strstr(said.text, wrong[i].part) == NULL) {
            fail_msg("%s: %s", wrong[i].line, said.text);
        }
        assert_int_equal(stderr_capture_lines(&said), 1);
    }
}

static void a_glass_may_be_changed(void **state)
{
    (void)state;
    take("--panel st7735s-80x160 --offset 24,1 --invert off --bgr");
    assert_true(o.kits[0].offset_set && o.kits[0].offset[0] == 24 && o.kits[0].offset[1] == 1);
    assert_true(o.kits[0].invert_set && !o.kits[0].invert && o.kits[0].bgr);
    take("--board rpi-waveshare-1in3 --invert on");
    assert_true(o.kits[0].invert_set && o.kits[0].invert && !o.kits[0].bgr && !o.kits[0].offset_set);
    static const char *const bad[] = {"--offset 1",      "--offset 1,",         "--offset ,1",  "--offset 1,2,3",
                                      "--offset 1024,0", "--offset 00000001,0", "--offset 1,x", "--invert yes"};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        assert_int_equal(read_line(bad[i]), PH_ERR_INVAL);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_first_word_is_a_command),
        cmocka_unit_test(what_is_not_given_is_the_boards),
        cmocka_unit_test(a_display_is_described_by_its_wires),
        cmocka_unit_test(each_further_board_is_another_display),
        cmocka_unit_test(a_scene_is_described),
        cmocka_unit_test(what_is_wrong_is_said),
        cmocka_unit_test(a_glass_may_be_changed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
