/* Pictures as they are read: shrunk by the mean, interlaced, JPEG, and what is broken. */
#include "crc32.h"
#include "picture_in.h"

#include <png.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <jpeglib.h> /* tests/run.sh skips this program where a library is not installed */

#include <setjmp.h>
#include <stdarg.h>
#include <cmocka.h>

enum { WIDTH = 37, HEIGHT = 21 };

static uint8_t pixels[HEIGHT][WIDTH][3];

static int make_pixels(void **state)
{
    (void)state;
    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < WIDTH; x++) {
            pixels[y][x][0] = (uint8_t)(x * 6);
            pixels[y][x][1] = (uint8_t)(y * 12);
            pixels[y][x][2] = (uint8_t)(x * y);
        }
    }
    return 0;
}

struct bytes {
    uint8_t bytes[8192];
    size_t n;
};

static void append(png_structp png, png_bytep from, size_t n)
{
    struct bytes *to = png_get_io_ptr(png);
    assert_true(to->n + n <= sizeof to->bytes);
    memcpy(to->bytes + to->n, from, n);
    to->n += n;
}

static struct bytes make_png(int interlace)
{
    struct bytes to = {.n = 0};
    png_bytep rows[HEIGHT];
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png);
    for (int y = 0; y < HEIGHT; y++) {
        rows[y] = pixels[y][0];
    }
    png_set_write_fn(png, &to, append, NULL);
    png_set_IHDR(png, info, WIDTH, HEIGHT, 8, PNG_COLOR_TYPE_RGB, interlace, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    png_set_rows(png, info, rows);
    png_write_png(png, info, PNG_TRANSFORM_IDENTITY, NULL);
    png_destroy_write_struct(&png, &info);
    return to;
}

/* A picture of one colour, which JPEG keeps within rounding. */
static struct bytes make_jpeg(uint8_t red, uint8_t green, uint8_t blue, bool is_progressive)
{
    struct bytes to = {.n = 0};
    struct jpeg_compress_struct jpeg;
    struct jpeg_error_mgr error;
    uint8_t row[3 * 40], *out = NULL;
    unsigned long n = 0;
    for (int i = 0; i < 40; i++) {
        memcpy(row + 3 * i, (uint8_t[3]){red, green, blue}, 3);
    }
    jpeg.err = jpeg_std_error(&error);
    jpeg_create_compress(&jpeg);
    jpeg_mem_dest(&jpeg, &out, &n);
    jpeg.image_width = 40;
    jpeg.image_height = 24;
    jpeg.input_components = 3;
    jpeg.in_color_space = JCS_RGB;
    jpeg_set_defaults(&jpeg);
    if (is_progressive) {
        jpeg_simple_progression(&jpeg);
    }
    jpeg_start_compress(&jpeg, TRUE);
    for (int y = 0; y < 24; y++) {
        uint8_t *const rows[1] = {row};
        jpeg_write_scanlines(&jpeg, (JSAMPARRAY)(uintptr_t)rows, 1);
    }
    jpeg_finish_compress(&jpeg);
    jpeg_destroy_compress(&jpeg);
    assert_true(n <= sizeof to.bytes);
    memcpy(to.bytes, out, n);
    to.n = n;
    free(out);
    return to;
}

static void a_png_is_read_whole_interlaced_or_not(void **state)
{
    (void)state;
    for (int interlace = 0; interlace < 2; interlace++) {
        const struct bytes png = make_png(interlace);
        struct picture_in in = {.most = PPM_SIDE_MAX};
        assert_null(picture_in_memory(&in, png.bytes, png.n));
        assert_int_equal(in.picture.width, WIDTH);
        assert_int_equal(in.picture.height, HEIGHT);
        assert_memory_equal(in.picture.rgb, pixels, sizeof pixels);
        picture_in_free(&in);
    }
}

static void a_larger_picture_is_shrunk_to_means(void **state)
{
    (void)state;
    for (int interlace = 0; interlace < 2; interlace++) {
        const struct bytes png = make_png(interlace);
        struct picture_in in = {.most = 8};
        unsigned sums[8][8][3] = {{{0}}}, counts[8][8] = {{0}};
        assert_null(picture_in_memory(&in, png.bytes, png.n));
        assert_int_equal(in.width, WIDTH);
        assert_int_equal(in.picture.width, 8);
        for (int y = 0; y < HEIGHT; y++) {
            for (int x = 0; x < WIDTH; x++) {
                counts[y * 8 / HEIGHT][x * 8 / WIDTH]++;
                for (int c = 0; c < 3; c++) {
                    sums[y * 8 / HEIGHT][x * 8 / WIDTH][c] += pixels[y][x][c];
                }
            }
        }
        for (int i = 0; i < 8 * 8 * 3; i++) {
            assert_int_equal(in.picture.rgb[i], (&sums[0][0][0])[i] / (&counts[0][0])[i / 3]);
        }
        picture_in_free(&in);
    }
}

/* Alpha is i of pixel i of 16 x 16. */
static void alpha_is_read_and_shrunk(void **state)
{
    (void)state;
    for (uint32_t most = 8; most <= 16; most += 8) {
        uint8_t rgba[16][16][4], bytes[4096];
        png_image image = {.version = PNG_IMAGE_VERSION, .width = 16, .height = 16, .format = PNG_FORMAT_RGBA};
        png_alloc_size_t n = sizeof bytes;
        for (int i = 0; i < 256; i++) {
            memcpy(rgba[i / 16][i % 16], (const uint8_t[4]){10, 20, 30, (uint8_t)i}, 4);
        }
        assert_true(png_image_write_to_memory(&image, bytes, &n, 0, rgba, 0, NULL));
        struct picture_in in = {.most = most};
        assert_null(picture_in_memory(&in, bytes, n));
        assert_non_null(in.alpha);
        for (uint32_t i = 0; i < most * most; i++) {
            const uint32_t x = i % most, y = i / most, shrink = 16 / most;
            const uint32_t mean = shrink == 1 ? 16 * y + x : 16 * (2 * y) + 2 * x + 8; /* of 0, 1, 16 and 17: 8.5 */
            assert_int_equal(in.alpha[i], mean);
            assert_memory_equal(in.picture.rgb + 3 * i, ((const uint8_t[3]){10, 20, 30}), 3);
        }
        picture_in_free(&in);
        assert_null(in.alpha);
    }
}

static void a_jpeg_is_read_and_a_progressive_one(void **state)
{
    (void)state;
    for (int k = 0; k < 2; k++) {
        const struct bytes jpeg = make_jpeg(200, 100, 50, k == 1);
        struct picture_in in = {.most = PPM_SIDE_MAX};
        assert_null(picture_in_memory(&in, jpeg.bytes, jpeg.n));
        assert_int_equal(in.picture.width, 40);
        assert_int_equal(in.picture.height, 24);
        for (int i = 0; i < 40 * 24; i++) {
            assert_in_range(in.picture.rgb[3 * i], 198, 202);
            assert_in_range(in.picture.rgb[3 * i + 1], 98, 102);
            assert_in_range(in.picture.rgb[3 * i + 2], 48, 52);
        }
        picture_in_free(&in);
    }
}

static void what_is_cut_off_is_refused(void **state)
{
    const struct bytes whole[3] = {make_png(0), make_png(1), make_jpeg(9, 90, 200, false)};
    (void)state;
    for (int k = 0; k < 3; k++) {
        for (size_t n = 0; n < whole[k].n - 16; n += 7) {
            uint8_t *bytes = malloc(n + 1); /* a reader that goes on is seen by the sanitizers */
            assert_non_null(bytes);
            memcpy(bytes, whole[k].bytes, n);
            struct picture_in in = {.most = 8};
            const char *why = picture_in_memory(&in, bytes, n);
            assert_non_null(why);
            assert_true(n < 4 || strstr(why, "cut off") != NULL);
            assert_null(in.picture.rgb);
            free(bytes);
        }
    }
}

/* The header alone is changed: the picture is refused before its rows are read. */
static void what_is_too_large_is_told_by_the_limit(void **state)
{
    static const uint32_t sides[3] = {16385, 1000001, 0x7fffffff};
    (void)state;
    for (int k = 0; k < 3; k++) {
        struct bytes png = make_png(0);
        struct picture_in in = {.most = 8};
        for (int i = 0; i < 4; i++) {
            png.bytes[16 + i] = (uint8_t)(sides[k] >> (24 - 8 * i)); /* the width; then the CRC of the chunk */
        }
        const uint32_t crc = crc32_update(0, png.bytes + 12, 17);
        for (int i = 0; i < 4; i++) {
            png.bytes[29 + i] = (uint8_t)(crc >> (24 - 8 * i));
        }
        assert_string_equal(picture_in_memory(&in, png.bytes, png.n), "is too large: more than 16384 pixels a side");
        png.bytes[29] ^= 1;
        assert_string_equal(picture_in_memory(&in, png.bytes, png.n),
                            "is a PNG that cannot be read: it is broken or cut off");
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_png_is_read_whole_interlaced_or_not),
        cmocka_unit_test(a_larger_picture_is_shrunk_to_means),
        cmocka_unit_test(alpha_is_read_and_shrunk),
        cmocka_unit_test(a_jpeg_is_read_and_a_progressive_one),
        cmocka_unit_test(what_is_cut_off_is_refused),
        cmocka_unit_test(what_is_too_large_is_told_by_the_limit),
    };
    return cmocka_run_group_tests(tests, make_pixels, NULL);
}
