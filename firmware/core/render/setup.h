/* setup: a triangle's edges and planes. Private to firmware/core. */
#ifndef PH_SETUP_H
#define PH_SETUP_H

#include "kernels.h"
#include "setting.h"
#include "triangle.h"

/* Prepares the set-up of a draw, whose lens is that of r. */
void ph_setting_of(struct ph_setting *s, const struct ph_renderer *r, const struct ph_draw *draw);

/* Sets up a triangle for which ph_setup_usual has returned `done`; PH_SMALL_NO_ROW if it was not asked. */
void ph_setup_unusual(const struct ph_setting *s, const struct ph_ref *ref, enum ph_small_setup done,
                      struct ph_triangle *t);

/* Gives a small triangle of one light that light. Of samples, those of a pixel get one light each, where light is
 * gentle: then the triangle becomes one of PH_KIND_SMALL_FINE. */
void ph_set_light(const struct ph_setting *s, const struct ph_vertex *first, struct ph_triangle *t);

/* Sets up a triangle of the draw. */
static inline void ph_setup(const struct ph_setting *s, const struct ph_ref *ref, struct ph_triangle *t)
{
    const enum ph_small_setup done = s->is_usual ? ph_setup_usual(&s->usual, ref, t) : PH_SMALL_NO_ROW;
    if (done == PH_SMALL_SET) {
        if (!s->keeps_light) {
            ph_set_light(s, &s->usual.base[ref->corner[0]], t);
        }
    } else {
        ph_setup_unusual(s, ref, done, t);
    }
}

/* Sets up the reference of that number, wherever its draw is; the lens of r must be its own. For the depth lab. */
void ph_setup_number(const struct ph_renderer *r, uint32_t number, struct ph_triangle *t);

#endif
