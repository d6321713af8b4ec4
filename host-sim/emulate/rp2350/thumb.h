/* thumb: parts of the decoder of the Armv8-M Mainline instruction set with DSP (Arm DDI 0553, C2.4). */
#ifndef THUMB_H
#define THUMB_H

#include "chip.h"

void thumb_run16(struct core *core, uint32_t code);
void thumb_run32(struct core *core, uint32_t first, uint32_t second);

/* thumb_data.c; false: no such instruction. */
bool thumb_immediate(struct core *core, uint32_t first, uint32_t second);
bool thumb_shifted(struct core *core, uint32_t first, uint32_t second);
bool thumb_plain(struct core *core, uint32_t first, uint32_t second);
bool thumb_registers(struct core *core, uint32_t first, uint32_t second);
bool thumb_multiply(struct core *core, uint32_t first, uint32_t second);
bool thumb_long(struct core *core, uint32_t first, uint32_t second);
bool thumb_parallel(struct core *core, uint32_t first, uint32_t second);

enum thumb_shift { THUMB_LSL, THUMB_LSR, THUMB_ASR, THUMB_ROR, THUMB_RRX };

/* Shifts by 0 .. 255; *carry is the last bit that left, or stays. */
uint32_t thumb_shift(uint32_t value, enum thumb_shift how, uint32_t by, bool *carry);
/* Returns a + b + carry, and sets the flags if asked to. */
uint32_t thumb_add(struct core *core, uint32_t a, uint32_t b, bool carry, bool flags);

static inline void thumb_nz(struct core *core, uint32_t value)
{
    core->n = value >> 31;
    core->z = value == 0;
}

static inline uint32_t thumb_extend(uint32_t value, uint32_t bits)
{
    return (uint32_t)((int32_t)(value << (32 - bits)) >> (32 - bits));
}

/* In an instruction the program counter is 4 ahead. */
static inline uint32_t thumb_pc(const struct core *core)
{
    return core->pc + 4;
}

static inline uint32_t thumb_get(const struct core *core, uint32_t number)
{
    return number == 15 ? thumb_pc(core) : core->r[number];
}

static inline void thumb_set(struct core *core, uint32_t number, uint32_t value)
{
    if (number == 13) {
        arm_set_stack(core, value);
    } else if (number == 15) {
        arm_branch(core, value);
    } else {
        core->r[number] = value;
    }
}

/* A load takes two cycles, but one after another load (DDI 0439, 3.3.2). */
static inline uint32_t thumb_load(struct core *core, uint32_t address, uint32_t bytes)
{
    core->cycles += !core->after_load;
    core->loads = true;
    return memory_read(core, address, bytes);
}

bool thumb_passes(const struct core *core, uint32_t condition);

#endif
