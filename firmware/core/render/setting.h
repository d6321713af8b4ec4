/* setting: what is the same for all triangles and lines of a draw. Private to firmware/core. */
#ifndef PH_SETTING_H
#define PH_SETTING_H

#include "list.h"

/* See ph_setting_of in setup.h. */
struct ph_setting {
    const struct ph_renderer *r;
    const void *base; /* corner 0: struct ph_vertex or struct ph_corner */
    struct ph_draw draw;
    const uint16_t *ramp; /* the material's, or its colour as the only entry */
    uint32_t far, bias;   /* N/f in units of fixed16; what is added to the codes of the format */
    bool is_small;        /* small triangles are drawn as such */
    bool floats;          /* float16, else fixed16 */
    uint8_t shading;      /* PH_SHADE_GOURAUD, _FLAT, _TEXTURE (lit or not), or _UNLIT: one colour */
};

#endif
