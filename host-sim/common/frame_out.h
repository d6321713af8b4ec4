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

/*
 * target: NULL (nowhere), "-", a name that ends in ".ppm", or a directory (made when missing, with those above it).
 * Several frames and FILE.ppm become FILE-NNNN.ppm. 0, or when one line has said why COMPLAINED, or PH_ERR_INVAL for
 * another extension.
 */
int frame_out_open(struct frame_out *out, const char *target, bool several);

/* Puts one frame there; a file is complete or not there. 0, or COMPLAINED when one line has said why. */
int frame_out_put(const struct frame_out *out, uint32_t frame, const struct ppm *picture);

#endif
