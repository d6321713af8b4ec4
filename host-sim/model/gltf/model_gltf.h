/* model_gltf: a glTF or GLB file as a scene; see gltf_file.h. */
#ifndef MODEL_GLTF_H
#define MODEL_GLTF_H

#include "gltf_file.h"
#include "model_scene.h"

/* How texture coordinates of a primitive become those of the renderer: u' = m[0] . (u, v, 1), v' = m[1] . (u, v, 1);
 * and what its vertex colours are multiplied by, in linear light. */
struct model_gltf_uv {
    uint32_t set; /* TEXCOORD_set */
    double m[2][3];
    double factor[4]; /* 1 where the texture has it already */
};

/* A channel of a display, 0 .. 255, for linear light of 0 .. 1; what is outside is clamped. */
uint8_t model_gltf_channel(double linear);

/* Reads the file that the model's folder names. Primitives without a material have a last one of their own. Vertices
 * that are equal are joined, and a primitive is split at MODEL_VERTICES_MAX vertices. false: shared->error. */
bool model_gltf_read(struct model_shared *shared, struct model_scene *scene);

/* Reads the materials of the file and one plain one, and how each maps its texture. NULL: no memory. */
struct model_material *model_gltf_materials(struct model_shared *shared, struct gltf_file *file,
                                            struct model_gltf_uv *uvs);

#endif
