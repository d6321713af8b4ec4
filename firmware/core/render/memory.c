/* ph_config_memory: one piece of memory for all that a renderer takes. See render.h. */
#include "render.h"

_Static_assert(PH_MEMORY(1, 1024, 1, 1) * sizeof(uint64_t) == (16 + 24 + 4 + 4 * 1024 + 7) / 8 * 8, "see render.h");

int ph_config_memory(struct ph_config *config, uint64_t *memory, size_t bytes)
{
    if (config == NULL || memory == NULL || config->band_height == 0 || config->antialiasing != NULL) {
        return PH_ERR_INVAL;
    }
    if (config->depth_format == NULL) {
        return PH_ERR_FORMAT;
    }
    const uint32_t pixels = (uint32_t)config->width * config->band_height;
    const uint32_t bins = (config->height + config->band_height - 1u) / config->band_height;
    /* each piece is aligned because those before it hold larger things */
    const uint64_t sizes[5] = {(uint64_t)config->vertex_max * ph_vertex_bytes,
                               (uint64_t)config->triangle_max * ph_triangle_bytes, bins * sizeof(uint32_t),
                               pixels * (uint64_t)ph_depth_bytes(config->depth_format),
                               pixels * (uint64_t)ph_pixel_bytes(config->pixel_order)};
    void *pieces[5];
    uint64_t used = 0;
    for (int i = 0; i < 5; i++) {
        if (sizes[i] > bytes - used) {
            return PH_ERR_NOMEM;
        }
        pieces[i] = (uint8_t *)memory + used;
        used += sizes[i];
    }
    config->vertices = pieces[0];
    config->triangles = pieces[1];
    config->bins = pieces[2];
    config->bin_max = bins;
    config->depth = pieces[3];
    config->pixels = pieces[4];
    return PH_OK;
}
