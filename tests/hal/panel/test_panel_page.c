/* panel_page: bytes of pages as the data sheets draw them, in windows and turned; the dither's matrix, made anew. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "blue_noise.h"
#include "panel_page.h"
#include "panels.h"

#include <math.h>
#include <string.h>

/* ---- a bus that keeps what is sent --------------------------------------------------------------- */

static uint8_t glass[8][128]; /* bytes by page and column */
static uint8_t address[3];
static uint32_t bytes, pieces;
static const uint8_t *before;
static int fails_after;

static int bus_write(void *context, enum hal_dc dc, const uint8_t *from, size_t n)
{
    (void)context;
    if (fails_after-- == 0) {
        return HAL_EIO;
    }
    if (dc == HAL_COMMAND) { /* B0h page, 00h and 10h column */
        assert_int_equal(n, 3);
        memcpy(address, from, 3);
        assert_true(address[0] >> 4 == 0xB && address[1] >> 4 == 0 && address[2] >> 4 == 1);
        return HAL_OK;
    }
    const uint32_t column = (address[1] & 15U) | (address[2] & 15U) << 4;
    assert_true((address[0] & 15) < 8 && column + n <= 128);
    assert_ptr_not_equal(from, before); /* it may still be on the wire */
    before = from;
    memcpy(&glass[address[0] & 15][column], from, n);
    bytes += (uint32_t)n + 3;
    pieces++;
    return HAL_OK;
}

static const struct hal_ops bus = {.bus_write = bus_write};
static struct panel_driver d;
static uint8_t scratch[300];
static struct panel panel;

static int start(unsigned rotation, size_t scratch_bytes)
{
    panel = panel_ssd1306_128x64;
    panel.rotation_base = 0;
    d = (struct panel_driver){.hal = {&bus, NULL},
                              .config = {&panel, (uint8_t)rotation, PANEL_MONO_THRESHOLD, 1, scratch, scratch_bytes},
                              .width = panel_width(&panel, rotation),
                              .height = panel_height(&panel, rotation)};
    memset(glass, 0, sizeof glass);
    memset(scratch, 0xA5, sizeof scratch);
    bytes = pieces = 0;
    before = NULL;
    fails_after = -1;
    return panel_page_init(&d);
}

static bool is_lit(uint32_t x, uint32_t y)
{
    return ((x * 40503 + y * 30011 + 7) * 2654435761U) >> 31;
}

static int send_window(uint32_t x, uint32_t y, uint32_t width, uint32_t height)
{
    int status = HAL_OK;
    d.x = (uint16_t)x, d.span = (uint16_t)width, d.bottom = (uint16_t)(y + height);
    d.filled = 0;
    for (d.row = (uint16_t)y; d.row < d.bottom && status >= 0; d.row++) {
        uint8_t line[256];
        for (uint32_t i = 0; i < width; i++) {
            memset(line + 2 * i, is_lit(x + i, d.row) ? 255 : 0, 2);
        }
        status = panel_page_line(&d, line);
    }
    return status;
}

/* Whether all of the picture's pixels in the window, and no other, are on the glass. Turned, column and row change
 * places: mirrors are the controller's. */
static void expect_window(uint32_t x, uint32_t y, uint32_t width, uint32_t height)
{
    const bool turned = d.config.rotation % 2 == 1;
    for (uint32_t row = 0; row < 64; row++) {
        for (uint32_t column = 0; column < 128; column++) {
            const uint32_t px = turned ? row : column, py = turned ? column : row;
            const bool inside = px >= x && px < x + width && py >= y && py < y + height;
            assert_int_equal(glass[row / 8][column] >> row % 8 & 1, inside && is_lit(px, py));
        }
    }
    assert_int_equal(d.frame_bytes, bytes);
}

static void eight_lines_make_a_page(void **state)
{
    (void)state;
    for (unsigned rotation = PANEL_R0; rotation <= PANEL_R180; rotation += 2) {
        assert_int_equal(start(rotation, 256), HAL_OK);
        assert_true(d.share_x == 0 && d.share_y == 3);
        assert_int_equal(send_window(0, 0, 128, 64), HAL_OK);
        expect_window(0, 0, 128, 64);
        assert_int_equal(bytes, 8 * (128 + 3));
        assert_int_equal(start(rotation, 299), HAL_OK);
        assert_int_equal(send_window(5, 16, 1, 24), HAL_OK);
        expect_window(5, 16, 1, 24);
        assert_int_equal(pieces, 3);
    }
}

static void a_turned_line_is_a_column_of_all_pages(void **state)
{
    (void)state;
    for (unsigned rotation = PANEL_R90; rotation <= PANEL_R270; rotation += 2) {
        assert_int_equal(start(rotation, 256), HAL_OK);
        assert_true(d.share_x == 3 && d.share_y == 0);
        assert_int_equal(send_window(0, 0, 64, 128), HAL_OK);
        expect_window(0, 0, 64, 128);
        assert_int_equal(bytes, 16 * 8 * (8 + 3));
        assert_int_equal(start(rotation, 128), HAL_OK);
        assert_int_equal(send_window(8, 3, 16, 50), HAL_OK); /* 2 pages, of which 32 lines fit into a half */
        expect_window(8, 3, 16, 50);
        assert_int_equal(pieces, 4);
    }
}

static void the_glass_lies_where_its_table_says(void **state)
{
    (void)state;
    assert_int_equal(start(PANEL_R0, 256), HAL_OK);
    panel.ram_width = 132;
    panel.x0 = 2;
    panel.width = 96;
    panel.height = 48;
    panel.y0 = 16;
    d.width = 96;
    assert_int_equal(send_window(0, 8, 3, 8), HAL_OK);
    assert_true(address[0] == 0xB3 && address[1] == 2 && address[2] == 0x10);
    d.config.rotation = PANEL_R180; /* 132 - 96 - 2 columns and 64 - 48 - 16 rows are left on the other side */
    assert_int_equal(send_window(0, 8, 3, 8), HAL_OK);
    assert_true(address[0] == 0xB1 && address[1] == 2 && address[2] == 0x12);
}

static void what_is_no_page_is_refused(void **state)
{
    (void)state;
    assert_int_equal(start(PANEL_R0, 255), HAL_EINVAL);
    assert_int_equal(start(PANEL_R90, 127), HAL_EINVAL);
    uint16_t *const sizes[] = {&panel.width, &panel.height, &panel.ram_height, &panel.y0};
    for (int i = 0; i < 4; i++) {
        assert_int_equal(start(PANEL_R0, 256), HAL_OK);
        *sizes[i] = (uint16_t)(*sizes[i] + 4);
        assert_int_equal(panel_page_init(&d), HAL_EINVAL);
    }
}

static void an_error_of_the_bus_is_told(void **state)
{
    (void)state;
    for (int writes = 0; writes < 4; writes++) {
        assert_int_equal(start(PANEL_R90, 256), HAL_OK);
        fails_after = writes;
        assert_int_equal(send_window(0, 0, 64, 8), HAL_EIO);
    }
}

/* The share of lit pixels is the square of the luma, which is what the eye makes of it. */
static void the_matrix_is_made_by_void_and_cluster(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < 64; i++) {
        const uint32_t x = i % 8, y = i / 8, rank = blue_noise_rank(x, y);
        for (uint32_t grey = 0; grey < 32; grey++) {
            const uint32_t green = 2 * grey + grey / 16, word = grey << 11 | green << 5 | grey;
            const double luma = floor((106 * floor(8.25 * grey) + 150 * floor(4.0625 * green)) / 256);
            const uint8_t high = (uint8_t)(word >> 8), low = (uint8_t)word;
            const double share = luma * luma / (255.0 * 255.0);
            const bool lit = share > (rank + 0.5) / 64;
            assert_int_equal(panel_mono(PANEL_MONO_DITHER, high, low, x, y), lit);
            assert_int_equal(panel_mono(PANEL_MONO_DITHER, high, low, x + 64, y + 8), lit);
            assert_int_equal(panel_mono(PANEL_MONO_THRESHOLD, high, low, x, y), grey >= 16);
        }
    }
}

/* Every colour, by the definition of its luma. */
static void a_half_and_more_is_lit(void **state)
{
    (void)state;
    unsigned halves = 0;
    for (uint32_t word = 0; word < 0x10000; word++) {
        const double red = floor(8.25 * (word >> 11)), green = floor(4.0625 * (word >> 5 & 63)),
                     blue = floor(8.25 * (word & 31)), luma = floor((77 * red + 150 * green + 29 * blue) / 256);
        halves += luma == 128;
        assert_int_equal(panel_mono(PANEL_MONO_THRESHOLD, (uint8_t)(word >> 8), (uint8_t)word, 1, 2), luma > 127.5);
    }
    assert_true(halves > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(eight_lines_make_a_page),
        cmocka_unit_test(a_turned_line_is_a_column_of_all_pages),
        cmocka_unit_test(the_glass_lies_where_its_table_says),
        cmocka_unit_test(what_is_no_page_is_refused),
        cmocka_unit_test(an_error_of_the_bus_is_told),
        cmocka_unit_test(a_half_and_more_is_lit),
        cmocka_unit_test(the_matrix_is_made_by_void_and_cluster),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
