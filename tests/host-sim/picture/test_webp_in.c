/* webp_in: pictures that libwebp's lossless encoder made, with alpha and without, come back; broken ones do not. */
#include "picture_in.h"

#include <stdlib.h>
#include <string.h>

#include <webp/encode.h> /* tests/run.sh skips this program where the library is not installed */

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

enum { WIDTH = 7, HEIGHT = 5 };

static uint8_t pixels[WIDTH * HEIGHT * 4], *file;
static size_t size;

static void make(bool has_alpha)
{
    for (size_t i = 0; i < sizeof pixels; i++) {
        pixels[i] = (uint8_t)(i * 37 % 251 + 3);
    }
    WebPFree(file);
    size = has_alpha ? WebPEncodeLosslessRGBA(pixels, WIDTH, HEIGHT, WIDTH * 4, &file)
                     : WebPEncodeLosslessRGB(pixels, WIDTH, HEIGHT, WIDTH * 3, &file);
    assert_true(size > 0);
}

static void every_pixel_comes_back(void **state)
{
    (void)state;
    for (int has_alpha = 0; has_alpha < 2; has_alpha++) {
        struct picture_in in = {.most = PPM_SIDE_MAX};
        make(has_alpha != 0);
        assert_null(picture_in_memory(&in, file, size));
        assert_true(in.picture.width == WIDTH && in.picture.height == HEIGHT && (in.alpha != NULL) == has_alpha);
        for (size_t i = 0; i < (size_t)WIDTH * HEIGHT; i++) {
            const uint8_t *expected = pixels + i * (has_alpha ? 4 : 3);
            assert_memory_equal(in.picture.rgb + 3 * i, expected, 3);
            assert_true(!has_alpha || in.alpha[i] == expected[3]);
        }
        picture_in_free(&in);
    }
}

static void what_is_cut_off_is_refused(void **state)
{
    (void)state;
    make(true);
    for (size_t n = 12; n < size; n++) {
        struct picture_in in = {.most = PPM_SIDE_MAX};
        uint8_t *copy = malloc(n);
        memcpy(copy, file, n);
        assert_string_equal(picture_in_memory(&in, copy, n), webp_in_reason);
        free(copy);
    }
}

static void a_picture_of_too_many_pixels_is_refused(void **state)
{
    (void)state;
    struct picture_in in = {.most = PPM_SIDE_MAX, .most_pixels = WIDTH * HEIGHT - 1};
    make(false);
    assert_string_equal(picture_in_memory(&in, file, size), "has too many pixels");
}

static void an_animation_is_refused(void **state)
{
    static const uint8_t animation[] = "RIFF\x16\0\0\0WEBPVP8X\x0A\0\0\0\x02\0\0\0\0\0\0\0\0";
    struct picture_in in = {.most = PPM_SIDE_MAX};
    (void)state;
    assert_string_equal(picture_in_memory(&in, animation, sizeof animation), webp_in_reason);
}

static int end(void **state)
{
    (void)state;
    WebPFree(file);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_pixel_comes_back),
        cmocka_unit_test(what_is_cut_off_is_refused),
        cmocka_unit_test(a_picture_of_too_many_pixels_is_refused),
        cmocka_unit_test(an_animation_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, end);
}
