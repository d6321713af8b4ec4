/* emulate_registers: the lines of QEMU's trace, the time that they tell, and registers that QEMU does not have, in a
 * chip that is made up. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "complain.h"
#include "emulate_registers.h"
#include "stderr_capture.h"

#include <stdio.h>
#include <string.h>

enum { UNIT = 0x40001000, KEPT = UNIT, WAITS = UNIT + 4, BYTE = UNIT + 8 };

static const struct register_field all[] = {{"ALL", 0, 32, 0, UINT32_MAX, "anything"}};
static const struct register_when waits[] = {
    {.need = REGISTER_WAITED, .address = KEPT, .mask = 1, .value = 1000, .why = "too soon"}};
static const struct register_row rows[] = {
    {"KEPT", 0, .fields = REGISTER_LIST(all), .source = "1"},
    {"WAITS", 4, .fields = REGISTER_LIST(all), .when = REGISTER_LIST(waits), .source = "2"},
    {"BYTE", 8, .narrow = true, .fields = REGISTER_LIST(all), .source = "3"},
};
static const struct register_block blocks[] = {{"UNIT", UNIT, 0x100, .rows = rows, .row_count = 3}};
static const struct register_chip chip = {"CHIP", "its manual", REGISTER_LIST(blocks), .resets = 0};

static struct emulate_registers r;
static struct emulate_access access;
static struct stderr_capture said;

static int fresh(void **state)
{
    (void)state;
    return emulate_registers_open(&r, &chip);
}

static int end(void **state)
{
    (void)state;
    emulate_registers_close(&r);
    return 0;
}

static int line(const char *text)
{
    stderr_capture_begin(&said);
    const int status = emulate_registers_line(&r, text, &access);
    stderr_capture_end(&said);
    return status;
}

/* As QEMU 10 writes it. */
static int access_line(const char *what, uint32_t address, uint32_t value, unsigned bytes, const char *name)
{
    char text[200];
    snprintf(text, sizeof text, "memory_region_ops_%s cpu 0 mr 0x55d0c0ffee addr 0x%x value 0x%x size %u name '%s'",
             what, (unsigned)address, (unsigned)value, bytes, name);
    return line(text);
}

static int store(uint32_t address, uint32_t value)
{
    return access_line("write", address, value, 4, "unit");
}

static int load(uint32_t address, uint32_t value)
{
    return access_line("read", address, value, 4, "unit");
}

static void an_access_is_read_from_its_line(void **state)
{
    (void)state;
    assert_int_equal(store(KEPT, 0x1234abcd), 0);
    assert_true(access.store && !access.load && !access.tick);
    assert_true(access.address == KEPT && access.value == 0x1234abcd && access.bytes == 4);
    assert_int_equal(registers_value(r.model, 0, KEPT), 0x1234abcd);
    assert_int_equal(load(KEPT, 0x1234abcd), 0);
    assert_true(!access.store && access.load && access.value == 0x1234abcd);
    assert_int_equal(access_line("write", BYTE, 0x7f, 1, "unit"), 0);
    assert_int_equal(access.bytes, 1);
    assert_int_equal(access_line("write", KEPT, 7, 4, "systick"), 0); /* it is told of once more */
    assert_true(!access.store && !access.load);
    assert_int_equal(access_line("read", KEPT, 7, 4, "systick"), 0);
    assert_true(!access.store && !access.load);
    assert_int_equal(registers_value(r.model, 0, KEPT), 0x1234abcd);
    assert_int_equal(line("memory_region_ops_other"), 0);
    assert_true(!access.store && !access.load && !access.tick);
    assert_int_equal(emulate_registers_said(&r), 0);
}

static void what_the_chip_refuses_is_told(void **state)
{
    (void)state;
    assert_int_equal(store(UNIT + 0x10, 5), COMPLAINED);
    assert_non_null(strstr(said.text, "UNIT ? (40001010) = 00000005: no such register"));
    assert_int_equal(load(UNIT + 0x10, 5), COMPLAINED);
    assert_non_null(strstr(said.text, "UNIT ? (40001010) reads 00000005: no such register"));
    assert_int_equal(access_line("write", KEPT, 1, 2, "unit"), COMPLAINED);
    assert_non_null(strstr(said.text, "whole words only"));
}

/* Before SysTick runs an access takes at least 128 ns; then only its interrupts tell the time, each millisecond. */
static void time_is_that_of_accesses_and_then_of_ticks(void **state)
{
    (void)state;
    assert_int_equal(store(KEPT, 1), 0);
    assert_int_equal(r.time_ns, 128);
    for (int i = 0; i < 7; i++) {
        assert_int_equal(load(BYTE, 0), 0);
    }
    assert_int_equal(r.time_ns, 1024);
    assert_int_equal(store(WAITS, 1), 0); /* at 1024 - 0 ns */
    assert_int_equal(store(KEPT, 0), 0);
    assert_int_equal(store(WAITS, 0), COMPLAINED);
    assert_non_null(strstr(said.text, "too soon"));
    const uint64_t before = r.time_ns;
    assert_int_equal(line("nvic_acknowledge_irq nvic acknowledge IRQ: 15 now active (prio 0)"), 0);
    assert_true(access.tick && !access.store && !access.load);
    assert_int_equal(r.time_ns, before + 1000000);
    assert_int_equal(store(WAITS, 0), 0);
    assert_int_equal(r.time_ns, before + 1000000);
}

/* QEMU reads 0 where it has no unit: the load reads what was written, and a store right after it keeps those bits. */
static void a_register_that_qemu_does_not_have_keeps_its_bits(void **state)
{
    (void)state;
    assert_int_equal(store(KEPT, 0xf0), 0);
    assert_int_equal(load(KEPT, 0), 0);
    assert_int_equal(store(KEPT, 1), 0);
    assert_int_equal(registers_value(r.model, 0, KEPT), 0xf1);
    assert_int_equal(store(KEPT, 2), 0); /* not right after the load */
    assert_int_equal(registers_value(r.model, 0, KEPT), 2);
    assert_int_equal(load(KEPT, 0), 0);
    assert_int_equal(store(BYTE, 1), 0); /* another register */
    assert_int_equal(registers_value(r.model, 0, BYTE), 1);
    assert_int_equal(store(KEPT, 4), 0);
    assert_int_equal(registers_value(r.model, 0, KEPT), 4);
    assert_int_equal(load(KEPT, 4), 0); /* QEMU has it */
    assert_int_equal(store(KEPT, 8), 0);
    assert_int_equal(registers_value(r.model, 0, KEPT), 8);
}

static void the_first_other_line_is_what_qemu_says(void **state)
{
    (void)state;
    assert_int_equal(emulate_registers_said(&r), 0);
    assert_int_equal(line("Invalid access at addr 0x7\nmore"), 0);
    assert_int_equal(line("another"), 0);
    assert_true(!access.tick && !access.store && !access.load);
    stderr_capture_begin(&said);
    assert_int_equal(emulate_registers_said(&r), COMPLAINED);
    stderr_capture_end(&said);
    assert_non_null(strstr(said.text, "QEMU says: Invalid access at addr 0x7\n"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(an_access_is_read_from_its_line, fresh, end),
        cmocka_unit_test_setup_teardown(what_the_chip_refuses_is_told, fresh, end),
        cmocka_unit_test_setup_teardown(time_is_that_of_accesses_and_then_of_ticks, fresh, end),
        cmocka_unit_test_setup_teardown(a_register_that_qemu_does_not_have_keeps_its_bits, fresh, end),
        cmocka_unit_test_setup_teardown(the_first_other_line_is_what_qemu_says, fresh, end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
