/*
 * emulate_registers: the accesses in QEMU's trace, and what the chip would say to them (registers/registers.h).
 *
 * QEMU has no unit behind some registers, or less of one: they read 0. The model gives what the chip would: the load
 * reads what was written last, and a store right after it keeps those bits. (A read-modify-write that clears bits there
 * is not seen.)
 */
#ifndef EMULATE_REGISTERS_H
#define EMULATE_REGISTERS_H

#include "registers/registers.h"

/* What a line of the trace tells of: an interrupt of SysTick, a store, a load or nothing that counts. */
struct emulate_access {
    bool tick, store, load;
    uint32_t address, value, bytes;
};

struct emulate_registers {
    struct registers *model;
    uint64_t time_ns; /* at least; SysTick's interrupts tell it */
    uint32_t empty;   /* the address that was read as 0 just now; 0: none */
    bool ticks;
    char said[160]; /* the first line that tells of something else: QEMU found something wrong */
};

/* Opens a table of registers. COMPLAINED: not enough memory. */
int emulate_registers_open(struct emulate_registers *r, const struct register_chip *chip);
void emulate_registers_close(struct emulate_registers *r);

/* Takes a line of the trace. COMPLAINED: the chip would not take the access. */
int emulate_registers_line(struct emulate_registers *r, const char *line, struct emulate_access *access);

/* Returns COMPLAINED if QEMU found something wrong. */
int emulate_registers_said(const struct emulate_registers *r);

#endif
