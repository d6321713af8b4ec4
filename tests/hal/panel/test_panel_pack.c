/* panel_pack: pixels as the controllers' data sheets draw them on the wire, bit by bit, for all sizes of scratch
 * memory; grey levels against doubles. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "panel_pack.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- a bus that keeps the bytes ------------------------------------------------------------------------------------
 */

static uint8_t wire[4096];
static size_t sent, longest;
static int fails_after; /* writes; below 0: never */
static struct panel_driver d;
static uint8_t scratch[300];
static const uint8_t *before; /* the half that was written last */

static int bus_write(void *context, enum hal_dc dc, const uint8_t *bytes, size_t n)
{
    (void)context;
    assert_int_equal(dc, HAL_DATA);
    assert_true(n > 0 && sent + n <= sizeof wire);
    assert_true(bytes >= scratch && bytes + n <= scratch + d.config.scratch_bytes);
    assert_true(bytes != before); /* it may still be on the wire */
    before = bytes;
    memcpy(wire + sent, bytes, n);
    sent += n;
    longest = n > longest ? n : longest;
    return fails_after-- == 0 ? HAL_EIO : HAL_OK;
}

static const struct hal_ops bus = {.bus_write = bus_write};

/* ---- a panel -------------------------------------------------------------------------------------------------------
 */

static struct panel_controller one = {.column_pixels = 1, .window_turns = true}, two = {.column_pixels = 2};
static struct panel panel;

static int start(struct panel_controller *controller, unsigned x0, unsigned format, unsigned rotation, size_t bytes)
{
    panel = (struct panel){
        .controller = controller, .width = 8, .height = 6, .ram_width = 16, .ram_height = 8, .x0 = (uint16_t)x0};
    d = (struct panel_driver){.hal = {&bus, NULL},
                              .config = {&panel, (uint8_t)rotation, (uint8_t)format, 1, scratch, bytes},
                              .width = panel_width(&panel, rotation),
                              .height = panel_height(&panel, rotation)};
    sent = longest = 0;
    before = NULL;
    fails_after = -1;
    memset(scratch, 0xa5, sizeof scratch);
    return panel_pack_init(&d);
}

/* Pixel (x, y) of the picture, as two bytes. */
static void pixel_of(uint32_t x, uint32_t y, uint8_t bytes[2])
{
    const uint32_t random = (x * 40503 + y * 30011 + 7) * 2654435761U;
    bytes[0] = (uint8_t)(random >> 24), bytes[1] = (uint8_t)(random >> 16);
}

static void send_window(uint32_t x, uint32_t y, uint32_t width, uint32_t height)
{
    d.x = (uint16_t)x, d.span = (uint16_t)width, d.bottom = (uint16_t)(y + height);
    for (d.row = (uint16_t)y; d.row < d.bottom; d.row++) {
        uint8_t line[32];
        for (uint32_t i = 0; i < width; i++) {
            pixel_of(x + i, d.row, line + 2 * i);
        }
        assert_int_equal(panel_pack_line(&d, line), HAL_OK);
    }
    assert_int_equal(panel_pack_end(&d), HAL_OK);
}

/* ---- what is expected, as a row of bits
 * ------------------------------------------------------------------------------ */

static uint8_t bits[8192];
static size_t bit_count;

static void put(uint32_t value, int n)
{
    while (n-- > 0) {
        bits[bit_count++] = value >> n & 1;
    }
}

static void expect_bits(void)
{
    assert_int_equal(sent, (bit_count + 7) / 8);
    for (size_t i = 0; i < bit_count; i++) {
        assert_int_equal(wire[i / 8] >> (7 - i % 8) & 1, bits[i]);
    }
}

/* The channels of a colour as fractions of their most. */
static void channels_of(uint32_t x, uint32_t y, uint32_t c[3])
{
    uint8_t b[2];
    pixel_of(x, y, b);
    const uint32_t word = (uint32_t)b[0] * 256 + b[1];
    c[0] = word / 2048, c[1] = word / 32 % 64, c[2] = word % 32;
}

static void put_colour(unsigned format, uint32_t x, uint32_t y)
{
    uint32_t c[3];
    channels_of(x, y, c);
    if (format == PANEL_RGB565) {
        put(c[0], 5), put(c[1], 6), put(c[2], 5);
    } else if (format == PANEL_RGB444) {
        put(c[0] / 2, 4), put(c[1] / 4, 4), put(c[2] / 2, 4);
    } else { /* five bits become six of the same share of the most: 2 c, and 1 more in the upper half */
        put(2 * c[0] + c[0] / 16, 6), put(0, 2), put(c[1], 6), put(0, 2), put(2 * c[2] + c[2] / 16, 6), put(0, 2);
    }
}

static void colours_are_packed_as_the_data_sheets_show_them(void **state)
{
    static const unsigned formats[] = {PANEL_RGB565, PANEL_RGB666, PANEL_RGB444};
    static const size_t sizes[] = {256, 257, 299};
    (void)state;
    for (int i = 0; i < 9; i++) {
        const unsigned format = formats[i % 3];
        assert_int_equal(start(&one, 0, format, PANEL_R0, sizes[i / 3]), HAL_OK);
        for (int window = 0; window < 2; window++) { /* a whole one, and one of 7 pixels */
            const uint32_t x = window == 0 ? 0 : 1, width = window == 0 ? 8 : 7, rows = window == 0 ? 6 : 1;
            bit_count = sent = 0;
            d.frame_bytes = 0;
            send_window(x, 0, width, rows);
            for (uint32_t k = 0; k < width * rows; k++) {
                put_colour(format, x + k % width, k / width);
            }
            expect_bits();
            assert_int_equal(d.frame_bytes, sent);
            assert_true(longest <= sizes[i / 3] / 2);
        }
        assert_int_equal(wire[sent - 1] & 15,
                         format == PANEL_RGB444 ? 0 : wire[sent - 1] & 15); /* four bits are left */
    }
}

/* The smallest scratch memory takes a pixel or two at a time. */
static void scratch_memory_is_halved_and_may_be_tiny(void **state)
{
    static const struct {
        struct panel_controller *controller;
        unsigned format, rotation;
        size_t bytes;
        int status;
        uint32_t half;
    } cases[] = {{&one, PANEL_RGB666, PANEL_R0, 5, HAL_EINVAL, 0},
                 {&one, PANEL_RGB666, PANEL_R0, 6, HAL_OK, 3},
                 {&one, PANEL_RGB444, PANEL_R0, 9, HAL_OK, 4},
                 {&two, PANEL_GREY4, PANEL_R0, 6, HAL_OK, 3},
                 {&two, PANEL_GREY4, PANEL_R90, 11, HAL_EINVAL, 0},
                 {&two, PANEL_GREY4, PANEL_R90, 12, HAL_OK, 3}, /* 6 are kept */
                 {&two, PANEL_GREY4, PANEL_R180, 6, HAL_OK, 3},
                 {&one, PANEL_GREY4, PANEL_R90, 6, HAL_OK, 3},
                 {&one, PANEL_RGB565, PANEL_R0, 255, HAL_OK, 0},
                 {&one, PANEL_RGB565, PANEL_R0, 256, HAL_OK, 128},
                 {&two, PANEL_GREY4, PANEL_R270, 300, HAL_OK, 147}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        assert_int_equal(start(cases[i].controller, 0, cases[i].format, cases[i].rotation, cases[i].bytes),
                         cases[i].status);
        assert_int_equal(d.half_bytes, cases[i].half);
        assert_int_equal(d.share_y,
                         cases[i].format == PANEL_GREY4 && cases[i].controller == &two && cases[i].rotation % 2 == 1);
        if (cases[i].half > 0 && cases[i].format != PANEL_GREY4) {
            bit_count = 0;
            send_window(2, 1, 5, 2);
            for (uint32_t k = 0; k < 10; k++) {
                put_colour(cases[i].format, 2 + k % 5, 1 + k / 5);
            }
            expect_bits();
            assert_true(longest <= cases[i].half);
        }
    }
    assert_int_equal(start(&one, 0, PANEL_RGB565, PANEL_R0, 300), HAL_OK);
    d.config.scratch = NULL;
    d.half_bytes = 0;
    assert_int_equal(panel_pack_init(&d), HAL_OK);
    assert_int_equal(d.half_bytes, 0);
}

/* The luma of channels of 8 bits, to 15 parts, dithered by Bayer's matrix of order 4 (Bayer 1973): more than its
 * threshold (2 b + 1) / 32 of a level goes up. */
static void grey_is_luma_dithered_by_bayers_matrix(void **state)
{
    static const int bayer2[2][2] = {{0, 2}, {3, 1}};
    uint32_t ups = 0;
    (void)state;
    for (uint32_t i = 0; i < 65536 / 7 * 16; i++) {
        const uint32_t word = i / 16 * 7, r = word / 2048, g = word / 32 % 64, b = word % 32, x = i % 4, y = i / 4 % 4;
        const uint32_t r8 = r * 8 + r / 4, g8 = g * 4 + g / 16, b8 = b * 8 + b / 4;
        const double luma = floor((77 * r8 + 150 * g8 + 29 * b8) / 256.0), level = 15 * luma / 255;
        const int rank = 4 * bayer2[y % 2][x % 2] + bayer2[y / 2][x / 2];
        const double up = level - floor(level) > (2 * rank + 1) / 32.0;
        assert_int_equal(panel_grey4((uint8_t)(word >> 8), (uint8_t)word, x + 4 * (word % 3), y + 8),
                         floor(level) + up);
        ups += up > 0;
    }
    assert_true(ups > 1000);
    assert_int_equal(panel_grey4(0, 0, 1, 1), 0);
    assert_int_equal(panel_grey4(255, 255, 0, 3), 15);
}

static uint8_t grey_at(uint32_t x, uint32_t y)
{
    uint8_t b[2];
    pixel_of(x, y, b);
    return panel_grey4(b[0], b[1], x, y);
}

/* The left pixel is in the high bits, and each line begins a byte. A glass that begins at an odd column has a neighbour
 * outside of it, which stays black. */
static void upright_grey_begins_each_line_with_a_byte(void **state)
{
    static const struct {
        unsigned x0, x, width;
    } cases[] = {{0, 0, 8}, {0, 2, 4}, {2, 0, 8}, {1, 0, 8}, {1, 1, 7}, {1, 0, 3}, {3, 3, 2}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0] * 2; i++) {
        const unsigned x0 = cases[i / 2].x0, x = cases[i / 2].x, width = cases[i / 2].width;
        assert_int_equal(start(&two, x0, PANEL_GREY4, PANEL_R0, i % 2 == 0 ? 8 : 256), HAL_OK);
        assert_int_equal(d.lead, x0 % 2);
        bit_count = 0;
        send_window(x, 1, width, 3);
        for (uint32_t y = 1; y < 4; y++) {
            if (x0 % 2 == 1 && x == 0) {
                put(0, 4);
            }
            for (uint32_t k = 0; k < width; k++) {
                put(grey_at(x + k, y), 4);
            }
            put(0, bit_count % 8 == 4 ? 4 : 0);
        }
        expect_bits();
    }
}

/* Turned by a quarter two lines share bytes: the upper one has the high bits. With x0 = 1 the first line shares its
 * bytes with nothing, and the last one, too. */
static void turned_grey_pairs_lines(void **state)
{
    static const struct {
        unsigned x0, y, height;
    } cases[] = {{0, 0, 8}, {0, 2, 4}, {1, 0, 8}, {1, 1, 2}, {1, 0, 1}, {1, 7, 1}, {1, 5, 3}, {0, 6, 2}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0] * 2; i++) {
        const unsigned x0 = cases[i / 2].x0, first = cases[i / 2].y, behind = first + cases[i / 2].height;
        assert_int_equal(start(&two, x0, PANEL_GREY4, PANEL_R90, i % 2 == 0 ? 13 : 256), HAL_OK);
        assert_int_equal(d.lead, x0);
        bit_count = 0;
        send_window(1, first, 4, behind - first);
        for (uint32_t y = first; y < behind; y += (y + x0) % 2 == 0 ? 2 : 1) {
            for (uint32_t x = 1; x < 5; x++) {
                const bool is_low = (y + x0) % 2 == 1;
                put(is_low ? 0 : grey_at(x, y), 4);
                put(is_low ? grey_at(x, y) : y + 1 < behind ? grey_at(x, y + 1) : 0, 4);
            }
        }
        expect_bits();
    }
}

static void an_error_of_the_bus_is_returned(void **state)
{
    uint8_t line[32] = {0};
    (void)state;
    for (int n = 0; n < 2; n++) {
        assert_int_equal(start(&one, 0, PANEL_RGB666, PANEL_R0, 12), HAL_OK);
        d.span = 8;
        fails_after = n;
        assert_int_equal(panel_pack_line(&d, line), HAL_EIO);
        assert_int_equal(sent, 6 * (n + 1)); /* nothing follows */
    }
    assert_int_equal(start(&one, 0, PANEL_RGB666, PANEL_R0, 64), HAL_OK);
    d.span = 8;
    assert_int_equal(panel_pack_line(&d, line), HAL_OK);
    fails_after = 0;
    assert_int_equal(panel_pack_end(&d), HAL_EIO);
    assert_int_equal(panel_pack_end(&d), HAL_OK); /* and nothing is left */
    assert_int_equal(sent, 24);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(colours_are_packed_as_the_data_sheets_show_them),
        cmocka_unit_test(scratch_memory_is_halved_and_may_be_tiny),
        cmocka_unit_test(grey_is_luma_dithered_by_bayers_matrix),
        cmocka_unit_test(upright_grey_begins_each_line_with_a_byte),
        cmocka_unit_test(turned_grey_pairs_lines),
        cmocka_unit_test(an_error_of_the_bus_is_returned),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
