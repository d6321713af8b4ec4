/*
 * The STM32F405's start and its bus on a model of its registers: QEMU's chip has no crystal, no PLL and no DMA, so that
 * there the port stays at 16 MHz and writes byte by byte. The model looks at the registers before each access: it sends
 * what a DMA stream is to send, watches D/C, and tells the chip's table (host-sim/emulate/stm32f4/registers_table.c) of
 * the access.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#include "registers/registers.h"

/* The port's own file, with these in place of chips/cortexm/start.h, and without the jump into the boot loader. */
#define CORTEXM_START_H
#define REG32(address) (*reg(address))
#define __asm__                                                                                                        \
    if (0)                                                                                                             \
    __asm
#pragma GCC diagnostic ignored "-Wpointer-to-int-cast"
#pragma GCC diagnostic ignored "-Wint-to-pointer-cast"
static volatile uint32_t *reg(uint32_t address);
void cortexm_dark(void);
uint32_t port_start(void);
void port_bus_stop(void);
unsigned cortexm_time_us(void *context);
void cortexm_delay_us(void *context, unsigned us);
#ifndef PORT_C /* test_stm32f4_wrong_start.sh gives a changed one */
#define PORT_C "../../hal/stm32f4/stm32f4.c"
#endif
#include PORT_C /* NOLINT(bugprone-suspicious-include): its registers are memory here */

enum { MOST = 140000, STEPS = 9, WORDS = 0x27000 / 4 };

#define UNWRITTEN 0xFFFFFFFFu
#define NOWHERE   0u

static struct {
    uint32_t words[WORDS], other;
    const uint8_t *memory; /* where addresses of the DMA lie */
    bool has_dma, fails, runs, dc, has_crystal, has_pll;
    uint32_t last, held; /* the address of the last access, and what was there before it */
    int steps;           /* until the stream ends */
    int accesses;        /* so that a wait for nothing ends */
    size_t sent, d_c_moves_in_a_byte;
    uint8_t wire[MOST];
    bool wire_dc[MOST];
} chip;

static uint32_t *word(uint32_t address)
{
    return address - 0x40000000u < sizeof chip.words ? &chip.words[(address - 0x40000000u) / 4] : &chip.other;
}

static struct registers *table;

static void accept(const char *objection)
{
    if (objection != NULL) {
        fail_msg("%s", objection);
    }
}

/* What the port wrote, with its pointers as the chip's addresses. */
static uint32_t written(uint32_t address, uint32_t value)
{
    return address == 0x40026078 && value == (uint32_t)(uintptr_t)word(0x4000380C) ? 0x4000380C
           : address == 0x4002607C ? 0x20000000 + (value - (uint32_t)(uintptr_t)chip.memory) % 0x20000
                                   : value;
}

/* The last access was a store if it changed the word; else it was a load, or made no difference. */
static void tell(void)
{
    const uint32_t address = chip.last, value = *word(address);
    chip.last = NOWHERE;
    if (address != NOWHERE && value != chip.held) {
        accept(registers_write(table, 0, 0, address, written(address, value), 4));
    } else if (address != NOWHERE) {
        accept(registers_read(table, 0, 0, address, value, 4));
    }
}

/* RM0090, 7: what is turned on becomes ready, and the clock is what SW says. */
static void step_clock(void)
{
    uint32_t *const cr = word(0x40023800), *const cfgr = word(0x40023808);
    *cr |= (*cr & 1u << 16) != 0 && chip.has_crystal ? 1u << 17 : 0;
    *cr |= (*cr & 1u << 24) != 0 && chip.has_pll ? 1u << 25 : 0;
    *cfgr = (*cfgr & ~(3u << 2)) | (*cfgr & 3) << 2;
}

static void send(uint8_t byte)
{
    assert_true(chip.sent < MOST);
    chip.wire[chip.sent] = byte;
    chip.wire_dc[chip.sent++] = chip.dc;
}

/* RM0090, 10: memory to peripheral, bytes, the memory's address counts up; the stream ends with a flag. */
static void step_dma(void)
{
    uint32_t *const cr = word(0x40026070), *const count = word(0x40026074), *const flags = word(0x40026004);
    *flags &= ~*word(0x4002600C);
    *word(0x4002600C) = 0;
    if ((*cr & 1) == 0 || (*word(0x40003804) & 2) == 0) {
        chip.runs = false;
        return;
    }
    if (!chip.runs) {
        assert_int_equal(*cr, 1u << 10 | 1u << 6 | 1u);
        assert_int_equal(*word(0x40026078), (uint32_t)(uintptr_t)word(0x4000380C));
        assert_int_equal(*flags & 0x3D, 0);
        assert_in_range(*count, 1, 65535);
        chip.runs = true;
        chip.steps = STEPS;
    }
    if (--chip.steps > 0) {
        return;
    }
    const uint32_t from = *word(0x4002607C) - (uint32_t)(uintptr_t)chip.memory;
    for (uint32_t i = 0; i < *count && !chip.fails; i++) {
        send(chip.memory[from + i]);
    }
    *flags |= chip.fails ? 8 : 32;
    *count = 0;
    *cr &= ~1u;
    chip.runs = false;
}

static volatile uint32_t *reg(uint32_t address)
{
    uint32_t *const data = word(0x4000380C), *const pins = word(0x40020418); /* port B: D/C */
    tell();
    if (*data != UNWRITTEN) {
        send((uint8_t)*data);
        *data = UNWRITTEN;
    }
    assert_true(++chip.accesses < 10000000);
    step_dma();
    step_clock();
    const uint32_t dc = board_here->pins.dc.number % 32;
    if ((*pins & (1u << dc | 1u << (dc + 16))) != 0) {
        chip.d_c_moves_in_a_byte += chip.runs;
        chip.dc = (*pins >> dc & 1) != 0;
    }
    *pins = 0;
    if (!chip.has_dma) {
        *word(0x40026074) = 0;
    }
    *word(0x40003808) = SR_TXE | (chip.runs ? SR_BSY : 0);
    chip.last = address;
    chip.held = *word(address);
    return word(address);
}

static uint8_t memory[MOST];

/* The chip after a reset. */
static void reset(bool has_crystal, bool has_pll)
{
    registers_free(table);
    table = registers_new(&stm32f4_registers, 1);
    assert_non_null(table);
    memset(&chip, 0, sizeof chip);
    chip.memory = memory;
    chip.has_crystal = has_crystal;
    chip.has_pll = has_pll;
    for (uint32_t i = 0; i < WORDS; i++) {
        chip.words[i] = registers_value(table, 0, 0x40000000 + 4 * i);
    }
    *word(0x4000380C) = UNWRITTEN;
}

static struct hal open_kit(bool has_dma)
{
    const struct hal kit_hal = port_hal();
    reset(true, true);
    chip.has_dma = has_dma;
    for (size_t i = 0; i < MOST; i++) {
        memory[i] = (uint8_t)(i * 2654435761u >> 13);
    }
    assert_int_equal(port_start(), 168000000);
    assert_int_equal(kit_hal.ops->open(NULL, board_here), HAL_OK);
    assert_int_equal(kit_hal.ops->bus_clock(NULL, 21000000), 21000000);
    return kit_hal;
}

/* All but the last 65535 bytes are out when it returns: the next band is drawn while these are sent. */
static void a_write_returns_while_its_bytes_are_sent(void **state)
{
    (void)state;
    const struct hal h = open_kit(true);
    assert_int_equal(h.ops->bus_write(NULL, HAL_DATA, memory, 100000), HAL_OK);
    assert_int_equal(chip.sent, 65535);
    assert_int_equal(h.ops->bus_wait(NULL), HAL_OK);
    assert_int_equal(chip.sent, 100000);
    assert_memory_equal(chip.wire, memory, 100000);
}

static void the_next_write_waits_and_d_c_moves_between_bytes(void **state)
{
    (void)state;
    const struct hal h = open_kit(true);
    static const uint8_t command[] = {0x2C};
    size_t at = 0;
    for (size_t i = 1; at + i < MOST - 8; at += i, i += i / 2 + 7) {
        assert_int_equal(h.ops->bus_write(NULL, HAL_DATA, memory + at, i), HAL_OK);
        assert_int_equal(h.ops->bus_write(NULL, HAL_COMMAND, command, 1), HAL_OK);
        assert_int_equal(h.ops->bus_wait(NULL), HAL_OK);
        for (size_t k = 0; k <= i; k++) {
            assert_int_equal(chip.wire[chip.sent - i - 1 + k], k < i ? memory[at + k] : command[0]);
            assert_int_equal(chip.wire_dc[chip.sent - i - 1 + k], k < i);
        }
        chip.sent = 0;
    }
    assert_int_equal(chip.d_c_moves_in_a_byte, 0);
}

static void a_fault_of_the_bus_is_told(void **state)
{
    (void)state;
    const struct hal h = open_kit(true);
    chip.fails = true;
    assert_int_equal(h.ops->bus_write(NULL, HAL_DATA, memory, 1000), HAL_OK);
    assert_int_equal(h.ops->bus_wait(NULL), HAL_EIO);
    chip.fails = false;
    assert_int_equal(h.ops->bus_write(NULL, HAL_DATA, memory, 1000), HAL_OK);
    assert_int_equal(h.ops->bus_wait(NULL), HAL_OK);
    assert_memory_equal(chip.wire, memory, 1000);
}

static void without_dma_the_bytes_are_the_same(void **state)
{
    (void)state;
    const struct hal h = open_kit(false);
    assert_int_equal(h.ops->bus_write(NULL, HAL_DATA, memory, 70000), HAL_OK);
    assert_int_equal(h.ops->bus_wait(NULL), HAL_OK);
    assert_int_equal(chip.sent, 70000);
    assert_memory_equal(chip.wire, memory, 70000);
}

/* RM0090, 7.3 and 3.9: the PLL is the clock, of 336 MHz / 2; APB1 has a quarter, APB2 a half; 5 wait states. */
static void with_a_crystal_the_chip_runs_at_168_mhz(void **state)
{
    (void)state;
    reset(true, true);
    assert_int_equal(port_start(), 168000000);
    tell();
    assert_int_equal(*word(0x40023808), 4u << 13 | 5u << 10 | 2u << 2 | 2u);
    assert_int_equal(*word(0x40023804), 0x2740540C);
    assert_int_equal(*word(0x40023C00) & 7, 5);
    assert_int_equal(*word(0x40004808), 365); /* 42 MHz / 115200 */
}

static void without_a_crystal_or_a_pll_it_stays_at_16_mhz(void **state)
{
    (void)state;
    for (int i = 0; i < 2; i++) {
        reset(i == 1, false);
        assert_int_equal(port_start(), 16000000);
        tell();
        assert_int_equal(*word(0x40023808), 0);
        assert_int_equal(*word(0x40004808), 139); /* 16 MHz / 115200 */
    }
}

static void the_kit_opens_and_closes_at_16_mhz(void **state)
{
    (void)state;
    const struct hal h = port_hal();
    reset(false, false);
    assert_int_equal(port_start(), 16000000);
    assert_int_equal(h.ops->open(NULL, board_here), HAL_OK);
    assert_int_equal(h.ops->bus_clock(NULL, 21000000), 8000000);
    assert_int_equal(h.ops->bus_write(NULL, HAL_DATA, memory, 100), HAL_OK);
    h.ops->close(NULL);
    tell();
    assert_int_equal(*word(0x40003800) & 64, 0);
}

/* A fault stops the stream in the middle of a transfer; the panel is then turned off byte by byte. */
static void a_stop_in_a_transfer_leaves_the_bus_to_the_cpu(void **state)
{
    (void)state;
    const struct hal h = open_kit(true);
    assert_int_equal(h.ops->bus_write(NULL, HAL_DATA, memory, 1000), HAL_OK);
    assert_int_equal(chip.sent, 0);
    port_bus_stop();
    assert_int_equal(h.ops->bus_write(NULL, HAL_COMMAND, memory, 20), HAL_OK);
    assert_int_equal(h.ops->bus_wait(NULL), HAL_OK);
    assert_int_equal(chip.sent, 20);
}

/* RM0090, 30.6.1: PE, FE and NF are bits 0 to 2 of SR, ORE is bit 3, RXNE bit 5. */
static void a_damaged_byte_is_not_taken_and_an_overrun_is_ended(void **state)
{
    (void)state;
    reset(true, true);
    port_start();
    for (uint32_t errors = 0; errors < 16; errors++) {
        *word(0x40004800) = 1u << 5 | errors;
        *word(0x40004804) = 'B';
        assert_int_equal(port_log_read(), (errors & 7) == 0 ? 'B' : -1);
        assert_int_equal(chip.last, 0x40004804); /* a read of DR clears the errors */
    }
    *word(0x40004800) = 1u << 3;
    assert_int_equal(port_log_read(), -1);
    assert_int_equal(chip.last, 0x40004804);
    *word(0x40004800) = 0;
    assert_int_equal(port_log_read(), -1);
    assert_int_equal(chip.last, 0x40004800);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(with_a_crystal_the_chip_runs_at_168_mhz),
        cmocka_unit_test(without_a_crystal_or_a_pll_it_stays_at_16_mhz),
        cmocka_unit_test(the_kit_opens_and_closes_at_16_mhz),
        cmocka_unit_test(a_stop_in_a_transfer_leaves_the_bus_to_the_cpu),
        cmocka_unit_test(a_write_returns_while_its_bytes_are_sent),
        cmocka_unit_test(the_next_write_waits_and_d_c_moves_between_bytes),
        cmocka_unit_test(a_fault_of_the_bus_is_told),
        cmocka_unit_test(without_dma_the_bytes_are_the_same),
        cmocka_unit_test(a_damaged_byte_is_not_taken_and_an_overrun_is_ended),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* What the port takes from elsewhere. */
extern const struct board board_feather_stm32f405;
const struct board *const board_here = &board_feather_stm32f405;

void cortexm_dark(void)
{
}

unsigned cortexm_time_us(void *context)
{
    (void)context;
    return 0;
}

void cortexm_delay_us(void *context, unsigned us)
{
    (void)context;
    (void)us;
}
