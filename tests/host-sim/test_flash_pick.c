/* Which board pinhole-flash takes when there is none, one or several, and the line when it takes none. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "flash_image.h"
#include "flash_pick.h"

#include <stdio.h>
#include <string.h>

static const struct flash_board alike[] = {{.bus = 1, .address = 7, .chip = FLASH_RP2040, .serial = "E0C9125B0D9B"},
                                           {.bus = 3, .address = 12, .chip = FLASH_RP2040, .serial = "E0C9125B0D9B"}};
static const struct flash_board mixed[] = {{.bus = 1, .address = 2, .chip = FLASH_RP2350, .serial = "AAAA"},
                                           {.bus = 1, .address = 3, .chip = FLASH_RP2040, .serial = "BBBB"},
                                           {.bus = 1, .address = 4, .chip = FLASH_RP2040, .serial = "CCCC"},
                                           {.bus = 1, .address = 5, .chip = FLASH_RP2040, .serial = ""}};
static const struct flash_board closed[] = {{.bus = 2, .address = 9, .chip = FLASH_RP2040, .serial = "BBBB"},
                                            {.bus = 2, .address = 10, .chip = FLASH_RP2040, .status = HAL_EACCES}};

static enum flash_chip chip = FLASH_RP2040;

static void picks(const struct flash_board *boards, int count, const char *serial, int index)
{
    char error[FLASH_ERROR_SIZE] = "";
    assert_int_equal(flash_pick(boards, count, chip, serial, error), index);
    assert_string_equal(error, "");
}

static void refuses(const struct flash_board *boards, int count, const char *serial, const char *line)
{
    char error[FLASH_ERROR_SIZE] = "";
    assert_int_equal(flash_pick(boards, count, chip, serial, error), PH_ERR_INVAL);
    assert_string_equal(error, line);
}

static void the_only_one_is_taken(void **state)
{
    (void)state;
    picks(alike, 1, NULL, 0);
    picks(alike, 1, "E0C9125B0D9B", 0);
    picks(mixed, 2, NULL, 1);
    picks(closed + 1, 1, NULL, 0); /* opening it will say why not */
}

static void one_of_several_by_number_or_place(void **state)
{
    (void)state;
    picks(alike, 2, "1:7", 0);
    picks(alike, 2, "3:12", 1);
    picks(mixed, 4, "CCCC", 2);
    picks(mixed, 4, "1:5", 3);
    picks(closed, 2, "BBBB", 0);
    picks(closed, 2, "XXXX", 1); /* may be the one whose number cannot be read */
}

static void none(void **state)
{
    (void)state;
    refuses(alike, 0, NULL,
            "no RP2040 in its boot loader (2e8a:0003) on USB; plug it in with BOOTSEL held, or send B to the UART of a "
            "running image");
    refuses(
        mixed, 1, NULL,
        "no RP2040 in its boot loader (2e8a:0003) on USB (an RP2350 is, which needs another image); plug it in with "
        "BOOTSEL held, or send B to the UART of a running image");
}

static void several(void **state)
{
    (void)state;
    refuses(alike, 2, NULL,
            "2 RP2040s match: 1:7 (E0C9125B0D9B), 3:12 (E0C9125B0D9B); choose one with --serial BUS:ADDRESS (their "
            "serial numbers are alike)");
    refuses(alike, 2, "E0C9125B0D9B",
            "2 RP2040s match: 1:7 (E0C9125B0D9B), 3:12 (E0C9125B0D9B); choose one with --serial BUS:ADDRESS (their "
            "serial numbers are alike)");
    refuses(mixed, 4, NULL,
            "3 RP2040s match: 1:3 (BBBB), 1:4 (CCCC), 1:5 (no serial number); choose one with --serial NUMBER or "
            "BUS:ADDRESS");
    refuses(closed, 2, NULL,
            "2 RP2040s match: 2:9 (BBBB), 2:10 (cannot be opened); choose one with --serial NUMBER or BUS:ADDRESS");
}

static void another_number(void **state)
{
    (void)state;
    refuses(alike, 1, "X1", "no RP2040 in its boot loader is 'X1'; on USB: 1:7 (E0C9125B0D9B)");
    refuses(mixed, 4, "AAAA",
            "no RP2040 in its boot loader is 'AAAA'; on USB: 1:3 (BBBB), 1:4 (CCCC), 1:5 (no serial number)");
    refuses(mixed, 4, "1:2",
            "no RP2040 in its boot loader is '1:2'; on USB: 1:3 (BBBB), 1:4 (CCCC), 1:5 (no serial number)");
    refuses(closed, 2, "2:11", "no RP2040 in its boot loader is '2:11'; on USB: 2:9 (BBBB), 2:10 (cannot be opened)");
}

/* Numbers of any length and as many boards as there may be: the line is whole. */
static void many_with_long_numbers(void **state)
{
    (void)state;
    static struct flash_board many[FLASH_BOARDS_MAX];
    char error[FLASH_ERROR_SIZE];
    for (int i = 0; i < FLASH_BOARDS_MAX; i++) {
        many[i] = (struct flash_board){.bus = 255, .address = (uint8_t)(200 + i), .chip = FLASH_RP2040};
        memset(many[i].serial, 'S', sizeof many[i].serial - 1);
    }
    assert_int_equal(flash_pick(many, FLASH_BOARDS_MAX, FLASH_RP2040, NULL, error), PH_ERR_INVAL);
    assert_non_null(strstr(error, "choose one with --serial BUS:ADDRESS (their serial numbers are alike)"));
    assert_int_equal(flash_pick(many, FLASH_BOARDS_MAX, FLASH_RP2040, "255:231", error), 31);
}

/* An image for an RP2350, and a scene, which is for any chip. */
static void the_image_names_the_chip(void **state)
{
    (void)state;
    chip = FLASH_RP2350;
    picks(mixed, 4, NULL, 0);
    picks(mixed, 4, "AAAA", 0);
    refuses(alike, 2, NULL,
            "no RP2350 in its boot loader (2e8a:000f) on USB (an RP2040 is, which needs another image); plug it in "
            "with BOOTSEL held, or send B to the UART of a running image");
    refuses(mixed, 4, "BBBB", "no RP2350 in its boot loader is 'BBBB'; on USB: 1:2 (AAAA)");
    chip = FLASH_ANY;
    picks(mixed, 4, "AAAA", 0);
    picks(mixed, 4, "BBBB", 1);
    refuses(mixed, 0, NULL,
            "no RP2040 or RP2350 in its boot loader (2e8a:0003 or 2e8a:000f) on USB; plug it in with BOOTSEL held, or "
            "send B to the UART of a running image");
    refuses(mixed, 2, NULL, "2 boards match: 1:2 (AAAA), 1:3 (BBBB); choose one with --serial NUMBER or BUS:ADDRESS");
    chip = FLASH_RP2040;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_only_one_is_taken),
        cmocka_unit_test(one_of_several_by_number_or_place),
        cmocka_unit_test(none),
        cmocka_unit_test(several),
        cmocka_unit_test(another_number),
        cmocka_unit_test(the_image_names_the_chip),
        cmocka_unit_test(many_with_long_numbers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
