/* Set-up of small triangles: no overflow and no bad shift. See proof.h. */
#include "proof_render.h"

#include "../../firmware/core/kernels/portable/setup_small.c"
#include "../../firmware/core/kernels/portable/float_depths.c"

/* A small triangle: its sides are below 32 px; those of a narrow one below 64 px downwards. */
static void any_small(struct triangle *t)
{
    const int32_t most = PH_SIDE_SMALL, most_y = PH_SIDE_SHORT;
    any_triangle(t);
    for (int i = 0; i < 3; i++) {
        const struct ph_vertex *const a = t->v[i], *const b = t->v[i < 2 ? i + 1 : 0];
        ASSUME(b->x - a->x >= -most && b->x - a->x <= most && b->y - a->y >= -most_y && b->y - a->y < most_y);
        ASSUME(a->x >= 256 && a->x <= 1023 * 256 && a->y >= 256 && a->y <= 1023 * 256);
    }
}

#define SLOPE (1 << PH_SLOPE_BITS)

void proof_slopes(void)
{
    struct triangle t;
    any_small(&t);
    const struct ph_slopes s = ph_slopes_of(&t.sides);
    CLAIM(s.a >= -SLOPE && s.a < SLOPE && s.b >= -SLOPE && s.b < SLOPE);
    CLAIM(s.c >= -SLOPE && s.c < SLOPE && s.d >= -SLOPE && s.d < SLOPE);
    CLAIM(s.shift >= 0 && s.shift <= 31);
}

/* Slopes in the range that proof_slopes has shown. */
static struct ph_slopes any_slopes(void)
{
    return (struct ph_slopes){i32_between(-SLOPE, SLOPE - 1), i32_between(-SLOPE, SLOPE - 1),
                              i32_between(-SLOPE, SLOPE - 1), i32_between(-SLOPE, SLOPE - 1), i32_between(0, 31)};
}

void proof_depth_gradient(void)
{
    struct ph_subpixel_gradient g;
    const struct ph_slopes s = any_slopes();
    struct triangle t;
    uint32_t d[3];
    any_small(&t);
    ASSUME(((d[0] ^ d[1]) | (d[0] ^ d[2])) >> 31 == 0);
    set_depth_gradient(&g, &s, &t.sides, d);
}

/* Light as in set_light; the limit of textures is lower. */
void proof_light_gradient(void)
{
    struct ph_subpixel_gradient g;
    const struct ph_slopes s = any_slopes();
    ph_set_gradient(&g, &s, i32_between(-SLOPE, SLOPE - 1), i32_between(-SLOPE, SLOPE - 1), 17, STEEP_LIGHT);
}

void proof_setup_small(void)
{
    struct triangle t;
    struct ph_triangle out;
    uint32_t d[3];
    any_small(&t);
    ASSUME(((d[0] ^ d[1]) | (d[0] ^ d[2])) >> 31 == 0);
    ph_setup_small(&out, t.v, &t.sides, d);
}

void proof_float_depths(void)
{
    struct triangle t;
    uint32_t d[3];
    const struct ph_lens lens = any_lens();
    any_small(&t);
    in_view(&lens, &t);
    ph_float_depths(&lens, t.v, nondet_u32(), d);
}
