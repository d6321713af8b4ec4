/* hal_conformance: what hal.h asks of every backend, as assertions; and the same for kits that are there only at times.
 */
#ifndef HAL_CONFORMANCE_H
#define HAL_CONFORMANCE_H

#include "board.h"
#include "hal.h"

/* Opens, tries and closes the kit twice. keeps_time: its clock runs. */
void hal_conforms(const struct hal *hal, const struct board *board, const char *name, bool keeps_time);

/* hal/linux in the virtual kit (tests/kit): number of failed tests. */
int kit_linux_tests(void);

/*
 * hal/ft232h with a device on USB: number of failed tests; or sends three frames (serial: NULL for the only device),
 * prints the error if there is one and returns it as an errno.
 */
int kit_ft232h_tests(void);
int kit_ft232h_send(const char *serial);

/* Whether this machine has the virtual kit. */
bool kit_is_here(void);

#endif
