/* frame_out: which output a name means, the names and bytes of the files, and what is left after an error. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "complain.h"
#include "files.h"
#include "frame_out.h"
#include "gif_out.h"
#include "picture_in.h"
#include "stderr_capture.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static uint8_t rgb[] = "abcdefghijkl"; /* 2x2 */
static const struct ppm picture = {2, 2, rgb};

static int open_out(struct frame_out *out, const char *target, bool several, uint32_t last, const char *said)
{
    struct stderr_capture capture;
    memset(out, 0x5a, sizeof *out);
    out->scale = 0;
    stderr_capture_begin(&capture);
    const int status = frame_out_open(out, target, several, last);
    stderr_capture_end(&capture);
    assert_int_equal(stderr_capture_lines(&capture), said != NULL);
    assert_true(said == NULL || strstr(capture.text, said) != NULL);
    return status;
}

static void expect_file(const char *path, const char *bytes, size_t n)
{
    size_t found = 0;
    uint8_t *const read = file_read(path, &found);
    assert_int_equal(found, n);
    assert_memory_equal(read, bytes, n);
    free(read);
    assert_int_equal(unlink(path), 0);
}

static void the_name_says_what_is_meant(void **state)
{
    (void)state;
    static const struct {
        const char *target;
        bool several;
        enum frame_out_kind kind;
        const char *ending;
    } known[] = {{NULL, true, FRAME_OUT_NONE, ".ppm"},           {"-", true, FRAME_OUT_STREAM, ".ppm"},
                 {"a.ppm", false, FRAME_OUT_FILE, ".ppm"},       {"a.ppm", true, FRAME_OUT_FILES, ".ppm"},
                 {"a.png", false, FRAME_OUT_FILE, ".png"},       {"a.png", true, FRAME_OUT_FILES, ".png"},
                 {"folder", false, FRAME_OUT_DIRECTORY, ".ppm"}, {".ppm", false, FRAME_OUT_DIRECTORY, ".ppm"},
                 {"d/.x", false, FRAME_OUT_DIRECTORY, ".ppm"},   {"a.b/", false, FRAME_OUT_DIRECTORY, ".ppm"},
                 {"a.b/c", false, FRAME_OUT_DIRECTORY, ".ppm"},  {"a.", false, FRAME_OUT_DIRECTORY, ".ppm"}};
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        struct frame_out out;
        assert_int_equal(open_out(&out, known[i].target, known[i].several, 9, NULL), 0);
        assert_int_equal(out.kind, known[i].kind);
        assert_string_equal(out.ending, known[i].ending);
        assert_int_equal(frame_out_close(&out, 0), 0);
        assert_int_equal(out.kind, FRAME_OUT_NONE);
        assert_true(known[i].target == NULL || access(known[i].target, F_OK) != 0); /* empty directories go */
    }
    assert_int_not_equal(access("a.b", F_OK), 0);
    struct frame_out out;
    assert_int_equal(open_out(&out, "a.jpg", false, 9, "--out a.jpg: .ppm, .png and .gif"), PH_ERR_INVAL);
    assert_int_equal(open_out(&out, "b/a.PPM", false, 9, "--out b/a.PPM"), PH_ERR_INVAL);
}

static void numbers_have_four_digits_or_more(void **state)
{
    (void)state;
    static const struct {
        uint32_t last;
        int digits;
    } known[] = {{0, 4}, {9999, 4}, {10000, 5}, {4294967295u, 10}};
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        struct frame_out out;
        assert_int_equal(open_out(&out, NULL, true, known[i].last, NULL), 0);
        assert_int_equal(out.digits, known[i].digits);
    }
}

static void each_kind_names_its_files(void **state)
{
    (void)state;
    struct frame_out out;
    assert_int_equal(open_out(&out, "a.ppm", false, 9, NULL), 0);
    assert_int_equal(frame_out_put(&out, 7, &picture), 0);
    assert_int_equal(frame_out_close(&out, 0), 0);
    expect_file("a.ppm", "P6\n2 2\n255\nabcdefghijkl", 23);
    assert_int_equal(open_out(&out, "a.ppm", true, 12345, NULL), 0);
    assert_int_equal(frame_out_put(&out, 7, &picture), 0);
    assert_int_equal(frame_out_close(&out, 0), 0);
    expect_file("a-00007.ppm", "P6\n2 2\n255\nabcdefghijkl", 23);
    assert_int_equal(open_out(&out, "f/g", true, 9, NULL), 0);
    assert_int_equal(frame_out_put(&out, 123, &picture), 0);
    assert_int_equal(frame_out_close(&out, COMPLAINED), COMPLAINED);
    expect_file("f/g/frame-0123.ppm", "P6\n2 2\n255\nabcdefghijkl", 23); /* a directory with a frame stays */
    assert_int_equal(rmdir("f/g"), 0);
    assert_int_equal(rmdir("f"), 0);
}

static void a_pixel_becomes_a_square(void **state)
{
    (void)state;
    struct ppm large;
    assert_int_equal(frame_out_enlarge(&picture, 3, &large), 0);
    assert_true(large.width == 6 && large.height == 6);
    for (unsigned i = 0; i < 6 * 6 * 3; i++) {
        assert_int_equal(large.rgb[i], rgb[(i / 18 / 3 * 2 + i / 3 % 6 / 3) * 3 + i % 3]);
    }
    free(large.rgb);
    struct frame_out out;
    assert_int_equal(open_out(&out, "a.ppm", false, 9, NULL), 0);
    out.scale = 2;
    assert_int_equal(frame_out_put(&out, 0, &(struct ppm){2, 1, rgb}), 0);
    assert_int_equal(frame_out_close(&out, 0), 0);
    expect_file("a.ppm", "P6\n4 2\n255\nabcabcdefdefabcabcdefdef", 35);
}

static void pictures_come_back(void **state)
{
    (void)state;
    static const char *const names[] = {"a.ppm", "a.png"};
    const int kinds = strstr(png_in_reason, "without libpng") == NULL ? 2 : 1; /* that are read here */
    for (int i = 0; i < kinds; i++) {
        struct frame_out out;
        struct ppm back;
        struct stderr_capture capture;
        assert_int_equal(open_out(&out, names[i], false, 9, NULL), 0);
        assert_int_equal(frame_out_put(&out, 0, &picture), 0);
        assert_int_equal(frame_out_load(names[i], 4, &back), 0);
        assert_true(back.width == 2 && back.height == 2);
        assert_memory_equal(back.rgb, rgb, 12);
        free(back.rgb);
        stderr_capture_begin(&capture);
        const int status = frame_out_load(names[i], 3, &back);
        stderr_capture_end(&capture);
        assert_int_equal(status, COMPLAINED);
        assert_non_null(strstr(capture.text, ": is 2x2, and there is room for 3 pixels"));
        assert_int_equal(unlink(names[i]), 0);
    }
}

static void what_cannot_be_read_is_told(void **state)
{
    (void)state;
    struct ppm back;
    struct stderr_capture capture;
    file_text("x", "neither");
    stderr_capture_begin(&capture);
    const int other = frame_out_load("x", 100, &back), none = frame_out_load("none", 100, &back);
    stderr_capture_end(&capture);
    assert_true(other == COMPLAINED && none == COMPLAINED);
    assert_string_equal(capture.text,
                        "pinhole: x: is neither a binary PPM (P6) nor a PNG, JPEG or WebP picture that can be read\n"
                        "pinhole: none: cannot be read: No such file or directory\n");
    struct frame_out out;
    assert_int_equal(open_out(&out, "x", false, 9, "x: cannot be used as a directory for frames: Not a directory"),
                     COMPLAINED);
    assert_int_equal(open_out(&out, "x/y", false, 9, "x/y: cannot be used as a directory"), COMPLAINED);
    assert_int_equal(unlink("x"), 0);
}

static void a_gif_is_written_at_the_end(void **state)
{
    (void)state;
    struct frame_out out;
    char head[7] = "";
    if (gif_out_reason != NULL) {
        skip(); /* no GIF is written here */
    }
    assert_int_equal(open_out(&out, "a.gif", true, 9, NULL), 0);
    assert_int_equal(out.kind, FRAME_OUT_GIF);
    assert_int_equal(frame_out_put(&out, 0, &picture), 0);
    assert_int_not_equal(access("a.gif", F_OK), 0);
    assert_int_equal(frame_out_close(&out, COMPLAINED), COMPLAINED); /* it failed: none */
    assert_int_not_equal(access("a.gif", F_OK), 0);
    out.scale = 3;
    assert_int_equal(frame_out_open(&out, "a.gif", true, 9), 0);
    assert_int_equal(frame_out_put(&out, 0, &picture), 0);
    assert_int_equal(frame_out_close(&out, 0), 0);
    FILE *const file = fopen("a.gif", "rb");
    assert_non_null(file);
    uint8_t size[4];
    assert_int_equal(fread(head, 1, 6, file), 6);
    assert_int_equal(fread(size, 1, 4, file), 4);
    fclose(file);
    assert_string_equal(head, "GIF89a");
    assert_memory_equal(size, "\x06\x00\x06\x00", 4);
    assert_int_equal(unlink("a.gif"), 0);
}

int main(void)
{
    if (files_begin_inside() != 0) {
        return 1;
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_name_says_what_is_meant), cmocka_unit_test(numbers_have_four_digits_or_more),
        cmocka_unit_test(each_kind_names_its_files),   cmocka_unit_test(a_pixel_becomes_a_square),
        cmocka_unit_test(pictures_come_back),          cmocka_unit_test(what_cannot_be_read_is_told),
        cmocka_unit_test(a_gif_is_written_at_the_end),
    };
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    return files_end_empty() != 0 ? 1 : failed;
}
