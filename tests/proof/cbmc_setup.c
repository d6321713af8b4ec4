/* Triangle set-up: no overflow and no bad shift, from any vertices that are in reach. See proof.h. */
#include "proof_render.h"

#include "../../firmware/core/render/setup.c"

/* A corner, and one below it that begins in a later row. */
static void any_edge(struct ph_vertex *a, struct ph_vertex *b)
{
    *a = any_vertex();
    *b = any_vertex();
    ASSUME(ph_first_row(a->y) < ph_first_row(b->y));
}

void proof_setup_edge(void)
{
    struct ph_vertex a, b;
    struct ph_edge edge;
    any_edge(&a, &b);
    setup_edge(&a, &b, i32_between(ph_first_row(a.y), REACH / 256), &edge);
}

void proof_wide_edge(void)
{
    struct ph_vertex a, b;
    struct ph_edge edge;
    any_edge(&a, &b);
    wide_edge(&a, &b, i32_between(ph_first_row(a.y), REACH / 256), &edge);
}

void proof_short_edge(void)
{
    struct ph_vertex a, b;
    any_edge(&a, &b);
    const int32_t dx = b.x - a.x, dy = b.y - a.y;
    ASSUME(dx >= -(int32_t)PH_SIDE_SHORT && dx < (int32_t)PH_SIDE_SHORT && dy < (int32_t)PH_SIDE_SHORT);
    ph_short_edge(&a, dx, dy, ph_first_row(a.y), i32_between(ph_first_row(a.y), REACH / 256));
}

void proof_setup_outline(void)
{
    struct triangle t;
    struct ph_triangle out;
    any_triangle(&t);
    const int32_t height = i32_between(1, 1024);
    if (setup_outline(height, t.v, &out)) {
        CLAIM(out.y_top >= 0 && out.y_top < out.y_bottom && out.y_bottom <= height);
        CLAIM(out.y_mid >= out.y_top && out.y_mid <= out.y_bottom);
    }
}

/* The sides of any triangle in reach, and the tests that choose its way. */
void proof_sides(void)
{
    struct ph_vertex at[3] = {any_vertex(), any_vertex(), any_vertex()};
    const struct ph_vertex *const v[3] = {&at[0], &at[1], &at[2]};
    const struct ph_sides s = ph_sides(v[0], v[1], v[2]);
    struct ph_renderer r;
    r.config.width = (uint16_t)u32_between(1, 1024);
    r.config.height = (uint16_t)u32_between(1, 1024);
    is_inside(&r, v);
    CLAIM(!is_small(&s) || s.is_short);
    is_thin(&s);
    misses_columns(r.config.width, v);
}

void proof_small_depths(void)
{
    struct triangle t;
    struct ph_renderer r;
    struct ph_material material;
    uint32_t d[3];
    uint8_t block;
    any_triangle(&t);
    r.lens = any_lens();
    small_depths(&r, &material, t.v, d, &block);
}

void proof_setup_part(void)
{
    struct ph_renderer r;
    struct ph_material material;
    r.lens = any_lens();
    ph_setup_part(&r, &material);
}

void proof_setup_line(void)
{
    struct ph_renderer r;
    struct ph_material material;
    struct ph_corner a, b;
    a.at = any_vertex();
    b.at = any_vertex();
    ph_setup_line(&r, &material, &a, &b);
}
