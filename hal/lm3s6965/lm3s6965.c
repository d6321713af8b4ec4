/*
 * Port to the Stellaris LM3S6965: SSI0, GPIO, UART0. Register addresses and bits are those of the LM3S6965 data sheet.
 *
 * bus_write returns when all bytes are in the FIFO: a frame of this kit's panel is 4 KB, and the chip has no DMA.
 */
#include "board.h"
#include "port.h"
#include "chips/pl011.h"
#include "chips/spi_clock.h"
#include "chips/cortexm/start.h"

#define DID0  REG32(0x400FE000)
#define DID1  REG32(0x400FE004)
#define RIS   REG32(0x400FE050)
#define RESC  REG32(0x400FE05C)
#define RCC   REG32(0x400FE060)
#define RCGC1 REG32(0x400FE104)
#define RCGC2 REG32(0x400FE108)

#define SSI_CR0  REG32(0x40008000)
#define SSI_CR1  REG32(0x40008004)
#define SSI_DR   REG32(0x40008008)
#define SSI_SR   REG32(0x4000800C)
#define SSI_CPSR REG32(0x40008010)
#define SR_TNF   2U
#define SR_RNE   4U
#define SR_BSY   16U

#define UART_DR   REG32(0x4000C000)
#define UART_FR   REG32(0x4000C018)
#define UART_IBRD REG32(0x4000C024)
#define UART_FBRD REG32(0x4000C028)
#define UART_LCRH REG32(0x4000C02C)
#define UART_CTL  REG32(0x4000C030)
#define FR_BUSY   8U
#define FR_RXFE   16U
#define FR_TXFF   32U

#define GPIO_DIR   0x400
#define GPIO_AFSEL 0x420
#define GPIO_PUR   0x510
#define GPIO_DEN   0x51C

#define CLOCK_HZ      SPI_CLOCK_LM3S6965_HZ
#define CRYSTAL_READS 262144U /* 131 ms, if a read and its loop take 6 clocks of 12 MHz */

#define CARD_SELECT BOARD_PORT('D', 0) /* the SD card's chip select, on the same bus; it must be high */

static struct {
    const struct board *board;
    uint32_t stuck; /* buttons that were down at the start: each counts after it was up once */
    int early;      /* the byte that came before the UART was set up, or -1 */
} kit;

/* ---- pins ------------------------------------------------------------------------------------------ */

static uint32_t gpio_base(uint32_t pin)
{
    const uint32_t port = pin / 32;
    return port < 4 ? 0x40004000U + 0x1000 * port : 0x40024000U + 0x1000 * (port - 4);
}

static void gpio_set_bit(uint32_t pin, uint32_t offset)
{
    REG32(gpio_base(pin) + offset) |= 1U << pin % 32;
}

/* Sets a pin. The address within the data register is the mask of the pins that are read or written. */
static void gpio_write(uint32_t pin, bool high)
{
    REG32(gpio_base(pin) + (4U << pin % 32)) = high ? 0xFF : 0;
}

static bool gpio_read(uint32_t pin)
{
    return REG32(gpio_base(pin) + (4U << pin % 32)) != 0;
}

static void gpio_output(uint32_t pin, bool high)
{
    gpio_set_bit(pin, GPIO_DEN);
    gpio_write(pin, high);
    gpio_set_bit(pin, GPIO_DIR);
}

static void gpio_function(uint32_t pin)
{
    gpio_set_bit(pin, GPIO_AFSEL);
    gpio_set_bit(pin, GPIO_DEN);
}

/* ---- start, log ------------------------------------------------------------------------------------- */

/*
 * Starts the clock: an 8 MHz crystal and the PLL give 200 MHz / 4. After a reset the main oscillator is off. It is
 * given the time to start that StellarisWare's SysCtlClockSet gives it; the chip runs on its internal oscillator
 * meanwhile.
 */
static void start_clock(void)
{
    const uint32_t bypass = 1U << 11, use_divider = 1U << 22, oscillators = 3U << 4 | 3U, internal = 1U << 4;
    const uint32_t fields = 15U << 23 | 1U << 13 | 15U << 6 | 3U << 4;
    RCC = (RCC & ~(use_divider | oscillators)) | bypass | internal; /* both oscillators run */
    for (uint32_t i = 0; i < CRYSTAL_READS; i++) {
        (void)RIS;
    }
    RCC = (RCC & ~fields) | 3U << 23 | 14U << 6;               /* the main oscillator is the clock, the PLL is on */
    RCC |= use_divider | 2U;                                   /* the internal oscillator is off */
    for (uint32_t i = 0; i < 100000 && (RIS & 64) == 0; i++) { /* the PLL locks within 0.5 ms */
    }
    RCC &= ~bypass;
}

/* Sets the UART up for the clock that start_clock() makes, and leaves it off. An emulator gives bytes to a UART that is
 * off, so the FIFO is there before the crystal starts. */
static void set_up_uart(void)
{
    kit.early = (UART_FR & FR_RXFE) != 0 ? -1 : pl011_byte(UART_DR); /* the set-up empties the FIFO */
    UART_CTL = 0;
    UART_IBRD = 27; /* 50 MHz / 16 / 115200 = 27 + 8 / 64 */
    UART_FBRD = 8;
    UART_LCRH = 0x70; /* 8N1, FIFO */
    gpio_function(BOARD_PORT('A', 0));
    gpio_function(BOARD_PORT('A', 1));
}

uint32_t port_start(void)
{
    RCGC1 |= 0x11; /* UART0, SSI0 */
    RCGC2 |= 0x3F; /* ports A .. F */
    (void)RCGC2;   /* the first access must come three clocks later */
    (void)RCGC2;
    set_up_uart();
    start_clock();
    UART_CTL = 0x301; /* on */
    return CLOCK_HZ;
}

/* Tells why the chip was reset. Bits of RESC add up until somebody clears them. */
void port_facts(port_put put) /* calls fact */
{
    static const char *const reasons[] = {" the reset pin;", " power on;", " brown-out;",
                                          " the watchdog;",  " software;", " the LDO;"};
    const uint32_t resc = RESC;
    put("chip LM3S, ids ", DID0, PORT_HEX);
    put(" ", DID1, PORT_HEX);
    put("\n", 0, PORT_TEXT);
    put("started by (since power on):", 0, PORT_TEXT);
    for (uint32_t i = 0; i < sizeof reasons / sizeof reasons[0]; i++) {
        put((resc >> i & 1) != 0 ? reasons[i] : "", 0, PORT_TEXT);
    }
    put(" (reasons ", resc, PORT_HEX);
    put(")", 0, PORT_TEXT);
    put("\n", 0, PORT_TEXT);
    put((RIS & 64) != 0 ? "clock of the 8 MHz crystal by the PLL, not measured: kHz "
                        : "clock not known, because the PLL is not locked; should be kHz ",
        CLOCK_HZ / 1000, PORT_DECIMAL);
    put("\n", 0, PORT_TEXT);
}

void port_log(const char *text) /* called as put */
{
    for (; *text != '\0'; text++) {
        while ((UART_FR & FR_TXFF) != 0) {
        }
        UART_DR = (uint8_t)*text;
    }
}

int port_log_read(void)
{
    const int early = kit.early;
    kit.early = -1;
    return early >= 0 || (UART_FR & FR_RXFE) != 0 ? early : pl011_byte(UART_DR);
}

void port_boot_loader(void)
{
}

/* ---- the kit ---------------------------------------------------------------------------------------- */

static uint32_t buttons_down(void)
{
    uint32_t down = 0;
    for (uint32_t i = 0; i < kit.board->button_count; i++) {
        const struct board_button *button = &kit.board->buttons[i];
        down |= gpio_read(button->pin.number) != button->pin.active_low ? button->button : 0U;
    }
    return down;
}

static void open_buttons(void)
{
    for (uint32_t i = 0; i < kit.board->button_count; i++) {
        const struct board_pin *pin = &kit.board->buttons[i].pin;
        gpio_set_bit(pin->number, GPIO_DEN);
        gpio_set_bit(pin->number, GPIO_PUR);
    }
    cortexm_delay_us(NULL, 10); /* the pull-ups charge the lines */
    kit.stuck = buttons_down();
}

/* Reads what came in and drops it: a transmitter may stop when the receive FIFO is full (QEMU's does). */
static void drain(void)
{
    while ((SSI_SR & SR_RNE) != 0) {
        (void)SSI_DR;
    }
}

static int lm3s6965_bus_wait(void *context)
{
    (void)context;
    while ((SSI_SR & SR_BSY) != 0) {
        drain();
    }
    drain();
    return HAL_OK;
}

/* Sets the clock of the bus. The data sheet wants SSE 0 for every change (Synchronous Serial Interface, Initialization
 * and Configuration). */
static void set_clock(uint32_t prescaler, uint32_t control)
{
    SSI_CR1 = 0;
    SSI_CPSR = prescaler;
    SSI_CR0 = control;
    SSI_CR1 = 2; /* on, master */
}

static int32_t lm3s6965_bus_clock(void *context, uint32_t hz)
{
    const struct spi_clock_pl022 clock = spi_clock_pl022(CLOCK_HZ, hz);
    if (clock.hz == 0) {
        return HAL_EINVAL;
    }
    lm3s6965_bus_wait(context);
    set_clock(clock.prescaler, (SSI_CR0 & 0xFF) | clock.scr << 8);
    return (int32_t)clock.hz;
}

static int lm3s6965_bus_write(void *context, enum hal_dc dc, const uint8_t *bytes, size_t n)
{
    lm3s6965_bus_wait(context); /* D/C may move now */
    gpio_write(kit.board->pins.dc.number, dc == HAL_DATA);
    for (size_t i = 0; i < n; i++) {
        while ((SSI_SR & SR_TNF) == 0) {
            drain();
        }
        SSI_DR = bytes[i];
        drain();
    }
    return HAL_OK;
}

static int lm3s6965_open(void *context, const struct board *board)
{
    const struct board_pins *pins = &board->pins;
    (void)context;
    kit.board = board;
    gpio_output(CARD_SELECT, true);
    gpio_output(pins->select.number, !pins->select.active_low);
    gpio_output(pins->dc.number, false);
    gpio_function(pins->clock.number);
    gpio_function(pins->data.number);
    set_clock(254, board->spi_mode == 3 ? 0xC7 : 0x07); /* 8 bits, Freescale format */
    open_buttons();
    return HAL_OK;
}

/* Sets no pin: the panel is reset with the CPU and has no backlight. */
static int lm3s6965_pin_set(void *context, enum hal_pin pin, bool level)
{
    (void)context;
    (void)pin;
    (void)level;
    return HAL_OK;
}

static uint32_t lm3s6965_buttons(void *context)
{
    const uint32_t down = buttons_down();
    (void)context;
    kit.stuck &= down;
    return down & ~kit.stuck;
}

static void lm3s6965_close(void *context)
{
    lm3s6965_bus_wait(context);
    gpio_write(kit.board->pins.select.number, kit.board->pins.select.active_low);
    SSI_CR1 = 0;
}

void port_bus_stop(void)
{
    if (kit.board == NULL) { /* not open yet; bus_write will need the board's pins */
        lm3s6965_open(NULL, board_here);
    }
}

struct hal port_hal(void)
{
    static const struct hal_ops ops = {
        .name = "lm3s6965",
        .open = lm3s6965_open,
        .bus_clock = lm3s6965_bus_clock,
        .bus_write = lm3s6965_bus_write,
        .bus_wait = lm3s6965_bus_wait,
        .pin_set = lm3s6965_pin_set,
        .time_us = cortexm_time_us,
        .delay_us = cortexm_delay_us,
        .buttons = lm3s6965_buttons,
        .close = lm3s6965_close,
    };
    return (struct hal){&ops, NULL};
}
