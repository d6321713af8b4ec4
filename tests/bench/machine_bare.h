/* machine_bare: what emulated machines without an operating system share. Each has a source of its own: machine_arm.c,
 * machine_riscv.c (these two also share machine_semihost.c), machine_xtensa.c. */
#ifndef MACHINE_BARE_H
#define MACHINE_BARE_H

#include <stdint.h>

/* What a machine gives: the count of instructions since its start, modulo 2^32; the end; the command
 * line, which is the image's name and the words of bench.h with spaces between them. */
uint32_t machine_count(void);
void machine_quit(int status);
void machine_command_line(char *text, uint32_t size);

/* What an Arm or RISC-V machine gives: a call of the emulator. */
void machine_semihost(uint32_t operation, const void *argument);

/* The start of main(), once there are a stack and an output. */
void machine_run(void);

#endif
