/* dma: channels of the emulated RP2350 that feed an SPI unit at its pace, and their registers. The test plays memory
 * and the units. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "rp2350/chip.h"

#include <string.h>

static struct chip chip;
static uint32_t room[2], pushed[2][32], pushes[2], read_bytes;
static unsigned warnings;

/* ---- in place of the rest of the chip ----------------------------------------------------------------------- */

bool spi_wants(const struct chip *of, uint32_t unit)
{
    assert_ptr_equal(of, &chip);
    return room[unit] > 0;
}

void spi_push(struct chip *of, uint32_t unit, uint32_t word)
{
    assert_ptr_equal(of, &chip);
    room[unit]--;
    pushed[unit][pushes[unit]++ % 32] = word;
}

/* The bytes of memory are their addresses. */
uint32_t memory_dma_read(struct chip *of, uint32_t address, uint32_t bytes)
{
    uint32_t word = 0;
    assert_ptr_equal(of, &chip);
    read_bytes = bytes;
    for (uint32_t i = bytes; i-- > 0;) {
        word = word << 8 | ((address + i) & 0xff);
    }
    return word;
}

void chip_warn(struct chip *of, const char *format, ...)
{
    assert_true(of == &chip && format != NULL);
    warnings++;
}

/* ---- the tests ---------------------------------------------------------------------------------------------- */

enum { BYTES = 0, HALVES = 1 << 2, WORDS = 2 << 2, EN = 1, INCR_READ = 1 << 4, BSWAP = 1 << 24, BUSY = 1 << 26 };
enum { SPI0 = 24 << 17, SPI1 = 26 << 17 }; /* DREQ_SPI0_TX, DREQ_SPI1_TX: 12.6.4.1 */
enum { READ_ADDR = 0, WRITE_ADDR = 4, TRANS_COUNT = 8, CTRL_TRIG = 12, AL1_CTRL = 16, AL3_READ_ADDR_TRIG = 0x3c };
enum { INTR = 0x400, INTE0 = 0x404, INTS0 = 0x40c, INTE1 = 0x414, INTS1 = 0x41c };

static int fresh(void **state)
{
    (void)state;
    chip = (struct chip){.ended = NULL};
    memset(room, 0, sizeof room);
    memset(pushes, 0, sizeof pushes);
    warnings = 0;
    return 0;
}

static void put(uint32_t channel, uint32_t offset, uint32_t value)
{
    dma_write(&chip, 0x40 * channel + offset, value);
}

static uint32_t get(uint32_t channel, uint32_t offset)
{
    return dma_read(&chip, 0x40 * channel + offset);
}

static void start(uint32_t channel, uint32_t from, uint32_t count, uint32_t control)
{
    put(channel, READ_ADDR, from);
    put(channel, TRANS_COUNT, count);
    put(channel, CTRL_TRIG, control);
}

static void a_channel_gives_what_the_unit_wants_and_then_asks(void **state)
{
    (void)state;
    room[1] = 2;
    start(3, 0x20000010, 5, EN | INCR_READ | SPI1);
    assert_true(pushes[1] == 2 && pushes[0] == 0 && read_bytes == 1);
    assert_int_equal(get(3, TRANS_COUNT), 3);
    assert_int_equal(get(3, READ_ADDR), 0x20000012);
    assert_int_equal(get(3, CTRL_TRIG), EN | INCR_READ | SPI1 | BUSY);
    assert_int_equal(dma_read(&chip, INTR), 0);
    room[1] = 9;
    dma_feed(&chip);
    assert_int_equal(pushes[1], 5);
    for (uint32_t i = 0; i < 5; i++) {
        assert_int_equal(pushed[1][i], 0x10 + i);
    }
    assert_int_equal(get(3, CTRL_TRIG), EN | INCR_READ | SPI1);
    assert_int_equal(dma_read(&chip, INTR), 1 << 3);
    assert_int_equal(get(3, TRANS_COUNT), 0);
    dma_feed(&chip);
    assert_int_equal(pushes[1], 5);
    start(15, 0x20000020, 1, EN | SPI0);
    assert_int_equal(pushes[0], 0);
    room[0] = 1;
    dma_feed(&chip);
    assert_true(pushes[0] == 1 && pushed[0][0] == 0x20);
    assert_int_equal(warnings, 0);
}

static void words_are_of_a_size_and_may_be_swapped(void **state)
{
    static const struct {
        uint32_t control, first, second;
    } cases[] = {
        {BYTES, 0x40, 0x41},         {HALVES, 0x4140, 0x4342},         {WORDS, 0x43424140, 0x47464544},
        {BYTES | BSWAP, 0x40, 0x41}, {HALVES | BSWAP, 0x4041, 0x4243}, {WORDS | BSWAP, 0x40414243, 0x44454647}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        fresh(NULL);
        room[1] = 2;
        start(0, 0x20000040, 2, EN | INCR_READ | SPI1 | cases[i].control);
        assert_int_equal(pushed[1][0], cases[i].first);
        assert_int_equal(pushed[1][1], cases[i].second);
    }
    room[1] = 2;
    start(0, 0x20000040, 2, EN | SPI1); /* the address stays */
    assert_true(pushed[1][2] == 0x40 && pushed[1][3] == 0x40);
    assert_int_equal(get(0, READ_ADDR), 0x20000040);
}

/* The last register of each of the four groups starts; 12.6.2.1. */
static void a_channel_starts_by_its_triggers_alone(void **state)
{
    static const uint8_t names[16] = {'R', 'W', 'T', 'C', 'C', 'R', 'W', 'T', 'C', 'T', 'R', 'W', 'C', 'W', 'T', 'R'};
    (void)state;
    for (uint32_t i = 0; i < 16; i++) {
        fresh(NULL);
        chip.channel[2] = (struct channel){.read = 'r', .write = 'w', .reload = 't', .control = EN | SPI1};
        put(2, 4 * i, EN | SPI0);
        const struct channel *const c = &chip.channel[2];
        assert_int_equal(c->read, names[i] == 'R' ? EN | SPI0 : 'r');
        assert_int_equal(c->write, names[i] == 'W' ? EN | SPI0 : 'w');
        assert_int_equal(c->reload, names[i] == 'T' ? EN | SPI0 : 't');
        assert_int_equal(c->control, names[i] == 'C' ? EN | SPI0 : EN | SPI1);
        assert_int_equal(c->busy, i % 4 == 3);
    }
    fresh(NULL);
    start(2, 0x20000000, 0, EN | SPI1);
    assert_false(chip.channel[2].busy);
    start(2, 0x20000000, 4, SPI1); /* not enabled */
    assert_false(chip.channel[2].busy);
    put(2, AL1_CTRL, EN | SPI1);
    assert_false(chip.channel[2].busy);
    put(2, AL3_READ_ADDR_TRIG, 0x20000004);
    assert_true(chip.channel[2].busy && chip.channel[2].count == 4 && warnings == 0);
    put(2, WRITE_ADDR, 0);
    assert_int_equal(warnings, 1); /* it works */
}

static void interrupts_are_enabled_for_each_line_and_cleared(void **state)
{
    (void)state;
    chip.dma_interrupts = 0xf0;
    dma_write(&chip, INTE0, 0x10033);
    dma_write(&chip, INTE1, 0x50);
    assert_int_equal(dma_read(&chip, INTE0), 0x33);
    assert_int_equal(dma_read(&chip, INTE1), 0x50);
    assert_int_equal(dma_read(&chip, INTS0), 0x30);
    assert_int_equal(dma_read(&chip, INTS1), 0x50);
    dma_write(&chip, INTS0, 0x10);
    assert_int_equal(dma_read(&chip, INTR), 0xe0);
    dma_write(&chip, INTS1, 0x40);
    dma_write(&chip, INTR, 0x80);
    assert_int_equal(dma_read(&chip, INTR), 0x20);
    assert_int_equal(warnings, 0);
    dma_write(&chip, 0x408, 1);
    assert_int_equal(dma_read(&chip, 0x444), 0);
    assert_int_equal(warnings, 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(a_channel_gives_what_the_unit_wants_and_then_asks, fresh),
        cmocka_unit_test_setup(words_are_of_a_size_and_may_be_swapped, fresh),
        cmocka_unit_test_setup(a_channel_starts_by_its_triggers_alone, fresh),
        cmocka_unit_test_setup(interrupts_are_enabled_for_each_line_and_cleared, fresh),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
