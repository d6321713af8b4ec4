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

/* The kit's bus: one a chip. */
static struct {
    const struct board_pins *pins;
    uint32_t unit;
    uint32_t cr0; /* clock and mode, without word width */
    uint32_t bits, dc;
    bool selected;
} spi;

static uint32_t transfer_control(uint32_t bits)
{
    const uint32_t pace = DMA_EN | DMA_INCR_READ | DMA_TREQ_SPI_TX(spi.unit); /* chained to itself: to none */
    return bits == 16 ? pace | DMA_HALFWORDS | DMA_BSWAP : pace;
}

void rp2040_spi_interrupt(void)
{
    REG(DMA_INTS0) = 1;
}

/* The interrupt ends WFE, also one that came between the look and the WFE. */
static void wait_for_dma(void)
{
    while ((REG(DMA_CH0_AL1_CTRL) & DMA_BUSY) != 0) {
        __asm volatile("wfe" ::: "memory");
    }
}

static void wait_for_last_bit(void)
{
    wait_for_dma();
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

static void spi_pin(const struct board_pin *pin)
{
    rp2040_pin_function(pin->number, FUNCTION_SPI);
    REG(PADS_BANK0(pin->number)) = PAD_FAST | PAD_8_MA | PAD_INPUT;
}

void rp2040_spi_open(const struct board *board)
{
    spi.pins = &board->pins;
    spi.unit = board->spi_bus;
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

void rp2040_spi_write(enum hal_dc dc, const uint8_t *bytes, uint32_t n)
{
    const uint32_t bits = ((n | (uintptr_t)bytes) & 1) == 0 ? 16 : 8;
    if (n == 0) {
        return;
    }
    if (dc == spi.dc && bits == spi.bits) {
        wait_for_dma();
    } else {
        rp2040_spi_wait();
        set_word(bits);
        rp2040_pin_write(spi.pins->dc.number, dc == HAL_DATA);
        spi.dc = dc;
    }
    if (!spi.selected) {
        chip_select(true);
    }
    __asm volatile("" ::: "memory"); /* the buffer is in memory before DMA reads it */
    REG(DMA_CH0_READ_ADDR) = (uint32_t)(uintptr_t)bytes;
    REG(DMA_CH0_WRITE_ADDR) = SPI_SSPDR(spi.unit);
    REG(DMA_CH0_TRANS_COUNT) = n * 8 / bits;
    REG(DMA_CH0_CTRL_TRIG) = transfer_control(bits);
}

void rp2040_spi_wait(void)
{
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
