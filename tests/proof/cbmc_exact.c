/* Depth in 64 bits: no overflow and no bad shift, from any vertices of set-up. See proof.h. */
#include "proof_render.h"

#include "../../firmware/core/render/exact.c"

#define DEPTHS POWER(40) /* N/w - N/f is below 1 */

/* How a lens's depth becomes codes. */
static const struct ph_exact_ways *any_codes(struct ph_renderer *r, struct ph_exact *e)
{
    r->lens = any_lens();
    r->stats.depth_format = ph_depth_formats[u32_between(1, PH_DEPTH_FORMATS - 1)];
    ASSUME(r->lens.far_s >= 0 || r->stats.depth_format->coding == PH_DEPTH_IS_FIXED);
    set_codes(e, r);
    return ph_depth_ways(r)->exact;
}

void proof_in_40_bits(void)
{
    const struct ph_vertex v = any_vertex();
    const int64_t d = in_40_bits(v.q, v.s);
    CLAIM(d >= 0 && d < 16 * DEPTHS);
}

void proof_divide(void)
{
    divide(i64_between(INT64_MIN, INT64_MAX), (uint64_t)i64_between(1, POWER(42) - 1), nondet_i32() > 0);
}

void proof_set_plane(void)
{
    struct triangle t;
    struct ph_exact e;
    const int64_t d[3] = {i64_between(0, DEPTHS - 1), i64_between(0, DEPTHS - 1), i64_between(0, DEPTHS - 1)};
    any_triangle(&t);
    set_plane(&e, d, t.v[0], &t.sides);
    CLAIM(load(e.low) + load(e.size) < (uint64_t)DEPTHS << 16);
}

void proof_set_run(void)
{
    struct triangle t;
    struct ph_renderer r;
    struct ph_triangle from, run;
    struct ph_exact *const e = &from.as.large.depth.as.exact;
    struct ph_linear *const linear = &from.as.large.depth.over_w.linear;
    struct ph_material material;
    from.material = &material;
    const struct ph_exact_ways *const ways = any_codes(&r, e);
    any_triangle(&t);
    in_view(&r.lens, &t);
    const int a = t.at[0].s, b = t.at[1].s, c = t.at[2].s, ab = a < b ? a : b, least = ab < c ? ab : c;
    const uint64_t d = (uint64_t)i64_between(0, (DEPTHS << 16) - 1);
    ASSUME(least >= 0 || e->coding == PH_DEPTH_IS_FIXED);
    ASSUME(e->coding == PH_DEPTH_IS_FIXED || d >> (56 - least) == 0); /* no depth is above that of the nearest corner */
    *linear = r.lens.linear;
    linear->down = (int8_t)(linear->down - least); /* setup_linear */
    const int octave = octave_of(e, d);
    CLAIM(octave >= 0 && octave <= 31);
    set_run(&from, ways, d, octave, u32_between(0, 1023), u32_between(0, 1023), &run);
}

void proof_linear_code(void)
{
    struct ph_renderer r;
    struct ph_exact e;
    struct ph_linear linear;
    any_codes(&r, &e);
    linear = r.lens.linear;
    linear.up = (uint8_t)u32_between(0, 31);
    linear_code(&e, &linear, (uint64_t)i64_between(0, (DEPTHS << 16) - 1));
}

void proof_range_of(void)
{
    struct ph_renderer r;
    struct ph_exact e;
    const struct ph_exact_ways *const ways = any_codes(&r, &e);
    const uint64_t d = (uint64_t)i64_between(0, (DEPTHS << 16) - 1);
    range_of(&e, ways, octave_of(&e, d));
}

void proof_rows(void)
{
    struct ph_renderer r;
    struct ph_material material;
    struct ph_triangle t, run;
    t.material = &material;
    const struct ph_exact_ways *const ways = any_codes(&r, &t.as.large.depth.as.exact);
    const int32_t y = i32_between(0, 1023);
    struct ph_exact_strip strip; /* with any edges */
    strip.rows.y = y;
    strip.rows.y_end = i32_between(y + 1, 1024);
    strip.width = i32_between(1, 1024);
    strip.ways = ways;
    ph_exact_rows(&t, &strip, &run);
}

/* At most PH_EXACT_RUN pixels of a row are asked for: the loop turns as often. */
void proof_pixels_in(void)
{
    const struct range range = {(uint64_t)nondet_i64(), (uint64_t)nondet_i64()};
    const uint32_t n = u32_between(1, PH_EXACT_RUN);
    const uint32_t count = pixels_in(&range, (uint64_t)nondet_i64(), (uint64_t)nondet_i64(), n);
    CLAIM(count >= 1 && count <= n);
}

/* Stands for pixels_in. */
uint32_t any_count(const struct range *range, uint64_t d, uint64_t gd, uint32_t n);

uint32_t any_count(const struct range *range, uint64_t d, uint64_t gd, uint32_t n)
{
    (void)range;
    (void)d;
    (void)gd;
    return u32_between(1, n);
}

void proof_run(void)
{
    struct ph_renderer r;
    struct ph_material material;
    struct ph_triangle t, run;
    t.material = &material;
    const struct ph_exact_ways *const ways = any_codes(&r, &t.as.large.depth.as.exact);
    const int32_t x = i32_between(0, 1023), x_end = i32_between(x + 1, 1024);
    const int32_t count = ph_exact_run(&t, ways, x, x_end, i32_between(0, 1023), &run);
    CLAIM(count >= 1 && count <= x_end - x);
}

/* Afterwards all depths are still below 1. */
void proof_lift(void)
{
    struct ph_renderer r;
    struct ph_exact e;
    struct ph_linear linear;
    any_codes(&r, &e);
    linear = r.lens.linear;
    const uint64_t low = (uint64_t)i64_between(0, (DEPTHS << 16) - 1);
    store(e.low, low);
    store(e.size, (uint64_t)i64_between(0, (DEPTHS << 16) - 1 - (int64_t)low));
    lift(&r, &e, &linear, u32_between(1, 255));
    CLAIM(load(e.low) + load(e.size) < (uint64_t)DEPTHS << 16);
}
