/* The address map of the emulated RP2350 (datasheet 2.2): which memory or peripheral an access reaches. */
#include "chip.h"

#include <string.h>

static const uint8_t *readable(const struct chip *chip, uint32_t address, uint32_t bytes)
{
    if (address - RAM_BASE <= RAM_BYTES - bytes) {
        return chip->ram + (address - RAM_BASE);
    }
    return address <= ROM_BYTES - bytes ? chip->rom + address : NULL;
}

static uint32_t block_read(struct chip *chip, uint32_t block, uint32_t offset)
{
    switch (block) {
    case 0x40028000:
    case 0x40038000:
        return pins_read(chip, block + offset);
    case 0x40070000:
        return uart_read(chip, offset);
    case 0x40080000:
    case 0x40088000:
        return spi_read(chip, block >> 15 & 1, offset);
    case 0x400b0000:
        return timer_read(chip, offset);
    case 0x50000000:
        return dma_read(chip, offset);
    case 0x40040000:
        return qmi_pad_read(chip, offset);
    case 0x400c8000:
        return xip_control_read(chip, offset);
    case 0x400d0000:
        return qmi_read(chip, offset);
    default:
        return clocks_read(chip, block + offset);
    }
}

static void block_write(struct chip *chip, uint32_t block, uint32_t offset, uint32_t value)
{
    switch (block) {
    case 0x40028000:
    case 0x40038000:
        pins_write(chip, block + offset, value);
        break;
    case 0x40070000:
        uart_write(chip, offset, value);
        break;
    case 0x40080000:
    case 0x40088000:
        spi_write(chip, block >> 15 & 1, offset, value);
        break;
    case 0x400b0000:
        timer_write(chip, offset, value);
        break;
    case 0x50000000:
        dma_write(chip, offset, value);
        break;
    case 0x40040000:
        qmi_pad_write(chip, offset, value);
        break;
    case 0x400c8000:
        xip_control_write(chip, offset, value);
        break;
    case 0x400d0000:
        qmi_write(chip, offset, value);
        break;
    default:
        clocks_write(chip, block + offset, value);
        break;
    }
}

/* Whether the chip takes an access, of which the line of registers/ complains; NULL: it does. */
static bool takes(struct core *core, const char *line)
{
    if (line != NULL) {
        chip_warn(core->chip, "core %u at %08x: %s", core->index, core->pc, line);
    }
    return line == NULL;
}

static bool is_private(uint32_t address)
{
    return address >> 12 == 0xe000e;
}

static uint32_t register_read(struct core *core, uint32_t address)
{
    if (is_private(address)) {
        return arm_private_read(core, address);
    }
    if (address >> 15 == 0xd0000000 >> 15) {
        return sio_read(core, address & 0x7fff);
    }
    return block_read(core->chip, address & 0xffff8000, address & 0xfff);
}

static uint32_t io_read(struct core *core, uint32_t address, uint32_t bytes)
{
    struct chip *chip = core->chip;
    chip->now = core->time; /* NOLINT(clang-analyzer-core.NullDereference): every core has its chip */
    const uint32_t value = register_read(core, address & ~3U);
    takes(core, registers_read(chip->registers, core->index, chip->now / FS_PER_NS, address, value, bytes));
    return value;
}

/* A block of 4 KB is there four times: to write, to toggle, to set and to clear bits (2.1.3). */
static void io_write(struct core *core, uint32_t address, uint32_t value, uint32_t bytes)
{
    struct chip *chip = core->chip;
    const uint32_t block = address & 0xffff8000, offset = address & 0xfff;
    chip->now = core->time;
    if (!takes(core, registers_write(chip->registers, core->index, chip->now / FS_PER_NS, address, value, bytes))) {
        return;
    }
    if (is_private(address)) {
        arm_private_write(core, address, value);
    } else if (block == 0xd0000000) {
        sio_write(core, address & 0x7fff, value);
    } else {
        const uint32_t how = address >> 12 & 3, old = how == 0 ? 0 : block_read(chip, block, offset);
        block_write(chip, block, offset,
                    how == 0   ? value
                    : how == 1 ? old ^ value
                    : how == 2 ? old | value
                               : old & ~value);
    }
}

static bool is_flash(uint32_t address)
{
    return address >> 28 == FLASH_BASE >> 28;
}

static bool is_io(uint32_t address)
{
    return (address >> 28 == 4 && address < 0x40110000) || address >> 15 == 0x50000000 >> 15 ||
           address >> 15 == 0xd0000000 >> 15 || is_private(address);
}

uint32_t memory_read(struct core *core, uint32_t address, uint32_t bytes)
{
    const uint8_t *from = readable(core->chip, address, bytes);
    uint32_t value = 0;
    if (from != NULL) {
        memcpy(&value, from, bytes);
        return value;
    }
    if (is_flash(address)) {
        return xip_read(core, address, bytes);
    }
    if (is_io(address)) {
        return io_read(core, address, bytes);
    }
    chip_warn(core->chip, "core %u reads %u bytes at %08x, where nothing is, at %08x", core->index, bytes, address,
              core->pc);
    return 0;
}

void memory_write(struct core *core, uint32_t address, uint32_t value, uint32_t bytes)
{
    if (core->faulted) {
        return;
    }
    if (address - RAM_BASE <= RAM_BYTES - bytes) {
        memcpy(core->chip->ram + (address - RAM_BASE), &value, bytes);
    } else if (is_io(address)) {
        io_write(core, address, value, bytes);
    } else {
        chip_warn(core->chip, "core %u writes %u bytes at %08x, where no RAM is, at %08x", core->index, bytes, address,
                  core->pc);
    }
}

void memory_check_aligned(struct core *core, uint32_t address)
{
    if (address & 3) {
        chip_warn(core->chip, "core %u reads or writes words at %08x with an instruction that needs them aligned",
                  core->index, address);
    }
}

uint32_t memory_fetch(struct core *core, uint32_t address)
{
    if (is_flash(address)) {
        return xip_read(core, address, 2);
    }
    const uint8_t *from = readable(core->chip, address, 2);
    if (from == NULL) {
        chip_warn(core->chip, "core %u runs at %08x, where nothing is", core->index, address);
        return 0xbf00;
    }
    return from[0] | (uint32_t)from[1] << 8;
}

uint32_t memory_dma_read(struct chip *chip, uint32_t address, uint32_t bytes)
{
    const bool of_flash = address - FLASH_BASE <= FLASH_BYTES - bytes && !qmi_is_direct(chip);
    const uint8_t *from = of_flash ? chip->flash + (address - FLASH_BASE) : readable(chip, address, bytes);
    uint32_t value = 0;
    if (from == NULL || address % bytes != 0) {
        chip_warn(chip, "the DMA reads %u bytes at %08x", bytes, address);
    } else {
        memcpy(&value, from, bytes);
    }
    return value;
}
