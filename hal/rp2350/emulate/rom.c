/* What the boot ROM does (5): it looks for the image definition, starts core 0 and later core 1, has a table of
 * functions. */
#include "chip.h"

#include <string.h>

#define BLOCK_START 0xffffded3
#define BLOCK_END   0xab123579
#define SEARCHED    4096
enum { LOOKUP = 0x80, REBOOT = 0x90, LOOKUP_AT = 0x16, LOOKUP_AT_RISCV = 0x7dfa };
enum {
    ITEM_IMAGE_TYPE = 0x42,
    ITEM_ENTRY = 0x44,
    ITEM_LAST = 0xff,
    TYPE_EXE = 1,
    CPU_ARM = 0,
    CPU_RISCV = 1,
    CHIP_RP2350 = 1
};

static uint32_t word_at(const uint8_t *from)
{
    uint32_t word;
    memcpy(&word, from, 4);
    return word;
}

/* Image type (5.9.3.1): 3:0 is it a program, 5:4 security, 10:8 CPU, 14:12 chip. */
static const char *type_is_wrong(struct chip *chip, uint32_t type)
{
    const uint32_t cpu = chip_bits(type, 8, 3), security = chip_bits(type, 4, 2);
    chip->riscv = cpu == CPU_RISCV;
    if ((type & 15) != TYPE_EXE) {
        return "the image definition is not that of a program";
    }
    if (chip_bits(type, 12, 3) != CHIP_RP2350) {
        return "the image definition is for another chip";
    }
    if (cpu != CPU_ARM && cpu != CPU_RISCV) {
        return "the image definition is for no CPU of this chip";
    }
    return security != (chip->riscv ? 0 : 2) ? "the image definition has the wrong security" : NULL;
}

/* The items of a block (5.9.1) up to the last; returns its offset, or 0 when there is none. */
static uint32_t read_items(struct chip *chip, const uint8_t *block, uint32_t bytes, uint32_t *type)
{
    uint32_t at = 4;
    while (at + 12 <= bytes && block[at] != ITEM_LAST) {
        const uint32_t words = block[at] & 0x80 ? block[at + 1] | (uint32_t)block[at + 2] << 8 : block[at + 1];
        if (block[at] == ITEM_IMAGE_TYPE) {
            *type = 0x10000 | word_at(block + at) >> 16;
        } else if (block[at] == ITEM_ENTRY) {
            chip->entry = word_at(block + at + 4);
            chip->stack = word_at(block + at + 8);
        }
        at += 4 * (words == 0 ? bytes : words);
    }
    return at + 12 > bytes ? 0 : at;
}

/* The last item has the number of words before it; an offset to the next block and the end mark follow. */
static const char *block_is_wrong(struct chip *chip, const uint8_t *block, uint32_t bytes)
{
    uint32_t type = 0;
    const uint32_t last = read_items(chip, block, bytes, &type);
    if (last == 0 || chip_bits(word_at(block + last), 8, 16) != last / 4 - 1 ||
        word_at(block + last + 8) != BLOCK_END) {
        return "the image definition has no proper end";
    }
    if (word_at(block + last + 4) != 0) {
        return "the image definition leads to another block, which is not modelled";
    }
    return type == 0 ? "the block in the first 4 KB defines no image" : type_is_wrong(chip, type & 0xffff);
}

const char *rom_refuses(struct chip *chip, const uint8_t *image, uint32_t bytes)
{
    const uint32_t searched = bytes < SEARCHED ? bytes : SEARCHED;
    for (uint32_t at = 0; at + 16 <= searched; at += 4) {
        if (word_at(image + at) == BLOCK_START) {
            return block_is_wrong(chip, image + at, searched - at);
        }
    }
    return "there is no image definition in the first 4 KB";
}

/* Where no entry is named, Arm cores find it in the vectors and RISC-V cores at the first byte (5.9.3.4). */
void rom_start(struct chip *chip)
{
    const uint16_t lookup = LOOKUP | (chip->riscv ? 0 : 1);
    uint32_t entry = chip->entry, stack = chip->stack;
    memcpy(chip->rom + (chip->riscv ? LOOKUP_AT_RISCV : LOOKUP_AT), &lookup, 2);
    chip->rom[0x10] = 'M';
    chip->rom[0x11] = 'u';
    chip->rom[0x12] = 2;
    if (entry == 0) {
        entry = chip->riscv ? FLASH_BASE : word_at(chip->flash + 4);
        stack = chip->riscv ? RAM_BASE + RAM_BYTES : word_at(chip->flash);
    }
    core_reset(&chip->core[0], chip->riscv ? 0x7ffc : FLASH_BASE, stack, entry);
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

/* Semihosting's exit. */
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
