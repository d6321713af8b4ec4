/* ph_draw_points of render.h: points are transformed and listed. See points.h. */
/* Kits on armv6m: -O2. */
#include "points.h"

#include "edge.h"
#include "float_depths.h"
#include "planes.h"
#include "transform.h"

_Static_assert(sizeof(struct ph_spot) == sizeof(struct ph_vertex), "a point lies where its vertex was");

#define HALF_MOST (255 * 128) /* half of the largest size, 1/256 px */

/* Half of a size in the world is size * factor * 2^-down on the screen, 1/256 px; by_distance: times N/w, in the form
 * of struct ph_quotient. */
struct scale {
    uint32_t factor;
    int down;
    bool by_distance;
};

/* What the points of a call have in common. */
struct listing {
    struct ph_renderer *r;
    const struct ph_points *points;
    struct ph_cloud *cloud;
    const struct ph_material *material;
    uint32_t before;               /* number of the first point */
    struct scale scale;            /* of sizes in the world */
    bool is_fixed16;               /* the depth format */
    const struct ph_lens *float16; /* of this format; or NULL */
    uint32_t fast_bias;            /* what is added to the codes of both, see struct ph_fast */
};

/* A point: its vertex until it is listed. */
union point {
    struct ph_vertex vertex;
    struct ph_spot spot;
};

static inline union point *point_at(const struct listing *l, uint32_t number)
{
    return (union point *)(void *)l->cloud + number;
}

/* ---- size ------------------------------------------------------------------------------------------------------- */

static struct scale scale_of(const struct ph_lens *lens)
{
    const bool fisheye = lens->kind == PH_FISHEYE;
    const uint32_t focal = (uint32_t)(fisheye ? lens->radian_px : lens->focal_y); /* times 2^(log2 - 30): px */
    const int log2 = fisheye ? 14 : lens->focal_log2;
    if (lens->kind == PH_ORTHOGRAPHIC) {
        return (struct scale){focal, 39 - log2, false};
    }
    int shift;
    const uint32_t over_near = fx_rcp_far(lens->depth_scale, &shift); /* 1 / N */
    return (struct scale){fx_mulhi_u32(focal, over_near), 51 - log2 - lens->near_shift - shift, true};
}

/* Half of a size on the screen, 1/256 px. */
static int32_t half_of(const struct listing *l, fx_t size, const struct ph_vertex *v)
{
    const int up = l->r->samples_log2;
    if (!l->points->in_world) {
        return ph_min((int32_t)(((uint32_t)size + 256) >> 9), HALF_MOST) * (1 << up);
    }
    const struct scale *const scale = &l->scale;
    const uint32_t factor = scale->by_distance ? fx_mulhi_u32(scale->factor, v->q) : scale->factor;
    const int down = scale->by_distance ? scale->down + v->s : scale->down;
    const uint64_t half = fx_mul_wide_u((uint32_t)size, factor) >> ph_min(ph_max(down, 0), 63);
    return half < (uint64_t)HALF_MOST << up ? (int32_t)half : HALF_MOST * (1 << up);
}

/* ---- listing ---------------------------------------------------------------------------------------------------- */

static inline uint32_t fixed16_code(struct ph_quotient depth, uint32_t bias)
{
    return (ph_depth_before(depth, 0, 0) + bias) >> 16;
}

/* The depth code of a point in any format. */
static PH_NOINLINE uint32_t code_of(const struct listing *l, struct ph_quotient depth)
{
    const struct ph_vertex v = {.q = depth.q, .s = depth.s}, *const all[3] = {&v, &v, &v};
    uint32_t d[3] = {0};
    return l->is_fixed16 ? fixed16_code(depth, l->fast_bias)
           : l->float16 != NULL && ph_float_depths_alike(l->float16, all, l->fast_bias, d)
               ? d[0] >> 16
               : ph_depth_code(l->r, depth, ph_depth_bias(l->material));
}

static void set_depth(struct listing *l)
{
    const struct ph_renderer *const r = l->r;
    const struct ph_depth_format *const format = r->stats.depth_format;
    const bool floats = format->coding == PH_DEPTH_IS_FLOAT;
    const uint32_t bias = ph_depth_bias(l->material);
    l->is_fixed16 = format->is_small && !floats;
    l->float16 = format->is_small && floats ? &r->lens : NULL;
    l->fast_bias = floats ? PH_DEPTH_BIAS_FLOAT16 + (bias << 13)
                          : PH_DEPTH_BIAS_FIXED16 + (bias << 16) - ph_depth_far(&r->lens, 0);
}

/* Puts a point at the front of the list of a band. */
static inline void put(uint16_t *first, uint32_t number, uint32_t band, struct ph_spot *spot)
{
    spot->next = first[band];
    first[band] = (uint16_t)number;
}

/* The colours of points: that of the last one is so many behind *colour, and each has one, or all have the same. */
static inline uint32_t colours_of(const struct listing *l, const uint16_t **colour)
{
    const bool own = l->points->colours != NULL;
    *colour = own ? l->points->colours + l->points->count : &l->material->colour;
    return own;
}

/* list_points for points that take one pixel each. */
PH_TIER(mesh) static PH_NOINLINE uint32_t list_pixels(const struct listing *l)
{
    const uint32_t width = l->r->config.width, bias = l->fast_bias, count = l->points->count;
    const uint32_t band_scale = l->r->list.band_scale;
    const bool is_fixed16 = l->is_fixed16;
    uint16_t *const first = l->cloud->first;
    const uint16_t *colour;
    const uint32_t step = colours_of(l, &colour);
    uint32_t number = l->before + count, hidden = 0;
    for (union point *at = point_at(l, number); number != l->before;) {
        const struct ph_vertex *const v = &(--at)->vertex;
        const int32_t x = v->x - 1, y = v->y - 1; /* of the pixel's corner, if the point were in its middle */
        number--;
        colour -= step;
        if (v->code != 0 || (x | y) < 0) {
            hidden++;
            continue;
        }
        const struct ph_quotient depth = ph_depth_of(v);
        at->spot.code = is_fixed16 ? fixed16_code(depth, bias) : code_of(l, depth);
        at->spot.of.pixel = (uint32_t)(y >> 8) * width + (uint32_t)(x >> 8);
        at->spot.colour = *colour;
        put(first, number, (uint32_t)(y >> 8) * band_scale >> 20, &at->spot); /* ph_band_of */
    }
    return count - hidden;
}

/* Lists a point whose vertex lies between the near and the far plane. False if no pixel of it can lie in the picture.
 */
static PH_NOINLINE bool list_point(const struct listing *l, uint32_t number, int32_t half, uint16_t colour)
{
    const struct ph_renderer *const r = l->r;
    struct ph_spot *const spot = &point_at(l, number)->spot;
    const struct ph_vertex v = point_at(l, number)->vertex;
    const bool is_disc = l->points->round && half >= 192 << r->samples_log2;
    half = is_disc ? (half + 8) & ~15 : half;
    const int32_t x0 = ph_max(ph_first_row(v.x - half), 0), x1 = ph_min(ph_first_row(v.x + half), r->config.width);
    const int32_t y0 = ph_max(ph_first_row(v.y - half), 0), y1 = ph_min(ph_first_row(v.y + half), r->config.height);
    if (x0 >= x1 || y0 >= y1) {
        return false;
    }
    spot->code = code_of(l, ph_depth_of(&v));
    spot->colour = colour;
    if (is_disc) {
        spot->code |= PH_SPOT_DISC << 24;
        spot->of.disc.x_radius = (int32_t)((uint32_t)v.x << 12 | (uint32_t)half >> 4);
        spot->of.disc.y = v.y;
    } else {
        spot->code |= PH_SPOT_SQUARE << 24;
        spot->of.square.x0 = (uint16_t)x0;
        spot->of.square.x1 = (uint16_t)x1;
        spot->of.square.y0 = (uint16_t)y0;
        spot->of.square.y1 = (uint16_t)y1;
    }
    l->cloud->goes_below |= y1 - y0 > 1;
    put(l->cloud->first, number, ph_band_of(r, y0), spot);
    return true;
}

/* Lists all points, the last one first, so that lists are in the order of the points. Returns how many can be seen. */
PH_TIER(mesh) static uint32_t list_points(const struct listing *l)
{
    const struct ph_points *const points = l->points;
    const int32_t least = 128 << l->r->samples_log2;
    const uint16_t *colour;
    const uint32_t step = colours_of(l, &colour);
    uint32_t seen = 0;
    for (uint32_t i = points->count; i-- > 0;) {
        const struct ph_vertex *const v = &point_at(l, l->before + i)->vertex;
        const fx_t size = points->sizes != NULL ? points->sizes[i] : points->size;
        colour -= step;
        if ((v->code & PH_CLIP) == 0 && size > 0) {
            seen += list_point(l, l->before + i, ph_max(half_of(l, size, v), least), *colour);
        }
    }
    return seen;
}

/* Whether all points take one pixel, and vertices have clip codes for the sides of the picture. */
static bool are_pixels(const struct ph_renderer *r, const struct ph_points *points)
{
    return points->sizes == NULL && !points->in_world && points->size > 0 && points->size <= FX_ONE &&
           r->samples_log2 == 0 && r->lens.kind != PH_FISHEYE;
}

/* ---- draws ------------------------------------------------------------------------------------------------------ */

/* Lists a draw for what is blended, so that its turn comes among the other draws with a blend. False: no room. */
static bool list_draw(struct ph_renderer *r, const struct ph_material *material, uint32_t place)
{
    const struct ph_draw draw = {.material = material, .kind = PH_DRAW_POINTS, .base = place};
    if (!ph_list_blend(r, material) || r->list.to == r->list.end || !ph_list_draw(r, &draw)) {
        return false;
    }
    struct ph_ref *const ref = ph_list_next(r); /* a draw without references would give its room to the next one */
    if (ref != NULL) {
        *ref = (struct ph_ref){{0}, PH_LINK_AFTER | 127 << 8}; /* all rows */
    }
    return ref != NULL;
}

/* Transforms and lists the points of a call behind a cloud, for which there is room at a place. False if none can be
 * seen, or there is no room for the draw of a blend. */
static bool list_cloud(const struct listing *l, const struct ph_mesh *mesh, const struct ph_xform *to_world,
                       uint32_t place)
{
    struct ph_renderer *const r = l->r;
    const struct ph_blend *const blend = l->material->blend;
    const bool blended = blend != NULL && blend->kind >= PH_BLEND_TIMES;
    const struct ph_xform object_to_view = ph_xform_mul(&r->view, to_world);
    const struct ph_clip_matrix matrix = ph_clip_matrix(&r->lens, &object_to_view);
    *l->cloud = (struct ph_cloud){.next = PH_NONE, .is_blended = blended};
    for (uint32_t i = 0; i < r->band_count; i++) {
        l->cloud->first[i] = 0;
    }
    ph_transform_mesh(r, &matrix, mesh, &point_at(l, l->before)->vertex);
    r->stats.vertices += mesh->vertex_count;
    const bool pixels = are_pixels(r, l->points);
    const uint32_t seen = pixels ? list_pixels(l) : list_points(l);
    if (seen > 0 && blended && !list_draw(r, l->material, place)) {
        r->stats.vertices_dropped += mesh->vertex_count;
        return false;
    }
    if (seen == 0) {
        return false;
    }
    r->stats.points_drawn += seen;
    r->stats.fragments += pixels ? seen : 0; /* others are counted when they are drawn */
    *(r->points != NULL ? &((struct ph_cloud *)ph_at(r, r->last_cloud))->next : &r->clouds) = place;
    r->last_cloud = place;
    r->points = &ph_pointing;
    return true;
}

int ph_draw_points(struct ph_renderer *r, const struct ph_points *points, const struct ph_xform *to_world,
                   const struct ph_material *material)
{
    if (points == NULL || to_world == NULL || material == NULL || points->count > PH_POINTS_MAX ||
        (points->count > 0 && points->positions == NULL)) {
        return PH_ERR_INVAL;
    }
    const struct ph_mesh mesh = {.positions = points->positions, .vertex_count = points->count};
    const struct ph_mark mark = ph_list_mark(r);
    const uint32_t size = sizeof(union point), n = points->count;
    /* room for as many bands as there can be, so that the same fits in bands of any height */
    const uint32_t before = ((uint32_t)sizeof(struct ph_cloud) + 2u * r->config.height + size - 1) / size;
    const uint32_t place = n - 1 < r->config.vertex_max ? ph_list_vertices(r, before + n) : PH_NONE;
    if (place == PH_NONE) {
        return ph_list_leave_out(r, &mesh, false);
    }
    struct listing l = {.r = r, .points = points, .cloud = ph_at(r, place), .material = material, .before = before};
    set_depth(&l);
    if (points->in_world) {
        l.scale = scale_of(&r->lens);
    }
    if (!list_cloud(&l, &mesh, to_world, place)) {
        ph_list_rewind(r, &mark);
    }
    r->stats.triangles_drawn = ph_ref_count(r);
    return PH_OK;
}
