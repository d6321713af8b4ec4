/*
 * self_test: what people report of a kit with its glass, as text to paste into an issue, in lines of less than 80
 * characters. On an open runner it tells the build, the kit and what the machine says of itself; asks the panel for its
 * identification and waits for its tearing-effect edges, where these lines are wired; measures the frames a second of
 * the turntable and the time of a whole frame on the bus; and draws the cube and the test card without sending them, to
 * compare their CRCs with a table of known ones (self_test.c; sizes of the panels in panels.h). It leaves the test card
 * on the glass.
 *
 * A CRC is of the picture as the renderer drew it, before the panel's format, as RGB888 rows: what
 * `pinhole-sim --size WxH --demo NAME --frames 1 --crc` prints.
 */
#ifndef SELF_TEST_H
#define SELF_TEST_H

#include "runner.h"

/* Where the text of the report goes. The end of a line comes alone, as "\n". */
typedef void self_test_put(const char *text);

struct self_test_machine {
    const char *build; /* of the program: "demos for pico-display, CORES=1 CHANGES=1" */
    uint32_t frames;   /* sent before the report */

    /* Puts lines about the machine. Nothing is on the bus meanwhile. */
    void (*facts)(const void *context, self_test_put *put);
    const char *(*why)(const void *context); /* what is known about an error; NULL: nothing */
    const void *context;
};

/* Returns how many CRCs are not the known ones, or an error of the runner (PH_ERR_.., HAL_E..); then the text says that
 * the test did not end. */
int self_test_report(struct runner *runner, const struct self_test_machine *machine, self_test_put *put);

/* Puts a number with at least `digits` digits. */
void self_test_number(self_test_put *put, uint32_t value, bool hex, uint32_t digits);

#endif
