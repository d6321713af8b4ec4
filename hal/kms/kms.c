/* See kms.h. */
#define _POSIX_C_SOURCE 200809L

#include "kms.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

int kms_find(struct kms *k)
{
    uint32_t width, height, scale = 1;
    const int status = kms_card_open(&k->card, k->where, k->error);
    if (status < 0) {
        return status;
    }
    kms_card_size(k->card, &width, &height);
    while (width / scale > KMS_SIDE_MAX || height / scale > KMS_SIDE_MAX) {
        scale++;
    }
    k->scale = (uint8_t)scale;
    k->width = (uint16_t)(width / scale);
    k->height = (uint16_t)(height / scale);
    k->left = width % scale / 2;
    k->top = height % scale / 2;
    return HAL_OK;
}

const char *kms_error(const struct kms *k)
{
    return k->error;
}

/* ---- pixels ------------------------------------------------------------------------------------- */

/* Finds the place of the picture's pixel on the display: turned clockwise as panel.h says, on an upright display in its
 * own pixels. */
static void turn(const struct kms *k, const struct panel_driver *d, uint32_t *x, uint32_t *y)
{
    const uint32_t px = *x, py = *y, right = k->width - 1U, bottom = k->height - 1U;
    switch (d->config.rotation) {
    case PANEL_R90:
        *x = right - py;
        *y = px;
        break;
    case PANEL_R180:
        *x = right - px;
        *y = bottom - py;
        break;
    case PANEL_R270:
        *x = py;
        *y = bottom - px;
        break;
    default:
        break;
    }
}

/* Converts RGB565 in wire order to 8 bits a channel: 31 and 63 become 255. */
static uint32_t widen(uint16_t pixel)
{
    uint8_t bytes[2];
    memcpy(bytes, &pixel, sizeof bytes);
    const uint32_t rgb = (uint32_t)bytes[0] << 8 | bytes[1];
    const uint32_t r = rgb >> 11, g = rgb >> 5 & 63, b = rgb & 31;
    return (r << 3 | r >> 2) << 16 | (g << 2 | g >> 4) << 8 | (b << 3 | b >> 2);
}

static void put(const struct kms *k, const struct panel_driver *d, uint32_t x, uint32_t y, uint16_t pixel)
{
    turn(k, d, &x, &y);
    uint32_t *to = k->buffer.pixels + (size_t)(k->top + y * k->scale) * k->buffer.stride + k->left + x * k->scale;
    const uint32_t colour = widen(pixel);
    for (uint32_t line = 0; line < k->scale; line++, to += k->buffer.stride) {
        for (uint32_t i = 0; i < k->scale; i++) {
            to[i] = colour;
        }
    }
}

/* Draws the part of a line that differs from the last picture; returns false if nothing does. */
static bool draw_line(const struct kms *k, const struct panel_driver *d, uint32_t y, const uint16_t *pixels,
                      uint32_t *from, uint32_t *to)
{
    uint16_t *shown = k->shown != NULL ? k->shown + (size_t)y * d->width : NULL;
    uint32_t first = 0, end = d->width;
    if (shown != NULL && !k->whole) {
        while (first < end && pixels[first] == shown[first]) {
            first++;
        }
        while (end > first && pixels[end - 1] == shown[end - 1]) {
            end--;
        }
    }
    for (uint32_t x = first; x < end; x++) {
        put(k, d, x, y, pixels[x]);
    }
    if (shown != NULL) {
        memcpy(shown + first, pixels + first, (end - first) * sizeof *pixels);
    }
    *from = first < *from ? first : *from;
    *to = end > first && end > *to ? end : *to;
    return first < end;
}

/* Adds a rectangle that changed. The last one grows when there is no room for another. */
static void add_clip(struct kms *k, struct kms_clip clip)
{
    if (k->clip_count < KMS_CLIPS_MAX) {
        k->clips[k->clip_count++] = clip;
        return;
    }
    struct kms_clip *last = &k->clips[KMS_CLIPS_MAX - 1];
    last->x0 = clip.x0 < last->x0 ? clip.x0 : last->x0;
    last->y0 = clip.y0 < last->y0 ? clip.y0 : last->y0;
    last->x1 = clip.x1 > last->x1 ? clip.x1 : last->x1;
    last->y1 = clip.y1 > last->y1 ? clip.y1 : last->y1;
}

/* Adds the rectangle from pixel (x0, y0) to (x1, y1) of the picture, both inside. */
static void changed(struct kms *k, struct panel_driver *d, uint32_t x0, uint32_t y0, uint32_t x1, uint32_t y1)
{
    d->frame_bytes += (x1 - x0 + 1) * (y1 - y0 + 1) * k->scale * k->scale * 4;
    turn(k, d, &x0, &y0);
    turn(k, d, &x1, &y1);
    const uint32_t left = x0 < x1 ? x0 : x1, right = x0 < x1 ? x1 : x0, top = y0 < y1 ? y0 : y1,
                   bottom = y0 < y1 ? y1 : y0;
    add_clip(k, (struct kms_clip){(uint16_t)(k->left + left * k->scale), (uint16_t)(k->top + top * k->scale),
                                  (uint16_t)(k->left + (right + 1) * k->scale),
                                  (uint16_t)(k->top + (bottom + 1) * k->scale)});
}

/* ---- the sender --------------------------------------------------------------------------------- */

static int sender_begin(void *context, struct panel_driver *d)
{
    struct kms *k = context;
    bool keeps;
    k->buffer = kms_card_buffer(k->card, &keeps);
    k->row = k->clip_count = 0;
    d->frame_bytes = 0;
    return HAL_OK;
}

/* Draws lines of a frame. It is shown with its last line: the next one may be long in coming. */
static int sender_rows(void *context, struct panel_driver *d, const uint16_t *pixels, uint32_t lines)
{
    struct kms *k = context;
    uint32_t x0 = d->width, x1 = 0, y0 = 0, y1 = 0;
    if (k->row + lines > d->height) {
        return HAL_EINVAL;
    }
    for (uint32_t i = 0; i < lines; i++, k->row++) {
        if (draw_line(k, d, k->row, pixels + (size_t)i * d->width, &x0, &x1)) {
            y0 = y1 == 0 ? k->row : y0;
            y1 = k->row + 1;
        }
    }
    if (y1 > 0) {
        changed(k, d, x0, y0, x1 - 1, y1 - 1);
    }
    if (k->row < d->height || k->clip_count == 0) {
        return HAL_OK;
    }
    k->whole = false;
    return kms_card_show(k->card, k->clips, k->clip_count, k->error);
}

static int sender_end(void *context, struct panel_driver *d)
{
    return ((const struct kms *)context)->row == d->height ? HAL_OK : HAL_EINVAL;
}

struct panel_sender kms_sender(struct kms *k)
{
    static const struct panel_sender_ops ops = {
        .copies = true, .begin = sender_begin, .rows = sender_rows, .end = sender_end};
    return (struct panel_sender){&ops, k};
}

/* ---- the kit ------------------------------------------------------------------------------------ */

static int kms_open(void *context, const struct board *board)
{
    struct kms *k = context;
    bool keeps;
    (void)board;
    const int status = kms_card_take(k->card, k->error);
    if (status < 0) {
        return status;
    }
    k->buffer = kms_card_buffer(k->card, &keeps);
    k->shown = keeps ? calloc((size_t)k->width * k->height, sizeof *k->shown) : NULL; /* without it all is drawn */
    k->whole = true;
    kms_keys_open(&k->keys);
    return HAL_OK;
}

static void kms_close(void *context)
{
    struct kms *k = context;
    kms_keys_close(&k->keys);
    kms_card_close(k->card);
    free(k->shown);
    k->card = NULL;
    k->shown = NULL;
}

/* A display that the kernel drives has no bus: any clock will do, and bytes for a controller go nowhere. */
static int32_t kms_bus_clock(void *context, uint32_t hz)
{
    (void)context;
    return hz == 0 ? HAL_EINVAL : hz > INT32_MAX ? INT32_MAX : (int32_t)hz;
}

static int kms_bus_write(void *context, enum hal_dc dc, const uint8_t *bytes, size_t n)
{
    (void)context, (void)dc, (void)bytes, (void)n;
    return HAL_OK;
}

static int kms_bus_wait(void *context)
{
    (void)context;
    return HAL_OK;
}

static int kms_pin_set(void *context, enum hal_pin pin, bool level)
{
    (void)context, (void)pin, (void)level;
    return HAL_OK;
}

static uint32_t kms_time_us(void *context)
{
    struct timespec now;
    (void)context;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (uint32_t)((uint64_t)now.tv_sec * 1000000U + (uint64_t)now.tv_nsec / 1000U);
}

/* Does not wait: no controller needs the pauses. */
static void kms_delay_us(void *context, uint32_t us)
{
    (void)context, (void)us;
}

static uint32_t kms_buttons(void *context)
{
    return kms_keys_read(&((const struct kms *)context)->keys);
}

const struct hal_ops kms_ops = {
    .name = "kms",
    .open = kms_open,
    .bus_clock = kms_bus_clock,
    .bus_write = kms_bus_write,
    .bus_wait = kms_bus_wait,
    .pin_set = kms_pin_set,
    .time_us = kms_time_us,
    .delay_us = kms_delay_us,
    .buttons = kms_buttons,
    .close = kms_close,
};
