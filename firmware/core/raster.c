/*
 * Bands: clear, walk the triangles down their edges, draw their spans. See pipeline.h.
 *
 * Everything at a pixel is a function of the triangle and the pixel alone (planes are exact modulo 2^32), so the
 * picture does not depend on where a band begins.
 */
#include "hot.h"
#include "pipeline.h"
#include "span.h"

#define NOINLINE __attribute__((noinline)) /* keeps what is rare from the registers of what is usual */

/* One row of a triangle: columns from .. from + n - 1, pixels and depths of its first one. */
struct row {
    uint16_t *pixels;
    void *depth;        /* see struct ph_band */
    uint32_t n, d;      /* d: depth at the first pixel, in units of the plane */
    uint32_t attribute; /* Gouraud: light at the first pixel */
};

/* A run of pixels whose depth codes are linear. */
static inline void draw_run(const struct ph_triangle *t, bool wide, const struct row *row, uint32_t gd)
{
    const bool gouraud = t->kind == PH_KIND_GOURAUD, linear = t->block == PH_BLOCK_LINEAR;
    const uint32_t light = row->attribute, glight = t->attribute[0].gx;
    const uint16_t *const ramp = t->material->ramp;
    if (wide && gouraud) {
        ph_span_gouraud24(row->pixels, row->depth, row->n, row->d, gd, light, glight, ramp);
    } else if (wide) {
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

/* A span that may be of several runs. */
static void draw_span(const struct ph_triangle *t, bool wide, struct row row)
{
    uint32_t left = row.n, d = row.d;
    while (left > 0) { /* each turn draws at least one pixel */
        row.n = left;
        const struct ph_piece piece = ph_depth_piece(t, d, &row.n);
        row.d = piece.d;
        draw_run(t, wide, &row, piece.gd);
        row.pixels += row.n;
        row.depth = ph_depth_from(row.depth, row.n, wide);
        row.attribute += t->attribute[0].gx * row.n;
        d += t->depth.gx * row.n;
        left -= row.n;
    }
}

/* A span, with the octave of the last one. */
static NOINLINE void draw_row(const struct ph_triangle *t, bool wide, struct ph_octave *octave, const struct row *row)
{
    const uint32_t last = row->d + t->depth.gx * (row->n - 1);
    if (!ph_octave_holds(octave, row->d, last)) {
        ph_octave_of(octave, t, row->d);
        if (!ph_octave_holds(octave, row->d, last)) {
            draw_span(t, wide, *row);
            return;
        }
    }
    struct row run = *row;
    run.d = ph_depth_float16_value(row->d, octave->octave) + octave->offset;
    draw_run(t, wide, &run, octave->slope);
}

/* Rows y .. y_end - 1 between two edges (at row y). Returns the number of pixels. */
static uint32_t walk_rows(const struct ph_triangle *t, const struct ph_band *band, int32_t y, int32_t y_end,
                          struct ph_edge left, struct ph_edge right)
{
    const uint32_t start = (uint32_t)(y - band->y0) * (uint32_t)band->width;
    uint16_t *pixels = band->pixels + start;
    void *depth = ph_depth_from(band->depth, start, band->wide);
    uint32_t d = t->depth.base + (uint32_t)y * t->depth.gy;
    uint32_t attribute = t->attribute[0].base + (uint32_t)y * t->attribute[0].gy, count = 0;
    const int kind = t->block == PH_BLOCK_NONE && !band->wide ? t->kind : -1; /* -1: the longer way */
    struct ph_octave octave = {0};
    for (; y < y_end; y++) {
        const int32_t from = left.x < 0 ? 0 : left.x >> 16;
        const int32_t right_column = right.x >> 16, to = right_column > band->width ? band->width : right_column;
        if (from < to) {
            const uint32_t x = (uint32_t)from, n = (uint32_t)(to - from), first_d = d + x * t->depth.gx;
            const uint32_t light = attribute + x * t->attribute[0].gx;
            if (kind == PH_KIND_FLAT) {
                ph_span_flat(pixels + x, (uint16_t *)depth + x, n, first_d, t->depth.gx, t->colour);
            } else if (kind == PH_KIND_GOURAUD) {
                ph_span_gouraud(pixels + x, (uint16_t *)depth + x, n, first_d, t->depth.gx, light, t->attribute[0].gx,
                                t->material->ramp);
            } else {
                const struct row row = {pixels + x, ph_depth_from(depth, x, band->wide), n, first_d, light};
                draw_row(t, band->wide, &octave, &row);
            }
            count += n;
        }
        left.x = (int32_t)((uint32_t)left.x + (uint32_t)left.dx);
        right.x = (int32_t)((uint32_t)right.x + (uint32_t)right.dx);
        pixels += band->width;
        depth = ph_depth_from(depth, (uint32_t)band->width, band->wide);
        d += t->depth.gy;
        attribute += t->attribute[0].gy;
    }
    return count;
}

static uint32_t walk(const struct ph_triangle *t, const struct ph_band *band)
{
    uint32_t count = 0;
    for (int half = 0; half < 2; half++) {
        int32_t y, y_end;
        struct ph_edge left, right;
        if (ph_half_rows(t, band, half, &y, &y_end, &left, &right)) {
            count += walk_rows(t, band, y, y_end, left, right);
        }
    }
    return count;
}

/* How many of the next rows lie in the octave; r->d, r->gd and r->d_dy in units of the triangle's plane. */
static uint32_t rows_in_octave(const struct ph_rows *r, const struct ph_octave *octave, uint32_t rows)
{
    uint32_t left = r->left, right = r->right, d = r->d, n = 0;
    for (; n < rows; n++) {
        const uint32_t from = left >> 16, to = right >> 16, first = d + from * r->gd;
        if ((int32_t)(to - from) > 0 && !ph_octave_holds(octave, first, first + (to - from - 1) * r->gd)) {
            break;
        }
        left += r->left_dx;
        right += r->right_dx;
        d += r->d_dy;
    }
    return n;
}

/* Rows of one octave; the steps of d are multiples of 8, so no bit of a shift to codes is lost. */
static void draw_rows_in_octave(struct ph_rows *r, const struct ph_octave *octave, uint32_t rows)
{
    const uint32_t from = r->left >> 16, d = r->d, gd = r->gd, d_dy = r->d_dy;
    const uint32_t above = d + from * gd - octave->bottom; /* the first row may be empty, and below the octave */
    r->gd = octave->slope;
    r->d_dy = ph_depth_float16_slope(d_dy, octave->octave);
    r->d = ph_depth_float16_value(octave->bottom, octave->octave) + octave->offset +
           ph_depth_float16_slope(above, octave->octave) - from * r->gd;
    r->rows = rows;
    ph_rows_gouraud(r);
    r->gd = gd;
    r->d_dy = d_dy;
    r->d = d + rows * d_dy;
}

/* One row that crosses octaves. */
static void draw_row_across(struct ph_rows *r, const struct ph_triangle *t)
{
    const uint32_t from = r->left >> 16, n = (r->right >> 16) - from;
    draw_span(t, false,
              (struct row){r->pixels + from, r->depth + from, n, r->d + from * r->gd, r->light + from * r->glight});
    r->count += n;
    r->left += r->left_dx;
    r->right += r->right_dx;
    r->d += r->d_dy;
    r->light += r->light_dy;
    r->depth += r->stride_bytes / 2;
    r->pixels += r->stride_bytes / 2;
}

/* Rows of a triangle that crosses octaves: most rows do not. */
static NOINLINE void draw_rows_split(struct ph_rows *r, const struct ph_triangle *t)
{
    struct ph_octave octave = {0};
    for (uint32_t rows = r->rows; rows > 0;) {
        ph_octave_of(&octave, t, r->d + (r->left >> 16) * r->gd);
        const uint32_t n = rows_in_octave(r, &octave, rows);
        if (n > 0) {
            octave.slope = ph_depth_float16_slope(r->gd, octave.octave);
            draw_rows_in_octave(r, &octave, n);
            rows -= n;
        } else {
            draw_row_across(r, t);
            rows--;
        }
    }
}

/* The rows of one half of a narrow triangle, the upper or the lower; r stands at the first of them. */
static void draw_half(struct ph_rows *r, const struct ph_triangle *t, const struct ph_edge *edge, int32_t down,
                      int32_t rows)
{
    const uint32_t x = (uint32_t)edge->x + (uint32_t)down * (uint32_t)edge->dx;
    if (t->long_left == 0) {
        r->left = x;
        r->left_dx = (uint32_t)edge->dx;
    } else {
        r->right = x;
        r->right_dx = (uint32_t)edge->dx;
    }
    r->rows = (uint32_t)rows;
    if (t->block == PH_BLOCK_NONE) {
        ph_rows_gouraud(r);
    } else {
        draw_rows_split(r, t);
    }
}

/*
 * A plane in multiples of 8, 3 bits being what codes lose of d in the nearest octave: from the triangle's first pixel
 * on, where no band begins.
 */
static NOINLINE void round_depth(struct ph_rows *r, const struct ph_triangle *t, uint32_t down)
{
    const uint32_t x = (uint32_t)t->long_edge.x >> 16;
    const uint32_t d = ph_plane_at(&t->depth, x, (uint32_t)t->y_top);
    r->gd = (r->gd + 4) & ~(uint32_t)7;
    r->d_dy = (r->d_dy + 4) & ~(uint32_t)7;
    r->d = ((d + 4) & ~(uint32_t)7) - x * r->gd + down * r->d_dy;
}

/* A narrow triangle, which no border but those of the band cuts. */
static uint32_t draw_gouraud_narrow(const struct ph_triangle *t, const struct ph_band *band)
{
    const int32_t y0 = t->y_top > band->y0 ? t->y_top : band->y0, y1 = t->y_bottom < band->y1 ? t->y_bottom : band->y1;
    const int32_t y_mid = t->y_mid < y1 ? t->y_mid : y1;
    const uint32_t start = (uint32_t)(y0 - band->y0) * (uint32_t)band->width, y = (uint32_t)y0;
    const uint32_t long_x = (uint32_t)t->long_edge.x + (uint32_t)(y0 - t->y_top) * (uint32_t)t->long_edge.dx;
    const uint32_t long_dx = (uint32_t)t->long_edge.dx;
    struct ph_rows r;
    r.left = r.right = long_x;
    r.left_dx = r.right_dx = long_dx;
    r.d = t->depth.base + y * t->depth.gy;
    r.light = t->attribute[0].base + y * t->attribute[0].gy;
    r.d_dy = t->depth.gy;
    r.light_dy = t->attribute[0].gy;
    r.gd = t->depth.gx;
    r.glight = t->attribute[0].gx;
    r.depth = (uint16_t *)band->depth + start;
    r.stride_bytes = 2 * (uint32_t)band->width;
    r.pixels = band->pixels + start;
    r.ramp = t->material->ramp;
    r.count = 0;
    if (t->block != PH_BLOCK_NONE) {
        round_depth(&r, t, (uint32_t)(y0 - t->y_top));
    }
    if (y_mid > y0) {
        draw_half(&r, t, &t->upper, y0 - t->y_top, y_mid - y0);
    }
    const int32_t y_low = y_mid > y0 ? y_mid : y0;
    if (y1 > y_low) {
        draw_half(&r, t, &t->lower, y_low - t->y_mid, y1 - y_low);
    }
    return r.count;
}

static inline uint32_t draw(const struct ph_triangle *t, const struct ph_band *band)
{
    if (t->kind == PH_KIND_TEXTURE) {
        return ph_draw_textured(t, band);
    }
    if (t->narrow && t->kind == PH_KIND_GOURAUD && t->block != PH_BLOCK_LINEAR && !band->wide) {
        return draw_gouraud_narrow(t, band);
    }
    return walk(t, band);
}

/* Takes the first triangle, in drawing order, off two lists that are both in drawing order. */
static uint32_t take_first(const struct ph_triangle *triangles, uint32_t *a, uint32_t *b)
{
    uint32_t *from = *a < *b ? a : b; /* PH_NONE is the largest */
    const uint32_t first = *from;
    *from = triangles[first].next;
    return first;
}

/* Rows of a band, cleared before they are drawn. */
static void clear(const struct ph_band *rows, uint16_t background)
{
    const uint32_t area = (uint32_t)(rows->y1 - rows->y0) * (uint32_t)rows->width;
    ph_fill(rows->pixels, background, area);
    ph_fill(rows->depth, 0, rows->wide ? 2 * area : area);
}

/* Merges, draws and sorts out in one pass. */
static void draw_alone(struct ph_renderer *r, uint32_t fresh, const struct ph_band *rows)
{
    struct ph_triangle *triangles = ph_triangles(r);
    uint32_t begun = r->carried, *carry = &r->carried;
    clear(rows, r->background);
    *carry = PH_NONE;
    while (begun != PH_NONE || fresh != PH_NONE) {
        const uint32_t i = take_first(triangles, &begun, &fresh);
        r->stats.fragments += draw(&triangles[i], rows);
        if (triangles[i].y_bottom > rows->y1) { /* goes on in the next band */
            *carry = i;
            carry = &triangles[i].next;
            *carry = PH_NONE;
        }
    }
}

/* What a core draws: some rows of a list that nobody changes meanwhile. */
struct share {
    const struct ph_triangle *triangles;
    uint32_t first;
    uint32_t fragments;
    uint16_t background;
    struct ph_band rows;
};

static void draw_share(struct share *s)
{
    s->fragments = 0;
    clear(&s->rows, s->background);
    for (uint32_t i = s->first; i != PH_NONE; i = s->triangles[i].next) {
        const struct ph_triangle *t = &s->triangles[i];
        if (t->y_top < s->rows.y1 && t->y_bottom > s->rows.y0) {
            s->fragments += draw(t, &s->rows);
        }
    }
}

static void draw_other_share(void *argument)
{
    draw_share(argument);
}

/* One list in drawing order of two. */
static uint32_t merge(struct ph_triangle *triangles, uint32_t a, uint32_t b)
{
    uint32_t first = PH_NONE, *link = &first;
    while (a != PH_NONE || b != PH_NONE) {
        const uint32_t i = take_first(triangles, &a, &b);
        *link = i;
        link = &triangles[i].next;
    }
    *link = PH_NONE;
    return first;
}

/* What of a list goes on below row y1. */
static uint32_t keep_below(struct ph_triangle *triangles, uint32_t list, int32_t y1)
{
    uint32_t first = PH_NONE, *link = &first;
    for (uint32_t i = list; i != PH_NONE; i = triangles[i].next) {
        if (triangles[i].y_bottom > y1) {
            *link = i;
            link = &triangles[i].next;
        }
    }
    *link = PH_NONE;
    return first;
}

/* Two halves of a band, of 2 rows or more. */
static void draw_with_other(struct ph_renderer *r, uint32_t fresh, const struct ph_band *rows)
{
    struct ph_triangle *triangles = ph_triangles(r);
    const uint32_t list = merge(triangles, r->carried, fresh);
    struct share upper = {triangles, list, 0, r->background, *rows}, lower = upper;
    upper.rows.y1 = lower.rows.y0 = rows->y0 + (rows->y1 - rows->y0) / 2;
    const uint32_t above = (uint32_t)(upper.rows.y1 - rows->y0) * (uint32_t)rows->width;
    lower.rows.pixels += above;
    lower.rows.depth = (uint8_t *)rows->depth + above * (rows->wide ? sizeof(uint32_t) : sizeof(uint16_t));
    const bool both = r->config.other_core(draw_other_share, &lower);
    draw_share(&upper);
    if (both) {
        r->config.other_core_join();
    } else {
        draw_share(&lower);
    }
    r->stats.fragments += upper.fragments + lower.fragments;
    r->carried = keep_below(triangles, list, rows->y1);
}

uint32_t ph_draw_band(struct ph_renderer *r, uint32_t band, uint16_t *pixels)
{
    const int32_t lines = r->config.band_height, height = r->config.height;
    const int32_t y0 = (int32_t)band * lines, y1 = y0 + lines < height ? y0 + lines : height;
    const bool wide = ph_depth_bytes(r->config.depth_format) == sizeof(uint32_t);
    struct ph_band rows = {NULL, r->config.depth, wide, y0, y1, r->config.width};
    rows.pixels = pixels; /* not above: clang-tidy would have them const */
    if (r->config.other_core != NULL && y1 - y0 >= 2) {
        draw_with_other(r, r->config.bins[band], &rows);
    } else {
        draw_alone(r, r->config.bins[band], &rows);
    }
    return (uint32_t)(y1 - y0);
}
