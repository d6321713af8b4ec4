/*
 * emulate: runs a firmware image in QEMU and steps it frame by frame through its log UART (the characters of
 * firmware/app/images/demos.c). There are two machines:
 *
 *   lm3s6965evb    the picture is the screen of QEMU's own model of the SSD0323; the buttons are those of the kit
 *   netduinoplus2  an STM32F405 without a display. QEMU's trace tells the stores to SPI and pins in order, and the
 * model of the controller (sim.h) makes the picture of them; buttons are pressed through the UART
 *
 * Functions return 0 or COMPLAINED.
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

/* Checks that this is the ELF of a whole image that begins in the flash at that address. (QEMU runs any file.) */
int emulate_image_check(const char *path, uint32_t flash);

int emulate_screen(const struct emulation *e); /* lm3s6965evb */
int emulate_trace(const struct emulation *e);  /* netduinoplus2 */

#endif
