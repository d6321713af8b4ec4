/* Renderer and camera: see render.h. */
#include "edge.h"
#include "feed.h"
#include "fisheye.h"

static bool is_exponent(unsigned bits)
{
    return bits == 0 || (bits >= 3 && bits <= 6);
}

static bool depth_is_usable(const struct ph_config *config)
{
    return config->depth != NULL && config->depth_format < PH_DEPTH_FORMATS && is_exponent(config->depth_exponent) &&
           (uintptr_t)config->depth % ph_depth_bytes(config->depth_format) == 0;
}

/* Length of the inner part of a side of the picture, 1/256 px: a point is inner if it stays further from both borders
 * than a small triangle can reach, plus one pixel. */
static uint32_t inner(uint32_t size)
{
    const uint32_t margins = 2 * (PH_SIDE_SMALL + 256);
    return size * 256 > margins ? size * 256 - margins : 0;
}

static int check_config(const struct ph_config *config)
{
    if (config == NULL) {
        return PH_ERR_INVAL;
    }
    const uint32_t width = config->width, height = config->height, lines = config->band_height;
    const int samples_log2 = config->samples != NULL ? 1 : 0;
    if (width < 1 || width << samples_log2 > 1024 || height < 1 || height << samples_log2 > 1024 || lines < 1 ||
        lines > height || !depth_is_usable(config) ||
        (samples_log2 != 0 && ((uintptr_t)config->samples | (uintptr_t)config->depth) % sizeof(uint32_t) != 0)) {
        return PH_ERR_INVAL;
    }
    if (config->vertices == NULL || config->triangles == NULL || config->bins == NULL ||
        config->triangle_max == PH_NONE ||
        ((uintptr_t)config->vertices | (uintptr_t)config->triangles) % sizeof(void *) != 0 ||
        (uintptr_t)config->bins % sizeof(uint32_t) != 0 || (uintptr_t)config->shown % sizeof(uint16_t) != 0 ||
        (config->other_core != NULL && (config->other_core_join == NULL || config->cores == NULL)) ||
        (config->samples != NULL && config->antialiasing == NULL)) {
        return PH_ERR_INVAL;
    }
    return config->bin_max < (height + lines - 1) / lines ? PH_ERR_NOMEM : PH_OK;
}

int ph_renderer_init(struct ph_renderer *r, const struct ph_config *config)
{
    const int status = check_config(config);
    if (r == NULL) {
        return PH_ERR_INVAL;
    }
    if (status != PH_OK) {
        *r = (struct ph_renderer){.band_count = 0}; /* which every later call refuses */
        ph_list_close(r);
        return status;
    }
    const int samples_log2 = config->samples != NULL ? 1 : 0;
    const uint32_t width = config->width, height = config->height, lines = config->band_height;
    *r = (struct ph_renderer){.config = *config,
                              .inner_x = inner(width << samples_log2),
                              .inner_y = inner(height << samples_log2),
                              .band_count = (height + lines - 1) / lines,
                              .samples_log2 = (uint8_t)samples_log2};
    r->config.antialiasing = samples_log2 != 0 ? config->antialiasing : NULL;
    r->config.width = (uint16_t)(width << samples_log2);
    r->config.height = (uint16_t)(height << samples_log2);
    r->config.band_height = (uint16_t)(lines << samples_log2);
    ph_list_begin(r);
    ph_list_close(r);
    return PH_OK;
}

/* Principal point in 1/256 px: half the size, moved by shift halves; y counts downwards. */
static int32_t centre_of(int32_t size, fx_t shift)
{
    return (int32_t)((fx_mul_wide(size, FX_ONE + shift) + 256) >> 9);
}

/* Focal lengths as fractions of 2^focal_log2 px. That power also makes the guard band reach over the picture. */
static int lens_focal(struct ph_lens *lens, const struct ph_projection *p, int32_t width, int32_t height)
{
    const int64_t fx = fx_mul_wide(p->scale_x_q20, width), fy = fx_mul_wide(p->scale_y_q20, height); /* px, Q21 */
    const int32_t guard = 2 * ph_max(width, height); /* px; with |shift| <= 2 no pixel is further away than 1.5 sizes */
    const int64_t longest = fx > fy ? fx : fy;
    int log2 = 0;
    while (log2 <= 18 && (((int64_t)1 << (21 + log2)) < longest || (4 << log2) < guard)) {
        log2++;
    }
    if (log2 > 18) {
        return PH_ERR_RANGE;
    }
    lens->focal_log2 = (int8_t)log2;
    lens->guard_up = (uint8_t)(log2 > 8 ? log2 - 8 : 0);
    lens->focal_x = (int32_t)(log2 <= 9 ? fx << (9 - log2) : fx >> (log2 - 9));
    lens->focal_y = (int32_t)(log2 <= 9 ? fy << (9 - log2) : fy >> (log2 - 9));
    return PH_OK;
}

/* n f / (f - n), but less than 8 n: from 2^31 on, times 2^-*shift. */
static uint32_t stretched_near(const struct ph_projection *p, int *shift)
{
    const uint32_t n = (uint32_t)p->near_z, f = (uint32_t)p->far_z, least = f / 8 + 1;
    const int up = fx_clz32(n);
    const uint64_t scaled = fx_quotient_u64(fx_mul_wide_u(n << up, f), f - n > least ? f - n : least);
    const int down = 32 - fx_clz32((uint32_t)(scaled >> 32)); /* at most 3 */
    *shift = up - down;
    return (uint32_t)(scaled >> down);
}

static void lens_depth(struct ph_lens *lens, const struct ph_projection *p, unsigned format)
{
    lens->near_z = p->near_z;
    lens->far_z = p->far_z;
    int shift = fx_clz32((uint32_t)p->near_z);
    if (p->kind == PH_ORTHOGRAPHIC) {
        lens->depth_scale = fx_rcp_norm((uint32_t)p->far_z - (uint32_t)p->near_z, &shift);
        lens->near_shift = (int8_t)shift;
        return; /* far_q stays 0: d is 0 at the far plane already */
    }
    const bool is_fixed = ph_depth_traits[format].coding == PH_DEPTH_IS_FIXED;
    const uint32_t norm = is_fixed ? stretched_near(p, &shift) : (uint32_t)p->near_z << shift;
    lens->near_shift = (int8_t)shift;
    lens->depth_scale = norm - (norm >> ph_depth_head(lens));
    const struct ph_quotient far = ph_depth_quotient(lens, p->far_z);
    lens->far_q = far.q;
    lens->far_s = far.s;
    lens->linear = ph_depth_linear_of(lens);
}

/* format, exponent: as in ph_stats. */
static int set_camera(struct ph_renderer *r, const struct ph_xform *view, const struct ph_projection *projection,
                      unsigned format, unsigned exponent)
{
    const int32_t width = r->config.width, height = r->config.height;
    const struct ph_projection *p = projection;
    if ((p->kind == PH_FISHEYE && p->curved == NULL) || p->far_z <= p->near_z ||
        (p->kind != PH_ORTHOGRAPHIC && p->near_z <= 0) || p->scale_x_q20 <= 0 || p->scale_y_q20 <= 0) {
        return PH_ERR_INVAL;
    }
    if (p->shift_x > 2 * FX_ONE || p->shift_x < -2 * FX_ONE || p->shift_y > 2 * FX_ONE || p->shift_y < -2 * FX_ONE) {
        return PH_ERR_RANGE;
    }
    struct ph_lens lens = {.kind = (uint8_t)p->kind, .float_down = (uint8_t)(exponent != 0 ? exponent - 1 : 3)};
    if (p->kind == PH_FISHEYE) {
        p->curved->set_lens(&lens, p, height);
    } else if (lens_focal(&lens, p, width, height) != PH_OK) {
        return PH_ERR_RANGE;
    }
    lens.centre_x = centre_of(width, -p->shift_x);
    lens.centre_y = centre_of(height, p->shift_y);
    lens_depth(&lens, p, format);
    r->lens = lens;
    r->list.lens = PH_NONE;
    r->projection = *projection;
    r->view = *view;
    return PH_OK;
}

int ph_frame_camera(struct ph_renderer *r, const struct ph_xform *view, const struct ph_projection *projection)
{
    if (r->list.is_closed == PH_LIST_CLOSED) {
        return PH_ERR_STATE;
    }
    if (view == NULL || projection == NULL) {
        return PH_ERR_INVAL;
    }
    return set_camera(r, view, projection, r->stats.depth_format, r->stats.depth_exponent);
}

/* Format and bits of exponent, as in ph_stats. */
static unsigned choose_format(const struct ph_config *config, const struct ph_projection *projection,
                              unsigned *exponent)
{
    const unsigned format = config->depth_format == PH_DEPTH_AUTO ? ph_depth_choose(projection) : config->depth_format;
    const bool is_float = ph_depth_traits[format].coding == PH_DEPTH_IS_FLOAT;
    *exponent = !is_float                     ? 0
                : config->depth_exponent != 0 ? config->depth_exponent
                                              : ph_depth_choose_exponent(projection);
    return format;
}

int ph_frame_begin(struct ph_renderer *r, const struct ph_xform *view, const struct ph_projection *projection,
                   const struct ph_scene_light *light, uint16_t background)
{
    if (r->band_count == 0) {
        return PH_ERR_STATE;
    }
    ph_list_close(r);
    if (view == NULL || projection == NULL || (light != NULL && light->count > PH_LIGHTS_MAX)) {
        return PH_ERR_INVAL;
    }
    unsigned exponent;
    const unsigned format = choose_format(&r->config, projection, &exponent);
    const int status = set_camera(r, view, projection, format, exponent);
    if (status != PH_OK) {
        return status;
    }
    static const struct ph_scene_light full = {.ambient = FX_ONE};
    r->light = light != NULL ? *light : full;
    r->background = background;
    r->fog = NULL;
    r->depth = ph_depth_traits[format];
    r->stats = (struct ph_stats){.depth_format = (uint8_t)format, .depth_exponent = (uint8_t)exponent};
    ph_list_begin(r);
    return PH_OK;
}

uint32_t ph_frame_bands(struct ph_renderer *r)
{
    if (r->list.is_closed == PH_LIST_CLOSED || r->band_count == 0) {
        return 0;
    }
    ph_feed_sort(r);
    r->carried = r->slots = r->ahead = NULL;
    r->slots_used[0] = r->list.used[1];
    r->slots_used[1] = r->list.used[2];
    ph_list_end(r);
    r->list.band = 0;
    return r->band_count;
}
