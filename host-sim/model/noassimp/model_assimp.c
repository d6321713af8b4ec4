#include "model_assimp.h"

bool model_assimp_read(struct model_shared *shared, struct model_scene *scene)
{
    (void)scene;
    return model_shared_failed(shared, "this program was built without assimp; install libassimp-dev (Debian) and make "
                                       "again");
}
