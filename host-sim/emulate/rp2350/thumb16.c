/* See thumb.h: instructions of 16 bits. */
#include "thumb.h"

bool thumb_passes(const struct core *core, uint32_t condition)
{
    bool is = true;
    switch (condition >> 1) {
    case 0:
        is = core->z;
        break;
    case 1:
        is = core->c;
        break;
    case 2:
        is = core->n;
        break;
    case 3:
        is = core->v;
        break;
    case 4:
        is = core->c && !core->z;
        break;
    case 5:
        is = core->n == core->v;
        break;
    case 6:
        is = core->n == core->v && !core->z;
        break;
    default:
        return true;
    }
    return is != (condition & 1);
}

uint32_t thumb_add(struct core *core, uint32_t a, uint32_t b, bool carry, bool flags)
{
    const uint64_t sum = (uint64_t)a + b + carry;
    const uint32_t result = (uint32_t)sum;
    if (flags) {
        thumb_nz(core, result);
        core->c = sum >> 32;
        core->v = (~(a ^ b) & (a ^ result)) >> 31;
    }
    return result;
}

uint32_t thumb_shift(uint32_t value, enum thumb_shift how, uint32_t by, bool *carry)
{
    if (how == THUMB_RRX) {
        const uint32_t result = value >> 1 | (uint32_t)*carry << 31;
        *carry = value & 1;
        return result;
    }
    if (by == 0) {
        return value;
    }
    switch (how) {
    case THUMB_LSL:
        *carry = by <= 32 && (by == 32 ? value & 1 : value >> (32 - by) & 1);
        return by < 32 ? value << by : 0;
    case THUMB_LSR:
        *carry = by <= 32 && (value >> (by - 1) & 1);
        return by < 32 ? value >> by : 0;
    case THUMB_ASR:
        by = by < 32 ? by : 32;
        *carry = by == 32 ? value >> 31 : value >> (by - 1) & 1;
        return (uint32_t)((int32_t)value >> (by < 32 ? by : 31));
    default:
        by &= 31;
        value = by == 0 ? value : value >> by | value << (32 - by);
        *carry = value >> 31;
        return value;
    }
}

static void shift_or_add(struct core *core, uint32_t code, bool flags)
{
    const uint32_t d = code & 7, m = code >> 3 & 7, how = code >> 11 & 3;
    uint32_t by = code >> 6 & 31;
    if (how == 3) { /* ADD, SUB of a register or 3 bits */
        const uint32_t b = code >> 10 & 1 ? code >> 6 & 7 : core->r[code >> 6 & 7];
        const bool subtracts = code >> 9 & 1;
        core->r[d] = thumb_add(core, core->r[m], subtracts ? ~b : b, subtracts, flags);
        return;
    }
    bool carry = core->c;
    by = by == 0 && how != THUMB_LSL ? 32 : by;
    core->r[d] = thumb_shift(core->r[m], (enum thumb_shift)how, by, &carry);
    if (flags) {
        thumb_nz(core, core->r[d]);
        core->c = carry;
    }
}

static void with_8_bits(struct core *core, uint32_t code, bool flags)
{
    const uint32_t d = code >> 8 & 7, value = code & 255;
    switch (code >> 11 & 3) {
    case 0:
        core->r[d] = value;
        if (flags) {
            thumb_nz(core, value);
        }
        break;
    case 1:
        thumb_add(core, core->r[d], ~value, true, true);
        break;
    case 2:
        core->r[d] = thumb_add(core, core->r[d], value, false, flags);
        break;
    default:
        core->r[d] = thumb_add(core, core->r[d], ~value, true, flags);
        break;
    }
}

/* Runs the data processing instructions that add or compare; false: it is another one. */
static bool adds(struct core *core, uint32_t what, uint32_t d, uint32_t b, bool flags)
{
    uint32_t *const a = &core->r[d];
    switch (what) {
    case 5:
        *a = thumb_add(core, *a, b, core->c, flags);
        return true;
    case 6:
        *a = thumb_add(core, *a, ~b, core->c, flags);
        return true;
    case 9:
        *a = thumb_add(core, ~b, 0, true, flags);
        return true;
    case 10:
        thumb_add(core, *a, ~b, true, true);
        return true;
    case 11:
        thumb_add(core, *a, b, false, true);
        return true;
    default:
        return false;
    }
}

static void data_processing(struct core *core, uint32_t code, bool flags)
{
    static const enum thumb_shift shifts[16] = {[2] = THUMB_LSL, [3] = THUMB_LSR, [4] = THUMB_ASR, [7] = THUMB_ROR};
    const uint32_t what = code >> 6 & 15, d = code & 7, a = core->r[d], b = core->r[code >> 3 & 7];
    if (adds(core, what, d, b, flags)) {
        return;
    }
    uint32_t result;
    bool carry = core->c;
    switch (what) {
    case 0:
    case 8:
        result = a & b;
        break;
    case 1:
        result = a ^ b;
        break;
    case 12:
        result = a | b;
        break;
    case 13:
        result = a * b;
        break;
    case 14:
        result = a & ~b;
        break;
    case 15:
        result = ~b;
        break;
    default:
        result = thumb_shift(a, shifts[what], b & 255, &carry);
        break;
    }
    if (what != 8) {
        core->r[d] = result;
    }
    if (flags || what == 8) {
        thumb_nz(core, result);
        core->c = carry;
    }
}

/* ADD, CMP, MOV of any registers, BX, BLX. */
static void high_registers(struct core *core, uint32_t code)
{
    const uint32_t d = (code & 7) | (code >> 4 & 8), b = thumb_get(core, code >> 3 & 15);
    switch (code >> 8 & 3) {
    case 0:
        thumb_set(core, d, d == 15 ? (thumb_get(core, d) + b) | 1 : core->r[d] + b);
        break;
    case 1:
        thumb_add(core, thumb_get(core, d), ~b, true, true);
        break;
    case 2:
        thumb_set(core, d, d == 15 ? b | 1 : b);
        break;
    default:
        if (code & 128) {
            core->r[14] = core->next | 1;
        }
        arm_branch(core, b);
        break;
    }
}

static void load_or_store(struct core *core, uint32_t address, uint32_t t, uint32_t what)
{
    switch (what) {
    case 0:
        memory_write(core, address, core->r[t], 4);
        break;
    case 1:
        memory_write(core, address, core->r[t], 2);
        break;
    case 2:
        memory_write(core, address, core->r[t], 1);
        break;
    case 3:
        core->r[t] = thumb_extend(thumb_load(core, address, 1), 8);
        break;
    case 4:
        core->r[t] = thumb_load(core, address, 4);
        break;
    case 5:
        core->r[t] = thumb_load(core, address, 2);
        break;
    case 6:
        core->r[t] = thumb_load(core, address, 1);
        break;
    default:
        core->r[t] = thumb_extend(thumb_load(core, address, 2), 16);
        break;
    }
}

static void with_5_bits(struct core *core, uint32_t code)
{
    static const uint8_t kind[8] = {0, 4, 2, 6, 1, 5}, scale[8] = {2, 2, 0, 0, 1, 1};
    const uint32_t what = (code >> 11) - 12;
    load_or_store(core, core->r[code >> 3 & 7] + ((code >> 6 & 31) << scale[what]), code & 7, kind[what]);
}

static void push(struct core *core, uint32_t list)
{
    const uint32_t address = core->r[13] - 4 * (uint32_t)__builtin_popcount(list);
    uint32_t at = address;
    arm_set_stack(core, address);
    for (uint32_t i = 0; i < 16 && !core->faulted; i++) {
        if (list >> i & 1) {
            memory_write(core, at, core->r[i], 4);
            at += 4;
            core->cycles++;
        }
    }
}

static void pop(struct core *core, uint32_t list)
{
    uint32_t at = core->r[13], target = 0;
    for (uint32_t i = 0; i < 16; i++) {
        if (list >> i & 1) {
            const uint32_t word = memory_read(core, at, 4);
            core->cycles++;
            at += 4;
            if (i == 15) {
                target = word;
            } else {
                core->r[i] = word;
            }
        }
    }
    core->r[13] = at;
    if (list >> 15) {
        arm_branch(core, target);
    }
}

static uint32_t reversed(uint32_t value, uint32_t how)
{
    const uint32_t halves = (value & 0xff00ff) << 8 | (value >> 8 & 0xff00ff);
    return how == 0 ? __builtin_bswap32(value) : how == 1 ? halves : thumb_extend(halves, 16);
}

static void hint(struct core *core, uint32_t what)
{
    switch (what) {
    case 2:
    case 3:
        core_wait(core, what == 3);
        break;
    case 4:
        for (uint32_t i = 0; i < core->chip->cores; i++) {
            core_send_event(&core->chip->core[i]);
        }
        break;
    default:
        break; /* NOP, YIELD */
    }
}

static void extend(struct core *core, uint32_t code)
{
    const uint32_t value = core->r[code >> 3 & 7];
    const uint32_t results[4] = {thumb_extend(value, 16), thumb_extend(value, 8), value & 0xffff, value & 0xff};
    core->r[code & 7] = results[code >> 6 & 3];
}

static void other(struct core *core, uint32_t code)
{
    const uint32_t what = code >> 8 & 15;
    if ((what & 5) == 1) { /* CBZ, CBNZ */
        if ((core->r[code & 7] == 0) != (code >> 11 & 1)) {
            arm_branch(core, (thumb_pc(core) + (code >> 3 & 31) * 2 + (code >> 9 & 1) * 64) | 1);
        }
    } else if (what == 0) {
        const uint32_t by = (code & 127) * 4;
        arm_set_stack(core, code & 128 ? core->r[13] - by : core->r[13] + by);
    } else if (what == 2) {
        extend(core, code);
    } else if ((what & 14) == 4) {
        push(core, (code & 255) | (code & 256) << 6);
    } else if ((what & 14) == 12) {
        pop(core, (code & 255) | (code & 256) << 7);
    } else if ((code & 0xffef) == 0xb662) {
        core->primask = code >> 4 & 1;
    } else if (what == 10 && (code >> 6 & 3) != 2) {
        core->r[code & 7] = reversed(core->r[code >> 3 & 7], code >> 6 & 3);
    } else if (what == 14) {
        rom_breakpoint(core, code & 255);
    } else if (what == 15 && (code & 15) == 0) {
        hint(core, code >> 4 & 15);
    } else if (what == 15) {
        core->it = code & 255;
    } else {
        arm_undefined(core, code);
    }
}

static void multiple(struct core *core, uint32_t code)
{
    const uint32_t n = code >> 8 & 7;
    const bool loads = code >> 11 & 1;
    uint32_t at = core->r[n];
    memory_check_aligned(core, at);
    for (uint32_t i = 0; i < 8; i++) {
        if ((code >> i & 1) == 0) {
            continue;
        }
        if (loads) {
            core->r[i] = memory_read(core, at, 4);
        } else {
            memory_write(core, at, core->r[i], 4);
        }
        at += 4;
        core->cycles++;
    }
    if (!loads || (code >> n & 1) == 0) {
        core->r[n] = at;
    }
}

static void branch(struct core *core, uint32_t code)
{
    const uint32_t condition = code >> 8 & 15;
    if (code >> 12 == 14) {
        arm_branch(core, (thumb_pc(core) + thumb_extend(code << 1, 12)) | 1);
    } else if (condition >= 14) {
        arm_undefined(core, code);
    } else if (thumb_passes(core, condition)) {
        arm_branch(core, (thumb_pc(core) + thumb_extend(code << 1, 9)) | 1);
    }
}

void thumb_run16(struct core *core, uint32_t code)
{
    const bool flags = !core->in_it;
    const uint32_t t = code >> 8 & 7, bytes = (code & 255) * 4;
    switch (code >> 12) {
    case 0:
    case 1:
        shift_or_add(core, code, flags);
        break;
    case 2:
    case 3:
        with_8_bits(core, code, flags);
        break;
    case 4:
        if (code & 0x800) {
            core->r[t] = thumb_load(core, (thumb_pc(core) & ~3U) + bytes, 4);
        } else if (code & 0x400) {
            high_registers(core, code);
        } else {
            data_processing(core, code, flags);
        }
        break;
    case 5:
        load_or_store(core, core->r[code >> 3 & 7] + core->r[code >> 6 & 7], code & 7, code >> 9 & 7);
        break;
    case 9:
        load_or_store(core, core->r[13] + bytes, t, code & 0x800 ? 4 : 0);
        break;
    case 10:
        core->r[t] = (code & 0x800 ? core->r[13] : thumb_pc(core) & ~3U) + bytes;
        break;
    case 11:
        other(core, code);
        break;
    case 12:
        multiple(core, code);
        break;
    case 13:
    case 14:
        branch(core, code);
        break;
    default:
        with_5_bits(core, code);
        break;
    }
}
