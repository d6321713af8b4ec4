/*
 * The bus of an RP2040 where board.mk says PORT_BUS = i2c: one of the two I2C units (DW_apb_i2c), as a master that only
 * writes. It takes the place of spi.c.
 *
 * bus_write makes a message: the display's address, a control byte (00h: commands follow, 40h: data), the bytes, and a
 * stop. The unit sends address and start by itself. bus_write copies all that follows into a ring, as the words that
 * IC_DATA_CMD takes, and returns. The unit's interrupt moves them into its FIFO of 16 words, while the next picture is
 * drawn. It may be late: where the FIFO runs empty in a message, the unit holds the clock low until more comes.
 *
 * When nobody acknowledges a byte the unit stops (TX_ABRT). The rest of the ring is dropped, and the next bus_write or
 * bus_wait returns HAL_EIO. A line that stays low would stop the unit for ever: a wait ends after PATIENCE_US,
 * or with the next tick of rp2.h.
 *
 * The handler's code and data lie in RAM, because flash may answer late.
 */
#include <cpu.h>
#include "chips/i2c_clock.h"
#include "port.h"
#include "rp2.h"

#define WORDS       512    /* a power of two; a picture of 128x64 pixels has 1064 */
#define FIFO_LOW    4      /* words: the interrupt comes when so many are left, 90 us before they are out */
#define PATIENCE_US 50000  /* without a word that leaves the ring or the FIFO; a word takes 23 us at 400 kHz */
#define START_US    500000 /* a display without a reset line answers when its own circuit has reset it */
#define HALF_US     5      /* half a period of the clock that frees the bus */
#define CLOCKS      9      /* they free it: a byte and its acknowledgement */

/* The chip's one bus. Words have numbers: those from `sent` to `given` are in the ring. */
static struct {
    uint32_t unit, address, spi_hz;
    struct i2c_clock clock;
    volatile uint16_t words[WORDS];
    volatile uint32_t given, sent;
    volatile int32_t status; /* an error that nobody knows of yet; until then all words are dropped */
} i2c;

/* Interrupt: few words are left in the FIFO, or nobody acknowledged. */
HAL_TIER(interrupt) void rp2_bus_interrupt(void)
{
    const uint32_t unit = i2c.unit;
    if ((REG(IC_INTR_STAT(unit)) & INTR_TX_ABRT) != 0) {
        i2c.status = HAL_EIO;
        (void)REG(IC_CLR_TX_ABRT(unit)); /* until now the FIFO takes nothing */
    }
    uint32_t sent = i2c.status < 0 ? i2c.given : i2c.sent;
    while (sent != i2c.given && (REG(IC_STATUS(unit)) & STATUS_TFNF) != 0) {
        REG(IC_DATA_CMD(unit)) = i2c.words[sent++ % WORDS];
    }
    i2c.sent = sent;
    if (sent == i2c.given) {
        REG(IC_INTR_MASK(unit)) = INTR_TX_ABRT;
    }
}

/* Resets the unit and sets it up. What is written here counts only while IC_ENABLE is 0, as a reset leaves it. */
static void set_up(void)
{
    const uint32_t unit = i2c.unit, reset = RESET_I2C(unit);
    REG_SET(RESETS_RESET) = reset;
    REG_CLEAR(RESETS_RESET) = reset;
    while ((REG(RESETS_RESET_DONE) & reset) == 0) {
    }
    REG(IC_CON(unit)) = CON_MASTER | CON_FAST | CON_RESTART | CON_NO_SLAVE;
    REG(IC_TAR(unit)) = i2c.address;
    REG(IC_FS_SCL_HCNT(unit)) = i2c.clock.high;
    REG(IC_FS_SCL_LCNT(unit)) = i2c.clock.low;
    REG(IC_FS_SPKLEN(unit)) = i2c.clock.spike;
    REG(IC_SDA_HOLD(unit)) = i2c.clock.hold;
    REG(IC_TX_TL(unit)) = FIFO_LOW;
    REG(IC_INTR_MASK(unit)) = INTR_TX_ABRT;
    REG(IC_ENABLE(unit)) = 1;
}

/* Drops all that waits. */
static void drop(int status)
{
    cpu_interrupts_off();
    i2c.sent = i2c.given;
    i2c.status = status;
    cpu_interrupts_on();
}

/* The bus does not move any more. */
static void give_up(void)
{
    set_up();
    drop(HAL_ETIMEDOUT);
}

/* The interrupt comes at once, as long as few words are in the FIFO. */
static void go_on(void)
{
    REG(IC_INTR_MASK(i2c.unit)) = INTR_TX_ABRT | INTR_TX_EMPTY;
}

/* Waits until at most so many words are in the ring. When the unit does not wake the core, the tick of rp2.h does. */
static void wait_for_ring(uint32_t words)
{
    uint32_t sent = i2c.sent, from = REG(TIMER_TIMERAWL);
    while (i2c.given - i2c.sent > words) {
        cpu_wait_event();
        const uint32_t now = REG(TIMER_TIMERAWL);
        if (i2c.sent != sent) {
            sent = i2c.sent;
            from = now;
        } else if (now - from > PATIENCE_US) {
            give_up();
        }
    }
}

/* Waits until the FIFO is empty and the last stop is out. */
static void wait_for_stop(void)
{
    const uint32_t from = REG(TIMER_TIMERAWL);
    while ((REG(IC_STATUS(i2c.unit)) & (STATUS_TFE | STATUS_MASTER)) != STATUS_TFE) {
        if (REG(TIMER_TIMERAWL) - from > PATIENCE_US) {
            give_up();
        }
    }
}

/* Tells of an error once. */
static int take_status(void)
{
    const int status = i2c.status;
    if (status == HAL_OK) {
        return HAL_OK;
    }
    if (status == HAL_EIO) {
        port_log("I2C: no display answers; look at its wires and its address\r\n");
    } else {
        port_log("I2C: a line stays low; look at the wires\r\n");
    }
    drop(HAL_OK);
    return status;
}

static void put(uint32_t word)
{
    if (i2c.given - i2c.sent == WORDS) {
        go_on();
        wait_for_ring(WORDS - 1);
    }
    i2c.words[i2c.given % WORDS] = (uint16_t)word;
    i2c.given++;
}

static void put_message(enum hal_dc dc, const uint8_t *bytes, uint32_t n)
{
    put((dc == HAL_DATA ? 0x40 : 0x00) | (n == 0 ? DATA_CMD_STOP : 0));
    for (uint32_t i = 0; i < n; i++) {
        put(bytes[i] | (i + 1 == n ? DATA_CMD_STOP : 0));
    }
    go_on();
}

static int send(enum hal_dc dc, const uint8_t *bytes, uint32_t n)
{
    put_message(dc, bytes, n);
    return take_status();
}

/* Makes a line low, or lets go of it, so that its pull-up makes it high. */
static void pull(const struct board_pin *pin, bool low)
{
    REG(low ? SIO_GPIO_OE_SET : SIO_GPIO_OE_CLR) = 1U << pin->number;
    const uint32_t from = REG(TIMER_TIMERAWL);
    while (REG(TIMER_TIMERAWL) - from <= HALF_US) {
    }
}

/*
 * A display that was just acknowledging a byte when the chip was reset still holds the data line low. It lets go of it
 * with the next clock (UM10204 3.1.16); a stop ends its message.
 */
static void free_bus(const struct board_pin *clock, const struct board_pin *data)
{
    rp2_pin_input(clock->number);
    rp2_pin_input(data->number);
    REG(SIO_GPIO_OUT_CLR) = 1U << clock->number | 1U << data->number;
    pull(data, false);
    for (uint32_t i = 0; i < CLOCKS && (REG(SIO_GPIO_IN) >> data->number & 1) == 0; i++) {
        pull(clock, true);
        pull(clock, false);
    }
    pull(clock, true);
    pull(data, true);
    pull(clock, false);
    pull(data, false);
}

static void i2c_pin(const struct board_pin *pin)
{
    REG(PADS_BANK0(pin->number)) = PAD_SCHMITT | PAD_PULL_UP | PAD_8_MA | PAD_INPUT;
    rp2_pin_function(pin->number, FUNCTION_I2C);
}

/* A message without a byte asks whether the display is there. */
static int wait_for_display(void)
{
    const uint32_t from = REG(TIMER_TIMERAWL);
    do {
        drop(HAL_OK);
        put_message(HAL_COMMAND, NULL, 0);
        wait_for_ring(0);
        wait_for_stop();
    } while (i2c.status == HAL_EIO && REG(TIMER_TIMERAWL) - from <= START_US);
    return take_status();
}

int rp2_bus_open(const struct board *board)
{
    i2c.unit = board->spi_bus;
    i2c.address = board->i2c_address;
    i2c.spi_hz = board->spi_hz;
    free_bus(&board->pins.clock, &board->pins.data);
    i2c_pin(&board->pins.clock);
    i2c_pin(&board->pins.data);
    i2c.clock = i2c_clock_dw(CLK_HZ, board->spi_hz);
    set_up();
    cpu_interrupt_enable(IRQ_I2C(i2c.unit));
    return wait_for_display();
}

int32_t rp2_bus_clock(void *context, uint32_t hz)
{
    const struct i2c_clock clock = i2c_clock_dw(CLK_HZ, hz < i2c.spi_hz ? hz : i2c.spi_hz);
    if (clock.hz == 0) {
        return HAL_EINVAL;
    }
    if (clock.hz != i2c.clock.hz) {
        rp2_bus_wait(context);
        i2c.clock = clock;
        set_up();
    }
    return (int32_t)clock.hz;
}

/* Nothing is kept back. */
void rp2_bus_flush(void *context)
{
    (void)context;
}

int rp2_bus_write(void *context, enum hal_dc dc, const uint8_t *bytes, size_t n)
{
    (void)context;
    return n > 0 ? send(dc, bytes, n) : HAL_OK;
}

int rp2_bus_write_rows(void *context, const uint8_t *bytes, size_t n, size_t stride, size_t rows)
{
    (void)context;
    int status = HAL_OK;
    for (size_t i = 0; i < rows && n > 0 && status == HAL_OK; i++) {
        status = send(HAL_DATA, bytes + i * stride, n);
    }
    return status;
}

int rp2_bus_wait(void *context)
{
    (void)context;
    wait_for_ring(0);
    wait_for_stop();
    return take_status();
}

void rp2_bus_close(void)
{
    rp2_bus_wait(NULL);
    REG(IC_ENABLE(i2c.unit)) = 0;
}
