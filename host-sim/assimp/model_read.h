/* model_read: the part of model loading that runs in the child process, on assimp's data. */
#ifndef MODEL_READ_H
#define MODEL_READ_H

#include "model.h"

#include <assimp/scene.h>

/* What the child shares with its parent. */
struct model_shared {
    struct model model;
    struct demo_arena arena; /* behind this struct */
    char error[256];         /* why it failed, one line */
    char note[256];
};

/* Reads path into shared->model. false: shared->error says why. */
bool model_read(struct model_shared *shared, const char *path);

/* For the parts below: writes shared->error and returns false. */
bool model_read_failed(struct model_shared *shared, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Materials of the scene, ready for the meshes' parts; NULL when the arena is full. is_linear: glTF's colours. */
struct ph_material *model_read_materials(struct model_shared *shared, const struct aiScene *scene, const char *path,
                                         bool is_linear);

/* The scene's meshes, fitted to the unit sphere. */
bool model_read_meshes(struct model_shared *shared, const struct aiScene *scene, const struct ph_material *materials);

#endif
