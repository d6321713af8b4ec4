/* proof_render: vertices and lenses as the stages before set-up leave them, within the ranges of their headers. */
#ifndef PROOF_RENDER_H
#define PROOF_RENDER_H

#include "proof.h"

/* The reciprocals are their contracts here: Gappa and cbmc_fx.c prove these. */
#define fx_rcp_norm fx_rcp_norm_proved
#define fx_rcp16    fx_rcp16_proved
#include "fx.h"
#undef fx_rcp_norm
#undef fx_rcp16

static inline uint32_t fx_rcp_norm(uint32_t w, int *shift)
{
    *shift = fx_clz32(w != 0 ? w : 1);
    return u32_between((uint32_t)1 << 30, (uint32_t)1 << 31);
}

uint32_t fx_rcp_far(uint32_t w, int *shift)
{
    return fx_rcp_norm(w, shift);
}

static inline uint32_t fx_rcp16(uint32_t d)
{
    CLAIM(d >= 1 << 15 && d < 1 << 16);
    return u32_between(1 << 15, (1 << 16) - 1);
}

#include "depth.h"

#define LEAST_Q (((uint32_t)1 << 30) - ((uint32_t)1 << 23)) /* 2^30 (1 - 2^-7): Gappa, with 6 bits of exponent */

#define LEAST_S (-3) /* of a fixed format, whose N/w may be up to 8; 0 in the others */

#define REACH (PH_GUARD_MAX + 128) /* a corner of a line is half a pixel beside it */

#define ph_wide_area ph_wide_area_proved
#include "sides.h"
#undef ph_wide_area

static inline int64_t ph_wide_area(const struct ph_sides *s)
{
    (void)s;
    return i64_between(1, POWER(42) - 1); /* proof_area */
}

#include "../../firmware/core/render/depth_formats.c"

static inline struct ph_lens lens_of(uint32_t kind)
{
    struct ph_lens lens;
    lens.kind = (uint8_t)kind;
    lens.guard_up = (uint8_t)u32_between(0, 10);
    lens.near_z = i32_between(lens.kind == PH_ORTHOGRAPHIC ? INT32_MIN : 1, INT32_MAX - 1);
    lens.far_z = i32_between(lens.near_z + 1, INT32_MAX);
    lens.near_shift = (int8_t)(fx_clz32((uint32_t)lens.near_z) - i32_between(0, lens.kind == PH_ORTHOGRAPHIC ? 0 : 3));
    lens.far_q = u32_between(LEAST_Q, ((uint32_t)1 << 31) - 1);
    lens.far_s = (int8_t)i32_between(LEAST_S, 31);
    if (lens.kind == PH_ORTHOGRAPHIC) {
        lens.far_q = 0;
        lens.far_s = 0;
    }
    lens.float_down = (uint8_t)u32_between(2, 5);
    lens.linear.bias = PH_DEPTH_BIAS_FIXED16 >> 16;
    lens.linear.down = (int8_t)i32_between(lens.far_s + 3, lens.far_s + 4);
    return lens;
}

static inline struct ph_lens any_lens(void)
{
    return lens_of(u32_between(PH_PERSPECTIVE, PH_FISHEYE));
}

static inline struct ph_vertex any_vertex(void)
{
    struct ph_vertex v;
    v.x = i32_between(-REACH, REACH);
    v.y = i32_between(-REACH, REACH);
    v.q = u32_between(0, ((uint32_t)1 << 31) - 1);
    v.s = (int8_t)i32_between(LEAST_S, 31);
    ASSUME(v.q >= LEAST_Q || v.s == 0); /* orthographic: from 0 on */
    return v;
}

struct triangle {
    struct ph_vertex at[3];
    const struct ph_vertex *v[3];
    struct ph_sides sides;
};

/* A triangle that faces the viewer. */
static inline void any_triangle(struct triangle *t)
{
    for (int i = 0; i < 3; i++) {
        t->at[i] = any_vertex();
        t->v[i] = &t->at[i];
    }
    struct ph_sides *s = &t->sides;
    s->dx1 = t->at[1].x - t->at[0].x, s->dx2 = t->at[2].x - t->at[0].x;
    s->dy1 = t->at[1].y - t->at[0].y, s->dy2 = t->at[2].y - t->at[0].y;
    s->is_short = ph_sides_are_short(s->dx1, s->dy1, s->dx2, s->dy2);
    s->area = s->is_short ? s->dx2 * s->dy1 - s->dx1 * s->dy2 : 1;
    ASSUME(s->area > 0);
}

/* Assumes that no corner is behind the far plane: their exponents are not above that of the far plane. */
static inline void in_view(const struct ph_lens *lens, const struct triangle *t)
{
    for (int i = 0; i < 3; i++) {
        ASSUME(t->at[i].s <= lens->far_s && (lens->kind == PH_ORTHOGRAPHIC || t->at[i].q >= LEAST_Q));
    }
}

#endif
