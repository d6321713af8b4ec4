/*
 * port: what a microcontroller port (a folder of hal/) gives to a firmware image besides its struct hal_ops. Every port
 * defines each function once. If its chip cannot do it, the function does what its comment says.
 */
#ifndef PORT_H
#define PORT_H

#include "hal.h"

/* The image's kit: its operations and their context. Its board is board_here. */
struct hal port_hal(void);

/* The image's board. The build defines it as the one that BOARD= names. */
extern const struct board *const board_here;

/* Writes text to the log UART (115200 8N1). Returns when all of it is in the transmitter. */
void port_log(const char *text);

/* The next byte from the log UART, or -1 if none waits or the one that came is damaged: a command must not be noise. */
int port_log_read(void);

/* Reboots into the chip's own USB boot loader. Returns if the chip has none. */
void port_boot_loader(void);

/* Ends the image: in an emulator it exits with status, on silicon it waits for ever with the panel dark. */
void port_exit(int status);

/* The most bytes of stack that were used since the start; 0 if that is not known. */
uint32_t port_stack_used(void);

/* How a number of a fact is written: not at all, in decimal digits, or in hexadecimal ones. */
enum port_form { PORT_TEXT, PORT_DECIMAL, PORT_HEX };

/* Takes a piece of a line: a text, and a number behind it. "\n" comes alone and ends the line. */
typedef void (*port_put)(const char *text, uint32_t value, enum port_form form);

/*
 * Tells what the chip says of itself, for people's reports, in lines of less than 80 characters: which chip and
 * revision it is, why it started, what its clocks measure against each other ("not measured" is an answer), how its
 * flash is read. The kit is open and nothing is on its bus. It may take 100 ms.
 */
void port_facts(port_put put);

/* Runs `run(argument)` on the other core; false: there is none, or it has not yet returned from the run before.
 * port_core_join waits until it has, and meanwhile runs what that core gives to this one in the same way. */
bool port_core_run(void (*run)(void *argument), void *argument);
void port_core_join(void);

#endif
