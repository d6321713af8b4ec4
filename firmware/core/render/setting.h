/* setting: what is the same for all triangles and lines of a draw. Private to firmware/core. */
#ifndef PH_SETTING_H
#define PH_SETTING_H

#include "kernels.h"
#include "list.h"

/* What gives pixels their colour: the material's own, the ramp with the light of the first corner, the ramp with a
 * plane of light, or what else the corners have: u and v of a texture, or lit colours. */
enum ph_source { PH_FROM_COLOUR, PH_FROM_FIRST_LIGHT, PH_FROM_LIGHT, PH_FROM_CORNERS };

/* What all triangles and lines of a draw share; ph_setting_of in setup.h fills it in. */
struct ph_setting {
    bool is_small;         /* small triangles are drawn as such */
    bool is_fast;          /* ph_setup_fast knows such triangles */
    bool has_fast_corners; /* ... and all of such triangles but what set_corners sets */
    bool has_codes;        /* depth of small triangles and lines is stepped in codes */
    bool keeps_light;    /* a small triangle keeps the light that ph_setup_small has set: else see ph_set_fast_light */
    uint8_t source;      /* enum ph_source */
    uint8_t v_unit;      /* textured: see ph_texel_v_unit */
    struct ph_fast fast; /* base: with PH_DRAW_UVS a struct ph_corner; ramp: the material's, or its colour as the only
                              entry; bias: what is added to the codes of the format, in fixed16 to N/w (depth.h) */
    bool (*set_corners)(struct ph_triangle *t, const struct ph_setting *s, const struct ph_vertex *const v[3],
                        const fx_t *const uv[3]); /* see shading.h, colours.h; PH_FROM_CORNERS only */
    enum ph_excess (*excess_of)(const struct ph_setting *s, const struct ph_sides *sides,
                                const struct ph_vertex *const v[3]); /* setup.h; NULL: one that is not small is large */
    const struct ph_antialiasing *antialiasing;                      /* pixels are samples, or light is dithered */
    const struct ph_octave_ways *octaves;                            /* float16; else NULL */
    const struct ph_renderer *r;
    const struct ph_draw *draw;
};

#endif
