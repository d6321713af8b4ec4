/* What the boot ROM of the emulated RP2350 does (datasheet 5) once it has taken an image: it starts core 0 and later
 * core 1, and has a table of functions. */
#include "chip.h"

#include <string.h>

enum { LOOKUP = 0x80, REBOOT = 0x90, LOOKUP_AT = 0x16, LOOKUP_AT_RISCV = 0x7dfa, TRAPS = 0x7ffc };

void rom_start(struct chip *chip)
{
    const uint16_t lookup = LOOKUP | (chip->riscv ? 0 : 1);
    memcpy(chip->rom + (chip->riscv ? LOOKUP_AT_RISCV : LOOKUP_AT), &lookup, 2);
    chip->rom[0x10] = 'M';
    chip->rom[0x11] = 'u';
    chip->rom[0x12] = 2;
    core_reset(&chip->core[0], chip->riscv ? TRAPS : chip->vectors, chip->stack, chip->entry);
    chip->core[0].msplim = chip->riscv ? 0 : chip->stack_limit;
}

static void look_up(struct core *core)
{
    const uint32_t code = core_argument(core, 0), mask = core_argument(core, 1);
    if (code != ('R' | 'B' << 8) || mask != (core->chip->riscv ? 1 : 4)) {
        chip_warn(core->chip, "the ROM was asked for a function %x with flags %x", code, mask);
    }
    core_set_argument(core, 0, REBOOT | (core->chip->riscv ? 0 : 1));
    core_return(core);
}

/* Whether the core was at a function of the ROM, which has been done. */
bool rom_call(struct core *core)
{
    switch (core->next) {
    case LOOKUP:
        look_up(core);
        return true;
    case REBOOT:
        if (core_argument(core, 0) != 0x102) {
            chip_warn(core->chip, "the ROM was asked to reboot with flags %x", core_argument(core, 0));
        }
        chip_end(core->chip, "boot loader");
        return true;
    default:
        return false;
    }
}

/* Takes a breakpoint: semihosting's exit. */
void rom_breakpoint(struct core *core, uint32_t number)
{
    if (number == 0xab && core_argument(core, 0) == 0x18) {
        chip_end(core->chip, core_argument(core, 1) == 0x20026 ? "exit" : "exit with an error");
    } else {
        chip_warn(core->chip, "breakpoint %u at %08x", number, core->pc);
    }
}

/* Core 1 waits in the ROM (5.3): it echoes 0, 0, 1, vectors, stack, entry and then starts there. */
void rom_core1_word(struct chip *chip, uint32_t word)
{
    static const uint32_t expected[3] = {0, 0, 1};
    struct core *reader = &chip->core[0];
    if (chip->core1_words < 3 && word != expected[chip->core1_words]) {
        chip->core1_words = 0;
    } else {
        chip->core1_word[chip->core1_words++] = word;
    }
    if (reader->fifo_count < FIFO_WORDS) {
        reader->fifo[reader->fifo_count++] = word;
    }
    core_send_event(reader);
    if (chip->core1_words == 6) {
        chip->core1_words = 0;
        core_reset(&chip->core[1], chip->core1_word[3], chip->core1_word[4], chip->core1_word[5]);
        chip_event_at(chip, chip->now);
    }
}
