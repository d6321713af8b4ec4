/*
 * The bus: one of the two SPI units (PL022) fed by DMA channel 0; chip select and D/C are moved by hand.
 *
 * They move only while the bus is idle: DMA done AND the unit no longer busy, for up to 8 words are still in its FIFO
 * when DMA is done. As long as D/C and word width stay, the next transfer starts as soon as DMA has read the last one's
 * buffer, and bits follow on each other.
 *
 * Whole halfwords go out as 16-bit words: half the DMA transfers, and half the pauses that the PL022 makes between
 * words in mode 0.
 */
#include "registers.h"
#include "rp2040.h"

/* A write that waits or is on its way. */
struct write {
    const uint8_t *bytes;
    uint32_t n;
    enum hal_dc dc;
    uint8_t copy[HAL_COPIED];
};

#define WRITES 16 /* a power of two */

/* The kit's bus: one a chip. Writes are numbered; the one numbered `sent` is on its way unless it equals `given`. */
static struct {
    const struct board_pins *pins;
    uint32_t unit;
    uint32_t cr0; /* clock and mode, without word width */
    uint32_t bits, dc;
    bool selected;
    uint32_t ahead;
    struct write writes[WRITES];
    volatile uint32_t given, sent;
} spi;

static void wait_for_last_bit(void)
{
    while ((REG(SPI_SSPSR(spi.unit)) & SSPSR_BSY) != 0) {
    }
}

static void chip_select(bool selected)
{
    if (spi.pins->select.wired) {
        rp2040_pin_write(spi.pins->select.number, selected != spi.pins->select.active_low);
    }
    spi.selected = selected;
}

/* Only while the bus is idle. */
static void set_word(uint32_t bits)
{
    REG(SPI_SSPCR1(spi.unit)) = 0;
    REG(SPI_SSPCR0(spi.unit)) = spi.cr0 | (bits - 1);
    REG(SPI_SSPCR1(spi.unit)) = SSPCR1_SSE;
    spi.bits = bits;
}

static uint32_t transfer_control(uint32_t bits)
{
    const uint32_t pace = DMA_EN | DMA_INCR_READ | DMA_TREQ_SPI_TX(spi.unit); /* chained to itself: to none */
    return bits == 16 ? pace | DMA_HALFWORDS | DMA_BSWAP : pace;
}

/* DMA is idle. */
static void start(const struct write *w)
{
    const uint32_t bits = ((w->n | (uintptr_t)w->bytes) & 1) == 0 ? 16 : 8;
    if (w->dc != spi.dc || bits != spi.bits) {
        wait_for_last_bit();
        chip_select(false);
        set_word(bits);
        rp2040_pin_write(spi.pins->dc.number, w->dc == HAL_DATA);
        spi.dc = w->dc;
    }
    if (!spi.selected) {
        chip_select(true);
    }
    REG(DMA_CH0_READ_ADDR) = (uint32_t)(uintptr_t)w->bytes;
    REG(DMA_CH0_WRITE_ADDR) = SPI_SSPDR(spi.unit);
    REG(DMA_CH0_TRANS_COUNT) = bits == 16 ? w->n / 2 : w->n; /* no division in a handler, see divide.c */
    REG(DMA_CH0_CTRL_TRIG) = transfer_control(bits);
}

/* The DMA has read all of a write. */
void rp2040_spi_interrupt(void)
{
    REG(DMA_INTS0) = 1;
    const uint32_t next = spi.sent + 1;
    spi.sent = next;
    if (next != spi.given) {
        start(&spi.writes[next % WRITES]);
    }
}

/* The interrupt ends WFE, also one that came between the look and the WFE. */
static void wait_for_dma(uint32_t waiting)
{
    while (spi.given - spi.sent > waiting) {
        __asm volatile("wfe" ::: "memory");
    }
}

static void spi_pin(const struct board_pin *pin)
{
    rp2040_pin_function(pin->number, FUNCTION_SPI);
    REG(PADS_BANK0(pin->number)) = PAD_FAST | PAD_8_MA | PAD_INPUT;
}

void rp2040_spi_open(const struct board *board)
{
    spi.pins = &board->pins;
    spi.unit = board->spi_bus;
    spi.ahead = 1;
    spi.cr0 = board->spi_mode == 3 ? 3 << 6 : 0; /* SPH, SPO */
    if (spi.pins->select.wired) {
        rp2040_pin_output(spi.pins->select.number, spi.pins->select.active_low);
    }
    rp2040_pin_output(spi.pins->dc.number, true);
    spi.dc = HAL_DATA;
    spi_pin(&spi.pins->clock);
    spi_pin(&spi.pins->data);
    REG(SPI_SSPDMACR(spi.unit)) = SSPDMACR_TXDMAE;
    REG(DMA_INTE0) = 1;
    REG(NVIC_ISER) = 1U << IRQ_DMA_0;
    rp2040_spi_clock(1000000);
}

/* SSPCLK / (prescaler x (SCR + 1)): an even prescaler up to 254, SCR up to 255. */
int32_t rp2040_spi_clock(uint32_t hz)
{
    const uint32_t divide = hz == 0 ? UINT32_MAX : (CLK_HZ - 1) / hz + 1;
    uint32_t prescaler = 2;
    while (prescaler <= 254 && prescaler * 256 < divide) {
        prescaler += 2;
    }
    if (prescaler > 254) {
        return HAL_EINVAL;
    }
    const uint32_t scr = (divide - 1) / prescaler;
    rp2040_spi_wait();
    spi.cr0 = (spi.cr0 & 0xff) | scr << 8;
    REG(SPI_SSPCR1(spi.unit)) = 0;
    REG(SPI_SSPCPSR(spi.unit)) = prescaler;
    set_word(8);
    return (int32_t)(CLK_HZ / (prescaler * (scr + 1)));
}

uint32_t rp2040_spi_ahead(uint32_t writes)
{
    spi.ahead = writes < 1 ? 1 : writes < WRITES ? writes : WRITES;
    return spi.ahead;
}

static void copy(struct write *w, const uint8_t *bytes)
{
    for (uint32_t i = 0; i < w->n; i++) {
        w->copy[i] = bytes[i];
    }
    w->bytes = w->copy;
}

/* There is a place among the writes when `ahead` - 1 at most wait; ahead is WRITES at most. */
void rp2040_spi_write(enum hal_dc dc, const uint8_t *bytes, uint32_t n)
{
    if (n == 0) {
        return;
    }
    wait_for_dma(spi.ahead - 1);
    const uint32_t number = spi.given;
    struct write *w = &spi.writes[number % WRITES];
    *w = (struct write){.bytes = bytes, .n = n, .dc = dc};
    if (n <= HAL_COPIED) {
        copy(w, bytes);
    }
    __asm volatile("cpsid i" ::: "memory"); /* what DMA reads is in memory */
    spi.given = number + 1;
    if (spi.sent == number) {
        start(w);
    }
    __asm volatile("cpsie i" ::: "memory");
}

void rp2040_spi_wait(void)
{
    wait_for_dma(0);
    wait_for_last_bit();
    if (spi.selected) {
        chip_select(false);
    }
}

void rp2040_spi_close(void)
{
    rp2040_spi_wait();
    REG(SPI_SSPCR1(spi.unit)) = 0;
    REG(DMA_INTE0) = 0;
}
