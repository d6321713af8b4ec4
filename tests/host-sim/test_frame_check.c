/* frame_check: what differs from golden frames is counted, measured and placed; what is no golden frame is refused. */
#define _XOPEN_SOURCE 700 /* mkdtemp */

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "complain.h"
#include "crc32.h"
#include "frame_check.h"
#include "render.h"
#include "stderr_capture.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define WIDTH  8
#define HEIGHT 6

static char folder[] = "/tmp/frame_check-XXXXXX";
static uint8_t rgb[3 * WIDTH * HEIGHT];
static struct ppm picture = {WIDTH, HEIGHT, rgb};
static char said[1000]; /* on stdout */

static int make_folder(void **state)
{
    (void)state;
    return mkdtemp(folder) == NULL;
}

static int remove_folder(void **state)
{
    char command[100];
    (void)state;
    snprintf(command, sizeof command, "rm -r '%s'", folder);
    return system(command); /* NOLINT(cert-env33-c): the folder's name is mkdtemp's */
}

/* A picture of greys. */
static int fresh(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < sizeof rgb; i++) {
        rgb[i] = (uint8_t)(100 + i / 3);
    }
    picture = (struct ppm){WIDTH, HEIGHT, rgb};
    return 0;
}

static const char *path(const char *name)
{
    static char paths[4][PATH_MAX];
    static unsigned next;
    char *const p = paths[next++ % 4];
    snprintf(p, PATH_MAX, "%s/%s", folder, name);
    return p;
}

static void write_text(const char *name, const char *text)
{
    FILE *const file = fopen(path(name), "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

static uint8_t *pixel(uint32_t x, uint32_t y)
{
    return rgb + 3 * (y * WIDTH + x);
}

/* Puts a frame to the check, and keeps what it says on stdout. */
static int put(struct frame_check *check, uint32_t frame)
{
    struct stderr_capture c;
    FILE *const out = tmpfile();
    assert_non_null(out);
    fflush(stdout);
    const int before = dup(STDOUT_FILENO);
    dup2(fileno(out), STDOUT_FILENO);
    stderr_capture_begin(&c);
    const int status = frame_check_put(check, frame, &picture);
    stderr_capture_end(&c);
    fflush(stdout);
    dup2(before, STDOUT_FILENO);
    close(before);
    rewind(out);
    said[fread(said, 1, sizeof said - 1, out)] = '\0';
    fclose(out);
    return status;
}

static int silent_open(struct frame_check *check, uint32_t last)
{
    struct stderr_capture c;
    stderr_capture_begin(&c);
    const int status = frame_check_open(check, last);
    stderr_capture_end(&c);
    return status;
}

static int silent_close(struct frame_check *check, int status)
{
    struct stderr_capture c;
    stderr_capture_begin(&c);
    const int closed = frame_check_close(check, status);
    stderr_capture_end(&c);
    return closed;
}

static struct frame_check check_of(const char *reference)
{
    return (struct frame_check){.reference = reference};
}

/* ---- pictures ---------------------------------------------------------------------------------------------------- */

static void an_equal_picture_says_nothing(void **state)
{
    (void)state;
    struct frame_check check = check_of(path("golden.ppm"));
    assert_int_equal(ppm_save(check.reference, &picture), 0);
    assert_int_equal(frame_check_open(&check, 0), 0);
    assert_int_equal(put(&check, 0), 0);
    assert_string_equal(said, "");
    assert_int_equal(check.wrong, 0);
    assert_int_equal(frame_check_close(&check, 0), 0);
}

/* Opens a check against the picture as it is now. */
static struct frame_check golden(uint32_t tolerance)
{
    struct frame_check check = check_of(path("golden.ppm"));
    check.difference = path("difference.ppm");
    check.tolerance = tolerance;
    assert_int_equal(ppm_save(check.reference, &picture), 0);
    assert_int_equal(frame_check_open(&check, 0), 0);
    return check;
}

/* The largest difference is in the first pixel, in the middle one, in the last: in any channel, up or down. */
static void a_difference_is_counted_measured_and_placed(void **state)
{
    for (int largest = 0; largest < 3; largest++) {
        struct frame_check check = golden(0);
        pixel(2, 4)[0] += largest == 0 ? 50 : 1;
        pixel(2, 4)[1] += 1; /* of a pixel's channels the largest counts, not their sum */
        pixel(6, 1)[1] -= largest == 1 ? 50 : 1;
        pixel(5, 3)[2] += largest == 2 ? 50 : 1;
        assert_int_equal(put(&check, 7), 0);
        char line[400];
        snprintf(line, sizeof line,
                 "frame 7: 3 of 48 pixels differ from %s, by at most 50 of 255, in columns 2 .. 6, rows 1 .. 4\n",
                 check.reference);
        assert_string_equal(said, line);
        assert_int_equal(check.wrong, 1);
        assert_int_equal(silent_close(&check, 0), COMPLAINED);
        fresh(state);
    }
}

static void the_corners_are_compared_too(void **state)
{
    for (uint32_t corner = 0; corner < 4; corner++) {
        const uint32_t x = corner % 2 * (WIDTH - 1), y = corner / 2 * (HEIGHT - 1);
        struct frame_check check = golden(0);
        pixel(x, y)[corner % 3] ^= 1;
        assert_int_equal(put(&check, 0), 0);
        char end[100];
        snprintf(end, sizeof end, ", by at most 1 of 255, in columns %u .. %u, rows %u .. %u\n", (unsigned)x,
                 (unsigned)x, (unsigned)y, (unsigned)y);
        assert_non_null(strstr(said, end));
        assert_non_null(strstr(said, "frame 0: 1 of 48 pixels"));
        assert_int_equal(silent_close(&check, 0), COMPLAINED);
        fresh(state);
    }
}

static void what_is_within_the_tolerance_is_no_difference(void **state)
{
    (void)state;
    struct frame_check check = golden(5);
    pixel(3, 3)[1] += 5;
    pixel(4, 4)[1] -= 5;
    assert_int_equal(put(&check, 0), 0);
    assert_int_equal(check.wrong, 0);
    pixel(4, 4)[1] -= 1;
    assert_int_equal(put(&check, 0), 0);
    assert_int_equal(check.wrong, 1);
    assert_non_null(strstr(said, "1 of 48 pixels"));
    assert_non_null(strstr(said, "by at most 6 of 255"));
    assert_int_equal(silent_close(&check, 0), COMPLAINED);
}

/* Where the picture is right it is dark grey, a quarter of what it was. */
static void a_difference_is_drawn_in_red_on_a_dark_picture(void **state)
{
    (void)state;
    memcpy(pixel(7, 5), (uint8_t[]){80, 160, 40}, 3); /* of green twice as much counts */
    struct frame_check check = golden(0);
    struct ppm drawn;
    pixel(2, 1)[0] += 100;
    assert_int_equal(put(&check, 0), 0);
    assert_int_equal(ppm_load(path("difference.ppm"), WIDTH * HEIGHT, &drawn), 0);
    for (uint32_t i = 0; i < WIDTH * HEIGHT; i++) {
        const uint8_t grey = i == 5 * WIDTH + 7 ? 440 / 16 : (uint8_t)((100 + i) / 4);
        assert_int_equal(drawn.rgb[3 * i], i == WIDTH + 2 ? 178 : grey);
        assert_int_equal(drawn.rgb[3 * i + 1], grey);
        assert_int_equal(drawn.rgb[3 * i + 2], grey);
    }
    free(drawn.rgb);
    assert_int_equal(silent_close(&check, 0), COMPLAINED);
}

static void a_reference_may_be_enlarged_by_the_scale_alone(void **state)
{
    (void)state;
    static uint8_t large_rgb[3 * 3 * 3 * WIDTH * HEIGHT];
    struct ppm large = {3 * WIDTH, 3 * HEIGHT, large_rgb};
    for (uint32_t i = 0; i < 9 * WIDTH * HEIGHT; i++) {
        memcpy(large_rgb + 3 * i, pixel(i % (3 * WIDTH) / 3, i / (3 * WIDTH) / 3), 3);
    }
    struct frame_check check = check_of(path("large.ppm"));
    assert_int_equal(ppm_save(check.reference, &large), 0);
    for (check.scale = 0; check.scale <= 4; check.scale++) {
        assert_int_equal(frame_check_open(&check, 0), 0);
        assert_int_equal(put(&check, 2), 0);
        char line[400] = "";
        if (check.scale != 3) {
            const unsigned scale = check.scale == 0 ? 1 : (unsigned)check.scale;
            snprintf(line, sizeof line, "frame 2: is %ux%u, but %s is 24x18\n", WIDTH * scale, HEIGHT * scale,
                     check.reference);
        }
        assert_string_equal(said, line);
        assert_int_equal(check.wrong, check.scale != 3);
        silent_close(&check, 0);
    }
}

static void a_picture_of_another_width_or_height_is_wrong(void **state)
{
    (void)state;
    static const uint32_t sizes[][2] = {{WIDTH, HEIGHT - 1}, {WIDTH - 1, HEIGHT}, {WIDTH * 2, HEIGHT}};
    static uint8_t other_rgb[3 * 2 * WIDTH * HEIGHT] = {0};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        const struct ppm other = {sizes[i][0], sizes[i][1], other_rgb};
        struct frame_check check = check_of(path("other.ppm"));
        assert_int_equal(ppm_save(check.reference, &other), 0);
        assert_int_equal(frame_check_open(&check, 0), 0);
        assert_int_equal(put(&check, 0), 0);
        assert_int_equal(check.wrong, 1);
        assert_non_null(strstr(said, "frame 0: is 8x6, but "));
        silent_close(&check, 0);
    }
}

static void several_frames_have_a_file_each(void **state)
{
    (void)state;
    struct frame_check check = check_of(path("walk.ppm"));
    check.several = true;
    assert_int_equal(ppm_save(path("walk-0012.ppm"), &picture), 0);
    assert_int_equal(frame_check_open(&check, 99), 0);
    assert_int_equal(put(&check, 12), 0);
    assert_string_equal(said, "");
    assert_int_equal(put(&check, 13), COMPLAINED); /* there is none */
    frame_check_close(&check, 0);
    assert_int_equal(ppm_save(path("walk-00012.ppm"), &picture), 0);
    assert_int_equal(unlink(path("walk-0012.ppm")), 0);
    assert_int_equal(frame_check_open(&check, 10000), 0); /* five digits for all */
    assert_int_equal(put(&check, 12), 0);
    frame_check_close(&check, 0);
}

static void a_folder_has_frames_by_their_numbers(void **state)
{
    (void)state;
    struct frame_check check = check_of(path("kept"));
    assert_int_equal(mkdir(check.reference, 0755), 0);
    assert_int_equal(ppm_save(path("kept/frame-0003.ppm"), &picture), 0);
    assert_int_equal(frame_check_open(&check, 3), 0);
    assert_int_equal(put(&check, 3), 0);
    pixel(0, 0)[0] ^= 4;
    assert_int_equal(put(&check, 3), 0);
    assert_int_equal(check.wrong, 1);
    assert_int_equal(silent_close(&check, 0), COMPLAINED);
}

/* ---- CRCs -------------------------------------------------------------------------------------------------------- */

static void a_list_of_crcs_is_compared_by_frames(void **state)
{
    (void)state;
    const unsigned crc = crc32_update(0, rgb, sizeof rgb);
    char text[300];
    snprintf(text, sizeof text,
             "some words\n\nframe 4 crc32 %08X\nframe 5 crc32 %08x\n{\"frame\": 6, \"crc32\": \"%08X\"}\nframe 7 crc32 "
             "12345678\n",
             crc, crc, crc);
    write_text("crcs", text);
    struct frame_check check = check_of(path("crcs"));
    assert_int_equal(frame_check_open(&check, 7), 0);
    assert_int_equal(check.crc_count, 4);
    for (uint32_t frame = 4; frame <= 6; frame++) {
        assert_int_equal(put(&check, frame), 0);
        assert_string_equal(said, "");
    }
    assert_int_equal(put(&check, 7), 0);
    char line[400];
    snprintf(line, sizeof line, "frame 7: crc32 %08X, but 12345678 in %s\n", crc, check.reference);
    assert_string_equal(said, line);
    assert_int_equal(check.wrong, 1);
    assert_int_equal(put(&check, 8), COMPLAINED); /* it is not on the list */
    pixel(WIDTH - 1, HEIGHT - 1)[2] ^= 1;         /* the last byte counts */
    assert_int_equal(put(&check, 4), 0);
    assert_int_equal(check.wrong, 2);
    assert_int_equal(silent_close(&check, 0), COMPLAINED);
}

static void a_file_without_crcs_is_refused(void **state)
{
    (void)state;
    write_text("nothing", "frame crc32\nframe x crc32 12345678\n");
    struct frame_check check = check_of(path("nothing"));
    assert_int_equal(silent_open(&check, 0), COMPLAINED);
    frame_check_close(&check, 0);
    check = check_of(path("is not there"));
    assert_int_equal(silent_open(&check, 0), COMPLAINED);
    frame_check_close(&check, 0);
}

static void crcs_take_no_tolerance(void **state)
{
    (void)state;
    write_text("list", "frame 0 crc32 12345678\n");
    struct frame_check check = check_of(path("list"));
    check.tolerance = 1;
    assert_int_equal(silent_open(&check, 0), PH_ERR_INVAL);
    frame_check_close(&check, 0);
}

/* ---- all of it --------------------------------------------------------------------------------------------------- */

static void without_a_reference_nothing_is_compared(void **state)
{
    (void)state;
    struct frame_check check = check_of(NULL);
    assert_int_equal(frame_check_open(&check, 0), 0);
    assert_int_equal(put(&check, 0), 0);
    assert_int_equal(frame_check_close(&check, 0), 0);
    assert_int_equal(frame_check_close(&check, -5), -5);
}

static void another_error_comes_first_and_frames_are_counted_in_words(void **state)
{
    (void)state;
    struct stderr_capture one, two;
    struct frame_check check = check_of("somewhere");
    check.wrong = 1;
    assert_int_equal(silent_close(&check, -5), -5);
    stderr_capture_begin(&one);
    frame_check_close(&check, 0);
    stderr_capture_end(&one);
    check.wrong = 2;
    stderr_capture_begin(&two);
    frame_check_close(&check, 0);
    stderr_capture_end(&two);
    assert_non_null(strstr(one.text, "1 frame is not as in somewhere"));
    assert_non_null(strstr(two.text, "2 frames are not as in somewhere"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(an_equal_picture_says_nothing, fresh),
        cmocka_unit_test_setup(a_difference_is_counted_measured_and_placed, fresh),
        cmocka_unit_test_setup(the_corners_are_compared_too, fresh),
        cmocka_unit_test_setup(what_is_within_the_tolerance_is_no_difference, fresh),
        cmocka_unit_test_setup(a_difference_is_drawn_in_red_on_a_dark_picture, fresh),
        cmocka_unit_test_setup(a_reference_may_be_enlarged_by_the_scale_alone, fresh),
        cmocka_unit_test_setup(a_picture_of_another_width_or_height_is_wrong, fresh),
        cmocka_unit_test_setup(several_frames_have_a_file_each, fresh),
        cmocka_unit_test_setup(a_folder_has_frames_by_their_numbers, fresh),
        cmocka_unit_test_setup(a_list_of_crcs_is_compared_by_frames, fresh),
        cmocka_unit_test_setup(a_file_without_crcs_is_refused, fresh),
        cmocka_unit_test_setup(crcs_take_no_tolerance, fresh),
        cmocka_unit_test_setup(without_a_reference_nothing_is_compared, fresh),
        cmocka_unit_test_setup(another_error_comes_first_and_frames_are_counted_in_words, fresh),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
