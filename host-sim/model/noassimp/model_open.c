#include "model.h"

#include "complain.h"

int model_open(struct model **model, const char *path)
{
    *model = NULL;
    return complain("model %s: this program was built without assimp; install libassimp-dev and libcjson-dev (Debian) "
                    "and make again",
                    path);
}

void model_close(struct model *model)
{
    (void)model;
}
