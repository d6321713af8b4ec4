/*
 * model_stl: STL, of text or binary, as a scene of one mesh. The normals of its facets are left aside, because they add
 * nothing; those of corners are made (model_normals.h). The colours that some programs put into the last two bytes of a
 * binary facet are read. A binary file whose count is 0 has as many facets as its size allows: some programs write it
 * so.
 */
#ifndef MODEL_STL_H
#define MODEL_STL_H

#include "model_scene.h"

/* Reads the file that the model's folder names. false: shared->error, with the line or the byte. */
bool model_stl_read(struct model_shared *shared, struct model_scene *scene);

#endif
