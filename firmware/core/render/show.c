/* ph_show: a frame through a function of the caller's. See render.h. */
#include "colour.h"
#include "list.h"
#include "overlay.h"

PH_TIER(mesh) size_t ph_pixel_bytes(unsigned order)
{
    return order == PH_PIXELS_RGB888 ? 3 : 2;
}

/* The part of a band that is sent. */
struct changed {
    uint32_t x, y, width, height;
};

/* The smallest rectangle that holds all changes against the picture before, which becomes this one. Height 0: none. */
PH_TIER(mesh)
static struct changed find_changes(const uint16_t *pixels, uint16_t *before, uint32_t width, uint32_t lines)
{
    uint32_t left = width, right = 0, top = lines, bottom = 0;
    for (uint32_t y = 0; y < lines; y++) {
        for (uint32_t x = 0; x < width; x++, pixels++, before++) {
            if (*pixels != *before) {
                *before = *pixels;
                left = x < left ? x : left;
                right = x + 1 > right ? x + 1 : right;
                top = y < top ? y : top;
                bottom = y + 1;
            }
        }
    }
    return top < bottom ? (struct changed){left, top, right - left, bottom - top} : (struct changed){0, 0, 0, 0};
}

/* Moves a rectangle to the beginning of the band, row behind row. */
PH_TIER(mesh) static void gather(uint16_t *pixels, uint32_t width, const struct changed *c)
{
    const uint16_t *from = pixels + (size_t)c->y * width + c->x;
    for (uint32_t y = 0; y < c->height; y++, from += width) {
        for (uint32_t x = 0; x < c->width; x++) {
            *pixels++ = from[x];
        }
    }
}

/* Turns n pixels from wire order into the order that is asked for, in place. */
PH_TIER(mesh) static void put_in_order(void *pixels, uint32_t n, unsigned order)
{
    uint16_t *const p = pixels;
    uint8_t *const rgb = pixels;
    if (order == PH_PIXELS_NATIVE) {
        for (uint32_t i = 0; i < n; i++) {
            p[i] = ph_wire16(p[i]);
        }
    } else if (order == PH_PIXELS_RGB888) {
        for (uint32_t i = n; i-- > 0;) { /* from the last, because they grow */
            const uint32_t v = ph_wire16(p[i]), red = v >> 11, green = v >> 5 & 63, blue = v & 31;
            rgb[3 * i] = (uint8_t)(red << 3 | red >> 2);
            rgb[3 * i + 1] = (uint8_t)(green << 2 | green >> 4);
            rgb[3 * i + 2] = (uint8_t)(blue << 3 | blue >> 2);
        }
    }
}

PH_TIER(mesh) int ph_show_painted(struct ph_renderer *r, ph_flush *flush, void *context, ph_paint *paint)
{
    const struct ph_config *const config = &r->config;
    uint16_t *const pixels = config->pixels;
    if (r->list.stage == PH_LIST_CLOSED) {
        return PH_ERR_STATE;
    }
    if (flush == NULL || pixels == NULL || (uintptr_t)pixels % sizeof(uint16_t) != 0 ||
        config->pixel_order > PH_PIXELS_RGB888) {
        return PH_ERR_INVAL;
    }
    const uint32_t width = (uint32_t)config->width >> r->samples_log2, bands = ph_frame_bands(r);
    struct ph_overlay_band over = {pixels, (uint16_t)width, 0, 0};
    int status = PH_OK;
    for (uint32_t band = 0; band < bands && status == PH_OK; band++, over.y0 += over.lines) {
        over.lines = (int32_t)ph_draw_band(r, band, pixels);
        if (over.lines == 0) {
            status = PH_ERR_STATE;
            break;
        }
        if (paint != NULL) {
            paint(context, &over); /* calls paint */
        }
        struct changed c = {0, 0, width, (uint32_t)over.lines};
        if (config->shown != NULL) {
            const struct changed found =
                find_changes(pixels, config->shown + (uint32_t)over.y0 * width, width, (uint32_t)over.lines);
            c = r->is_shown ? found : c;
        }
        if (c.height > 0) {
            gather(pixels, width, &c);
            put_in_order(pixels, c.width * c.height, config->pixel_order);
            status = flush(context, c.x, (uint32_t)over.y0 + c.y, c.width, c.height, pixels); /* calls flush */
        }
    }
    r->is_shown = status == PH_OK;
    return status;
}

PH_TIER(mesh) int ph_show(struct ph_renderer *r, ph_flush *flush, void *context)
{
    return ph_show_painted(r, flush, context, NULL);
}
