/* Renderer and camera: see render.h. */
#include "edge.h"
#include "feed.h"
#include "lens.h"

static bool is_exponent(unsigned bits)
{
    return bits == 0 || (bits >= 3 && bits <= 6);
}

static bool depth_is_usable(const struct ph_config *config)
{
    return config->depth != NULL && is_exponent(config->depth_exponent) &&
           ((uintptr_t)config->depth & (ph_depth_bytes(config->depth_format) - 1)) == 0;
}

/* Length of the inner part of a side of the picture, 1/256 px: a point is inner if it stays further from both borders
 * than a small triangle can reach, plus one pixel. */
static uint32_t inner(uint32_t size)
{
    const uint32_t margins = 2 * (PH_SIDE_SMALL + 256);
    return size * 256 > margins ? size * 256 - margins : 0;
}

static uint32_t bands_of(const struct ph_config *config)
{
    const uint32_t lines = config->band_height;
    return (uint32_t)fx_quotient_u64(config->height + lines - 1, lines);
}

static int check_config(const struct ph_config *config)
{
    if (config == NULL) {
        return PH_ERR_INVAL;
    }
    if (config->depth_format == NULL) {
        return PH_ERR_FORMAT;
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
    return config->bin_max < bands_of(config) ? PH_ERR_NOMEM : PH_OK;
}

int ph_renderer_init(struct ph_renderer *r, const struct ph_config *config)
{
    const int status = check_config(config);
    if (r == NULL) {
        return PH_ERR_INVAL;
    }
    struct ph_config c = {.width = 0}; /* config may lie in r */
    if (status == PH_OK) {
        const int samples_log2 = config->samples != NULL ? 1 : 0;
        c = *config;
        c.antialiasing = samples_log2 != 0 ? c.antialiasing : NULL;
        c.width = (uint16_t)(c.width << samples_log2);
        c.height = (uint16_t)(c.height << samples_log2);
        c.band_height = (uint16_t)(c.band_height << samples_log2);
    }
    *r = (struct ph_renderer){.band_count = 0}; /* which every later call refuses */
    if (status == PH_OK) {
        r->config = c;
        r->inner_x = inner(c.width);
        r->inner_y = inner(c.height);
        r->band_count = bands_of(&c);
        r->samples_log2 = c.samples != NULL ? 1 : 0;
        ph_list_begin(r);
    }
    ph_list_close(r);
    return status;
}

/* format, exponent: as in ph_stats. */
static int set_camera(struct ph_renderer *r, const struct ph_xform *view, const struct ph_projection *projection,
                      const struct ph_depth_format *format, unsigned exponent)
{
    struct ph_lens lens;
    const int status = ph_lens_of(&lens, projection, r->config.width, r->config.height, format, exponent);
    if (status != PH_OK) {
        return status;
    }
    r->lens = lens;
    r->list.lens = PH_NONE;
    r->projection = *projection;
    r->view = *view;
    r->view_norm = 0;
    return PH_OK;
}

int ph_frame_camera(struct ph_renderer *r, const struct ph_xform *view, const struct ph_projection *projection)
{
    if (r->list.stage == PH_LIST_CLOSED) {
        return PH_ERR_STATE;
    }
    if (view == NULL || projection == NULL) {
        return PH_ERR_INVAL;
    }
    return set_camera(r, view, projection, r->stats.depth_format, r->stats.depth_exponent);
}

/* Format and bits of exponent, as in ph_stats. */
static const struct ph_depth_format *choose_format(const struct ph_config *config,
                                                   const struct ph_projection *projection, unsigned *exponent)
{
    const struct ph_depth_format *const named = config->depth_format, *const format = named->choose != NULL
                                                                                          ? named->choose(projection)
                                                                                          : named;
    *exponent = format->coding != PH_DEPTH_IS_FLOAT ? 0
                : config->depth_exponent != 0       ? config->depth_exponent
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
    const struct ph_depth_format *const format = choose_format(&r->config, projection, &exponent);
    const int status = set_camera(r, view, projection, format, exponent);
    if (status != PH_OK) {
        return status;
    }
    static const struct ph_scene_light full = {.ambient = FX_ONE};
    r->light = light != NULL ? *light : full;
    r->background = background;
    r->fog = NULL;
    r->stats = (struct ph_stats){.depth_format = format, .depth_exponent = (uint8_t)exponent};
    ph_list_begin(r);
    return PH_OK;
}

uint32_t ph_frame_bands(struct ph_renderer *r)
{
    if (r->list.stage == PH_LIST_CLOSED) {
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
