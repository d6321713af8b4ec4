/* jpeg_in: pictures that libjpeg's writer made of one colour a block, in which JPEG loses no more than rounding; grey
 * ones, and broken ones. */
#include "picture_in.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <jpeglib.h> /* tests/run.sh skips this program where the library is not installed */

#include <setjmp.h>
#include <stdarg.h>
#include <cmocka.h>

enum { WIDTH = 40, HEIGHT = 24, BLOCK = 8 };

static uint8_t file[8192];
static unsigned long size;

static uint8_t value(uint32_t x, uint32_t y, uint32_t c)
{
    return (uint8_t)(30 + 40 * (x / BLOCK) + 20 * (y / BLOCK) + 15 * c);
}

static void make(int channels, J_COLOR_SPACE space)
{
    struct jpeg_compress_struct jpeg;
    struct jpeg_error_mgr error;
    uint8_t row[WIDTH * 4], *const rows[1] = {row}, *out = NULL;
    jpeg.err = jpeg_std_error(&error);
    jpeg_create_compress(&jpeg);
    size = 0;
    jpeg_mem_dest(&jpeg, &out, &size);
    jpeg.image_width = WIDTH;
    jpeg.image_height = HEIGHT;
    jpeg.input_components = channels;
    jpeg.in_color_space = space;
    jpeg_set_defaults(&jpeg);
    jpeg_set_quality(&jpeg, 100, TRUE);
    for (int c = 0; c < channels; c++) { /* colours are kept for each pixel */
        jpeg.comp_info[c].h_samp_factor = jpeg.comp_info[c].v_samp_factor = 1;
    }
    jpeg_start_compress(&jpeg, TRUE);
    for (uint32_t y = 0; y < HEIGHT; y++) {
        for (uint32_t i = 0; i < WIDTH * (uint32_t)channels; i++) {
            row[i] = value(i / (uint32_t)channels, y, i % (uint32_t)channels);
        }
        jpeg_write_scanlines(&jpeg, (JSAMPARRAY)(uintptr_t)rows, 1);
    }
    jpeg_finish_compress(&jpeg);
    jpeg_destroy_compress(&jpeg);
    assert_true(size <= sizeof file - 16);
    memcpy(file, out, size);
    free(out);
}

static void expect_read(size_t n, bool is_grey)
{
    struct picture_in in = {.most = PPM_SIDE_MAX};
    assert_true(jpeg_in_memory(&in, file, n));
    picture_in_end(&in);
    assert_true(in.picture.width == WIDTH && in.picture.height == HEIGHT && in.alpha == NULL);
    for (uint32_t i = 0; i < WIDTH * HEIGHT * 3; i++) {
        const int want = value(i / 3 % WIDTH, i / 3 / WIDTH, is_grey ? 0 : i % 3);
        assert_in_range(in.picture.rgb[i], want - 2, want + 2);
    }
    picture_in_free(&in);
}

static void expect_refused(size_t n)
{
    struct picture_in in = {.most = PPM_SIDE_MAX};
    assert_false(jpeg_in_memory(&in, file, n));
    picture_in_free(&in);
}

static void colours_and_greys_are_read(void **state)
{
    (void)state;
    make(3, JCS_RGB);
    expect_read(size, false);
    make(1, JCS_GRAYSCALE);
    expect_read(size, true);
}

static void four_colours_are_refused(void **state)
{
    (void)state;
    make(4, JCS_CMYK);
    expect_refused(size);
}

/* Bytes between two markers, as cameras leave them: behind the first one, which has two bytes. */
static void bytes_between_the_markers_are_passed_over(void **state)
{
    (void)state;
    make(3, JCS_RGB);
    memmove(file + 2 + 5, file + 2, size - 2);
    memset(file + 2, 0x11, 5);
    expect_read(size + 5, false);
}

/* The library itself would make the rest grey. */
static void what_is_cut_off_or_damaged_is_refused(void **state)
{
    (void)state;
    make(3, JCS_RGB);
    for (size_t n = 0; n < size - 2; n += 3) {
        expect_refused(n);
    }
    file[size - 30] = 0xFF; /* a marker in the middle of the data */
    file[size - 29] = 0xD9;
    expect_refused(size);
}

static void what_is_too_large_is_refused(void **state)
{
    (void)state;
    make(3, JCS_RGB);
    struct picture_in in = {.most = WIDTH, .most_pixels = WIDTH * HEIGHT - 1};
    assert_false(jpeg_in_memory(&in, file, size));
    assert_non_null(in.why);
    picture_in_free(&in);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(colours_and_greys_are_read),
        cmocka_unit_test(four_colours_are_refused),
        cmocka_unit_test(bytes_between_the_markers_are_passed_over),
        cmocka_unit_test(what_is_cut_off_or_damaged_is_refused),
        cmocka_unit_test(what_is_too_large_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
