/*
 * Rasterizer: a triangle is walked down its edges, as far as they lie in the band, and its spans are drawn. See band.h.
 *
 * What a triangle gives at a pixel depends on the triangle and the pixel alone, because planes are exact modulo 2^32.
 * So the picture does not depend on where a band begins.
 */
#include "band.h"
#include "colours.h"
#include "edge.h"
#include "exact.h"
#include "kernels.h"
#include "line.h"
#include "span.h"
#include "small_texels.h"
#include "texture.h"

#define NOINLINE __attribute__((noinline)) /* keeps rare work out of the registers of what is usual */

/* n pixels of a row of a triangle. */
struct row {
    uint16_t *pixels;
    void *depth;        /* as in struct ph_band; both are of the first pixel */
    uint32_t n, d;      /* d: depth at the first pixel, in units of the plane */
    uint32_t attribute; /* Gouraud: light at the first pixel */
};

/* Draws a run of pixels along which the depth code is linear. */
static inline void draw_run(const struct ph_triangle *t, bool depth24, const struct row *row, uint32_t gd)
{
    const bool gouraud = t->kind == PH_KIND_GOURAUD, linear = t->block == PH_BLOCK_LINEAR;
    const uint32_t light = row->attribute, glight = t->attribute[0].gx;
    const uint16_t *const ramp = t->material->ramp;
    if (depth24 && gouraud) {
        ph_span_gouraud24(row->pixels, row->depth, row->n, row->d, gd, light, glight, ramp);
    } else if (depth24) {
        ph_span_flat24(row->pixels, row->depth, row->n, row->d, gd, t->colour);
    } else if (linear && gouraud) {
        ph_span_gouraud_linear(row->pixels, row->depth, row->n, row->d, gd, &t->linear, light, glight, ramp);
    } else if (linear) {
        ph_span_flat_linear(row->pixels, row->depth, row->n, row->d, gd, &t->linear, t->colour);
    } else if (gouraud) {
        ph_span_gouraud(row->pixels, row->depth, row->n, row->d, gd, light, glight, ramp);
    } else {
        ph_span_flat(row->pixels, row->depth, row->n, row->d, gd, t->colour);
    }
}

/* Draws a span in as many runs as it needs. */
static void draw_span(const struct ph_triangle *t, bool depth24, struct row row)
{
    uint32_t left = row.n, d = row.d;
    while (left > 0) { /* each turn draws at least one pixel */
        row.n = left;
        const struct ph_piece piece = ph_depth_piece(t, d, &row.n);
        row.d = piece.d;
        draw_run(t, depth24, &row, piece.gd);
        row.pixels += row.n;
        row.depth = ph_depth_from(row.depth, row.n, depth24);
        row.attribute += t->attribute[0].gx * row.n;
        d += t->depth.gx * row.n;
        left -= row.n;
    }
}

/* Draws a span; tries the octave of the last one first. */
static NOINLINE void draw_row(const struct ph_triangle *t, bool depth24, struct ph_octave *octave,
                              const struct row *row)
{
    const uint32_t last = row->d + t->depth.gx * (row->n - 1);
    if (!ph_octave_holds(octave, row->d, last)) {
        ph_octave_of(octave, t, row->d, t->depth.gx);
        if (!ph_octave_holds(octave, row->d, last)) {
            draw_span(t, depth24, *row);
            return;
        }
    }
    struct row run = *row;
    run.d = ph_depth_float16_code(octave, row->d);
    draw_run(t, depth24, &run, octave->slope);
}

/* Draws rows y .. y_end - 1 between two edges, which are given at row y. Returns the number of pixels. */
static uint32_t walk_rows(const struct ph_triangle *t, const struct ph_band *band, int32_t y, int32_t y_end,
                          struct ph_edge left, struct ph_edge right)
{
    const uint32_t start = (uint32_t)(y - band->y0) * (uint32_t)band->width;
    uint16_t *pixels = band->pixels + start;
    void *depth = ph_depth_from(band->depth, start, band->depth24);
    uint32_t d = t->depth.base + (uint32_t)y * t->depth.gy;
    uint32_t attribute = t->attribute[0].base + (uint32_t)y * t->attribute[0].gy, count = 0;
    struct ph_octave octave = {0};
    for (; y < y_end; y++) {
        const int32_t from = left.x < 0 ? 0 : left.x >> 16;
        const int32_t right_column = right.x >> 16, to = right_column > band->width ? band->width : right_column;
        if (from < to) {
            const uint32_t x = (uint32_t)from, n = (uint32_t)(to - from), first_d = d + x * t->depth.gx;
            const uint32_t light = attribute + x * t->attribute[0].gx;
            const struct row row = {pixels + x, ph_depth_from(depth, x, band->depth24), n, first_d, light};
            if (t->block >= PH_BLOCK_LINEAR) { /* no octaves to cross */
                draw_run(t, band->depth24, &row, t->depth.gx);
            } else {
                draw_row(t, band->depth24, &octave, &row);
            }
            count += n;
        }
        left.x = (int32_t)((uint32_t)left.x + (uint32_t)left.dx);
        right.x = (int32_t)((uint32_t)right.x + (uint32_t)right.dx);
        pixels += band->width;
        depth = ph_depth_from(depth, (uint32_t)band->width, band->depth24);
        d += t->depth.gy;
        attribute += t->attribute[0].gy;
    }
    return count;
}

/* The same for one colour and depth codes of 16 bits that are linear along all of the triangle. */
static uint32_t walk_flat_rows(const struct ph_triangle *t, const struct ph_band *band, int32_t y, int32_t y_end,
                               const struct ph_edge *left_edge, const struct ph_edge *right_edge)
{
    const int32_t width = band->width;
    const uint32_t start = (uint32_t)(y - band->y0) * (uint32_t)width, gd = t->depth.gx, d_dy = t->depth.gy;
    uint16_t *pixels = band->pixels + start, *depth = (uint16_t *)band->depth + start;
    uint32_t d = t->depth.base + (uint32_t)y * d_dy, left = (uint32_t)left_edge->x, right = (uint32_t)right_edge->x;
    uint32_t count = 0;
    for (int32_t rows = y_end - y; rows > 0; rows--) {
        const int32_t first = (int32_t)left >> 16, end = (int32_t)right >> 16;
        const int32_t from = ph_max(first, 0), n = ph_min(end, width) - from;
        if (n > 0) {
            count += (uint32_t)n;
            ph_span_flat(pixels + from, depth + from, (uint32_t)n, d + (uint32_t)from * gd, gd, t->colour);
        }
        left += (uint32_t)left_edge->dx;
        right += (uint32_t)right_edge->dx;
        d += d_dy;
        pixels += width;
        depth += width;
    }
    return count;
}

/* Draws both halves of a triangle, as far as they lie in the band. */
static uint32_t walk(const struct ph_triangle *t, const struct ph_band *band)
{
    const bool flat =
        t->block == PH_BLOCK_NONE && !band->depth24 && t->kind == PH_KIND_FLAT; /* else draw_row decides */
    uint32_t count = 0;
    for (int half = 0; half < 2; half++) {
        int32_t y, y_end;
        struct ph_edge left, right;
        if (ph_half_rows(t, band, half, &y, &y_end, &left, &right)) {
            count +=
                flat ? walk_flat_rows(t, band, y, y_end, &left, &right) : walk_rows(t, band, y, y_end, left, right);
        }
    }
    return count;
}

/* Column 0 of the row in which a small triangle goes on. */
struct place {
    uint16_t *depth, *pixels;
    uint32_t stride; /* pixels */
    bool wide;       /* rows may leave the picture, or have more than PH_SMALL_COLUMNS pixels */
};

/* The columns between two edges, cut to the picture. */
static inline uint32_t from_column(uint32_t left)
{
    return (uint32_t)ph_max((int32_t)left >> 16, 0);
}

static inline uint32_t to_column(uint32_t right, uint32_t width)
{
    return (uint32_t)ph_min((int32_t)right >> 16, (int32_t)width);
}

/* Steps n rows down. At most all of the upper rows are passed; then the lower edge takes over. */
static void step_rows(struct ph_small_triangle *r, uint32_t n)
{
    r->left += n * r->left_dx;
    r->right += n * r->right_dx;
    r->d += n * r->d_dy;
    r->light += n * r->light_dy;
    r->upper_rows = (uint16_t)(r->upper_rows - n);
    if (r->upper_rows == 0 && r->lower_rows > 0) {
        ph_small_lower(r);
    }
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
        const uint32_t from = from_column(left), to = to_column(right, width), first = d + from * r->gd;
        if ((int32_t)(to - from) > 0 && !ph_octave_holds(octave, first, first + (to - from - 1) * r->gd)) {
            break;
        }
        left += r->left_dx;
        right += r->right_dx;
        d += r->d_dy;
    }
    return n;
}

/* Draws the upper rows of r, textured if there are texels. */
static uint32_t draw_upper_rows(const struct ph_small_triangle *r, const struct place *at,
                                struct ph_small_texels *texels)
{
    return texels != NULL ? ph_small_texels_draw(texels, r, at->depth, at->pixels)
           : at->wide     ? ph_wide_gouraud(r, at->depth, at->pixels, 2 * at->stride)
                          : ph_small_gouraud(r, at->depth, at->pixels, 2 * at->stride);
}

/* Draws rows of one octave. The steps of d are multiples of 8, so the shift to codes loses no bit of them. */
static uint32_t draw_rows_in_octave(struct ph_small_triangle *r, const struct ph_octave *octave, uint32_t rows,
                                    const struct place *at, struct ph_small_texels *texels)
{
    const uint32_t from = from_column(r->left), d = r->d, gd = r->gd, d_dy = r->d_dy;
    const uint32_t above =
        d + from * gd - octave->bottom; /* the first row's d lies in the octave, unless it is empty */
    const uint16_t upper_rows = r->upper_rows, lower_rows = r->lower_rows;
    r->gd = octave->slope;
    r->d_dy = ph_depth_float16_slope(d_dy, octave->up);
    r->d = ph_depth_float16_value(octave->bottom, octave->up) + octave->offset +
           ph_depth_float16_slope(above, octave->up) - from * r->gd;
    r->upper_rows = (uint16_t)rows;
    r->lower_rows = 0;
    const uint32_t count = draw_upper_rows(r, at, texels);
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
                                const struct ph_octave *first, struct ph_octave *next, const struct place *at,
                                struct ph_small_texels *texels)
{
    const uint32_t from = from_column(r->left), to = to_column(r->right, at->stride);
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
            ph_small_texels_piece(texels, &piece, at->depth, at->pixels);
        } else {
            ph_span_gouraud(&at->pixels[x], &at->depth[x], n, code, octave->slope, r->light + x * r->glight, r->glight,
                            r->ramp);
        }
    }
    return to - from;
}

/* Draws the rows of a triangle that crosses octaves. Most of its rows do not. */
static uint32_t draw_rows_split(const struct ph_triangle *t, struct ph_small_triangle *r, struct place at,
                                struct ph_small_texels *texels)
{
    struct ph_octave octave = {0}, next = {0}; /* none yet */
    uint32_t count = 0;
    while (r->upper_rows > 0) {
        const uint32_t from = from_column(r->left), d = r->d + from * r->gd;
        const bool is_empty = (int32_t)(to_column(r->right, at.stride) - from) <= 0; /* d may have wrapped there */
        if (!is_empty && !ph_octave_holds(&octave, d, d)) {
            ph_octave_of(&octave, t, d, r->gd);
        }
        uint32_t n = is_empty ? 1 : rows_in_octave(r, &octave, at.stride);
        if (n == 0) {
            n = 1;
            count += draw_row_across(t, r, &octave, &next, &at, texels);
        } else if (!is_empty || texels != NULL) { /* texels are stepped over an empty row, too */
            count += draw_rows_in_octave(r, &octave, n, &at, texels);
        }
        step_rows(r, n);
        at.depth += n * at.stride;
        at.pixels += n * at.stride;
    }
    return count;
}

/* Draws so many rows of a Gouraud triangle that is not small; r stands at the first of them. */
static uint32_t draw_wide_rows(const struct ph_triangle *t, struct ph_small_triangle *r, struct place at, uint32_t rows)
{
    uint32_t count = 0;
    while (rows > 0) {
        const uint32_t n = rows < PH_WIDE_ROWS ? rows : PH_WIDE_ROWS;
        r->upper_rows = (uint16_t)n;
        if (t->block == PH_BLOCK_NONE) {
            count += ph_wide_gouraud(r, at.depth, at.pixels, 2 * at.stride);
            step_rows(r, n);
        } else {
            count += draw_rows_split(t, r, at, NULL);
        }
        at.depth += n * at.stride;
        at.pixels += n * at.stride;
        rows -= n;
    }
    return count;
}

/* Draws a Gouraud triangle that is not small, with depth of 16 bits. */
static uint32_t draw_wide(const struct ph_triangle *t, const struct ph_band *band)
{
    const struct ph_plane *const depth = &t->depth, *const light = &t->attribute[0];
    struct ph_small_triangle r;
    uint32_t count = 0;
    r.lower_rows = 0;
    r.ramp = t->material->ramp;
    r.gd = depth->gx;
    r.d_dy = depth->gy;
    r.glight = light->gx;
    r.light_dy = light->gy;
    for (int half = 0; half < 2; half++) {
        int32_t y, y_end;
        struct ph_edge left, right;
        if (ph_half_rows(t, band, half, &y, &y_end, &left, &right)) {
            const uint32_t width = (uint32_t)band->width, start = (uint32_t)(y - band->y0) * width;
            r.left = (uint32_t)left.x;
            r.left_dx = (uint32_t)left.dx;
            r.right = (uint32_t)right.x;
            r.right_dx = (uint32_t)right.dx;
            r.d = depth->base + (uint32_t)y * depth->gy;
            r.light = light->base + (uint32_t)y * light->gy;
            const struct place at = {(uint16_t *)band->depth + start, band->pixels + start, width, true};
            count += draw_wide_rows(t, &r, at, (uint32_t)(y_end - y));
        }
    }
    return count;
}

/* Draws a triangle without texture that is not small. */
static uint32_t draw_plain(const struct ph_triangle *t, const struct ph_band *band)
{
    return t->kind == PH_KIND_GOURAUD && t->block != PH_BLOCK_LINEAR && !band->depth24 ? draw_wide(t, band)
                                                                                       : walk(t, band);
}

/* Draws a run of a triangle whose depth takes 64 bits. */
static uint32_t draw_exact_run(const struct ph_triangle *run, const struct ph_band *band)
{
    return run->kind == PH_KIND_TEXTURE   ? ph_draw_textured(run, band)
           : run->kind == PH_KIND_COLOURS ? ph_draw_colours(run, band)
                                          : draw_plain(run, band);
}

/* Draws the rows of a strip one by one. */
static uint32_t draw_exact_rows(const struct ph_triangle *t, const struct ph_band *band, const struct ph_band *rows,
                                struct ph_triangle *run)
{
    int32_t y, y_end;
    struct ph_edge left, right;
    uint32_t count = 0;
    const struct ph_band in_band = {
        NULL, NULL, false, rows->y0 > band->y0 ? rows->y0 : band->y0, rows->y1 < band->y1 ? rows->y1 : band->y1, 0};
    if (!ph_half_rows(t, &in_band, rows->y0 >= t->y_mid, &y, &y_end, &left, &right)) {
        return 0;
    }
    for (; y < y_end; y++) {
        const int32_t right_column = right.x >> 16, to = right_column > band->width ? band->width : right_column;
        for (int32_t x = left.x < 0 ? 0 : left.x >> 16; x < to;) {
            x += ph_exact_run(t, x, to, y, run);
            count += draw_exact_run(run, band);
        }
        left.x = (int32_t)((uint32_t)left.x + (uint32_t)left.dx);
        right.x = (int32_t)((uint32_t)right.x + (uint32_t)right.dx);
    }
    return count;
}

/* Draws a triangle whose depth takes 64 bits, strip by strip. Where strips begin does not depend on the band. */
static NOINLINE uint32_t draw_exact(const struct ph_triangle *t, const struct ph_band *band)
{
    struct ph_triangle run = *t;
    run.shades = t->depth; /* see triangle.h */
    struct ph_band rows = {NULL, NULL, false, band->y0 & ~(PH_EXACT_ROWS - 1), 0, 0};
    uint32_t count = 0;
    for (rows.y0 = rows.y0 > t->y_top ? rows.y0 : t->y_top; rows.y0 < t->y_bottom && rows.y0 < band->y1;
         rows.y0 = rows.y1) {
        const int32_t half_end = rows.y0 < t->y_mid ? t->y_mid : t->y_bottom, end = (rows.y0 | (PH_EXACT_ROWS - 1)) + 1;
        struct ph_exact_strip strip = {.width = band->width};
        rows.y1 = end < half_end ? end : half_end;
        ph_half_rows(t, &rows, rows.y0 >= t->y_mid, &strip.y, &strip.y_end, &strip.left, &strip.right);
        count += ph_exact_rows(t, &strip, &run) ? draw_exact_run(&run, band) : draw_exact_rows(t, band, &rows, &run);
    }
    return count;
}

/* Steps n rows down, through both halves, which have so many rows. */
static inline void skip_rows_of(struct ph_small_triangle *r, uint32_t n, uint32_t upper_rows, uint32_t lower_rows)
{
    const uint32_t left = r->left + n * r->left_dx, right = r->right + n * r->right_dx;
    r->d += n * r->d_dy;
    r->light += n * r->light_dy;
    r->left = left;
    r->right = right;
    if (n < upper_rows) {
        r->upper_rows = (uint16_t)(upper_rows - n);
        r->lower_rows = (uint16_t)lower_rows;
        return;
    }
    const uint32_t below = n - upper_rows, dx = (uint32_t)r->lower.dx, x = (uint32_t)r->lower.x + below * dx;
    if (r->lower_is_right) {
        r->right = x;
        r->right_dx = dx;
    } else {
        r->left = x;
        r->left_dx = dx;
    }
    r->upper_rows = (uint16_t)(lower_rows - below);
    r->lower_rows = 0;
}

static FX_APART void skip_rows(struct ph_small_triangle *r, uint32_t n)
{
    skip_rows_of(r, n, r->upper_rows, r->lower_rows);
}

/* Cuts a triangle down to its rows in the band. Returns the place of the first of them. */
static FX_APART struct place cut_rows(const struct ph_triangle *t, const struct ph_band *band,
                                      struct ph_small_triangle *r)
{
    int32_t y = t->y_top - band->y0;
    if (y < 0) {
        skip_rows(r, 0u - (uint32_t)y);
        y = 0;
    }
    const uint32_t rows = (uint32_t)(band->y1 - band->y0 - y), upper_rows = r->upper_rows;
    if (upper_rows >= rows) {
        r->upper_rows = (uint16_t)rows;
        r->lower_rows = 0;
    } else if (r->lower_rows > rows - upper_rows) {
        r->lower_rows = (uint16_t)(rows - upper_rows);
    }
    const uint32_t start = (uint32_t)y * (uint32_t)band->width;
    return (struct place){(uint16_t *)band->depth + start, band->pixels + start, (uint32_t)band->width, false};
}

/* Draws the rows of a small triangle that are left. */
static inline uint32_t draw_left(const struct ph_triangle *t, const struct ph_small_triangle *r, const struct place *at)
{
    return t->kind == PH_KIND_SMALL ? ph_small_gouraud(r, at->depth, at->pixels, 2 * at->stride)
                                    : ph_small_knee(r, at->depth, at->pixels, 2 * at->stride);
}

/* Draws a small triangle that the band cuts, or that has a knee. */
static NOINLINE uint32_t draw_cut(const struct ph_triangle *t, const struct ph_band *band)
{
    struct ph_small_triangle r = t->small;
    const struct place at = cut_rows(t, band, &r);
    return draw_left(t, &r, &at);
}

/* Draws a small triangle that crosses octaves. */
static NOINLINE uint32_t draw_split(const struct ph_triangle *t, const struct ph_band *band)
{
    struct ph_small_triangle r = t->small;
    const struct place at = cut_rows(t, band, &r);
    return draw_rows_split(t, &r, at, NULL);
}

/* Draws a small textured triangle that crosses octaves, or that is not usual. */
static NOINLINE uint32_t draw_small_texture(const struct ph_triangle *t, const struct ph_band *band)
{
    struct ph_small_triangle r = t->small;
    const struct place at = cut_rows(t, band, &r);
    struct ph_small_texels texels;
    ph_small_texels_begin(&texels, t, t->y_top > band->y0 ? t->y_top : band->y0, 2 * at.stride);
    if (t->block != PH_BLOCK_NONE) {
        return draw_rows_split(t, &r, at, &texels);
    }
    return ph_small_texels_draw(&texels, &r, at.depth, at.pixels);
}

/* Draws a small triangle. Only the borders of the band can cut it. */
static inline uint32_t draw_small(const struct ph_triangle *t, const struct ph_band *band)
{
    if (t->block != PH_BLOCK_NONE) {
        return draw_split(t, band);
    }
    if (t->y_top < band->y0 || t->y_bottom > band->y1) {
        return draw_cut(t, band);
    }
    const uint32_t width = (uint32_t)band->width, start = (uint32_t)(t->y_top - band->y0) * width;
    return ph_small_gouraud(&t->small, (uint16_t *)band->depth + start, band->pixels + start, 2 * width);
}

uint32_t ph_draw_triangle(const struct ph_triangle *t, const struct ph_band *band)
{
    if (t->kind == PH_KIND_SMALL) {
        return draw_small(t, band);
    }
    if (t->kind == PH_KIND_SMALL_KNEE) {
        return draw_cut(t, band);
    }
    if (t->kind == PH_KIND_SMALL_TEXTURE) {
        return t->block == PH_BLOCK_NONE && ph_texels_are_usual(t) ? ph_draw_small_texels(t, band)
                                                                   : draw_small_texture(t, band);
    }
    if (t->kind >= PH_KIND_LINE) {
        return ph_draw_line_rows(t, band);
    }
    if (t->block == PH_BLOCK_EXACT) {
        return draw_exact(t, band);
    }
    if (t->kind == PH_KIND_TEXTURE) {
        return ph_draw_textured(t, band);
    }
    if (t->kind == PH_KIND_COLOURS) {
        return ph_draw_colours(t, band);
    }
    return draw_plain(t, band);
}

NOINLINE void ph_draw_pixel(const struct ph_triangle *t, int32_t x, int32_t y, const struct ph_band *band)
{
    struct ph_triangle pixel = *t;
    pixel.y_top = (int16_t)y;
    pixel.y_mid = pixel.y_bottom = (int16_t)(y + 1);
    pixel.long_left = 1;
    pixel.long_edge = (struct ph_edge){x * 65536, 0};
    pixel.upper = (struct ph_edge){(x + 1) * 65536, 0};
    if (t->block == PH_BLOCK_EXACT) {
        ph_exact_run(t, x, x + 1, y, &pixel);
    }
    walk(&pixel, band);
}

/* Whether a triangle is small and has a plane of codes, with or without a knee. */
static inline bool can_step(const struct ph_triangle *t)
{
    return t->kind == PH_KIND_SMALL_KNEE || (t->kind == PH_KIND_SMALL && t->block == PH_BLOCK_NONE);
}

/* Steps a small triangle or a line down to row y1, where the next band begins; y_bottom is below y1. A triangle that
 * crosses octaves stays as it is, since its depth is rounded at its first row. */
void ph_step_below(struct ph_triangle *t, int32_t y1)
{
    if (t->kind >= PH_KIND_LINE) {
        ph_line_step_below(t, y1);
        return;
    }
    if (can_step(t)) {
        skip_rows(&t->small, (uint32_t)(y1 - t->y_top));
        t->y_top = (int16_t)y1;
    }
}

uint32_t ph_draw_above(struct ph_triangle *t, const struct ph_band *band)
{
    if (!can_step(t) || t->y_top < band->y0) {
        const uint32_t count = ph_draw_triangle(t, band);
        ph_step_below(t, band->y1);
        return count;
    }
    struct ph_small_triangle *const small = &t->small;
    const uint32_t rows = (uint32_t)(band->y1 - t->y_top), upper_rows = small->upper_rows,
                   width = (uint32_t)band->width;
    const uint32_t lower_rows = small->lower_rows, start = (uint32_t)(t->y_top - band->y0) * width;
    const struct place at = {(uint16_t *)band->depth + start, band->pixels + start, width, false};
    const bool in_upper = rows <= upper_rows;
    small->upper_rows = (uint16_t)(in_upper ? rows : upper_rows);
    small->lower_rows = (uint16_t)(in_upper ? 0 : rows - upper_rows);
    const uint32_t count = draw_left(t, small, &at);
    skip_rows_of(small, rows, upper_rows, lower_rows);
    t->y_top = (int16_t)band->y1;
    return count;
}
