/* model_surface: what a file says of a material, and the material that the renderer draws. */
#ifndef MODEL_SURFACE_H
#define MODEL_SURFACE_H

#include "model_shared.h"
#include "model_texture.h"

/* Colours are those of the display, 0 .. 255. */
struct model_surface {
    uint8_t colour[3];  /* without a texture */
    uint8_t glow[3];    /* emissive */
    char name[104];     /* of the texture, for notes */
    struct ppm picture; /* of the texture; rgb is NULL without; model_surface_make frees it */
    uint8_t wrap[2];    /* enum ph_wrap along u and v */
    bool two_sided, is_unlit, is_transparent;
};

/* Makes the material: emission is added to the ramp; what cannot be drawn is noted. false: the arena is full. */
bool model_surface_make(struct model_shared *shared, struct model_surface *from, struct ph_material *to);

/* Why a picture was not read, from its first bytes. */
const char *model_surface_why(const uint8_t *bytes, size_t n);

#endif
