/* See panel_tiles.h. */
#include "panel_tiles.h"

#include <string.h>

/* States of a band, in `rest`. Other values count down the frames in which it is still sent whole. */
enum {
    WATCHED = 0,
    NEARLY_ALL = 255, /* signatures are compared, and nearly all tiles changed last time */
    REST_FRAMES = 16, /* frames in which a band is sent whole; signatures are made in the last of them, at 1 */
    SLOW_REST = 100,  /* as REST_FRAMES, for all bands, where signatures cost more than they save */
};

/* Above this share, sending the other tiles costs less than making signatures. */
static bool is_nearly_all(uint32_t changed, uint32_t columns)
{
    return 8 * changed >= 7 * columns;
}

/* Mixes two pixels into a signature. Each step can be undone, so a change of one word always changes the signature. */
static inline uint32_t mix(uint32_t sign, uint32_t factor, const uint16_t *two_pixels)
{
    uint32_t word;
    __builtin_memcpy(&word, __builtin_assume_aligned(two_pixels, 4), sizeof word); /* one load, no call */
    const uint32_t mixed = (sign ^ word) * factor;
    return mixed >> 15 | mixed << 17;
}

/* The signature of a whole tile. This is the only loop over all pixels of a frame. */
HAL_TIER(loop) static uint32_t sign_tile(const uint16_t *pixels, uint32_t stride, uint32_t lines, uint32_t factor)
{
    uint32_t sign = 0;
    for (const uint16_t *end = pixels + stride * lines; pixels != end; pixels += stride) {
        sign = mix(sign, factor, pixels);
        sign = mix(sign, factor, pixels + 2);
        sign = mix(sign, factor, pixels + 4);
        sign = mix(sign, factor, pixels + 6);
        sign = mix(sign, factor, pixels + 8);
        sign = mix(sign, factor, pixels + 10);
        sign = mix(sign, factor, pixels + 12);
        sign = mix(sign, factor, pixels + 14);
    }
    return sign;
}

/* Continues a signature over n pixels in one piece. */
HAL_TIER(loop) static uint32_t sign_piece(uint32_t sign, uint32_t factor, const uint16_t *pixels, uint32_t n)
{
    for (; n >= 2; n -= 2, pixels += 2) {
        sign = mix(sign, factor, pixels);
    }
    const uint16_t last[2] __attribute__((aligned(4))) = {n > 0 ? *pixels : 0, 0};
    return n > 0 ? mix(sign, factor, last) : sign;
}

/* Lines of odd width are not aligned to words; then a band is one tile, as wide as the picture. */
static uint32_t tile_width(const struct panel_tiles *t)
{
    return t->width % 2 == 0 ? PANEL_TILE_PX : t->width;
}

HAL_TIER(loop)
static uint32_t sign_of(const struct panel_tiles *t, const uint16_t *pixels, uint32_t column, uint32_t lines)
{
    const uint32_t x = column * PANEL_TILE_PX;
    if (t->width % 2 != 0) {
        return sign_piece(0, t->factor, pixels, t->width * lines);
    }
    if (x + PANEL_TILE_PX <= t->width) {
        return sign_tile(pixels + x, t->width, lines, t->factor);
    }
    uint32_t sign = 0;
    for (uint32_t y = 0; y < lines; y++) {
        sign = sign_piece(sign, t->factor, pixels + y * t->width + x, t->width - x);
    }
    return sign;
}

static uint32_t columns_of(uint32_t width)
{
    return width % 2 == 0 ? (width + PANEL_TILE_PX - 1) / PANEL_TILE_PX : 1;
}

static uint32_t bands_of(uint32_t height, uint32_t lines)
{
    return lines > 0 ? (height + lines - 1) / lines : 0;
}

size_t panel_tiles_bytes(uint16_t width, uint16_t height, uint16_t lines)
{
    return (size_t)bands_of(height, lines) * (columns_of(width) * sizeof(uint32_t) + 1);
}

int panel_tiles_init(struct panel_tiles *t, const struct panel_driver *d, uint16_t lines, void *memory, size_t bytes)
{
    const size_t needed = panel_tiles_bytes(d->width, d->height, lines);
    if (needed == 0 || bytes < needed || d->config.format != PANEL_RGB565) {
        return HAL_EINVAL;
    }
    const uint32_t columns = columns_of(d->width), bands = bands_of(d->height, lines);
    *t = (struct panel_tiles){.width = d->width,
                              .height = d->height,
                              .lines = lines,
                              .columns = (uint16_t)columns,
                              .bands = (uint16_t)bands,
                              .factor = 0x9e3779b1, /* 2^32 over the golden ratio */
                              .unknown = true};
    t->signs = memory;
    t->rest = (uint8_t *)(t->signs + columns * bands);
    return HAL_OK;
}

uint32_t panel_tiles_refresh_frames(const struct panel_tiles *t)
{
    return (uint32_t)t->columns * t->bands;
}

/*
 * Takes the time of the frame before. If two in a row took longer than a whole frame takes on the bus, the kit waits
 * for its cores: then all bands rest, for signatures cost the cores time. If one of the rest's first three frames is no
 * faster (with few buffers the cores wait for the bus all the same), the rest ends. After SLOW_REST frames it is tried
 * again.
 */
static void weigh(struct panel_tiles *t, const struct panel_driver *d)
{
    const uint32_t now_us = d->hal.ops->time_us(d->hal.context), took_us = now_us - t->begun_us;
    const uint32_t bus_us =
        panel_frame_us(d->config.panel, d->config.format, d->config.rotation, (uint32_t)d->clock_hz);
    t->begun_us = now_us;
    if (t->unknown || t->whole) { /* the time says nothing */
        t->resting = t->slow = 0;
    } else if (t->resting > 0) {
        t->resting--;
        if (t->resting >= SLOW_REST - 3 && took_us >= t->watched_us) {
            t->watched_us = UINT32_MAX; /* once */
            memset(t->rest, 1, t->bands);
        }
    } else if (took_us <= bus_us + bus_us / 64) {
        t->slow = 0;
    } else if (++t->slow == 2) {
        memset(t->rest, SLOW_REST, t->bands);
        t->watched_us = took_us;
        t->resting = SLOW_REST;
        t->slow = 0;
    }
}

void panel_tiles_forget(struct panel_tiles *t)
{
    t->unknown = true;
}

int panel_tiles_begin(struct panel_tiles *t, struct panel_driver *d)
{
    weigh(t, d);
    t->whole = t->unknown;
    t->unknown = true; /* until all bands have been sent without error */
    t->row = 0;
    t->open_x = t->open_end = 0;
    t->turn = (t->turn + 1) % panel_tiles_refresh_frames(t);
    if (t->whole) {
        memset(t->rest, 1, t->bands);
        t->status = panel_frame_begin(d);
        t->open_end = t->width;
    } else {
        panel_windows_begin(d);
        t->status = HAL_OK;
    }
    return t->status;
}

/* Sends tiles first .. end - 1 of the band. */
static int send_tiles(struct panel_tiles *t, struct panel_driver *d, const uint16_t *pixels, uint32_t lines,
                      uint32_t first, uint32_t end)
{
    const uint32_t x = first * tile_width(t);
    const uint32_t x1 = end * tile_width(t) < t->width ? end * tile_width(t) : t->width;
    int status = HAL_OK;
    if (x != t->open_x ||
        x1 != t->open_end) { /* the window reaches down to the last line, so that the bands below can continue in it */
        status = panel_window(d, x, t->row, x1 - x, (uint32_t)t->height - t->row);
        t->open_x = (uint16_t)x;
        t->open_end = (uint16_t)x1;
    }
    return status < 0 ? status : panel_window_rows(d, pixels + x, t->width, lines);
}

/* Whether a tile has another signature than before. The new one is kept. */
static bool is_other(uint32_t *kept, uint32_t sign)
{
    const bool other = *kept != sign;
    *kept = sign;
    return other;
}

/* Sends the tiles that changed. The next band can continue only in the last window of this band. */
static int send_changed(struct panel_tiles *t, struct panel_driver *d, const uint16_t *pixels, uint32_t lines,
                        uint32_t band)
{
    uint32_t *signs = t->signs + band * t->columns;
    const uint32_t turn = t->turn - band * t->columns;
    uint32_t changed = 0, first = 0;
    int status = HAL_OK;
    bool sent = false;
    for (uint32_t i = 0; i <= t->columns && status >= 0; i++) {
        const bool other = i < t->columns && is_other(&signs[i], sign_of(t, pixels, i, lines));
        changed += other;
        if (other || (i < t->columns && i == turn)) {
            continue;
        }
        if (first < i) {
            status = send_tiles(t, d, pixels, lines, first, i);
            sent = true;
        }
        first = i + 1;
    }
    if (!sent) {
        t->open_x = t->open_end = 0;
    }
    const bool again = t->rest[band] == NEARLY_ALL;
    t->rest[band] = !is_nearly_all(changed, t->columns) ? WATCHED : again ? REST_FRAMES : NEARLY_ALL;
    return status;
}

static int send_whole(struct panel_tiles *t, struct panel_driver *d, const uint16_t *pixels, uint32_t lines,
                      uint32_t band)
{
    if (--t->rest[band] == 0) {
        for (uint32_t i = 0; i < t->columns; i++) {
            t->signs[band * t->columns + i] = sign_of(t, pixels, i, lines);
        }
        t->rest[band] = NEARLY_ALL;
    }
    return send_tiles(t, d, pixels, lines, 0, t->columns);
}

int panel_tiles_rows(struct panel_tiles *t, struct panel_driver *d, const uint16_t *pixels, uint32_t lines)
{
    const uint32_t left = (uint32_t)t->height - t->row, band = t->row / t->lines;
    if (t->status < 0 || left == 0 || lines != (left < t->lines ? left : t->lines)) {
        return t->status < 0 ? t->status : HAL_EINVAL;
    }
    const bool watched = t->rest[band] == WATCHED || t->rest[band] == NEARLY_ALL;
    t->status = watched ? send_changed(t, d, pixels, lines, band) : send_whole(t, d, pixels, lines, band);
    t->row = (uint16_t)(t->row + lines);
    t->unknown = t->status < 0 || t->row < t->height;
    return t->status;
}

int panel_tiles_end(struct panel_tiles *t, struct panel_driver *d)
{
    const int status = t->whole ? panel_frame_end(d) : panel_wait(d);
    t->unknown = t->unknown || status < 0 || t->status < 0;
    if (status < 0 || t->status < 0) {
        return t->status < 0 ? t->status : status;
    }
    return t->row == t->height ? HAL_OK : HAL_EINVAL;
}

/* ---- as a sender -------------------------------------------------------------------------------- */

static int sender_begin(void *tiles, struct panel_driver *d)
{
    return panel_tiles_begin(tiles, d);
}

static int sender_rows(void *tiles, struct panel_driver *d, const uint16_t *pixels, uint32_t lines)
{
    return panel_tiles_rows(tiles, d, pixels, lines);
}

static int sender_end(void *tiles, struct panel_driver *d)
{
    return panel_tiles_end(tiles, d);
}

static void sender_forget(void *tiles)
{
    panel_tiles_forget(tiles);
}

struct panel_sender panel_tiles_sender(struct panel_tiles *t)
{
    static const struct panel_sender_ops ops = {
        .skips = true, .begin = sender_begin, .rows = sender_rows, .end = sender_end, .forget = sender_forget};
    return (struct panel_sender){&ops, t};
}
