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
#include "texels.h"

#include "planes.h"
#include "slopes.h"

/* What u and v share. */
struct warp {
    int32_t scale[3]; /* P over u - u0 at the corners, Q15 */
    int32_t q[3];     /* Q16 */
    uint32_t error;   /* d^2 / 2, Q16 */
};

/* False if W changes by more than a quarter. */
static bool set_warp(struct warp *p, const struct ph_vertex *const v[3])
{
    const int least = ph_min(ph_min(v[0]->s, v[1]->s), v[2]->s), most = ph_max(ph_max(v[0]->s, v[1]->s), v[2]->s);
    if (most > least + 1) {
        return false;
    }
    const int32_t w[3] = {(int32_t)(v[0]->q >> (v[0]->s - least + 14)), (int32_t)(v[1]->q >> (v[1]->s - least + 14)),
                          (int32_t)(v[2]->q >> (v[2]->s - least + 14))};
    const int32_t low = ph_min(ph_min(w[0], w[1]), w[2]), high = ph_max(ph_max(w[0], w[1]), w[2]);
    const int32_t middle = (low + high) >> 1;
    if (high - low > middle >> 2) {
        return false;
    }
    const int zeros = fx_clz32((uint32_t)middle);
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

/* c x / 256, but for the last 8 bits of the fraction. */
static uint32_t times_px(uint32_t c, int32_t x)
{
    return c * (uint32_t)(x >> 8) + (uint32_t)((int32_t)c >> 8) * (uint32_t)(x & 255);
}

/* How far a gradient must be shifted to the right to have 15 bits. */
static int excess(const struct ph_subpixel_gradient *g)
{
    const int bits = 32 - fx_clz32(ph_without_sign(g->x) | ph_without_sign(g->y));
    return ph_max(bits - 14, 0);
}

/* -P q. The gradients are per 1/256 px; g in 2^-22 texels, so in 2^-14 per pixel; q in Q28, so in Q20 per pixel. */
static struct ph_curve curve_of(const struct ph_subpixel_gradient *g, const struct ph_subpixel_gradient *q)
{
    const int drop_g = excess(g), drop_q = excess(q);
    const int32_t gx = g->x >> drop_g, gy = g->y >> drop_g, qx = q->x >> drop_q, qy = q->y >> drop_q;
    const int32_t xx = -(gx * qx), xy = -(gx * qy + gy * qx), yy = -(gy * qy);
    const int bits = 32 - fx_clz32(ph_without_sign(xx) | ph_without_sign(xy) | ph_without_sign(yy));
    int shift = drop_g + drop_q - 12, down = ph_max(bits - 14, 0);
    down = ph_max(down, -shift); /* not finer than 2^-22 texels */
    shift = ph_min(down + shift, 24);
    const int32_t half = (1 << down) >> 1;
    return (struct ph_curve){(int16_t)((xx + half) >> down), (int16_t)((xy + half) >> down),
                             (int16_t)((yy + half) >> down), (int16_t)shift};
}

/* The polynomial through u0, from the differences d1, d2 (Q16.16) of the other corners; `unit`: log2 of the units in
 * 2^-16. x, y: from the first corner to the centre of the first column and row, 1/256 px. */
static void set_way(struct ph_plane *way, struct ph_curve *curve, const struct warp *p, const struct ph_slopes *slopes,
                    const struct ph_subpixel_gradient *q, int32_t d1, int32_t d2, int unit, int32_t x, int32_t y)
{
    const int up = ph_min(fx_clz32(ph_without_sign(d1) | ph_without_sign(d2)) - 18, unit); /* to 14 bits */
    const int32_t p1 = (up >= 0 ? d1 * (1 << up) : d1 >> -up) * p->scale[1] >> 15;
    const int32_t p2 = (up >= 0 ? d2 * (1 << up) : d2 >> -up) * p->scale[2] >> 15;
    struct ph_subpixel_gradient g;
    ph_set_gradient(&g, slopes, p1, p2, unit - up, 22);
    *curve = curve_of(&g, q);
    const uint32_t xx = (uint32_t)curve->xx << curve->shift, xy = (uint32_t)curve->xy << curve->shift,
                   yy = (uint32_t)curve->yy << curve->shift;
    const uint32_t xx_x = times_px(xx, x), yy_y = times_px(yy, y), rise = xx_x + times_px(xy, y);
    way->base += (uint32_t)g.x * (uint32_t)x + (uint32_t)g.y * (uint32_t)y + times_px(rise, x) + times_px(yy_y, y);
    way->gx = (uint32_t)g.x * 256 + rise + xx_x;
    way->gy = (uint32_t)g.y * 256 + times_px(xy, x) + 2 * yy_y;
}

/* Whether all corners of a clamped texture fit into the units beside the sign: see set_texels in texture.c. */
static bool fits_clamped(const struct ph_texture *texture, const fx_t *const uv[3])
{
    uint32_t all = 0;
    for (int i = 0; i < 3; i++) {
        all |= ph_without_sign(uv[i][0]) | ph_without_sign(uv[i][1]);
    }
    const int range = ph_max(16 - fx_clz32(all), 0);
    return range + texture->log2_width <= 8 && range + texture->log2_width + texture->log2_height <= 14;
}

bool ph_setup_texels(struct ph_triangle *t, const struct ph_renderer *r, const struct ph_vertex *const v[3],
                     const fx_t *const corner_uv[3], const struct ph_sides *sides)
{
    static const fx_t origin[2];
    static const fx_t *const origins[3] = {origin, origin, origin};
    const fx_t *const *const uv = corner_uv != NULL ? corner_uv : origins;
    const struct ph_texture *const texture = t->material->texture;
    const int width = texture->log2_width, height = texture->log2_height;
    const int32_t du1 = uv[1][0] - uv[0][0], du2 = uv[2][0] - uv[0][0], dv1 = uv[1][1] - uv[0][1],
                  dv2 = uv[2][1] - uv[0][1];
    struct warp warp = {{0, 32768, 32768}, {0, 0, 0}, 0};
    if ((r->lens.kind != PH_ORTHOGRAPHIC && !set_warp(&warp, v)) ||
        (texture->wrap == PH_WRAP_CLAMP && !fits_clamped(texture, uv))) {
        return false;
    }
    const uint32_t most_u = (ph_without_sign(du1) | ph_without_sign(du2)) >> 4,
                   most_v = (ph_without_sign(dv1) | ph_without_sign(dv2)) >> 4;
    if ((most_u >> (23 - width) | most_v >> (23 - height)) != 0 || (most_u >> 16 | most_v >> 16) != 0 ||
        (most_u << width | most_v << height) * warp.error >= 65536 * 256) {
        return false;
    }
    const struct ph_slopes slopes = ph_slopes_of(sides);
    struct ph_subpixel_gradient q;
    struct ph_plane u;
    ph_set_gradient(&q, &slopes, warp.q[1], warp.q[2], 12, 22);
    t->y_mid = (int16_t)(ph_min(ph_min(v[0]->x, v[1]->x), v[2]->x) >> 8);
    const int32_t x = t->y_mid * 256 + 128 - v[0]->x, y = t->y_top * 256 + 128 - v[0]->y;
    u.base = (uint32_t)uv[0][0] << (width + 6);
    t->v.base = (uint32_t)uv[0][1] << (width + height);
    if (texture->wrap == PH_WRAP_REPEAT) {
        u.base &= UINT32_MAX >> (10 - width);
    }
    set_way(&u, &t->curves[0], &warp, &slopes, &q, du1, du2, width + 6, x, y);
    set_way(&t->v, &t->curves[1], &warp, &slopes, &q, dv1, dv2, width + height, x, y);
    t->small.light = u.base;
    t->small.glight = u.gx;
    t->small.light_dy = u.gy;
    t->kind = PH_KIND_SMALL_TEXTURE;
    t->colour = ph_texture_light(t->material, v[0]);
    return true;
}
