/* See panel.h. Arithmetic on panels; nothing here uses the bus. */
#include "panel.h"

#include <string.h>

const struct panel *panel_find(const char *name)
{
    for (uint32_t i = 0; i < panel_count; i++) {
        if (strcmp(panel_list[i]->name, name) == 0) {
            return panel_list[i];
        }
    }
    return NULL;
}

/* Which axes a rotation mirrors, and whether it swaps them. At 90 degrees clockwise the first column is the last row.
 */
static bool turns_mx(unsigned rotation)
{
    return rotation == PANEL_R90 || rotation == PANEL_R180;
}

static bool turns_my(unsigned rotation)
{
    return rotation == PANEL_R180 || rotation == PANEL_R270;
}

static bool turns_mv(unsigned rotation)
{
    return (rotation & 1) != 0;
}

struct panel_place panel_place(const struct panel *panel, unsigned rotation)
{
    const struct panel_controller *c = panel->controller;
    unsigned byte = panel->rotation_base;
    byte ^= turns_mx(rotation) ? (unsigned)c->rotation_bit_mx | c->rotation_bit_mx_pair : 0U;
    byte ^= turns_my(rotation) ? c->rotation_bit_my : 0U;
    byte ^= turns_mv(rotation) ? c->rotation_bit_mv : 0U;

    bool mx = (byte & c->rotation_bit_mx) != 0, my = (byte & c->rotation_bit_my) != 0;
    uint16_t cx = mx ? (uint16_t)(panel->ram_width - panel->width - panel->x0) : panel->x0;
    uint16_t cy = my ? (uint16_t)(panel->ram_height - panel->height - panel->y0) : panel->y0;
    bool swap = c->window_turns && turns_mv(rotation);
    return (struct panel_place){swap ? cy : cx, swap ? cx : cy, (uint8_t)byte};
}

bool panel_can_turn(const struct panel *panel, unsigned rotation)
{
    return rotation <= PANEL_R270 && (panel->controller->lines == NULL || !turns_mv(rotation));
}

uint16_t panel_width(const struct panel *panel, unsigned rotation)
{
    return turns_mv(rotation) ? panel->height : panel->width;
}

uint16_t panel_height(const struct panel *panel, unsigned rotation)
{
    return turns_mv(rotation) ? panel->width : panel->height;
}

static uint32_t pixel_bytes(const struct panel *panel, unsigned format, unsigned rotation)
{
    uint32_t width = panel_width(panel, rotation), height = panel_height(panel, rotation);
    switch (format) {
    case PANEL_RGB666:
        return 3 * width * height;
    case PANEL_RGB444:
        return (3 * width * height + 1) / 2;
    case PANEL_GREY4:
        return (panel_place(panel, rotation).column % panel->controller->column_pixels + panel->width + 1U) / 2 *
               panel->height;
    case PANEL_MONO_DITHER:
    case PANEL_MONO_THRESHOLD:
        if (panel->controller->lines != NULL) {
            return PANEL_MESSAGE_BYTES + (width / 8 + PANEL_LINE_BYTES) * height;
        }
        /* turned by 90 or 270, a piece of a page has 8 bytes */
        return width * height / 8 + PANEL_PAGE_BYTES * (turns_mv(rotation) ? width / 8 * (height / 8) : height / 8);
    default:
        return 2 * width * height;
    }
}

uint32_t panel_frame_bytes(const struct panel *panel, unsigned format, unsigned rotation)
{
    const struct panel_controller *c = panel->controller;
    const uint32_t window = c->set_page != 0 ? 0 : 2 * panel_border_bytes(c) + panel_start_bytes(c);
    return window + pixel_bytes(panel, format, rotation);
}

uint32_t panel_frame_us(const struct panel *panel, unsigned format, unsigned rotation, uint32_t hz)
{
    uint64_t bits = 8ULL * panel_frame_bytes(panel, format, rotation), us = (bits * 1000000 + hz - 1) / hz;
    return us > UINT32_MAX ? UINT32_MAX : (uint32_t)us;
}
