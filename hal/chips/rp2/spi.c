/*
 * The bus of an RP2040 or RP2350: DMA channel 0 feeds one of the two SPI units (PL022). The code moves chip select and
 * D/C by hand.
 *
 * They move only while the bus is idle: the DMA is done AND the unit is no longer busy, for up to 8 words are still in
 * its FIFO when the DMA is done. While D/C and word width stay the same, the next transfer starts as soon as the DMA
 * has read the last buffer, without a pause between the bits.
 *
 * Whole halfwords go out as 16-bit words. That halves the DMA transfers, and the pauses that the PL022 makes between
 * words in mode 0. Commands and their parameters go straight into the unit's FIFO, one after the other: those of a
 * window take 4 us together.
 *
 * The handler's code and data lie in RAM, because flash may answer late.
 */
#include <cpu.h>
#include "rp2.h"
#include "chips/spi_clock.h"

_Static_assert(CLK_PERI_HZ == SPI_CLOCK_RP2_HZ, "the simulator counts with this clock");

#define SHORTS 12 /* bytes: column, row and memory write commands of a window are 11 */

/* A write that waits or is on its way: rows for the DMA, or short writes that were copied. */
struct write {
    union {
        struct {
            const uint8_t *bytes; /* of the first row */
            uint32_t n, stride;   /* bytes of a row; bytes from one row to the next */
        };
        uint8_t copy[SHORTS];
    };
    uint16_t count; /* rows, or bytes copied */
    uint16_t data;  /* D/C: one bit for each byte copied; for rows, bit 0 */
    bool copied;
};

#define WRITES 32 /* a power of two */

/* The chip's one bus. Writes have numbers: write `sent` is on its way unless `sent` equals `given`. */
static struct {
    uint32_t unit;
    uint32_t cr0;          /* clock and mode, without word width */
    uint32_t bits, dc;     /* word width and D/C at present */
    uint32_t dc_pin;       /* as a bit */
    uint32_t select_pin;   /* as a bit; 0: not wired */
    bool select_low;       /* low selects */
    uint32_t rows_left;    /* of the write on its way, with the row that the DMA reads */
    uint32_t row, stride;  /* address of that row; bytes to the next */
    uint32_t waiting_most; /* writes that may wait */
    struct write writes[WRITES];
    volatile uint32_t given, sent;
} spi;

HAL_TIER(interrupt) static void wait_for_last_bit(void)
{
    while ((REG(SPI_SSPSR(spi.unit)) & SSPSR_BSY) != 0) {
    }
}

HAL_TIER(interrupt) static inline void set_level(uint32_t pins, bool high)
{
    REG(high ? SIO_GPIO_OUT_SET : SIO_GPIO_OUT_CLR) = pins;
}

HAL_TIER(interrupt) static inline void chip_select(bool selected)
{
    set_level(spi.select_pin, selected != spi.select_low);
}

/* Sets the bits of a word; only while the bus is idle. */
HAL_TIER(interrupt) static void set_word(uint32_t bits)
{
    REG(SPI_SSPCR1(spi.unit)) = 0;
    REG(SPI_SSPCR0(spi.unit)) = spi.cr0 | (bits - 1);
    REG(SPI_SSPCR1(spi.unit)) = SSPCR1_SSE;
    spi.bits = bits;
}

/* The words that go into the unit from now on have this width and this D/C. */
HAL_TIER(interrupt) static inline void turn_to(uint32_t bits, uint32_t dc)
{
    if (dc != spi.dc || bits != spi.bits) {
        wait_for_last_bit();
        chip_select(false);
        if (bits != spi.bits) {
            set_word(bits);
        }
        set_level(spi.dc_pin, dc == HAL_DATA);
        spi.dc = dc;
    }
    chip_select(true);
}

HAL_TIER(interrupt) static void send_copied(const struct write *w)
{
    uint32_t data = w->data;
    for (uint32_t i = 0; i < w->count; i++, data >>= 1) {
        turn_to(8, data & 1);
        while ((REG(SPI_SSPSR(spi.unit)) & SSPSR_TNF) == 0) {
        }
        REG(SPI_SSPDR(spi.unit)) = w->copy[i];
    }
}

/* Starts the first row; the DMA is idle. */
HAL_TIER(interrupt) static void start_rows(const struct write *w)
{
    const uint32_t bits = ((w->n | w->stride | (uintptr_t)w->bytes) & 1) == 0 ? 16 : 8;
    const uint32_t pace =
        DMA_EN | DMA_INCR_READ | DMA_TREQ_SPI_TX(spi.unit); /* chained to itself, which means to none */
    turn_to(bits, w->data);
    spi.rows_left = w->count;
    spi.row = (uint32_t)(uintptr_t)w->bytes;
    spi.stride = w->stride;
    REG(DMA_CH0_READ_ADDR) = spi.row;
    REG(DMA_CH0_TRANS_COUNT) = bits == 16 ? w->n / 2 : w->n; /* no division in a handler, see divide.c */
    REG(DMA_CH0_CTRL_TRIG) = bits == 16 ? pace | DMA_HALFWORDS | DMA_BSWAP : pace;
}

/* Sends short writes until one has rows, and starts that one. The DMA is idle, and nothing interrupts. */
HAL_TIER(interrupt) static void go_on(void)
{
    for (uint32_t next = spi.sent; next != spi.given; spi.sent = ++next) {
        const struct write *w = &spi.writes[next % WRITES];
        if (!w->copied) {
            start_rows(w);
            return;
        }
        send_copied(w);
    }
}

/* Interrupt: the DMA has read a whole row. */
HAL_TIER(interrupt) void rp2_bus_interrupt(void)
{
    REG(DMA_INTS0) = 1;
    if (--spi.rows_left > 0) {
        spi.row += spi.stride;
        REG(DMA_CH0_AL3_READ_ADDR_TRIG) = spi.row;
        return;
    }
    spi.sent++;
    go_on();
}

/* Waits until at most so many writes wait or are on their way. WFE also ends when the interrupt came before it, after
 * the condition was read. */
static void wait_for_dma(uint32_t waiting)
{
    while (spi.given - spi.sent > waiting) {
        cpu_wait_event();
    }
}

static void spi_pin(const struct board_pin *pin)
{
    rp2_pin_function(pin->number, FUNCTION_SPI);
    REG(PADS_BANK0(pin->number)) = PAD_FAST | PAD_8_MA | PAD_INPUT;
}

int rp2_bus_open(const struct board *board)
{
    const struct board_pins *pins = &board->pins;
    spi.unit = board->spi_bus;
    spi.waiting_most = 0;
    spi.cr0 = board->spi_mode == 3 ? 3 << 6 : 0; /* SPH, SPO */
    if (pins->select.wired) {
        rp2_pin_output(pins->select.number, pins->select.active_low);
        spi.select_pin = 1U << pins->select.number;
        spi.select_low = pins->select.active_low;
    }
    rp2_pin_output(pins->dc.number, true);
    spi.dc_pin = 1U << pins->dc.number;
    spi.dc = HAL_DATA;
    spi_pin(&pins->clock);
    spi_pin(&pins->data);
    REG(SPI_SSPDMACR(spi.unit)) = SSPDMACR_TXDMAE;
    REG(DMA_CH0_WRITE_ADDR) = SPI_SSPDR(spi.unit);
    REG(DMA_INTE0) = 1;
    cpu_interrupt_enable(IRQ_DMA_0);
    rp2_bus_clock(NULL, 1000000);
    return HAL_OK;
}

int32_t rp2_bus_clock(void *context, uint32_t hz)
{
    const struct spi_clock_pl022 clock = spi_clock_pl022(CLK_PERI_HZ, hz);
    if (clock.hz == 0) {
        return HAL_EINVAL;
    }
    rp2_bus_wait(context);
    spi.cr0 = (spi.cr0 & 0xff) | clock.scr << 8;
    REG(SPI_SSPCR1(spi.unit)) = 0;
    REG(SPI_SSPCPSR(spi.unit)) = clock.prescaler;
    set_word(8);
    return (int32_t)clock.hz;
}

void rp2_bus_queue(void *context, bool on)
{
    (void)context;
    spi.waiting_most = on ? WRITES - 1 : 0;
}

uint32_t rp2_bus_written(void *context)
{
    (void)context;
    return spi.given;
}

int rp2_bus_until(void *context, uint32_t written)
{
    (void)context;
    wait_for_dma(spi.given - written);
    return HAL_OK;
}

/* The next free place; nobody else reads it before `given` moves on. */
static struct write *place(void)
{
    wait_for_dma(spi.waiting_most);
    return &spi.writes[spi.given % WRITES];
}

/* Hands over the place, which is filled. */
static void give(void)
{
    cpu_interrupts_off(); /* all that the DMA reads is in memory by now */
    const bool idle = spi.sent == spi.given;
    spi.given++;
    if (idle) {
        go_on();
    }
    cpu_interrupts_on();
}

static void add_copies(struct write *w, enum hal_dc dc, const uint8_t *bytes, uint32_t n)
{
    for (uint32_t i = 0; i < n; i++) {
        w->copy[w->count] = bytes[i];
        w->data |= (uint16_t)(dc << w->count);
        w->count++;
    }
}

/* Adds to the last write if that one is short, still waits and has room. */
static bool joins(enum hal_dc dc, const uint8_t *bytes, uint32_t n)
{
    struct write *last = &spi.writes[(spi.given - 1) % WRITES];
    cpu_interrupts_off();
    const bool room = spi.sent != spi.given && last->copied && last->count + n <= SHORTS;
    if (room) {
        add_copies(last, dc, bytes, n);
    }
    cpu_interrupts_on();
    return room;
}

static void write_short(enum hal_dc dc, const uint8_t *bytes, uint32_t n)
{
    if (joins(dc, bytes, n)) {
        return;
    }
    struct write *w = place();
    w->count = w->data = 0;
    w->copied = true;
    add_copies(w, dc, bytes, n);
    give();
}

static void write_rows(enum hal_dc dc, const uint8_t *bytes, uint32_t n, uint32_t stride, uint32_t rows)
{
    struct write *w = place();
    w->bytes = bytes;
    w->n = n;
    w->stride = stride;
    w->count = (uint16_t)rows;
    w->data = (uint16_t)dc;
    w->copied = false;
    give();
}

HAL_TIER(bus) int rp2_bus_write(void *context, enum hal_dc dc, const uint8_t *bytes, size_t n)
{
    (void)context;
    if (n > HAL_COPIED) {
        write_rows(dc, bytes, n, n, 1);
    } else if (n > 0) {
        write_short(dc, bytes, n);
    }
    return HAL_OK;
}

int rp2_bus_write_rows(void *context, const uint8_t *bytes, size_t n, size_t stride, size_t rows)
{
    (void)context;
    if (n > 0 && rows > 0) {
        write_rows(HAL_DATA, bytes, n, stride, rows);
    }
    return HAL_OK;
}

int rp2_bus_wait(void *context)
{
    (void)context;
    wait_for_dma(0);
    wait_for_last_bit();
    chip_select(false);
    return HAL_OK;
}

void rp2_bus_close(void)
{
    rp2_bus_wait(NULL);
    REG(SPI_SSPCR1(spi.unit)) = 0;
    REG(DMA_INTE0) = 0;
}
