/* model_gltf_motion: skins, morph weights and animations of a glTF file, for nodes that its scene shows. */
#ifndef MODEL_GLTF_MOTION_H
#define MODEL_GLTF_MOTION_H

#include "gltf_file.h"
#include "model_scene.h"

/* Reads the skins that shown nodes have, and the weights that their morph targets have at rest. False: file->error. */
bool model_gltf_skins_read(struct gltf_file *file, struct model_scene *scene);

/* Reads all animations; what they move beside shown nodes is left out. False: file->error. */
bool model_gltf_clips_read(struct gltf_file *file, struct model_scene *scene);

#endif
