/* model_surface: what a file says of a material, and the material that the renderer draws. */
#ifndef MODEL_SURFACE_H
#define MODEL_SURFACE_H

#include "model_shared.h"
#include "model_texture.h"
#include "picture_in.h"

enum model_alpha {
    MODEL_OPAQUE,
    MODEL_MASK, /* cut out where alpha is below the cut-off */
    MODEL_BLEND,
};

/* Colours are those of the display, 0 .. 255. */
struct model_surface {
    uint8_t colour[3];              /* without a texture */
    uint8_t glow[3];                /* emissive */
    const struct ph_filter *filter; /* as the file says */
    char name[104];                 /* of the texture, for notes */
    struct picture_in picture;      /* of the texture; its rgb is NULL without; model_surface_make frees both */
    struct picture_in mask;         /* whose alpha counts, in place of the picture's; its alpha is NULL without */
    struct picture_in glowing; /* emission in place of `glow`, at the coordinates of the texture; rgb is NULL without */
    uint8_t wrap;              /* enum ph_wrap */
    bool two_sided, is_unlit;
    uint8_t mode;         /* enum model_alpha */
    double alpha, cutoff; /* alpha is multiplied by the picture's */
};

/* A channel of 0 .. 1 as one of 0 .. 255; what is outside is clamped. */
uint8_t model_surface_channel(float value);

/* What a mesh is drawn with. Emission of a surface with a texture is drawn once more over it, and added; so are vertex
 * colours on an opaque texture, and multiplied. */
struct model_material {
    struct ph_material surface, glow, tint;
    bool glows, can_tint;
};

/* Makes the material. Emission is in the ramp where there is no texture. false: the arena is full. */
bool model_surface_make(struct model_shared *shared, struct model_surface *from, struct model_material *to);

/* Takes the alpha of the surface's mask, or its grey where it has none: it cuts out what is seldom between nothing and
 * all, and blends otherwise. */
void model_surface_mask(struct model_surface *surface);

/* Makes the texture that --texture names, if it does. false: shared->error says why not. */
bool model_surface_take_texture(struct model_shared *shared);

#endif
