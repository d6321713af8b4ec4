/* model_fit: the sphere and the outline of all that a model shows, in all moments of its clips. */
#ifndef MODEL_FIT_H
#define MODEL_FIT_H

#include "model_camera.h"

#define MODEL_OUTLINE 17

/* The points that are furthest away in directions from straight down to straight up, as seen while the model is turned
 * about y: distance from the axis and height, from the model's middle and in its radii. */
struct model_outline {
    double points[MODEL_OUTLINE][2];
};

/* Finds the middle of the box around all points, their largest distance from it, and their outline. False:
 * shared->error. */
bool model_fit_find(struct model_shared *shared, const struct model_places *places, struct model_fit *fit,
                    struct model_outline *outline);

/* Gives the outline to what moves. False: shared->error. */
bool model_fit_outline(struct model_shared *shared, const struct model_outline *outline);

#endif
