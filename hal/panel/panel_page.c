/*
 * See panel_page.h. One half of the scratch memory is filled with bytes while the other is on the wire, as in
 * panel_pack.c. A byte has 8 pixels of a column of the glass, the upper one in bit 0.
 *
 * Upright (and turned by 180) 8 lines of the picture are a page: a line adds one bit to each byte of the half. Turned
 * by 90 or 270 a line is a column of the glass, which crosses the pages: it gives each of them a byte. As many lines
 * are collected as the half has room for, so that each page gets them in one piece.
 */
#include "panel_page.h"

#include <string.h>

enum { PAGE_ROWS_LOG2 = 3, PAGE_ROWS = 8 };

/* Ranks 0 .. 63 by the void-and-cluster method; tests/hal/panel/test_panel_page.c makes them anew. */
static const uint8_t blue_noise8[8][8] = {
    {3, 20, 56, 16, 41, 7, 58, 24},   {62, 32, 47, 5, 50, 30, 44, 14},  {36, 8, 28, 18, 60, 21, 1, 48},
    {10, 43, 54, 39, 12, 34, 55, 26}, {61, 22, 2, 25, 49, 9, 40, 17},   {51, 33, 46, 15, 63, 31, 45, 4},
    {29, 6, 59, 37, 0, 23, 57, 19},   {52, 42, 11, 27, 53, 35, 13, 38},
};

bool panel_mono(unsigned format, uint8_t high, uint8_t low, uint32_t x, uint32_t y)
{
    const uint32_t luma = panel_luma(high, low);
    const uint32_t level = 2U * blue_noise8[y & 7][x & 7] + 1; /* of 128 */
    return format == PANEL_MONO_THRESHOLD ? luma >= 128 : 128 * luma * luma > 255 * 255 * level;
}

int panel_page_init(struct panel_driver *d)
{
    const struct panel *panel = d->config.panel;
    d->share_x = (d->config.rotation & 1) != 0 ? PAGE_ROWS_LOG2 : 0;
    d->share_y = PAGE_ROWS_LOG2 - d->share_x;
    d->half_bytes = (uint32_t)(d->config.scratch_bytes / 2);
    const bool whole = ((panel->width | panel->height | panel->ram_height | panel->y0) & (PAGE_ROWS - 1)) == 0;
    return whole && d->half_bytes >= d->width ? HAL_OK : HAL_EINVAL;
}

/* Sends n bytes of a page. The commands before them lie in column_sent until the bytes are on their way. */
static int send_piece(struct panel_driver *d, uint32_t row, uint32_t column, const uint8_t *bytes, uint32_t n)
{
    uint8_t *address = d->column_sent;
    address[0] = (uint8_t)(d->config.panel->controller->set_page | row / PAGE_ROWS);
    address[1] = column & 15;
    address[2] = (uint8_t)(0x10 | column >> 4);
    d->frame_bytes += PANEL_PAGE_BYTES + n;
    const int status = d->hal.ops->bus_write(d->hal.context, HAL_COMMAND, address, PANEL_PAGE_BYTES);
    return status < 0 ? status : d->hal.ops->bus_write(d->hal.context, HAL_DATA, bytes, n);
}

static int page_line(struct panel_driver *d, uint8_t *half, const uint8_t *pixels)
{
    const uint32_t line = d->row % PAGE_ROWS;
    if (line == 0) {
        memset(half, 0, d->span);
    }
    for (uint32_t i = 0; i < d->span; i++) {
        half[i] |= (uint8_t)(panel_mono(d->config.format, pixels[2 * i], pixels[2 * i + 1], d->x + i, d->row) << line);
    }
    if (line != PAGE_ROWS - 1) {
        return HAL_OK;
    }
    const struct panel_place place = panel_place(d->config.panel, d->config.rotation);
    d->half ^= 1;
    return send_piece(d, (uint32_t)place.row + d->row, (uint32_t)place.column + d->x, half, d->span);
}

/* The 8 pixels from *pixels on, whose first is column x of the picture. */
static uint8_t crossing(const struct panel_driver *d, const uint8_t *pixels, uint32_t x)
{
    uint32_t byte = 0;
    for (uint32_t i = 0; i < PAGE_ROWS; i++) {
        byte |= (uint32_t)panel_mono(d->config.format, pixels[2 * i], pixels[2 * i + 1], x + i, d->row) << i;
    }
    return (uint8_t)byte;
}

/* Bytes of a page lie beside each other in the half, d->filled of them so far. */
static int column_line(struct panel_driver *d, uint8_t *half, const uint8_t *pixels)
{
    const uint32_t pages = d->span / PAGE_ROWS, lines = d->width / pages;
    for (uint32_t i = 0; i < pages; i++) {
        half[i * lines + d->filled] = crossing(d, pixels + 2 * PAGE_ROWS * i, d->x + PAGE_ROWS * i);
    }
    d->filled++;
    if (d->filled < lines && d->row + 1U < d->bottom) {
        return HAL_OK;
    }
    const struct panel_place place = panel_place(d->config.panel, d->config.rotation);
    const uint32_t column = place.column + d->row + 1U - d->filled;
    int status = HAL_OK;
    for (uint32_t i = 0; i < pages && status >= 0; i++) {
        status = send_piece(d, place.row + d->x + PAGE_ROWS * i, column, half + i * lines, d->filled);
    }
    d->half ^= 1;
    d->filled = 0;
    return status;
}

int panel_page_line(struct panel_driver *d, const uint8_t *pixels)
{
    uint8_t *half = d->config.scratch + d->half * d->half_bytes;
    return d->share_y != 0 ? page_line(d, half, pixels) : column_line(d, half, pixels);
}
