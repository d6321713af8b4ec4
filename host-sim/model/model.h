/*
 * model: a model file (OBJ, STL, PLY, glTF, GLB, and what else assimp reads) as meshes for the renderer, and as a demo.
 *
 * The model is triangulated (n-gons by ears), its node transforms are applied, points and lines are left out, normals
 * are made where there are none (OBJ, STL: smooth, but creases above 66 degrees stay sharp; PLY, glTF and what else
 * shares vertices: flat, as glTF asks), meshes are split at 65535 vertices. It is moved and scaled so that it touches a
 * sphere of radius 1 around the origin from inside. The diffuse colour of a material becomes its ramp; a PNG texture is
 * resampled to a power of two of at most 1024. A texture that cannot be used (JPEG, missing, broken) leaves the colour.
 * A note says so, and what else was changed or ignored: missing material files, sizes of textures, vertex colours,
 * transparency, lights, animations.
 *
 * A file's first camera (glTF) becomes the model's, moved and scaled with it; its near and far plane come as close to
 * the model as they can. The shape of its picture is kept: what it shows is seen on a panel of any shape.
 *
 * assimp/ does it with libassimp, noassimp/ says what to install; the Makefile picks. Reading happens in a child
 * process, into memory shared with it: a file that makes the reader crash or hang costs one line, not the program.
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

/* Reads a file. 0, or COMPLAINED when one line has said why. */
int model_open(struct model **model, const char *path);

void model_close(struct model *model);

/*
 * A demo that shows the model as its camera does, with the views `camera` and `turntable`; a model without one on the
 * turntable. Its context->state must be the model.
 */
struct demo model_demo(const struct model *model);

#endif
