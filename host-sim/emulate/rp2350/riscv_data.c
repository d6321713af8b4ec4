/* See riscv.h: arithmetic. */
#include "riscv.h"

enum { DIVIDE_CYCLES = 17 }; /* beyond the first: Hazard3 finds two bits of a quotient in a cycle */

static uint32_t rotated(uint32_t value, uint32_t right)
{
    return value >> (right & 31) | value << (-right & 31);
}

static uint32_t remainder_of(uint32_t a, uint32_t b, bool is_signed)
{
    if (b == 0) {
        return a;
    }
    return is_signed ? (b == UINT32_MAX ? 0 : (uint32_t)((int32_t)a % (int32_t)b)) : a % b;
}

static uint32_t quotient_of(uint32_t a, uint32_t b, bool is_signed)
{
    if (b == 0) {
        return UINT32_MAX;
    }
    return is_signed ? (b == UINT32_MAX ? -a : (uint32_t)((int32_t)a / (int32_t)b)) : a / b;
}

static uint32_t multiplied(struct core *core, uint32_t kind, uint32_t a, uint32_t b)
{
    core->cycles += kind >= 4 ? DIVIDE_CYCLES : 0;
    switch (kind) {
    case 0:
        return a * b;
    case 1:
        return (uint32_t)((uint64_t)((int64_t)(int32_t)a * (int32_t)b) >> 32);
    case 2:
        return (uint32_t)((uint64_t)((int64_t)(int32_t)a * (int64_t)b) >> 32);
    case 3:
        return (uint32_t)((uint64_t)a * b >> 32);
    case 4:
    case 5:
        return quotient_of(a, b, kind == 4);
    default:
        return remainder_of(a, b, kind == 6);
    }
}

static uint32_t base(uint32_t kind, uint32_t a, uint32_t b)
{
    switch (kind) {
    case 0:
        return a + b;
    case 1:
        return a << (b & 31);
    case 2:
        return (int32_t)a < (int32_t)b;
    case 3:
        return a < b;
    case 4:
        return a ^ b;
    case 5:
        return a >> (b & 31);
    case 6:
        return a | b;
    default:
        return a & b;
    }
}

/* Single bits and rotations; the code is that of upper 7 bits and kind. */
static bool with_bits(uint32_t what, uint32_t a, uint32_t by, uint32_t *result)
{
    const uint32_t bit = 1U << (by & 31);
    switch (what) {
    case 0x205:
        *result = (uint32_t)((int32_t)a >> (by & 31));
        return true;
    case 0x305:
        *result = rotated(a, by);
        return true;
    case 0x141:
        *result = a | bit;
        return true;
    case 0x241:
        *result = a & ~bit;
        return true;
    case 0x245:
        *result = a >> (by & 31) & 1;
        return true;
    case 0x341:
        *result = a ^ bit;
        return true;
    default:
        return false;
    }
}

static bool with_words(uint32_t what, uint32_t a, uint32_t b, uint32_t *result)
{
    const uint32_t kind = what & 7;
    switch (what) {
    case 0x200:
        *result = a - b;
        return true;
    case 0x204:
    case 0x206:
    case 0x207:
        *result = base(kind, a, ~b);
        return true;
    case 0x102:
    case 0x104:
    case 0x106:
        *result = (a << kind / 2) + b;
        return true;
    case 0x044:
        *result = (a & 0xffff) | b << 16;
        return true;
    case 0x047:
        *result = (a & 0xff) | (b & 0xff) << 8;
        return true;
    case 0x054:
    case 0x056:
        *result = ((int32_t)a < (int32_t)b) == (kind == 4) ? a : b;
        return true;
    case 0x055:
    case 0x057:
        *result = (a < b) == (kind == 5) ? a : b;
        return true;
    case 0x301:
        *result = rotated(a, -b);
        return true;
    default:
        return false;
    }
}

bool riscv_operate(struct core *core, uint32_t code, uint32_t a, uint32_t b, uint32_t *result)
{
    const uint32_t kind = chip_bits(code, 12, 3), more = code >> 25, what = more << 4 | kind;
    if (more == 0) {
        *result = base(kind, a, b);
        return true;
    }
    if (more == 1) {
        *result = multiplied(core, kind, a, b);
        return true;
    }
    return with_words(what, a, b, result) || with_bits(what, a, b, result);
}

static uint32_t bits_reversed_in_bytes(uint32_t value)
{
    value = (value & 0x55555555) << 1 | (value >> 1 & 0x55555555);
    value = (value & 0x33333333) << 2 | (value >> 2 & 0x33333333);
    return (value & 0x0f0f0f0f) << 4 | (value >> 4 & 0x0f0f0f0f);
}

static uint32_t bytes_or(uint32_t value)
{
    uint32_t result = 0;
    for (uint32_t i = 0; i < 32; i += 8) {
        result |= (value >> i & 255) != 0 ? 255U << i : 0;
    }
    return result;
}

/* ZIP puts the lower half's bits at even places and the upper half's between them; UNZIP takes them apart. */
static uint32_t zipped(uint32_t value, bool takes_apart)
{
    uint32_t result = 0;
    for (uint32_t i = 0; i < 32; i++) {
        const uint32_t even = i < 16 ? 2 * i : 2 * i - 31;
        result |= takes_apart ? (value >> even & 1) << i : (value >> i & 1) << even;
    }
    return result;
}

/* Runs an instruction with one operand; the immediate says which. */
static bool unary(uint32_t imm, uint32_t kind, uint32_t a, uint32_t *result)
{
    switch (imm << 4 | kind) {
    case 0x6001:
        *result = a == 0 ? 32 : (uint32_t)__builtin_clz(a);
        return true;
    case 0x6011:
        *result = a == 0 ? 32 : (uint32_t)__builtin_ctz(a);
        return true;
    case 0x6021:
        *result = (uint32_t)__builtin_popcount(a);
        return true;
    case 0x6041:
    case 0x6051:
        *result = riscv_extend(a, imm & 1 ? 16 : 8);
        return true;
    case 0x08f1:
    case 0x08f5:
        *result = zipped(a, kind == 5);
        return true;
    case 0x2875:
        *result = bytes_or(a);
        return true;
    case 0x6985:
        *result = __builtin_bswap32(a);
        return true;
    case 0x6875:
        *result = bits_reversed_in_bytes(a);
        return true;
    default:
        return false;
    }
}

bool riscv_operate_immediate(uint32_t code, uint32_t a, uint32_t *result)
{
    const uint32_t kind = chip_bits(code, 12, 3), imm = code >> 20, more = code >> 25;
    if (kind != 1 && kind != 5) {
        *result = base(kind, a, riscv_extend(imm, 12));
        return true;
    }
    if (more == 0) {
        *result = base(kind, a, imm);
        return true;
    }
    return unary(imm, kind, a, result) || with_bits(more << 4 | kind, a, imm, result);
}
