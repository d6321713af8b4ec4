/*
 * port: what a microcontroller port (a folder below hal/) gives to a firmware image besides its struct hal_ops. Each
 * function is defined once in every such port; where a chip cannot do it, it does what is said here.
 */
#ifndef PORT_H
#define PORT_H

#include "hal.h"

/* The one kit of this image: operations and their context. Its board is the image's `board_here`. */
struct hal port_hal(void);

/* The image's board: defined by the build as the one that BOARD= names. */
extern const struct board *const board_here;

/* Writes text to the log UART (115200 8N1); waits until it is in the transmitter. */
void port_log(const char *text);

/* Next byte from the log UART, or -1 when none waits. */
int port_log_read(void);

/* Reboots into the chip's own USB boot loader; returns where it has none. */
void port_boot_loader(void);

/* Ends the image: under an emulator it exits with status, on silicon it waits for ever with the panel dark. */
void port_exit(int status);

/* Bytes of stack used since the start, at most; 0 where that is not known. */
uint32_t port_stack_used(void);

/*
 * Runs `run(argument)` on the other core; false where there is none or it is busy. port_core_join waits until run has
 * returned.
 */
bool port_core_run(void (*run)(void *argument), void *argument);
void port_core_join(void);

#endif
