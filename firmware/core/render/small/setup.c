/* Triangles of the small profile: each is set up as render/setup.c does it, and drawn at once. See small.h. */
#include "../planes.c"

#include "small.h"

#include "exact.h"
#include "kernels.h"
#include "outline.h"
#include "raster_rows.h"
#include "span.h"

_Static_assert(sizeof(struct ph_triangle) <= sizeof((struct ph_renderer *)0)->triangle, "see render.h");

/* The triangle that is set up. It lies in the renderer, for the stack is deepest here. */
static struct ph_triangle *triangle_of(struct ph_renderer *r)
{
    return (struct ph_triangle *)(void *)r->triangle;
}

/* The colours of a material's pixels: its ramp, or its colour as the only entry. */
static const uint16_t *ramp_of(const struct ph_material *material)
{
    const bool lit = ph_lit_corners_of(material) != PH_NO_CORNER && material->ramp != NULL;
    return lit ? material->ramp : &material->colour;
}

/* Whether light is interpolated; else it is `first`, that of the first corner in a plane of light. */
static bool has_plane(const struct ph_material *material, const struct ph_vertex *v, uint32_t *first)
{
    const bool lit = ph_lit_corners_of(material) != PH_NO_CORNER && material->ramp != NULL;
    *first = lit ? (uint32_t)v->light << 16 : 0;
    return lit && material->shading->corners == PH_EACH_CORNER;
}

/* Draws rows from row y of the picture on: ph_long_gouraud, in place. */
static uint32_t draw_rows(struct ph_small_triangle *r, int32_t y, const struct ph_band *band)
{
    const uint32_t stride = band->stride, start = (uint32_t)(y - band->y0) * stride;
    uint16_t *depth = (uint16_t *)band->depth + start, *pixels = band->pixels + start;
    uint32_t count = 0;
    for (; r->upper_rows > 0; ph_small_lower(r)) {
        while (r->upper_rows > 0) {
            const uint32_t from = ph_from_column(r->left), columns = ph_to_column(r->right, stride) - from;
            if ((int32_t)columns > 0) {
                ph_span_gouraud(pixels + from, depth + from, columns, r->d + r->gd * from, r->gd,
                                r->light + r->glight * from, r->glight, r->ramp, PH_LIGHT_DOWN);
                count += columns;
            }
            ph_small_step(r, 1);
            r->upper_rows--;
            depth += stride;
            pixels += stride;
        }
    }
    return count;
}

/* Cuts a small triangle that begins at row y to the band, and draws it. */
static uint32_t draw_small(struct ph_small_triangle *rows, int32_t y, const struct ph_band *band)
{
    if (y < band->y0) {
        ph_skip_rows_of(rows, (uint32_t)(band->y0 - y));
    }
    const int32_t from = ph_max(y, band->y0);
    const uint32_t left = (uint32_t)(band->y1 - from);
    rows->upper_rows = rows->upper_rows < left ? rows->upper_rows : (uint16_t)left;
    const uint32_t lower = left - rows->upper_rows;
    rows->lower_rows = rows->lower_rows < lower ? rows->lower_rows : (uint16_t)lower;
    return draw_rows(rows, from, band);
}

/* Sets up a small triangle with these depths. False: they do not fit. */
static bool setup_small(const struct ph_material *material, const struct ph_vertex *const v[3],
                        const struct ph_sides *sides, const uint32_t d[3], struct ph_triangle *t)
{
    struct ph_small_triangle *const rows = &t->as.small.rows;
    uint32_t first;
    if (((d[0] ^ d[1]) | (d[0] ^ d[2])) >> 31 != 0) {
        return false;
    }
    rows->ramp = ramp_of(material);
    if (ph_setup_small(t, v, sides, d) == PH_SMALL_STEEP) {
        struct ph_plane plane;
        if (!ph_depth_plane(&plane, v[0], sides, d)) {
            return false;
        }
        rows->gd = plane.gx;
        rows->d_dy = plane.gy;
        rows->d = plane.base + (uint32_t)t->y_top * plane.gy;
    }
    if (!has_plane(material, v[0], &first)) {
        rows->light = first;
        rows->glight = rows->light_dy = 0;
    }
    return true;
}

/* Colour or light of a triangle that is not small. */
static PH_NOINLINE void setup_light(const struct ph_material *material, const struct ph_vertex *const v[3],
                                    const struct ph_sides *sides, struct ph_triangle *t)
{
    uint32_t first;
    t->material = material;
    t->block = PH_BLOCK_NONE;
    t->kind = PH_KIND_FLAT;
    if (has_plane(material, v[0], &first)) {
        struct ph_plane_base base;
        const int32_t light[3] = {v[0]->light, v[1]->light, v[2]->light};
        plane_base(&base, v[0], sides);
        plane_light(&t->as.large.of.light, &base, light);
        t->kind = PH_KIND_GOURAUD;
    } else {
        t->as.large.of.colour = ramp_of(material)[first >> 25];
    }
}

/* Draws rows of a half of a large triangle, with depth in a plane. */
static uint32_t draw_half(const struct ph_triangle *t, const struct ph_plane *depth, const struct ph_half_rows *in,
                          const struct ph_band *band)
{
    static const struct ph_plane no_light = {0, 0, 0};
    const bool shaded = t->kind == PH_KIND_GOURAUD;
    const struct ph_plane *const light = shaded ? &t->as.large.of.light : &no_light;
    const uint32_t y = (uint32_t)in->y;
    struct ph_small_triangle r;
    r.ramp = shaded ? t->material->ramp : &t->as.large.of.colour;
    r.upper_rows = (uint16_t)(in->y_end - in->y);
    r.lower_rows = 0;
    r.left = (uint32_t)in->left.x;
    r.left_dx = (uint32_t)in->left.dx;
    r.right = (uint32_t)in->right.x;
    r.right_dx = (uint32_t)in->right.dx;
    r.d = depth->base + y * depth->gy;
    r.gd = depth->gx;
    r.d_dy = depth->gy;
    r.light = light->base + y * light->gy;
    r.glight = light->gx;
    r.light_dy = light->gy;
    return draw_rows(&r, in->y, band);
}

/* Draws the rows of a large triangle that lie in the band. */
static PH_NOINLINE uint32_t draw_large(const struct ph_triangle *t, const struct ph_band *band)
{
    struct ph_half_rows in;
    uint32_t count = 0;
    for (int half = 0; half < 2; half++) {
        if (ph_rows_of_half_apart(t, band, half, &in)) {
            count += draw_half(t, &t->as.large.depth.as.plane, &in, band);
        }
    }
    return count;
}

bool ph_small_draw(struct ph_renderer *r, const struct ph_material *material, const struct ph_band *band,
                   const struct ph_vertex *const v[3])
{
    const struct ph_sides sides = ph_sides(v[0], v[1], v[2]);
    struct ph_triangle *const t = triangle_of(r);
    uint32_t d[3];
    fixed_depths(r, v, ph_depth_bias(material), d);
    if (ph_sides_are_small(&sides) && ph_is_between(v[0]->x, v[1]->x, v[2]->x, r->config.width) &&
        ph_is_between(v[0]->y, v[1]->y, v[2]->y, r->config.height) && setup_small(material, v, &sides, d, t)) {
        r->stats.fragments += draw_small(&t->as.small.rows, t->y_top, band);
        return true;
    }
    if (!ph_depth_plane(&t->as.large.depth.as.plane, v[0], &sides, d)) {
        return false;
    }
    ph_setup_outline(r->config.height, v, t);
    setup_light(material, v, &sides, t);
    r->stats.fragments += draw_large(t, band);
    return true;
}

/* The rows of a half between two rows. False: there are none. */
static PH_NOINLINE bool rows_of_half(const struct ph_triangle *t, int32_t y0, int32_t y1, int half,
                                     struct ph_half_rows *in)
{
    const struct ph_band rows = {.y0 = y0, .y1 = y1};
    return ph_rows_of_half(t, &rows, half, in);
}

/* Draws rows of a strip whose depth leaves the range of the corners, run by run. */
static PH_NOINLINE uint32_t draw_runs(const struct ph_triangle *t, uint32_t bias, struct ph_half_rows *in,
                                      const struct ph_band *band)
{
    uint32_t count = 0;
    while (in->y < in->y_end) {
        int32_t x, to;
        const int32_t y = in->y++;
        ph_next_row(&in->left, &in->right, band->width, &x, &to);
        while (x < to) {
            struct ph_plane run;
            const int32_t end = x + ph_small_exact_run(&t->as.large.depth.as.exact, bias, x, to, y, &run);
            const struct ph_half_rows row = {y, y + 1, {x * 65536, 0}, {end * 65536, 0}};
            count += draw_half(t, &run, &row, band);
            x = end;
        }
    }
    return count;
}

/* Draws the rows of a triangle with an exact depth that lie in the band, strip by strip. */
static PH_NOINLINE uint32_t draw_strips(const struct ph_triangle *t, uint32_t bias, const struct ph_band *band)
{
    uint32_t count = 0;
    int32_t next;
    for (int32_t y = ph_max(band->y0 & ~(PH_EXACT_ROWS - 1), t->y_top); y < t->y_bottom && y < band->y1; y = next) {
        const int half = y >= t->as.large.y_mid;
        struct ph_half_rows in;
        struct ph_plane run;
        next = ph_min((y | (PH_EXACT_ROWS - 1)) + 1, half ? t->y_bottom : t->as.large.y_mid);
        rows_of_half(t, y, next, half, &in);
        const bool is_strip = ph_small_exact_rows(&t->as.large.depth.as.exact, bias, &in, band->width, &run);
        if (rows_of_half(t, ph_max(y, band->y0), ph_min(next, band->y1), half, &in)) {
            count += is_strip ? draw_half(t, &run, &in, band) : draw_runs(t, bias, &in, band);
        }
    }
    return count;
}

PH_NOINLINE void ph_small_draw_exact(struct ph_renderer *r, const struct ph_material *material,
                                     const struct ph_band *band, const struct ph_vertex *const v[3])
{
    const struct ph_sides sides = ph_sides(v[0], v[1], v[2]);
    struct ph_triangle *const t = triangle_of(r);
    ph_setup_outline(r->config.height, v, t);
    setup_light(material, v, &sides, t);
    ph_small_set_exact(r, v, &sides, &t->as.large.depth.as.exact);
    r->stats.fragments += draw_strips(t, ph_depth_bias(material), band);
}
