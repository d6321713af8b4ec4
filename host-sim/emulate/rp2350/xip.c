/*
 * The cache before the flash (4.4.1): 16 KB, two ways of 1024 lines of 8 bytes, for both cores. A hit takes no time of
 * its own, for the cycle that it takes stands in the instruction's. A miss reads its line, which qmi.c makes a time of.
 *
 * A line that comes in throws out one of the two that lie where it must lie, at random (4.4.1.3); which one, a
 * generator tells that starts alike each time.
 *
 * CTR_HIT and CTR_ACC (4.4.4) count; the other registers of XIP_CTRL are not modelled.
 *
 * Taken so: a line goes where there is none before it throws out another; a core fetches no line that it does not run;
 * it goes on when the whole line is there; what the DMA reads of the flash takes no time and no line.
 */
#include "chip.h"

#include <string.h>

#define WINDOW_BYTES 0x4000000U
enum { CACHED = 0, UNCACHED = 1 };
enum { CTR_HIT = 0x0c, CTR_ACC = 0x10 };

void xip_reset(struct chip *chip)
{
    memset(&chip->xip, 0, sizeof chip->xip);
}

uint32_t xip_control_read(struct chip *chip, uint32_t offset)
{
    if (offset != CTR_HIT && offset != CTR_ACC) {
        chip_warn(chip, "register %x of XIP_CTRL is not modelled", offset);
    }
    return offset == CTR_HIT ? chip->xip.hits : chip->xip.accesses;
}

/* Any value clears a counter. */
void xip_control_write(struct chip *chip, uint32_t offset, uint32_t value)
{
    (void)value;
    if (offset != CTR_HIT && offset != CTR_ACC) {
        chip_warn(chip, "register %x of XIP_CTRL cannot be written, or is not modelled", offset);
    }
    *(offset == CTR_HIT ? &chip->xip.hits : &chip->xip.accesses) = 0;
}

static void miss(struct core *core, uint32_t line)
{
    struct chip *chip = core->chip;
    uint32_t *ways = chip->xip.line[line % XIP_SETS];
    bool right;
    chip->xip.random = chip->xip.random * 1664525 + 1013904223;
    ways[ways[0] == 0 ? 0 : ways[1] == 0 ? 1 : chip->xip.random >> 31] = line + 1;
    core->cycles += qmi_transfer(core, 8 * line, 8, &right);
    if (qmi_is_marginal(chip)) {
        chip_warn(chip, "core %u reads flash, whose bits change less than 3 ns from where M0_TIMING %08x samples them",
                  core->index, chip->qmi.timing);
    }
}

static void look(struct core *core, uint32_t address)
{
    struct xip *xip = &core->chip->xip;
    const uint32_t line = address / 8, *ways = xip->line[line % XIP_SETS];
    xip->accesses++;
    if (ways[0] == line + 1 || ways[1] == line + 1) {
        xip->hits++;
    } else {
        miss(core, line);
    }
}

/* An uncached read fetches no more than it needs (12.14.1). What is sampled at the wrong time is no use. */
static uint32_t uncached(struct core *core, uint32_t address, uint32_t bytes, uint32_t value)
{
    bool right;
    core->chip->xip.accesses++;
    core->cycles += qmi_transfer(core, address, bytes, &right);
    return right ? value : ~value;
}

uint32_t xip_read(struct core *core, uint32_t address, uint32_t bytes)
{
    struct chip *chip = core->chip;
    const uint32_t window = (address - FLASH_BASE) / WINDOW_BYTES, at = (address - FLASH_BASE) % WINDOW_BYTES;
    uint32_t value = 0;
    if (at > FLASH_BYTES - bytes || (window != CACHED && window != UNCACHED)) {
        chip_warn(chip, "core %u reads %u bytes at %08x, where nothing is, at %08x", core->index, bytes, address,
                  core->pc);
        return 0;
    }
    if (qmi_is_direct(chip)) {
        chip_warn(chip, "core %u reads flash at %08x while the QMI is in direct mode, at %08x", core->index, address,
                  core->pc);
        return 0;
    }
    memcpy(&value, chip->flash + at, bytes);
    if (window == UNCACHED) {
        return uncached(core, at, bytes, value);
    }
    look(core, at);
    if ((at & 7) + bytes > 8) {
        look(core, at + bytes - 1);
    }
    return value;
}
