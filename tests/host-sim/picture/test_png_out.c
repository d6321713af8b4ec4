/* png_out: the chunks of the file by PNG's standard, and its pixels read back by libpng's own reader of files. */
#include "crc32.h"
#include "png_out.h"

#include <png.h> /* tests/run.sh skips this program where the library is not installed */
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <cmocka.h>

static uint32_t u32(const uint8_t *at)
{
    return (uint32_t)at[0] << 24 | (uint32_t)at[1] << 16 | (uint32_t)at[2] << 8 | at[3];
}

/* Makes a picture of noise, and its file. free() both. */
static uint8_t *make(struct ppm *picture, uint32_t width, uint32_t height, size_t *n)
{
    uint32_t seed = width * 7 + height;
    *picture = (struct ppm){width, height, malloc((size_t)width * height * 3)};
    assert_non_null(picture->rgb);
    for (size_t i = 0; i < (size_t)width * height * 3; i++) {
        seed = seed * 1664525 + 1013904223;
        picture->rgb[i] = (uint8_t)(seed >> 24);
    }
    uint8_t *const bytes = png_out_bytes(picture, n);
    assert_non_null(bytes);
    return bytes;
}

/* IHDR, IDAT.., IEND, each with its CRC, and no other chunk that a reader must know. */
static void expect_chunks(const uint8_t *bytes, size_t n, const struct ppm *picture)
{
    assert_memory_equal(bytes, "\x89PNG\r\n\x1a\n", 8);
    assert_memory_equal(bytes + 12, "IHDR", 4);
    assert_int_equal(u32(bytes + 8), 13);
    assert_int_equal(u32(bytes + 16), picture->width);
    assert_int_equal(u32(bytes + 20), picture->height);
    assert_memory_equal(bytes + 24, "\10\2\0\0\0", 5); /* 8 bits, RGB, not interlaced */
    size_t at = 8;
    for (unsigned i = 0; at + 12 <= n; i++) {
        const uint32_t length = u32(bytes + at);
        assert_true(length <= n - at - 12);
        const bool is_last = at + 12 + length == n;
        if (i == 0 || is_last || (bytes[at + 4] & 0x20) == 0) { /* else it is one that a reader may pass over */
            assert_memory_equal(bytes + at + 4, i == 0 ? "IHDR" : is_last ? "IEND" : "IDAT", 4);
        }
        assert_int_equal(crc32_update(0, bytes + at + 4, length + 4), u32(bytes + at + 8 + length));
        at += 12 + length;
    }
    assert_int_equal(at, n);
}

static void a_picture_is_in_its_file(void **state)
{
    /* rows of 3 w + 1 bytes: also at the border of blocks of 65535, and of several of them */
    static const uint32_t sides[][2] = {{1, 1}, {37, 21}, {28, 771}, {28, 772}, {300, 200}, {1, 1024}, {1024, 1}};
    (void)state;
    for (size_t i = 0; i < sizeof sides / sizeof sides[0]; i++) {
        struct ppm picture;
        size_t n = 0;
        uint8_t *const bytes = make(&picture, sides[i][0], sides[i][1], &n);
        expect_chunks(bytes, n, &picture);
        png_image image = {.version = PNG_IMAGE_VERSION};
        assert_true(png_image_begin_read_from_memory(&image, bytes, n));
        assert_true(image.width == picture.width && image.height == picture.height);
        image.format = PNG_FORMAT_RGB;
        const size_t size = PNG_IMAGE_SIZE(image);
        uint8_t *const seen = malloc(size);
        assert_non_null(seen);
        assert_true(png_image_finish_read(&image, NULL, seen, 0, NULL));
        assert_memory_equal(seen, picture.rgb, size);
        free(seen);
        free(bytes);
        free(picture.rgb);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_picture_is_in_its_file),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
