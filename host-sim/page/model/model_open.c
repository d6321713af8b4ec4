/* See model.h. It stands in place of host-sim/model/model_open.c: the page's worker is the process that a hostile file
 * may crash, and the memory of its module has a limit. */
#include "complain.h"
#include "model_read.h"

#include <stdlib.h>

#define SHARED_BYTES ((size_t)1 << 29) /* a page of it takes memory when it is written */

/* The memory is new, and so it is 0: an instance of the module reads one model. */
int model_open(struct model **model, const char *path, const struct model_options *options)
{
    struct model_shared *const shared = malloc(SHARED_BYTES);
    const size_t head = (sizeof *shared + 15) & ~(size_t)15;
    *model = NULL;
    if (shared == NULL) {
        return complain("model %s: not enough memory", path);
    }
    *shared = (struct model_shared){.arena = {.base = (uint8_t *)shared + head, .size = SHARED_BYTES - head},
                                    .options = *options};
    if (!model_read(shared, path)) {
        const int status = complain("model %s: %s", path, shared->error);
        free(shared);
        return status;
    }
    shared->model.note = shared->note[0] != '\0' ? shared->note : NULL;
    *model = &shared->model;
    return 0;
}

void model_close(struct model *model)
{
    free(model);
}
