/* See panel.h. What goes over the bus for a frame; panel_pack.c converts pixels. */
#include "panel.h"
#include "panel_pack.h"

#include <string.h>

static int send(const struct hal *hal, enum hal_dc dc, const uint8_t *bytes, size_t n)
{
    if (n == 0) {
        return HAL_OK;
    }
    int status = hal->ops->bus_write(hal->context, dc, bytes, n);
    return status < 0 ? status : hal->ops->bus_wait(hal->context);
}

static int send_command(const struct panel_driver *d, uint8_t command, const uint8_t *parameters, size_t n)
{
    int status = send(&d->hal, HAL_COMMAND, &command, 1);
    if (status < 0) {
        return status;
    }
    bool low = d->config.panel->controller->parameters_are_commands;
    return send(&d->hal, low ? HAL_COMMAND : HAL_DATA, parameters, n);
}

/* Bytes as described at struct panel. A sequence that is cut short is a broken table. */
static int send_sequence(const struct panel_driver *d, const uint8_t *bytes, size_t n)
{
    size_t i = 0;
    while (i + 2 <= n) {
        uint8_t command = bytes[i];
        uint8_t count = bytes[i + 1];
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
    if (status < 0) {
        return status;
    }
    status = set_pin(d, HAL_PIN_RESET, false);
    if (status < 0) {
        return status;
    }
    d->hal.ops->delay_us(d->hal.context, c->reset_low_us);
    status = set_pin(d, HAL_PIN_RESET, true);
    d->hal.ops->delay_us(d->hal.context, c->reset_high_us);
    return status;
}

static int initialise(const struct panel_driver *d)
{
    const struct panel *panel = d->config.panel;
    const struct panel_controller *c = panel->controller;
    int status = send_sequence(d, panel->init, panel->init_bytes);
    if (status < 0) {
        return status;
    }
    struct panel_place place = panel_place(panel, d->config.rotation);
    status = send_command(d, c->set_rotation, &place.rotation_byte, 1);
    if (status < 0 || c->set_format == 0) {
        return status;
    }
    return send_command(d, c->set_format, &c->format_value[d->config.format], 1);
}

static int check(const struct panel_config *config)
{
    const struct panel *panel = config->panel;
    if (config->rotation > PANEL_R270 || config->format > PANEL_GREY4 || config->clock_hz == 0 ||
        (panel->formats & PANEL_FORMAT_BIT(config->format)) == 0) {
        return HAL_EINVAL;
    }
    if (config->format != PANEL_RGB565 && (config->scratch == NULL || config->scratch_bytes < PANEL_SCRATCH_MIN)) {
        return HAL_EINVAL;
    }
    return HAL_OK;
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
    status = panel_pack_init(d);
    if (status < 0) {
        return status;
    }

    status = set_clock(d, config->panel->controller->init_hz);
    if (status < 0) {
        return status;
    }
    status = hardware_reset(d);
    if (status < 0) {
        return status;
    }
    status = initialise(d);
    if (status < 0) {
        return status;
    }
    d->clock_hz = set_clock(d, config->clock_hz);
    return d->clock_hz < 0 ? d->clock_hz : HAL_OK;
}

/* One border after the other, high byte first. */
static int send_border(const struct panel_driver *d, uint8_t command, uint32_t first, uint32_t last)
{
    uint8_t wide[4] = {(uint8_t)(first >> 8), (uint8_t)first, (uint8_t)(last >> 8), (uint8_t)last};
    uint8_t narrow[2] = {(uint8_t)first, (uint8_t)last};
    if (d->config.panel->controller->address_bytes == 1) {
        return send_command(d, command, narrow, sizeof narrow);
    }
    return send_command(d, command, wide, sizeof wide);
}

int panel_frame_begin(struct panel_driver *d)
{
    const struct panel *panel = d->config.panel;
    const struct panel_controller *c = panel->controller;
    struct panel_place place = panel_place(panel, d->config.rotation);
    uint32_t columns = c->window_turns ? d->width : panel->width;
    uint32_t rows = c->window_turns ? d->height : panel->height;

    d->row = 0;
    d->in_frame = false;
    d->filled = 0;
    d->carry_full = false;
    int status =
        send_border(d, c->set_column, place.column / c->column_pixels, (place.column + columns - 1) / c->column_pixels);
    if (status < 0) {
        return status;
    }
    status = send_border(d, c->set_row, place.row, place.row + rows - 1);
    if (status < 0) {
        return status;
    }
    if (c->memory_write != 0) {
        status = send_command(d, c->memory_write, NULL, 0);
        if (status < 0) {
            return status;
        }
    }
    d->in_frame = true;
    return HAL_OK;
}

int panel_rows(struct panel_driver *d, const uint16_t *pixels, uint32_t lines)
{
    if (!d->in_frame || lines > (uint32_t)(d->height - d->row)) {
        return HAL_EINVAL;
    }
    const uint8_t *bytes = (const uint8_t *)pixels;
    size_t line_bytes = 2U * d->width;
    int status = HAL_OK;
    if (d->config.format == PANEL_RGB565) {
        status = lines == 0 ? HAL_OK : d->hal.ops->bus_write(d->hal.context, HAL_DATA, bytes, lines * line_bytes);
        d->row = (uint16_t)(d->row + lines);
    } else {
        for (uint32_t i = 0; i < lines && status >= 0; i++) {
            status = panel_pack_line(d, bytes + i * line_bytes);
            d->row++;
        }
    }
    if (status < 0) {
        d->in_frame = false;
    }
    return status;
}

int panel_wait(struct panel_driver *d)
{
    return d->hal.ops->bus_wait(d->hal.context);
}

int panel_frame_end(struct panel_driver *d)
{
    bool complete = d->in_frame && d->row == d->height;
    d->in_frame = false;
    int status = complete ? panel_pack_end(d) : HAL_OK;
    int waited = panel_wait(d);
    if (status < 0 || waited < 0) {
        return status < 0 ? status : waited;
    }
    if (!complete) {
        return HAL_EINVAL;
    }
    if (d->lit) {
        return HAL_OK;
    }
    const struct panel_controller *c = d->config.panel->controller;
    status = send_sequence(d, c->on, c->on_bytes);
    if (status < 0) {
        return status;
    }
    status = set_pin(d, HAL_PIN_BACKLIGHT, true);
    d->lit = status >= 0;
    return status;
}

int panel_close(struct panel_driver *d)
{
    const struct panel_controller *c = d->config.panel->controller;
    d->in_frame = false;
    d->lit = false;
    int dark = set_pin(d, HAL_PIN_BACKLIGHT, false);
    int waited = panel_wait(d);
    int status = send_sequence(d, c->off, c->off_bytes);
    if (dark < 0) {
        return dark;
    }
    return waited < 0 ? waited : status;
}
