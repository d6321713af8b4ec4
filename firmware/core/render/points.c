/* Points are drawn into bands. See points.h. */
/* Kits on armv6m: -O2. */
#include "points.h"

#include "blend.h"
#include "cores.h"
#include "edge.h"
#include "fog.h"
#include "kernels.h"
#include "span.h"

/* How the pixels of a cloud are drawn. */
struct brush {
    const struct ph_band *band;
    const struct ph_renderer *r;
    const struct ph_blend *blend; /* NULL: opaque */
    uint32_t alpha;               /* blended: 0 .. 32 */
    struct ph_fog_here fog;       /* blended */
};

/* ---- rows ------------------------------------------------------------------------------------------------------- */

static inline uint32_t code_of(const struct ph_spot *s)
{
    return s->code & 0xffffff;
}

/* A pixel of a point: what is behind it, and what becomes of that. */
static uint16_t blend_pixel(struct brush *b, uint16_t behind, const struct ph_spot *s)
{
    const uint32_t pixel = ph_spread(behind);
    if (b->blend->kind == PH_BLEND_TIMES) {
        return ph_fold(ph_spread_mix(pixel, ph_spread(ph_times(behind, s->colour)), b->alpha));
    }
    uint32_t colour = ph_spread(s->colour);
    if (b->r->fog != NULL) {
        ph_fog_at(&b->fog, code_of(s));
        colour = ph_fogged(&b->fog.mix, colour);
    }
    return ph_fold(b->blend->kind == PH_BLEND_ADD ? ph_spread_add(pixel, colour, b->alpha)
                                                  : ph_spread_mix(pixel, colour, b->alpha));
}

/* Blends n pixels of a point from pixel number `at` of the band on. */
static void blend_row(struct brush *b, const struct ph_spot *s, uint32_t at, uint32_t n)
{
    const struct ph_band *const band = b->band;
    const uint32_t code = code_of(s) + (b->blend->kind == PH_BLEND_TIMES); /* TIMES: also over the same depth */
    for (const uint32_t end = at + n; at < end; at++) {
        const uint32_t there =
            band->depth24 ? ((const uint32_t *)band->depth)[at] : ((const uint16_t *)band->depth)[at];
        if (code > there) {
            band->pixels[at] = blend_pixel(b, band->pixels[at], s);
        }
    }
}

static void draw_row(struct brush *b, const struct ph_spot *s, uint32_t at, uint32_t n)
{
    const struct ph_band *const band = b->band;
    if (b->blend != NULL) {
        blend_row(b, s, at, n);
    } else if (band->depth24) {
        ph_span_flat24(band->pixels + at, (uint32_t *)band->depth + at, n, s->code << 8, 0, s->colour);
    } else {
        ph_span_flat(band->pixels + at, (uint16_t *)band->depth + at, n, s->code << 16, 0, s->colour);
    }
}

/* ---- points ----------------------------------------------------------------------------------------------------- */

static inline struct ph_spot *spot_at(const struct ph_cloud *cloud, uint32_t number)
{
    return (struct ph_spot *)(uintptr_t)cloud + number;
}

static inline int32_t radius_of(const struct ph_spot *s)
{
    return (s->of.disc.x_radius & 4095) * 16;
}

/* The row behind the last one; 0: it has one only. */
static int32_t end_row(const struct ph_spot *s)
{
    return ph_spot_shape(s) == PH_SPOT_DISC     ? ph_first_row(s->of.disc.y + radius_of(s))
           : ph_spot_shape(s) == PH_SPOT_SQUARE ? s->of.square.y1
                                                : 0;
}

static inline int32_t x_of(const struct ph_spot *s)
{
    return s->of.disc.x_radius >> 12;
}

static struct ph_box box_of(const struct ph_spot *s)
{
    if (ph_spot_shape(s) == PH_SPOT_SQUARE) {
        return (struct ph_box){s->of.square.x0, s->of.square.x1, s->of.square.y0, s->of.square.y1};
    }
    const int32_t x = x_of(s), y = s->of.disc.y, radius = radius_of(s);
    return (struct ph_box){ph_first_row(x - radius), ph_first_row(x + radius), ph_first_row(y - radius), end_row(s)};
}

/* v^2, |v| < 65536. */
static inline uint32_t square(int32_t v)
{
    return (uint32_t)v * (uint32_t)v;
}

/* Takes off the columns of a disc's row whose centres are not inside the circle. */
static void cut_to_circle(const struct ph_spot *s, int32_t y, struct ph_box *row)
{
    const int32_t down = y * 256 + 128 - s->of.disc.y, radius = radius_of(s);
    const uint32_t limit = square(radius) - square(down);
    int32_t left = row->x0 * 256 + 128 - x_of(s), right = row->x1 * 256 - 128 - x_of(s);
    for (; left <= right && square(left) >= limit; left += 256) {
        row->x0++;
    }
    for (; left <= right && square(right) >= limit; right -= 256) {
        row->x1--;
    }
}

/* Draws the part of a square or a disc that lies in the band. Returns the pixels tested. */
static PH_NOINLINE uint32_t draw_spot(struct brush *b, const struct ph_spot *s)
{
    const struct ph_band *const band = b->band;
    const struct ph_box box = box_of(s);
    const int32_t end = ph_min(box.y1, band->y1);
    uint32_t count = 0;
    for (int32_t y = ph_max(box.y0, band->y0); y < end; y++) {
        struct ph_box row = box;
        if (ph_spot_shape(s) == PH_SPOT_DISC) {
            cut_to_circle(s, y, &row);
        }
        const int32_t from = ph_max(row.x0, 0), to = ph_min(row.x1, band->width);
        if (from < to) {
            draw_row(b, s, (uint32_t)(y - band->y0) * band->stride + (uint32_t)from, (uint32_t)(to - from));
            count += (uint32_t)(to - from);
        }
    }
    return count;
}

/* Draws a list of points. Returns the pixels tested of those of several; single ones are counted when they are listed.
 */
static uint32_t draw_list(struct brush *b, const struct ph_cloud *cloud, uint32_t number)
{
    const struct ph_band *const band = b->band;
    const uint32_t start = (uint32_t)band->y0 * band->stride, n = (uint32_t)(band->y1 - band->y0) * band->stride;
    uint32_t count = 0;
    while (number != 0) {
        const struct ph_spot *const s = spot_at(cloud, number);
        const uint32_t at = s->of.pixel - start;
        number = s->next;
        if (ph_spot_shape(s) != PH_SPOT_PIXEL) {
            count += draw_spot(b, s);
        } else if (at < n) {
            draw_row(b, s, at, 1);
        }
    }
    return count;
}

/* draw_list for opaque points in all rows of a band, with depth of 16 bits. */
PH_TIER(figure) static uint32_t draw_band16(struct brush *b, const struct ph_cloud *cloud, uint32_t number)
{
    uint16_t *const pixels = b->band->pixels, *const depth = b->band->depth;
    const uint32_t start = (uint32_t)b->band->y0 * b->band->stride;
    uint32_t count = 0;
    while (number != 0) {
        const struct ph_spot *const s = spot_at(cloud, number);
        const uint32_t code = s->code, at = s->of.pixel - start;
        number = s->next;
        if (code >> 24 != PH_SPOT_PIXEL) {
            count += draw_spot(b, s);
        } else if (code > depth[at]) {
            PH_KEEP_BRANCH();
            depth[at] = (uint16_t)code;
            pixels[at] = s->colour;
        }
    }
    return count;
}

/* ---- bands ------------------------------------------------------------------------------------------------------ */

/* Moves the points that go on below row y from the list of the band above to that of band number `number`. */
static void carry(struct ph_cloud *cloud, uint32_t number, int32_t y)
{
    uint16_t *link = &cloud->first[number];
    for (uint16_t next, i = cloud->first[number - 1]; i != 0; i = next) {
        struct ph_spot *const s = spot_at(cloud, i);
        next = s->next;
        if (end_row(s) > y) {
            while (*link != 0 && *link < i) {
                link = &spot_at(cloud, *link)->next;
            }
            s->next = *link;
            *link = i;
        }
    }
}

/* Draws the opaque points that lie in rows of band number `number`; whole: in all of them. Returns the pixels tested.
 */
static uint32_t draw_rows(const struct ph_renderer *r, const struct ph_band *rows, uint32_t number, bool whole)
{
    struct brush b; /* the rest is for blends */
    uint32_t count = 0;
    b.band = rows;
    b.blend = NULL;
    const struct ph_cloud *cloud;
    for (uint32_t place = r->clouds; place != PH_NONE; place = cloud->next) {
        cloud = ph_at(r, place);
        if (!cloud->is_blended) {
            const uint32_t first = cloud->first[number];
            count += whole && !rows->depth24 ? draw_band16(&b, cloud, first) : draw_list(&b, cloud, first);
        }
    }
    return count;
}

static void draw_share(void *argument) /* called as run */
{
    struct ph_share *const s = argument;
    s->fragments = draw_rows(s->r, &s->band, ph_band_of(s->r, s->band.y0), s->parts == 1);
}

static void draw_opaque(struct ph_renderer *r, const struct ph_band *band, uint32_t number)
{
    struct ph_cloud *cloud;
    for (uint32_t place = r->clouds; number > 0 && place != PH_NONE; place = cloud->next) {
        cloud = ph_at(r, place);
        if (cloud->goes_below) {
            carry(cloud, number, band->y0);
        }
    }
    if (r->config.other_core == NULL) {
        r->stats.fragments += draw_rows(r, band, number, true);
    } else {
        ph_draw_in_parts(r, band, (band->y1 - band->y0) / 2, draw_share);
    }
}

static uint32_t draw_blended(const struct ph_renderer *r, const struct ph_band *band, const struct ph_draw *draw)
{
    const struct ph_cloud *const cloud = ph_at(r, draw->base);
    struct brush b = {.band = band, .r = r, .blend = draw->material->blend};
    b.alpha = b.blend->alpha < 32 ? b.blend->alpha : 32;
    if (b.alpha == 0) {
        return 0;
    }
    ph_fog_start(&b.fog, r, b.blend->kind == PH_BLEND_ADD ? 0 : r->fog_of.colour);
    return draw_list(&b, cloud, cloud->first[ph_band_of(r, band->y0)]);
}

const struct ph_pointing ph_pointing = {.draw_opaque = draw_opaque, .draw_blended = draw_blended};
