/* model_stage: a renderer with room for everything in a demo's picture, and the demo. */
#ifndef MODEL_STAGE_H
#define MODEL_STAGE_H

#include "demo.h"

struct model_stage {
    struct demo demo;
    struct demo_context context;
    struct ph_renderer r;
    uint16_t *pixels; /* a band */
    void *memory;     /* free() it, also after an error */
};

/* The picture. */
struct model_stage_size {
    uint16_t width, height, band_height;
    uint32_t triangle_max; /* of the list */
};

/* Initialises the renderer, and the demo, whose state is given. 0, or their errors. */
int model_stage_open(struct model_stage *stage, const struct demo *demo, void *state,
                     const struct model_stage_size *size);

#endif
