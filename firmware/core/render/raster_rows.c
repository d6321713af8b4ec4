/*
 * Rows of Gouraud and of textured triangles, as the kernels draw them. Where the depth is a float that crosses octaves,
 * rows of one octave are drawn together, and a row that crosses is drawn in pieces. See raster_rows.h.
 */
/* Kits on armv6m: -O2. */
#include "raster_rows.h"

#include "edge.h"
#include "kernels.h"
#include "shading.h"
#include "span.h"

PH_TIER(scenery)
void ph_octave_of(struct ph_octave *o, const struct ph_triangle *t, uint32_t d, uint32_t gd)
{
    if (t->block >= PH_BLOCK_LINEAR) {
        *o = (struct ph_octave){0, UINT32_MAX, 0, gd, 0};
        return;
    }
    const bool wrapped = d >= PH_DEPTH_WRAPPED;
    const int block = ph_block_exponent(t->block), down = ph_block_down(t->block);
    const int lowest = ph_depth_lowest(block, down), octave = ph_depth_octave(wrapped ? 0 : d, lowest);
    const uint32_t half = octave <= 0 ? (uint32_t)1 << 31 : ((uint32_t)1 << 31) >> octave;
    const uint32_t end = octave <= 0 ? PH_DEPTH_WRAPPED : 2 * half;
    o->bottom = octave >= lowest ? 0 : half;
    o->size = wrapped ? 0 : end - o->bottom;
    o->offset = ph_depth_float16_offset(octave, block, down) + (ph_depth_bias(t->material) << 13);
    o->up = octave - down;
    o->slope = ph_depth_float16_slope(gd, o->up);
}

PH_TIER(loop) FX_APART void ph_skip_rows(struct ph_small_triangle *r, uint32_t n)
{
    ph_skip_rows_of(r, n);
}

PH_TIER(loop)
FX_APART struct ph_place ph_cut_rows(const struct ph_triangle *t, const struct ph_band *band,
                                     struct ph_small_triangle *r)
{
    int32_t y = t->y_top - band->y0;
    if (y < 0) {
        ph_skip_rows(r, 0u - (uint32_t)y);
        y = 0;
    }
    const uint32_t rows = (uint32_t)(band->y1 - band->y0 - y), upper_rows = r->upper_rows;
    if (upper_rows >= rows) {
        r->upper_rows = (uint16_t)rows;
        r->lower_rows = 0;
    } else if (r->lower_rows > rows - upper_rows) {
        r->lower_rows = (uint16_t)(rows - upper_rows);
    }
    const uint32_t stride = band->stride, start = (uint32_t)y * stride;
    return (struct ph_place){(uint16_t *)band->depth + start, band->pixels + start, stride, ph_small_gouraud,
                             PH_LIGHT_DOWN};
}

/* Whether the depth where an edge meets a row, a pixel more or less, lies in the octave. */
static inline bool end_in_octave(const struct ph_octave *octave, uint32_t d, uint32_t x, uint32_t gd)
{
    const uint32_t at = d + (uint32_t)((int32_t)x >> 16) * gd - octave->bottom;
    return at < octave->size && at - gd < octave->size && at + gd < octave->size;
}

/* Whether the upper rows lie in the octave, because the ends of the first and of the last one do. */
static bool all_in_octave(const struct ph_small_triangle *r, const struct ph_octave *octave)
{
    const uint32_t n = r->upper_rows - 1u, gd = r->gd, last = r->d + n * r->d_dy;
    return end_in_octave(octave, r->d, r->left, gd) && end_in_octave(octave, r->d, r->right, gd) &&
           end_in_octave(octave, last, r->left + n * r->left_dx, gd) &&
           end_in_octave(octave, last, r->right + n * r->right_dx, gd);
}

/* How many of the next upper rows lie wholly in the octave. d, gd and d_dy are in units of the triangle's plane. */
static uint32_t rows_in_octave(const struct ph_small_triangle *r, const struct ph_octave *octave, uint32_t width)
{
    uint32_t left = r->left, right = r->right, d = r->d, n = 0;
    if (all_in_octave(r, octave)) {
        return r->upper_rows;
    }
    for (; n < r->upper_rows; n++) {
        const uint32_t from = ph_from_column(left), to = ph_to_column(right, width), first = d + from * r->gd;
        if ((int32_t)(to - from) > 0 && !ph_octave_holds(octave, first, first + (to - from - 1) * r->gd)) {
            break;
        }
        left += r->left_dx;
        right += r->right_dx;
        d += r->d_dy;
    }
    return n;
}

/* How many of the next upper rows have no pixel, where the first one has none: a triangle may reach far beyond a side
 * of the picture. */
static uint32_t empty_rows(const struct ph_small_triangle *r, uint32_t width)
{
    uint32_t left = r->left, right = r->right, n = 0;
    do {
        left += r->left_dx;
        right += r->right_dx;
        n++;
    } while (n < r->upper_rows && (int32_t)(ph_to_column(right, width) - ph_from_column(left)) <= 0);
    return n;
}

/* Draws the upper rows of r, textured if there are texels. */
static uint32_t draw_upper_rows(const struct ph_triangle *t, const struct ph_small_triangle *r,
                                const struct ph_place *at, struct ph_small_texels *texels)
{
    return texels != NULL ? t->material->shading->texturing.draw_texel_rows(texels, r, at->depth, at->pixels)
                          : at->draw_gouraud(r, at->depth, at->pixels, 2 * at->stride);
}

/* Draws rows of one octave. The steps of d are multiples of 8, so the shift to codes loses no bit of them. */
static uint32_t draw_rows_in_octave(const struct ph_triangle *t, struct ph_small_triangle *r,
                                    const struct ph_octave *octave, uint32_t rows, const struct ph_place *at,
                                    struct ph_small_texels *texels)
{
    const uint32_t from = ph_from_column(r->left), d = r->d, gd = r->gd, d_dy = r->d_dy;
    const uint32_t above =
        d + from * gd - octave->bottom; /* the first row's d lies in the octave, unless it is empty */
    const uint16_t upper_rows = r->upper_rows, lower_rows = r->lower_rows;
    r->gd = octave->slope;
    r->d_dy = ph_depth_float16_slope(d_dy, octave->up);
    r->d = ph_depth_float16_value(octave->bottom, octave->up) + octave->offset +
           ph_depth_float16_slope(above, octave->up) - from * r->gd;
    r->upper_rows = (uint16_t)rows;
    r->lower_rows = 0;
    const uint32_t count = draw_upper_rows(t, r, at, texels);
    r->d = d;
    r->gd = gd;
    r->d_dy = d_dy;
    r->upper_rows = upper_rows;
    r->lower_rows = lower_rows;
    return count;
}

/* How many of n pixels lie in the octave in one run; the first has depth d, and counts in any case. */
static uint32_t pixels_in_octave(const struct ph_octave *octave, uint32_t d, uint32_t gd, uint32_t n)
{
    const uint32_t size = octave->size;
    uint32_t above = d - octave->bottom, count = 0;
    if (FX_DIVIDES_32 && above < size && gd != 0) {
        const uint32_t room = (int32_t)gd > 0 ? (size - 1 - above) / gd : above / (0u - gd);
        return room < n ? room + 1 : n;
    }
    do {
        above += gd;
        count++;
    } while (count < n && above < size);
    return count;
}

/* Draws a row that crosses octaves. It begins in `first`; `next` is a guess of the octave that follows. */
static uint32_t draw_row_across(const struct ph_triangle *t, const struct ph_small_triangle *r,
                                const struct ph_octave *first, struct ph_octave *next, const struct ph_place *at,
                                struct ph_small_texels *texels)
{
    const uint32_t from = ph_from_column(r->left), to = ph_to_column(r->right, at->stride);
    const struct ph_octave *octave = first;
    for (uint32_t x = from, n; x < to; x += n) {
        const uint32_t d = r->d + x * r->gd;
        if (!ph_octave_holds(octave, d, d)) {
            if (!ph_octave_holds(next, d, d)) {
                ph_octave_of(next, t, d, r->gd);
            }
            octave = next;
        }
        n = pixels_in_octave(octave, d, r->gd, to - x);
        const uint32_t code = ph_depth_float16_code(octave, d);
        if (texels != NULL) {
            const struct ph_row_piece piece = {x, n, code, octave->slope, x + n == to};
            t->material->shading->texturing.draw_texel_piece(texels, &piece, at->depth, at->pixels);
        } else {
            ph_span_gouraud(&at->pixels[x], &at->depth[x], n, code, octave->slope, r->light + x * r->glight, r->glight,
                            r->ramp, at->light_down);
        }
    }
    return to - from;
}

/* Draws the rows of a triangle that crosses octaves. Most of its rows do not. */
uint32_t ph_draw_rows_split(const struct ph_triangle *t, struct ph_small_triangle *r, const struct ph_place *place,
                            struct ph_small_texels *texels)
{
    struct ph_place at = *place;
    struct ph_octave octave = {0}, next; /* none yet */
    next.bottom = next.size = 0;
    uint32_t count = 0;
    while (r->upper_rows > 0) {
        const uint32_t from = ph_from_column(r->left), d = r->d + from * r->gd;
        const bool is_empty = (int32_t)(ph_to_column(r->right, at.stride) - from) <= 0; /* d may have wrapped there */
        if (!is_empty && !ph_octave_holds(&octave, d, d)) {
            ph_octave_of(&octave, t, d, r->gd);
        }
        uint32_t n = is_empty ? empty_rows(r, at.stride) : rows_in_octave(r, &octave, at.stride);
        if (n == 0) {
            n = 1;
            count += draw_row_across(t, r, &octave, &next, &at, texels);
        } else if (!is_empty || texels != NULL) { /* texels are stepped over empty rows, too */
            count += draw_rows_in_octave(t, r, &octave, n, &at, texels);
        }
        ph_skip_rows(r, n);
        at.depth += n * at.stride;
        at.pixels += n * at.stride;
    }
    return count;
}

PH_TIER(seldom) uint32_t ph_draw_split(const struct ph_triangle *t, const struct ph_band *band)
{
    struct ph_small_triangle r = t->as.small.rows;
    const struct ph_place at = ph_cut_rows(t, band, &r);
    if (t->kind != PH_KIND_SMALL_TEXTURE) {
        return ph_draw_rows_split(t, &r, &at, NULL);
    }
    struct ph_small_texels texels;
    t->material->shading->texturing.begin_texels(&texels, t, ph_max(t->y_top, band->y0), 2 * at.stride);
    return ph_draw_rows_split(t, &r, &at, &texels);
}

/* Draws so many rows of a Gouraud triangle that is not small; r stands at the first of them. */
PH_TIER(scenery)
static uint32_t draw_long_rows(const struct ph_triangle *t, const struct ph_band *band, struct ph_small_triangle *r,
                               struct ph_place at, uint32_t rows)
{
    uint32_t count = 0;
    while (rows > 0) {
        const uint32_t n = rows < PH_LONG_ROWS ? rows : PH_LONG_ROWS;
        r->upper_rows = (uint16_t)n;
        if (t->block == PH_BLOCK_NONE) {
            count += at.draw_gouraud(r, at.depth, at.pixels, 2 * at.stride);
            if (n == rows) { /* as in every band of 16 lines */
                return count;
            }
            ph_skip_rows(r, n);
        } else {
            count += band->ways->octaves->draw_rows_split(t, r, &at, NULL);
        }
        at.depth += n * at.stride;
        at.pixels += n * at.stride;
        rows -= n;
    }
    return count;
}

PH_TIER(scenery)
uint32_t ph_draw_long(const struct ph_triangle *t, const struct ph_band *band, ph_gouraud_kernel *draw_gouraud,
                      uint32_t light_down)
{
    const struct ph_plane *const depth = &t->as.large.depth.as.plane, *const light = &t->as.large.of.light;
    struct ph_small_triangle r;
    uint32_t count = 0;
    r.lower_rows = 0;
    r.ramp = t->material->ramp;
    r.gd = depth->gx;
    r.d_dy = depth->gy;
    r.glight = light->gx;
    r.light_dy = light->gy;
    for (int half = 0; half < 2; half++) {
        struct ph_half_rows in;
        if (ph_rows_of_half(t, band, half, &in)) {
            const uint32_t stride = band->stride, start = (uint32_t)(in.y - band->y0) * stride;
            r.left = (uint32_t)in.left.x;
            r.left_dx = (uint32_t)in.left.dx;
            r.right = (uint32_t)in.right.x;
            r.right_dx = (uint32_t)in.right.dx;
            r.d = depth->base + (uint32_t)in.y * depth->gy;
            r.light = light->base + (uint32_t)in.y * light->gy;
            const struct ph_place at = {(uint16_t *)band->depth + start, band->pixels + start, stride, draw_gouraud,
                                        light_down};
            count += draw_long_rows(t, band, &r, at, (uint32_t)(in.y_end - in.y));
        }
    }
    return count;
}
