/* See panel.h. This file sends what a frame needs over the bus; panel_pack.c converts pixels. */
#include "panel.h"
#include "panel_pack.h"

#include <string.h>

enum { SET_COLUMN, SET_ROW, MEMORY_WRITE };

static int send(const struct hal *hal, enum hal_dc dc, const uint8_t *bytes, size_t n)
{
    const int status = n > 0 ? hal->ops->bus_write(hal->context, dc, bytes, n) : HAL_OK;
    return status < 0 || n == 0 ? status : hal->ops->bus_wait(hal->context);
}

/* Sends bytes of a command; each as a word of 16 bits where the controller wants that. */
static int send_bytes(const struct panel_driver *d, enum hal_dc dc, const uint8_t *bytes, size_t n)
{
    if (!d->config.panel->controller->words) {
        return send(&d->hal, dc, bytes, n);
    }
    int status = HAL_OK;
    for (size_t i = 0; i < n && status >= 0; i++) {
        const uint8_t word[2] = {0, bytes[i]};
        status = send(&d->hal, dc, word, sizeof word);
    }
    return status;
}

static int send_command(const struct panel_driver *d, uint8_t command, const uint8_t *parameters, size_t n)
{
    const bool low = d->config.panel->controller->parameters_are_commands;
    const int status = send_bytes(d, HAL_COMMAND, &command, 1);
    return status < 0 ? status : send_bytes(d, low ? HAL_COMMAND : HAL_DATA, parameters, n);
}

/* Sends a sequence as described at struct panel. HAL_EINVAL: the table is broken, because the sequence is cut short. */
static int send_sequence(const struct panel_driver *d, const uint8_t *bytes, size_t n)
{
    size_t i = 0;
    while (i + 2 <= n) {
        uint8_t command = bytes[i], count = bytes[i + 1];
        i += 2;
        if (count > n - i) {
            return HAL_EINVAL;
        }
        if (command == 0 && count == 1) {
            d->hal.ops->delay_us(d->hal.context, bytes[i] * 1000U);
        } else {
            int status = send_command(d, command, bytes + i, count);
            if (status < 0) {
                return status;
            }
        }
        i += count;
    }
    return i == n ? HAL_OK : HAL_EINVAL;
}

static int set_clock(const struct panel_driver *d, uint32_t hz)
{
    return d->hal.ops->bus_clock(d->hal.context, hz);
}

static int set_pin(const struct panel_driver *d, enum hal_pin pin, bool level)
{
    return d->hal.ops->pin_set(d->hal.context, pin, level);
}

static int hardware_reset(const struct panel_driver *d)
{
    const struct panel_controller *c = d->config.panel->controller;
    int status = set_pin(d, HAL_PIN_BACKLIGHT, false);
    status = status < 0 ? status : set_pin(d, HAL_PIN_RESET, false);
    if (status < 0) {
        return status;
    }
    d->hal.ops->delay_us(d->hal.context, c->reset_low_us);
    status = set_pin(d, HAL_PIN_RESET, true);
    d->hal.ops->delay_us(d->hal.context, c->reset_high_us);
    return status;
}

static int initialise(struct panel_driver *d)
{
    const struct panel *panel = d->config.panel;
    const struct panel_controller *c = panel->controller;
    int status = send_sequence(d, panel->init, panel->init_bytes);
    if (status < 0) {
        return status;
    }
    if (c->lines != NULL) {
        return c->lines->line_clear(d);
    }
    struct panel_place place = panel_place(panel, d->config.rotation);
    if (c->set_page != 0) {
        const uint8_t mirrors[2] = {c->set_rotation | (place.rotation_byte & c->rotation_bit_mx),
                                    c->set_scan | (place.rotation_byte & c->rotation_bit_my)};
        return send(&d->hal, HAL_COMMAND, mirrors, sizeof mirrors);
    }
    status = send_command(d, c->set_rotation, &place.rotation_byte, 1);
    if (status < 0 || c->set_format == 0) {
        return status;
    }
    return send_command(d, c->set_format, &c->format_value[d->config.format], 1);
}

static int check(const struct panel_config *config)
{
    const struct panel *panel = config->panel;
    if (!panel_can_turn(panel, config->rotation) || config->format >= PANEL_FORMATS || config->clock_hz == 0 ||
        (panel->formats & PANEL_FORMAT_BIT(config->format)) == 0) {
        return HAL_EINVAL;
    }
    const bool scratch = config->scratch != NULL && config->scratch_bytes >= PANEL_SCRATCH_MIN;
    return scratch || config->format == PANEL_RGB565 ? HAL_OK : HAL_EINVAL;
}

int panel_open(struct panel_driver *d, const struct hal *hal, const struct panel_config *config)
{
    int status = check(config);
    if (status < 0) {
        return status;
    }
    memset(d, 0, sizeof *d);
    d->hal = *hal;
    d->config = *config;
    d->width = panel_width(config->panel, config->rotation);
    d->height = panel_height(config->panel, config->rotation);
    d->commands[SET_COLUMN][1] = config->panel->controller->set_column;
    d->commands[SET_ROW][1] = config->panel->controller->set_row;
    d->commands[MEMORY_WRITE][1] = config->panel->controller->memory_write;
    status = panel_pack_init(d);
    status = status < 0 ? status : panel_clock(d, config->panel->controller->init_hz);
    status = status < 0 ? status : hardware_reset(d);
    status = status < 0 ? status : initialise(d);
    return status < 0 ? status : panel_clock(d, config->clock_hz);
}

int panel_clock(struct panel_driver *d, uint32_t hz)
{
    d->clock_hz = set_clock(d, hz);
    return d->clock_hz < 0 ? d->clock_hz : HAL_OK;
}

/* Sends bytes that stay where they are until the next write has started, so nothing has to wait. */
static int stream(struct panel_driver *d, enum hal_dc dc, const uint8_t *bytes, size_t n)
{
    d->frame_bytes += (uint32_t)n;
    return d->hal.ops->bus_write(d->hal.context, dc, bytes, n);
}

/* Sends a command of a window. */
static int start(struct panel_driver *d, uint32_t command)
{
    const bool word = d->config.panel->controller->words;
    return stream(d, HAL_COMMAND, d->commands[command] + !word, 1U + word);
}

/*
 * Sends a window's two borders in a direction, high byte first. `sent` keeps them while they are on the wire. It is
 * written only when the command before them has been taken, so everything earlier has left its buffer. `again`: send
 * them even if the controller has them.
 */
static int send_border(struct panel_driver *d, uint32_t command, uint32_t first, uint32_t last, uint8_t sent[8],
                       bool again)
{
    const struct panel_controller *c = d->config.panel->controller;
    const uint8_t words[8] = {0, (uint8_t)(first >> 8), 0, (uint8_t)first, 0, (uint8_t)(last >> 8), 0, (uint8_t)last};
    const uint8_t wide[8] = {(uint8_t)(first >> 8), (uint8_t)first, (uint8_t)(last >> 8), (uint8_t)last};
    const uint8_t narrow[8] = {(uint8_t)first, (uint8_t)last};
    const uint8_t *bytes = c->words ? words : c->address_bytes == 1 ? narrow : wide;
    if (!again && memcmp(sent, bytes, sizeof wide) == 0) {
        return HAL_OK;
    }
    int status = start(d, command);
    if (status < 0) {
        return status;
    }
    memcpy(sent, bytes, sizeof wide);
    return stream(d, c->parameters_are_commands ? HAL_COMMAND : HAL_DATA, sent, (2U * c->address_bytes) << c->words);
}

/* Opens a window. `again`: send the borders even if the controller has them. */
static int open_window(struct panel_driver *d, uint32_t x, uint32_t y, bool again)
{
    const struct panel_controller *c = d->config.panel->controller;
    if (c->set_page != 0 || c->lines != NULL) {
        return HAL_OK; /* each piece of a page, and each line, is addressed by itself */
    }
    struct panel_place place = panel_place(d->config.panel, d->config.rotation);
    bool swap = !c->window_turns && (d->config.rotation & 1) != 0; /* the picture's lines are columns of the glass */
    uint32_t height = d->bottom - y, column = place.column + (swap ? y : x), row = place.row + (swap ? x : y);
    uint32_t columns = swap ? height : d->span, rows = swap ? d->span : height;
    int status = send_border(d, SET_COLUMN, column / c->column_pixels, (column + columns - 1) / c->column_pixels,
                             d->column_sent, again);
    status = status < 0 ? status : send_border(d, SET_ROW, row, row + rows - 1, d->row_sent, again);
    return status < 0 || c->memory_write == 0 ? status : start(d, MEMORY_WRITE);
}

static int window(struct panel_driver *d, uint32_t x, uint32_t y, uint32_t width, uint32_t height, bool again)
{
    d->x = (uint16_t)x;
    d->span = (uint16_t)width;
    d->row = (uint16_t)y;
    d->bottom = (uint16_t)(y + height);
    d->filled = 0;
    d->carry_full = false;
    int status = open_window(d, x, y, again);
    d->in_frame = status >= 0;
    return status < 0 ? status : HAL_OK;
}

int panel_frame_begin(struct panel_driver *d)
{
    const int status = d->in_message ? panel_wait(d) : HAL_OK;
    d->frame_bytes = 0;
    return status < 0 ? status : window(d, 0, 0, d->width, d->height, true);
}

void panel_windows_begin(struct panel_driver *d)
{
    d->frame_bytes = 0;
    d->in_frame = false;
    memset(d->column_sent, UINT8_MAX, sizeof d->column_sent); /* all ones: the controller has no window */
    memset(d->row_sent, UINT8_MAX, sizeof d->row_sent);
}

/* Whether `first` and `end` lie between two bytes of 1 << share pixels. Pixels beside the picture do not count. */
static bool between_bytes(const struct panel_driver *d, uint32_t share, uint32_t first, uint32_t end, uint32_t size)
{
    const uint32_t inside = (1U << share) - 1;
    return (first == 0 || ((first + d->lead) & inside) == 0) && (end == size || ((end + d->lead) & inside) == 0);
}

int panel_window(struct panel_driver *d, uint32_t x, uint32_t y, uint32_t width, uint32_t height)
{
    d->in_frame = false;
    if (width == 0 || height == 0 || x >= d->width || y >= d->height || width > d->width - x ||
        height > d->height - y) {
        return HAL_EINVAL;
    }
    if (!between_bytes(d, d->share_x, x, x + width, d->width) ||
        !between_bytes(d, d->share_y, y, y + height, d->height)) {
        return HAL_EINVAL;
    }
    /* Without a memory write command only the borders take the controller back to the window's start. An SSD1351 has
     * that command, but it continues in a window that was left unfinished. */
    const bool again = d->config.panel->controller->memory_write == 0 || d->row != d->bottom;
    return window(d, x, y, width, height, again);
}

uint32_t panel_border_bytes(const struct panel_controller *c)
{
    return c->lines != NULL ? 0 : (1 + 2U * c->address_bytes) << c->words;
}

uint32_t panel_start_bytes(const struct panel_controller *c)
{
    return (uint32_t)(c->memory_write != 0) << c->words;
}

/* Sends lines that are `stride` pixels apart in memory. */
static int send_apart(struct panel_driver *d, const uint8_t *bytes, uint32_t stride, uint32_t lines)
{
    d->frame_bytes += 2U * d->span * lines;
    d->row = (uint16_t)(d->row + lines);
    return d->hal.ops->bus_write_rows(d->hal.context, bytes, 2U * d->span, 2 * (size_t)stride, lines);
}

/* Sends lines straight from where they are, in one write if there is no gap between them. */
static int send_lines(struct panel_driver *d, const uint8_t *bytes, uint32_t stride, uint32_t lines)
{
    if (stride != d->span && d->hal.ops->bus_write_rows != NULL) {
        return send_apart(d, bytes, stride, lines);
    }
    uint32_t pieces = stride == d->span ? 1 : lines;
    size_t n = 2U * d->span * (size_t)(lines / pieces);
    int status = HAL_OK;
    for (uint32_t i = 0; i < pieces && status >= 0; i++) {
        status = stream(d, HAL_DATA, bytes + 2 * (size_t)stride * i, n);
    }
    d->row = (uint16_t)(d->row + lines);
    return status;
}

static int pack_lines(struct panel_driver *d, const uint8_t *bytes, uint32_t stride, uint32_t lines)
{
    int status = HAL_OK;
    for (uint32_t i = 0; i < lines && status >= 0; i++) {
        status = panel_pack_line(d, bytes + 2 * (size_t)stride * i);
        d->row++;
    }
    return status >= 0 && d->row == d->bottom ? panel_pack_end(d) : status;
}

int panel_window_rows(struct panel_driver *d, const uint16_t *pixels, uint32_t stride, uint32_t lines)
{
    if (!d->in_frame || stride < d->span || lines > (uint32_t)(d->bottom - d->row)) {
        return HAL_EINVAL;
    }
    if (lines == 0) {
        return HAL_OK;
    }
    bool straight = d->config.format == PANEL_RGB565 && (stride == d->span || d->half_bytes == 0);
    const uint8_t *bytes = (const uint8_t *)pixels;
    int status = straight ? send_lines(d, bytes, stride, lines) : pack_lines(d, bytes, stride, lines);
    if (status < 0) {
        d->in_frame = false;
    } else if (d->row == d->bottom && d->hal.ops->bus_flush != NULL) {
        d->hal.ops->bus_flush(d->hal.context);
    }
    return status;
}

int panel_rows(struct panel_driver *d, const uint16_t *pixels, uint32_t lines)
{
    return panel_window_rows(d, pixels, d->span, lines);
}

int panel_wait(struct panel_driver *d)
{
    const struct panel_line_ops *lines = d->config.panel->controller->lines;
    return lines != NULL ? lines->line_end(d) : d->hal.ops->bus_wait(d->hal.context);
}

int panel_hold(struct panel_driver *d)
{
    return d->config.panel->controller->lines != NULL ? panel_wait(d) : HAL_OK;
}

int panel_frame_end(struct panel_driver *d)
{
    bool complete = d->in_frame && d->row == d->bottom;
    d->in_frame = false;
    int status = panel_wait(d);
    if (status < 0 || !complete || d->lit) {
        return status < 0 ? status : complete ? HAL_OK : HAL_EINVAL;
    }
    const struct panel_controller *c = d->config.panel->controller;
    status = send_sequence(d, c->on, c->on_bytes);
    status = status < 0 ? status : set_pin(d, HAL_PIN_BACKLIGHT, true);
    d->lit = status >= 0;
    return status;
}

int panel_close(struct panel_driver *d)
{
    const struct panel_controller *c = d->config.panel->controller;
    d->in_frame = false;
    d->lit = false;
    int dark = set_pin(d, HAL_PIN_BACKLIGHT, false), waited = panel_wait(d);
    int status = c->lines != NULL ? c->lines->line_clear(d) : send_sequence(d, c->off, c->off_bytes);
    return dark < 0 ? dark : waited < 0 ? waited : status;
}
