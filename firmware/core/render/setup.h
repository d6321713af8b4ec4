/* setup: a triangle's edges and planes. Private to firmware/core. */
#ifndef PH_SETUP_H
#define PH_SETUP_H

#include "list.h"
#include "triangle.h"

/* What the triangles of a draw have in common at set-up. */
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

/* Prepares the set-up of a draw, whose lens is that of r. */
void ph_setting_of(struct ph_setting *s, const struct ph_renderer *r, const struct ph_draw *draw);

/* Sets up a triangle of the draw. */
void ph_setup(const struct ph_setting *s, const struct ph_ref *ref, struct ph_triangle *t);

/* Sets up the reference of that number, wherever its draw is; the lens of r must be its own. For the depth lab. */
void ph_setup_number(const struct ph_renderer *r, uint32_t number, struct ph_triangle *t);

#endif
