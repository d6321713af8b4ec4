/*
 * See flash.h. Datasheet 4.10 (SSI); JESD216B (SFDP, the parameters that a serial flash tells of itself); W25Q16JV and
 * GD25Q16C data sheets (commands).
 *
 * boot2.S has set up the read of a W25Q on four lines, or the slow one. In place of the slow one this looks for
 *   EBh  20 clocks a word: 24 address bits and mode bits A0h on four lines, dummy clocks, data on four lines. The mode
 *        bits keep the flash from expecting a command. Only the first read has one: the SSI cannot send both.
 *   6Bh  48 clocks, as a rule: command and address on one line, dummy clocks, data on four lines
 *   03h  64 clocks
 * that the flash tells of. A read is kept if the image's first bytes come as they do by 03h. Status bits are changed
 * only until power-off (50h), never for good (06h).
 *
 * While the SSI is set up nothing can be read of flash. So the functions of .once run from RAM: they are linked to the
 * lowest part of the stack, which is free whenever the stack is short. `borrow` copies them there for a while.
 */
#include "board.h"
#include "port.h"
#include <cpu.h>
#include "chips/rp2/flash.h"
#include "chips/rp2/flash_margin.h"

#include <stddef.h>

#define ONCE static __attribute__((section(".once"), noinline))

#define SSI                0x18000000
#define SSI_CTRLR0         SSI
#define SSI_CTRLR1         (SSI + 0x04)
#define SSI_SSIENR         (SSI + 0x08)
#define SSI_BAUDR          (SSI + 0x14)
#define SSI_SR             (SSI + 0x28)
#define SSI_DR             (SSI + 0x60)
#define SSI_RX_SAMPLE_DLY  (SSI + 0xf0)
#define SSI_SPI_CTRLR0     (SSI + 0xf4)
#define FLASH_PAST_CACHE   0x13000000U /* flash, neither looked up in the cache nor kept there */
#define PROBE_WORDS        64
#define DELAYS             8
#define STACK_BYTES_ENOUGH 256 /* more than the functions of .once take */

enum { SR_BUSY = 1, SR_TFE = 4 };

/* CTRLR0: transfers of bytes, or words that are read after a command and an address. */
enum { BYTES = 7 << 16, WORDS = 31 << 16 | 3 << 8, WORDS_QUAD = 2 << 21 | WORDS };

/* SPI_CTRLR0: dummy clocks; a command of 8 bits; an address of n bits; what else than data is on four lines. */
#define DUMMY(clocks)   ((clocks) << 11)
#define COMMAND         (2U << 8)
#define ADDRESS(bits)   ((bits) / 4U << 2)
#define ADDRESS_ON_FOUR 1U
#define ALL_ON_FOUR     2U
#define READ_03         (0x03U << 24 | COMMAND | ADDRESS(24))
#define READ_6B         (0x6bU << 24 | COMMAND | ADDRESS(24))
#define READ_EB_MODE    0xa0U
#define READ_EB         (READ_EB_MODE << 24 | ADDRESS(32) | ALL_ON_FOUR) /* without its command */

_Static_assert(RP2040_FLASH_CLK_SYS_HZ == CLK_HZ, "the margins are for another clock than that of clocks.c");

extern uint32_t ld_stack[], ld_once_end[];
extern const uint32_t ld_once_load[]; /* rp2040.ld */

ONCE void set_up(uint32_t control, uint32_t read, uint32_t divider, uint32_t delay)
{
    REG(SSI_SSIENR) = 0; /* off, or the others are disregarded */
    REG(SSI_BAUDR) = divider;
    REG(SSI_CTRLR0) = control;
    REG(SSI_CTRLR1) = 0;
    REG(SSI_RX_SAMPLE_DLY) = delay;
    REG(SSI_SPI_CTRLR0) = read;
    REG(SSI_SSIENR) = 1;
}

ONCE void wait_sent(void)
{
    while ((REG(SSI_SR) & (SR_BUSY | SR_TFE)) != SR_TFE) {
    }
}

/* Sends a command and the highest n - 1 bytes of `more`, then zeros; n is at most 16. Returns the last four answers. */
ONCE uint32_t transfer(uint32_t command, uint32_t more, uint32_t n)
{
    REG(SSI_DR) = command;
    for (uint32_t i = 1; i < n; i++) {
        REG(SSI_DR) = more >> 24;
        more <<= 8;
    }
    wait_sent();
    uint32_t answer = 0;
    for (uint32_t i = 0; i < n; i++) {
        answer = answer << 8 | (REG(SSI_DR) & 0xff);
    }
    return answer;
}

/* A double word of the flash's parameters. */
ONCE uint32_t parameter(uint32_t address)
{
    return __builtin_bswap32(transfer(0x5a, address << 8, 9));
}

ONCE void begin_bytes(void)
{
    set_up(BYTES, 0, RP2040_FLASH_UNKNOWN_DIVIDER, RP2040_FLASH_DELAY);
}

/* Makes a flash expect a command that was read without one. */
ONCE void end_read(uint32_t read)
{
    if ((read & COMMAND) == 0) {
        REG(SSI_DR) = UINT32_MAX; /* address and mode bits */
        wait_sent();
    }
}

ONCE void begin_read(uint32_t control, uint32_t read, uint32_t divider, uint32_t delay)
{
    if ((read & COMMAND) == 0) {
        set_up(control, (read & (DUMMY(31U) | ADDRESS(60))) | COMMAND | ADDRESS_ON_FOUR, divider, delay);
        REG(SSI_DR) = 0xeb;
        REG(SSI_DR) = read >> 24; /* address 0, mode bits */
        wait_sent();
    }
    set_up(control, read, divider, delay);
}

/* What the image's first bytes are, as they are read now. */
ONCE uint32_t probe(void)
{
    uint32_t sum = 0;
    for (uint32_t i = 0; i < PROBE_WORDS; i++) {
        sum = (sum << 5 | sum >> 27) + REG(FLASH_PAST_CACHE + 4 * i);
    }
    return sum;
}

/*
 * Sets the bit QE, if the flash has one and keeps it until power-off only. `table` has `words` double words; the 15th
 * and the 16th (JESD216B, 6.4.18 and 6.4.19) are in no older one. Without them only GigaDevice's flash is known to have
 * the registers of a W25Q (GD25Q16C data sheet, 7.3 .. 7.5).
 */
ONCE bool enable_quad(uint32_t table, uint32_t words)
{
    const bool told = words >= 16;
    const uint32_t needs = told ? parameter(table + 56) >> 20 & 7 : 5;
    if (needs == 0) {
        return true;
    }
    if (needs == 3 || needs == 7 || (!told && (transfer(0x9f, 0, 4) >> 16 & 0xff) != 0xc8)) {
        return false;
    }
    const bool in_first = needs == 2;
    const uint32_t command = in_first ? 0x05 : 0x35, bit = in_first ? 0x40 : 0x02;
    const uint32_t status = transfer(command, 0, 2) & 0xff;
    if ((status & bit) != 0) {
        return true;
    }
    if (told && (parameter(table + 60) & 0x0c) == 0) {
        return false; /* bits that 50h makes writable are told in these two */
    }
    const uint32_t first = transfer(0x05, 0, 2) & 0xff;
    transfer(0x50, 0, 1);
    if (in_first) {
        transfer(0x01, (status | bit) << 24, 2);
    } else if (needs == 6) {
        transfer(0x31, (status | bit) << 24, 2);
    } else {
        transfer(0x01, first << 24 | (status | bit) << 16, 3);
    }
    return (transfer(command, 0, 2) & bit) != 0;
}

/* Keeps the read, if it gives what is right. */
ONCE bool take(uint32_t read, uint32_t right)
{
    begin_read(WORDS_QUAD, read, RP2040_FLASH_UNKNOWN_DIVIDER, RP2040_FLASH_DELAY);
    if (probe() == right) {
        return true;
    }
    end_read(read);
    return false;
}

/* The first double words of the parameters' header and of the basic table are those of JESD216B, 6.2 .. 6.4.3. */
ONCE void find_read(uint32_t right)
{
    begin_bytes();
    const uint32_t header = parameter(8), table = parameter(12) & 0xffffff;
    if (parameter(0) == 0x50444653 && (header & 0xff) == 0 && (header >> 16 & 0xff) == 1) {
        const uint32_t kinds = parameter(table), reads = parameter(table + 8), words = header >> 24;
        if ((kinds >> 17 & 3) != 2 && (kinds & 3U << 21) != 0 && enable_quad(table, words)) {
            const bool keeps = words < 16 || (parameter(table + 56) & (1U << 18 | 1U << 9)) == (1U << 18 | 1U << 9);
            if (keeps && (kinds & 1U << 21) != 0 && (reads & 0xffe0) == 0xeb40 &&
                take(READ_EB | DUMMY(reads & 31), right)) {
                return;
            }
            if ((kinds & 1U << 22) != 0 && reads >> 24 == 0x6b &&
                take(READ_6B | DUMMY((reads >> 16 & 31) + (reads >> 21 & 7)), right)) {
                return;
            }
        }
    }
    begin_read(WORDS, READ_03, RP2040_FLASH_UNKNOWN_DIVIDER, RP2040_FLASH_DELAY);
}

ONCE void open_flash(uint32_t kind)
{
    const uint32_t read = REG(SSI_SPI_CTRLR0);
    const bool quad = (read & COMMAND) == 0; /* boot2.S found a W25Q */
    if (kind != BOARD_FLASH_SERIAL && !quad) {
        find_read(probe());
    } else if (kind != BOARD_FLASH_AUTOMATIC && quad) {
        end_read(read);
        begin_read(kind == BOARD_FLASH_HALF ? WORDS_QUAD : WORDS, kind == BOARD_FLASH_HALF ? read : READ_03,
                   RP2040_FLASH_UNKNOWN_DIVIDER, RP2040_FLASH_DELAY);
    }
}

ONCE void measure(struct rp2_flash_facts *facts)
{
    const uint32_t control = REG(SSI_CTRLR0), read = REG(SSI_SPI_CTRLR0), divider = REG(SSI_BAUDR);
    const uint32_t delay = REG(SSI_RX_SAMPLE_DLY), right = probe();
    for (uint32_t i = 0; i < DELAYS; i++) {
        set_up(control, read, divider, i);
        facts->good_delays |= (probe() == right ? 1U : 0U) << i;
    }
    set_up(control, read, divider, delay);
    end_read(read);
    begin_bytes();
    const uint32_t id = transfer(0x9f, 0, 4);
    begin_read(control, read, divider, delay);
    for (uint32_t i = 0; i < 3; i++) {
        facts->id[i] = (uint8_t)(id >> (16 - 8 * i));
    }
    facts->command = (uint8_t)((read & COMMAND) == 0 ? 0xeb : read >> 24);
    facts->divider = (uint8_t)divider;
    facts->delay = (uint8_t)delay;
}

/* Core 1 waits here until *waits is false. */
ONCE void stay(void *waits) /* called as run */
{
    cpu_interrupts_off();
    *(volatile uint32_t *)waits = 2;
    while (*(volatile uint32_t *)waits != 0) {
    }
    cpu_interrupts_on();
}

static uint32_t once_words(void)
{
    return ((uint32_t)(uintptr_t)ld_once_end - (uint32_t)(uintptr_t)ld_stack) / sizeof *ld_stack;
}

/* How many of the words that .once takes no call has reached yet. They hold the paint of entry.S, their own address. */
static uint32_t untouched(void)
{
    uint32_t n = 0;
    while (n < once_words() && ld_stack[n] == (uint32_t)(uintptr_t)(ld_stack + n)) {
        n++;
    }
    return n;
}

/* Copies .once to the stack's lowest part; false: the stack is too long now. */
static bool borrow(void)
{
    const uint32_t here = 0, words = once_words();
    if ((uint32_t)(uintptr_t)&here < (uint32_t)(uintptr_t)ld_once_end + STACK_BYTES_ENOUGH) {
        return false;
    }
    for (uint32_t i = 0; i < words; i++) {
        ld_stack[i] = ld_once_load[i];
    }
    __asm volatile("dsb\n isb" ::: "memory");
    return true;
}

/* Paints the first words of the stack again, for port_stack_used(). */
static void give_back(uint32_t words)
{
    for (uint32_t i = 0; i < words; i++) {
        ld_stack[i] = (uint32_t)(uintptr_t)(ld_stack + i);
    }
}

void rp2_flash_open(void)
{
    const uint32_t clean = untouched();
    if (borrow()) {
        open_flash(board_here->flash);
        give_back(clean);
    }
}

void rp2_flash_measure(struct rp2_flash_facts *facts)
{
    *facts = (struct rp2_flash_facts){0};
    const uint32_t clean = untouched();
    if (borrow()) {
        uint32_t waits = 1;
        port_core_join();
        const bool other = port_core_run(stay, &waits);
        while (other && *(volatile uint32_t *)&waits == 1) {
        }
        cpu_interrupts_off();
        measure(facts);
        cpu_interrupts_on();
        *(volatile uint32_t *)&waits = 0;
        port_core_join();
        give_back(clean);
    }
}
