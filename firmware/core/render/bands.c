/*
 * Bands: the list of a frame is sorted into bands, and each band sets up and draws its triangles. See list.h, render.h.
 *
 * A triangle is set up in the band where it begins. If it goes on below, it is carried on in its slot; if there is no
 * slot for it, its reference moves to the next band, where it is set up again. That gives the same pixels, because what
 * a triangle gives at a pixel depends on the triangle and the pixel alone: planes are exact modulo 2^32. So the number
 * of slots changes the speed, and nothing else.
 */
#include "band.h"
#include "edge.h"
#include "kernels.h"
#include "setup.h"

/* The references of a band, one after the other. */
struct feed {
    struct ph_renderer *r;
    uint32_t ref, band;   /* ref: PH_NONE at the end */
    uint32_t next_first;  /* first reference of the draw after this one */
    uint32_t next_place;  /* that draw, or PH_NONE */
    struct ph_setting setting;
};

uint32_t ph_frame_bands(struct ph_renderer *r)
{
    uint32_t *const bins = r->config.bins;
    for (uint32_t i = 0; i < r->band_count; i++) {
        bins[i] = PH_NONE;
    }
    for (uint32_t i = ph_ref_count(r); i-- > 0;) { /* from the last, so that each list is in drawing order */
        struct ph_ref *const ref = ph_ref_at(r, i);
        uint32_t *const bin = &bins[ref->link];
        const uint32_t further = *bin - i;
        ref->link = (uint16_t)(*bin == PH_NONE ? 0 : further < PH_LINK_FAR ? further : PH_LINK_FAR);
        *bin = i;
    }
    r->carried = r->slots = NULL;
    r->slots_used[0] = r->list.used[1];
    r->slots_used[1] = r->list.used[2];
    return r->band_count;
}

/* ---- the list of a band ----------------------------------------------------------------------------------------- */

/* Whether a triangle has rows in the band. Only asked where a list leaps over very many references. */
static bool touches(const struct feed *f, const struct ph_draw *draw, const struct ph_ref *ref)
{
    const size_t size = (draw->kind & PH_DRAW_UVS) != 0 ? sizeof(struct ph_corner) : sizeof(struct ph_vertex);
    const uint8_t *const base = ph_at(f->r, draw->base);
    const int n = (draw->kind & PH_DRAW_LINES) != 0 ? 2 : 3, wide = n == 2 ? 128 : 0;
    const int32_t height = f->r->config.band_height, y0 = (int32_t)f->band * height;
    int32_t top = INT32_MAX, low = INT32_MIN;
    for (int i = 0; i < n; i++) {
        const int32_t y = ((const struct ph_vertex *)(const void *)(base + ref->corner[i] * size))->y;
        top = ph_min(top, y);
        low = ph_max(low, y);
    }
    return ph_first_row(top - wide) < y0 + height && ph_first_row(low + wide) > y0;
}

/* The next reference of the band's list when it is PH_LINK_FAR or further away: the next one that has rows in the band.
 * It may be carried already; then it is drawn twice, and the second time changes nothing. */
static __attribute__((noinline)) uint32_t far_next(const struct feed *f, uint32_t ref)
{
    const struct ph_renderer *const r = f->r;
    const uint32_t count = ph_ref_count(r);
    const struct ph_draw *draw = ph_at(r, r->list.first);
    for (uint32_t i = ref + PH_LINK_FAR; i < count; i++) {
        while (draw->next != PH_NONE && ((const struct ph_draw *)ph_at(r, draw->next))->first <= i) {
            draw = ph_at(r, draw->next);
        }
        if (touches(f, draw, ph_ref_at(r, i))) {
            return i;
        }
    }
    return PH_NONE;
}

static inline uint32_t next_of(const struct feed *f, uint32_t ref)
{
    const uint32_t link = ph_ref_at(f->r, ref)->link;
    return link == 0 ? PH_NONE : link < PH_LINK_FAR ? ref + link : far_next(f, ref);
}

static inline void set_next(struct ph_renderer *r, uint32_t ref, uint32_t next)
{
    const uint32_t further = next - ref;
    ph_ref_at(r, ref)->link = (uint16_t)(next == PH_NONE ? 0 : further < PH_LINK_FAR ? further : PH_LINK_FAR);
}

/* Puts a reference into the list of the band below; *after is the one put there before, or PH_NONE. */
static __attribute__((noinline)) void put_below(const struct feed *f, uint32_t ref, uint32_t *after)
{
    const struct feed below = {.r = f->r, .band = f->band + 1};
    uint32_t *const bin = &f->r->config.bins[below.band], before = *after;
    uint32_t next = before == PH_NONE ? *bin : next_of(&below, before);
    while (next < ref) {
        before = next;
        next = next_of(&below, next);
    }
    set_next(f->r, ref, next);
    if (before == PH_NONE) {
        *bin = ref;
    } else {
        set_next(f->r, before, ref);
    }
    *after = ref;
}

/* ---- set-up ----------------------------------------------------------------------------------------------------- */

static void start(struct feed *f, struct ph_renderer *r, uint32_t band)
{
    f->r = r;
    f->band = band;
    f->ref = r->config.bins[band];
    f->next_first = 0;
    f->next_place = r->list.first;
}

/* Makes the draw of the reference the current one. */
static __attribute__((noinline)) void find_draw(struct feed *f)
{
    const struct ph_draw *draw = NULL;
    while (f->ref >= f->next_first) {
        draw = ph_at(f->r, f->next_place);
        f->next_place = draw->next;
        f->next_first = draw->next == PH_NONE ? PH_NONE : ((const struct ph_draw *)ph_at(f->r, draw->next))->first;
    }
    if (draw->lens != f->r->list.lens) {
        f->r->lens = *(const struct ph_lens *)ph_at(f->r, draw->lens);
        f->r->list.lens = draw->lens;
    }
    ph_setting_of(&f->setting, f->r, draw);
}

/* Sets up the next triangle. */
static void set_up(struct feed *f, struct ph_triangle *t)
{
    const uint32_t ref = f->ref;
    if (ref >= f->next_first) {
        find_draw(f);
    }
    ph_setup(&f->setting, ph_ref_at(f->r, ref), t);
    t->order = ref;
    f->ref = next_of(f, ref);
}

/* ---- slots ------------------------------------------------------------------------------------------------------ */

/* A free slot, or NULL. */
static struct ph_triangle *take_slot(struct ph_renderer *r)
{
    struct ph_triangle *t = r->slots;
    if (t != NULL) {
        r->slots = t->next;
        return t;
    }
    const struct ph_config *c = &r->config;
    uint8_t *const bases[2] = {c->vertices, c->triangles};
    const size_t refs = (size_t)((const uint8_t *)r->list.to - bases[1]);
    const size_t room[2] = {bases[0] == bases[1] ? 0 : c->vertex_max * ph_vertex_bytes, refs};
    for (int i = 1; i >= 0; i--) {
        const size_t at = r->slots_used[i];
        if (at + sizeof *t <= room[i]) {
            r->slots_used[i] = (uint32_t)(at + sizeof *t);
            return (struct ph_triangle *)(void *)(bases[i] + at);
        }
    }
    return NULL;
}

static inline void free_slot(struct ph_renderer *r, struct ph_triangle *t)
{
    t->next = r->slots;
    r->slots = t;
}

/* ---- drawing ---------------------------------------------------------------------------------------------------- */

/* Clears the rows of a band. */
static void clear(const struct ph_band *rows, uint16_t background)
{
    const uint32_t area = (uint32_t)(rows->y1 - rows->y0) * (uint32_t)rows->width;
    ph_fill(rows->pixels, background, area);
    ph_fill(rows->depth, 0, rows->depth24 ? 2 * area : area);
}

/* Draws a band with one core: each triangle is set up, drawn, and carried on if it goes on below. */
static void draw_alone(struct ph_renderer *r, uint32_t band, const struct ph_band *rows)
{
    struct ph_triangle scratch, *slot = NULL, *begun = r->carried, **carry = &r->carried;
    uint32_t put = PH_NONE;
    struct feed f;
    start(&f, r, band);
    clear(rows, r->background);
    while (begun != NULL || f.ref != PH_NONE) {
        struct ph_triangle *t = begun;
        if (t != NULL && t->order < f.ref) {
            begun = t->next;
        } else {
            slot = slot != NULL ? slot : take_slot(r);
            t = slot != NULL ? slot : &scratch;
            set_up(&f, t);
        }
        r->stats.fragments += ph_draw_triangle(t, rows);
        if (t->y_bottom <= rows->y1) {
            if (t != slot && t != &scratch) {
                free_slot(r, t);
            }
        } else if (t == &scratch) {
            put_below(&f, t->order, &put);
        } else {
            slot = t == slot ? NULL : slot;
            ph_step_below(t, rows->y1);
            *carry = t;
            carry = &t->next;
        }
    }
    *carry = NULL;
    if (slot != NULL) {
        free_slot(r, slot);
    }
}

uint32_t ph_draw_band(struct ph_renderer *r, uint32_t band, uint16_t *pixels)
{
    const int32_t lines = r->config.band_height, height = r->config.height;
    const int32_t y0 = (int32_t)band * lines, y1 = y0 + lines < height ? y0 + lines : height;
    const bool depth24 = ph_depth_bytes(r->config.depth_format) == sizeof(uint32_t);
    struct ph_band rows = {NULL, r->config.depth, depth24, y0, y1, r->config.width};
    rows.pixels = pixels; /* set here, because clang-tidy would make a parameter that only initialises const */
    draw_alone(r, band, &rows);
    return (uint32_t)(y1 - y0);
}
