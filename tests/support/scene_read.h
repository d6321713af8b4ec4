/* scene_read: a reader of models on a text or bytes, in this process. Include the reader's header and this; see
 * model_files.h for the folder of the files. */
#ifndef SCENE_READ_H
#define SCENE_READ_H

#include "model_files.h"
#include "model_scene.h"

#include <stdarg.h>
#include <setjmp.h>
#include <cmocka.h>

typedef bool (*scene_reader)(struct model_shared *shared, struct model_scene *scene);

/* Reads the file; the scene and shared->note last until the next call. false: shared->error. */
bool scene_read(scene_reader reader, const char *path, struct model_shared **shared, struct model_scene **scene);

/* Fails unless the file is read without a note. */
struct model_scene *scene_read_good(scene_reader reader, const char *path);

/* Fails unless the file is refused by an error that holds `reason`. */
void scene_refuse(scene_reader reader, const char *path, const char *reason);

/* The area of all triangles of a mesh, by which they are anticlockwise seen from +z. */
double scene_area_z(const struct model_mesh *mesh);

#endif
