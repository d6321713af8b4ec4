/* setup: a triangle's edges and planes. Private to firmware/core. */
#ifndef PH_SETUP_H
#define PH_SETUP_H

#include "setting.h"
#include "triangle.h"

/* Prepares the set-up of a draw, whose lens is that of r. */
void ph_setting_of(struct ph_setting *s, const struct ph_renderer *r, const struct ph_draw *draw);

/* Sets up a triangle or a line of the draw. */
void ph_setup(const struct ph_setting *s, const struct ph_ref *ref, struct ph_triangle *t);

/* Sets up the reference of that number, wherever its draw is; the lens of r must be its own. For the depth lab. */
void ph_setup_number(const struct ph_renderer *r, uint32_t number, struct ph_triangle *t);

#endif
