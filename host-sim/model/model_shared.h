/* model_shared: what the child process that reads a model shares with its parent. */
#ifndef MODEL_SHARED_H
#define MODEL_SHARED_H

#include "model.h"
#include "model_folder.h"

#include <stddef.h>

struct model_rig;

struct model_shared {
    struct model model;
    struct demo_arena arena; /* behind this struct */
    struct model_options options;
    struct demo_studio studio;        /* of the options */
    struct model_folder folder;       /* what the file may name */
    const struct ph_texture *texture; /* of options.texture, once it is made */
    struct model_rig *rig;            /* what moves; NULL: nothing */
    char error[256];                  /* why it failed, one line */
    char note[512];                   /* what was left out or changed; see model_shared_note */
};

/* Writes shared->error and returns false. */
bool model_shared_failed(struct model_shared *shared, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Adds a text to shared->note unless it is there already or has no room. */
void model_shared_note(struct model_shared *shared, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Makes room for one more element behind `count`, of so many bytes; lists that grow by this alone are never full. NULL:
 * no memory, and the list is as it was. */
void *model_shared_grow(void *list, size_t count, size_t bytes);

/* Whether the name of the model's file ends so, in capitals or not. */
bool model_shared_ends(const struct model_shared *shared, const char *ending);

#endif
