#include "model.h"

#include "complain.h"
#include "model_scene.h"
#include "option_text.h"

#include <stdlib.h>

int model_open(struct model **model, const char *path, const struct model_options *options)
{
    (void)options;
    *model = NULL;
    if (option_text_ends(path, ".phs")) {
        return model_scene_open(model, path);
    }
    return complain("model %s: this program was built without assimp; install libassimp-dev (Debian) "
                    "and make again",
                    path);
}

void model_close(struct model *model)
{
    free(model); /* a binary scene, or NULL */
}
