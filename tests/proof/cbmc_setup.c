/* Triangle set-up: no overflow and no bad shift, from any vertices that are in reach. See proof.h. */
#include "proof_render.h"

#include "../../firmware/core/render/outline.c"
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
    wide_edge(&a, &b, i32_between(ph_first_row(a.y), ph_first_row(b.y) - 1), &edge);
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
    const struct ph_outline o = ph_outline(t.v);
    ASSUME(o.row_top < o.row_low && o.row_top < height && o.row_low > 0); /* ph_first_row_of */
    ph_setup_outline(height, t.v, &out);
    CLAIM(out.y_top >= 0 && out.y_top < out.y_bottom && out.y_bottom <= height);
    CLAIM(out.as.large.y_mid >= out.y_top && out.as.large.y_mid <= out.y_bottom);
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
    const struct ph_setting setting = {.r = &r, .source = PH_FROM_CORNERS};
    is_inside(&r, v);
    CLAIM(!ph_sides_are_small(&s) || s.is_short);
    CLAIM(ph_excess_of(&setting, &s, v) == PH_EXCESS_LARGE || s.is_short);
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
    in_view(&r.lens, &t);
    r.stats.depth_format = nondet_i32() > 0 ? PH_DEPTH_FLOAT16 : PH_DEPTH_FIXED16;
    const struct ph_setting s = {
        .r = &r, .fast.material = &material, .fast.bias = nondet_u32(), .octaves = ph_depth_ways(&r)->octaves};
    small_depths(&s, t.v, d, &block);
}

static bool set_no_texels(struct ph_triangle *t, const struct ph_setting *s, const struct ph_vertex *const v[3],
                          const fx_t *const uv[3])
{
    return t != NULL && s != NULL && v != NULL && uv != NULL;
}

static void prepare_nothing(struct ph_setting *s)
{
    (void)s;
}

void proof_setting(void)
{
    struct ph_renderer r;
    struct ph_texture texture;
    struct ph_material material = {.texture = &texture};
    const struct ph_draw draw = {.material = &material, .kind = nondet_u32()};
    struct ph_setting s;
    texture.log2_width = (uint8_t)u32_between(0, 10);
    texture.log2_height = (uint8_t)u32_between(0, 10);
    struct ph_shading shading = {.corners = (uint8_t)nondet_u32()};
    shading.texturing.set_texels = nondet_u32() != 0 ? set_no_texels : NULL;
    material.shading = nondet_u32() != 0 ? &shading : NULL;
    r.stats.depth_format = ph_depth_formats[u32_between(1, PH_DEPTH_FORMATS - 1)];
    r.lens = any_lens();
    const struct ph_antialiasing antialiasing = {.prepare = prepare_nothing};
    r.config.antialiasing = nondet_u32() != 0 ? &antialiasing : NULL;
    const struct ph_colouring colouring = {.prepare = prepare_nothing}; /* only then a draw has colours */
    r.config.colouring = &colouring;
    ph_setting_of(&s, &r, &draw);
}
