/*
 * QMI (12.14), which reads the flash: its registers, direct mode, and the reads of window 0, whose flash is in flash.c.
 * Window 1, its registers, writes to the windows, address translation, double rate and MAX_SELECT are not modelled: a
 * write to what belongs to them is an objection. The pads of the flash (9.11.4) are here, too.
 *
 * A read takes, in cycles of clk_sys:
 *   clocks x CLKDIV     prefix, address, suffix, dummy and data, by RFMT's lengths and widths (12.14.2)
 *   1 + SELECT_HOLD,    if the flash is still selected, to release it (12.14.6, SELECT_HOLD), and
 *   CLKDIV / 2 + MIN_DESELECT   until it is selected again, rounded up (MIN_DESELECT)
 *   MORE                for what lies between the core, the cache and the pins
 * A read that goes on at the address at which the last one ended takes the clocks of its data and MORE, if it comes
 * before the flash is released: 64 x COOLDOWN cycles and half a clock later, at once at a page that PAGEBREAK names
 * (12.14.2.1).
 *
 * MORE is published nowhere. It is what is left of 178 and of 126 cycles a miss, which the project YasOS measured on an
 * RP2350 and a W25Q128JV with CLKDIV 4, and 27 and 7 cycles between two reads: 36 x 4 + 1 + 27 + 6, 28 x 4 + 1 + 7 + 6.
 *
 * Taken so: a read costs as much as its last bit needs; one that waits for the other core's begins when that has ended.
 */
#include "chip.h"

#include <string.h>

#define MORE 6

enum { DIRECT_CSR = 0x00, DIRECT_TX = 0x04, DIRECT_RX = 0x08, M0_TIMING = 0x0c, M0_RFMT = 0x10, M0_RCMD = 0x14 };
/* The bits that each register has (12.14.6); those of DIRECT_CSR that can be written, and that are modelled: not
 * CS1's. */
#define CSR_BITS        0xffdf7ccfU
#define CSR_WRITABLE    0xffc00045U
#define CSR_CS1         0x88
#define TIMING_BITS     0xf3fff7ffU
#define TIMING_CLKDIV   0xffU
#define MAX_SELECT      0x7e0000U
#define RFMT_BITS       0x1007d3ffU
#define RFMT_DTR        (1U << 28)
#define RFMT_PREFIX     (1U << 12)
#define RCMD_BITS       0xffffU
#define TX_BITS         0x1fffffU
#define TX_NOPUSH       (1U << 20)
#define TX_NOT_MODELLED (0xfU << 16)
#define NO_ADDRESS      UINT32_MAX
enum { EN = 1, BUSY = 2, ASSERT_CS0N = 4, AUTO_CS0N = 0x40, TXFULL = 1 << 10, TXEMPTY = 1 << 11, RXEMPTY = 1 << 16 };

/* Pads: SCLK, SD0 .. SD3, SS behind VOLTAGE_SELECT. */
enum { PAD_SCLK = 1, PAD_SD0 = 2, PAD_SS = 6, PADS = 7 };
enum { PAD_ISO = 1 << 8, PAD_OD = 1 << 7, PAD_IE = 1 << 6, PAD_SCHMITT = 2, PAD_SLEWFAST = 1, PAD_RESET = 0x56 };
#define PADS_MOST_HZ 50.01e6 /* what the ROM reads with with pads as they are after a reset */
enum { RESET_IO_QSPI = 1 << 7, RESET_PADS_QSPI = 1 << 10 };
#define MARGIN_FS 3000000ULL /* hal/chips/rp2/flash_margin.h */

static uint32_t divider_of(uint32_t clkdiv)
{
    return clkdiv == 0 ? 256 : clkdiv;
}

static uint32_t divider(const struct chip *chip)
{
    return divider_of(chip->qmi.timing & TIMING_CLKDIV);
}

static uint64_t half_clock(const struct chip *chip)
{
    return (divider(chip) + 1) / 2 * chip->sys_cycle;
}

/* The ROM has found an image definition with CLKDIV 3 (pico-bootrom-rp2350, varm_generic_flash.c). */
void qmi_reset(struct chip *chip)
{
    struct qmi *qmi = &chip->qmi;
    const uint32_t command = flash_rom_command(&chip->flash_chip);
    memset(qmi, 0, sizeof *qmi);
    flash_reset(&chip->flash_chip);
    qmi->csr = 3 << 22;
    qmi->timing = 1U << 30 | 2 << 28 | 7 << 12 | 2 << 8 | 3;
    qmi->rfmt = RFMT_PREFIX | (command == 0xeb   ? 4 << 16 | 2 << 14 | 0x2a8
                               : command == 0xbb ? 2 << 14 | 0x154
                                                 : 2 << 16);
    qmi->rcmd = command;
    qmi->next = NO_ADDRESS;
    for (uint32_t i = 1; i < PADS; i++) {
        qmi->pads[i] = PAD_RESET;
    }
    qmi->pads[PAD_SS] = 0x5a;
    chip->resets &= ~(uint32_t)(RESET_IO_QSPI | RESET_PADS_QSPI);
}

uint32_t qmi_pad_read(struct chip *chip, uint32_t offset)
{
    return offset / 4 < PADS ? chip->qmi.pads[offset / 4] : 0;
}

void qmi_pad_write(struct chip *chip, uint32_t offset, uint32_t value)
{
    const uint32_t known = offset == 0 ? 1 : 0x1ff;
    if (offset / 4 >= PADS || (value & ~known) != 0) {
        chip_warn(chip, "PADS_QSPI's register %x has no bits %08x", offset, value);
        return;
    }
    if (offset == 0 && value != 0) {
        chip_warn(chip, "VOLTAGE_SELECT: the flash's pads have 3.3 V");
    }
    chip->qmi.pads[offset / 4] = value;
}

static void check_pads(struct chip *chip, double sck_hz)
{
    const uint32_t *pads = chip->qmi.pads;
    bool on = (chip->resets & (RESET_IO_QSPI | RESET_PADS_QSPI)) == 0, fast = (pads[PAD_SCLK] & PAD_SLEWFAST) != 0;
    for (uint32_t i = PAD_SCLK; i <= PAD_SS; i++) {
        const bool is_data = i >= PAD_SD0 && i < PAD_SS;
        on &= (pads[i] & (PAD_ISO | PAD_OD)) == 0 && (!is_data || (pads[i] & PAD_IE) != 0);
        fast &= !is_data || (pads[i] & PAD_SCHMITT) == 0;
    }
    if (!on) {
        chip_warn(chip, "flash is read, but its pads are off");
    } else if (!fast && sck_hz > PADS_MOST_HZ) {
        chip_warn(chip, "flash is read at %.1f MHz with slow pads", sck_hz / 1e6);
    }
}

/* ---- direct mode (12.14.5) -------------------------------------------------------------------------------------- */

static uint64_t byte_time(const struct chip *chip)
{
    return 8 * divider_of(chip->qmi.csr >> 22 & 255) * chip->sys_cycle;
}

/* BUSY stays for half a clock after the last byte, whose answer is there before. */
static bool is_busy(const struct chip *chip)
{
    const struct qmi *qmi = &chip->qmi;
    const bool is_clocked = qmi->clocks_end != 0 && chip->now < qmi->clocks_end + byte_time(chip) / 16;
    return is_clocked || chip->now < qmi->selected_until;
}

/* Selects the flash while the QMI is busy, if AUTO_CS0N is set. */
static void follow_busy(struct chip *chip)
{
    if (chip->flash_chip.selected && (chip->qmi.csr & ASSERT_CS0N) == 0 && !is_busy(chip)) {
        flash_select(chip, false);
        chip->flash_chip.released = chip->qmi.clocks_end;
    }
}

static uint32_t tx_level(const struct chip *chip)
{
    const uint64_t left = chip->now < chip->qmi.clocks_end ? chip->qmi.clocks_end - chip->now : 0;
    const uint64_t bytes = left / byte_time(chip);
    return bytes > QMI_FIFO_WORDS ? QMI_FIFO_WORDS : (uint32_t)bytes;
}

static uint32_t rx_level(const struct chip *chip)
{
    uint32_t level = 0;
    while (level < chip->qmi.rx_count && chip->qmi.rx_ready[level] <= chip->now) {
        level++;
    }
    return level;
}

static uint32_t csr(const struct chip *chip)
{
    const uint32_t tx = tx_level(chip), rx = rx_level(chip);
    return chip->qmi.csr | (is_busy(chip) ? BUSY : 0) | (tx == 0 ? TXEMPTY : 0) | (tx == QMI_FIFO_WORDS ? TXFULL : 0) |
           tx << 12 | (rx == 0 ? RXEMPTY : 0) | rx << 18;
}

static void write_csr(struct chip *chip, uint32_t value)
{
    struct qmi *qmi = &chip->qmi;
    const uint32_t was = qmi->csr, now = value & CSR_WRITABLE, changed = was ^ now;
    if ((value & ~CSR_BITS) != 0 || (value & CSR_CS1) != 0) {
        chip_warn(chip, "DIRECT_CSR is written with %08x, of which some bits do not exist or select no device", value);
    }
    if (is_busy(chip) && (changed & (ASSERT_CS0N | AUTO_CS0N)) != 0) {
        chip_warn(chip, "DIRECT_CSR selects or releases the flash while the QMI is busy");
    } else if (is_busy(chip) && (was & EN) != 0 && (changed & EN) != 0) {
        chip_warn(chip, "DIRECT_CSR ends direct mode while the QMI is busy");
    } else if ((now & (EN | ASSERT_CS0N)) == ASSERT_CS0N) {
        chip_warn(chip, "DIRECT_CSR selects the flash without direct mode: reads from memory may be under way");
    }
    follow_busy(chip);
    qmi->csr = now;
    qmi->next = NO_ADDRESS;
    if ((changed & ASSERT_CS0N) != 0) {
        flash_select(chip, (now & ASSERT_CS0N) != 0);
    }
}

static void write_tx(struct chip *chip, uint32_t value)
{
    struct qmi *qmi = &chip->qmi;
    follow_busy(chip);
    if ((value & ~TX_BITS) != 0 || (value & TX_NOT_MODELLED) != 0) {
        chip_warn(chip, "DIRECT_TX is written with %08x: only bytes on one line are modelled", value);
    } else if ((qmi->csr & EN) == 0 || (qmi->csr & (ASSERT_CS0N | AUTO_CS0N)) == 0) {
        chip_warn(chip, "DIRECT_TX is written without direct mode, or nothing selects the flash");
    } else if (chip->now < qmi->selected_until) {
        chip_warn(chip, "DIRECT_TX is written while a read from memory is under way");
    } else if (tx_level(chip) == QMI_FIFO_WORDS) {
        chip_warn(chip, "DIRECT_TX is full");
    } else if ((value & TX_NOPUSH) == 0 && qmi->rx_count == QMI_FIFO_WORDS) {
        chip_warn(chip, "DIRECT_RX is full: the QMI waits, which is not modelled");
    } else {
        if (!chip->flash_chip.selected) {
            flash_select(chip, true);
        }
        qmi->clocks_end = (chip->now < qmi->clocks_end ? qmi->clocks_end : chip->now) + byte_time(chip);
        const uint8_t byte = flash_byte(chip, (uint8_t)value);
        if ((value & TX_NOPUSH) == 0) {
            qmi->rx[qmi->rx_count] = byte;
            qmi->rx_ready[qmi->rx_count++] = qmi->clocks_end;
        }
    }
}

static uint32_t read_rx(struct chip *chip)
{
    struct qmi *qmi = &chip->qmi;
    const uint32_t byte = qmi->rx[0];
    if (rx_level(chip) == 0) {
        chip_warn(chip, "DIRECT_RX is read, but is empty");
        return 0;
    }
    qmi->rx_count--;
    memmove(qmi->rx, qmi->rx + 1, qmi->rx_count);
    memmove(qmi->rx_ready, qmi->rx_ready + 1, qmi->rx_count * sizeof *qmi->rx_ready);
    return byte;
}

/* ---- registers -------------------------------------------------------------------------------------------------- */

uint32_t qmi_read(struct chip *chip, uint32_t offset)
{
    switch (offset) {
    case DIRECT_CSR:
        follow_busy(chip);
        return csr(chip);
    case DIRECT_RX:
        return read_rx(chip);
    case M0_TIMING:
        return chip->qmi.timing;
    case M0_RFMT:
        return chip->qmi.rfmt;
    case M0_RCMD:
        return chip->qmi.rcmd;
    default:
        chip_warn(chip, "register %x of the QMI is not modelled", offset);
        return 0;
    }
}

/* All but CLKDIV may only change while no transfer is under way (M0_TIMING's description). */
static void write_window(struct chip *chip, uint32_t *to, const char *name, uint32_t value, uint32_t known)
{
    const uint32_t on_the_fly = to == &chip->qmi.timing ? TIMING_CLKDIV : 0;
    if ((value & ~known) != 0) {
        chip_warn(chip, "%s is written with %08x, of which bits %08x do not exist or are not modelled", name, value,
                  value & ~known);
    } else if (is_busy(chip) && ((*to ^ value) & ~on_the_fly) != 0) {
        chip_warn(chip, "%s changes while the QMI is busy", name);
    }
    *to = value;
    chip->qmi.next = NO_ADDRESS;
}

void qmi_write(struct chip *chip, uint32_t offset, uint32_t value)
{
    struct qmi *qmi = &chip->qmi;
    switch (offset) {
    case DIRECT_CSR:
        write_csr(chip, value);
        break;
    case DIRECT_TX:
        write_tx(chip, value);
        break;
    case M0_TIMING:
        write_window(chip, &qmi->timing, "M0_TIMING", value, TIMING_BITS & ~MAX_SELECT);
        break;
    case M0_RFMT:
        write_window(chip, &qmi->rfmt, "M0_RFMT", value, RFMT_BITS & ~RFMT_DTR);
        break;
    case M0_RCMD:
        write_window(chip, &qmi->rcmd, "M0_RCMD", value, RCMD_BITS);
        break;
    default:
        chip_warn(chip, "register %x of the QMI cannot be written, or is not modelled", offset);
        break;
    }
}

/* ---- reads from memory (12.14.2, 12.14.3) ------------------------------------------------------------------------ */

static uint32_t clocks(uint32_t bits, uint32_t width)
{
    return bits >> (width & 3);
}

static uint32_t clocks_before_data(uint32_t rfmt)
{
    return ((rfmt & RFMT_PREFIX) != 0 ? clocks(8, rfmt) : 0) + clocks(24, rfmt >> 2) +
           clocks(4 * chip_bits(rfmt, 14, 2), rfmt >> 4) + clocks(4 * chip_bits(rfmt, 16, 3), rfmt >> 6);
}

/* How far the moment of the sample is from those at which the bits change; less than 0: they are wrong. */
static int64_t margin(const struct chip *chip)
{
    const struct flash_chip *flash = &chip->flash_chip;
    const uint32_t halves = chip_bits(chip->qmi.timing, 8, 3);
    const int64_t sample = (int64_t)((divider(chip) + halves) * chip->sys_cycle / 2);
    const int64_t setup = sample - (int64_t)flash->latest_fs;
    const int64_t hold = (int64_t)(divider(chip) * chip->sys_cycle + flash->earliest_fs) - sample;
    return setup < hold ? setup : hold;
}

static bool at_page_break(const struct chip *chip, uint32_t address)
{
    static const uint32_t page[4] = {0, 256, 1024, 4096};
    const uint32_t bytes = page[chip_bits(chip->qmi.timing, 28, 2)];
    return bytes != 0 && address % bytes == 0;
}

/* The time until which the flash stays selected after a transfer. */
static uint64_t cooldown(const struct chip *chip, uint32_t next)
{
    const uint64_t cycles = at_page_break(chip, next) ? 0 : 64 * (uint64_t)(chip->qmi.timing >> 30);
    return cycles * chip->sys_cycle + half_clock(chip);
}

/* When a read that begins a new transfer can select the flash. */
static uint64_t selects(const struct chip *chip, uint64_t from)
{
    const struct qmi *qmi = &chip->qmi;
    const uint64_t released = from < qmi->selected_until ? from : qmi->selected_until;
    const uint64_t cycles = 1 + chip_bits(qmi->timing, 23, 2) + chip_bits(qmi->timing, 12, 5);
    const uint64_t ready = released + cycles * chip->sys_cycle + half_clock(chip);
    return qmi->selected_until == 0 || ready < from ? from : ready;
}

uint64_t qmi_transfer(struct core *core, uint32_t address, uint32_t bytes, bool *right)
{
    struct chip *chip = core->chip;
    struct qmi *qmi = &chip->qmi;
    const uint64_t now = core->time + core->cycles * chip->sys_cycle;
    const uint64_t from = now >= qmi->from && now < qmi->until ? qmi->until : now;
    const bool goes_on = address == qmi->next && from < qmi->selected_until && !at_page_break(chip, address);
    const double sck_hz = chip->sys_hz / divider(chip);
    uint64_t begins = from, count = clocks(8 * bytes, qmi->rfmt >> 8);
    chip->now = core->time;
    if (!goes_on) {
        begins = selects(chip, from);
        count += clocks_before_data(qmi->rfmt);
        check_pads(chip, sck_hz);
        flash_begin_read(chip, qmi->rfmt, qmi->rcmd, sck_hz);
    }
    *right = margin(chip) >= 0;
    if (chip->free_flash) {
        return 0;
    }
    qmi->from = now;
    qmi->until = begins + count * divider(chip) * chip->sys_cycle;
    qmi->next = address + bytes;
    qmi->selected_until = qmi->until + cooldown(chip, qmi->next);
    return (qmi->until - now) / chip->sys_cycle + MORE;
}

bool qmi_is_marginal(const struct chip *chip)
{
    return margin(chip) < (int64_t)MARGIN_FS;
}
