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

void arm_start(struct core *core, uint32_t vectors, uint32_t stack, uint32_t entry)
{
    core->vtor = vectors;
    core->r[13] = stack & ~3U;
    core->r[14] = UINT32_MAX;
    core->pc = core->next = entry & ~1U;
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
    core_stack_is(core, core->r[13]);
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
                  core->pc);
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
    core_stack_is(core, core->r[13]);
}

void arm_fault(struct core *core)
{
    if (core->ipsr == HARD_FAULT) {
        core_lock_up(core);
    } else {
        enter(core, HARD_FAULT, core->pc);
    }
}

void arm_undefined(struct core *core, uint32_t code)
{
    chip_warn(core->chip, "core %u: no instruction that the model knows: %x at %08x", core->index, code, core->pc);
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
    core->tick_at = core->systick.control & 1 && core->systick.reload > 0
                        ? core->chip->now + cycles * core->chip->sys_cycle
                        : NEVER;
    chip_event_at(core->chip, core->tick_at);
}

static bool systick_due(struct core *core)
{
    if (core->tick_at <= core->chip->now) {
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
        return core->tick_at == NEVER ? 0 : (uint32_t)((core->tick_at - core->chip->now) / core->chip->sys_cycle);
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

bool arm_takes_ticks(const struct core *core)
{
    return core->systick.control >> 1 & 1;
}

/* WFI ends with an interrupt that PRIMASK holds back, too; WFE with one that is taken. */
bool arm_wakes(struct core *core)
{
    return waiting(core) != 0 && core->ipsr == 0 && (core->sleeps_for_interrupt || core->primask == 0);
}

void arm_interrupt(struct core *core)
{
    const uint32_t exception = core->ipsr == 0 && core->primask == 0 ? waiting(core) : 0;
    if (exception != 0) {
        core->systick.pending &= exception != SYSTICK;
        enter(core, exception, core->next);
    }
}

void arm_step(struct core *core)
{
    const uint32_t at = core->pc, first = memory_fetch(core, at), it = core->it;
    const bool is_long = first >= 0xe800, runs = it == 0 || thumb_passes(core, it >> 4);
    core->next = at + (is_long ? 4 : 2);
    core->cycles++;
    core->in_it = it != 0;
    core->after_load = core->loads;
    core->loads = false;
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
