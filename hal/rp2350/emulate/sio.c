/* SIO (3.1): the cores' numbers, pins, FIFOs and spin locks. */
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
    } else {
        chip_warn(chip, "core %u writes SIO's register %x", core->index, offset);
    }
}
