/* setup: a triangle's edges and planes. Private to firmware/core. */
#ifndef PH_SETUP_H
#define PH_SETUP_H

#include "kernels.h"
#include "setting.h"
#include "triangle.h"

/* Prepares the set-up of a draw, whose lens is that of r. */
void ph_setting_of(struct ph_setting *s, const struct ph_renderer *r, const struct ph_draw *draw);

/* Sets up a triangle for which ph_setup_fast has returned `done`, from the start unless that is PH_SMALL_STEEP. */
void ph_setup_general(const struct ph_setting *s, const struct ph_ref *ref, enum ph_small_setup done,
                      struct ph_triangle *t);

/* Finishes a triangle that ph_setup_fast has set up, if its light is not what ph_setup_small has set. */
void ph_set_fast_light(const struct ph_setting *s, const struct ph_ref *ref, struct ph_triangle *t);

/* Sets up a triangle of the draw. */
static inline void ph_setup(const struct ph_setting *s, const struct ph_ref *ref, struct ph_triangle *t)
{
    const enum ph_small_setup done = s->is_fast ? ph_setup_fast(&s->fast, ref, t) : PH_SMALL_NO_ROW;
    if (done != PH_SMALL_SET) {
        ph_setup_general(s, ref, done, t);
    } else if (!s->keeps_light) {
        ph_set_fast_light(s, ref, t);
    }
}

/* Gives a small triangle a plane of depth. */
static inline void ph_set_small_depth(struct ph_triangle *t, const struct ph_plane *plane)
{
    struct ph_small_triangle *const small = &t->as.small.rows;
    small->gd = plane->gx;
    small->d_dy = plane->gy;
    small->d = plane->base + (uint32_t)t->y_top * plane->gy;
}

/* octaves.c: sets the depth of a small triangle that crosses octaves, as d says in units of its block. has_plane:
 * ph_setup_small has set its plane. False if 32 bits are not enough. Only formats name it. */
bool ph_finish_octaves(struct ph_triangle *t, const struct ph_renderer *r, const struct ph_vertex *const v[3],
                       const struct ph_sides *sides, const uint32_t d[3], bool has_plane);

/* How far a triangle exceeds a small one. */
enum ph_excess ph_excess_of(const struct ph_setting *s, const struct ph_sides *sides,
                            const struct ph_vertex *const v[3]);

/* Gives a triangle with a texture or colours the depth that a small triangle of another shading has, so that depth is
 * the same in all shadings. fits: what is returned if it has no other. False if 32 bits are not enough. */
bool ph_take_small_depth(struct ph_triangle *t, const struct ph_setting *s, const struct ph_vertex *const v[3],
                         const struct ph_sides *sides, bool fits);

/* Sets up the reference of that number, wherever its draw is; the lens of r must be its own. For the depth lab. */
void ph_setup_number(const struct ph_renderer *r, uint32_t number, struct ph_triangle *t);

#endif
