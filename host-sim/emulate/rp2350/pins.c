/* Pins of the emulated RP2350 (datasheet 9): IO_BANK0 and PADS_BANK0, and the UART that hangs on two of them (12.1). */
#include "chip.h"

enum { FUNCTION_UART = 2, FUNCTION_SIO = 5, FUNCTION_NONE = 31 };
enum { PAD_PULL_UP = 8, PAD_INPUT = 64, PAD_OFF = 128, PAD_ISOLATED = 256, PAD_AFTER_RESET = 0x116 };
#define PADS    0x40038000
#define BYTE_FS (10 * 1000000000000000ULL / 115200)

void pins_reset(struct chip *chip)
{
    chip->out = chip->out_enable = 0;
    for (uint32_t i = 0; i < PINS; i++) {
        chip->io_control[i] = FUNCTION_NONE;
        chip->pad[i] = PAD_AFTER_RESET;
        chip->pulled_up[i] = NEVER;
    }
}

static bool drives(const struct chip *chip, uint32_t pin)
{
    return (chip->io_control[pin] & 31) == FUNCTION_SIO && (chip->pad[pin] & (PAD_OFF | PAD_ISOLATED)) == 0 &&
           (chip->out_enable >> pin & 1) != 0;
}

/* A pin that nobody drives keeps the level that it had. */
static void update(struct chip *chip)
{
    uint32_t levels = chip->levels;
    for (uint32_t i = 0; i < PINS; i++) {
        if (drives(chip, i)) {
            levels = (levels & ~(1U << i)) | (chip->out & 1U << i);
        }
    }
    if (levels != chip->levels) {
        chip->levels = levels;
        chip->hooks.levels(chip->hooks.user);
    }
}

void pins_set_out(struct chip *chip, uint32_t out, uint32_t enable)
{
    const uint32_t changed = (out ^ chip->out) & enable;
    for (uint32_t i = 0; i < PINS; i++) {
        if ((changed >> i & 1) != 0 && (chip->io_control[i] & 31) == FUNCTION_SIO &&
            (chip->pad[i] & PAD_ISOLATED) != 0) {
            chip_warn(chip, "pin %u is driven, but its pad is isolated", i);
        }
    }
    chip->out = out;
    chip->out_enable = enable;
    update(chip);
}

static bool is_high(struct chip *chip, uint32_t pin)
{
    if (drives(chip, pin)) {
        return chip->out >> pin & 1;
    }
    const bool pulled = (chip->pad[pin] & PAD_PULL_UP) != 0 && chip->now >= chip->pulled_up[pin] + chip->charge;
    return pulled && (chip->low >> pin & 1) == 0;
}

/* A pad whose input is off or that is isolated reads 0. */
uint32_t pins_in(struct chip *chip)
{
    uint32_t levels = 0;
    for (uint32_t i = 0; i < PINS; i++) {
        if ((chip->pad[i] & (PAD_INPUT | PAD_ISOLATED)) == PAD_INPUT && is_high(chip, i)) {
            levels |= 1U << i;
        }
    }
    return levels;
}

/* Whether a pin whose number has these bits has this function and an open pad. */
bool pins_carry(const struct chip *chip, uint32_t function, uint32_t mask, uint32_t equals)
{
    for (uint32_t i = 0; i < PINS; i++) {
        if ((i & mask) == equals && (chip->io_control[i] & 31) == function &&
            (chip->pad[i] & (PAD_OFF | PAD_ISOLATED)) == 0) {
            return true;
        }
    }
    return false;
}

uint32_t pins_read(struct chip *chip, uint32_t address)
{
    const uint32_t offset = address & 0xfff;
    if ((address & ~0xfffU) == PADS) {
        return offset >= 4 && offset < 4 + 4 * PINS ? chip->pad[offset / 4 - 1] : 0;
    }
    if (offset < 8 * PINS && (offset & 4) != 0) {
        return chip->io_control[offset / 8];
    }
    if (offset >= 0x230 && offset < 0x248) {
        return 0; /* no edges: nothing outside moves a pin but buttons */
    }
    chip_warn(chip, "register %x of the pins is not modelled", offset);
    return 0;
}

void pins_write(struct chip *chip, uint32_t address, uint32_t value)
{
    const uint32_t offset = address & 0xfff;
    if ((address & ~0xfffU) == PADS && offset >= 4 && offset < 4 + 4 * PINS) {
        const uint32_t pin = offset / 4 - 1;
        if ((chip->pad[pin] & PAD_PULL_UP) == 0 || (value & PAD_PULL_UP) == 0) {
            chip->pulled_up[pin] = chip->now;
        }
        chip->pad[pin] = value;
    } else if ((address & ~0xfffU) != PADS && offset < 8 * PINS && (offset & 4) != 0) {
        chip->io_control[offset / 8] = value;
    } else if ((address & ~0xfffU) == PADS || offset < 0x230 || offset >= 0x248) {
        chip_warn(chip, "register %x of the pins or pads is not modelled", offset);
    }
    update(chip);
}

enum { UART_DR = 0, UART_FR = 0x18, UART_IBRD = 0x24, UART_FBRD = 0x28, UART_LCR = 0x2c, UART_CR = 0x30 };

uint32_t uart_read(struct chip *chip, uint32_t offset)
{
    const uint64_t behind = chip->uart_free > chip->now ? chip->uart_free - chip->now : 0;
    switch (offset) {
    case UART_DR: {
        const uint8_t byte = chip->uart_in[chip->uart_first % sizeof chip->uart_in];
        chip->uart_first += chip->uart_count > 0;
        chip->uart_count -= chip->uart_count > 0;
        return byte;
    }
    case UART_FR:
        return (chip->uart_count == 0 ? 1 << 4 : 0) | (behind >= 32 * BYTE_FS ? 1 << 5 : 0) |
               (behind > 0 ? 1 << 3 : 1 << 7);
    case UART_CR:
        return chip->uart_control;
    default:
        chip_warn(chip, "register %x of the UART is not modelled", offset);
        return 0;
    }
}

static void send(struct chip *chip, uint8_t byte)
{
    const double baud = chip->peri_hz * 4 / (chip->uart_divisor * 64 + chip->uart_fraction + 1e-9);
    if ((chip->uart_control & 0x101) != 0x101 || baud < 113000 || baud > 117500) {
        chip_warn(chip, "the UART sends, but is off or has %.0f baud", baud);
    } else if (!pins_carry(chip, FUNCTION_UART, 31, 0)) {
        chip_warn(chip, "the UART sends, but no pin carries it");
    }
    chip->uart_free = (chip->uart_free > chip->now ? chip->uart_free : chip->now) + BYTE_FS;
    chip->hooks.uart(chip->hooks.user, byte);
}

void uart_write(struct chip *chip, uint32_t offset, uint32_t value)
{
    switch (offset) {
    case UART_DR:
        send(chip, (uint8_t)value);
        break;
    case UART_IBRD:
        chip->uart_divisor = value;
        break;
    case UART_FBRD:
        chip->uart_fraction = value;
        break;
    case UART_LCR:
        chip->uart_line = value;
        break;
    case UART_CR:
        chip->uart_control = value;
        break;
    default:
        chip_warn(chip, "register %x of the UART is not modelled", offset);
        break;
    }
}

void uart_feed(struct chip *chip, uint8_t byte)
{
    if (chip->uart_count < sizeof chip->uart_in) {
        chip->uart_in[(chip->uart_first + chip->uart_count++) % sizeof chip->uart_in] = byte;
    }
}
