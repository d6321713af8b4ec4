/*
 * Small triangles with a colour at each corner. Their planes have 16 bits a channel, as ph_pixel_colour takes them;
 * half a step is added, so that a channel is rounded to nearest, and so that none leaves its 16 bits as long as it is
 * off by less than that. Planes are linear, so one that is right at the corners is right between them. See
 * colours_small.h.
 */
/* Kits on armv6m: -O2. */
#include "colours_small.h"

#include "edge.h"
#include "raster_rows.h"
#include "shading.h"
#include "span.h"

enum {
    STEP_LOG2 = 10,  /* green; those of red and blue are twice as large */
    TOLERANCE = 256, /* at a corner: 1/4 step of green */
    STEEP = 1 << 15, /* a pixel: 2^-9 px beside the triangle that is 1/16 step of green */
};

/* Half of the rows of a small triangle: to copy all of them gcc calls a function. */
struct __attribute__((may_alias)) half {
    uint32_t words[sizeof(struct ph_small_triangle) / sizeof(uint32_t) / 2];
};
_Static_assert(sizeof(struct ph_small_triangle) == 2 * sizeof(struct half), "two halves");

/* Draws the rows of a small triangle that lie in the band. */
PH_TIER(few) static uint32_t draw_small(const struct ph_triangle *t, const struct ph_band *band) /* called as draw */
{
    const uint32_t stride_bytes = 2 * (uint32_t)band->stride;
    if (t->y_top >= band->y0 && t->y_bottom <= band->y1) {
        const uint32_t start = (uint32_t)(t->y_top - band->y0) * band->stride;
        return ph_small_colours(&t->as.small, (uint16_t *)band->depth + start, band->pixels + start, stride_bytes);
    }
    const struct half *const from = (const struct half *)(const void *)&t->as.small.rows;
    struct ph_small small;
    struct half *const to = (struct half *)(void *)&small.rows;
    to[0] = from[0];
    to[1] = from[1];
    small.of.own.green = t->as.small.of.own.green;
    small.of.own.green.base += (uint32_t)ph_max(band->y0 - t->y_top, 0) * small.of.own.green.gy;
    const struct ph_place at = ph_cut_rows(t, band, &small.rows);
    return ph_small_colours(&small, at.depth, at.pixels, stride_bytes);
}

/* What the planes of a small triangle share. */
struct corners {
    struct ph_slopes slopes;
    int32_t x, y;               /* from the first corner to the first row, in its pixel's column; 1/256 px */
    int32_t column;             /* that column */
    int32_t dx1, dy1, dx2, dy2; /* from the first corner to the others, 1/256 px */
    uint32_t colours[3];
};

/* A channel of a colour, in the upper bits of 16, and half a step. It is in `mask` once the colour is shifted `up`. */
static inline int32_t channel_of(uint32_t colour, int up, uint32_t mask)
{
    return (int32_t)((colour << up & mask) + ((0x10000 - mask) >> 1));
}

/* Sets the plane of a channel. False if it would be off at a corner, or too steep. */
static FX_APART bool set_channel(struct ph_plane *out, const struct corners *c, int up, uint32_t mask)
{
    const int32_t first = channel_of(c->colours[0], up, mask);
    const int32_t d1 = channel_of(c->colours[1], up, mask) - first, d2 = channel_of(c->colours[2], up, mask) - first;
    const int32_t n1 = d1 >> STEP_LOG2, n2 = d2 >> STEP_LOG2; /* no bit is lost */
    const struct ph_slopes *const s = &c->slopes;
    const int32_t gx = (n2 * s->a - n1 * s->b) >> s->shift, gy = (n1 * s->d - n2 * s->c) >> s->shift;
    const int32_t off1 = ((c->dx1 * gx + c->dy1 * gy) >> 8) - d1, off2 = ((c->dx2 * gx + c->dy2 * gy) >> 8) - d2;
    if (((uint32_t)(gx + STEEP) | (uint32_t)(gy + STEEP)) >= 2 * STEEP ||
        ((uint32_t)(off1 + TOLERANCE) | (uint32_t)(off2 + TOLERANCE)) >= 2 * TOLERANCE) {
        return false;
    }
    *out = (struct ph_plane){(uint32_t)(first + ((c->x * gx + c->y * gy) >> 8) - c->column * gx), (uint32_t)gx,
                             (uint32_t)gy};
    return true;
}

PH_TIER(few)
bool ph_set_small_colours(struct ph_triangle *t, const struct ph_setting *s, const struct ph_vertex *const v[3],
                          const fx_t *const uv[3])
{
    (void)uv;
    const bool flat = ph_lit_corners_of(s->fast.material) == PH_FIRST_CORNER;
    const uint32_t a = v[0]->light, b = flat ? a : v[1]->light, c = flat ? a : v[2]->light;
    const int32_t x = v[0]->x, y = v[0]->y;
    struct corners f = {
        t->as.small.of.slopes, 128 - (x & 255), t->y_top * 256 + 128 - y, x >> 8, v[1]->x - x, v[1]->y - y, v[2]->x - x,
        v[2]->y - y,           {a, b, c}};
    struct ph_plane red, green, blue;
    f.slopes.shift -= STEP_LOG2 + 8; /* gradients are per pixel */
    if (t->block != PH_BLOCK_NONE || f.slopes.shift < 0 || !set_channel(&red, &f, 0, 0xf800) ||
        !set_channel(&green, &f, 5, 0xfc00) || !set_channel(&blue, &f, 11, 0xf800)) {
        return false;
    }
    struct ph_small *const small = &t->as.small;
    small->rows.light = ph_red_blue(red.base, blue.base);
    small->rows.glight = ph_red_blue(red.gx, blue.gx);
    small->rows.light_dy = ph_red_blue(red.gy, blue.gy);
    small->of.own.green.base = green.base << PH_GREEN_LOG2;
    small->of.own.green.gx = green.gx << PH_GREEN_LOG2;
    small->of.own.green.gy = green.gy << PH_GREEN_LOG2;
    small->of.own.draw = draw_small;
    t->kind = PH_KIND_SMALL_OWN;
    return true;
}
