/* See model_stage.h. */
#include "model_stage.h"

#include <stdlib.h>

/* The next n bytes of memory, a multiple of 16; NULL if there is no memory and they are only counted. */
static void *take(uint8_t *memory, size_t *used, size_t n)
{
    void *part = memory != NULL ? memory + *used : NULL;
    *used += (n + 15) & ~(size_t)15;
    return part;
}

/* Divides memory, or (NULL) counts it. */
static size_t divide(struct model_stage *s, struct ph_config *config, uint8_t *memory)
{
    const size_t pixels = (size_t)config->width * config->band_height;
    size_t used = 0;
    config->vertices = take(memory, &used, ph_vertex_bytes * config->vertex_max);
    config->triangles = take(memory, &used, ph_triangle_bytes * config->triangle_max);
    config->depth = take(memory, &used, 4 * pixels);
    config->bins = take(memory, &used, sizeof *config->bins * config->bin_max);
    s->context.arena.base = take(memory, &used, s->demo.arena_bytes);
    s->pixels = take(memory, &used, sizeof *s->pixels * pixels);
    return used;
}

int model_stage_open(struct model_stage *stage, const struct demo *demo, void *state,
                     const struct model_stage_size *size)
{
    struct ph_config config = {.width = size->width,
                               .height = size->height,
                               .band_height = size->band_height,
                               .depth_format = PH_DEPTH_AUTO,
                               .colouring = PH_COLOURS,
                               .vertex_max = demo->vertex_max,
                               .triangle_max = size->triangle_max,
                               .bin_max = ((uint32_t)size->height + size->band_height - 1) / size->band_height};
    *stage = (struct model_stage){
        .demo = *demo,
        .context = {
            .arena = {.size = demo->arena_bytes}, .state = state, .width = size->width, .height = size->height}};
    stage->memory = malloc(divide(stage, &config, NULL));
    if (stage->memory == NULL) {
        return PH_ERR_NOMEM;
    }
    divide(stage, &config, stage->memory);
    const int status = ph_renderer_init(&stage->r, &config);
    return status == 0 ? stage->demo.init(&stage->context) : status;
}
