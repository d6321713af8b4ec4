/*
 * What is cut out or blended, after the opaque triangles of a band. See render.h.
 *
 * A triangle with a blend is drawn as if it were opaque, but into some empty rows of its own. They then hold its
 * colours and its depth codes, in every shading and depth format, and are laid over the band. A second set of colours
 * has the texels that decide what is left out. Only a triangle of one colour that is blended with one alpha needs no
 * rows.
 *
 * These triangles are in no band's list: each band looks at all of them, and sets up those that it meets.
 */
#include "blend.h"
#include "cores.h"
#include "edge.h"
#include "fog.h"
#include "kernels.h"
#include "setup.h"

#include "band.h"

/* What the triangles of a draw have in common. */
struct overlay {
    struct ph_renderer *r;
    const struct ph_band *band;
    uint32_t place, rows; /* rows of its own */
    uint32_t fragments;
    const struct ph_blend *blend;
    struct ph_setting setting, keys; /* of the colours; of the texels that decide */
    struct ph_material key_material;
    struct ph_texture key_texture; /* the material's, without a filter */
    bool has_keys, same_keys;      /* the colours are the texels that decide */
    uint32_t share;                /* of the fog, where it was last looked up */
};

/* The pixels that a triangle may cover, in the band. */
struct box {
    int32_t x0, x1, y0, y1;
};

/* The box of a triangle; a line is as wide as it can be. */
static struct box box_of(const struct overlay *o, const struct ph_ref *ref)
{
    const struct ph_draw *const draw = &o->setting.draw;
    const size_t size = (draw->kind & PH_DRAW_UVS) != 0 ? sizeof(struct ph_corner) : sizeof(struct ph_vertex);
    const uint8_t *const base = (const uint8_t *)(const void *)o->setting.usual.base;
    const int n = (draw->kind & PH_DRAW_LINES) != 0 ? 2 : 3, wide = n == 2 ? 128 << o->r->fine : 0;
    struct box box = {INT32_MAX, INT32_MIN, INT32_MAX, INT32_MIN};
    for (int i = 0; i < n; i++) {
        const struct ph_vertex *const v = (const struct ph_vertex *)(const void *)(base + ref->corner[i] * size);
        box.x0 = ph_min(box.x0, v->x);
        box.x1 = ph_max(box.x1, v->x);
        box.y0 = ph_min(box.y0, v->y);
        box.y1 = ph_max(box.y1, v->y);
    }
    /* one more on each side, because edges are rounded */
    return (struct box){
        ph_max(ph_first_row(box.x0 - wide) - 1, 0), ph_min(ph_first_row(box.x1 + wide) + 1, o->band->width),
        ph_max(ph_first_row(box.y0 - wide), o->band->y0), ph_min(ph_first_row(box.y1 + wide), o->band->y1)};
}

/* ---- rows over the band ----------------------------------------------------------------------------------------- */

/* A row of a triangle, and the row of the band over which it is laid; from its first column on. */
struct rows {
    uint16_t *colours, *keys, *pixels;
    void *codes, *depth;
};

static inline uint32_t code_of(const void *depth, uint32_t i, bool depth24)
{
    return depth24 ? ((const uint32_t *)depth)[i] : ((const uint16_t *)depth)[i];
}

/* The alpha of a pixel, 0 .. 32; key: its texel that decides. */
static inline uint32_t alpha_of(const struct overlay *o, uint16_t key)
{
    const struct ph_blend *const s = o->blend;
    if (s->kind == PH_BLEND_KEY) {
        return o->has_keys && key == s->key ? 0 : 32;
    }
    const uint32_t green = s->alphas != NULL ? ph_wire16(key) >> 5 & 63 : 63;
    if (s->kind == PH_BLEND_MASK) {
        return green >= 32 ? 32 : 0;
    }
    return ((uint32_t)(s->alpha < 32 ? s->alpha : 32) * green + 31) / 63;
}

/* Blends a colour with a pixel. */
static uint16_t blended(struct overlay *o, uint16_t pixel, uint16_t colour, uint32_t alpha, uint32_t code)
{
    const bool adds = o->blend->kind == PH_BLEND_ADD;
    if (o->blend->kind == PH_BLEND_TIMES) { /* fog comes later */
        colour = ph_times(pixel, colour);
    } else if (o->r->fog != NULL) {
        o->share = ph_fog_share(o->r->fog_codes, code, o->share);
        colour = ph_mix(colour, adds ? 0 : o->r->fog_of.colour, o->share);
    }
    return adds ? ph_add(pixel, colour, alpha) : ph_mix(pixel, colour, alpha);
}

/* Lays n pixels over the band. */
static void lay(struct overlay *o, const struct rows *row, uint32_t n)
{
    const bool depth24 = o->band->depth24, cut = o->blend->kind < PH_BLEND_TIMES;
    const uint32_t more = o->blend->kind == PH_BLEND_TIMES ? 0 : 1; /* TIMES: also over the same depth */
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t code = code_of(row->codes, i, depth24);
        if (code < code_of(row->depth, i, depth24) + more || code == 0) {
            continue;
        }
        const uint32_t alpha = alpha_of(o, row->keys[i]);
        if (alpha == 0) {
            continue;
        }
        if (!cut) {
            row->pixels[i] = blended(o, row->pixels[i], row->colours[i], alpha, code);
            continue;
        }
        row->pixels[i] = row->colours[i];
        if (depth24) {
            ((uint32_t *)row->depth)[i] = code;
        } else {
            ((uint16_t *)row->depth)[i] = (uint16_t)code;
        }
    }
}

/* Draws a triangle into rows that are emptied before. */
static uint32_t draw_rows(const struct ph_triangle *t, const struct ph_band *rows, const struct box *box)
{
    const uint32_t words = (uint32_t)(box->x1 - box->x0) * (rows->depth24 ? 2 : 1);
    for (int32_t y = rows->y0; y < rows->y1; y++) {
        const uint32_t at = (uint32_t)(y - rows->y0) * (uint32_t)rows->width + (uint32_t)box->x0;
        ph_fill(ph_depth_from(rows->depth, at, rows->depth24), 0, words);
    }
    return ph_draw_triangle(t, rows);
}

/* Draws a triangle into rows of its own, some at a time, and lays them over the band. keys: NULL, or the same triangle
 * with the texels that decide. */
static void draw_over(struct overlay *o, const struct ph_triangle *t, const struct ph_triangle *keys,
                      const struct box *box)
{
    const struct ph_renderer *const r = o->r;
    const struct ph_band *const band = o->band;
    const uint32_t width = (uint32_t)band->width, area = o->rows * width;
    uint16_t *const colours = ph_at(r, o->place);
    struct ph_band rows = *band;
    rows.depth = colours + 2 * area;
    for (rows.y0 = box->y0; rows.y0 < box->y1; rows.y0 = rows.y1) {
        rows.y1 = ph_min(rows.y0 + (int32_t)o->rows, box->y1);
        if (keys != NULL) {
            rows.pixels = colours + area;
            draw_rows(keys, &rows, box);
        }
        rows.pixels = colours;
        o->fragments += draw_rows(t, &rows, box);
        for (int32_t y = rows.y0; y < rows.y1; y++) {
            const uint32_t own = (uint32_t)(y - rows.y0) * width + (uint32_t)box->x0;
            const uint32_t at = (uint32_t)(y - band->y0) * width + (uint32_t)box->x0;
            const struct rows row = {colours + own, colours + own + (keys != NULL ? area : 0), band->pixels + at,
                                     ph_depth_from(rows.depth, own, band->depth24),
                                     ph_depth_from(band->depth, at, band->depth24)};
            lay(o, &row, (uint32_t)(box->x1 - box->x0));
        }
    }
}

/* ---- triangles -------------------------------------------------------------------------------------------------- */

/* Blends a triangle of one colour with one alpha. */
static void blend_flat(struct overlay *o, const struct ph_triangle *t)
{
    const struct ph_band *const band = o->band;
    const uint32_t alpha = o->blend->alpha < 32 ? o->blend->alpha : 32;
    const uint32_t source = ph_spread(t->colour) * alpha + PH_SPREAD_HALF;
    for (int half = 0; half < 2; half++) {
        struct ph_half_rows in;
        if (!ph_rows_of_half_apart(t, band, half, &in)) {
            continue;
        }
        for (; in.y < in.y_end; in.y++) {
            int32_t from, to;
            if (ph_next_row(&in.left, &in.right, band->width, &from, &to)) {
                const uint32_t at = (uint32_t)(in.y - band->y0) * (uint32_t)band->width + (uint32_t)from;
                ph_span_blend(band->pixels + at, (const uint16_t *)band->depth + at, (uint32_t)(to - from),
                              ph_plane_at(&t->depth, (uint32_t)from, (uint32_t)in.y), t->depth.gx, source, 32 - alpha);
                o->fragments += (uint32_t)(to - from);
            }
        }
    }
}

static void draw_one(struct overlay *o, const struct ph_ref *ref)
{
    const struct box box = box_of(o, ref);
    struct ph_triangle t, keys;
    if (box.x0 >= box.x1 || box.y0 >= box.y1) {
        return;
    }
    ph_setup(&o->setting, ref, &t);
    if (t.kind == PH_KIND_FLAT && t.block == PH_BLOCK_NONE && !o->band->depth24 && o->r->fog == NULL &&
        o->blend->kind == PH_BLEND_ALPHA) {
        blend_flat(o, &t);
        return;
    }
    if (o->has_keys && !o->same_keys) {
        ph_setup(&o->keys, ref, &keys);
    }
    draw_over(o, &t, o->has_keys && !o->same_keys ? &keys : NULL, &box);
}

/* Prepares a draw. */
static void begin(struct overlay *o, const struct ph_draw *draw)
{
    const struct ph_material *const material = draw->material;
    struct ph_draw keys = *draw;
    o->blend = material->blend;
    ph_take_lens(o->r, draw);
    ph_setting_of(&o->setting, o->r, draw);
    const bool by_colour = o->blend->kind == PH_BLEND_KEY;
    o->has_keys = by_colour ? ph_is_textured(material) : o->blend->alphas != NULL;
    o->same_keys = o->has_keys && by_colour && material->shading == PH_SHADE_TEXTURE &&
                   material->texture->filter == PH_FILTER_NEAREST;
    if (o->has_keys && !o->same_keys) {
        o->key_material = *material;
        o->key_material.shading = PH_SHADE_TEXTURE;
        o->key_texture = by_colour ? *material->texture : *o->blend->alphas;
        o->key_texture.filter = by_colour ? PH_FILTER_NEAREST : o->key_texture.filter;
        o->key_material.texture = &o->key_texture;
        keys.material = &o->key_material;
        ph_setting_of(&o->keys, o->r, &keys);
    }
    o->setting.is_small = o->setting.is_small && (o->has_keys || o->setting.shading == PH_SHADE_GOURAUD);
}

/* Whether a draw is cut out or multiplied, or blended. */
static bool is_of_kind(const struct ph_draw *draw, bool blends)
{
    const struct ph_blend *const blend = draw->material->blend;
    return blend != NULL && (blend->kind >= PH_BLEND_ALPHA) == blends;
}

/* The rows that one core draws, and its rows of its own. */
struct blend_share {
    struct ph_renderer *r;
    struct ph_band band;
    bool blends;
    uint32_t place, rows, fragments;
};

/* Draws the cut-outs and what is multiplied, or what is blended. */
static void blend_share(void *argument)
{
    struct blend_share *const s = argument;
    struct ph_renderer *const r = s->r;
    struct overlay o = {.r = r, .band = &s->band, .place = s->place, .rows = s->rows};
    for (uint32_t place = r->list.first; place != PH_NONE;) {
        const struct ph_draw *const draw = ph_at(r, place);
        place = draw->next;
        if (!is_of_kind(draw, s->blends)) {
            continue;
        }
        const uint32_t end = place == PH_NONE ? ph_ref_count(r) : ((const struct ph_draw *)ph_at(r, place))->first;
        begin(&o, draw);
        for (uint32_t i = draw->first; i < end; i++) {
            draw_one(&o, ph_ref_at(r, i));
        }
    }
    s->fragments = o.fragments;
}

/* Whether there are draws of that kind. Sets *one_lens if they have the lens that r has now: else one core draws them,
 * because it changes that of r. */
static bool has_kind(const struct ph_renderer *r, bool blends, bool *one_lens)
{
    bool any = false;
    *one_lens = true;
    for (uint32_t place = r->list.first; place != PH_NONE;) {
        const struct ph_draw *const draw = ph_at(r, place);
        const bool is = is_of_kind(draw, blends);
        any |= is;
        *one_lens &= !is || draw->lens == r->list.lens;
        place = draw->next;
    }
    return any;
}

/* Draws what is of one kind, the lower half of the band on the other core if it is free. */
static void draw_kind(struct ph_renderer *r, const struct ph_band *band, bool blends)
{
    bool one_lens;
    struct blend_share mine = {r, *band, blends, r->rows_place, r->rows, 0};
    if (!has_kind(r, blends, &one_lens)) {
        return;
    }
    if (!one_lens || r->rows < 2 || band->y1 - band->y0 < 2 || !ph_other_core_is_free(r)) {
        blend_share(&mine);
        r->stats.fragments += mine.fragments;
        return;
    }
    struct blend_share others = mine;
    const uint32_t width = (uint32_t)band->width, half = (uint32_t)(band->y1 - band->y0) / 2;
    mine.rows = r->rows / 2;
    others.rows = r->rows - mine.rows;
    others.place += mine.rows * width * (band->depth24 ? 8 : 6);
    mine.band.y1 = others.band.y0 = band->y0 + (int32_t)half;
    others.band.pixels += half * width;
    others.band.depth = ph_depth_from(band->depth, half * width, band->depth24);
    ph_run_both(r, blend_share, &mine, &others);
    r->stats.fragments += mine.fragments + others.fragments;
}

void ph_draw_blended(struct ph_renderer *r, const struct ph_band *band)
{
    draw_kind(r, band, false);
    if (r->fog != NULL) {
        r->fog(r, band);
    }
    draw_kind(r, band, true);
}
