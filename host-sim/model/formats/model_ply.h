/*
 * model_ply: PLY, of text or binary in either byte order, as a scene of one mesh. Read are of a vertex x, y, z, nx, ny,
 * nz, red, green, blue and its texture coordinates (s and t, u and v, texture_u and texture_v); of a face
 * vertex_indices (or vertex_index) and texcoord, a pair for each corner; of tristrips vertex_indices, where -1 begins a
 * new strip; and the comment TextureFile. What has no colours is white, and all is drawn from both sides: few PLY files
 * say which is the outer one. Other elements and properties are passed over.
 */
#ifndef MODEL_PLY_H
#define MODEL_PLY_H

#include "model_scene.h"

/* Reads the file that the model's folder names. false: shared->error, with the line or the byte. */
bool model_ply_read(struct model_shared *shared, struct model_scene *scene);

#endif
