/* A core of the emulated RP2350, of either instruction set: how it runs, sleeps and wakes. */
#include "chip.h"

#include <stddef.h>

void core_reset(struct core *core, uint32_t vectors, uint32_t stack, uint32_t entry)
{
    struct core fresh = {.chip = core->chip,
                         .index = core->index,
                         .time = core->chip->now,
                         .idle = core->idle,
                         .lowest = core->lowest,
                         .started = true,
                         .tick_at = NEVER,
                         .compare = UINT64_MAX};
    *core = fresh;
    (core->chip->riscv ? riscv_start : arm_start)(core, vectors, stack, entry);
}

/* Makes a core wait: by WFE or h3.block, which an event before it ends, or by WFI. */
void core_wait(struct core *core, bool for_interrupt)
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

void core_send_event(struct core *core)
{
    if (core->asleep && !core->sleeps_for_interrupt) {
        awake(core);
    } else {
        core->event = true;
    }
}

void core_wake(struct core *core)
{
    if ((core->chip->riscv ? riscv_wakes : arm_wakes)(core)) {
        awake(core);
    }
}

void core_stack_is(struct core *core, uint32_t address)
{
    core->lowest = address < core->lowest ? address : core->lowest;
}

void core_lock_up(struct core *core)
{
    char text[] = "core 0 locks up";
    text[5] = (char)('0' + core->index);
    core->locked = true;
    core->chip->hooks.trouble(core->chip->hooks.user, text);
}

void core_fault(struct core *core)
{
    core->pc = core->next;
    (core->chip->riscv ? riscv_fault : arm_fault)(core);
}

uint32_t core_argument(struct core *core, uint32_t number)
{
    if (core->chip->riscv) {
        return core->r[10 + number];
    }
    return number < 4 ? core->r[number] : memory_read(core, core->r[13] + 4 * (number - 4), 4);
}

void core_set_argument(struct core *core, uint32_t number, uint32_t value)
{
    core->r[core->chip->riscv ? 10 + number : number] = value;
}

void core_return(struct core *core)
{
    core->next = core->r[core->chip->riscv ? 1 : 14] & ~1U;
}

uint64_t core_next_tick(const struct core *core)
{
    return (core->chip->riscv ? riscv_takes_ticks : arm_takes_ticks)(core) ? core->tick_at : NEVER;
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

/* Runs a core until a time, or until the chip's limit, which falls when an event comes nearer. */
void core_run(struct core *core, uint64_t until)
{
    struct chip *chip = core->chip;
    chip->limit = until;
    while (core->time < chip->limit && !core->asleep && !core->locked && chip->ended == NULL) {
        chip->now = core->time;
        (chip->riscv ? riscv_interrupt : arm_interrupt)(core);
        core->pc = core->next;
        if (is_call(core)) {
            chip->hooks.call(chip->hooks.user, core);
            core->pc = core->next;
        }
        if (core->next >= ROM_BYTES || !rom_call(core)) {
            (chip->riscv ? riscv_step : arm_step)(core);
        }
        core->time += core->cycles * chip->sys_cycle;
        core->cycles = 0;
    }
}
