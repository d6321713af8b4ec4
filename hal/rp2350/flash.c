/*
 * See chips/rp2/flash.h: the RP2350's QMI reads the flash. RP2350 datasheet 4.4 (cache), 12.14 (QMI), 9.11.4 (pads).
 *
 * The ROM leaves the QMI with the fastest command by which it found the image: EBh on four lines, BBh on two, 0Bh or
 * 03h on one, at a third of clk_sys, with the command before each read (pico-bootrom-rp2350, varm_generic_flash.c). By
 * EBh a line of the cache takes 36 clocks of 3 cycles. A flash that reads on without a command takes 28 clocks (EBh
 * with mode bits A0h: W25Q16JV datasheet, "Fast Read Quad I/O"), and a W25Q takes half of clk_sys. Window, pads and
 * delay are those of pico-sdk (boot2_w25q080.S for the RP2350) but for two: QE is set only until power-off (command
 * 50h), and between two reads the flash is not selected for two cycles (tSHSL1 of a W25Q: 10 ns).
 *
 * All of this runs from RAM. Flashes of Winbond and GigaDevice are known by their JEDEC id, any other by its parameters
 * (SFDP, JEDEC JESD216B). Where something is not as expected, the ROM's way of reading stays.
 */
/* Kits: -Os, because it takes RAM and runs once. */
#include "board.h"
#include "port.h"
#include <registers.h>
#include <cpu.h>
#include "chips/rp2/flash_margin.h"
#include "chips/rp2/flash.h"

#include <stddef.h>

#define QMI        0x400d0000
#define DIRECT_CSR (QMI + 0x00)
#define DIRECT_TX  (QMI + 0x04)
#define DIRECT_RX  (QMI + 0x08)
#define M0_TIMING  (QMI + 0x0c)
#define M0_RFMT    (QMI + 0x10)
#define M0_RCMD    (QMI + 0x14)
enum { CSR_EN = 1, CSR_BUSY = 2, CSR_ASSERT_CS0N = 4, CSR_RXEMPTY = 1 << 16 };
#define CSR_CLKDIV (30U << 22) /* 5 MHz at 150 */

#define TIMING(divider) (1U << 30 | 1U << 12 | RP2350_FLASH_DELAY << 8 | (divider)) /* COOLDOWN, MIN_DESELECT */
#define TIMING_RXDELAY  (7U << 8)
/* Lengths of dummy phase (16 bits on four lines: 4 clocks) and suffix; four lines for all but the prefix. */
#define RFMT_QUAD   (4U << 16 | 2U << 14 | 2U << 8 | 2U << 6 | 2U << 4 | 2U << 2)
#define RFMT_PREFIX (1U << 12) /* 8 bits */
#define RCMD(mode)  ((mode) << 8 | 0xebU)
enum { READS_ON = 0xa0, ENDS = 0xff };

#define PADS_QSPI_SCLK   0x40040004
#define PADS_QSPI_SD(n)  (0x40040008 + 4 * (uint32_t)(n))
#define UNCACHED         ((const volatile uint32_t *)0x14000000)
#define TSHSL2_READS     8 /* of a register, between two commands: 50 ns, a cycle each at least */
#define SFDP_BYTES_LEAST 60
enum { WORDS = 16, STATUS2_QE = 2, WINBOND = 0xef, W25Q = 0x40, GIGADEVICE = 0xc8 };

_Static_assert(RP2350_FLASH_CLK_SYS_HZ == CLK_HZ, "the margins are for another clock than that of clocks.c");

static uint8_t jedec_id[3];

/* The flash is in no transfer and gets none from memory: before, it may be selected up to 64 cycles after one. */
static void direct_begin(void)
{
    REG(DIRECT_CSR) = CSR_CLKDIV | CSR_EN;
    while ((REG(DIRECT_CSR) & CSR_BUSY) != 0) {
    }
}

static void direct_end(void)
{
    REG(DIRECT_CSR) = CSR_CLKDIV;
}

static uint8_t swap(uint32_t byte)
{
    REG(DIRECT_TX) = byte;
    while ((REG(DIRECT_CSR) & CSR_RXEMPTY) != 0) {
    }
    return (uint8_t)REG(DIRECT_RX);
}

/* Sends a command of `sent` bytes, the lowest first, and receives n bytes. */
static void command(uint32_t bytes, uint32_t sent, uint8_t *received, uint32_t n)
{
    REG(DIRECT_CSR) = CSR_CLKDIV | CSR_EN | CSR_ASSERT_CS0N;
    for (uint32_t i = 0; i < sent + n; i++) {
        const uint8_t byte = swap(i < 4 ? bytes >> 8 * i & 255 : 0);
        if (i >= sent) {
            received[i - sent] = byte;
        }
    }
    while ((REG(DIRECT_CSR) & CSR_BUSY) != 0) {
    }
    REG(DIRECT_CSR) = CSR_CLKDIV | CSR_EN;
    for (uint32_t i = 0; i < TSHSL2_READS; i++) {
        (void)REG(DIRECT_CSR);
    }
}

static uint8_t status(uint32_t code)
{
    uint8_t byte;
    command(code, 1, &byte, 1);
    return byte;
}

/* Whether SFDP says that EBh takes 2 clocks of mode and 4 dummy ones, that mode bits Axh let the flash read on, and
 * that QE is bit 1 of status register 2, which 01h writes: words 3 and 15 of the first table. */
static bool sfdp_is_like_w25q(void)
{
    uint8_t head[16], word[4];
    command(0x5a, 5, head, sizeof head);
    const uint32_t table = head[12] | (uint32_t)head[13] << 8;
    if (head[0] != 'S' || head[1] != 'F' || head[2] != 'D' || head[3] != 'P' || 4 * head[11] < SFDP_BYTES_LEAST) {
        return false;
    }
    command(0x5a | (table + 8) >> 8 << 16 | (table + 8) << 24, 5, word, sizeof word);
    if (word[0] != 0x44 || word[1] != 0xeb) {
        return false;
    }
    command(0x5a | (table + 56) >> 8 << 16 | (table + 56) << 24, 5, word, sizeof word);
    const uint32_t quad_enable = word[2] >> 4 & 7;
    return (word[1] & 2) != 0 && (word[2] & 4) != 0 && (quad_enable == 1 || quad_enable >= 4) && quad_enable <= 5;
}

/* Sets QE unless it is set; false: the flash does not take it. */
static bool enable_quad(void)
{
    uint8_t status2 = status(0x35);
    if ((status2 & STATUS2_QE) == 0) {
        const uint32_t status1 = status(0x05);
        command(0x50, 1, NULL, 0);
        command(0x01 | status1 << 8 | (status2 | STATUS2_QE) << 16, 3, NULL, 0);
        status2 = status(0x35);
    }
    return (status2 & STATUS2_QE) != 0;
}

static void set_pads(void)
{
    REG(PADS_QSPI_SCLK) = PAD_8_MA | PAD_FAST;
    for (uint32_t i = 0; i < 4; i++) {
        REG_CLEAR(PADS_QSPI_SD(i)) = PAD_SCHMITT;
    }
}

static void set_window(uint32_t timing, uint32_t rfmt, uint32_t rcmd)
{
    direct_begin();
    REG(M0_TIMING) = timing;
    REG(M0_RFMT) = rfmt;
    REG(M0_RCMD) = rcmd;
    direct_end();
}

/* A checksum of the image's first words, as they are read now. */
static uint32_t sum(void)
{
    uint32_t all = 0;
    for (uint32_t i = 0; i < WORDS; i++) {
        all = 31 * all + UNCACHED[i];
    }
    return all;
}

/* The first read has the command and lets the flash read on. Where it reads other words then, a read whose mode bits
 * end that goes before the ROM's set-up. */
static void read_on(uint32_t divider)
{
    const uint32_t timing = REG(M0_TIMING), rfmt = REG(M0_RFMT), rcmd = REG(M0_RCMD), expected = sum();
    set_pads();
    set_window(TIMING(divider), RFMT_QUAD | RFMT_PREFIX, RCMD(READS_ON));
    (void)UNCACHED[0];
    set_window(TIMING(divider), RFMT_QUAD, RCMD(READS_ON));
    if (sum() != expected) {
        set_window(TIMING(divider), RFMT_QUAD, RCMD(ENDS));
        (void)UNCACHED[0];
        set_window(timing, rfmt, rcmd);
    }
}

/* Ends a read without a command prefix that another program may have left on: the flash would hear no command. */
void rp2_flash_open(void)
{
    const uint32_t kind = board_here->flash, slower = kind == BOARD_FLASH_AUTOMATIC ? 1 : 2;
    if ((REG(M0_RFMT) & RFMT_PREFIX) == 0) {
        return;
    }
    direct_begin();
    command(0x9f, 1, jedec_id, sizeof jedec_id);
    const bool is_w25q = jedec_id[0] == WINBOND && jedec_id[1] >= W25Q;
    const bool reads_on =
        kind != BOARD_FLASH_SERIAL && (is_w25q || jedec_id[0] == GIGADEVICE || sfdp_is_like_w25q()) && enable_quad();
    direct_end();
    if (kind == BOARD_FLASH_SERIAL) {
        set_window(TIMING(slower * RP2350_FLASH_UNKNOWN_DIVIDER), RFMT_PREFIX, 0x03);
    } else if (reads_on) {
        read_on(slower * (is_w25q ? RP2350_FLASH_W25Q_DIVIDER : RP2350_FLASH_UNKNOWN_DIVIDER));
    }
}

/* Core 1 waits here until *waits is false. */
static void stay(void *waits) /* called as run */
{
    cpu_interrupts_off();
    *(volatile uint32_t *)waits = 2;
    while (*(volatile uint32_t *)waits != 0) {
    }
    cpu_interrupts_on();
}

static uint32_t good_delays(uint32_t timing)
{
    const uint32_t rfmt = REG(M0_RFMT), rcmd = REG(M0_RCMD), expected = sum();
    uint32_t good = 0;
    for (uint32_t delay = 0; delay < 8; delay++) {
        set_window((timing & ~TIMING_RXDELAY) | delay << 8, rfmt, rcmd);
        good |= (sum() == expected ? 1U : 0U) << delay;
    }
    set_window(timing, rfmt, rcmd);
    return good;
}

/* The id is that of the start: a flash that reads on would not hear the command. */
void rp2_flash_measure(struct rp2_flash_facts *facts)
{
    const uint32_t timing = REG(M0_TIMING);
    uint32_t waits = 1;
    port_core_join();
    const bool other = port_core_run(stay, &waits);
    while (other && *(volatile uint32_t *)&waits == 1) {
    }
    cpu_interrupts_off();
    facts->good_delays = good_delays(timing);
    cpu_interrupts_on();
    *(volatile uint32_t *)&waits = 0;
    port_core_join();
    for (uint32_t i = 0; i < sizeof jedec_id; i++) {
        facts->id[i] = jedec_id[i];
    }
    facts->command = (uint8_t)REG(M0_RCMD);
    facts->divider = (uint8_t)timing;
    facts->delay = timing >> 8 & 7;
}
