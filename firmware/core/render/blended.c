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
#include "pairs.h"
#include "points.h"
#include "raster.h"
#include "raster_rows.h"
#include "setup.h"

/* What the triangles of a draw have in common. */
struct blend_pass {
    struct ph_renderer *r;
    const struct ph_band *band;
    uint32_t place, room[2]; /* memory for rows of its own; how many pixels they can have, without and with keys */
    uint32_t fragments;
    const struct ph_triangle *triangle; /* the one that is drawn */
    uint16_t *colours, *deciders;       /* column 0 of the first of its own rows; the same of the texels that decide */
    void *codes;
    uint32_t x, y; /* of the pixel that is laid first */
    const struct ph_blend *blend;
    uint32_t alpha;      /* of the whole draw, 0 .. 32 */
    uint32_t over;       /* of a flat triangle: its spread colour times alpha, to be rounded */
    uint16_t mask, hole; /* cut-out: no pixel is where the bits of the mask are these in a texel that decides */
    struct ph_setting setting, keys; /* of the colours; of the texels that decide */
    struct ph_draw key_draw;         /* that of `keys` */
    struct ph_material key_material;
    struct ph_texture key_texture; /* the material's, without a filter */
    bool has_keys, same_keys;      /* the colours are the texels that decide */
    struct ph_fog_here fog;
};

/* Finds the part of the band that a reference may cover. False if there is none. */
static bool box_of(const struct blend_pass *o, const struct ph_ref *ref, struct ph_box *box)
{
    *box = ph_box_of(o->r, o->setting.draw, ref);
    box->y0 = ph_max(box->y0, o->band->y0);
    box->y1 = ph_min(box->y1, o->band->y1);
    box->x0 = ph_max(box->x0 - 1, 0); /* one more on each side, because edges are rounded */
    box->x1 = ph_min(box->x1 + 1, o->band->width);
    return box->x0 < box->x1 && box->y0 < box->y1;
}

/* ---- rows over the band ----------------------------------------------------------------------------------------- */

/* Lays n pairs over others by kind. */
static void lay_pairs(uint32_t kind, ph_pair *to, const ph_pair *from, uint32_t n, uint32_t share)
{
    if (kind == PH_BLEND_TIMES) {
        ph_pairs_times(to, from, n);
    } else if (kind == PH_BLEND_ADD) {
        ph_pairs_add(to, from, n, share);
    } else {
        ph_pairs_mix(to, from, n, share);
    }
}

/* Lays n pixels over others by kind. One that does not stand as half of the same word in both goes alone. */
static void lay_pixels(uint32_t kind, uint16_t *to, const uint16_t *from, uint32_t n, uint32_t share)
{
    const uintptr_t apart = (uintptr_t)to ^ (uintptr_t)from;
    while (n > 0) {
        uint32_t some = 1;
        if (n > 1 && ((apart | (uintptr_t)to) & 2) == 0) {
            some = n & ~1u;
            lay_pairs(kind, (ph_pair *)(void *)to, (const ph_pair *)(const void *)from, some / 2, share);
        } else {
            ph_pair under = *to, over = *from;
            lay_pairs(kind, &under, &over, 1, share);
            *to = (uint16_t)under;
        }
        to += some;
        from += some;
        n -= some;
    }
}

/* Lays n pixels of a cut-out triangle over the band, those that are nearer and no hole. A loop for each depth has all
 * in registers. */
static inline __attribute__((always_inline)) void lay_kept(const struct blend_pass *o, uint32_t own, uint32_t at,
                                                           uint32_t n, bool depth24)
{
    const uint16_t *const keys = o->deciders + own, *const colours = o->colours + own;
    uint16_t *const pixels = o->band->pixels + at;
    void *const depth = ph_depth_from(o->band->depth, at, depth24);
    const void *const codes = ph_depth_from(o->codes, own, depth24);
    const uint32_t mask = o->mask, hole = o->hole;
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t code = depth24 ? ((const uint32_t *)codes)[i] : ((const uint16_t *)codes)[i];
        if (code <= (depth24 ? ((uint32_t *)depth)[i] : ((uint16_t *)depth)[i]) || (keys[i] & mask) == hole) {
            continue;
        }
        pixels[i] = colours[i];
        if (depth24) {
            ((uint32_t *)depth)[i] = code;
        } else {
            ((uint16_t *)depth)[i] = (uint16_t)code;
        }
    }
}

static FX_APART void lay_cut_out(struct blend_pass *o, uint32_t own, uint32_t at, uint32_t n) /* called as lay_row */
{
    if (o->band->depth24) {
        lay_kept(o, own, at, n, true);
    } else {
        lay_kept(o, own, at, n, false);
    }
}

/* Mixes n pixels by the alphas of their texels. to: the band's, or (ADD) the triangle's own, which are scaled. */
static void lay_alphas(const struct blend_pass *o, uint16_t *to, const uint16_t *colours, const uint16_t *keys,
                       uint32_t n)
{
    for (uint32_t i = 0; i < n; i++) { /* by 63: exact up to 32 x 63 + 31 */
        const uint32_t alpha = (o->alpha * (ph_wire16(keys[i]) >> 5 & 63) + 31) * 33289 >> 21;
        to[i] = ph_mix(to == colours ? 0 : to[i], colours[i], alpha);
    }
}

/* Lays n pixels that are seen over the band. */
static void lay_seen(struct blend_pass *o, uint32_t own, uint32_t at, uint32_t n)
{
    uint16_t *const colours = o->colours + own, *const pixels = o->band->pixels + at;
    const bool depth24 = o->band->depth24;
    uint32_t kind = o->blend->kind, alpha = o->alpha;
    if (kind == PH_BLEND_TIMES && (alpha < 32 || o->has_keys)) {
        lay_pixels(PH_BLEND_TIMES, colours, pixels, n, 0);
        kind = PH_BLEND_ALPHA;
    } else if (kind != PH_BLEND_TIMES && o->r->fog != NULL) { /* what is multiplied is fogged with what is behind */
        o->r->fog->fog_run(&o->fog, colours, ph_depth_from(o->codes, own, depth24), n, depth24);
    }
    if (o->has_keys) {
        lay_alphas(o, kind == PH_BLEND_ADD ? colours : pixels, colours, o->deciders + own, n);
        alpha = 32;
    }
    if (kind == PH_BLEND_ADD || !o->has_keys) {
        lay_pixels(kind, pixels, colours, n, alpha);
    }
}

/* The number of the first of n pixels that are seen, or that are hidden. */
static uint32_t count_pixels(const struct blend_pass *o, uint32_t own, uint32_t at, uint32_t n, bool same, bool seen)
{
    if (!o->band->depth24) {
        return ph_span_seen((const uint16_t *)o->codes + own, (const uint16_t *)o->band->depth + at, n, same, seen);
    }
    const uint32_t *const codes = (const uint32_t *)o->codes + own, *const depth =
                                                                        (const uint32_t *)o->band->depth + at;
    uint32_t i = 0;
    while (i < n && (codes[i] + same > depth[i]) == seen) {
        i++;
    }
    return i;
}

/* Lays n pixels of a row over the band. */
static void lay_over(struct blend_pass *o, uint32_t own, uint32_t at, uint32_t n) /* called as lay_row */
{
    const bool same = o->blend->kind == PH_BLEND_TIMES;
    bool seen = false;
    for (uint32_t some; n > 0; n -= some, own += some, at += some, seen = !seen) {
        some = count_pixels(o, own, at, n, same, seen);
        if (seen) {
            lay_seen(o, own, at, some);
        }
    }
}

/* Blends n pixels of a triangle of one colour with one alpha, in depth of 16 bits. */
static void lay_flat(struct blend_pass *o, uint32_t own, uint32_t at, uint32_t n) /* called as lay_row */
{
    (void)own;
    const struct ph_plane *const depth = &o->triangle->as.large.depth.as.plane;
    ph_span_blend(o->band->pixels + at, (const uint16_t *)o->band->depth + at, n, ph_plane_at(depth, o->x, o->y),
                  depth->gx, o->over, 32 - o->alpha);
    o->fragments += n;
}

/* ---- triangles -------------------------------------------------------------------------------------------------- */

/* Calls lay_row, which is built into a copy of its own, for n pixels of each row that a triangle may cover: from number
 * `at` of the band and number `own` of the rows that it is drawn into. */
static inline __attribute__((always_inline)) void
lay_rows(struct blend_pass *o, const struct ph_box *box, const struct ph_band *rows,
         void (*lay_row)(struct blend_pass *o, uint32_t own, uint32_t at, uint32_t n))
{
    const struct ph_band *const band = o->band;
    const struct ph_triangle *const t = o->triangle;
    const bool is_large = t->kind >= PH_KIND_FLAT && t->kind <= PH_KIND_COLOURS;
    for (int half = 0; half <= is_large; half++) {
        struct ph_half_rows in;
        in.y = rows->y0;
        in.y_end = rows->y1;
        if (is_large) {
            ph_rows_of_half_apart(t, rows, half, &in);
        }
        uint32_t own = (uint32_t)((in.y - rows->y0) * rows->stride), at = (uint32_t)((in.y - band->y0) * band->stride);
        for (; in.y < in.y_end; in.y++, own += rows->stride, at += band->stride) {
            int32_t from = box->x0, to = box->x1;
            if (!is_large || ph_next_row(&in.left, &in.right, band->width, &from, &to)) {
                o->x = (uint32_t)from;
                o->y = (uint32_t)in.y;
                lay_row(o, own + o->x, at + o->x, (uint32_t)(to - from));
            }
        }
    }
}

/* Draws a triangle into rows that are emptied before, from column x0 of the first to x1 of the last. */
static uint32_t draw_rows(const struct ph_triangle *t, const struct ph_band *rows, uint32_t x0, uint32_t x1)
{
    const uint32_t pixels = (uint32_t)(rows->y1 - rows->y0 - 1) * rows->stride + x1 - x0;
    ph_fill(ph_depth_from(rows->depth, x0, rows->depth24), 0, pixels << rows->depth24);
    return ph_draw_triangle(t, rows);
}

/* Draws the triangle of the pass into rows of its own, as many at a time as there is room for, and lays them over the
 * band. keys: NULL, or the same triangle with the texels that decide. A row follows the one before without the columns
 * beside the triangle, if what draws it can do so, and else without those to the right. Its pixels are the same half of
 * a word as the band's, if a band begins at a word. */
static void draw_over(struct blend_pass *o, const struct ph_triangle *keys, const struct ph_box *box)
{
    const struct ph_band *const band = o->band;
    const struct ph_triangle *const t = o->triangle;
    const uint32_t x0 = (uint32_t)box->x0, x1 = (uint32_t)box->x1;
    const bool from_0 = ph_ends_at_stride(t) || (keys != NULL && ph_ends_at_stride(keys));
    const uint32_t least = from_0 ? x1 : x1 - x0, stride = least + ((least ^ band->stride) & 1);
    const uint32_t room = o->room[keys != NULL];
    struct ph_band rows = *band;
    rows.stride = (uint16_t)stride;
    for (rows.y0 = box->y0; rows.y0 < box->y1; rows.y0 = rows.y1) {
        const uint32_t odd = (uint32_t)(rows.y0 - band->y0) & band->stride & 1; /* the row of the band begins so */
        rows.y1 = ph_min(rows.y0 + (int32_t)((room - x1 - odd) / stride + 1), box->y1);
        o->colours = (uint16_t *)ph_at(o->r, o->place) + odd;
        o->deciders = keys != NULL ? o->colours + room : o->colours;
        rows.depth = o->codes = ph_depth_from(o->deciders - odd + room, odd, band->depth24);
        if (keys != NULL) {
            rows.pixels = o->deciders;
            draw_rows(keys, &rows, x0, x1);
        }
        rows.pixels = o->colours;
        if (o->blend->kind == PH_BLEND_TIMES) { /* white where nothing is drawn */
            ph_fill(o->colours, UINT16_MAX, (uint32_t)(rows.y1 - rows.y0 - 1) * stride + x1);
        }
        o->fragments += draw_rows(t, &rows, x0, x1);
        lay_rows(o, box, &rows, o->blend->kind < PH_BLEND_TIMES ? lay_cut_out : lay_over);
    }
}

static void draw_one(struct blend_pass *o, const struct ph_ref *ref)
{
    struct ph_box box;
    struct ph_triangle t, keys;
    if (!box_of(o, ref, &box)) {
        return;
    }
    ph_setup(&o->setting, ref, &t);
    o->triangle = &t;
    if (t.kind == PH_KIND_FLAT && t.block == PH_BLOCK_NONE && !o->band->depth24 && o->r->fog == NULL &&
        o->blend->kind == PH_BLEND_ALPHA && !o->has_keys) {
        o->over = ph_spread(t.as.large.of.colour) * o->alpha + PH_SPREAD_HALF;
        lay_rows(o, &box, o->band, lay_flat);
    } else if (o->has_keys && !o->same_keys) {
        ph_setup(&o->keys, ref, &keys);
        draw_over(o, &keys, &box);
    } else {
        draw_over(o, NULL, &box);
    }
    o->triangle = NULL;
}

/* Prepares the pass for the triangles of a draw. */
static void begin(struct blend_pass *o, const struct ph_draw *draw)
{
    const struct ph_material *const material = draw->material;
    o->blend = material->blend;
    o->alpha = o->blend->alpha < 32 ? o->blend->alpha : 32;
    ph_take_lens(o->r, draw);
    ph_setting_of(&o->setting, o->r, draw);
    const bool by_colour = o->blend->kind == PH_BLEND_KEY;
    o->has_keys = by_colour ? ph_is_textured(material) : o->blend->alphas != NULL;
    o->same_keys =
        o->has_keys && by_colour && ph_lit_corners_of(material) == PH_NO_CORNER && material->texture->filter == NULL;
    if (o->has_keys && !o->same_keys) {
        o->key_material = *material;
        o->key_material.shading = ph_texels_of_blend(material);
        o->key_texture = by_colour ? *material->texture : *o->blend->alphas;
        o->key_texture.filter = by_colour ? PH_FILTER_NEAREST : o->key_texture.filter;
        o->key_material.texture = &o->key_texture;
        o->key_draw = *draw;
        o->key_draw.material = &o->key_material;
        ph_setting_of(&o->keys, o->r, &o->key_draw);
    }
    const bool by_mask = o->blend->kind == PH_BLEND_MASK;
    o->mask = !o->has_keys ? 0 : by_mask ? ph_wire16(1 << 10) : UINT16_MAX;
    o->hole = !o->has_keys ? 1 : by_mask ? 0 : o->blend->key;
    ph_fog_start(&o->fog, o->r, o->blend->kind == PH_BLEND_ADD ? 0 : o->r->fog_of.colour);
    o->setting.is_small = o->setting.is_small && (o->has_keys || o->setting.source == PH_FROM_LIGHT);
}

/* Whether a draw is cut out or multiplied, or blended. */
static bool is_of_kind(const struct ph_draw *draw, bool blends)
{
    const struct ph_blend *const blend = draw->material->blend;
    return blend != NULL && (blend->kind >= PH_BLEND_ALPHA) == blends;
}

/* Draws what is cut out and multiplied, or what is blended, in the pass's rows. */
static void draw_kind(struct blend_pass *o, bool blends)
{
    struct ph_renderer *const r = o->r;
    const uint32_t first = (uint32_t)o->band->y0 >> 3, last = (uint32_t)(o->band->y1 - 1) >> 3;
    for (uint32_t place = r->list.first; place != PH_NONE;) {
        const struct ph_draw *const draw = ph_at(r, place);
        place = draw->next;
        if (!is_of_kind(draw, blends)) {
            continue;
        }
        if ((draw->kind & PH_DRAW_POINTS) != 0) {
            o->fragments += r->points->draw_blended(r, o->band, draw);
            continue;
        }
        const struct ph_ref *ref = ph_ref_at(r, draw->first);
        bool begun = false; /* most draws have nothing in a band */
        for (uint32_t n = ph_end_of_draw(r, draw) - draw->first; n > 0; n--, ref--) {
            if (ph_ref_may_reach(ref, first, last)) {
                if (!begun) {
                    begin(o, draw);
                    begun = true;
                }
                draw_one(o, ref);
            }
        }
    }
}

static void draw_share(void *argument) /* called as run */
{
    struct ph_share *const s = argument;
    struct ph_renderer *const r = s->r;
    const uint32_t deep = s->band.depth24 ? 4 : 2;
    const uint32_t upper = r->rows / s->parts, rows = s->part == 0 ? upper : r->rows - upper;
    struct blend_pass o = {.r = r, .band = &s->band, .place = r->rows_place};
    o.place += s->part * upper * ph_row_bytes(r);
    o.room[1] = rows * ph_row_pixels(r);
    o.room[0] = rows * ph_row_bytes(r) / (2 + deep) & ~1u; /* even, too */
    draw_kind(&o, false);
    if (r->fog != NULL) {
        r->fog->fog_rows(r, &s->band);
    }
    draw_kind(&o, true);
    s->fragments = o.fragments;
}

/* Whether all draws with a blend have the lens that r has now. Else one core draws them, because it changes that of r.
 */
static bool has_one_lens(const struct ph_renderer *r)
{
    bool one = true;
    for (uint32_t place = r->list.first; place != PH_NONE;) {
        const struct ph_draw *const draw = ph_at(r, place);
        one &= draw->material->blend == NULL || draw->lens == r->list.lens;
        place = draw->next;
    }
    return one;
}

/* How many of a band's first rows hold about half of its work; 0 if it has one row only. */
static int32_t rows_of_half(const struct ph_renderer *r, const struct ph_band *band)
{
    const uint16_t *const work = ph_list_work(r);
    const uint32_t fog = r->fog != NULL ? r->config.width / 2 : 0;
    uint32_t all = 0, above = 0;
    int32_t y;
    for (y = band->y0; y < band->y1; y += 2) {
        all += work[y >> 1] + fog;
    }
    for (y = band->y0; y + 2 < band->y1 && 2 * above + work[y >> 1] + fog <= all; y += 2) {
        above += work[y >> 1] + fog;
    }
    return y > band->y0 ? y - band->y0 : band->y1 - band->y0 > 1;
}

static void draw_after(struct ph_renderer *r, const struct ph_band *band)
{
    ph_draw_in_parts(r, band, r->rows >= 2 && has_one_lens(r) ? rows_of_half(r, band) : 0, draw_share);
}

#define BLENDING                                                                                                       \
    .begin_blend = ph_begin_blend, .put_after = ph_put_after, .draw_sides = ph_draw_sides,                             \
    .sort_opaque = ph_sort_opaque, .draw_after = draw_after

const struct ph_blending ph_blending = {BLENDING}, ph_blending_alphas = {BLENDING, .of_alphas = PH_SHADE_TEXTURE};
