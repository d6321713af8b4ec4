/* setup: a triangle's edges and planes. Private to firmware/core. */
#ifndef PH_SETUP_H
#define PH_SETUP_H

#include "list.h"
#include "triangle.h"

/* A number with the sign of ph_wide_area. */
int32_t ph_wide_area_sign(int32_t dx1, int32_t dy1, int32_t dx2, int32_t dy2);

/* The sides and the area of a triangle whose corners are projected. */
static inline struct ph_sides ph_sides(const struct ph_vertex *a, const struct ph_vertex *b, const struct ph_vertex *c)
{
    const int32_t dx1 = b->x - a->x, dx2 = c->x - a->x, dy1 = b->y - a->y, dy2 = c->y - a->y;
    const bool is_short = ph_sides_are_short(dx1, dy1, dx2, dy2);
    const int32_t area = is_short ? dx2 * dy1 - dx1 * dy2 : ph_wide_area_sign(dx1, dy1, dx2, dy2);
    return (struct ph_sides){dx1, dy1, dx2, dy2, area, is_short};
}

/* Whether pixels are taken from a texture. */
bool ph_is_textured(const struct ph_material *material);

/* What the triangles of a draw have in common at set-up. */
struct ph_setting {
    const struct ph_renderer *r;
    const void *base; /* corner 0: struct ph_vertex or struct ph_corner */
    struct ph_draw draw;
    const uint16_t *ramp; /* the material's, or its colour as the only entry */
    uint32_t far, bias;   /* N/f in units of fixed16; what is added to the codes of the format */
    bool is_small;        /* small triangles are drawn as such */
    bool floats;          /* float16, else fixed16 */
    uint8_t shading;      /* PH_SHADE_GOURAUD, PH_SHADE_FLAT, or PH_SHADE_UNLIT: one colour */
};

/* Prepares the set-up of a draw, whose lens is that of r. */
void ph_setting_of(struct ph_setting *s, const struct ph_renderer *r, const struct ph_draw *draw);

/* Sets up a triangle of the draw. */
void ph_setup(const struct ph_setting *s, const struct ph_ref *ref, struct ph_triangle *t);

#endif
