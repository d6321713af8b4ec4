/*
 * emulate: runs a firmware image in QEMU and steps it frame by frame through its log UART (the characters of
 * firmware/app/images/demos.c). Two machines:
 *
 *   lm3s6965evb    the picture is what QEMU's own model of the kit's SSD0323 shows (screendump); its buttons are real
 *   netduinoplus2  an STM32F405 without a display: the picture is what a controller's model (sim.h) makes of the
 *                  stores to SPI and pins, which QEMU's trace tells in order; buttons are pressed through the UART
 *
 * Functions return 0, or COMPLAINED when one line has said why.
 */
#ifndef EMULATE_H
#define EMULATE_H

#include "board.h"
#include "key_script.h"
#include "ppm.h"

struct emulation {
    const struct board *board;
    const char *image;
    uint32_t frames;
    const struct key_script *keys;
    FILE *log;
    void *context; /* frame's */
    int (*frame)(void *context, uint32_t frame, const struct ppm *picture);
};

/* The ELF of a whole image that begins in the flash at that address: QEMU runs anything. */
int emulate_image_check(const char *path, uint32_t flash);

int emulate_screen(const struct emulation *e); /* lm3s6965evb */
int emulate_trace(const struct emulation *e);  /* netduinoplus2 */

#endif
