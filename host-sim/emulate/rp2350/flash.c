/*
 * The flash beside an RP2350: Winbond's W25Q, as on a Pico 2, or others. It answers to commands of bytes (direct mode)
 * and to reads from memory. W25Q16JV data sheet, 8.1 (status registers, continuous read in 8.2), 9.6 (times); JEDEC
 * JESD216 (SFDP).
 *
 * Which flash it is, its JEDEC id tells: EFh 40h.. is a W25Q, EFh 30h.. an older one that has no four lines; any other
 * has four lines as W25Q has, and tells so only if it has SFDP. Without SFDP only GigaDevice's (C8h) knows the
 * continuous read.
 */
#include "chip.h"

#include <stdlib.h>
#include <string.h>

#define FS_PER_NS  1000000ULL
#define SHSL2_NS   50 /* tSHSL2: between commands other than reads */
#define WINBOND    0xef
#define GIGADEVICE 0xc8
enum { STATUS2_QE = 2, MODE_CONTINUES = 0x20, MODE_MASK = 0x30, SFDP_TABLE = 0x80 };
enum { PREFIX_LEN = 1 << 12 };

static bool is_w25q(const struct flash_chip *flash)
{
    return flash->id[0] == WINBOND && flash->id[1] >= 0x40;
}

static bool has_four_lines(const struct flash_chip *flash)
{
    return flash->id[0] != WINBOND || is_w25q(flash);
}

static bool reads_on(const struct flash_chip *flash)
{
    return is_w25q(flash) || flash->id[0] == GIGADEVICE || flash->has_sfdp;
}

bool flash_is(struct flash_chip *flash, const char *text)
{
    char *end;
    const unsigned long id = strtoul(text, &end, 16);
    if (end != text + 6) {
        return false;
    }
    *flash = (struct flash_chip){
        .id = {(uint8_t)(id >> 16), (uint8_t)(id >> 8), (uint8_t)id}, .earliest_fs = 5000000, .latest_fs = 7500000};
    flash->has_sfdp = is_w25q(flash);
    while (*end == ',') {
        const char *word = end + 1;
        const size_t length = strcspn(word, ",");
        end += 1 + length;
        if (memchr(word, ':', length) != NULL) {
            flash->earliest_fs = strtoul(word, NULL, 10) * 1000;
            flash->latest_fs = strtoul(strchr(word, ':') + 1, NULL, 10) * 1000;
        } else if (strncmp(word, "locked", length) == 0) {
            flash->locked = true;
        } else if (strncmp(word, "sfdp", length) == 0) {
            flash->has_sfdp = true;
        } else {
            flash->status[1] = (uint8_t)strtoul(word, NULL, 16);
        }
    }
    return *end == '\0';
}

/* The ROM ends the continuous read before it uses the flash. QE, which is set until power-off, stays. */
void flash_reset(struct flash_chip *flash)
{
    flash->continuous = flash->volatile_write = flash->selected = false;
    flash->released = 0;
}

/* RP2350 data sheet 5: the ROM tries EBh, BBh, 0Bh and 03h, in this order, until it reads an image definition. */
uint32_t flash_rom_command(const struct flash_chip *flash)
{
    if (!has_four_lines(flash)) {
        return 0x0b;
    }
    return (flash->status[1] & STATUS2_QE) != 0 ? 0xeb : 0xbb;
}

/* JESD216: a header, that of one table, and the table's words that say how to read on four lines: 1-4-4 by EBh with 4 +
 * 2 clocks, 0-4-4 by mode bits Axh, QE is bit 1 of status register 2. */
static uint8_t sfdp_byte(uint32_t at)
{
    static const uint8_t head[16] = {'S', 'F', 'D', 'P', 6, 1, 0, 0xff, 0, 6, 1, 16, SFDP_TABLE, 0, 0, 0xff};
    static const uint32_t table[16] = {0xfff920e5, 0x01ffffff, 0x6b08eb44,
                                       0xbb803b08, [14] = 5 << 20 | 4 << 16 | 3 << 9};
    if (at < sizeof head) {
        return head[at];
    }
    return at >= SFDP_TABLE && at < SFDP_TABLE + sizeof table ? (uint8_t)(table[(at - SFDP_TABLE) / 4] >> 8 * (at & 3))
                                                              : 0xff;
}

static uint8_t answer(struct chip *chip)
{
    struct flash_chip *flash = &chip->flash_chip;
    const uint32_t n = flash->count - 1;
    const uint8_t *bytes = flash->bytes;
    switch (bytes[0]) {
    case 0x9f:
        return n >= 1 && n <= 3 ? flash->id[n - 1] : 0;
    case 0x05:
        return n > 0 ? flash->status[0] : 0;
    case 0x35:
        return n > 0 && has_four_lines(flash) ? flash->status[1] : 0;
    case 0x5a: /* three bytes of address, one that counts for nothing */
        return n >= 5 && flash->has_sfdp ? sfdp_byte((bytes[1] << 16 | bytes[2] << 8 | bytes[3]) + n - 5) : 0xff;
    case 0x50:
    case 0x01:
        return 0;
    default:
        chip_warn(chip, "the flash got a command %02x, which is not modelled", bytes[0]);
        return 0;
    }
}

/* A write of the status registers that is not volatile takes up to 15 ms, and wears them. */
static void end_command(struct chip *chip)
{
    struct flash_chip *flash = &chip->flash_chip;
    if (flash->count > 0 && flash->bytes[0] == 0x01) {
        if (!flash->volatile_write || flash->count != 3) {
            chip_warn(chip, "the flash's status registers are written without 50h, or not both of them");
        } else if (!flash->locked && has_four_lines(flash)) {
            flash->status[0] = flash->bytes[1];
            flash->status[1] = flash->bytes[2];
        }
    }
    flash->volatile_write = flash->count == 1 && flash->bytes[0] == 0x50;
    flash->count = 0;
}

void flash_select(struct chip *chip, bool selected)
{
    struct flash_chip *flash = &chip->flash_chip;
    if (flash->selected && !selected) {
        end_command(chip);
        flash->released = chip->now;
    } else if (!flash->selected && selected && chip->now - flash->released < SHSL2_NS * FS_PER_NS) {
        chip_warn(chip, "the flash is selected again after %u ns, its tSHSL2 is %u",
                  (uint32_t)((chip->now - flash->released) / FS_PER_NS), SHSL2_NS);
    }
    flash->selected = selected;
}

uint8_t flash_byte(struct chip *chip, uint8_t byte)
{
    struct flash_chip *flash = &chip->flash_chip;
    if (flash->continuous) {
        chip_warn(chip, "the flash got a command %02x, but expects an address: it reads on", byte);
    }
    if (flash->count < sizeof flash->bytes) {
        flash->bytes[flash->count] = byte;
    }
    flash->count++;
    return answer(chip);
}

/* The phases of a read that a flash knows; RFMT without the prefix. */
struct read {
    uint8_t command;
    uint32_t rfmt;
    double most_hz;
};

static const struct read *read_of(uint32_t command)
{
    static const struct read reads[] = {
        {0x03, 0, 50e6},
        {0x0b, 2 << 16, 133e6},
        {0xbb, 2 << 14 | 0x154, 133e6},
        {0xeb, 4 << 16 | 2 << 14 | 0x2a8, 133e6},
    };
    for (uint32_t i = 0; i < sizeof reads / sizeof *reads; i++) {
        if (reads[i].command == command) {
            return &reads[i];
        }
    }
    return NULL;
}

/* Widths of phases that are not there do not count. */
static uint32_t phases(uint32_t rfmt)
{
    const uint32_t no_dummy = (rfmt & 7 << 16) == 0 ? 3 << 6 : 0, no_suffix = (rfmt & 3 << 14) == 0 ? 3 << 4 : 0;
    const uint32_t prefix = (rfmt & PREFIX_LEN) == 0 ? 3 : PREFIX_LEN;
    return rfmt & ~(no_dummy | no_suffix | prefix);
}

void flash_begin_read(struct chip *chip, uint32_t rfmt, uint32_t rcmd, double sck_hz)
{
    struct flash_chip *flash = &chip->flash_chip;
    const uint32_t command = flash->continuous ? 0xeb : rcmd & 255, mode = rcmd >> 8;
    const struct read *read = read_of(command);
    if (flash->continuous != ((rfmt & PREFIX_LEN) == 0)) {
        chip_warn(chip, "flash is read %s a command, which the flash %s", flash->continuous ? "with" : "without",
                  flash->continuous ? "takes for an address" : "expects");
    } else if (read == NULL || phases(rfmt) != phases(read->rfmt)) {
        chip_warn(chip, "flash is read by %02x with RFMT %08x, which is not how it answers", command, rfmt);
    } else if (command == 0xeb && (!has_four_lines(flash) || (flash->status[1] & STATUS2_QE) == 0)) {
        chip_warn(chip, "flash is read on four lines, but its QE is 0");
    } else if (sck_hz > read->most_hz) {
        chip_warn(chip, "flash is read by %02x at %.1f MHz", command, sck_hz / 1e6);
    }
    flash->continuous = command == 0xeb && reads_on(flash) && (mode & MODE_MASK) == MODE_CONTINUES;
    if (command == 0xbb && (mode & MODE_MASK) == MODE_CONTINUES) {
        chip_warn(chip, "a continuous read on two lines is not modelled");
    }
}
