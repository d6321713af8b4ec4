/* model_materials: a scene's materials and their textures. */
#ifndef MODEL_MATERIALS_H
#define MODEL_MATERIALS_H

#include "model_surface.h"

#include <assimp/scene.h>

/* Returns the materials of the scene, or NULL when the arena is full. */
struct model_material *model_materials_read(struct model_shared *shared, const struct aiScene *scene);

#endif
