/* See model_assimp.h. Stands in where assimp is not installed: refuses the file, and says which formats are read. */
#include "model_assimp.h"

bool model_assimp_read(struct model_shared *shared, struct model_scene *scene)
{
    (void)scene;
    return model_shared_failed(shared, "is no model that can be read: OBJ, STL, PLY, glTF and GLB are; for other "
                                       "formats install libassimp-dev (Debian) and make again");
}
