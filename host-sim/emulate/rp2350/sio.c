/* SIO of the emulated RP2350 (datasheet 3.1): the cores' numbers, pins, FIFOs and spin locks. */
#include "chip.h"

static uint32_t pull(struct core *core)
{
    if (core->fifo_count == 0) {
        chip_warn(core->chip, "core %u read an empty FIFO", core->index);
        return 0;
    }
    const uint32_t word = core->fifo[0];
    core->fifo_count--;
    for (uint32_t i = 0; i < core->fifo_count; i++) {
        core->fifo[i] = core->fifo[i + 1];
    }
    return word;
}

static void push(struct core *core, uint32_t word)
{
    struct chip *chip = core->chip;
    struct core *reader = &chip->core[1 - core->index];
    if (core->index == 0 && chip->cores > 1 && !reader->started) {
        rom_core1_word(chip, word);
    } else if (reader->fifo_count < FIFO_WORDS) {
        reader->fifo[reader->fifo_count++] = word;
    } else {
        chip_warn(chip, "core %u wrote into a full FIFO", core->index);
    }
}

/* The timer (3.1.8) counts cycles when it runs at full speed, the only way that is modelled. */
enum { MTIME_CTRL = 0x1a4, MTIME = 0x1b0, MTIMEH = 0x1b4, MTIMECMP = 0x1b8, MTIMECMPH = 0x1bc, MTIME_RUNS = 3 };

static uint64_t mtime(const struct chip *chip)
{
    const bool runs = chip->mtime_control == MTIME_RUNS;
    return chip->mtime + (runs ? (chip->now - chip->mtime_from) / chip->sys_cycle : 0);
}

static void set_ticks(struct core *core)
{
    const struct chip *chip = core->chip;
    const uint64_t now = mtime(chip);
    core->tick_at = NEVER;
    if (chip->mtime_control == MTIME_RUNS && core->compare <= now) {
        core->tick_at = chip->now;
    } else if (chip->mtime_control == MTIME_RUNS && core->compare - now < 1ULL << 32) {
        core->tick_at = chip->now + (core->compare - now) * chip->sys_cycle;
    }
    chip_event_at(core->chip, core->tick_at);
}

static void set_half(uint64_t *word, bool upper, uint32_t value)
{
    *word = upper ? (*word & UINT32_MAX) | (uint64_t)value << 32 : (*word & ~(uint64_t)UINT32_MAX) | value;
}

static void timer_write_word(struct core *core, uint32_t offset, uint32_t value)
{
    struct chip *chip = core->chip;
    chip->mtime = mtime(chip);
    chip->mtime_from = chip->now;
    if (offset == MTIME_CTRL) {
        chip->mtime_control = value & MTIME_RUNS;
    } else if (offset < MTIMECMP) {
        set_half(&chip->mtime, offset == MTIMEH, value);
    } else {
        set_half(&core->compare, offset == MTIMECMPH, value);
    }
    for (uint32_t i = 0; i < chip->cores; i++) {
        set_ticks(&chip->core[i]);
    }
}

uint32_t sio_read(struct core *core, uint32_t offset)
{
    struct chip *chip = core->chip;
    if (offset >= 0x100 && offset < 0x180) { /* a spin lock: 0 if it was taken before */
        const uint32_t lock = 1U << (offset - 0x100) / 4, free = ~chip->locks & lock;
        chip->locks |= lock;
        return free;
    }
    switch (offset) {
    case 0x00:
        return core->index;
    case 0x04:
        return pins_in(chip);
    case 0x10:
        return chip->out;
    case 0x30:
        return chip->out_enable;
    case 0x50:
        return (core->fifo_count > 0 ? 1 : 0) | (chip->core[1 - core->index].fifo_count < FIFO_WORDS ? 2 : 0);
    case 0x58:
        return pull(core);
    case MTIME:
        return (uint32_t)mtime(chip);
    case MTIMEH:
        return (uint32_t)(mtime(chip) >> 32);
    default:
        chip_warn(chip, "core %u reads SIO's register %x", core->index, offset);
        return 0;
    }
}

void sio_write(struct core *core, uint32_t offset, uint32_t value)
{
    struct chip *chip = core->chip;
    const uint32_t how = offset >> 3 & 3; /* OUT, OUT_SET, OUT_CLR, OUT_XOR lie 8 apart, and so do those of OE */
    if (offset >= 0x10 && offset < 0x50 && (offset & 7) == 0) {
        const bool enables = offset >= 0x30;
        const uint32_t old = enables ? chip->out_enable : chip->out;
        const uint32_t kinds[4] = {old & ~value, old ^ value, value, old | value};
        const uint32_t all = kinds[how];
        pins_set_out(chip, enables ? chip->out : all, enables ? all : chip->out_enable);
    } else if (offset >= 0x100 && offset < 0x180) {
        chip->locks &= ~(1U << (offset - 0x100) / 4);
    } else if (offset == 0x54) {
        push(core, value);
    } else if (offset == MTIME_CTRL || (offset >= MTIME && offset <= MTIMECMPH)) {
        timer_write_word(core, offset, value);
    } else {
        chip_warn(chip, "core %u writes SIO's register %x", core->index, offset);
    }
}
