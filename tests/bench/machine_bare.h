/* machine_bare: what emulated machines without an operating system share. Each has a source of its own: machine_arm.c,
 * machine_riscv.c. */
#ifndef MACHINE_BARE_H
#define MACHINE_BARE_H

#include <stdint.h>

/* What a machine gives: the count of instructions since its start, modulo 2^32, and a call of the emulator (Arm's
 * "Semihosting for AArch32 and AArch64", whose numbers RISC-V has, too). */
uint32_t machine_count(void);
void machine_semihost(uint32_t operation, const void *argument);

/* The start of main(), once there are a stack and an output, and its end. */
void machine_run(void);
void machine_quit(int status);

#endif
