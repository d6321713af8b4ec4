/* setup: a triangle's edges and planes, computed once and put on the list. Private to firmware/core. */
#ifndef PH_SETUP_H
#define PH_SETUP_H

#include "sides.h"

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

/* Before the triangles of a part: prepares its small ones. Triangles of other materials may come in between. */
void ph_setup_part(struct ph_renderer *r, const struct ph_material *material);

/* Sets up a triangle and lists it. False if it faces away (and is not two-sided) or covers no pixel centre. uv: those
 * of each corner; NULL if the material has no texture. */
bool ph_setup_triangle(struct ph_renderer *r, const struct ph_material *material, const struct ph_vertex *const v[3],
                       const fx_t *const uv[3]);

/* The same for a triangle that faces the viewer, whose sides are known. */
bool ph_setup_front(struct ph_renderer *r, const struct ph_material *material, const struct ph_vertex *const v[3],
                    const fx_t *const uv[3], const struct ph_sides *sides);

/* ph_setup_triangle for corners that are no vertices of the mesh. */
bool ph_setup_corners(struct ph_renderer *r, const struct ph_material *material, const struct ph_corner *a,
                      const struct ph_corner *b, const struct ph_corner *c);

/* Sets up a line one pixel wide as two triangles. */
void ph_setup_line(struct ph_renderer *r, const struct ph_material *material, const struct ph_corner *a,
                   const struct ph_corner *b);

#endif
