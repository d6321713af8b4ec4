/*
 * model: a model file (OBJ, STL, PLY, glTF, GLB, and whatever assimp reads) as meshes for the renderer, and as a demo.
 *
 * The model is triangulated, the transforms of its nodes are applied, and points and lines are left out. Missing
 * normals are made: smooth for OBJ and STL, with creases above 66 degrees; flat for PLY, glTF and other formats that
 * share vertices, as glTF asks. Meshes are split at 65535 vertices. The model is moved and scaled into the sphere of
 * radius 1 around the origin, which it touches. The diffuse colour of a material becomes its ramp. A PNG texture is
 * resampled to a power of two of at most 1024; one that cannot be used (JPEG, missing, broken) leaves the colour. A
 * note tells what was changed or ignored.
 *
 * The first camera of a glTF file becomes the camera of the model, moved and scaled with it. Its near and far planes
 * come as close to the model as they can. A panel of another shape shows all of the camera's picture.
 *
 * Of glTF these are read, too: base colour factor times texture, emissive factor, unlit, mirrored textures and
 * KHR_texture_transform. A required extension that is not read is an error.
 *
 * assimp/ does it with libcjson (glTF, GLB) and libassimp; noassimp/ says what to install. A child process with limits of
 * time and memory reads the file into shared memory: a file that crashes or hangs the reader costs one line, not the
 * program.
 */
#ifndef MODEL_H
#define MODEL_H

#include "demo.h"

#define MODEL_TRIANGLES_MAX 4000000u
#define MODEL_FILE_MAX      (1u << 30) /* bytes */
#define MODEL_VERTICES_MAX  65535u     /* of one mesh */

struct model {
    struct ph_mesh *meshes;
    uint32_t mesh_count;
    uint32_t vertex_max;     /* vertices of the largest mesh */
    uint32_t triangle_count; /* of all meshes */
    bool has_camera;
    struct demo_eye camera;
    const char *note; /* one line on what could not be used, or NULL */
};

/* Reads a file. 0 or COMPLAINED. */
int model_open(struct model **model, const char *path);

void model_close(struct model *model);

/* The filter of that name: nearest, bilinear, mipmap. False if it is none. */
bool model_filter_named(const char *name, uint8_t *filter);

/* Draws its textures with that filter, enum ph_filter, from now on. They have all levels. */
void model_set_filter(struct model *model, uint8_t filter);

/* Returns a demo of the model: with a camera it has the views `camera` and `turntable`, else the turntable alone. Its
 * context->state must be the model. */
struct demo model_demo(const struct model *model);

#endif
