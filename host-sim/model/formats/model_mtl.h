/* model_mtl: MTL, the materials of an OBJ file: Kd, Ke, d, Tr, map_Kd and map_d. */
#ifndef MODEL_MTL_H
#define MODEL_MTL_H

#include "model_scene.h"
#include "model_text.h"

/* What an OBJ file must know of a material beside what the scene has of it. */
struct model_mtl {
    struct model_word name;     /* in the bytes of a file that stay in memory */
    double scale[2], offset[2]; /* of the texture: u' = u * scale + offset */
};

struct model_mtls {
    struct model_mtl *list; /* of each material of the scene */
    uint32_t count;
};

/* Adds the materials of the file that has this name in the OBJ file. Pictures are looked for beside the MTL file, then
 * beside the model. What cannot be used is noted. false: shared->error. */
bool model_mtl_read(struct model_shared *shared, struct model_scene *scene, struct model_mtls *mtls,
                    const struct model_word *name);

/* Adds a material that no file has; one without a name (n 0) is that of what names none. false: shared->error. */
bool model_mtl_add_plain(struct model_shared *shared, struct model_scene *scene, struct model_mtls *mtls,
                         const struct model_word *name);

/* Adds the material of what names none. false: shared->error. */
bool model_mtl_plain(struct model_shared *shared, struct model_scene *scene);

/* Adds a white material for both sides, with a picture beside the model (n 0: without). false: shared->error. */
bool model_mtl_white(struct model_shared *shared, struct model_scene *scene, const struct model_word *texture);

#endif
