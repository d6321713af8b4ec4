/*
 * frame_out: where frames go: a directory, one file, several files, a GIF, or a stream on stdout; and pictures in
 * files, as PPM, PNG or GIF by the name's ending.
 */
#ifndef FRAME_OUT_H
#define FRAME_OUT_H

#include "ppm.h"

#include <stdbool.h>

enum frame_out_kind {
    FRAME_OUT_NONE,
    FRAME_OUT_STREAM,
    FRAME_OUT_FILE,
    FRAME_OUT_FILES,
    FRAME_OUT_DIRECTORY,
    FRAME_OUT_GIF
};

struct gif_out;

struct frame_out {
    enum frame_out_kind kind;
    const char *path, *ending; /* ending: of each file */
    uint32_t scale;            /* every pixel so many times as wide and high; 0 is 1 */
    int digits;                /* of a frame's number in a file's name: names sort like numbers */
    struct gif_out *gif;
    bool is_full; /* the disk has no room for more frames of the GIF */
    size_t made;  /* length of the part of path that names the first directory that was made; 0: none was */
};

#define FRAME_OUT_SCALE_MAX 16
#define FRAME_OUT_TAKES     "a directory, a file that ends in .ppm, .png or .gif, or -"

/*
 * target is NULL (nowhere), "-" (stdout, PPM), a name that ends in .ppm, .png or .gif, or a directory, which is made
 * when it is missing and gets PPM files. `last` is the highest number of a frame to come. Several frames turn FILE.png
 * into FILE-NNNN.png; a GIF takes all. Sets all but out->scale. 0, COMPLAINED, or PH_ERR_INVAL for another ending.
 */
int frame_out_open(struct frame_out *out, const char *target, bool several, uint32_t last);

/* Writes one frame, or keeps it for the GIF. A file is written whole or not at all. 0 or COMPLAINED. */
int frame_out_put(struct frame_out *out, uint32_t frame, const struct ppm *picture);

/* Writes a GIF if `status`, of what was done so far, is 0, or if the disk had no room for more frames. Directories that
 * were made go, unless a frame is in them. Returns status, or COMPLAINED. */
int frame_out_close(struct frame_out *out, int status);

/* Enlarges a picture: every pixel becomes `scale` times as wide and high. 0 or COMPLAINED. The caller frees to->rgb in
 * any case. */
int frame_out_enlarge(const struct ppm *from, uint32_t scale, struct ppm *to);

#define FRAME_OUT_PIXELS_MAX (1u << 26) /* what pictures that were read may have together: 192 MB */

/* Reads a PPM or a PNG of most_pixels at most, whatever its name is. A larger one is refused before it is decoded. 0 or
 * COMPLAINED. The caller frees picture->rgb. */
int frame_out_load(const char *path, uint32_t most_pixels, struct ppm *picture);

#endif
