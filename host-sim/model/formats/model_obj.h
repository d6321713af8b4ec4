/*
 * model_obj: Wavefront OBJ as a scene of one node: v (with a weight or a colour), vt, vn, f, usemtl, mtllib; o and g
 * begin a mesh. Points, lines and curves are left out, and smoothing groups are not looked at. Where a corner has no
 * normal one is made (model_normals.h) within its mesh.
 */
#ifndef MODEL_OBJ_H
#define MODEL_OBJ_H

#include "model_scene.h"

/* Reads the file that the model's folder names. false: shared->error, with the line. */
bool model_obj_read(struct model_shared *shared, struct model_scene *scene);

#endif
