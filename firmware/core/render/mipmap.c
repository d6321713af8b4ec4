/* The bilinear filter in the levels of a texture. See texel_filter.h. */
/* Kits on armv6m: -O2. */
#include "bilinear.h"
#include "edge.h"
#include "texel_filter.h"
#include "texel_map.h"
#include "tile_surface.h"

/* Texels of the first level from pixel to pixel, in 2^-16, on both axes of the texture. */
struct slope {
    int32_t u, v;
};

/* The length, at most 8 % too long. */
static inline uint32_t length_of(const struct slope *s)
{
    const uint32_t u = fx_magnitude(s->u), v = fx_magnitude(s->v);
    return u > v ? u + (v >> 3) * 3 : v + (u >> 3) * 3;
}

/* The level in which a pixel's step to the right or down, whichever is longer, is nearest to one texel. */
static unsigned level_of(const struct ph_texture *texture, const struct slope *right, const struct slope *down)
{
    const uint32_t a = length_of(right), b = length_of(down), most = a > b ? a : b;
    const uint32_t turned = (most >> 1) + (most >> 3) + (most >> 4) + (most >> 6); /* over sqrt 2 */
    const int level = 17 - fx_clz32(turned | 1 << 14);
    return level < texture->levels ? (unsigned)level : texture->levels;
}

/* The change of u or v between two corners in texels of 2^-16 from pixel to pixel, the range being 2^range texels. */
static int32_t slope_of(int32_t from, int32_t to, int range, int size_log2)
{
    const int64_t change = (int64_t)to - from;
    return fx_sat64(change * ((int64_t)1 << range) >> (9 + size_log2));
}

static unsigned level_of_tile(const struct ph_triangle *t, const struct ph_tile *tile, const struct ph_surface *s)
{
    const struct ph_texture *const texture = t->material->texture;
    const int range = t->as.large.of.map.range_log2;
    const int u = range + texture->log2_width, v = range + texture->log2_height;
    const int width = tile->width_log2, height = tile->height_log2;
    const struct slope right = {slope_of(s->u.left[0], s->u.right[0], u, width),
                                slope_of(s->v.left[0], s->v.right[0], v, width)};
    const struct slope down = {slope_of(s->u.left[0], s->u.left[1], u, height),
                               slope_of(s->v.left[0], s->v.left[1], v, height)};
    return level_of(texture, &right, &down);
}

/* v 2^-down; the sign is kept. */
static inline uint32_t shifted(uint32_t v, int down)
{
    return (uint32_t)((int32_t)v >> down);
}

/* u or v and its curve, 2^-down times. */
PH_TIER(mesh) static void shrink(struct ph_plane *way, struct ph_curve *curve, int down)
{
    way->base >>= down;
    way->gx = shifted(way->gx, down);
    way->gy = shifted(way->gy, down);
    curve->xx = shifted(curve->xx, down);
    curve->xy = shifted(curve->xy, down);
    curve->yy = shifted(curve->yy, down);
}

static void set_level(struct ph_small_map *map, const struct ph_texture *texture)
{
    const int width = texture->log2_width, height = texture->log2_height, v_up = ph_texel_row_up(texture);
    const struct slope right = {(int32_t)map->u.gx >> 6, (int32_t)map->v.gx >> v_up};
    const struct slope down = {(int32_t)map->u.gy >> 6, (int32_t)map->v.gy >> v_up};
    const int level = (int)level_of(texture, &right, &down);
    if (level > 0) {
        shrink(&map->u, &map->u_curve, ph_min(level, width));
        shrink(&map->v, &map->v_curve, ph_min(level, height));
    }
    map->level = (uint8_t)level;
}

static struct ph_texture map_of(const struct ph_texture *texture, unsigned level)
{
    struct ph_texture map = *texture;
    for (; level > 0; level--) {
        map.texels += (size_t)1 << (map.log2_width + map.log2_height);
        map.log2_width = (uint8_t)(map.log2_width - (map.log2_width > 0));
        map.log2_height = (uint8_t)(map.log2_height - (map.log2_height > 0));
    }
    return map;
}

static const struct ph_levels levels = {.level_of_tile = level_of_tile, .set_level = set_level, .map_of = map_of};

const struct ph_filter ph_filter_mipmap = {.draw_row = ph_texel_row_smooth,
                                           .draw_lit_row = ph_texel_row_smooth_lit,
                                           .texel_of_row = ph_bilinear_of_row,
                                           .texel = ph_bilinear,
                                           .levels = &levels};
