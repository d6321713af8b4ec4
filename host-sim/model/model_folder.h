/*
 * model_folder: the files that a model may name. A model comes from anywhere, and what it names ends in an image that
 * its user may publish: so it may name what lies in its own folder, or below, and nothing else. What counts is where a
 * name leads after "..", symbolic links and "file:" are resolved, not how it is spelled.
 */
#ifndef MODEL_FOLDER_H
#define MODEL_FOLDER_H

#include <stdbool.h>

#define MODEL_PATH_BYTES 4096

struct model_folder {
    const char *model;  /* the path of its file */
    bool allow_outside; /* --allow-outside */
    char outside[128];  /* the first name that led to a file outside; else empty */
};

/* Finds the regular file that the model names: its path from the folder on, or an absolute one, with / or \ between
 * folders, or a "file:" URI. False: there is none, or it is outside. */
bool model_folder_find(struct model_folder *folder, const char *name, char path[MODEL_PATH_BYTES]);

/* Finds the file of a path that a reader has joined to the model's folder, or of the model itself, which may be a
 * symbolic link to anywhere. */
bool model_folder_find_path(struct model_folder *folder, const char *from, char path[MODEL_PATH_BYTES]);

#endif
