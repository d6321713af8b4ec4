/* See thumb.h: data processing of 32 bits. */
#include "thumb.h"

static uint32_t expand(uint32_t imm, bool *carry)
{
    const uint32_t byte = imm & 255;
    switch (imm >> 8) {
    case 0:
        return byte;
    case 1:
        return byte << 16 | byte;
    case 2:
        return byte << 24 | byte << 8;
    case 3:
        return byte * 0x01010101;
    default:
        return thumb_shift(0x80 | (imm & 127), THUMB_ROR, imm >> 7, carry);
    }
}

static uint32_t imm12(uint32_t first, uint32_t second)
{
    return (first >> 10 & 1) << 11 | (second >> 12 & 7) << 8 | (second & 255);
}

/* The instruction's operation with a and b; *writes: it has a result. */
static bool logical(const struct core *core, uint32_t what, uint32_t n, uint32_t b, uint32_t *result)
{
    const uint32_t a = thumb_get(core, n);
    switch (what) {
    case 0:
        *result = a & b;
        return true;
    case 1:
        *result = a & ~b;
        return true;
    case 2:
        *result = n == 15 ? b : a | b;
        return true;
    case 3:
        *result = n == 15 ? ~b : a | ~b;
        return true;
    case 4:
        *result = a ^ b;
        return true;
    default:
        return false;
    }
}

static bool arithmetic(struct core *core, uint32_t what, uint32_t a, uint32_t b, bool flags, uint32_t *result)
{
    switch (what) {
    case 8:
        *result = thumb_add(core, a, b, false, flags);
        return true;
    case 10:
        *result = thumb_add(core, a, b, core->c, flags);
        return true;
    case 11:
        *result = thumb_add(core, a, ~b, core->c, flags);
        return true;
    case 13:
        *result = thumb_add(core, a, ~b, true, flags);
        return true;
    case 14:
        *result = thumb_add(core, ~a, b, true, flags);
        return true;
    default:
        return false;
    }
}

static bool operate(struct core *core, uint32_t first, uint32_t d, uint32_t b, bool carry)
{
    const uint32_t what = first >> 5 & 15, n = first & 15;
    const bool flags = first >> 4 & 1;
    uint32_t result;
    if (logical(core, what, n, b, &result)) {
        if (flags) {
            thumb_nz(core, result);
            core->c = carry;
        }
    } else if (!arithmetic(core, what, thumb_get(core, n), b, flags, &result)) {
        return false;
    }
    if (d != 15 || !flags) { /* else it only compares or tests */
        thumb_set(core, d, result);
    }
    return true;
}

bool thumb_immediate(struct core *core, uint32_t first, uint32_t second)
{
    bool carry = core->c;
    const uint32_t b = expand(imm12(first, second), &carry);
    return operate(core, first, second >> 8 & 15, b, carry);
}

bool thumb_shifted(struct core *core, uint32_t first, uint32_t second)
{
    const uint32_t by = (second >> 12 & 7) << 2 | (second >> 6 & 3), how = second >> 4 & 3, m = core->r[second & 15];
    if ((first >> 5 & 15) == 6) { /* PKHBT, PKHTB */
        const uint32_t n = core->r[first & 15], asr = (uint32_t)((int32_t)m >> (by == 0 ? 31 : by));
        core->r[second >> 8 & 15] =
            how == 2 ? (n & 0xffff0000) | (asr & 0xffff) : (n & 0xffff) | (m << by & 0xffff0000);
        return (first & 16) == 0 && (how & 1) == 0;
    }
    bool carry = core->c;
    const enum thumb_shift shift = how == 3 && by == 0 ? THUMB_RRX : (enum thumb_shift)how;
    const uint32_t b = thumb_shift(m, shift, by == 0 && (how == 1 || how == 2) ? 32 : by, &carry);
    return operate(core, first, second >> 8 & 15, b, carry);
}

/* Saturates to so many bits, signed or from 0. */
static uint32_t saturate(struct core *core, int64_t value, uint32_t bits, bool is_unsigned)
{
    const int64_t most = is_unsigned ? (1LL << bits) - 1 : (1LL << (bits - 1)) - 1, least = is_unsigned ? 0 : -most - 1;
    if (value > most || value < least) {
        core->q = true;
        value = value > most ? most : least;
    }
    return (uint32_t)value;
}

static bool saturates(struct core *core, uint32_t first, uint32_t second)
{
    const uint32_t by = (second >> 12 & 7) << 2 | (second >> 6 & 3), n = core->r[first & 15];
    const bool is_unsigned = first >> 7 & 1, asr = first >> 5 & 1;
    const uint32_t bits = (second & 31) + !is_unsigned;
    if (asr && by == 0) { /* SSAT16, USAT16 */
        const uint32_t low = saturate(core, (int16_t)n, bits, is_unsigned);
        const uint32_t high = saturate(core, (int16_t)(n >> 16), bits, is_unsigned);
        core->r[second >> 8 & 15] = high << 16 | (low & 0xffff);
        return true;
    }
    const int32_t value = asr ? (int32_t)n >> by : (int32_t)(n << by);
    core->r[second >> 8 & 15] = saturate(core, value, bits, is_unsigned);
    return true;
}

/* Runs SBFX, UBFX, BFI, BFC. */
static bool bit_field(struct core *core, uint32_t first, uint32_t second)
{
    const uint32_t what = first >> 4 & 31, low = (second >> 12 & 7) << 2 | (second >> 6 & 3), n = first & 15;
    uint32_t *const d = &core->r[second >> 8 & 15];
    if (what == 0x16) {
        const uint32_t high = second & 31;
        if (high < low) {
            return false;
        }
        const uint32_t mask = (high - low == 31 ? UINT32_MAX : (1U << (high - low + 1)) - 1) << low;
        *d = (*d & ~mask) | (n == 15 ? 0 : core->r[n] << low & mask);
        return true;
    }
    const uint32_t bits = (second & 31) + 1;
    if (low + bits > 32) {
        return false;
    }
    const uint32_t up = core->r[n] << (32 - low - bits);
    *d = what == 0x14 ? (uint32_t)((int32_t)up >> (32 - bits)) : up >> (32 - bits);
    return true;
}

bool thumb_plain(struct core *core, uint32_t first, uint32_t second)
{
    const uint32_t what = first >> 4 & 31, d = second >> 8 & 15, n = first & 15, imm = imm12(first, second);
    const uint32_t base = n == 15 ? thumb_pc(core) & ~3U : core->r[n];
    switch (what) {
    case 0x00:
        thumb_set(core, d, base + imm);
        return true;
    case 0x0a:
        thumb_set(core, d, base - imm);
        return true;
    case 0x04:
        core->r[d] = n << 12 | imm;
        return true;
    case 0x0c:
        core->r[d] = (core->r[d] & 0xffff) | n << 28 | imm << 16;
        return true;
    case 0x10:
    case 0x12:
    case 0x18:
    case 0x1a:
        return saturates(core, first, second);
    case 0x14:
    case 0x16:
    case 0x1c:
        return bit_field(core, first, second);
    default:
        return false;
    }
}

/* Runs SXTAH, UXTAH, SXTAB16, UXTAB16, SXTAB, UXTAB, and their forms without a sum, where n is 15. */
static bool extends(struct core *core, uint32_t first, uint32_t second)
{
    const uint32_t what = first >> 4 & 7, by = (second >> 4 & 3) * 8, m = core->r[second & 15], n = first & 15;
    const uint32_t value = by == 0 ? m : m >> by | m << (32 - by), add = n == 15 ? 0 : core->r[n];
    const bool is_unsigned = what & 1;
    uint32_t result;
    if (what >> 1 == 1) {
        const uint32_t low = is_unsigned ? value & 255 : thumb_extend(value, 8);
        const uint32_t high = is_unsigned ? value >> 16 & 255 : thumb_extend(value >> 16, 8);
        result = ((add >> 16) + high) << 16 | ((add + low) & 0xffff);
    } else if (what >> 1 == 3) {
        return false;
    } else {
        const uint32_t bits = what < 2 ? 16 : 8;
        result = add + (is_unsigned ? value & ((1U << bits) - 1) : thumb_extend(value, bits));
    }
    core->r[second >> 8 & 15] = result;
    return true;
}

static uint32_t with_bits_reversed(uint32_t value)
{
    uint32_t result = 0;
    for (uint32_t i = 0; i < 32; i++) {
        result |= (value >> i & 1) << (31 - i);
    }
    return result;
}

/* Computes QADD, QDADD, QSUB, QDSUB. */
static uint32_t saturating_sum(struct core *core, uint32_t how, int32_t n, int32_t m)
{
    int64_t b = n;
    if (how & 1) {
        b = (int32_t)saturate(core, 2 * b, 32, false);
    }
    return saturate(core, how & 2 ? m - b : m + b, 32, false);
}

static bool miscellaneous(struct core *core, uint32_t first, uint32_t second)
{
    const uint32_t what = (first >> 2 & 12) | (second >> 4 & 3), m = core->r[second & 15], n = core->r[first & 15];
    const uint32_t halves = (m & 0xff00ff) << 8 | (m >> 8 & 0xff00ff);
    uint32_t result = 0;
    switch (what) {
    case 4:
        result = __builtin_bswap32(m);
        break;
    case 5:
        result = halves;
        break;
    case 6:
        result = with_bits_reversed(m);
        break;
    case 7:
        result = thumb_extend(halves, 16);
        break;
    case 8:
        for (uint32_t i = 0; i < 4; i++) {
            result |= (core->ge >> i & 1 ? n : m) & 255U << 8 * i;
        }
        break;
    case 12:
        result = m == 0 ? 32 : (uint32_t)__builtin_clz(m);
        break;
    default:
        if (what > 3) {
            return false;
        }
        result = saturating_sum(core, what, (int32_t)n, (int32_t)m);
        break;
    }
    core->r[second >> 8 & 15] = result;
    return true;
}

bool thumb_registers(struct core *core, uint32_t first, uint32_t second)
{
    if ((second & 0xf000) != 0xf000) {
        return false;
    }
    if ((first & 0x80) == 0 && (second & 0xf0) == 0) { /* shifts */
        bool carry = core->c;
        const uint32_t result =
            thumb_shift(core->r[first & 15], (enum thumb_shift)(first >> 5 & 3), core->r[second & 15] & 255, &carry);
        if (first & 16) {
            thumb_nz(core, result);
            core->c = carry;
        }
        core->r[second >> 8 & 15] = result;
        return true;
    }
    if ((first & 0x80) == 0) {
        return (second & 0x80) != 0 && (second & 0x40) == 0 && extends(core, first, second);
    }
    if ((second & 0x80) == 0) {
        return thumb_parallel(core, first, second);
    }
    return (second & 0x40) == 0 && (first & 0x40) == 0 && miscellaneous(core, first, second);
}
