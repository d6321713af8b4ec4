/* frame_out: where pinhole-sim's frames go: a directory, one file, several files, or a stream on stdout. */
#ifndef FRAME_OUT_H
#define FRAME_OUT_H

#include "ppm.h"

#include <stdbool.h>

enum frame_out_kind { FRAME_OUT_NONE, FRAME_OUT_STREAM, FRAME_OUT_FILE, FRAME_OUT_FILES, FRAME_OUT_DIRECTORY };

struct frame_out {
    enum frame_out_kind kind;
    const char *path;
};

/* target is NULL (nowhere), "-" (stdout), a name that ends in ".ppm", or a directory, which is made when it is missing.
 * Several frames turn FILE.ppm into FILE-NNNN.ppm. 0, COMPLAINED, or PH_ERR_INVAL for another extension. */
int frame_out_open(struct frame_out *out, const char *target, bool several);

/* Writes one frame; a file is written whole or not at all. 0 or COMPLAINED. */
int frame_out_put(const struct frame_out *out, uint32_t frame, const struct ppm *picture);

#endif
