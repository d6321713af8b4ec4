/* See riscv.h: compressed instructions. */
#include "riscv.h"

enum { LOAD = 0x03, OP_IMM = 0x13, STORE = 0x23, OP = 0x33, LUI = 0x37, BRANCH = 0x63, JALR = 0x67, JAL = 0x6f };

/* Bits `from` .. of the code go to bit `to` of the result. */
static uint32_t moved(uint32_t code, uint32_t from, uint32_t count, uint32_t to)
{
    return chip_bits(code, from, count) << to;
}

static uint32_t i_type(uint32_t opcode, uint32_t kind, uint32_t d, uint32_t a, uint32_t imm)
{
    return imm << 20 | a << 15 | kind << 12 | d << 7 | opcode;
}

static uint32_t r_type(uint32_t kind, uint32_t more, uint32_t d, uint32_t a, uint32_t b)
{
    return more << 25 | b << 20 | a << 15 | kind << 12 | d << 7 | OP;
}

static uint32_t store(uint32_t a, uint32_t b, uint32_t imm)
{
    return imm >> 5 << 25 | b << 20 | a << 15 | 2 << 12 | (imm & 31) << 7 | STORE;
}

static uint32_t jump(uint32_t code, uint32_t d)
{
    const uint32_t by =
        riscv_extend(moved(code, 12, 1, 11) | moved(code, 11, 1, 4) | moved(code, 9, 2, 8) | moved(code, 8, 1, 10) |
                         moved(code, 7, 1, 6) | moved(code, 6, 1, 7) | moved(code, 3, 3, 1) | moved(code, 2, 1, 5),
                     12);
    return (by >> 20 & 1) << 31 | (by >> 1 & 0x3ff) << 21 | (by >> 11 & 1) << 20 | (by >> 12 & 255) << 12 | d << 7 |
           JAL;
}

static uint32_t branch(uint32_t code, uint32_t kind)
{
    const uint32_t by = riscv_extend(moved(code, 12, 1, 8) | moved(code, 10, 2, 3) | moved(code, 5, 2, 6) |
                                         moved(code, 3, 2, 1) | moved(code, 2, 1, 5),
                                     9);
    return (by >> 12 & 1) << 31 | (by >> 5 & 63) << 25 | (8 + chip_bits(code, 7, 3)) << 15 | kind << 12 |
           (by >> 1 & 15) << 8 | (by >> 11 & 1) << 7 | BRANCH;
}

static uint32_t quadrant0(uint32_t code)
{
    const uint32_t d = 8 + chip_bits(code, 2, 3), a = 8 + chip_bits(code, 7, 3);
    const uint32_t by = moved(code, 10, 3, 3) | moved(code, 6, 1, 2) | moved(code, 5, 1, 6);
    const uint32_t add = moved(code, 11, 2, 4) | moved(code, 7, 4, 6) | moved(code, 6, 1, 2) | moved(code, 5, 1, 3);
    switch (code >> 13) {
    case 0:
        return add == 0 ? 0 : i_type(OP_IMM, 0, d, 2, add);
    case 2:
        return i_type(LOAD, 2, d, a, by);
    case 6:
        return store(a, d, by);
    default:
        return 0;
    }
}

static uint32_t arithmetic(uint32_t code)
{
    static const uint8_t kinds[4] = {0, 4, 6, 7}; /* SUB, XOR, OR, AND */
    const uint32_t d = 8 + chip_bits(code, 7, 3), b = 8 + chip_bits(code, 2, 3), what = chip_bits(code, 5, 2);
    const uint32_t imm = moved(code, 12, 1, 5) | moved(code, 2, 5, 0);
    switch (chip_bits(code, 10, 2)) {
    case 0:
        return imm > 31 ? 0 : i_type(OP_IMM, 5, d, d, imm);
    case 1:
        return imm > 31 ? 0 : i_type(OP_IMM, 5, d, d, imm | 0x400);
    case 2:
        return i_type(OP_IMM, 7, d, d, riscv_extend(imm, 6));
    default:
        return code >> 12 & 1 ? 0 : r_type(kinds[what], what == 0 ? 0x20 : 0, d, d, b);
    }
}

static uint32_t upper_or_stack(uint32_t code, uint32_t d, uint32_t imm)
{
    if (d == 2) {
        const uint32_t by = moved(code, 12, 1, 9) | moved(code, 6, 1, 4) | moved(code, 5, 1, 6) | moved(code, 3, 2, 7) |
                            moved(code, 2, 1, 5);
        return i_type(OP_IMM, 0, 2, 2, riscv_extend(by, 10));
    }
    return imm == 0 ? 0 : riscv_extend(imm, 6) << 12 | d << 7 | LUI;
}

static uint32_t quadrant1(uint32_t code)
{
    const uint32_t d = chip_bits(code, 7, 5), imm = moved(code, 12, 1, 5) | moved(code, 2, 5, 0);
    switch (code >> 13) {
    case 0:
        return i_type(OP_IMM, 0, d, d, riscv_extend(imm, 6));
    case 1:
        return jump(code, 1);
    case 2:
        return i_type(OP_IMM, 0, d, 0, riscv_extend(imm, 6));
    case 3:
        return upper_or_stack(code, d, imm);
    case 4:
        return arithmetic(code);
    case 5:
        return jump(code, 0);
    default:
        return branch(code, code >> 13 & 1);
    }
}

/* Expands C.JR, C.MV, C.EBREAK, C.JALR and C.ADD. */
static uint32_t jump_or_move(uint32_t d, uint32_t b, bool links)
{
    if (b != 0) {
        return r_type(0, 0, d, links ? d : 0, b);
    }
    return d == 0 ? (links ? 0x00100073 : 0) : i_type(JALR, 0, links, d, 0);
}

static uint32_t quadrant2(uint32_t code)
{
    const uint32_t d = chip_bits(code, 7, 5), b = chip_bits(code, 2, 5), bit5 = moved(code, 12, 1, 5);
    switch (code >> 13) {
    case 0:
        return bit5 ? 0 : i_type(OP_IMM, 1, d, d, b);
    case 2:
        return d == 0 ? 0 : i_type(LOAD, 2, d, 2, bit5 | moved(code, 4, 3, 2) | moved(code, 2, 2, 6));
    case 4:
        return jump_or_move(d, b, bit5);
    case 6:
        return store(2, b, moved(code, 9, 4, 2) | moved(code, 7, 2, 6));
    default:
        return 0;
    }
}

uint32_t riscv_expand(uint32_t code)
{
    return (code & 3) == 0 ? quadrant0(code) : (code & 3) == 1 ? quadrant1(code) : quadrant2(code);
}
