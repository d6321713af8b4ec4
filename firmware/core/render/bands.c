/*
 * Bands: each band sets up and draws its triangles, which feed.h finds. See list.h, render.h.
 *
 * A triangle is set up in the band where it begins. If it goes on below, it is carried on in its slot; if there is no
 * slot for it, its reference moves to the next band, where it is set up again. That gives the same pixels, because what
 * a triangle gives at a pixel depends on the triangle and the pixel alone: planes are exact modulo 2^32. So the number
 * of slots changes the speed, and nothing else.
 */
/* Kits on armv6m: -O2. */
#include "bands.h"

#include "coarse.h"
#include "cores.h"
#include "feed.h"
#include "fog.h"
#include "kernels.h"
#include "points.h"
#include "raster.h"
#include "samples.h"
#include "setup.h"

#define ASKS_REFS 16 /* after so many references one core asks whether the other is idle */
#define HELPED    0  /* draw_begun returns this instead of a reference when the other core has become idle */

/* ---- set-up ----------------------------------------------------------------------------------------------------- */

/* Prepares the draw of a reference that is behind the current draw. */
PH_TIER(mesh) static PH_NOINLINE void enter_draw(struct ph_feed *f, uint32_t ref)
{
    ph_feed_find(f, ref);
    ph_take_lens(f->r, f->draw);
    ph_setting_of(&f->setting, f->r, f->draw);
}

static inline struct ph_triangle *take_slot_or(struct ph_renderer *r, struct ph_triangle *scratch)
{
    struct ph_triangle *const t = ph_take_slot(r);
    return t != NULL ? t : scratch;
}

/* ---- drawing ---------------------------------------------------------------------------------------------------- */

/* Draws a triangle that stands in a slot and goes on below the band. Returns its pixels. carry: as in struct ph_rest.
 */
static inline uint32_t draw_beyond(struct ph_triangle ***carry, struct ph_triangle *t, const struct ph_band *rows)
{
    **carry = t;
    *carry = &t->next;
    return ph_draw_above(t, rows);
}

/* Whether the other core is idle, and there is a row for each. Without another core this saves the call. */
static inline bool is_helped(const struct ph_renderer *r, const struct ph_band *rows)
{
    return r->config.other_core != NULL && rows->y1 - rows->y0 >= 2 && r->config.cores->is_idle(r);
}

/* Draws the carried triangles that come before the next reference, and prepares its draw. Returns the first reference
 * for which there is something to do here; none at the end of the list. */
PH_TIER(scenery) static PH_NOINLINE uint32_t draw_begun(struct ph_feed *f, struct ph_rest *rest)
{
    const uint32_t ref = f->ref;
    struct ph_renderer *const r = f->r;
    const struct ph_band *const rows = rest->rows;
    const int32_t y1 = rows->y1;
    struct ph_triangle *t = rest->begun, **carry = rest->carry;
    uint32_t fragments = rest->fragments;
    while (t != NULL && t->order < ref) {
        struct ph_triangle *const next = t->next;
        if (t->y_bottom <= y1) {
            fragments += ph_draw_end(t, rows);
            ph_free_slot(r, t);
        } else {
            fragments += draw_beyond(&carry, t, rows);
        }
        t = next;
    }
    rest->carry = carry;
    rest->begun = t;
    rest->fragments = fragments;
    if (ref >= f->next_first && ref != PH_NONE) {
        enter_draw(f, ref);
    }
    const uint32_t after = t != NULL ? t->order + 1 : PH_NONE;
    const uint32_t stop = after < f->next_first ? after : f->next_first;
    if (r->config.other_core == NULL) {
        return stop;
    }
    const uint32_t asks = stop < ref + ASKS_REFS ? stop : ref + ASKS_REFS;
    return is_helped(r, rows) ? HELPED : asks;
}

/* Draws the triangles of a band that are left, until the other core is idle: each is set up, drawn, and carried on if
 * it goes on below. */
PH_TIER(mesh) static FX_APART void draw_rest(struct ph_feed *f, struct ph_rest *rest)
{
    struct ph_renderer *const r = f->r;
    const struct ph_band *const rows = rest->rows;
    const int32_t y1 = rows->y1;
    struct ph_triangle scratch, *t = take_slot_or(r, &scratch);
    const struct ph_ref *const first = ph_ref_at(r, 0);
    uint32_t fragments = 0, ref = f->ref;
    for (uint32_t stop = 0;;) {
        if (ref >= stop) { /* so it is at the end of the list */
            f->ref = ref;
            stop = draw_begun(f, rest);
            if (ref == PH_NONE || stop == HELPED) {
                break;
            }
        }
        const struct ph_ref *const at = first - ref;
        ph_setup(&f->setting, at, t);
        t->order = ref;
        ref = ph_next_ref(f, at, ref);
        if (t->y_bottom <= y1) {
            fragments += ph_draw_fresh(t, rows);
        } else if (t != &scratch) {
            fragments += draw_beyond(&rest->carry, t, rows);
            t = take_slot_or(f->r, &scratch); /* not r: no register is left for it in this loop */
        } else {
            fragments += ph_draw_triangle(t, rows);
            ph_feed_put_below(f, t->order, &rest->put);
        }
    }
    rest->fragments += fragments;
    if (t != &scratch) {
        ph_free_slot(r, t);
    }
}

/* ---- bands ----------------------------------------------------------------------------------------------------- */

/* Draws the triangles of a band, with the other core from the moment when it is idle. */
PH_TIER(mesh) static void draw_triangles(struct ph_feed *f, const struct ph_band *rows)
{
    struct ph_renderer *const r = f->r;
    struct ph_rest rest = {r, rows, r->carried, &r->carried, PH_NONE, 0};
    bool clears = r->ahead != NULL || is_helped(r, rows);
    for (const struct ph_triangle *t = r->ahead; t != NULL; t = t->next) {
        f->ref = ph_feed_next(f, t->order);
    }
    bool more = clears;
    if (!clears) {
        ph_clear_rows(r, rows);
        draw_rest(f, &rest);
        more = rest.begun != NULL || f->ref != PH_NONE;
    }
    for (; more; clears = false) {
        more = r->config.cores->draw_chunk(f, &rest, clears);
    }
    *rest.carry = NULL;
    r->stats.fragments += rest.fragments;
}

PH_TIER(mesh) void ph_draw_rows(struct ph_feed *f, struct ph_band *rows)
{
    struct ph_renderer *const r = f->r;
    draw_triangles(f, rows);
    if (r->points != NULL) {
        r->points->draw_opaque(r, rows, f->band);
    }
    if (r->after != NULL) {
        rows->coarse = NULL; /* blended triangles are drawn into rows of their own */
        r->after->draw_after(r, rows);
    } else if (r->fog != NULL) {
        r->fog->fog_band(r, rows);
    }
}

PH_TIER(mesh) uint32_t ph_draw_band(struct ph_renderer *r, uint32_t band, uint16_t *pixels)
{
    const int32_t lines = r->config.band_height, height = r->config.height;
    const int32_t y0 = (int32_t)band * lines, y1 = y0 + lines < height ? y0 + lines : height;
    if (band != r->list.band || band >= r->band_count || (uintptr_t)pixels % sizeof(uint16_t) != 0 || pixels == NULL) {
        return 0;
    }
    const bool depth24 = r->stats.depth_format->bits > 16;
    r->list.band++;
    struct ph_coarse coarse[2]; /* the other core has its own, for its rows */
    coarse[0].count = coarse[1].count = 0;
    coarse[0].occlusion = coarse[1].occlusion = r->config.occlusion;
    struct ph_band rows = {NULL, r->config.depth, depth24, r->config.width,  y0,
                           y1,   r->config.width, NULL,    ph_depth_ways(r), r->config.colouring};
    rows.coarse = r->config.occlusion != NULL ? coarse : NULL;
    struct ph_feed f;
    ph_feed_start(&f, r, band);
    if (r->config.antialiasing != NULL) {
        r->config.antialiasing->draw_samples(&f, &rows, pixels);
    } else {
        rows.pixels = pixels; /* an assignment, not an initialiser: else clang-tidy asks for a const pointer */
        ph_draw_rows(&f, &rows);
    }
    return (uint32_t)(y1 - y0) >> r->samples_log2;
}
