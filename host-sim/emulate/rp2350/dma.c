/* DMA of the emulated RP2350 (datasheet 12.6): channels that read memory and write to an SPI unit at its pace. The
 * chip's table of registers refuses what is not modelled. */
#include "chip.h"

enum { EN = 1, INCR_READ = 1 << 4, BSWAP = 1 << 24, BUSY = 1 << 26, REQUEST_SPI1_TX = 26 };

static uint32_t swapped(uint32_t word, uint32_t bytes)
{
    return bytes == 1 ? word : bytes == 2 ? (word >> 8 | word << 8) & 0xffff : __builtin_bswap32(word);
}

static void feed(struct chip *chip, uint32_t number)
{
    struct channel *channel = &chip->channel[number];
    const uint32_t unit = (channel->control >> 17 & 63) == REQUEST_SPI1_TX, bytes = 1U << (channel->control >> 2 & 3);
    while (channel->busy && spi_wants(chip, unit)) {
        const uint32_t word = memory_dma_read(chip, channel->read, bytes);
        channel->read += channel->control & INCR_READ ? bytes : 0;
        channel->busy = --channel->count > 0;
        spi_push(chip, unit, channel->control & BSWAP ? swapped(word, bytes) : word);
        chip->dma_interrupts |= channel->busy ? 0 : 1U << number;
    }
}

void dma_feed(struct chip *chip)
{
    for (uint32_t i = 0; i < CHANNELS; i++) {
        if (chip->channel[i].busy) {
            feed(chip, i);
        }
    }
}

static void trigger(struct chip *chip, uint32_t number)
{
    struct channel *channel = &chip->channel[number];
    if ((channel->control & EN) == 0 || channel->reload == 0) {
        return;
    }
    channel->count = channel->reload;
    channel->busy = true;
    feed(chip, number);
}

/* Each of the four groups has the registers in an order of its own; a write to the last of a group starts. */
enum field { READ, WRITE, COUNT, CONTROL };
static const uint8_t fields[16] = {READ,    WRITE, COUNT, CONTROL, CONTROL, READ,  WRITE, COUNT,
                                   CONTROL, COUNT, READ,  WRITE,   CONTROL, WRITE, COUNT, READ};

uint32_t dma_read(struct chip *chip, uint32_t offset)
{
    if (offset < 0x40 * CHANNELS) {
        const struct channel *channel = &chip->channel[offset / 0x40];
        const uint32_t words[4] = {channel->read, channel->write, channel->count,
                                   channel->control | (channel->busy ? BUSY : 0)};
        return words[fields[offset / 4 % 16]];
    }
    switch (offset) {
    case 0x400:
        return chip->dma_interrupts;
    case 0x404:
    case 0x414:
        return chip->dma_enabled[offset >> 4 & 1];
    case 0x40c:
    case 0x41c:
        return chip->dma_interrupts & chip->dma_enabled[offset >> 4 & 1];
    default:
        chip_warn(chip, "register %x of the DMA is not modelled", offset);
        return 0;
    }
}

void dma_write(struct chip *chip, uint32_t offset, uint32_t value)
{
    if (offset < 0x40 * CHANNELS) {
        struct channel *channel = &chip->channel[offset / 0x40];
        uint32_t *const words[4] = {&channel->read, &channel->write, &channel->reload, &channel->control};
        if (channel->busy) {
            chip_warn(chip, "DMA channel %u is set up while it works", offset / 0x40);
        }
        *words[fields[offset / 4 % 16]] = value;
        if (offset / 4 % 4 == 3) {
            trigger(chip, offset / 0x40);
        }
        return;
    }
    switch (offset) {
    case 0x400:
    case 0x40c:
    case 0x41c:
        chip->dma_interrupts &= ~value;
        break;
    case 0x404:
    case 0x414:
        chip->dma_enabled[offset >> 4 & 1] = value & 0xffff;
        break;
    default:
        chip_warn(chip, "register %x of the DMA is not modelled", offset);
        break;
    }
}
