/*
 * See panel_pack.h. The scratch memory has two halves: one is filled while the other is on the wire. bus_write of one
 * half returns only when the other is free again (hal.h), so a half is never written while it is being sent.
 */
#include "panel_pack.h"

#include "panel_page.h"

#include <string.h>

/* one pixel adds at most so many */
#define PIXEL_BYTES_MAX 3

static const uint8_t bayer4[4][4] = {{0, 8, 2, 10}, {12, 4, 14, 6}, {3, 11, 1, 9}, {15, 7, 13, 5}};

uint32_t panel_luma(uint8_t high, uint8_t low)
{
    uint32_t r5 = high >> 3, g6 = (high & 7U) << 3 | low >> 5, b5 = low & 31U;
    return (77 * (r5 << 3 | r5 >> 2) + 150 * (g6 << 2 | g6 >> 4) + 29 * (b5 << 3 | b5 >> 2)) >> 8;
}

uint8_t panel_grey4(uint8_t high, uint8_t low, uint32_t x, uint32_t y)
{
    uint32_t scaled = 15 * panel_luma(high, low);       /* level * 255 */
    uint32_t level = (scaled + 1 + (scaled >> 8)) >> 8; /* scaled / 255, exact below 65535 */
    uint32_t rest = scaled - 255 * level;
    return (uint8_t)(level + (32 * rest > 255 * (2U * bayer4[y & 3][x & 3] + 1)));
}

int panel_pack_init(struct panel_driver *d)
{
    const struct panel_config *config = &d->config;
    if (config->panel->controller->set_page != 0) {
        return panel_page_init(d);
    }
    if (config->panel->controller->lines != NULL) {
        return config->panel->controller->lines->line_init(d);
    }
    if (config->format == PANEL_GREY4) {
        d->share_y = config->panel->controller->column_pixels == 2 && (config->rotation & 1) != 0;
        d->share_x = !d->share_y;
    }
    if (config->format == PANEL_RGB565 && (config->scratch == NULL || config->scratch_bytes < PANEL_SCRATCH_MIN)) {
        return HAL_OK; /* without scratch memory windows are sent line by line */
    }
    size_t kept = d->share_y != 0 ? d->width : 0; /* the upper line of a pair, at the end of scratch */
    if (config->scratch_bytes < kept + 2 * PIXEL_BYTES_MAX) {
        return HAL_EINVAL;
    }
    d->half_bytes = (uint32_t)((config->scratch_bytes - kept) / 2);
    if (config->format == PANEL_GREY4) {
        d->lead =
            (uint8_t)(panel_place(config->panel, config->rotation).column % config->panel->controller->column_pixels);
    }
    return HAL_OK;
}

static uint8_t *upper_line(const struct panel_driver *d)
{
    return d->config.scratch + d->config.scratch_bytes - d->width;
}

int panel_pack_flush(struct panel_driver *d)
{
    if (d->filled == 0) {
        return HAL_OK;
    }
    uint8_t *half = d->config.scratch + d->half * d->half_bytes;
    int status = d->hal.ops->bus_write(d->hal.context, HAL_DATA, half, d->filled);
    d->frame_bytes += d->filled;
    d->half ^= 1;
    d->filled = 0;
    return status;
}

static uint8_t *pack_rgb666(uint8_t *out, const uint8_t *in, uint32_t n)
{
    for (uint32_t i = 0; i < n; i++) {
        uint32_t r5 = in[2 * i] >> 3, g6 = (in[2 * i] & 7U) << 3 | in[2 * i + 1] >> 5, b5 = in[2 * i + 1] & 31U;
        *out++ = (uint8_t)((r5 << 1 | r5 >> 4) << 2);
        *out++ = (uint8_t)(g6 << 2);
        *out++ = (uint8_t)((b5 << 1 | b5 >> 4) << 2);
    }
    return out;
}

/* Adds four bits to the output. */
static uint8_t *pack_nibble(struct panel_driver *d, uint8_t *out, uint32_t nibble)
{
    if (d->carry_full) {
        *out++ = (uint8_t)(d->carry << 4 | nibble);
    }
    d->carry = (uint8_t)nibble;
    d->carry_full = !d->carry_full;
    return out;
}

static uint8_t *pack_rgb444(struct panel_driver *d, uint8_t *out, const uint8_t *in, uint32_t n)
{
    for (uint32_t i = 0; i < n; i++) {
        uint32_t high = in[2 * i], low = in[2 * i + 1];
        out = pack_nibble(d, out, high >> 4);
        out = pack_nibble(d, out, (high & 7U) << 1 | low >> 7);
        out = pack_nibble(d, out, low >> 1 & 15U);
    }
    return out;
}

static uint8_t *pack_grey4(struct panel_driver *d, uint8_t *out, const uint8_t *in, uint32_t x, uint32_t n)
{
    for (uint32_t i = 0; i < n; i++) {
        uint8_t grey = panel_grey4(in[2 * i], in[2 * i + 1], x + i, d->row);
        if (d->share_y == 0) {
            out = pack_nibble(d, out, grey);
        } else if (((d->row + d->lead) & 1U) == 0) {
            upper_line(d)[x + i] = grey;
        } else {
            uint32_t upper = d->row == 0 ? 0U : upper_line(d)[x + i];
            *out++ = (uint8_t)(upper << 4 | grey);
        }
    }
    return out;
}

/* Converts pixels x .. x + n - 1 of the line. There must be room for n * PIXEL_BYTES_MAX bytes. */
static void pack(struct panel_driver *d, const uint8_t *in, uint32_t x, uint32_t n)
{
    uint8_t *start = d->config.scratch + d->half * d->half_bytes + d->filled;
    uint8_t *end;
    if (d->config.format == PANEL_RGB565) {
        memcpy(start, in, 2 * (size_t)n);
        end = start + 2 * n;
    } else if (d->config.format == PANEL_RGB666) {
        end = pack_rgb666(start, in, n);
    } else if (d->config.format == PANEL_RGB444) {
        end = pack_rgb444(d, start, in, n);
    } else {
        end = pack_grey4(d, start, in, x, n);
    }
    d->filled += (uint32_t)(end - start);
}

static int put_byte(struct panel_driver *d, uint8_t byte)
{
    const int status = d->filled == d->half_bytes ? panel_pack_flush(d) : HAL_OK;
    d->config.scratch[d->half * d->half_bytes + d->filled++] = byte;
    return status;
}

/* Sends the last bits of a window. Four bits that are left over get a byte of their own; there is no pixel to their
 * right. */
static int pack_rest(struct panel_driver *d)
{
    if (!d->carry_full) {
        return HAL_OK;
    }
    d->carry_full = false;
    return put_byte(d, (uint8_t)(d->carry << 4));
}

int panel_pack_line(struct panel_driver *d, const uint8_t *pixels)
{
    uint32_t x = 0;
    if (d->config.panel->controller->set_page != 0) {
        return panel_page_line(d, pixels);
    }
    if (d->config.panel->controller->lines != NULL) {
        return d->config.panel->controller->lines->line_pack(d, pixels);
    }
    if (d->config.format == PANEL_GREY4 && d->share_y == 0 && d->lead != 0 && d->x == 0) {
        d->carry = 0;
        d->carry_full = true;
    }
    while (x < d->span) {
        uint32_t fit = (d->half_bytes - d->filled) / PIXEL_BYTES_MAX;
        if (fit == 0) {
            int status = panel_pack_flush(d);
            if (status < 0) {
                return status;
            }
            continue;
        }
        uint32_t n = d->span - x < fit ? d->span - x : fit;
        pack(d, pixels + 2 * x, d->x + x, n);
        x += n;
    }
    return d->config.format == PANEL_GREY4 ? pack_rest(d) : HAL_OK;
}

/* Converts the last line of a window. Where two lines share a byte, it may have its bytes for itself. */
static int pack_last_line(struct panel_driver *d)
{
    int status = HAL_OK;
    for (uint32_t x = d->x; x < (uint32_t)d->x + d->span && status >= 0; x++) {
        status = put_byte(d, (uint8_t)(upper_line(d)[x] << 4));
    }
    return status;
}

int panel_pack_end(struct panel_driver *d)
{
    int status = d->config.format == PANEL_GREY4 && d->share_y != 0 && ((d->bottom + d->lead) & 1U) != 0
                     ? pack_last_line(d)
                     : pack_rest(d);
    return status < 0 ? status : panel_pack_flush(d);
}
