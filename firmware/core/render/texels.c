/*
 * u and v over a small textured triangle: each is one polynomial of the second order in column and row. See texels.h.
 *
 * u = U / W, where W = 1/w and U = u/w are planes. Let W be m (1 + o), with m in the middle of the least and the most W
 * of the corners, so that |o| <= d, half the relative change of W. Let u0 and o0 be those of the first corner. Then
 *
 *   u = u0 + N / (1 + o), where N is a plane: 0 at the first corner, (u - u0) (1 + o) at the others
 *     = u0 + N (1 - o + d^2 / 2), but for at most |N| d^2 / 2
 *     = u0 + P (1 - q), where P = N (1 - o0 + d^2 / 2) and q = (o - o0) / (1 - o0 + d^2 / 2) are planes, too.
 *
 * So it takes one reciprocal for both u and v. Triangles in which the error may exceed 1/16 texel are drawn in tiles.
 */
/* Kits on armv6m: -O2. */
#include "texels.h"

#include "planes.h"
#include "slopes.h"
#include "texel_filter.h"
#include "texel_map.h"

/* What u and v share. */
struct warp {
    int32_t scale[3]; /* P over u - u0 at the corners, Q15 */
    int32_t q[3];     /* Q16 */
    uint32_t error;   /* d^2 / 2, Q16 */
};

/* Finds W of the corners in 16 or 17 bits; false if it changes by more than 4 times. */
static inline bool over_w(const struct ph_vertex *const v[3], int32_t w[3])
{
    const int s0 = v[0]->s, s1 = v[1]->s, s2 = v[2]->s;
    if (((s0 ^ s1) | (s0 ^ s2)) == 0) { /* mostly */
        for (int i = 0; i < 3; i++) {
            w[i] = (int32_t)(v[i]->q >> 14);
        }
        return true;
    }
    const int least = ph_min(ph_min(s0, s1), s2);
    if (ph_max(ph_max(s0, s1), s2) > least + 1) {
        return false;
    }
    w[0] = (int32_t)(v[0]->q >> (s0 - least + 14));
    w[1] = (int32_t)(v[1]->q >> (s1 - least + 14));
    w[2] = (int32_t)(v[2]->q >> (s2 - least + 14));
    return true;
}

/* Prepares the perspective of u and v. False if W changes by more than a quarter. */
static inline bool set_warp(struct warp *p, const struct ph_vertex *const v[3], bool flat)
{
    int32_t w[3] = {1 << 16, 1 << 16, 1 << 16};
    if (!flat && !over_w(v, w)) {
        return false;
    }
    const int32_t low = ph_min(ph_min(w[0], w[1]), w[2]), high = ph_max(ph_max(w[0], w[1]), w[2]);
    const int32_t middle = (low + high) >> 1;
    if (high - low > middle >> 2) {
        return false;
    }
    const int zeros = fx_clz32((uint32_t)middle);
    /* NOLINTNEXTLINE(clang-analyzer-core.UndefinedBinaryOperatorResult): middle > 0 */
    const int32_t reciprocal = (int32_t)fx_rcp16((uint32_t)middle << zeros >> 16); /* 2^(47 - zeros) / middle */
    const int32_t d = (high - middle) * reciprocal >> (31 - zeros), o0 = (w[0] - middle) * reciprocal >> (31 - zeros);
    const int32_t error = d * d >> 17, m0 = 65536 - o0 + error;
    p->error = (uint32_t)error;
    for (int i = 1; i < 3; i++) {
        const int32_t o = (w[i] - middle) * reciprocal >> (31 - zeros);
        p->scale[i] = ((65536 + o) >> 1) * (m0 >> 1) >> 15;
        p->q[i] = (o - o0) * (65536 + o0 - error + (o0 * o0 >> 16)) >> 16;
    }
    return true;
}

/* A gradient per 1/256 px in 15 bits, times 2^drop. */
struct short_gradient {
    int32_t x, y;
    int drop;
};

static inline struct short_gradient shortened(const struct ph_subpixel_gradient *g)
{
    const int drop = ph_max(17 - fx_clz32(ph_without_sign(g->x) | ph_without_sign(g->y)), 0);
    return (struct short_gradient){g->x >> drop, g->y >> drop, drop};
}

/* v 2^up. */
static inline uint32_t shifted(int32_t v, int up)
{
    return up >= 0 ? (uint32_t)v << up : (uint32_t)(v >> -up);
}

/* Sets the curve -P q. P is in 2^-22 texels, so its gradient in 2^-14 per pixel; q is in Q28, so its gradient in Q20
 * per pixel. */
static inline void set_curve(struct ph_curve *curve, const struct ph_subpixel_gradient *gradient,
                             const struct short_gradient *q)
{
    const struct short_gradient g = shortened(gradient);
    const int up = ph_min(g.drop + q->drop - 12, 24);
    curve->xx = shifted(-(g.x * q->x), up);
    curve->xy = shifted((int32_t)(0u - (uint32_t)(g.x * q->y) - (uint32_t)(g.y * q->x)), up);
    curve->yy = shifted(-(g.y * q->y), up);
}

/* c x / 256; |x| <= 128. */
static inline uint32_t times_part(uint32_t c, int32_t x)
{
    return (uint32_t)(((int32_t)c >> 8) * x);
}

/* What the polynomials of u and v share. */
struct frame {
    struct warp warp;
    struct ph_slopes slopes;
    struct short_gradient q;
    int32_t x, y; /* from the first corner to the centre of its pixel, 1/256 px */
};

/* The polynomial from way->base at the first corner. d1, d2: the differences of the other corners, Q16.16; `unit`: log2
 * of 2^-16 in units of the plane. */
PH_TIER(figure)
static FX_APART void set_way(struct ph_plane *way, struct ph_curve *curve, const struct frame *f, int32_t d1,
                             int32_t d2, int unit)
{
    const int up = ph_min(fx_clz32(ph_without_sign(d1) | ph_without_sign(d2)) - 18, unit); /* to 14 bits */
    const int32_t p1 = (int32_t)shifted(d1, up) * f->warp.scale[1] >> 15;
    const int32_t p2 = (int32_t)shifted(d2, up) * f->warp.scale[2] >> 15;
    struct ph_subpixel_gradient g;
    ph_set_gradient(&g, &f->slopes, p1, p2, unit - up, 22);
    set_curve(curve, &g, &f->q);
    const uint32_t xx_x = times_part(curve->xx, f->x), yy_y = times_part(curve->yy, f->y);
    const uint32_t rise = xx_x + times_part(curve->xy, f->y);
    way->base += (uint32_t)(g.x * f->x) + (uint32_t)(g.y * f->y) + times_part(rise, f->x) + times_part(yy_y, f->y);
    way->gx = (uint32_t)g.x * 256 + rise + xx_x;
    way->gy = (uint32_t)g.y * 256 + times_part(curve->xy, f->x) + 2 * yy_y;
}

/* Whether all corners of a clamped texture fit into the units beside the sign: see set_texels in texture.c. */
PH_TIER(mesh) static bool fits_clamped(const struct ph_texture *texture, const fx_t *const uv[3])
{
    uint32_t all = 0;
    for (int i = 0; i < 3; i++) {
        all |= ph_without_sign(uv[i][0]) | ph_without_sign(uv[i][1]);
    }
    const int range = ph_max(16 - fx_clz32(all), 0);
    return ph_fits_clamped(texture, range);
}

/* The larger difference between corners, or up to twice that; Q12 from Q16. */
static inline uint32_t most_of(int32_t d1, int32_t d2)
{
    return (ph_without_sign(d1) | ph_without_sign(d2)) >> 4;
}

/* Whether u and v change by less than 1024 texels, and their error keeps below 1/16. most_u, most_v: Q12, of widths. */
static inline bool is_exact(const struct warp *warp, uint32_t most_u, uint32_t most_v, const struct ph_texture *texture)
{
    const uint32_t most = most_u << texture->log2_width | most_v << texture->log2_height;
    return (most_u | most_v) >> 16 == 0 && most >> 22 == 0 && most * warp->error < (uint32_t)1 << 24;
}

static inline int32_t change(const fx_t *const uv[3], int corner, int axis)
{
    return (int32_t)((uint32_t)uv[corner][axis] - (uint32_t)uv[0][axis]);
}

/* The plane of light, which counts from column 0 of the first row, as that of other small triangles. */
static void set_shades(struct ph_triangle *t, const struct frame *f, const struct ph_vertex *const v[3])
{
    const int32_t first = ph_texel_light_of(t->material, v[0]);
    struct ph_subpixel_gradient g;
    ph_set_gradient(&g, &f->slopes, ph_texel_light_of(t->material, v[1]) - first,
                    ph_texel_light_of(t->material, v[2]) - first, 16, 22);
    struct ph_small_triangle *const small = &t->as.small.rows;
    const struct ph_small_map *const map = &t->as.small.of.map;
    small->glight = (uint32_t)g.x * 256;
    small->light_dy = (uint32_t)g.y * 256;
    small->light = ((uint32_t)(first + PH_TEXEL_LIGHT_UP) << 16) + (uint32_t)(g.x * f->x + g.y * f->y) -
                   (uint32_t)map->x * small->glight - (uint32_t)map->y * small->light_dy;
}

/* Sets level and light of a triangle; u and v are those of the first level. */
static FX_APART void set_general(struct ph_triangle *t, const struct frame *f, const struct ph_vertex *const v[3])
{
    struct ph_small_map *const map = &t->as.small.of.map;
    const struct ph_levels *const levels = ph_levels_of(t->material->texture);
    if (levels != NULL) {
        levels->set_level(map, t->material->texture);
    }
    if (map->light.shaded) {
        set_shades(t, f, v);
    }
}

PH_TIER(mesh)
bool ph_setup_texels(struct ph_triangle *t, const struct ph_setting *s, const struct ph_vertex *const v[3],
                     const fx_t *const corner_uv[3])
{
    static const fx_t origin[2];
    static const fx_t *const origins[3] = {origin, origin, origin};
    const fx_t *const *const uv = corner_uv != NULL ? corner_uv : origins;
    const struct ph_texture *const texture = t->material->texture;
    const int width = texture->log2_width, v_unit = s->v_unit;
    const int32_t du1 = change(uv, 1, 0), du2 = change(uv, 2, 0), dv1 = change(uv, 1, 1), dv2 = change(uv, 2, 1);
    struct frame f;
    if (!set_warp(&f.warp, v, s->r->lens.kind == PH_ORTHOGRAPHIC) ||
        (texture->wrap != PH_WRAP_REPEAT && !fits_clamped(texture, uv)) ||
        !is_exact(&f.warp, most_of(du1, du2), most_of(dv1, dv2), texture)) {
        return false;
    }
    struct ph_subpixel_gradient q;
    f.slopes = t->as.small.of.slopes;
    ph_set_gradient(&q, &f.slopes, f.warp.q[1], f.warp.q[2], 12, 22);
    f.q = shortened(&q);
    f.x = 128 - (v[0]->x & 255);
    f.y = 128 - (v[0]->y & 255);
    struct ph_small_map *const map = &t->as.small.of.map;
    map->u.base = (uint32_t)uv[0][0] << (width + 6);
    if ((texture->wrap & PH_WRAP_CLAMP_U) == 0) {
        map->u.base &= UINT32_MAX >> (10 - width);
    }
    set_way(&map->u, &map->u_curve, &f, du1, du2, width + 6);
    map->v.base = (uint32_t)uv[0][1] << v_unit;
    set_way(&map->v, &map->v_curve, &f, dv1, dv2, v_unit);
    map->x = (int16_t)(v[0]->x >> 8);
    map->y = (int8_t)((v[0]->y >> 8) - t->y_top);
    map->level = 0;
    map->light = ph_texture_light(t->material, v[0]);
    const bool nearest = !map->light.shaded && texture->filter == NULL;
    map->fast = nearest && map->light.light == 32 && texture->wrap == PH_WRAP_REPEAT;
    if (!nearest) {
        set_general(t, &f, v);
    }
    t->kind = PH_KIND_SMALL_TEXTURE;
    return true;
}
