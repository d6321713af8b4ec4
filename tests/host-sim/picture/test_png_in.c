/* png_in: every kind of PNG that its standard has, of every small size, interlaced or not; and broken ones. The files
 * are written by libpng; what their pixels mean is computed here. */
#include "picture_in.h"

#include <png.h> /* tests/run.sh skips this program where the library is not installed */
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <cmocka.h>

enum { SIDE = 9, ROW = SIDE * 8 };

static uint8_t file[16384];
static size_t size;

static void append(png_structp png, png_bytep from, size_t n)
{
    (void)png;
    assert_true(size + n <= sizeof file);
    memcpy(file + size, from, n);
    size += n;
}

struct kind {
    int type, depth;
    bool has_key; /* a transparent colour: of a palette the first two entries, else that of the first pixel */
};

/* Byte i of the rows as the file has them; of a palette each number names one of its entries. */
static uint8_t raw(const struct kind *kind, uint32_t y, uint32_t i)
{
    const uint8_t byte = (uint8_t)(31 * y + 57 * i + 3 * y * i + 1);
    return kind->type == PNG_COLOR_TYPE_PALETTE && kind->depth == 8 ? byte % 16 : byte;
}

static png_color entry(unsigned i)
{
    return (png_color){(png_byte)(13 * i), (png_byte)(255 - 9 * i), (png_byte)(i * i)};
}

/* Number c of pixel x, as the file has it. */
static uint32_t sample(const struct kind *kind, uint32_t y, uint32_t x, uint32_t c, uint32_t channels)
{
    const uint32_t bit = (x * channels + c) * (uint32_t)kind->depth, at = bit / 8;
    if (kind->depth == 16) {
        return (uint32_t)raw(kind, y, at) << 8 | raw(kind, y, at + 1);
    }
    return (uint32_t)raw(kind, y, at) >> (8 - (uint32_t)kind->depth - bit % 8) & ((1u << kind->depth) - 1);
}

static uint32_t channels_of(const struct kind *kind)
{
    return kind->type == PNG_COLOR_TYPE_RGB          ? 3
           : kind->type == PNG_COLOR_TYPE_RGBA       ? 4
           : kind->type == PNG_COLOR_TYPE_GRAY_ALPHA ? 2
                                                     : 1;
}

static void write_file(const struct kind *kind, uint32_t width, uint32_t height, int interlace)
{
    static uint8_t bytes[SIDE][ROW];
    static const png_byte clear[2] = {0, 100};
    png_bytep rows[SIDE];
    png_color palette[16];
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png);
    size = 0;
    for (uint32_t y = 0; y < SIDE; y++) {
        rows[y] = bytes[y];
        for (uint32_t i = 0; i < ROW; i++) {
            bytes[y][i] = raw(kind, y, i);
        }
    }
    for (unsigned i = 0; i < 16; i++) {
        palette[i] = entry(i);
    }
    png_set_write_fn(png, NULL, append, NULL);
    png_set_IHDR(png, info, width, height, kind->depth, kind->type, interlace, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    if (kind->type == PNG_COLOR_TYPE_PALETTE) {
        png_set_PLTE(png, info, palette, kind->depth == 8 ? 16 : 1 << kind->depth);
    }
    if (kind->has_key) {
        const png_color_16 key = {.gray = (png_uint_16)sample(kind, 0, 0, 0, 1),
                                  .red = (png_uint_16)sample(kind, 0, 0, 0, 3),
                                  .green = (png_uint_16)sample(kind, 0, 0, 1, 3),
                                  .blue = (png_uint_16)sample(kind, 0, 0, 2, 3)};
        png_set_tRNS(png, info, clear, 2, &key);
    }
    png_set_rows(png, info, rows);
    png_write_png(png, info, PNG_TRANSFORM_IDENTITY, NULL);
    png_destroy_write_struct(&png, &info);
}

/* A number of so many bits as one of 8, rounded to nearest. */
static uint8_t of_8(uint32_t value, int depth)
{
    const uint32_t most = (1u << depth) - 1;
    return (uint8_t)((value * 255 + most / 2) / most);
}

static void expect_pixel(const struct picture_in *in, const struct kind *kind, uint32_t x, uint32_t y)
{
    const uint32_t n = channels_of(kind);
    const bool is_grey = n < 3, has_alpha = n == 2 || n == 4;
    uint8_t want[4] = {0, 0, 0, 255};
    bool is_key = kind->has_key;
    for (uint32_t c = 0; c < 3; c++) {
        const uint32_t value = sample(kind, y, x, is_grey ? 0 : c, n);
        want[c] = of_8(value, kind->depth);
        is_key = is_key && value == sample(kind, 0, 0, is_grey ? 0 : c, n);
    }
    if (kind->type == PNG_COLOR_TYPE_PALETTE) {
        const uint32_t i = sample(kind, y, x, 0, 1);
        const png_color colour = entry(i);
        memcpy(want, (const uint8_t[3]){colour.red, colour.green, colour.blue}, 3);
        want[3] = !kind->has_key || i > 1 ? 255 : i == 0 ? 0 : 100;
    } else {
        want[3] = has_alpha ? of_8(sample(kind, y, x, n - 1, n), kind->depth) : is_key ? 0 : 255;
    }
    const uint32_t at = y * in->width + x;
    assert_memory_equal(in->picture.rgb + (size_t)3 * at, want, 3);
    assert_int_equal(in->alpha != NULL, has_alpha || kind->has_key);
    assert_int_equal(in->alpha != NULL ? in->alpha[at] : 255, want[3]);
}

static void every_kind_of_every_size_is_read(void **state)
{
    static const struct kind kinds[] = {{PNG_COLOR_TYPE_GRAY, 1, false},       {PNG_COLOR_TYPE_GRAY, 2, false},
                                        {PNG_COLOR_TYPE_GRAY, 4, true},        {PNG_COLOR_TYPE_GRAY, 8, false},
                                        {PNG_COLOR_TYPE_GRAY, 16, false},      {PNG_COLOR_TYPE_RGB, 8, false},
                                        {PNG_COLOR_TYPE_RGB, 8, true},         {PNG_COLOR_TYPE_RGB, 16, false},
                                        {PNG_COLOR_TYPE_PALETTE, 1, false},    {PNG_COLOR_TYPE_PALETTE, 2, true},
                                        {PNG_COLOR_TYPE_PALETTE, 4, false},    {PNG_COLOR_TYPE_PALETTE, 8, true},
                                        {PNG_COLOR_TYPE_GRAY_ALPHA, 8, false}, {PNG_COLOR_TYPE_GRAY_ALPHA, 16, false},
                                        {PNG_COLOR_TYPE_RGBA, 8, false},       {PNG_COLOR_TYPE_RGBA, 16, false}};
    (void)state;
    for (size_t k = 0; k < sizeof kinds / sizeof kinds[0]; k++) {
        for (uint32_t i = 0; i < SIDE * SIDE * 2; i++) {
            const uint32_t width = i / 2 % SIDE + 1, height = i / 2 / SIDE + 1;
            struct picture_in in = {.most = PPM_SIDE_MAX};
            write_file(&kinds[k], width, height, i % 2 == 0 ? PNG_INTERLACE_NONE : PNG_INTERLACE_ADAM7);
            assert_null(picture_in_memory(&in, file, size));
            assert_true(in.width == width && in.height == height);
            for (uint32_t at = 0; at < width * height; at++) {
                expect_pixel(&in, &kinds[k], at % width, at / width);
            }
            picture_in_free(&in);
        }
    }
}

/* Cut off anywhere before its last chunk, or with a bit of its data changed. */
static void what_is_broken_is_refused(void **state)
{
    static const struct kind kind = {PNG_COLOR_TYPE_RGB, 8, false};
    (void)state;
    for (int interlace = 0; interlace < 2; interlace++) {
        write_file(&kind, SIDE, SIDE, interlace);
        for (size_t n = 8; n < size - 16; n++) {
            struct picture_in in = {.most = SIDE};
            uint8_t *const part = malloc(n);
            assert_non_null(part);
            memcpy(part, file, n);
            assert_false(png_in_memory(&in, part, n));
            free(part);
            picture_in_free(&in);
            in = (struct picture_in){.most = SIDE};
            file[n] ^= 4;
            assert_false(png_in_memory(&in, file, size));
            picture_in_free(&in);
            file[n] ^= 4;
        }
    }
}

static void what_has_too_many_pixels_is_refused(void **state)
{
    static const struct kind kind = {PNG_COLOR_TYPE_RGB, 8, false};
    (void)state;
    write_file(&kind, SIDE, SIDE, 0);
    struct picture_in in = {.most = SIDE, .most_pixels = SIDE * SIDE - 1};
    assert_false(png_in_memory(&in, file, size));
    assert_non_null(in.why);
    picture_in_free(&in);
    in = (struct picture_in){.most = SIDE, .most_pixels = SIDE * SIDE};
    assert_true(png_in_memory(&in, file, size));
    picture_in_free(&in);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_kind_of_every_size_is_read),
        cmocka_unit_test(what_is_broken_is_refused),
        cmocka_unit_test(what_has_too_many_pixels_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
