/* Bands of the small profile: each goes through the triangles of all parts. See small.h. */
#include "small.h"

#include "shading.h"

/* What a band draws at the moment. */
struct work {
    struct ph_renderer *r;
    const struct ph_small_part *part;
    struct ph_band band;
};

static uint32_t over_w(const struct ph_small_vertex *v)
{
    return v->over[0] | (uint32_t)v->over[1] << 16;
}

/* A vertex that is not far. With an exponent of 2 its quotient is N/w in 2^-32. */
static void unpack(const struct ph_small_vertex *from, struct ph_vertex *v)
{
    *v = (struct ph_vertex){from->x, from->y, over_w(from), 2, 0, from->light};
}

/* Whether a triangle covers the centre of a pixel of the picture, as ph_first_row_of of render/list.h has it, in a row
 * of the band. */
static bool is_in_band(const struct work *w, const struct ph_vertex *const v[3])
{
    const int32_t left = ph_first_row(ph_min(ph_min(v[0]->x, v[1]->x), v[2]->x));
    const int32_t right = ph_first_row(ph_max(ph_max(v[0]->x, v[1]->x), v[2]->x));
    const int32_t top = ph_first_row(ph_min(ph_min(v[0]->y, v[1]->y), v[2]->y));
    const int32_t low = ph_first_row(ph_max(ph_max(v[0]->y, v[1]->y), v[2]->y));
    return left < right && right > 0 && left < w->band.width && top < low && top < w->band.y1 && low > w->band.y0;
}

/* Draws a projected triangle. False: its corners must be exact ones. */
static bool draw_projected(const struct work *w, const struct ph_vertex at[3], bool exact)
{
    const struct ph_vertex *v[3] = {&at[0], &at[1], &at[2]};
    if (!is_in_band(w, v)) {
        return true;
    }
    const int32_t area = ph_sides(v[0], v[1], v[2]).area;
    if (area == 0 || (area < 0 && w->part->material->two_sided == 0)) {
        return true;
    }
    if (area < 0) {
        v[1] = &at[2];
        v[2] = &at[1];
    }
    if (exact) {
        ph_small_draw_exact(w->r, w->part->material, &w->band, v);
        return true;
    }
    return ph_small_draw(w->r, w->part->material, &w->band, v);
}

/* Transforms the corners of a triangle again. */
static void transform_again(const struct work *w, const uint16_t index[3], struct ph_vertex at[3])
{
    for (int i = 0; i < 3; i++) {
        const struct ph_small_vertex *const v = &w->part->vertices[index[i]];
        ph_transform(w->r, &w->part->matrix, &w->part->positions[index[i]], &at[i]);
        at[i].light = v->light != 0 ? v->light : v->y;
    }
}

/* The corners of a fan's triangle i, which clipping has made: see project_corner in render/clipped.c. */
static PH_NOINLINE void project(const struct ph_lens *lens, const struct ph_clip_vertex *fan, int i,
                                struct ph_vertex at[3])
{
    const struct ph_clip_vertex *const corners[3] = {&fan[0], &fan[i - 1], &fan[i]};
    for (int k = 0; k < 3; k++) {
        const struct ph_clip_vertex *const in = corners[k];
        struct ph_vertex *const v = &at[k];
        ph_project(lens, in->x, in->y, in->w, in->z, v);
        v->x = ph_max(ph_min(v->x, PH_GUARD_MAX), -PH_GUARD_MAX);
        v->y = ph_max(ph_min(v->y, PH_GUARD_MAX), -PH_GUARD_MAX);
        v->light = (uint16_t)in->light;
        v->code = 0;
    }
}

/* The corners of a triangle of which one is far: in `at`, or *fan, if it is clipped. Returns how many there are. */
static PH_NOINLINE int far_corners(const struct work *w, const uint16_t index[3], struct ph_vertex at[3],
                                   const struct ph_clip_vertex **fan)
{
    struct ph_small_clip *const clip = w->r->clip;
    const bool alike = ph_lit_corners_of(w->part->material) != PH_EACH_CORNER;
    transform_again(w, index, at);
    if ((at[0].code & at[1].code & at[2].code & PH_REJECT) != 0) {
        return 0;
    }
    if (((at[0].code | at[1].code | at[2].code) & PH_CLIP) == 0) {
        return 3;
    }
    if (clip == NULL) {
        w->r->stats.triangles_dropped++;
        return 0;
    }
    for (int i = 0; i < 3; i++) {
        clip->work[0][i] = ph_clip_place(&w->r->lens, &w->part->matrix, &w->part->positions[index[i]]);
        clip->work[0][i].light = at[alike ? 0 : i].light;
    }
    return ph_small_clip(&w->r->lens, clip, fan);
}

/* Draws a triangle in the band, if it has rows there. */
static void draw_triangle(const struct work *w, const uint16_t index[3])
{
    const struct ph_small_vertex *const a = &w->part->vertices[index[0]], *const b = &w->part->vertices[index[1]],
                                        *const c = &w->part->vertices[index[2]];
    const bool far = a->light == 0 || b->light == 0 || c->light == 0;
    const struct ph_clip_vertex *fan = NULL;
    struct ph_vertex at[3];
    int corners = 3;
    if (far) {
        corners = far_corners(w, index, at, &fan);
    } else {
        const int32_t top = w->band.y0 * 256 + 128, low = w->band.y1 * 256 + 128;
        if ((a->y <= top && b->y <= top && c->y <= top) || (a->y > low && b->y > low && c->y > low)) {
            return; /* for speed only: see is_in_band */
        }
        unpack(a, &at[0]);
        unpack(b, &at[1]);
        unpack(c, &at[2]);
    }
    for (int i = 2; i < corners; i++) {
        if (fan != NULL) {
            project(&w->r->lens, fan, i, at);
        }
        if (!draw_projected(w, at, false)) {
            if (!far) {
                transform_again(w, index, at);
            }
            draw_projected(w, at, true);
        }
    }
}

static void clear(const struct ph_band *band, uint16_t background)
{
    uint16_t *const depth = band->depth;
    for (uint32_t i = (uint32_t)(band->y1 - band->y0) * band->stride; i-- > 0;) {
        band->pixels[i] = background;
        depth[i] = 0;
    }
}

uint32_t ph_draw_band(struct ph_renderer *r, uint32_t band, uint16_t *pixels)
{
    const uint16_t lines = r->config.band_height, width = r->config.width;
    const int32_t y0 = (int32_t)(band * lines), y1 = ph_min(y0 + lines, r->config.height);
    if (r->state != PH_SMALL_BANDS || band != r->band || band >= r->band_count || pixels == NULL ||
        (uintptr_t)pixels % sizeof(uint16_t) != 0) {
        return 0;
    }
    r->band++;
    struct work w = {
        .r = r,
        .band = {.pixels = pixels, .depth = r->config.depth, .stride = width, .y0 = y0, .y1 = y1, .width = width}};
    clear(&w.band, r->background);
    for (w.part = r->first; w.part != NULL; w.part = w.part->next) {
        for (uint32_t i = 0; i < w.part->count; i++) {
            draw_triangle(&w, w.part->triangles[i]);
        }
    }
    return (uint32_t)(y1 - y0);
}
