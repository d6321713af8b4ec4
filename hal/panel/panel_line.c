/* See panel_line.h. One half of the scratch memory is filled with lines while the other is on the wire. */
#include "panel_line.h"

#include "panel_pack.h"

#include <string.h>

enum { MODE_LINES = 0x80, MODE_VCOM = 0x40, MODE_CLEAR = 0x20 }; /* M0, M1, M2 */
enum { HOLD_US = 2 };                                            /* thSCS of the slowest panel */

static uint32_t line_bytes(const struct panel_driver *d)
{
    return d->width / 8U + PANEL_LINE_BYTES;
}

static int line_init(struct panel_driver *d)
{
    while (1U << d->share_x < d->width) { /* all pixels of a line are sent together */
        d->share_x++;
    }
    d->half_bytes = (uint32_t)(d->config.scratch_bytes / 2);
    return d->width % 8 == 0 && d->height <= UINT8_MAX && d->half_bytes >= line_bytes(d) ? HAL_OK : HAL_EINVAL;
}

/* Sends a byte and waits for its last bit. */
static int send_byte(struct panel_driver *d, enum hal_dc dc, uint8_t byte)
{
    const int status = d->hal.ops->bus_write(d->hal.context, dc, &byte, 1),
              waited = d->hal.ops->bus_wait(d->hal.context);
    d->frame_bytes++;
    return status < 0 ? status : waited;
}

/* SCS rises for the mode. */
static int begin(struct panel_driver *d, uint8_t mode)
{
    d->in_message = true;
    d->vcom ^= MODE_VCOM;
    int status = d->hal.ops->bus_clock(d->hal.context, d->config.panel->controller->init_hz);
    status = status < 0 ? status : send_byte(d, HAL_DATA, mode | d->vcom);
    const int32_t clock_hz = d->hal.ops->bus_clock(d->hal.context, (uint32_t)d->clock_hz);
    return status < 0 ? status : clock_hz < 0 ? clock_hz : HAL_OK;
}

static int line_end(struct panel_driver *d)
{
    int status = d->in_message ? HAL_OK : begin(d, 0);
    d->in_message = false;
    status = status < 0 ? status : send_byte(d, HAL_DATA, 0);
    d->hal.ops->delay_us(d->hal.context, HOLD_US);
    return status < 0 ? status : send_byte(d, HAL_COMMAND, 0);
}

/* The byte before the message lets SCS fall, wherever the backend left it. */
static int line_clear(struct panel_driver *d)
{
    int status = send_byte(d, HAL_COMMAND, 0);
    status = status < 0 ? status : begin(d, MODE_CLEAR);
    return status < 0 ? status : line_end(d);
}

/* The byte with its bits in the other order. */
static uint8_t turned_over(uint32_t byte)
{
    uint32_t over = 0;
    for (uint32_t i = 0; i < 8; i++) {
        over = over << 1 | (byte >> i & 1);
    }
    return (uint8_t)over;
}

static int line_pack(struct panel_driver *d, const uint8_t *pixels)
{
    const bool upside_down = d->config.rotation == PANEL_R180;
    const uint32_t bytes = line_bytes(d), last_x = d->width - 1U, last_y = d->height - 1U;
    int status = d->in_message ? HAL_OK : begin(d, MODE_LINES);
    if (status >= 0 && d->half_bytes - d->filled < bytes) {
        status = panel_pack_flush(d);
    }
    uint8_t *out = d->config.scratch + d->half * d->half_bytes + d->filled;
    memset(out, 0, bytes);
    out[0] = turned_over(1 + (upside_down ? last_y - d->row : d->row));
    for (uint32_t x = 0; x <= last_x; x++) {
        const uint32_t at = upside_down ? last_x - x : x;
        const bool white = panel_mono(d->config.format, pixels[2 * x], pixels[2 * x + 1], x, d->row);
        out[1 + at / 8] |= (uint8_t)(white << (7 - at % 8));
    }
    d->filled += bytes;
    return status;
}

const struct panel_line_ops panel_line_ops = {
    .line_init = line_init, .line_clear = line_clear, .line_pack = line_pack, .line_end = line_end};
