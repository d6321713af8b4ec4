/*
 * Port to the STM32F405: SPI2 with DMA1 stream 4, GPIO, USART3 (PB10 TX, PB11 RX). Register addresses and bits are
 * those of the reference manual RM0090. All boards have their panel on SPI2.
 *
 * bus_write returns while the DMA sends. D/C and chip select move only when the last bit is out. In an emulator without
 * DMA the CPU writes byte by byte.
 */
#include "board.h"
#include "chips/cortexm/start.h"
#include "port.h"
#include "chips/spi_clock.h"

#define RCC_CR      REG32(0x40023800)
#define RCC_PLLCFGR REG32(0x40023804)
#define RCC_CFGR    REG32(0x40023808)
#define RCC_AHB1ENR REG32(0x40023830)
#define RCC_APB1ENR REG32(0x40023840)
#define RCC_APB2ENR REG32(0x40023844)
#define RCC_CSR     REG32(0x40023874)
#define FLASH_ACR   REG32(0x40023C00)
#define MEMRMP      REG32(0x40013800) /* in SYSCFG */
#define VTOR        REG32(0xE000ED08)
#define AIRCR       REG32(0xE000ED0C)
#define MPU_CTRL    REG32(0xE000ED94)
#define IDCODE      REG32(0xE0042000) /* of DBGMCU, RM0090 38.6.1 */

#define PLLCFGR_KEPT (2U << 28) /* a reserved field, which must stay as a reset leaves it */

#define GPIO_MODER   0x00
#define GPIO_OSPEEDR 0x08
#define GPIO_PUPDR   0x0C
#define GPIO_IDR     0x10
#define GPIO_BSRR    0x18
#define GPIO_AFRL    0x20

#define SPI_CR1 REG32(0x40003800)
#define SPI_CR2 REG32(0x40003804)
#define SPI_SR  REG32(0x40003808)
#define SPI_DR  REG32(0x4000380C)
#define SR_TXE  2U
#define SR_BSY  128U
#define CR1_BR  (7U << 3)
#define CR1_SPE 64U

#define USART_SR      REG32(0x40004800)
#define USART_DR      REG32(0x40004804)
#define USART_BRR     REG32(0x40004808)
#define USART_CR1     REG32(0x4000480C)
#define USART_DAMAGED 7U /* parity, framing, noise */
#define USART_ORE     8U
#define USART_RXNE    32U
#define USART_TXE     128U

#define DMA_HISR  REG32(0x40026004)
#define DMA_HIFCR REG32(0x4002600C)
#define DMA_CR    REG32(0x40026070)
#define DMA_NDTR  REG32(0x40026074)
#define DMA_PAR   REG32(0x40026078)
#define DMA_M0AR  REG32(0x4002607C)
#define DMA_FCR   REG32(0x40026084)
#define DMA_EN    1U
#define DMA_FLAGS 0x3DU /* of stream 4 in HISR */
#define DMA_TEIF  8U
#define DMA_TCIF  32U
#define DMA_MOST  65535U

#define AF_SPI   5
#define AF_USART 7

#define HSI_HZ 16000000U
#define PLL_HZ 168000000U
_Static_assert(PLL_HZ / 4 == SPI_CLOCK_STM32F4_HZ, "the simulator counts with this clock");
#define BAUD        115200U
#define BOOT_LOADER 0x1FFF0000U /* system memory */
#define BOOT_WISH   0xB007B007U

static struct {
    const struct board *board;
    uint32_t cpu_hz, apb1_hz;
    bool dma, under_way;
} kit;

/* ---- pins ------------------------------------------------------------------------------------------ */

static uint32_t gpio_base(uint32_t pin)
{
    return 0x40020000U + 0x400 * (pin / 32);
}

static void gpio_field(uint32_t pin, uint32_t offset, uint32_t value)
{
    const uint32_t shift = 2 * (pin % 32);
    REG32(gpio_base(pin) + offset) = (REG32(gpio_base(pin) + offset) & ~(3U << shift)) | value << shift;
}

static void gpio_write(uint32_t pin, bool high)
{
    REG32(gpio_base(pin) + GPIO_BSRR) = 1U << (pin % 32 + (high ? 0 : 16));
}

static void gpio_output(const struct board_pin *pin, bool level)
{
    if (pin->wired) {
        gpio_write(pin->number, level != pin->active_low);
        gpio_field(pin->number, GPIO_OSPEEDR, 2);
        gpio_field(pin->number, GPIO_MODER, 1);
    }
}

static void gpio_function(uint32_t pin, uint32_t function)
{
    const uint32_t at = gpio_base(pin) + GPIO_AFRL + 4 * (pin % 32 / 8), shift = 4 * (pin % 8);
    REG32(at) = (REG32(at) & ~(15U << shift)) | function << shift;
    gpio_field(pin, GPIO_OSPEEDR, 2);
    gpio_field(pin, GPIO_MODER, 2);
}

static void gpio_button(const struct board_pin *pin)
{
    gpio_field(pin->number, GPIO_PUPDR, pin->active_low ? 1 : 2);
    gpio_field(pin->number, GPIO_MODER, 0);
}

/* ---- the boot loader in ROM ------------------------------------------------------------------------ */

/*
 * The boot loader is entered right after a reset, so that it finds the chip as after power-on. A reset does not touch
 * this word.
 */
static __attribute__((section(".noinit"))) uint32_t boot_wish;

void port_boot_loader(void)
{
    cortexm_dark();
    boot_wish = BOOT_WISH;
    AIRCR = 0x05FA0004; /* system reset */
    for (;;) {
    }
}

/* Maps the boot loader's memory to 0, where its vectors must be, and removes the guard from the RAM that it uses
 * (AN2606). The chip's errata sheet wants two clocks after RCC turns a unit on. */
static void enter_boot_loader(void)
{
    const volatile uint32_t *vectors = (const uint32_t *)BOOT_LOADER; /* NOLINT: an address of the memory map */
    boot_wish = 0;
    VTOR = 0;
    MPU_CTRL = 0;
    RCC_APB2ENR |= 1U << 14; /* SYSCFG */
    (void)RCC_APB2ENR;
    (void)RCC_APB2ENR;
    MEMRMP = 1;
    /* NOLINTNEXTLINE(clang-analyzer-deadcode.DeadStores): the assembly reads them */
    const uint32_t stack = vectors[0], entry = vectors[1];
    __asm__ volatile("msr msp, %0\n"
                     "bx %1\n"
                     :
                     : "r"(stack), "r"(entry));
}

/* ---- start, log ------------------------------------------------------------------------------------- */

static bool ready(uint32_t bit)
{
    for (uint32_t i = 0; i < 500000; i++) {
        if ((RCC_CR & bit) != 0) {
            return true;
        }
    }
    return false;
}

/* A 12 MHz crystal gives 336 MHz / 2, APB1 a quarter of it, APB2 a half. Without the crystal the chip stays at 16 MHz.
 */
static void start_clock(void)
{
    kit.cpu_hz = kit.apb1_hz = HSI_HZ;
    RCC_CR |= 1U << 16;
    if (!ready(1U << 17)) {
        return;
    }
    RCC_PLLCFGR = PLLCFGR_KEPT | 7U << 24 | 1U << 22 | 336U << 6 | 12U;
    RCC_CR |= 1U << 24;
    if (!ready(1U << 25)) {
        return;
    }
    FLASH_ACR = 0x705;             /* 5 wait states, prefetch, both caches */
    while ((FLASH_ACR & 7) != 5) { /* the clock may rise when they are in force */
    }
    RCC_CFGR = 4U << 13 | 5U << 10 | 2U;
    while ((RCC_CFGR >> 2 & 3) != 2) {
    }
    kit.cpu_hz = PLL_HZ;
    kit.apb1_hz = PLL_HZ / 4;
}

uint32_t port_start(void)
{
    if (boot_wish == BOOT_WISH) {
        enter_boot_loader();
    }
    start_clock();
    RCC_AHB1ENR |= 0x1FU | 1U << 21;    /* ports A .. E, DMA1 */
    RCC_APB1ENR |= 1U << 14 | 1U << 18; /* SPI2, USART3 */
    (void)RCC_AHB1ENR;                  /* the first access must come some clocks of the unit's bus later */
    (void)RCC_APB1ENR;
    gpio_function(BOARD_PORT('B', 10), AF_USART);
    gpio_function(BOARD_PORT('B', 11), AF_USART);
    USART_BRR = (kit.apb1_hz + BAUD / 2) / BAUD;
    USART_CR1 = 1U << 13 | 8U | 4U;
    return kit.cpu_hz;
}

/* Flags of RCC_CSR (RM0090 6.3.21); they add up until a power-on, so that several may be set. */
static void put_start(port_put put) /* calls fact */
{
    static const struct {
        uint32_t bit;
        const char *text;
    } reasons[] = {
        {1U << 27, " power on;"},   {1U << 25, " brown-out or power on;"}, {1U << 28, " a reset by software;"},
        {1U << 29, " a watchdog;"}, {1U << 30, " the window watchdog;"},   {1U << 31, " low power;"},
        {1U << 26, " the NRST pin"}};
    const uint32_t flags = RCC_CSR;
    put("started by (since power on):", 0, PORT_TEXT);
    for (uint32_t i = 0; i < sizeof reasons / sizeof reasons[0]; i++) {
        put((flags & reasons[i].bit) != 0 ? reasons[i].text : "", 0, PORT_TEXT);
    }
    put(" (reasons ", flags >> 24, PORT_HEX);
    put(")", 0, PORT_TEXT);
    put("\n", 0, PORT_TEXT);
}

void port_facts(port_put put) /* calls fact */
{
    put("chip STM32F4, id ", IDCODE, PORT_HEX);
    put("\n", 0, PORT_TEXT);
    put_start(put);
    put(kit.cpu_hz == HSI_HZ ? "clock HSI, because crystal or PLL did not start: kHz "
                             : "clock of the 12 MHz crystal by the PLL, not measured: kHz ",
        kit.cpu_hz / 1000, PORT_DECIMAL);
    put("\n", 0, PORT_TEXT);
}

void port_log(const char *text) /* called as put */
{
    for (; *text != '\0'; text++) {
        while ((USART_SR & USART_TXE) == 0) {
        }
        USART_DR = (uint8_t)*text;
    }
}

/*
 * After an overrun the USART receives nothing until DR has been read, also where no byte waits (RM0090, 30.3.3). The
 * byte that waits is whole then; the lost one came after it.
 */
int port_log_read(void)
{
    const uint32_t status = USART_SR;
    if ((status & (USART_RXNE | USART_ORE)) == 0) {
        return -1;
    }
    const uint32_t byte = USART_DR & 255; /* clears the errors of the status that was read */
    return (status & USART_RXNE) != 0 && (status & USART_DAMAGED) == 0 ? (int)byte : -1;
}

/* ---- the bus ---------------------------------------------------------------------------------------- */

/* A stream takes a new set-up when EN reads 0; it first ends what it moves (RM0090, 10.3.17). */
static void dma_stop(void)
{
    DMA_CR &= ~DMA_EN;
    while ((DMA_CR & DMA_EN) != 0) {
    }
}

static bool dma_is_there(void)
{
    dma_stop();
    DMA_NDTR = 1;
    return DMA_NDTR == 1;
}

static void dma_start(const uint8_t *bytes, size_t n)
{
    dma_stop();
    DMA_HIFCR = DMA_FLAGS;
    DMA_PAR = (uint32_t)&SPI_DR;
    DMA_M0AR = (uint32_t)bytes;
    DMA_NDTR = (uint32_t)n;
    DMA_FCR = 0;                 /* direct */
    DMA_CR = 1U << 10 | 1U << 6; /* channel 0, bytes, memory counts up, to the peripheral */
    DMA_CR |= DMA_EN;
    SPI_CR2 = 2;
    kit.under_way = true;
}

static int dma_end(void)
{
    uint32_t flags;
    do {
        flags = DMA_HISR;
    } while ((flags & (DMA_TCIF | DMA_TEIF)) == 0);
    SPI_CR2 = 0;
    kit.under_way = false;
    return (flags & DMA_TEIF) != 0 ? HAL_EIO : HAL_OK;
}

static int stm32f4_bus_wait(void *context)
{
    (void)context;
    const int status = kit.under_way ? dma_end() : HAL_OK;
    while ((SPI_SR & SR_TXE) == 0) {
    }
    while ((SPI_SR & SR_BSY) != 0) {
    }
    (void)SPI_DR; /* drops what came in */
    (void)SPI_SR;
    return status;
}

static void write_polled(const uint8_t *bytes, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        while ((SPI_SR & SR_TXE) == 0) {
        }
        SPI_DR = bytes[i];
    }
}

static int stm32f4_bus_write(void *context, enum hal_dc dc, const uint8_t *bytes, size_t n)
{
    int status = stm32f4_bus_wait(context);
    if (n == 0 || status != HAL_OK) {
        return status;
    }
    gpio_write(kit.board->pins.dc.number, dc == HAL_DATA);
    if (!kit.dma || n < 8) { /* a command is out sooner than DMA is set up */
        write_polled(bytes, n);
        return HAL_OK;
    }
    for (; n > DMA_MOST && status == HAL_OK; bytes += DMA_MOST, n -= DMA_MOST) {
        dma_start(bytes, DMA_MOST);
        status = dma_end();
    }
    if (status == HAL_OK) {
        dma_start(bytes, n);
    }
    return status;
}

static int32_t stm32f4_bus_clock(void *context, uint32_t hz)
{
    uint32_t br = 0;
    const uint32_t got = spi_clock_stm32f4(kit.apb1_hz, hz, &br);
    if (got == 0) {
        return HAL_EINVAL;
    }
    stm32f4_bus_wait(context);
    SPI_CR1 &= ~CR1_SPE;
    SPI_CR1 = (SPI_CR1 & ~CR1_BR) | br << 3;
    SPI_CR1 |= CR1_SPE;
    return (int32_t)got;
}

void port_bus_stop(void)
{
    dma_stop();
    SPI_CR2 = 0;
    kit.under_way = kit.dma = false;
    if (kit.board == NULL) { /* not open yet; bus_write will need the board's pins */
        port_hal().ops->open(NULL, board_here);
    }
}

/* ---- the kit ---------------------------------------------------------------------------------------- */

static int stm32f4_open(void *context, const struct board *board)
{
    const struct board_pins *pins = &board->pins;
    (void)context;
    if (board->spi_bus != 2) {
        return HAL_EINVAL;
    }
    kit.board = board;
    gpio_output(&pins->select, true);
    gpio_output(&pins->dc, false);
    gpio_output(&pins->reset, true);
    gpio_output(&pins->backlight, false);
    gpio_function(pins->clock.number, AF_SPI);
    gpio_function(pins->data.number, AF_SPI);
    for (uint32_t i = 0; i < board->button_count; i++) {
        gpio_button(&board->buttons[i].pin);
    }
    SPI_CR1 = 3U << 8 | CR1_BR | 4U | (board->spi_mode == 3 ? 3U : 0); /* master, select by software, slowest clock */
    SPI_CR1 |= CR1_SPE;
    kit.dma = dma_is_there();
    return HAL_OK;
}

static int stm32f4_pin_set(void *context, enum hal_pin pin, bool level)
{
    const struct board_pins *pins = &kit.board->pins;
    const struct board_pin *p = pin == HAL_PIN_RESET ? &pins->reset : &pins->backlight;
    (void)context;
    if (p->wired) {
        gpio_write(p->number, level != p->active_low);
    }
    return HAL_OK;
}

static uint32_t stm32f4_buttons(void *context)
{
    uint32_t down = 0;
    (void)context;
    for (uint32_t i = 0; i < kit.board->button_count; i++) {
        const struct board_pin *pin = &kit.board->buttons[i].pin;
        const bool high = (REG32(gpio_base(pin->number) + GPIO_IDR) >> pin->number % 32 & 1) != 0;
        down |= high != pin->active_low ? kit.board->buttons[i].button : 0U;
    }
    return down;
}

static void stm32f4_close(void *context)
{
    stm32f4_bus_wait(context);
    gpio_output(&kit.board->pins.select, false);
    SPI_CR1 &= ~CR1_SPE;
}

struct hal port_hal(void)
{
    static const struct hal_ops ops = {
        .name = "stm32f4",
        .open = stm32f4_open,
        .bus_clock = stm32f4_bus_clock,
        .bus_write = stm32f4_bus_write,
        .bus_wait = stm32f4_bus_wait,
        .pin_set = stm32f4_pin_set,
        .time_us = cortexm_time_us,
        .delay_us = cortexm_delay_us,
        .buttons = stm32f4_buttons,
        .close = stm32f4_close,
    };
    return (struct hal){&ops, NULL};
}
