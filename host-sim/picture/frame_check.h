/*
 * frame_check: compares frames with reference pictures that were kept: golden frames of a scene.
 *
 * A reference is a PNG or PPM (of several frames: FILE-NNNN.png, as --out names them), a folder of frame-NNNN.png or
 * .ppm, or a text file with lines `frame N crc32 XXXXXXXX`, as --crc prints them (with
 * --json, too).
 */
#ifndef FRAME_CHECK_H
#define FRAME_CHECK_H

#include "ppm.h"

#include <stdbool.h>

struct frame_check_crc {
    uint32_t frame, crc;
};

struct frame_check {
    const char *reference;  /* NULL: nothing is compared */
    const char *difference; /* FILE.png: where a difference is drawn; several: FILE-NNNN.png */
    uint32_t tolerance;     /* of 255: a pixel differs if a channel is further off */
    uint32_t scale;         /* a reference may be so many times as wide and high, as --out --scale wrote it; 0 is 1 */
    bool several;
    int digits;
    struct frame_check_crc *crcs; /* NULL: the references are pictures */
    uint32_t crc_count;
    uint32_t wrong; /* frames that differ so far */
};

/* Call this with the first five members set; `last` is the highest number of a frame to come. 0, COMPLAINED, or
 * PH_ERR_INVAL for a tolerance with CRCs. Close it in any case. */
int frame_check_open(struct frame_check *check, uint32_t last);

/* Compares a frame. If it differs, it prints a line on stdout (how many pixels, how far, where) and draws the
 * difference. 0, or COMPLAINED if it cannot be compared. */
int frame_check_put(struct frame_check *check, uint32_t frame, const struct ppm *picture);

/* Ends the check. COMPLAINED, with a line, if frames differed; else status. */
int frame_check_close(struct frame_check *check, int status);

#endif
