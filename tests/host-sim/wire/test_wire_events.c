/* wire_events: each kind of line, its fields at their limits, and the reason why another line is none. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "hal.h"
#include "wire_events.h"

#include <stdio.h>
#include <string.h>

static char line[400];
static struct wire_event event;

/* Parses a line; NULL, or the reason why it is wrong. */
static const char *parse(const char *text)
{
    const char *error = NULL;
    snprintf(line, sizeof line, "%s", text);
    memset(&event, 0x5a, sizeof event);
    const int status = wire_parse(line, &event, &error);
    assert_int_equal(status, error == NULL ? 1 : HAL_EINVAL);
    return error;
}

static void comments_and_empty_lines_are_no_events(void **state)
{
    (void)state;
    static const char *const none[] = {"", "\n", "\r\n", "# 1 level 0\n", "#"};
    for (size_t i = 0; i < sizeof none / sizeof none[0]; i++) {
        const char *error = "as it was";
        snprintf(line, sizeof line, "%s", none[i]);
        assert_int_equal(wire_parse(line, &event, &error), 0);
        assert_string_equal(error, "as it was");
    }
}

static void a_line_gets_a_name(void **state)
{
    (void)state;
    assert_null(parse("12 name 63 GPIO25 or so\r\n"));
    assert_int_equal(event.kind, WIRE_NAME);
    assert_int_equal(event.time_ns, 12);
    assert_int_equal(event.number, 63);
    assert_string_equal(event.text, "GPIO25 or so");
    assert_null(parse("0 name 0 x"));
    static const char *const wrong[] = {"0 name 64 x", "0 name 1", "0 name 1 ", "0 name x y", "0 name", "0 name -1 x"};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        assert_string_equal(parse(wrong[i]), "a name needs BIT (0 .. 63) and TEXT");
    }
}

static void levels_are_64_bits_in_hexadecimal(void **state)
{
    (void)state;
    assert_null(parse("18446744073709551615 level fEdCbA9876543210"));
    assert_int_equal(event.kind, WIRE_LEVEL);
    assert_true(event.time_ns == UINT64_MAX && event.end_ns == UINT64_MAX);
    assert_true(event.levels == 0xfedcba9876543210u);
    assert_null(parse("0 level FFFFFFFFFFFFFFFF"));
    assert_true(event.levels == UINT64_MAX);
    static const char *const wrong[] = {"0 level 10000000000000000",
                                        "0 level g",
                                        "0 level G",
                                        "0 level",
                                        "0 level ",
                                        "0 level 0x1",
                                        "0 level :",
                                        "0 level @",
                                        "0 level `"};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        assert_string_equal(parse(wrong[i]), "LEVELS are not hexadecimal");
    }
}

static void a_transfer_has_all_its_fields(void **state)
{
    (void)state;
    assert_null(parse("100 spi 2 62500000 40000000 4b 16 8a 9 250 00ff7Fa0\n"));
    assert_int_equal(event.kind, WIRE_SPI);
    assert_int_equal(event.time_ns, 100);
    assert_int_equal(event.end_ns, 250);
    assert_int_equal(event.select, 2);
    assert_int_equal(event.asked_hz, 62500000);
    assert_int_equal(event.got_hz, 40000000);
    assert_int_equal(event.mode, 0x4b);
    assert_int_equal(event.word_bits, 16);
    assert_int_equal(event.levels, 0x8a);
    assert_int_equal(event.levels_at_end, 9);
    assert_int_equal(event.count, 4);
    assert_memory_equal(event.bytes, "\x00\xff\x7f\xa0", 4);
    assert_null(parse("100 read - 1 1 0 8 0 0 100 "));
    assert_int_equal(event.kind, WIRE_READ);
    assert_int_equal(event.select, WIRE_NO_SELECT);
    assert_int_equal(event.count, 0);
    assert_int_equal(event.end_ns, 100);
}

static void each_field_of_a_transfer_may_be_wrong(void **state)
{
    (void)state;
    static const struct {
        const char *text, *error;
    } wrong[] = {{"9 spi x 1 1 0 8 0 0 9 00", "SELECT is no number and not '-'"},
                 {"9 spi -1 1 1 0 8 0 0 9 00", "SELECT is no number and not '-'"},
                 {"9 spi 4294967296 1 1 0 8 0 0 9 00", "SELECT is no number and not '-'"},
                 {"9 spi", "SELECT is no number and not '-'"},
                 {"9 spi - x 1 0 8 0 0 9 00", "ASKED and GOT are no clocks in Hz"},
                 {"9 spi - 1 x 0 8 0 0 9 00", "ASKED and GOT are no clocks in Hz"},
                 {"9 spi - 1 0 0 8 0 0 9 00", "ASKED and GOT are no clocks in Hz"},
                 {"9 spi - 1 a 0 8 0 0 9 00", "ASKED and GOT are no clocks in Hz"},
                 {"9 spi - 1 1 x 8 0 0 9 00", "MODE and BITS are no numbers"},
                 {"9 spi - 1 1 0 x 0 0 9 00", "MODE and BITS are no numbers"},
                 {"9 spi - 1 1 0 a 0 0 9 00", "MODE and BITS are no numbers"},
                 {"9 spi - 1 1 0 8 x 0 9 00", "LEVELS are not hexadecimal"},
                 {"9 spi - 1 1 0 8 0 x 9 00", "LEVELS are not hexadecimal"},
                 {"9 spi - 1 1 0 8 0 0 8 00", "END_TIME is no time, or before TIME"},
                 {"9 spi - 1 1 0 8 0 0 a 00", "END_TIME is no time, or before TIME"},
                 {"9 spi - 1 1 0 8 0 0", "END_TIME is no time, or before TIME"},
                 {"9 spi - 1 1 0 8 0 0 9 0", "BYTES are not pairs of hexadecimal digits"},
                 {"9 spi - 1 1 0 8 0 0 9 000", "BYTES are not pairs of hexadecimal digits"},
                 {"9 spi - 1 1 0 8 0 0 9 0g", "BYTES are not pairs of hexadecimal digits"},
                 {"9 spi - 1 1 0 8 0 0 9 g0", "BYTES are not pairs of hexadecimal digits"},
                 {"9 read - 1 1 0 8 0 0 9 00 00", "BYTES are not pairs of hexadecimal digits"}};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        const char *const error = parse(wrong[i].text);
        assert_non_null(error);
        assert_string_equal(error, wrong[i].error);
    }
}

static void a_message_on_the_i2c_bus_has_an_address(void **state)
{
    (void)state;
    assert_null(parse("5 i2c 3c 400000 9 00af"));
    assert_int_equal(event.kind, WIRE_I2C);
    assert_true(event.time_ns == 5 && event.end_ns == 9 && event.number == 0x3C && event.got_hz == 400000);
    assert_int_equal(event.count, 2);
    assert_memory_equal(event.bytes, "\x00\xAF", 2);
    assert_string_equal(parse("5 i2c 80 400000 9 00"), "ADDRESS is no hexadecimal number of 7 bits");
    assert_string_equal(parse("5 i2c x 400000 9 00"), "ADDRESS is no hexadecimal number of 7 bits");
    assert_string_equal(parse("5 i2c 3c 0 9 00"), "HZ is no clock");
    assert_string_equal(parse("5 i2c 3c 400000 4 00"), "END_TIME is no time, or before TIME");
    assert_string_equal(parse("5 i2c 3c 400000 9 0"), "BYTES are not pairs of hexadecimal digits");
}

static void lost_events_are_counted_and_notes_are_text(void **state)
{
    (void)state;
    assert_null(parse("7 lost 4294967295"));
    assert_int_equal(event.kind, WIRE_LOST);
    assert_int_equal(event.number, UINT32_MAX);
    assert_string_equal(parse("7 lost 4294967296"), "COUNT is no number");
    assert_string_equal(parse("7 lost x"), "COUNT is no number");
    assert_null(parse("8 note frame  2 "));
    assert_int_equal(event.kind, WIRE_NOTE);
    assert_int_equal(event.time_ns, 8);
    assert_int_equal(event.end_ns, 8);
    assert_string_equal(event.text, "frame  2 ");
    assert_null(parse("8 note"));
    assert_string_equal(event.text, "");
}

static void time_and_kind_come_first(void **state)
{
    (void)state;
    static const char *const no_time[] = {"level 0", " 1 level 0", "-1 level 0", "18446744073709551616 level 0",
                                          "1a level 0"};
    for (size_t i = 0; i < sizeof no_time / sizeof no_time[0]; i++) {
        assert_string_equal(parse(no_time[i]), "TIME is no number of ns");
    }
    static const char *const no_kind[] = {"1", "1 ", "1 levels 0", "1 LEVEL 0", "1  level 0"};
    for (size_t i = 0; i < sizeof no_kind / sizeof no_kind[0]; i++) {
        assert_string_equal(parse(no_kind[i]), "no such kind of event");
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(comments_and_empty_lines_are_no_events),
        cmocka_unit_test(a_line_gets_a_name),
        cmocka_unit_test(levels_are_64_bits_in_hexadecimal),
        cmocka_unit_test(a_transfer_has_all_its_fields),
        cmocka_unit_test(each_field_of_a_transfer_may_be_wrong),
        cmocka_unit_test(a_message_on_the_i2c_bus_has_an_address),
        cmocka_unit_test(lost_events_are_counted_and_notes_are_text),
        cmocka_unit_test(time_and_kind_come_first),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
