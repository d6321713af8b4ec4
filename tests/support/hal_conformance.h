/* hal_conformance: what hal.h asks of every backend, as assertions; and the same for boards that are there only at
 * times.
 */
#ifndef HAL_CONFORMANCE_H
#define HAL_CONFORMANCE_H

#include "board.h"
#include "hal.h"

/* Opens, tries and closes the backend twice. keeps_time: its clock runs. */
void hal_conforms(const struct hal *hal, const struct board *board, const char *name, bool keeps_time);

/* hal/linux in the virtual board (tests/guest): number of failed tests. */
int linux_guest_tests(void);

/*
 * hal/ft232h with a device on USB: number of failed tests; or sends three frames (serial: NULL for the only device),
 * prints the error if there is one and returns it as an errno.
 */
int ft232h_guest_tests(void);
int ft232h_guest_send(const char *serial);

/* Whether this machine has the virtual backend. */
bool virtual_board_is_here(void);

#endif
