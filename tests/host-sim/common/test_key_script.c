/* key_script: scripts of button presses as text, and what is held at which frame, counted by hand. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "complain.h"
#include "files.h"
#include "hal.h"
#include "key_script.h"
#include "stderr_capture.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char path[] = "key_script.test";

/* Reads a script; `said` is in the line on stderr where it is wrong, else NULL. */
static struct key_script read_bytes(const char *text, size_t n, const char *said)
{
    struct key_script keys;
    struct stderr_capture capture;
    file_bytes(path, text, n);
    stderr_capture_begin(&capture);
    const int status = key_script_read(&keys, path);
    stderr_capture_end(&capture);
    assert_int_equal(unlink(path), 0);
    assert_int_equal(status, said == NULL ? 0 : PH_ERR_INVAL);
    assert_int_equal(stderr_capture_lines(&capture), said != NULL);
    assert_true(said == NULL || strstr(capture.text, said) != NULL);
    return keys;
}

static struct key_script read_text(const char *text, const char *said)
{
    return read_bytes(text, strlen(text), said);
}

static void a_press_is_held_for_its_frames(void **state)
{
    (void)state;
    struct key_script keys = read_text("3 up\n5 left+right 2\n\n# nothing\n 5\tselect 3 # adds up\r\n0 down", NULL);
    static const uint32_t held[] = {HAL_BUTTON_DOWN,
                                    0,
                                    0,
                                    HAL_BUTTON_UP,
                                    0,
                                    HAL_BUTTON_LEFT | HAL_BUTTON_RIGHT | HAL_BUTTON_SELECT,
                                    HAL_BUTTON_LEFT | HAL_BUTTON_RIGHT | HAL_BUTTON_SELECT,
                                    HAL_BUTTON_SELECT,
                                    0,
                                    0};
    assert_int_equal(keys.count, 4);
    for (uint32_t frame = 0; frame < sizeof held / sizeof held[0]; frame++) {
        assert_int_equal(key_script_at(&keys, frame), held[frame]);
    }
    key_script_free(&keys);
    assert_int_equal(keys.count, 0);
    assert_null(keys.presses);
}

static void without_a_path_nothing_is_pressed(void **state)
{
    (void)state;
    struct key_script keys;
    assert_int_equal(key_script_read(&keys, NULL), 0);
    assert_int_equal(key_script_at(&keys, 0), 0);
    key_script_free(&keys);
}

static void a_wrong_line_is_named(void **state)
{
    (void)state;
    static const char *const wrong[] = {
        "1",     "x up",      "1 jump",        "1 up+",           "1 +up",  "1 up 0", "1 up 2 3",    "1 up 2 3 4",
        "-1 up", "1 up,down", "1000000001 up", "1 up 1000000001", "1 up x", "up 1",   "1 up + down", "1 UP"};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        char text[64];
        snprintf(text, sizeof text, "0 up\n# fine\n%s\n", wrong[i]);
        struct key_script keys = read_text(text, "key_script.test:3: a line must be");
        key_script_free(&keys);
    }
    struct key_script keys = read_bytes("1 up\0 2\n", 8, "key_script.test:1:");
    key_script_free(&keys);
    keys = read_text("1000000000 up 1000000000", NULL);
    assert_int_equal(key_script_at(&keys, 1000000000), HAL_BUTTON_UP);
    assert_int_equal(key_script_at(&keys, 1999999999), HAL_BUTTON_UP);
    assert_int_equal(key_script_at(&keys, 2000000000), 0);
    key_script_free(&keys);
}

static void a_file_that_is_missing_is_named(void **state)
{
    (void)state;
    struct key_script keys;
    struct stderr_capture capture;
    stderr_capture_begin(&capture);
    const int status = key_script_read(&keys, "no-such-folder/keys");
    stderr_capture_end(&capture);
    assert_int_equal(status, COMPLAINED);
    assert_non_null(strstr(capture.text, "--keys no-such-folder/keys: No such file"));
    assert_int_equal(keys.count, 0);
    key_script_free(&keys);
}

/* 100,000 presses are read, each in its frame, and one more is refused with its line's number. */
static void a_hundred_thousand_presses_are_enough(void **state)
{
    (void)state;
    enum { MOST = 100000 };
    char *const text = malloc(MOST * 10 + 20);
    size_t n = 0;
    assert_non_null(text);
    for (unsigned i = 0; i < MOST; i++) {
        n += (size_t)sprintf(text + n, "%u up\n", 2 * i);
    }
    struct key_script keys = read_text(text, NULL);
    assert_int_equal(keys.count, MOST);
    for (uint32_t frame = 2 * MOST - 40; frame < 2 * MOST; frame++) {
        assert_int_equal(key_script_at(&keys, frame), frame % 2 == 0 ? HAL_BUTTON_UP : 0);
    }
    key_script_free(&keys);
    strcpy(text + n, "7 up\n");
    keys = read_text(text, "key_script.test:100001: more than 100000 presses");
    key_script_free(&keys);
    free(text);
}

int main(void)
{
    if (files_begin_inside() != 0) {
        return 1;
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_press_is_held_for_its_frames),
        cmocka_unit_test(without_a_path_nothing_is_pressed),
        cmocka_unit_test(a_wrong_line_is_named),
        cmocka_unit_test(a_file_that_is_missing_is_named),
        cmocka_unit_test(a_hundred_thousand_presses_are_enough),
    };
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    return files_end_empty() != 0 ? 1 : failed;
}
