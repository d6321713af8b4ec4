/* Renderer and camera of the small profile. See small.h, render.h. */
#include "small.h"

#include "lens.h"

/* The only format: the rest of its ways is that of the files of this folder. */
static const struct ph_depth_ways ways = {.set_near = ph_lens_near};
const struct ph_depth_format ph_depth_fixed16 = {"fixed16", PH_DEPTH_IS_FIXED, 16, 0, true, NULL, &ways};

const size_t ph_vertex_bytes = PH_VERTEX_BYTES_32, ph_triangle_bytes = PH_TRIANGLE_BYTES_32;

/* What the profile lacks is refused. */
static bool is_beyond(const struct ph_config *config)
{
    return config->depth_format != PH_DEPTH_FIXED16 || config->samples != NULL || config->other_core != NULL ||
           config->shown != NULL;
}

int ph_renderer_init(struct ph_renderer *r, const struct ph_config *config)
{
    if (r == NULL) {
        return PH_ERR_INVAL;
    }
    *r = (struct ph_renderer){.band_count = 0}; /* which every later call refuses */
    if (config == NULL || is_beyond(config) || config->width < 1 || config->width > 1024 || config->height < 1 ||
        config->height > 1024 || config->band_height < 1 || config->band_height > config->height ||
        config->vertices == NULL || config->triangles == NULL || config->depth == NULL ||
        ((uintptr_t)config->vertices | (uintptr_t)config->triangles) % sizeof(void *) != 0 ||
        (uintptr_t)config->depth % sizeof(uint16_t) != 0) {
        return config != NULL && config->depth_format == NULL ? PH_ERR_FORMAT : PH_ERR_INVAL;
    }
    r->config.width = config->width;
    r->config.height = config->height;
    r->config.band_height = config->band_height;
    r->config.depth = config->depth;
    r->room[0] = config->vertices;
    r->room[1] = config->triangles;
    r->vertex_max = config->vertex_max;
    r->room_bytes = config->vertices == config->triangles ? config->vertex_max * PH_VERTEX_BYTES_32
                                                          : config->triangle_max * PH_TRIANGLE_BYTES_32;
    r->band_count = (uint16_t)((config->height + config->band_height - 1u) / config->band_height);
    return PH_OK;
}

/* Whether the profile has such a light: a directional one, white. */
static bool is_lit_by(const struct ph_scene_light *light)
{
    const struct ph_light *const l = &light->lights[0];
    return light->count == 0 ||
           (light->count == 1 && l->kind == PH_LIGHT_DIRECTIONAL && (l->red | l->green | l->blue) == 0);
}

int ph_frame_begin(struct ph_renderer *r, const struct ph_xform *view, const struct ph_projection *projection,
                   const struct ph_scene_light *light, uint16_t background)
{
    if (r->band_count == 0) {
        return PH_ERR_STATE;
    }
    r->state = PH_SMALL_NONE;
    if (view == NULL || projection == NULL || projection->kind == PH_FISHEYE || (light != NULL && !is_lit_by(light))) {
        return PH_ERR_INVAL;
    }
    const int status = ph_lens_of(&r->lens, projection, r->config.width, r->config.height, PH_DEPTH_FIXED16, 0);
    if (status != PH_OK) {
        return status;
    }
    r->light = light != NULL ? *light : (struct ph_scene_light){.ambient = FX_ONE};
    r->view = *view;
    r->background = background;
    r->stats = (struct ph_stats){.depth_format = PH_DEPTH_FIXED16};
    r->vertices = r->room[0];
    r->vertices_end = r->room[0] == r->room[1] ? NULL : r->vertices + r->vertex_max * PH_VERTEX_BYTES_32;
    r->parts = (uint8_t *)r->room[1] + (r->room_bytes & ~(uint32_t)7);
    r->clip = NULL;
    r->first = r->last = NULL;
    r->state = PH_SMALL_OPEN;
    return PH_OK;
}

void *ph_small_room(struct ph_renderer *r, size_t bytes)
{
    const uint8_t *const least = r->vertices_end != NULL ? r->room[1] : r->vertices;
    const size_t all = (bytes + 7) & ~(size_t)7;
    if (all > (size_t)(r->parts - least)) {
        return NULL;
    }
    r->parts -= all;
    return r->parts;
}

struct ph_small_vertex *ph_small_vertices(struct ph_renderer *r, uint32_t n)
{
    const uint8_t *const end = r->vertices_end != NULL ? r->vertices_end : r->parts;
    uint8_t *const at = r->vertices;
    if (n > (size_t)(end - at) / sizeof(struct ph_small_vertex)) {
        return NULL;
    }
    r->vertices += n * sizeof(struct ph_small_vertex);
    return (struct ph_small_vertex *)(void *)at;
}

uint32_t ph_frame_bands(struct ph_renderer *r)
{
    if (r->state != PH_SMALL_OPEN) {
        return 0;
    }
    r->state = PH_SMALL_BANDS;
    r->band = 0;
    return r->band_count;
}
