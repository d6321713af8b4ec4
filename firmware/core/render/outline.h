/* outline: rows and edges of a triangle that is not small. Private to firmware/core. */
#ifndef PH_OUTLINE_H
#define PH_OUTLINE_H

#include "triangle.h"
#include "vertex.h"

/* Sets rows and edges of a triangle with rows in a picture so many rows high; its corners run counter-clockwise. */
void ph_setup_outline(int32_t height, const struct ph_vertex *const v[3], struct ph_triangle *t);

#endif
