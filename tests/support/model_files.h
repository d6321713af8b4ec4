/*
 * model_files: model files made on the fly in a directory of their own, and what model_open says about them.
 * The bytes are written by hand, format by format.
 */
#ifndef MODEL_FILES_H
#define MODEL_FILES_H

#include "model.h"
#include "files.h"

/* Writes n (up to 128) bytes: floats of little endian, 0 everywhere but 1 at these places. */
void file_ones(const char *name, const int *places, int count, size_t n);

/* model_open with stderr caught in said (empty string: nothing was said). */
int open_caught(struct model **model, const char *path, char said[1024]);

/* model_open; the test fails if anything was said. */
struct model *open_good(const char *path);

/* The cube [-1, 1]^3 in each format: 6 quads or 12 triangles, counter-clockwise from outside. */
const char *cube_obj(void);
const char *cube_stl_text(void);
const char *cube_stl_binary(void);
const char *cube_ply_text(void);
const char *cube_ply_binary(void);

/* glTF: nodes is the text of the "nodes" array; each may show mesh 0, the cube with 8 vertices. */
const char *cube_gltf(const char *nodes);
const char *cube_glb(const char *nodes);

#endif
