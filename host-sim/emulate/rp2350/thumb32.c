/* See thumb.h: loads, stores and branches of 32 bits. */
#include "thumb.h"

static void dual(struct core *core, uint32_t first, uint32_t second)
{
    const uint32_t n = first & 15, t = second >> 12, t2 = second >> 8 & 15, by = (second & 255) * 4;
    const bool before = first >> 8 & 1, up = first >> 7 & 1, back = first >> 5 & 1;
    const uint32_t base = n == 15 ? thumb_pc(core) & ~3U : core->r[n], moved = up ? base + by : base - by;
    const uint32_t at = before ? moved : base;
    memory_check_aligned(core, at);
    if (first >> 4 & 1) {
        const uint32_t low = memory_read(core, at, 4), high = memory_read(core, at + 4, 4);
        core->cycles += 2;
        core->r[t] = low;
        core->r[t2] = high;
    } else {
        memory_write(core, at, core->r[t], 4);
        memory_write(core, at + 4, core->r[t2], 4);
        core->cycles++;
    }
    if (back) {
        thumb_set(core, n, moved);
    }
}

static void table_branch(struct core *core, uint32_t first, uint32_t second)
{
    const uint32_t n = first & 15, index = core->r[second & 15], base = thumb_get(core, n);
    const uint32_t by = second >> 4 & 1 ? thumb_load(core, base + 2 * index, 2) : thumb_load(core, base + index, 1);
    arm_branch(core, (thumb_pc(core) + 2 * by) | 1);
}

/* LDA, STL and their forms for bytes and halves: all cores see the model's memory in one order, so that is no work. */
static void acquire_or_release(struct core *core, uint32_t first, uint32_t second)
{
    const uint32_t bytes = 1u << (second >> 4 & 3), address = core->r[first & 15], t = second >> 12;
    memory_check_aligned(core, address * (4 / bytes));
    if (first & 0x10) {
        thumb_set(core, t, memory_read(core, address, bytes));
    } else {
        memory_write(core, address, core->r[t], bytes);
    }
}

/* LDREX, STREX and their likes are not among what the image uses; they are told as unknown. */
static void dual_or_table(struct core *core, uint32_t first, uint32_t second)
{
    if ((first & 0xfff0) == 0xe8d0 && (second & 0xffe0) == 0xf000) {
        table_branch(core, first, second);
    } else if ((first & 0xffe0) == 0xe8c0 && (second & 0xfcf) == 0xf8f && (second & 0x30) != 0x30) {
        acquire_or_release(core, first, second);
    } else if ((first & 0x120) != 0) {
        dual(core, first, second);
    } else {
        arm_undefined(core, first << 16 | second);
    }
}

static void multiple(struct core *core, uint32_t first, uint32_t list)
{
    const uint32_t n = first & 15, bytes = 4 * (uint32_t)__builtin_popcount(list);
    const bool down = first >> 8 & 1, loads = first >> 4 & 1, back = first >> 5 & 1;
    const uint32_t base = core->r[n], end = down ? base - bytes : base + bytes;
    uint32_t at = down ? end : base, target = 0;
    memory_check_aligned(core, base);
    if (back && !loads) {
        thumb_set(core, n, end);
    }
    for (uint32_t i = 0; i < 16 && !core->faulted; i++) {
        if ((list >> i & 1) == 0) {
            continue;
        }
        if (!loads) {
            memory_write(core, at, i == n ? base : core->r[i], 4);
        } else if (i == 15) {
            target = memory_read(core, at, 4);
        } else {
            core->r[i] = memory_read(core, at, 4);
        }
        at += 4;
        core->cycles++;
    }
    if (back && loads) {
        thumb_set(core, n, end);
    }
    if (loads && list >> 15) {
        arm_branch(core, target);
    }
}

/* The address of a single load or store; false: no such instruction. */
static bool single_address(struct core *core, uint32_t first, uint32_t second, uint32_t *address)
{
    const uint32_t n = first & 15, by = second & 255;
    const uint32_t base = n == 15 ? thumb_pc(core) & ~3U : core->r[n];
    if (n == 15) {
        *address = first >> 7 & 1 ? base + (second & 0xfff) : base - (second & 0xfff);
    } else if (first >> 7 & 1) {
        *address = base + (second & 0xfff);
    } else if ((second & 0xfc0) == 0) {
        *address = base + (core->r[second & 15] << (second >> 4 & 3));
    } else if ((second & 0x800) == 0 || (second & 0x500) == 0) {
        return false;
    } else {
        const uint32_t moved = second >> 9 & 1 ? base + by : base - by;
        *address = second >> 10 & 1 ? moved : base;
        if (second >> 8 & 1) {
            thumb_set(core, n, moved);
        }
    }
    return true;
}

static void single(struct core *core, uint32_t first, uint32_t second)
{
    const uint32_t size = first >> 5 & 3, t = second >> 12;
    const bool loads = first >> 4 & 1, is_signed = first >> 8 & 1;
    const uint32_t stored = core->r[t];
    uint32_t address;
    if (size == 3 || (is_signed && (size == 2 || !loads)) || !single_address(core, first, second, &address)) {
        arm_undefined(core, first << 16 | second);
        return;
    }
    if (core->faulted) {
        return;
    }
    if (!loads) {
        memory_write(core, address, stored, 1U << size);
    } else if (t != 15 || size == 2) { /* else it only prefetches */
        const uint32_t value = thumb_load(core, address, 1U << size);
        thumb_set(core, t, is_signed ? thumb_extend(value, 8U << size) : value);
    }
}

/* Move to and from special registers, barriers, hints. */
static void control(struct core *core, uint32_t first, uint32_t second)
{
    const uint32_t what = first >> 4 & 127;
    if (what == 0x38) {
        arm_set_special(core, second & 255, core->r[first & 15]);
    } else if (what == 0x3e) {
        core->r[second >> 8 & 15] = arm_special(core, second & 255);
    } else if (what == 0x3a && (second & 0x7ff) <= 4) {
        thumb_run16(core, 0xbf00 | (second & 15) << 4);
    } else if (what != 0x3b || (second & 0xf0) < 0x40 || (second & 0xf0) > 0x60) { /* DSB, DMB, ISB */
        arm_undefined(core, first << 16 | second);
    }
}

static void branch(struct core *core, uint32_t first, uint32_t second)
{
    const uint32_t s = first >> 10 & 1, j1 = second >> 13 & 1, j2 = second >> 11 & 1;
    if ((second & 0x5000) == 0) {
        if ((first >> 7 & 7) == 7) {
            control(core, first, second);
        } else if (thumb_passes(core, first >> 6 & 15)) {
            const uint32_t by = s << 20 | j2 << 19 | j1 << 18 | (first & 63) << 12 | (second & 0x7ff) << 1;
            arm_branch(core, (thumb_pc(core) + thumb_extend(by, 21)) | 1);
        }
        return;
    }
    if ((second & 0x1000) == 0) {
        arm_undefined(core, first << 16 | second);
        return;
    }
    const uint32_t i1 = !(j1 ^ s), i2 = !(j2 ^ s);
    const uint32_t by = s << 24 | i1 << 23 | i2 << 22 | (first & 0x3ff) << 12 | (second & 0x7ff) << 1;
    if (second & 0x4000) {
        core->r[14] = core->next | 1;
    }
    arm_branch(core, (thumb_pc(core) + thumb_extend(by, 25)) | 1);
}

void thumb_run32(struct core *core, uint32_t first, uint32_t second)
{
    bool known = true;
    switch (first >> 9 & 15) {
    case 4: /* 11101 00 */
        (first & 64 ? dual_or_table : multiple)(core, first, second);
        break;
    case 5:
        known = thumb_shifted(core, first, second);
        break;
    case 8: /* 11110 */
    case 10:
        if (second & 0x8000) {
            branch(core, first, second);
        } else {
            known = thumb_immediate(core, first, second);
        }
        break;
    case 9:
    case 11:
        if (second & 0x8000) {
            branch(core, first, second);
        } else {
            known = thumb_plain(core, first, second);
        }
        break;
    case 12: /* 11111 00 */
        single(core, first, second);
        break;
    case 13:
        known = first & 0x100 ? (first & 0x80 ? thumb_long : thumb_multiply)(core, first, second)
                              : thumb_registers(core, first, second);
        break;
    default:
        known = false;
        break;
    }
    if (!known) {
        arm_undefined(core, first << 16 | second);
    }
}
