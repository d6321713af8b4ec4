/*
 * sim_focus: depth of field (blur.h): what --focus sets of a scene's, and its numbers, in lines of sim_fraction.h:
 *
 *   focus.distance   the distance along the view that is in focus
 *   focus.strength   radius of the blur of what is infinitely far away, pixels
 *   focus.aperture   diameter of the thin lens that blurs so, in units of the world: 2 strength distance / F, where F
 * is the focal length in pixels, scale_y height / 2; not for a parallel projection focus.largest    the largest
 * diameter that is drawn, pixels blur             diameter of the blur of a point at the distance z: 2 strength |1 -
 * distance / z|, or in parallel 2 strength |z - distance| / (far - near). Pinhole's code has steps of 1/8 px, and ends
 * at `largest`
 *
 * ph_blur_begin is replaced at link time (see the Makefile). A fisheye, whose distances are those from the eye, has no
 * such lines.
 */
#ifndef SIM_FOCUS_H
#define SIM_FOCUS_H

#include "sim_fraction.h"
#include "sim_player.h"

struct sim_focus {
    struct ph_focus focus;
    struct ph_blur blur; /* which has begun */
};

/* From now on scenes with depth of field have this one; a distance of 0: their own. A strength below 0: their own. */
void sim_focus_set(fx_t distance, fx_t strength);

int sim_focus_blur_begin(struct ph_blur *blur, const struct ph_renderer *r, void *scratch, size_t bytes,
                         const struct ph_focus *focus);

/* Draws the first band of the scene that sim_player_scene made, and finds its depth of field. False: it has none, or no
 * memory for it. */
bool sim_focus_find(struct sim_focus *found, struct sim_player *p);

/* Prints the lines of `focus`. height: of the picture, pixels. */
void sim_focus_print(FILE *file, const struct sim_focus *f, const struct ph_projection *p, uint16_t height);

/* Prints the line of the blur, as `name`, at a distance along the view. Nothing beyond near and far, where nothing is
 * drawn. */
void sim_focus_print_blur(FILE *file, const char *name, const struct sim_focus *f, const struct ph_projection *p,
                          struct sim_fraction z);

#endif
