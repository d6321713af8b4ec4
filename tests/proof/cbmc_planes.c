/* Planes: no overflow and no bad shift in any of its functions, from any vertices of set-up. See proof.h. */
#include "proof_render.h"

#include "../../firmware/core/render/knee.c"
#include "../../firmware/core/render/lift.c"
#include "../../firmware/core/render/planes.c"

/* Twice the area of a triangle whose corners are in reach. It is linear in each coordinate, so it is largest where each
 * is at one of its ends. */
void proof_area(void)
{
    int32_t at[6];
    for (int i = 0; i < 6; i++) {
        at[i] = nondet_i32() > 0 ? REACH : -REACH;
    }
    const struct ph_sides s = {at[2] - at[0], at[3] - at[1], at[4] - at[0], at[5] - at[1], 0, false};
    CLAIM(ph_wide_area_proved(&s) < POWER(42));
}

void proof_plane_base(void)
{
    struct triangle t;
    struct ph_plane_base base;
    any_triangle(&t);
    plane_base(&base, t.v[0], &t.sides);
    CLAIM(base.part_x >= 0 && base.part_x <= 255 && base.part_y >= 0 && base.part_y <= 255);
    CLAIM(base.reciprocal >= (t.sides.is_short ? 1 << 15 : 1 << 29));
    CLAIM(base.shift >= (t.sides.is_short ? 3 : -10) && base.shift <= 31);
}

/* A base as proof_plane_base found it. */
static struct ph_plane_base any_base(struct triangle *t)
{
    any_triangle(t);
    const bool is_short = t->sides.is_short;
    return (struct ph_plane_base){&t->sides,
                                  i32_between(-REACH / 256 - 1, REACH / 256 + 1),
                                  i32_between(-REACH / 256 - 1, REACH / 256 + 1),
                                  i32_between(0, 255),
                                  i32_between(0, 255),
                                  i32_between(is_short ? 1 << 15 : 1 << 29, is_short ? 1 << 16 : 1 << 30),
                                  i32_between(is_short ? 3 : -10, 31)};
}

#define SIDE         (2 * REACH)
#define WIDE_PRODUCT (POWER(32) * SIDE)

/* Stands for fx_mul_wide in proof_times_wide. */
int64_t any_product(int32_t a, int32_t n)
{
    (void)a;
    CLAIM(n >= -SIDE && n <= SIDE);
    return i64_between(-POWER(31) * SIDE, POWER(31) * SIDE);
}

/* The upper two bits of d are constants in each call, which spares the solver a product. test_planes.c finds the
 * results exact, so that they are within WIDE_PRODUCT. */
void proof_times_wide(void)
{
    const int64_t least[] = {-POWER(32), -POWER(31), 0, POWER(31)};
    for (int i = 0; i < 4; i++) {
        times_wide(least[i] | (nondet_u32() & 0x7fffffff), i32_between(-SIDE, SIDE));
    }
}

/* Stands for times_wide in proof_wide_gradient. */
int64_t any_wide_product(int64_t d, int32_t n)
{
    CLAIM(d > -POWER(32) && d < POWER(32) && n >= -SIDE && n <= SIDE);
    return i64_between(-WIDE_PRODUCT, WIDE_PRODUCT);
}

/* Stands for fx_mul_wide in proof_wide_gradient: a number of 32 bits times a reciprocal. */
int64_t any_quotient(int32_t a, int32_t b)
{
    (void)a;
    CLAIM(b >= 0 && b <= POWER(30));
    return i64_between(-POWER(61), POWER(61));
}

void proof_wide_gradient(void)
{
    struct triangle t;
    const struct ph_plane_base base = any_base(&t);
    int halved;
    ASSUME(!t.sides.is_short); /* short sides get the base of wide ones first */
    wide_gradient(&base, i64_between(-POWER(32) + 1, POWER(32) - 1), i64_between(-POWER(32) + 1, POWER(32) - 1),
                  &halved);
}

void proof_short_plane(void)
{
    struct triangle t;
    const struct ph_plane_base base = any_base(&t);
    struct ph_plane out;
    ASSUME(t.sides.is_short);
    short_plane(&out, &base, i32_between(-(1 << 15), 1 << 15), i32_between(-(1 << 15), 1 << 15), i32_between(0, 17));
}

void proof_plane_through(void)
{
    struct triangle t;
    const struct ph_plane_base base = any_base(&t);
    struct ph_plane out;
    uint32_t v[3];
    plane_through(&out, &base, v, i32_between(0, 1) != 0);
}

void proof_plane_light(void)
{
    struct triangle t;
    const struct ph_plane_base base = any_base(&t);
    struct ph_plane out;
    plane_light(&out, &base, t.v);
}

void proof_plane_exact(void)
{
    struct triangle t;
    const struct ph_plane_base base = any_base(&t);
    struct ph_plane out;
    uint32_t v[3];
    plane_exact(&out, &base, v);
}

void proof_depths(void)
{
    struct triangle t;
    struct ph_renderer r;
    struct ph_material m;
    uint32_t d[3];
    any_triangle(&t);
    r.lens = any_lens();
    in_view(&r.lens, &t);
    corner_over_w(t.v[0], least_exponent(t.v));
    fixed_depths(&r, t.v, ph_depth_bias(&m), d);
    struct ph_plane plane;
    const int block = ph_block_depths(&r, t.v, ph_depth_bias(&m), d);
    CLAIM(block == PH_BLOCK_NONE || (ph_block_exponent(block) <= 60 && ph_block_down(block) == r.lens.float_down));
    if (block != PH_BLOCK_NONE) {
        (void)ph_small_plane_does(d, block);
        ph_block_rounded(d[0], block);
    }
    round_depth(&plane, i32_between(0, 5));
}

void proof_setup_depth(void)
{
    struct triangle t;
    struct ph_renderer r;
    struct ph_material m;
    const struct ph_plane_base base = any_base(&t);
    struct ph_depth depth;
    uint8_t block;
    r.lens = any_lens();
    in_view(&r.lens, &t);
    r.stats.depth_format = ph_depth_formats[u32_between(1, PH_DEPTH_FORMATS - 1)];
    setup_depth(&r, &base, &m, t.v, &depth, &block);
}

void proof_setup_texture(void)
{
    struct triangle t;
    struct ph_renderer r;
    r.lens = any_lens();
    struct ph_texture x;
    struct ph_material m = {.texture = &x};
    fx_t uv[3][2];
    const fx_t *uvs[3] = {uv[0], uv[1], uv[2]};
    const struct ph_plane_base base = any_base(&t);
    struct ph_triangle out = {.material = &m};
    setup_texture(&r, &base, t.v, uvs, &out);
}
