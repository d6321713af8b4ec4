/* SPI of the emulated RP2350 (datasheet 12.3): two PL022, which send a word after the other from a FIFO; what they
 * receive nobody reads. */
#include "chip.h"

enum { CR0 = 0x00, CR1 = 0x04, DR = 0x08, SR = 0x0c, CPSR = 0x10, DMACR = 0x24 };
enum { FIFO_DEPTH = 8, FUNCTION_SPI = 1, PIN_CLOCK = 2, PIN_SEND = 3 };

static uint32_t bits_of(const struct spi *spi)
{
    return (spi->cr0 & 15) + 1;
}

/* A word takes its bits at the unit's clock and, unless SPH is set, a pause (hal/chips/spi_clock.h). */
static void start_word(struct chip *chip, uint32_t unit)
{
    struct spi *spi = &chip->spi[unit];
    const bool sph = spi->cr0 >> 7 & 1;
    const uint32_t prescaler = spi->cpsr & 0xfe;
    if ((spi->cr1 & 2) == 0 || prescaler == 0 || chip->peri_hz <= 0) {
        chip_warn(chip, "a word was written to SPI%u, which is off or has no clock", unit);
        spi->count = 0;
        return;
    }
    if (!pins_carry(chip, FUNCTION_SPI, 11, unit << 3 | PIN_CLOCK) ||
        !pins_carry(chip, FUNCTION_SPI, 11, unit << 3 | PIN_SEND)) {
        chip_warn(chip, "SPI%u sends, but no pin carries its clock or its data", unit);
    }
    spi->hz = chip->peri_hz / (prescaler * (1.0 + (spi->cr0 >> 8 & 255)));
    spi->word = spi->fifo[spi->first % FIFO_DEPTH];
    spi->first++;
    spi->count--;
    spi->busy = true;
    spi->start = chip->now;
    spi->end = chip->now + (chip->free_wire ? 0 : (uint64_t)((bits_of(spi) + (sph ? 0 : 1.5)) * 1e15 / spi->hz));
    chip->hooks.word_start(chip->hooks.user);
    chip_event_at(chip, spi->end);
}

bool spi_wants(const struct chip *chip, uint32_t unit)
{
    return (chip->spi[unit].dmacr & 2) != 0 && chip->spi[unit].count < FIFO_DEPTH;
}

void spi_push(struct chip *chip, uint32_t unit, uint32_t word)
{
    struct spi *spi = &chip->spi[unit];
    if (spi->count == FIFO_DEPTH) {
        chip_warn(chip, "a word was written into the full FIFO of SPI%u", unit);
        return;
    }
    spi->fifo[(spi->first + spi->count++) % FIFO_DEPTH] = (uint16_t)(word & ((2U << (spi->cr0 & 15)) - 1));
    if (!spi->busy) {
        start_word(chip, unit);
    }
}

void spi_event(struct chip *chip, uint32_t unit)
{
    struct spi *spi = &chip->spi[unit];
    spi->busy = false;
    chip->hooks.word(chip->hooks.user, spi, bits_of(spi));
    if (spi->count > 0) {
        start_word(chip, unit);
    }
    dma_feed(chip);
}

uint32_t spi_read(struct chip *chip, uint32_t unit, uint32_t offset)
{
    const struct spi *spi = &chip->spi[unit];
    switch (offset) {
    case CR0:
        return spi->cr0;
    case CR1:
        return spi->cr1;
    case SR:
        return (spi->count == 0 ? 1 : 0) | (spi->count < FIFO_DEPTH ? 2 : 0) | (spi->busy ? 16 : 0);
    case CPSR:
        return spi->cpsr;
    case DMACR:
        return spi->dmacr;
    default:
        chip_warn(chip, "register %x of SPI%u is not modelled", offset, unit);
        return 0;
    }
}

void spi_write(struct chip *chip, uint32_t unit, uint32_t offset, uint32_t value)
{
    struct spi *spi = &chip->spi[unit];
    switch (offset) {
    case CR0:
        spi->cr0 = value;
        break;
    case CR1:
        spi->cr1 = value;
        break;
    case DR:
        spi_push(chip, unit, value);
        break;
    case CPSR:
        spi->cpsr = value;
        break;
    case DMACR:
        spi->dmacr = value;
        dma_feed(chip);
        break;
    default:
        chip_warn(chip, "register %x of SPI%u is not modelled", offset, unit);
        break;
    }
}
