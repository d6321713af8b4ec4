/*
 * Bands: each band sets up and draws its triangles, which feed.h finds. See list.h, render.h.
 *
 * A triangle is set up in the band where it begins. If it goes on below, it is carried on in its slot; if there is no
 * slot for it, its reference moves to the next band, where it is set up again. That gives the same pixels, because what
 * a triangle gives at a pixel depends on the triangle and the pixel alone: planes are exact modulo 2^32. So the number
 * of slots changes the speed, and nothing else.
 */
/* Kits on armv6m: -O2. */
#include "check.h"
#include "coarse.h"
#include "cores.h"
#include "feed.h"
#include "kernels.h"
#include "raster.h"
#include "samples.h"
#include "setup.h"

#define ASKS_REFS 16 /* after so many references one core asks whether the other is idle */
#define HELPED    0  /* draw_begun returns this instead of a reference when the other core has become idle */
#define SPARES    8
#define CHUNK     32 /* triangles that two cores set up at a time, most */

/* ---- set-up ----------------------------------------------------------------------------------------------------- */

PH_TIER(mesh) void ph_take_lens(struct ph_renderer *r, const struct ph_draw *draw)
{
    if (draw->lens != r->list.lens) {
        r->lens = *(const struct ph_lens *)ph_at(r, draw->lens);
        r->list.lens = draw->lens;
    }
}

/* Prepares the draw of a reference that is behind the current draw. */
PH_TIER(mesh) static PH_NOINLINE void enter_draw(struct ph_feed *f, uint32_t ref)
{
    ph_feed_find(f, ref);
    ph_take_lens(f->r, f->draw);
    ph_setting_of(&f->setting, f->r, f->draw);
}

/* The reference after number ref, which stands at `at`. */
static inline uint32_t next_ref(const struct ph_feed *f, const struct ph_ref *at, uint32_t ref)
{
    return at->link - 1u < PH_LINK_FAR - 1u ? ref + at->link : ph_feed_next(f, ref);
}

/* ---- slots ------------------------------------------------------------------------------------------------------ */

/* A slot behind the `used` bytes at base, or NULL. */
static inline struct ph_triangle *slot_behind(void *base, uint32_t *used, size_t room)
{
    const uint32_t at = *used;
    if (at + sizeof(struct ph_triangle) > room) {
        return NULL;
    }
    *used = (uint32_t)(at + sizeof(struct ph_triangle));
    return (struct ph_triangle *)(void *)((uint8_t *)base + at);
}

/* An unused slot, or NULL. */
PH_TIER(mesh) static struct ph_triangle *take_slot(struct ph_renderer *r)
{
    const struct ph_config *c = &r->config;
    struct ph_triangle *t = r->slots;
    if (t != NULL) {
        r->slots = t->next;
        return t;
    }
    t = slot_behind(c->triangles, &r->slots_used[1], (size_t)((uint8_t *)r->list.to - (uint8_t *)c->triangles));
    return t == NULL && c->vertices != c->triangles
               ? slot_behind(c->vertices, &r->slots_used[0], c->vertex_max * ph_vertex_bytes)
               : t;
}

static inline struct ph_triangle *take_slot_or(struct ph_renderer *r, struct ph_triangle *scratch)
{
    struct ph_triangle *const t = take_slot(r);
    return t != NULL ? t : scratch;
}

static inline void free_slot(struct ph_renderer *r, struct ph_triangle *t)
{
    t->next = r->slots;
    r->slots = t;
}

/* ---- drawing ---------------------------------------------------------------------------------------------------- */

PH_TIER(mesh) static void clear_depth(const struct ph_band *rows)
{
    const uint32_t area = (uint32_t)(rows->y1 - rows->y0) * (uint32_t)rows->width;
    ph_fill(rows->depth, 0, rows->depth24 ? 2 * area : area);
}

/* Clears the rows of a band; of samples only depth, see ph_samples_clear. */
PH_TIER(mesh) static void clear(const struct ph_renderer *r, const struct ph_band *rows)
{
    if (r->samples_log2 == 0) {
        ph_fill(rows->pixels, r->background, (uint32_t)(rows->y1 - rows->y0) * (uint32_t)rows->width);
    }
    clear_depth(rows);
}

/* A band that is being drawn. */
struct rest {
    struct ph_renderer *r;
    const struct ph_band *rows;
    struct ph_triangle *begun;  /* those that were carried on, as far as they are not drawn */
    struct ph_triangle **carry; /* where the next one is linked that is carried on from here */
    uint32_t put, fragments;    /* put: what ph_feed_put_below takes */
};

/* Draws a triangle that stands in a slot and goes on below the band. Returns its pixels. carry: as in struct rest. */
static inline uint32_t draw_beyond(struct ph_triangle ***carry, struct ph_triangle *t, const struct ph_band *rows)
{
    **carry = t;
    *carry = &t->next;
    return ph_draw_above(t, rows);
}

/* Whether the other core is idle, and there is a row for each. */
static inline bool is_helped(const struct ph_renderer *r, const struct ph_band *rows)
{
    return rows->y1 - rows->y0 >= 2 && ph_other_core_is_idle(r);
}

/* Draws the carried triangles that come before the next reference, and prepares its draw. Returns the first reference
 * for which there is something to do here; none at the end of the list. */
PH_TIER(scenery) static PH_NOINLINE uint32_t draw_begun(struct ph_feed *f, struct rest *rest)
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
            free_slot(r, t);
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
PH_TIER(mesh) static FX_APART void draw_rest(struct ph_feed *f, struct rest *rest)
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
        ref = next_ref(f, at, ref);
        if (t->y_bottom <= y1) {
            fragments += ph_draw_fresh(t, rows);
        } else if (t != &scratch) {
            fragments += draw_beyond(&rest->carry, t, rows);
            t = take_slot_or(r, &scratch);
        } else {
            fragments += ph_draw_triangle(t, rows);
            ph_feed_put_below(f, t->order, &rest->put);
        }
    }
    rest->fragments += fragments;
    if (t != &scratch) {
        free_slot(r, t);
    }
}

/* ---- two cores -------------------------------------------------------------------------------------------------- */

/* Slots for a chunk when all others hold triangles that were carried on. */
struct spares {
    struct ph_triangle at[SPARES];
    uint32_t used;
};

/* Triangles that both cores draw, each in its rows of the band. */
struct drawn {
    const struct ph_feed *f;
    struct ph_triangle *list;
    const struct spares *spares;
    struct rest *rest;
};

/* Carries the triangles that go on below the band to the next band. */
PH_TIER(figure) static void keep_below(const struct drawn *d)
{
    struct rest *const rest = d->rest;
    const struct ph_triangle *const spares = d->spares->at;
    const int32_t y1 = rest->rows->y1;
    for (struct ph_triangle *next, *list = d->list; list != NULL; list = next) {
        const bool spare = list >= spares && list < spares + SPARES;
        struct ph_triangle *const t = spare && list->y_bottom > y1 ? take_slot(rest->r) : list;
        next = list->next;
        if (list->y_bottom <= y1) {
            if (!spare) {
                free_slot(rest->r, t);
            }
        } else if (t == NULL) {
            ph_feed_put_below(d->f, list->order, &rest->put);
        } else {
            if (spare) {
                *t = *list;
            }
            ph_step_below(t, y1);
            *rest->carry = t;
            rest->carry = &t->next;
        }
    }
}

/*
 * Triangles that two cores set up: core 0 from the first on, core 1 from the last one back, until they meet. Each says
 * how far it claims to have come before it looks at the other's claim. So of the last triangle that both claim at once
 * neither sets it up, and no triangle is set up twice.
 */
struct fresh {
    struct ph_renderer *r;
    struct ph_triangle *first, *last, *met; /* met: where core 0 stopped */
    uint32_t count;                         /* COUNTING until the list is complete */
    uint32_t claimed[2];
    uint32_t drawn_below;      /* 1: core 1 has drawn its rows of `drawn` */
    const struct drawn *drawn; /* core 0 carries it on then; NULL: nothing, or it has done so */
};

#define COUNTING UINT32_MAX
#define MAY_ASK  1000 /* times, for the list; then core 0 sets up all of it */

/* The part of a set-up by two cores that one of them does. */
struct set_up_share {
    struct fresh *fresh;
    uint32_t core;
};

PH_TIER(figure) static void set_up_fresh(void *argument) /* called as run */
{
    const struct set_up_share *const mine = argument;
    struct fresh *const s = mine->fresh;
    const uint32_t core = mine->core;
    struct ph_setting setting;
    const struct ph_draw *draw = NULL; /* that of the setting */
    uint32_t count = COUNTING;
    for (uint32_t asked = 0; count == COUNTING && asked < MAY_ASK; asked++) {
        count = __atomic_load_n(&s->count, __ATOMIC_SEQ_CST);
    }
    if (count == COUNTING) { /* core 0 may still be writing the list */
        return;
    }
    struct ph_triangle *t = core == 0 ? s->first : s->last;
    for (uint32_t n = 1; count > 0; n++) {
        if (core == 0 && s->drawn != NULL && __atomic_load_n(&s->drawn_below, __ATOMIC_SEQ_CST) != 0) {
            keep_below(s->drawn);
            s->drawn = NULL;
        }
        __atomic_store_n(&s->claimed[core], n, __ATOMIC_SEQ_CST);
        if (n + __atomic_load_n(&s->claimed[1 - core], __ATOMIC_SEQ_CST) > count) {
            break;
        }
        struct ph_triangle *const next = core == 0 ? t->next : t->as.listed.before;
        if (t->as.listed.draw != draw) {
            draw = t->as.listed.draw;
            ph_setting_of(&setting, s->r, draw);
        }
        ph_setup(&setting, ph_ref_at(s->r, t->order), t);
        t = next;
    }
    if (core == 0) {
        s->met = t;
    }
}

/* Sets up the triangle that both cores claimed, if there is one, when both have stopped. */
PH_TIER(figure) static void finish_fresh(struct fresh *s)
{
    if (s->count > 0 && s->claimed[0] - 1 + (s->claimed[1] > 0 ? s->claimed[1] - 1 : 0) < s->count) {
        struct fresh one = {.r = s->r, .first = s->met, .count = 1};
        set_up_fresh(&(struct set_up_share){&one, 0});
    }
}

PH_TIER(figure) static struct ph_triangle *take_slot_or_spare(struct ph_renderer *r, struct spares *spares)
{
    struct ph_triangle *const t = take_slot(r);
    return t != NULL || spares == NULL || spares->used == SPARES ? t : &spares->at[spares->used++];
}

/* Takes slots for the next triangles of the band, as far as there are any, and of one camera: that of the first, or
 * without spares that of the picture now. */
PH_TIER(figure) static void take_chunk(struct ph_feed *f, struct spares *spares, struct fresh *fresh)
{
    struct ph_renderer *const r = f->r;
    struct ph_triangle **link = &fresh->first, *last = NULL;
    uint32_t count = 0;
    for (; count < CHUNK && f->ref != PH_NONE; count++) {
        if (f->ref >= f->next_first) {
            ph_feed_find(f, f->ref);
        }
        if (count == 0 && spares != NULL) {
            ph_take_lens(r, f->draw);
        }
        struct ph_triangle *const t = f->draw->lens == r->list.lens ? take_slot_or_spare(r, spares) : NULL;
        if (t == NULL) {
            break;
        }
        t->order = f->ref;
        t->as.listed.draw = f->draw;
        t->as.listed.before = last;
        *link = last = t;
        link = &t->next;
        f->ref = next_ref(f, ph_ref_at(r, f->ref), f->ref);
    }
    *link = NULL;
    fresh->last = last;
    __atomic_store_n(&fresh->count, count, __ATOMIC_SEQ_CST);
}

/* The rows that one of two cores draws; then it sets up the triangles that come next. */
struct share {
    struct set_up_share then;
    struct ph_feed *next; /* core 0: it takes the next triangles from here first; NULL: it does not */
    const struct ph_triangle *first;
    uint32_t fragments;
    bool clears;
    struct ph_band rows;
};

/* Draws one core's rows, then sets up triangles that come next. The list must not change until both cores have
 * returned. */
PH_TIER(figure) static void draw_share(void *argument) /* called as run */
{
    struct share *const s = argument;
    struct fresh *const fresh = s->then.fresh;
    s->fragments = 0;
    if (s->next != NULL) {
        take_chunk(s->next, NULL, fresh);
    }
    if (s->clears) {
        clear(fresh->r, &s->rows);
    }
    for (const struct ph_triangle *t = s->first; t != NULL; t = t->next) {
        if (t->y_top < s->rows.y1 && t->y_bottom > s->rows.y0) {
            s->fragments += ph_draw_triangle(t, &s->rows);
        }
    }
    if (s->then.core == 1) {
        __atomic_store_n(&fresh->drawn_below, 1, __ATOMIC_SEQ_CST);
    }
    set_up_fresh(&s->then);
}

/* Merges two lists in drawing order: all of a, and of *b what comes before `end`. */
PH_TIER(figure) static struct ph_triangle *merge(struct ph_triangle *a, struct ph_triangle **b, uint32_t end)
{
    struct ph_triangle *first = NULL, **link = &first;
    for (;;) {
        struct ph_triangle *t = a;
        if (*b != NULL && (*b)->order < (a != NULL ? a->order : end)) {
            t = *b;
            *b = t->next;
        } else if (a != NULL) {
            a = a->next;
        } else {
            break;
        }
        *link = t;
        link = &t->next;
    }
    *link = NULL;
    return first;
}

/* Draws triangles in two halves of the band, the lower one on the other core, carries them on, and sets up those that
 * come next there, unless it is NULL. */
PH_TIER(figure) static void draw_list(struct ph_feed *next, const struct drawn *drawn, bool clears)
{
    struct rest *const rest = drawn->rest;
    const struct ph_band *const rows = rest->rows;
    struct ph_renderer *const r = rest->r;
    struct fresh fresh = {.r = r, .count = next != NULL ? COUNTING : 0, .drawn = drawn};
    struct share upper = {.then = {&fresh, 0}, .first = drawn->list, .clears = clears, .rows = *rows}, lower = upper;
    upper.next = next;
    lower.then.core = 1;
    lower.rows = ph_cut_lower(&upper.rows, (rows->y1 - rows->y0) / 2);
    lower.rows.coarse = rows->coarse + 1;
    ph_run_both(r, draw_share, &upper, &lower);
    if (fresh.drawn != NULL) {
        keep_below(fresh.drawn);
    }
    finish_fresh(&fresh);
    r->ahead = fresh.first;
    rest->fragments += upper.fragments + lower.fragments;
}

/* Sets up the next triangles of a band, as many as there are slots. */
PH_TIER(figure) static struct ph_triangle *set_up_chunk(struct ph_feed *f, struct spares *spares)
{
    struct fresh fresh = {.r = f->r};
    struct set_up_share mine = {&fresh, 0}, others = {&fresh, 1};
    take_chunk(f, spares, &fresh);
    ph_run_both(f->r, set_up_fresh, &mine, &others);
    finish_fresh(&fresh);
    return fresh.first;
}

/* Draws some triangles of a band with two cores: those that are set up already, or the next. Triangles that come next
 * are set up meanwhile, also of the band below, where no reference is put any more then. False: the band is finished.
 */
PH_TIER(figure) static PH_NOINLINE bool draw_chunk(struct ph_feed *f, struct rest *rest, bool clears)
{
    struct ph_renderer *const r = f->r;
    struct spares spares;
    spares.used = 0;
    struct ph_triangle *const fresh = r->ahead != NULL ? r->ahead : set_up_chunk(f, &spares);
    struct ph_triangle *const list = merge(fresh, &rest->begun, f->ref);
    const bool more = f->ref != PH_NONE;
    struct ph_feed below, *next = more ? f : NULL;
    if (!more && spares.used == 0 && rest->rows->y1 + 2 <= r->config.height) {
        ph_feed_start(&below, r, f->band + 1);
        next = &below;
    }
    draw_list(next, &(struct drawn){f, list, &spares, rest}, clears);
    return more;
}

/* Draws the triangles of a band, with the other core from the moment when it is idle. */
PH_TIER(mesh) static void draw_triangles(struct ph_feed *f, const struct ph_band *rows)
{
    struct ph_renderer *const r = f->r;
    struct rest rest = {r, rows, r->carried, &r->carried, PH_NONE, 0};
    bool clears = r->ahead != NULL || is_helped(r, rows);
    for (const struct ph_triangle *t = r->ahead; t != NULL; t = t->next) {
        f->ref = ph_feed_next(f, t->order);
    }
    bool more = clears;
    if (!clears) {
        clear(r, rows);
        draw_rest(f, &rest);
        more = rest.begun != NULL || f->ref != PH_NONE;
    }
    for (; more; clears = false) {
        more = draw_chunk(f, &rest, clears);
    }
    *rest.carry = NULL;
    r->stats.fragments += rest.fragments;
}

PH_TIER(mesh) uint32_t ph_draw_band(struct ph_renderer *r, uint32_t band, uint16_t *pixels)
{
    const int32_t lines = r->config.band_height, height = r->config.height;
    const int32_t y0 = (int32_t)band * lines, y1 = y0 + lines < height ? y0 + lines : height;
    const bool depth24 = ph_depth_bytes(r->config.depth_format) == sizeof(uint32_t);
    if (band != r->list.band || band >= r->band_count || (uintptr_t)pixels % sizeof(uint16_t) != 0 || pixels == NULL) {
        return 0;
    }
    r->list.band++;
    struct ph_coarse coarse[2]; /* the other core has its own, for its rows */
    coarse[0].count = coarse[1].count = 0;
    struct ph_band rows = {NULL, r->config.depth, depth24, r->config.width, y0, y1, r->config.width, coarse};
    rows.pixels = r->samples_log2 != 0
                      ? r->config.samples
                      : pixels; /* an assignment, not an initialiser: else clang-tidy asks for a const pointer */
    struct ph_columns in;       /* set only with samples */
    if (r->samples_log2 != 0) {
        ph_samples_columns(r, band, &in);
    }
    struct ph_feed f;
    ph_feed_start(&f, r, band);
    if (r->samples_log2 == 0 || f.ref != PH_NONE || r->carried != NULL || r->after != NULL) {
        if (r->samples_log2 != 0) {
            ph_samples_clear(&rows, &in, r->background);
        }
        draw_triangles(&f, &rows);
        if (r->after != NULL) {
            rows.coarse = NULL; /* blended triangles are drawn into rows of their own */
            r->after(r, &rows);
        } else if (r->fog != NULL) {
            ph_draw_in_parts(r, &rows, (y1 - y0) / 2, r->fog);
        }
    } else {
        clear_depth(&rows); /* a blur reads it; nobody reads a sample */
    }
    if (r->samples_log2 != 0) {
        ph_samples_resolve(&rows, &in, r->background, pixels);
    }
    return r->list.band < r->band_count || ph_check_materials(r) ? (uint32_t)(y1 - y0) >> r->samples_log2 : 0;
}
