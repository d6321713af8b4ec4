/*
 * A core beside its instructions: exceptions, SysTick, sleep, the private peripheral bus (Arm DDI 0553, B3, B11, D1.2).
 * All interrupts have the same priority, so that none interrupts another; the image that asks for more is told so.
 */
#include "thumb.h"

#include <string.h>

/* Cycles beyond the first. Arm publishes no table for the Cortex-M33: these are the Cortex-M4's (DDI 0439, 3.3.1). */
enum { BRANCH_CYCLES = 2, ENTRY_CYCLES = 12, RETURN_CYCLES = 10 };
enum { HARD_FAULT = 3, SYSTICK = 15, IRQ_0 = 16, LOCKUP_AT = 0xeffffffe };
#define RETURN_TO_THREAD 0xfffffff9

void arm_reset(struct core *core, uint32_t vectors, uint32_t stack, uint32_t entry)
{
    struct core fresh = {.chip = core->chip,
                         .index = core->index,
                         .time = core->chip->now,
                         .idle = core->idle,
                         .lowest = core->lowest,
                         .started = true,
                         .vtor = vectors};
    fresh.r[13] = stack & ~3U;
    fresh.r[14] = UINT32_MAX;
    fresh.r[15] = fresh.next = entry & ~1U;
    fresh.systick.zero = NEVER;
    *core = fresh;
}

static uint32_t status(const struct core *core)
{
    return (uint32_t)core->n << 31 | (uint32_t)core->z << 30 | (uint32_t)core->c << 29 | (uint32_t)core->v << 28 |
           (uint32_t)core->q << 27 | (core->it & 3) << 25 | 1 << 24 | core->ge << 16 | (core->it >> 2) << 10 |
           core->ipsr;
}

static void set_flags(struct core *core, uint32_t status)
{
    core->n = status >> 31;
    core->z = status >> 30 & 1;
    core->c = status >> 29 & 1;
    core->v = status >> 28 & 1;
    core->q = status >> 27 & 1;
    core->ge = status >> 16 & 15;
}

/* An exception's frame goes onto the stack unless that has no room: then the handler finds the stack at its limit. */
static void enter(struct core *core, uint32_t exception, uint32_t return_to)
{
    const uint32_t old = core->r[13], frame = (old - 32) & ~7U;
    const uint32_t words[8] = {core->r[0],  core->r[1],  core->r[2], core->r[3],
                               core->r[12], core->r[14], return_to,  status(core) | (old & 4) << 7};
    core->faulted = false;
    if (frame < core->msplim) {
        core->r[13] = core->msplim;
    } else {
        core->r[13] = frame;
        for (uint32_t i = 0; i < 8; i++) {
            memory_write(core, frame + 4 * i, words[i], 4);
        }
    }
    if (core->r[13] < core->lowest) {
        core->lowest = core->r[13];
    }
    core->ipsr = exception;
    core->it = 0;
    core->r[14] = RETURN_TO_THREAD;
    core->next = memory_read(core, core->vtor + 4 * exception, 4) & ~1U;
    core->event = true;
    core->cycles += ENTRY_CYCLES;
}

static void leave(struct core *core, uint32_t value)
{
    const uint32_t frame = core->r[13];
    uint32_t words[8];
    if (value != RETURN_TO_THREAD) {
        chip_warn(core->chip, "core %u returns from an exception with %08x", core->index, value);
    }
    for (uint32_t i = 0; i < 8; i++) {
        words[i] = memory_read(core, frame + 4 * i, 4);
    }
    memcpy(core->r, words, 4 * sizeof *words);
    core->r[12] = words[4];
    core->r[14] = words[5];
    core->next = words[6] & ~1U;
    set_flags(core, words[7]);
    core->it = (words[7] >> 25 & 3) | (words[7] >> 10 & 63) << 2;
    core->r[13] = (frame + 32) | (words[7] >> 9 & 1) << 2;
    core->ipsr = 0;
    core->event = true;
    core->cycles += RETURN_CYCLES;
}

void arm_branch(struct core *core, uint32_t address)
{
    if (core->faulted) {
        return;
    }
    if (address >= 0xff000000 && core->ipsr != 0) {
        leave(core, address);
        return;
    }
    if ((address & 1) == 0) {
        chip_warn(core->chip, "core %u branches to %08x, which is no Thumb code, at %08x", core->index, address,
                  core->r[15]);
    }
    core->next = address & ~1U;
    core->cycles += BRANCH_CYCLES;
}

/* A stack pointer below its limit is a usage fault, which is off and so becomes a hard fault. */
void arm_set_stack(struct core *core, uint32_t address)
{
    if (address < core->msplim) {
        core->faulted = true;
        return;
    }
    core->r[13] = address & ~3U;
    if (core->r[13] < core->lowest) {
        core->lowest = core->r[13];
    }
}

void arm_fault(struct core *core)
{
    if (core->ipsr == HARD_FAULT) {
        char text[32] = "core 0 locks up";
        text[5] = (char)('0' + core->index);
        core->locked = true;
        core->chip->hooks.trouble(core->chip->hooks.user, text);
    } else {
        enter(core, HARD_FAULT, core->r[15]);
    }
}

void arm_undefined(struct core *core, uint32_t code)
{
    chip_warn(core->chip, "core %u: no instruction that the model knows: %x at %08x", core->index, code, core->r[15]);
}

uint32_t arm_special(const struct core *core, uint32_t number)
{
    switch (number) {
    case 0:
    case 3:
        return (status(core) & 0xf80f0000) | (number == 3 ? core->ipsr : 0);
    case 5:
        return core->ipsr;
    case 8:
        return core->r[13];
    case 10:
        return core->msplim;
    case 16:
        return core->primask;
    case 20:
        return 0; /* CONTROL: privileged, main stack */
    default:
        chip_warn(core->chip, "core %u reads special register %u", core->index, number);
        return 0;
    }
}

void arm_set_special(struct core *core, uint32_t number, uint32_t value)
{
    switch (number) {
    case 0:
        set_flags(core, value);
        break;
    case 8:
        arm_set_stack(core, value);
        break;
    case 10:
        core->msplim = value & ~7U;
        break;
    case 16:
        core->primask = value & 1;
        break;
    default:
        chip_warn(core->chip, "core %u writes special register %u", core->index, number);
        break;
    }
}

/* The counter of SysTick runs with the core's clock: `zero` is when it comes to 0. */
static void systick_start(struct core *core)
{
    const uint64_t cycles = (uint64_t)core->systick.reload + 1;
    core->systick.zero = core->systick.control & 1 && core->systick.reload > 0
                             ? core->chip->now + cycles * core->chip->sys_cycle
                             : NEVER;
    chip_event_at(core->chip, core->systick.zero);
}

static bool systick_due(struct core *core)
{
    if (core->systick.zero <= core->chip->now) {
        systick_start(core);
        core->systick.pending = core->systick.control >> 1 & 1;
    }
    return core->systick.pending;
}

uint32_t arm_private_read(struct core *core, uint32_t address)
{
    switch (address & 0xfff) {
    case 0x010:
        return core->systick.control;
    case 0x014:
        return core->systick.reload;
    case 0x018:
        return core->systick.zero == NEVER ? 0
                                           : (uint32_t)((core->systick.zero - core->chip->now) / core->chip->sys_cycle);
    case 0x100:
    case 0x104:
        return (uint32_t)(core->irq_enabled >> (address & 4) * 8);
    case 0xd08:
        return core->vtor;
    default:
        chip_warn(core->chip, "core %u reads the private register %08x", core->index, address);
        return 0;
    }
}

void arm_private_write(struct core *core, uint32_t address, uint32_t value)
{
    const uint32_t shift = (address & 4) * 8;
    switch (address & 0xfff) {
    case 0x010:
        core->systick.control = value & 7;
        systick_start(core);
        if ((value & 5) == 1) {
            chip_warn(core->chip, "core %u: SysTick counts another clock than the core's", core->index);
        }
        break;
    case 0x014:
        core->systick.reload = value & 0xffffff;
        break;
    case 0x018:
        systick_start(core);
        break;
    case 0x100:
    case 0x104:
        core->irq_enabled |= (uint64_t)value << shift;
        break;
    case 0x180:
    case 0x184:
        core->irq_enabled &= ~((uint64_t)value << shift);
        break;
    case 0xd08:
        core->vtor = value & ~127U;
        break;
    default:
        chip_warn(core->chip, "core %u writes the private register %08x", core->index, address);
        break;
    }
}

/* The exception that would be taken if nothing masked it; 0: none. */
static uint32_t waiting(struct core *core)
{
    const uint64_t irqs = core->irq_enabled & chip_interrupts(core->chip);
    if (systick_due(core)) {
        return SYSTICK;
    }
    return irqs == 0 ? 0 : IRQ_0 + (uint32_t)__builtin_ctzll(irqs);
}

void arm_wait(struct core *core, bool for_interrupt)
{
    if (!for_interrupt && core->event) {
        core->event = false;
        return;
    }
    core->asleep = true;
    core->sleeps_for_interrupt = for_interrupt;
}

static void awake(struct core *core)
{
    core->asleep = false;
    core->chip->limit = core->chip->now; /* it may be another core that runs: this one is behind it */
    if (core->chip->now > core->time) {
        core->idle += core->chip->now - core->time;
        core->time = core->chip->now;
    }
}

void arm_send_event(struct core *core)
{
    if (core->asleep && !core->sleeps_for_interrupt) {
        awake(core);
    } else {
        core->event = true;
    }
}

/* WFI ends with an interrupt that PRIMASK holds back, too; WFE with one that is taken. */
void arm_wake(struct core *core)
{
    const uint32_t exception = waiting(core);
    if (exception != 0 && core->ipsr == 0 && (core->sleeps_for_interrupt || core->primask == 0)) {
        awake(core);
    }
}

static void step(struct core *core)
{
    const uint32_t at = core->next, first = memory_fetch(core, at), it = core->it;
    const bool is_long = first >= 0xe800, runs = it == 0 || thumb_passes(core, it >> 4);
    core->r[15] = at;
    core->next = at + (is_long ? 4 : 2);
    core->cycles++;
    core->in_it = it != 0;
    core->it = it & 7 ? (it & 0xe0) | (it << 1 & 31) : 0;
    if (is_long) {
        const uint32_t second = memory_fetch(core, at + 2);
        if (runs) {
            thumb_run32(core, first, second);
        }
    } else if (runs) {
        thumb_run16(core, first);
    }
    if (core->faulted) {
        core->next = at;
        arm_fault(core);
    }
}

static bool is_call(const struct core *core)
{
    const struct chip *chip = core->chip;
    for (uint32_t i = 0; i < chip->call_count && core->index == 0; i++) {
        if (chip->calls[i] == core->next) {
            return true;
        }
    }
    return false;
}

/* Until then, or until the chip's limit, which falls when an event comes nearer. */
void arm_run(struct core *core, uint64_t until)
{
    struct chip *chip = core->chip;
    chip->limit = until;
    while (core->time < chip->limit && !core->asleep && !core->locked && chip->ended == NULL) {
        chip->now = core->time;
        if (core->ipsr == 0 && core->primask == 0) {
            const uint32_t exception = waiting(core);
            if (exception != 0) {
                core->systick.pending &= exception != SYSTICK;
                enter(core, exception, core->next);
            }
        }
        if (is_call(core)) {
            chip->hooks.call(chip->hooks.user, core);
        }
        if (core->next >= ROM_BYTES || !rom_call(core)) {
            step(core);
        }
        core->time += core->cycles * chip->sys_cycle;
        core->cycles = 0;
    }
}
