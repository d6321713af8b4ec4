/*
 * Triangle set-up: edges, and the choice of how a triangle is drawn (its kind). See setup.h.
 *
 * Most triangles of a mesh are small Gouraud ones: ph_setup_small of kernels.h sets these up, setup_any all others.
 */
#include "tier.h"
#include <stdbool.h>
#include <stdint.h>

/* A copy of this inline function that the compiler does not inline here lies with what calls it. */
PH_TIER(mesh) static inline bool ph_is_between(int32_t a, int32_t b, int32_t c, int32_t size);

#include "setup.h"

#include "colours.h"
#include "edge.h"
#include "exact.h"
#include "kernels.h"
#include "lift.h"
#include "line.h"
#include "outline.h"
#include "planes.h"
#include "samples.h"
#include "small_texels.h"
#include "texels.h"

/* Edges and planes of any triangle. False if 32 bits are not enough for its depth. */
PH_TIER(scenery)
static PH_NOINLINE bool setup_any(const struct ph_renderer *r, const struct ph_material *material,
                                  const struct ph_vertex *const v[3], const fx_t *const uv[3],
                                  const struct ph_sides *sides, struct ph_triangle *t)
{
    ph_setup_outline(r->config.height, v, t);
    t->material = material;
    return ph_set_planes(t, r, v, uv, sides);
}

/* Whether a small triangle keeps a pixel off the borders. Mostly its first corner tells: see inner() in frame.c. */
static inline bool is_inside(const struct ph_renderer *r, const struct ph_vertex *const v[3])
{
    const uint32_t margin = PH_SIDE_SMALL + 256;
    return ((uint32_t)v[0]->x - margin < r->inner_x && (uint32_t)v[0]->y - margin < r->inner_y) ||
           (ph_is_between(v[0]->x, v[1]->x, v[2]->x, r->config.width) &&
            ph_is_between(v[0]->y, v[1]->y, v[2]->y, r->config.height));
}

/* Whether a triangle is as narrow as a small one. */
static inline bool is_narrow(uint32_t dx1, uint32_t dx2)
{
    return ((dx1 + PH_SIDE_SMALL) | (dx2 + PH_SIDE_SMALL) | (dx2 - dx1 + PH_SIDE_SMALL)) < 2 * PH_SIDE_SMALL;
}

PH_TIER(few)
enum ph_excess ph_excess_of(const struct ph_setting *s, const struct ph_sides *sides,
                            const struct ph_vertex *const v[3])
{
    const uint32_t dx1 = (uint32_t)sides->dx1, dx2 = (uint32_t)sides->dx2, dy = (uint32_t)(sides->dy2 - sides->dy1);
    if (!sides->is_short || ((dy + PH_SIDE_SHORT) | (dx2 - dx1 + PH_SIDE_SHORT)) >= 2 * PH_SIDE_SHORT ||
        !ph_is_between(v[0]->x, v[1]->x, v[2]->x, s->r->config.width) ||
        !ph_is_between(v[0]->y, v[1]->y, v[2]->y, s->r->config.height)) {
        return PH_EXCESS_LARGE;
    }
    return is_narrow(dx1, dx2) ? PH_EXCESS_NARROW : PH_EXCESS_ROWS;
}

/* Depth of the corners in the format of small triangles, and the block exponent. False if two are 2^31 apart. */
PH_TIER(mesh)
static inline bool small_depths(const struct ph_setting *s, const struct ph_vertex *const v[3], uint32_t d[3],
                                uint8_t *block)
{
    const struct ph_renderer *r = s->r;
    *block = PH_BLOCK_NONE;
    if (s->octaves != NULL) {
        if (!s->octaves->set_codes(&r->lens, v, s->fast.bias, d)) {
            *block = ph_depth_ways(r)->block_depths(r, v, ph_depth_bias(s->fast.material), d);
        }
        return true;
    }
    for (int i = 0; i < 3; i++) {
        d[i] = ph_depth_before(ph_depth_of(v[i]), 0, 0) + s->fast.bias;
    }
    return ((d[0] ^ d[1]) | (d[0] ^ d[2])) >> 31 == 0;
}

/* Whether rows lie between all pixel centres: the upper ones between two edges, the left one first, which are given at
 * the first row; then `lower` takes the place of one of them. */
PH_TIER(mesh)
static PH_NOINLINE bool rows_are_empty(struct ph_edge edge[2], int32_t upper_rows, const struct ph_edge *lower,
                                       bool lower_is_right, int32_t lower_rows)
{
    for (int32_t rows = upper_rows + lower_rows; rows > 0; rows--) {
        if (rows == lower_rows) {
            edge[lower_is_right] = *lower;
        }
        if (edge[0].x >> 16 < edge[1].x >> 16) {
            return false;
        }
        ph_edge_step(&edge[0], 1);
        ph_edge_step(&edge[1], 1);
    }
    return true;
}

/* Whether a triangle lies between all pixel centres, as thin ones often do. */
static bool is_empty(const struct ph_triangle *t)
{
    const struct ph_large *const l = &t->as.large;
    const bool long_left = l->long_left != 0;
    struct ph_edge edge[2];
    edge[!long_left] = l->long_edge;
    edge[long_left] = l->upper;
    return rows_are_empty(edge, l->y_mid - t->y_top, &l->lower, long_left, t->y_bottom - l->y_mid);
}

PH_TIER(mesh) static bool small_is_empty(const struct ph_small_triangle *s)
{
    struct ph_edge edge[2] = {{(int32_t)s->left, (int32_t)s->left_dx}, {(int32_t)s->right, (int32_t)s->right_dx}};
    return rows_are_empty(edge, s->upper_rows, &s->lower, s->lower_is_right, s->lower_rows);
}

/* Sets the depth that ph_setup_small left out, or that crosses octaves. False if 32 bits are not enough. */
PH_TIER(mesh)
static PH_NOINLINE bool finish_depth(struct ph_triangle *t, const struct ph_renderer *r,
                                     const struct ph_vertex *const v[3], const struct ph_sides *sides,
                                     const uint32_t d[3], enum ph_small_setup done)
{
    struct ph_plane plane;
    if (t->block != PH_BLOCK_NONE) {
        return ph_depth_ways(r)->octaves->finish_depth(t, r, v, sides, d, done == PH_SMALL_SET);
    }
    if (!ph_depth_plane(&plane, v[0], sides, d)) {
        return false;
    }
    ph_set_small_depth(t, &plane);
    return true;
}

/* Moves depth in codes as depth_bias_slope says; what crosses octaves is moved in octaves.c. */
static inline void lift_codes(struct ph_triangle *t, const uint32_t d[3])
{
    if (t->block == PH_BLOCK_NONE) {
        ph_lift_small(t, PH_TOP_CODE, d);
    }
}

PH_TIER(figure)
bool ph_take_small_depth(struct ph_triangle *t, const struct ph_setting *s, const struct ph_vertex *const v[3],
                         const struct ph_sides *sides, bool fits)
{
    struct ph_triangle other;
    uint32_t d[3];
    other.material = t->material;
    other.as.small.rows.ramp = NULL;
    if (!small_depths(s, v, d, &other.block)) {
        return fits;
    }
    const enum ph_small_setup done = ph_setup_small(&other, v, sides, d);
    if (done == PH_SMALL_NO_ROW) {
        return true;
    }
    if ((done == PH_SMALL_STEEP || other.block != PH_BLOCK_NONE) && !finish_depth(&other, s->r, v, sides, d, done)) {
        return false;
    }
    lift_codes(&other, d);
    const struct ph_small_triangle *const small = &other.as.small.rows;
    t->block = other.block;
    t->as.large.depth.as.plane =
        (struct ph_plane){small->d - (uint32_t)other.y_top * small->d_dy, small->gd, small->d_dy};
    return true;
}

/* Sets up any triangle that ph_setup_small cannot take. */
static PH_NOINLINE void setup_other(const struct ph_setting *s, const struct ph_vertex *const v[3],
                                    const fx_t *const uv[3], const struct ph_sides *sides, bool small,
                                    struct ph_triangle *t)
{
    const struct ph_renderer *r = s->r;
    const struct ph_colouring *const colouring = (s->draw->kind & PH_DRAW_COLOURS) != 0 ? r->config.colouring : NULL;
    bool (*take_small_depth)(struct ph_triangle * t, const struct ph_setting *s, const struct ph_vertex *const v[3],
                             const struct ph_sides *sides, bool fits) = NULL;
    bool fits = setup_any(r, s->fast.material, v, uv, sides, t);
    if (colouring != NULL) {
        colouring->set_colours(t, v, sides, ph_lit_corners_of(s->fast.material) == PH_FIRST_CORNER);
        take_small_depth = colouring->take_small_depth;
    } else if (t->kind == PH_KIND_TEXTURE) {
        take_small_depth = t->material->shading->texturing.take_small_depth;
    }
    if (small && s->has_codes && take_small_depth != NULL) {
        fits = take_small_depth(t, s, v, sides, fits);
    }
    if (!fits) {
        if (!is_empty(t)) { /* an exact plane costs more than the look */
            ph_set_exact(r, t->material, v, sides, &t->as.large.depth);
            t->block = PH_BLOCK_EXACT;
        }
    } else if (t->kind == PH_KIND_GOURAUD && t->block == PH_BLOCK_NONE && s->has_codes && t->y_top < t->y_bottom) {
        t->material->shading->gouraud->take_tall(t, r, v, sides);
    }
}

PH_TIER(mesh) void ph_setting_of(struct ph_setting *s, const struct ph_renderer *r, const struct ph_draw *draw)
{
    const struct ph_material *const material = draw->material;
    const struct ph_depth_format *const format = r->stats.depth_format;
    const unsigned corners = ph_lit_corners_of(material);
    const bool lit = corners != PH_NO_CORNER && !ph_takes_texture(material) && material->ramp != NULL;
    const bool textured = ph_is_textured(material);
    s->r = r;
    s->draw = draw;
    s->fast.base = ph_at(r, draw->base);
    s->has_codes = format->is_small;
    s->is_small = (draw->kind & PH_DRAW_SMALL) != 0 && s->has_codes;
    s->fast.ramp = lit ? material->ramp : textured ? NULL : &material->colour;
    s->source = textured                     ? PH_FROM_CORNERS
                : !lit                       ? PH_FROM_COLOUR
                : corners == PH_FIRST_CORNER ? PH_FROM_FIRST_LIGHT
                                             : PH_FROM_LIGHT;
    s->antialiasing = r->config.antialiasing;
    s->excess_of = s->antialiasing != NULL ? s->antialiasing->excess_of : NULL;
    if (textured) {
        s->set_corners = material->shading->texturing.set_texels;
        s->excess_of = material->shading->texturing.excess_of;
        s->v_unit = (uint8_t)ph_texel_v_unit(material->texture);
    } else if ((draw->kind & PH_DRAW_COLOURS) != 0) {
        r->config.colouring->prepare(s);
    }
    s->keeps_light = s->source == PH_FROM_LIGHT && s->antialiasing == NULL;
    s->octaves = format->ways->octaves;
    s->fast.lens = s->octaves != NULL ? &r->lens : NULL;
    s->fast.set_codes = s->octaves != NULL ? s->octaves->set_codes : NULL;
    s->fast.side = PH_SIDE_SMALL;
    s->fast.margin = PH_SIDE_SMALL + 256;
    s->fast.material = material;
    s->fast.inner_x = r->inner_x;
    s->fast.inner_y = r->inner_y;
    if (s->antialiasing != NULL) {
        s->antialiasing->prepare(s);
    }
    const bool fast = s->is_small && r->inner_x > 0 && r->inner_y > 0 &&
                      (draw->kind & (PH_DRAW_LINES | PH_DRAW_UVS)) == 0 && material->depth_bias_slope == 0;
    s->has_fast_corners = fast && s->source == PH_FROM_CORNERS;
    s->is_fast = fast && !s->has_fast_corners;
    s->fast.bias = s->octaves != NULL
                       ? PH_DEPTH_BIAS_FLOAT16 + (ph_depth_bias(material) << 13)
                       : PH_DEPTH_BIAS_FIXED16 + (ph_depth_bias(material) << 16) - ph_depth_far(&r->lens, 0);
}

/* Sets the light of a small triangle whose corners share one light. */
static inline void set_light(const struct ph_setting *s, const struct ph_vertex *first, struct ph_triangle *t)
{
    if (s->source != PH_FROM_LIGHT) {
        t->as.small.rows.light = s->source == PH_FROM_FIRST_LIGHT ? (uint32_t)first->light << 16 : 0;
        t->as.small.rows.glight = t->as.small.rows.light_dy = 0;
    }
}

PH_TIER(mesh) void ph_set_fast_light(const struct ph_setting *s, const struct ph_ref *ref, struct ph_triangle *t)
{
    if (s->antialiasing != NULL && t->y_bottom - t->y_top >= (int32_t)(PH_SIDE_SHORT / 256)) {
        ph_setup_general(s, ref, PH_SMALL_SET, t); /* its third side may be no short one */
        return;
    }
    set_light(s, &s->fast.base[ref->corner[0]], t);
    if (s->antialiasing != NULL) {
        s->antialiasing->set_kind(t, false);
    }
}

/* ph_set_knee for a small textured triangle. */
static inline void set_texture_knee(const struct ph_setting *s, struct ph_triangle *t, const uint32_t d[3])
{
    s->octaves->set_knee(t, d);
    t->kind = t->kind == PH_KIND_SMALL_KNEE ? PH_KIND_SMALL_TEXTURE_KNEE : t->kind;
}

/* Sets up a triangle that faces the viewer and covers a pixel centre. uv: those of each corner; NULL if the material
 * has no texture. done: PH_SMALL_STEEP if ph_setup_fast has set all but depth. */
PH_TIER(mesh)
static void setup_front(const struct ph_setting *s, const struct ph_vertex *const v[3], const fx_t *const uv[3],
                        const struct ph_sides *sides, enum ph_small_setup done, struct ph_triangle *t)
{
    const struct ph_renderer *r = s->r;
    const bool as_small =
        (done == PH_SMALL_STEEP && s->fast.side == PH_SIDE_SMALL) || (ph_sides_are_small(sides) && is_inside(r, v));
    const enum ph_excess excess = as_small               ? PH_EXCESS_NARROW
                                  : s->excess_of != NULL ? s->excess_of(s, sides, v)
                                                         : PH_EXCESS_LARGE;
    const bool small = as_small || (s->antialiasing != NULL &&
                                    excess != PH_EXCESS_LARGE); /* in all shadings its depth is set up as there */
    uint32_t d[3];
    if (!s->is_small || excess == PH_EXCESS_LARGE || (excess == PH_EXCESS_ROWS && s->source == PH_FROM_CORNERS)) {
        setup_other(s, v, uv, sides, small, t);
        return;
    }
    t->kind = PH_KIND_SMALL;
    t->material = s->fast.material;
    t->as.small.rows.ramp = s->fast.ramp;
    if (!small_depths(s, v, d, &t->block)) {
        setup_other(s, v, uv, sides, false, t);
        return;
    }
    done = done == PH_SMALL_STEEP ? done : ph_setup_small(t, v, sides, d);
    if (done == PH_SMALL_STEEP && small_is_empty(&t->as.small.rows)) {
        t->as.small.rows.d = t->as.small.rows.gd = t->as.small.rows.d_dy = 0; /* no pixel asks for it */
        return;
    }
    if ((done == PH_SMALL_STEEP || t->block != PH_BLOCK_NONE || !small) && /* narrow: depth as in other shadings */
        !finish_depth(t, r, v, sides, d, small ? done : PH_SMALL_STEEP)) {
        setup_other(s, v, uv, sides, false, t);
        return;
    }
    lift_codes(t, d);
    if (s->source == PH_FROM_CORNERS) {
        if (!s->set_corners(t, s, v, uv)) {
            setup_other(s, v, uv, sides, small, t);
        } else if (PH_TEXTURE_KNEE && t->block != PH_BLOCK_NONE && t->as.small.of.map.fast) {
            set_texture_knee(s, t, d);
        }
    } else {
        if (t->block != PH_BLOCK_NONE && excess != PH_EXCESS_ROWS) {
            t->kind = PH_KIND_SMALL_SPLIT;
            s->octaves->set_knee(t, d);
        }
        set_light(s, v[0], t);
        if (s->antialiasing != NULL) {
            s->antialiasing->set_kind(t, excess == PH_EXCESS_ROWS);
        }
    }
}

PH_TIER(mesh)
static PH_NOINLINE void setup_triangle(const struct ph_setting *s, const struct ph_ref *ref, enum ph_small_setup done,
                                       struct ph_triangle *t)
{
    const struct ph_vertex *const base = s->fast.base, *v[3];
    const fx_t(*const uvs)[2] = s->draw->uvs, *of_corners[3];
    const bool has_corners = (s->draw->kind & PH_DRAW_UVS) != 0; /* their texture coordinates stand beside them */
    if (has_corners) {
        for (int i = 0; i < 3; i++) {
            const struct ph_corner *const corner = (const struct ph_corner *)(const void *)base + ref->corner[i];
            v[i] = &corner->at;
            of_corners[i] = corner->uv;
        }
    } else {
        v[0] = &base[ref->corner[0]];
        v[1] = &base[ref->corner[1]];
        v[2] = &base[ref->corner[2]];
        for (int i = 0; uvs != NULL && i < 3; i++) {
            of_corners[i] = uvs[ref->corner[i]];
        }
    }
    const fx_t *const *const uv = has_corners || uvs != NULL ? of_corners : NULL;
    done = s->has_fast_corners ? ph_setup_fast(&s->fast, ref, t) : done;
    const bool is_fast = s->has_fast_corners && done == PH_SMALL_SET;
    if (is_fast && s->set_corners(t, s, v, uv)) {
        return;
    }
    const struct ph_sides sides = ph_sides(v[0], v[1], v[2]);
    if (is_fast) {
        setup_other(s, v, uv, &sides, true, t);
    } else {
        setup_front(s, v, uv, &sides, done, t);
    }
}

PH_TIER(mesh)
void ph_setup_general(const struct ph_setting *s, const struct ph_ref *ref, enum ph_small_setup done,
                      struct ph_triangle *t)
{
    const struct ph_vertex *const base = s->fast.base;
    if ((s->draw->kind & PH_DRAW_LINES) == 0) {
        setup_triangle(s, ref, done, t);
    } else if (s->antialiasing != NULL) {
        s->antialiasing->setup_sample_line(s, ref, t);
    } else {
        s->r->lines->setup_line(s, &base[ref->corner[0]], &base[ref->corner[1]], t);
    }
}

void ph_setup_number(const struct ph_renderer *r, uint32_t number, struct ph_triangle *t)
{
    const struct ph_draw *draw = ph_at(r, r->list.first);
    while (draw->next != PH_NONE && ((const struct ph_draw *)ph_at(r, draw->next))->first <= number) {
        draw = ph_at(r, draw->next);
    }
    struct ph_setting setting;
    ph_setting_of(&setting, r, draw);
    ph_setup(&setting, ph_ref_at(r, number), t);
}
