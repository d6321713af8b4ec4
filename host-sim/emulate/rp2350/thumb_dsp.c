/* See thumb.h: multiplications and packed halves. */
#include "thumb.h"

static int32_t half(uint32_t value, bool top)
{
    return (int16_t)(top ? value >> 16 : value);
}

/* What adds to a sum of 32 bits and does not saturate sets Q when the sum does not fit. */
static uint32_t accumulate(struct core *core, int64_t product, uint32_t a)
{
    const int64_t sum = a == 15 ? product : product + (int32_t)core->r[a];
    core->q |= sum != (int32_t)sum;
    return (uint32_t)sum;
}

static uint32_t absolute_differences(uint32_t n, uint32_t m)
{
    uint32_t sum = 0;
    for (uint32_t i = 0; i < 32; i += 8) {
        const int32_t by = (int32_t)(n >> i & 255) - (int32_t)(m >> i & 255);
        sum += (uint32_t)(by < 0 ? -by : by);
    }
    return sum;
}

/* The upper half of a product, to or from a sum, rounded if asked to. */
static uint32_t upper_half(const struct core *core, int64_t product, uint32_t a, bool subtracts, bool rounds)
{
    const uint64_t sum = a == 15 ? 0 : (uint64_t)core->r[a] << 32;
    return (uint32_t)(((subtracts ? sum - (uint64_t)product : sum + (uint64_t)product) + (rounds ? 1U << 31 : 0)) >>
                      32);
}

bool thumb_multiply(struct core *core, uint32_t first, uint32_t second)
{
    const uint32_t what = first >> 4 & 7, n = core->r[first & 15], m = core->r[second & 15], a = second >> 12;
    const bool n_top = second >> 5 & 1, m_top = second >> 4 & 1;
    const uint32_t swapped = m_top ? m >> 16 | m << 16 : m; /* of those that take both halves */
    uint32_t *const d = &core->r[second >> 8 & 15];
    if ((second & 0xc0) != 0 || (n_top && what != 1 && what != 0)) {
        return false;
    }
    switch (what) {
    case 0:
        if (n_top || (m_top && a == 15)) {
            return false;
        }
        *d = m_top ? core->r[a] - n * m : n * m + (a == 15 ? 0 : core->r[a]);
        core->cycles += a != 15;
        return true;
    case 1:
        *d = accumulate(core, (int64_t)half(n, n_top) * half(m, m_top), a);
        return true;
    case 2:
    case 4: {
        const int64_t low = (int64_t)half(n, false) * half(swapped, false),
                      high = (int64_t)half(n, true) * half(swapped, true);
        *d = accumulate(core, what == 2 ? low + high : low - high, a);
        return true;
    }
    case 3:
        *d = accumulate(core, (int64_t)(int32_t)n * half(m, m_top) >> 16, a);
        return true;
    case 5:
    case 6:
        *d = upper_half(core, (int64_t)(int32_t)n * (int32_t)m, a, what == 6, m_top);
        return true;
    default:
        *d = absolute_differences(n, m) + (a == 15 ? 0 : core->r[a]);
        return !m_top;
    }
}

/* Arm gives a division's time by the digits of its result (DDI 0439, table 3-1: 2 to 12 cycles). */
static void divide(struct core *core, uint32_t n, uint32_t m, bool is_signed, uint32_t *d)
{
    const uint32_t size_n = n == 0 ? 0 : 32 - (uint32_t)__builtin_clz(is_signed && (int32_t)n < 0 ? -n : n);
    const uint32_t size_m = m == 0 ? 32 : 32 - (uint32_t)__builtin_clz(is_signed && (int32_t)m < 0 ? -m : m);
    core->cycles += 1 + (size_n > size_m ? (size_n - size_m) / 3 : 0);
    if (m == 0) {
        *d = 0;
    } else if (is_signed) {
        *d = m == UINT32_MAX ? -n : (uint32_t)((int32_t)n / (int32_t)m);
    } else {
        *d = n / m;
    }
}

bool thumb_long(struct core *core, uint32_t first, uint32_t second)
{
    const uint32_t what = first >> 4 & 7, sub = second >> 4 & 15, n = core->r[first & 15], m = core->r[second & 15];
    uint32_t *const low = &core->r[second >> 12], *const high = &core->r[second >> 8 & 15];
    const uint64_t sum = (uint64_t)*high << 32 | *low;
    const uint64_t product_signed = (uint64_t)((int64_t)(int32_t)n * (int32_t)m), product = (uint64_t)n * m;
    const uint32_t swapped = sub & 1 ? m >> 16 | m << 16 : m;
    const int64_t lows = (int64_t)half(n, false) * half(swapped, false),
                  highs = (int64_t)half(n, true) * half(swapped, true);
    uint64_t result;
    if (what == 1 || what == 3) {
        divide(core, n, m, what == 1, high);
        return sub == 15;
    }
    if (what == 0 && sub == 0) {
        result = product_signed;
    } else if (what == 2 && sub == 0) {
        result = product;
    } else if (what == 4 && sub == 0) {
        result = sum + product_signed;
    } else if (what == 6 && sub == 0) {
        result = sum + product;
    } else if (what == 6 && sub == 6) {
        result = product + *low + *high;
    } else if (what == 4 && sub >> 2 == 2) {
        result = sum + (uint64_t)((int64_t)half(n, sub >> 1 & 1) * half(m, sub & 1));
    } else if ((what == 4 || what == 5) && sub >> 1 == 6) {
        result = sum + (uint64_t)(what == 4 ? lows + highs : lows - highs);
    } else {
        return false;
    }
    *low = (uint32_t)result;
    *high = (uint32_t)(result >> 32);
    return true;
}

/* One part of a parallel sum or difference; *ge: it did not borrow, or it carried. */
static uint32_t part(int32_t a, int32_t b, bool subtracts, uint32_t bits, uint32_t how, bool *ge)
{
    const bool is_unsigned = how & 4;
    const int32_t value = subtracts ? a - b : a + b, ones = (1 << bits) - 1;
    const int32_t most = is_unsigned ? ones : ones >> 1, least = is_unsigned ? 0 : -most - 1;
    *ge = is_unsigned && !subtracts ? value > ones : value >= 0;
    switch (how & 3) {
    case 1:
        return (uint32_t)(value > most ? most : value < least ? least : value) & (uint32_t)ones;
    case 2:
        return (uint32_t)(value >> 1) & (uint32_t)ones;
    default:
        return (uint32_t)value & (uint32_t)ones;
    }
}

static int32_t lane(uint32_t value, uint32_t at, uint32_t bits, bool is_unsigned)
{
    const uint32_t up = value << (32 - at - bits);
    return is_unsigned ? (int32_t)(up >> (32 - bits)) : (int32_t)up >> (32 - bits);
}

bool thumb_parallel(struct core *core, uint32_t first, uint32_t second)
{
    const uint32_t what = first >> 4 & 7, how = second >> 4 & 7, n = core->r[first & 15], m = core->r[second & 15];
    const uint32_t bits = what == 0 || what == 4 ? 8 : 16;
    const bool crosses = what == 2 || what == 6, is_unsigned = how & 4;
    uint32_t result = 0, ge = 0;
    if (what == 3 || what == 7 || (how & 3) == 3) {
        return false;
    }
    for (uint32_t at = 0; at < 32; at += bits) {
        bool part_ge;
        const bool subtracts = what == 2 ? at == 0 : what == 6 ? at != 0 : what >= 4;
        const int32_t b = lane(m, crosses ? 16 - at : at, bits, is_unsigned);
        result |= part(lane(n, at, bits, is_unsigned), b, subtracts, bits, how, &part_ge) << at;
        ge |= (part_ge ? (1U << bits / 8) - 1 : 0) << at / 8;
    }
    if ((how & 3) == 0) {
        core->ge = ge;
    }
    core->r[second >> 8 & 15] = result;
    return true;
}
