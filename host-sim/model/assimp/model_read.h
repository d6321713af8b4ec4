/* model_read: the part of model loading that runs in the child process, on assimp's data. */
#ifndef MODEL_READ_H
#define MODEL_READ_H

#include "model.h"

#include <assimp/scene.h>

#include <stddef.h>

/* What the child shares with its parent. */
struct model_shared {
    struct model model;
    struct demo_arena arena; /* behind this struct */
    char error[256];         /* why it failed, one line */
    char note[512];          /* what was left out or changed; see model_read_note */
};

/* Reads path into shared->model. false: shared->error says why. */
bool model_read(struct model_shared *shared, const char *path);

/* For the parts below: writes shared->error and returns false. */
bool model_read_failed(struct model_shared *shared, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Adds to shared->note what is not said there yet; what has no room is left out. */
void model_read_note(struct model_shared *shared, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Notes the material files that an OBJ file names and that cannot be opened. */
void model_note_missing_mtl(struct model_shared *shared, const char *path);

/* Materials of the scene, ready for the meshes' parts; NULL when the arena is full. is_linear: glTF's colours. */
struct ph_material *model_read_materials(struct model_shared *shared, const struct aiScene *scene, const char *path,
                                         bool is_linear);

/* From the world to the unit sphere: (p - centre) * scale. */
struct model_fit {
    double centre[3], scale;
};

/* The scene's meshes, fitted to the unit sphere; the camera is fitted with them. */
bool model_read_meshes(struct model_shared *shared, const struct aiScene *scene, const struct ph_material *materials);

/* The scene's first camera, where it has one; what is odd about it is noted. */
void model_read_camera(struct model_shared *shared, const struct aiScene *scene, const struct model_fit *fit);

/* to = parent * local: rows of three and a translation. */
void model_place_multiply(double to[3][4], double parent[3][4], const struct aiMatrix4x4 *local);

/* A mesh where a node shows it. */
struct model_place {
    const struct aiMesh *mesh;
    double m[3][4]; /* to world: three rows, the last column is the translation */
    double cofactors[3][3];
    bool mirrors; /* left becomes right: faces must be turned over to look outwards again */
};

struct model_places {
    struct model_place *list; /* free() it */
    size_t count;
};

/* Every mesh of every node. false: no memory. */
bool model_places_find(const struct aiScene *scene, struct model_places *places);

/* Vertex i and its normal (of any length) in the world. */
void model_place_point(const struct model_place *place, unsigned i, double point[3]);
void model_place_normal(const struct model_place *place, unsigned i, double normal[3]);

#endif
