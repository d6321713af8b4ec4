/* riscv: parts of the decoder of RV32IMAC with Zicsr, Zba, Zbb, Zbs and Zbkb. */
#ifndef RISCV_H
#define RISCV_H

#include "chip.h"

/* A compressed instruction (RISC-V ISA manual, volume I, chapter 16) as one of 32 bits; 0: there is none. */
uint32_t riscv_expand(uint32_t code);

/* The result of an OP (0x33) or OP-IMM (0x13) instruction; false: there is none. */
bool riscv_operate(struct core *core, uint32_t code, uint32_t a, uint32_t b, uint32_t *result);
bool riscv_operate_immediate(uint32_t code, uint32_t a, uint32_t *result);

static inline uint32_t riscv_extend(uint32_t value, uint32_t bits)
{
    return (uint32_t)((int32_t)(value << (32 - bits)) >> (32 - bits));
}

#endif
