/* Bands on two cores: each sets up half of the next triangles, and draws half of the band's rows. See band_rest.h. */
/* Kits on armv6m: -O2. */
#include "band_rest.h"

#include "coarse.h"
#include "cores.h"
#include "line.h"
#include "raster.h"
#include "setup.h"

#define SPARES 8
#define CHUNK  32 /* triangles that two cores set up at a time, most */

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
    struct ph_rest *rest;
};

/* Carries the triangles that go on below the band to the next band. */
PH_TIER(figure) static void keep_below(const struct drawn *d)
{
    struct ph_rest *const rest = d->rest;
    const struct ph_triangle *const spares = d->spares->at;
    const int32_t y1 = rest->rows->y1;
    for (struct ph_triangle *next, *list = d->list; list != NULL; list = next) {
        const bool spare = list >= spares && list < spares + SPARES;
        struct ph_triangle *const t = spare && list->y_bottom > y1 ? ph_take_slot(rest->r) : list;
        next = list->next;
        if (list->y_bottom <= y1) {
            if (!spare) {
                ph_free_slot(rest->r, t);
            }
        } else if (t == NULL) {
            ph_feed_put_below(d->f, list->order, &rest->put);
        } else {
            if (spare) {
                *t = *list;
            }
            if (t->kind >= PH_KIND_LINE) {
                t->as.line.lines->step_line(t, y1);
            } else {
                ph_step_below(t, y1);
            }
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
    struct ph_triangle *const t = ph_take_slot(r);
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
        f->ref = ph_next_ref(f, ph_ref_at(r, f->ref), f->ref);
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
        ph_clear_rows(fresh->r, &s->rows);
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
    struct ph_rest *const rest = drawn->rest;
    const struct ph_band *const rows = rest->rows;
    struct ph_renderer *const r = rest->r;
    struct fresh fresh = {.r = r, .count = next != NULL ? COUNTING : 0, .drawn = drawn};
    struct share upper = {.then = {&fresh, 0}, .first = drawn->list, .clears = clears, .rows = *rows}, lower = upper;
    upper.next = next;
    lower.then.core = 1;
    lower.rows = ph_cut_lower(&upper.rows, (rows->y1 - rows->y0) / 2);
    lower.rows.coarse = rows->coarse != NULL ? rows->coarse + 1 : NULL;
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

PH_TIER(figure) bool ph_draw_chunk(struct ph_feed *f, struct ph_rest *rest, bool clears)
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
