/* model_camera: a scene's first camera. */
#ifndef MODEL_CAMERA_H
#define MODEL_CAMERA_H

#include "model_places.h"

/* How the world is fitted into the unit sphere: (p - centre) * scale. */
struct model_fit {
    double centre[3], scale;
};

/* Reads the camera into the model, where there is one; what is odd about it is noted. */
void model_camera_read(struct model_shared *shared, const struct model_scene *scene, const struct model_places *places,
                       const struct model_fit *fit);

#endif
