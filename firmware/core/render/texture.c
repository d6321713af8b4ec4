/*
 * Textured triangles, perspective-correct, in tiles of up to 64 x 16 pixels.
 *
 * At the four corners of a tile u and v are divided exactly. Between them they follow a surface that is a parabola
 * along each row and each column and is exact in the middle of each side, too: if 1/w goes from w0 to w1 along a side,
 * and u changes by U, then u in its middle lies U (w1 - w0) / (2 (w0 + w1)) beside the straight line. So a pixel and a
 * row cost a few additions. Where 1/w changes much, tiles are smaller. They are not placed by the band,
 * so the picture does not depend on where bands begin. Measured error: tests/core/test_quality.c, test_texture.c.
 *
 * A triangle is cut into strips, rows in which all tiles have one height, a power of two. A strip begins at a row that
 * is a multiple of its height, so bands of a multiple of 16 lines cut no tile. A strip is cut into tiles from left to
 * right: tile_surface.h divides, tile_depth.h and texel_rows.h draw its rows.
 */
/* Kits on armv6m: -O2. */
#include "texture.h"

#include "edge.h"
#include "planes.h"
#include "texel_map.h"
#include "tile_depth.h"

enum { WIDTH_LOG2 = 6, HEIGHT_LOG2 = 4 };

_Static_assert(1 << WIDTH_LOG2 == PH_TILE, "texture_tile.h");

/* Rows of a triangle whose tiles have one height. */
struct strip {
    uint32_t y, y_end;
    int height_log2;
    int32_t x, x_end; /* the columns in which there are pixels; none if x >= x_end */
    uint32_t least_w; /* 1/w at its pixels */
};

static inline bool are_inside(const struct ph_corners *c, uint32_t margin, uint32_t span)
{
    return (uint32_t)c->left[0] - margin < span && (uint32_t)c->left[1] - margin < span &&
           (uint32_t)c->right[0] - margin < span && (uint32_t)c->right[1] - margin < span;
}

/* The ways in which some of a tile may lie outside of a clamped texture's only repeat, or in a margin, which is half a
 * texel wider for a filter. */
PH_TIER(scenery)
static unsigned ways_outside(const struct ph_triangle *t, const struct ph_texture *map, const struct ph_surface *s)
{
    const int least = ph_min(map->log2_width, map->log2_height);
    const uint32_t half = map->filter != NULL ? ((uint32_t)1 << 24) >> least : 0, one = (uint32_t)1 << 25;
    const unsigned range = t->as.large.of.map.range_log2;
    const uint32_t margin = (1 << 15) + (half >> range), span = (one >> range) - 2 * margin;
    unsigned clamp = map->wrap;
    if (span < one) {
        clamp &= are_inside(&s->u, margin, span) ? PH_WRAP_CLAMP_V : PH_WRAP_CLAMP;
        clamp &= are_inside(&s->v, margin, span) ? PH_WRAP_CLAMP_U : PH_WRAP_CLAMP;
    }
    return clamp;
}

/*
 * Chooses how a tile is drawn. For ph_texture_tile u and v are in its units: they wrap, and so the texture repeats. In
 * a clamped texture they must not wrap, or a point outside would seem to be inside: its texels must fit in beside the
 * sign, with room for as many again. For draw_other u and v are in 2^-29 of their range.
 */
PH_TIER(scenery)
static inline void set_texels(struct ph_tile_kind *k, const struct ph_tile *tile, const struct ph_surface *s,
                              const struct ph_texture *map, struct ph_tile_rows *r)
{
    const struct ph_triangle *const t = k->triangle;
    const int width = map->log2_width, height = map->log2_height, range = t->as.large.of.map.range_log2;
    k->from = -(int32_t)tile->x;
    k->clamp = map->wrap == PH_WRAP_REPEAT ? 0 : (uint8_t)ways_outside(t, map, s); /* most textures repeat */
    k->fast = !k->depth24 && t->block != PH_BLOCK_LINEAR && (k->clamp == 0 || ph_fits_clamped(map, range));
    k->u_down = 29 - range - width;
    k->v_down = 29 - range - height;
    ph_set_texel_kind(k, r, map, &t->as.large.of.map.light);
    ph_surface_way(&r->u, &s->u, s, tile, k->u_down + range + width - 25);
    ph_surface_way(&r->v, &s->v, s, tile, k->v_down + range + height - 25);
}

/* Draws the rows of the upper or the lower half that are in the band; r stands at the first of them. */
PH_TIER(scenery)
static void draw_half(const struct ph_tile_kind *k, const struct ph_band *rows, int half, const struct ph_tile *tile,
                      struct ph_tile_rows *r)
{
    const struct ph_triangle *const t = k->triangle;
    const struct ph_plane *const plane = &t->as.large.depth.as.plane;
    struct ph_half_rows in;
    struct ph_tile_depth depth;
    if (!ph_rows_of_half(t, rows, half, &in)) {
        return;
    }
    const uint32_t row = (uint32_t)in.y - tile->y;
    r->row.left = (uint32_t)in.left.x - (tile->x << 16);
    r->row.left_dx = (uint32_t)in.left.dx;
    r->row.right = (uint32_t)in.right.x - (tile->x << 16);
    r->row.right_dx = (uint32_t)in.right.dx;
    r->row.rows = (uint32_t)(in.y_end - in.y);
    if (k->fast && t->block == PH_BLOCK_NONE) {
        ph_draw_fast_rows(k, r);
    } else if (k->fast && ((plane->base | plane->gx | plane->gy) & 7) == 0 && ph_tile_octaves(t, tile, &depth)) {
        ph_draw_rows_in_octaves(k, r, &depth, row);
    } else {
        ph_draw_rows_in_pieces(k, r);
    }
}

/* Sets the light of rows, at column x and row y. */
static inline void set_light(struct ph_tile_rows *r, const struct ph_map *map, uint32_t x, uint32_t y)
{
    const bool shaded = map->light.shaded;
    r->row.light = shaded ? ph_plane_at(&map->shades, x, y) : (uint32_t)map->light.light << 24;
    r->row.glight = shaded ? map->shades.gx : 0;
    r->row.light_dy = shaded ? map->shades.gy : 0;
}

/* Draws the rows of a tile that are in the band. */
PH_TIER(scenery)
static uint32_t draw_tile(const struct ph_triangle *t, const struct ph_band *band, const struct ph_tile *tile,
                          const struct ph_surface *s)
{
    const int32_t y = (int32_t)tile->y, y1 = y + (1 << tile->height_log2);
    const int32_t top = y > t->y_top ? y : t->y_top;
    const struct ph_band rows = {.y0 = ph_max(top, band->y0), .y1 = ph_min(y1, band->y1)};
    const uint32_t stride = band->stride, left = (uint32_t)band->width - tile->x, columns = 1u << tile->width_log2;
    const uint32_t at = (uint32_t)(rows.y0 - band->y0) * stride + tile->x;
    const struct ph_plane *const depth = &t->as.large.depth.as.plane;
    const struct ph_texture *texture = t->material->texture;
    const struct ph_levels *const levels = ph_levels_of(texture);
    struct ph_texture map;
    struct ph_tile_kind k;
    struct ph_tile_rows r;
    r.row.depth = ph_depth_from(band->depth, at, band->depth24);
    r.row.pixels = band->pixels + at;
    r.row.stride_bytes = 2 * stride;
    r.row.light = r.row.glight = r.row.light_dy = 0;
    k.triangle = t;
    k.depth24 = band->depth24;
    k.end = (int32_t)left;
    r.columns = left < columns ? left : columns;
    r.count = 0;
    r.row.d = ph_plane_at(depth, tile->x, (uint32_t)rows.y0);
    r.row.gd = depth->gx;
    r.row.d_dy = depth->gy;
    if (levels != NULL) {
        map = levels->map_of(texture, levels->level_of_tile(t, tile, s));
        texture = &map;
    }
    set_texels(&k, tile, s, texture, &r);
    if (k.lighting != NULL) {
        set_light(&r, &t->as.large.of.map, tile->x, (uint32_t)rows.y0);
    }
    for (int32_t skipped = y; skipped < rows.y0; skipped++) {
        ph_texel_way_down(&r.u);
        ph_texel_way_down(&r.v);
    }
    if (rows.y0 < t->as.large.y_mid) {
        draw_half(&k, &rows, 0, tile, &r);
    }
    if (rows.y1 > t->as.large.y_mid) {
        draw_half(&k, &rows, 1, tile, &r);
    }
    return r.count;
}

/* Whether slopes are gentle along a side of 2^log2 pixels: 1/w changes by 3/16 at most, u and v by 2 of their range. */
PH_TIER(scenery) static bool is_gentle(uint32_t gu, uint32_t gv, uint32_t gw, uint32_t least_w, int log2)
{
    return least_w < (uint32_t)1 << 30 && fx_magnitude((int32_t)gw) <= ((least_w >> 3) + (least_w >> 4)) >> log2 &&
           (fx_magnitude((int32_t)gu) | fx_magnitude((int32_t)gv)) <= (least_w >> 1) >> log2;
}

/* The widest tile at x, y that is gentle. */
PH_TIER(scenery) static int tile_width(const struct ph_triangle *t, const struct ph_tile *tile, uint32_t columns)
{
    const struct ph_plane *const w = ph_over_w(t);
    const struct ph_map *const map = &t->as.large.of.map;
    int log2 = WIDTH_LOG2;
    while (log2 > 0 && (columns - 1) >> (log2 - 1) == 0) {
        log2--;
    }
    if (log2 == 0) {
        return 0;
    }
    uint32_t least = ph_plane_at(w, tile->x, tile->y);
    const uint32_t below = w->gy << tile->height_log2;
    least += (int32_t)below < 0 ? below : 0;
    for (; log2 > 0; log2--) {
        const uint32_t right = w->gx << log2, corner = (int32_t)right < 0 ? least + right : least;
        if (is_gentle(map->u.gx, map->v.gx, w->gx, corner, log2)) {
            break;
        }
    }
    return log2;
}

/* Finds columns and least 1/w of the rows of a strip. */
PH_TIER(scenery) static void measure_strip(const struct ph_triangle *t, int32_t width, struct strip *strip)
{
    const struct ph_band rows = {.y0 = (int32_t)strip->y, .y1 = (int32_t)strip->y_end};
    strip->x = width;
    strip->x_end = 0;
    strip->least_w = UINT32_MAX;
    for (int half = 0; half < 2; half++) {
        struct ph_half_rows in;
        if (!ph_rows_of_half(t, &rows, half, &in)) {
            continue;
        }
        for (;;) { /* the first row, and the last */
            const int32_t from = (int32_t)ph_from_column((uint32_t)in.left.x);
            const int32_t to = (int32_t)ph_to_column((uint32_t)in.right.x, (uint32_t)width);
            strip->x = from < strip->x ? from : strip->x;
            strip->x_end = to > strip->x_end ? to : strip->x_end;
            if (from < to) {
                const uint32_t w0 = ph_plane_at(ph_over_w(t), (uint32_t)from, (uint32_t)in.y);
                const uint32_t w1 = ph_plane_at(ph_over_w(t), (uint32_t)to - 1, (uint32_t)in.y);
                strip->least_w = w0 < strip->least_w ? w0 : strip->least_w;
                strip->least_w = w1 < strip->least_w ? w1 : strip->least_w;
            }
            const int32_t more = in.y_end - 1 - in.y;
            if (more == 0) {
                break;
            }
            ph_edge_step(&in.left, more);
            ph_edge_step(&in.right, more);
            in.y = in.y_end - 1;
        }
    }
}

/* The highest strip from row y of the triangle on that is gentle. */
PH_TIER(scenery) static void choose_strip(const struct ph_triangle *t, int32_t width, uint32_t y, struct strip *strip)
{
    const struct ph_map *const map = &t->as.large.of.map;
    strip->height_log2 = HEIGHT_LOG2;
    while (strip->height_log2 > 0 && (y ^ ((uint32_t)t->y_bottom - 1)) >> (strip->height_log2 - 1) == 0) {
        strip->height_log2--;
    }
    for (;; strip->height_log2--) {
        const uint32_t height = 1u << strip->height_log2;
        strip->y = y & (0u - height);
        strip->y_end = strip->y + height;
        measure_strip(t, width, strip);
        if (strip->height_log2 == 0 || strip->x >= strip->x_end ||
            is_gentle(map->u.gy, map->v.gy, ph_over_w(t)->gy, strip->least_w, strip->height_log2)) {
            return;
        }
    }
}

PH_TIER(scenery)
static uint32_t draw_strip(const struct ph_triangle *t, const struct ph_band *band, const struct strip *strip)
{
    struct ph_surface surface;
    struct ph_tile tile = {(uint32_t)strip->x, strip->y, 0, strip->height_log2};
    uint32_t count = 0;
    if (strip->x < strip->x_end) {
        ph_surface_begin(t, &tile, &surface);
    }
    for (; (int32_t)tile.x < strip->x_end; tile.x += 1u << tile.width_log2) {
        tile.width_log2 = tile_width(t, &tile, (uint32_t)strip->x_end - tile.x);
        ph_surface_next(t, &tile, &surface);
        count += draw_tile(t, band, &tile, &surface);
    }
    return count;
}

PH_TIER(scenery) uint32_t ph_draw_textured(const struct ph_triangle *t, const struct ph_band *band)
{
    const uint32_t top = (uint32_t)t->y_top, above = (uint32_t)band->y0 & (0u - (1u << HEIGHT_LOG2));
    uint32_t count = 0;
    struct strip strip;
    for (uint32_t y = top > above ? top : above; y < (uint32_t)t->y_bottom && y < (uint32_t)band->y1; y = strip.y_end) {
        choose_strip(t, band->width, y, &strip);
        if (strip.y_end > (uint32_t)band->y0) {
            count += draw_strip(t, band, &strip);
        }
    }
    return count;
}
