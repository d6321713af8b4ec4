/* rom_uf2: which UF2 files the boot loader of an RP2350 takes, and where in flash their pages lie. Each field of the
 * block against erratum E10 and of the others is wrong once. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "rp2350/rom.h"
#include "uf2_make.h"

#include <stdlib.h>
#include <string.h>

enum { PAGES = 3, PAGE = 256, FILE_BYTES = (PAGES + 1) * 512 };

static uint8_t file[FILE_BYTES + 512], bin[PAGES * PAGE];
static uint8_t *flash;
static struct rom_uf2 uf2;

static int make_flash(void **state)
{
    (void)state;
    flash = malloc(FLASH_BYTES);
    return flash == NULL;
}

static int free_flash(void **state)
{
    (void)state;
    free(flash);
    return 0;
}

static int fresh(void **state)
{
    (void)state;
    memset(file, 0, sizeof file);
    uf2_make_bin(bin, sizeof bin, 1);
    uf2_make_e10(file);
    uf2_make(file + 512, bin, sizeof bin);
    uf2_for_rp2350(file + 512, PAGES);
    for (uint32_t i = 0; i < PAGES; i++) {
        memcpy(bin + i * PAGE, file + 512 * (i + 1) + UF2_DATA, PAGE);
    }
    return 0;
}

static void takes(uint32_t bytes, uint32_t family)
{
    const char *const why = rom_uf2_refused(file, FILE_BYTES, flash, &uf2);
    if (why != NULL) {
        fail_msg("%s", why);
    }
    assert_int_equal(uf2.bytes, bytes);
    assert_int_equal(uf2.family, family);
}

static void refuses(const char *part)
{
    const char *const why = rom_uf2_refused(file, FILE_BYTES, flash, &uf2);
    if (why == NULL || strstr(why, part) == NULL) {
        fail_msg("'%s' is not in '%s'", part, why != NULL ? why : "taken");
    }
    fresh(NULL);
}

static uint8_t *block(uint32_t i, uint32_t field)
{
    return file + 512 * (i + 1) + field;
}

static void put_all(uint32_t field, uint32_t value)
{
    for (uint32_t i = 0; i < PAGES; i++) {
        uf2_put(block(i, field), value);
    }
}

static void pages_go_to_their_addresses_in_any_order(void **state)
{
    (void)state;
    memset(flash, 0xff, PAGES * PAGE + 1);
    takes(PAGES * PAGE, 0xe48bff59);
    assert_memory_equal(flash, bin, sizeof bin);
    assert_int_equal(flash[sizeof bin], 0xff);
    uint8_t swap[512];
    memcpy(swap, block(0, 0), 512);
    memcpy(block(0, 0), block(2, 0), 512);
    memcpy(block(2, 0), swap, 512);
    memset(flash, 0xff, sizeof bin);
    takes(PAGES * PAGE, 0xe48bff59);
    assert_memory_equal(flash, bin, sizeof bin);
    uf2_put(block(1, UF2_ADDRESS), 0x10fffF00); /* the last page of the flash */
    takes(FLASH_BYTES, 0xe48bff59);
    assert_memory_equal(flash + FLASH_BYTES - PAGE, bin + PAGE, PAGE);
}

static void file_begins_with_the_block_against_e10(void **state)
{
    static const uint32_t fields[] = {UF2_MAGIC_0, UF2_MAGIC_1, UF2_FLAGS,  UF2_ADDRESS,   UF2_SIZE,
                                      UF2_NUMBER,  UF2_TOTAL,   UF2_FAMILY, UF2_MAGIC_END, UF2_DATA + PAGE};
    (void)state;
    for (size_t i = 0; i < sizeof fields / sizeof fields[0]; i++) {
        file[fields[i]] ^= 1;
        refuses("does not begin with the block against erratum RP2350-E10");
    }
    assert_non_null(rom_uf2_refused(file, 1023, flash, &uf2));
    assert_non_null(strstr(rom_uf2_refused(file, 1024, flash, &uf2), "are missing"));
}

static void each_field_of_a_block_is_looked_at(void **state)
{
    static const uint32_t magics[] = {UF2_MAGIC_0, UF2_MAGIC_1, UF2_MAGIC_END};
    (void)state;
    for (int i = 0; i < 3; i++) {
        *block(2, magics[i]) ^= 1;
        refuses("has wrong magic numbers");
    }
    uf2_put(block(1, UF2_FLAGS), 0);
    refuses("has no family");
    uf2_put(block(1, UF2_FLAGS), 0x2001);
    refuses("is not for the main flash");
    uf2_put(block(1, UF2_SIZE), 255);
    refuses("has no 256 bytes");
    uf2_put(block(1, UF2_TOTAL), PAGES + 1);
    refuses("another count or family");
    uf2_put(block(1, UF2_FAMILY), 0xe48bff5a);
    refuses("another count or family");
    uf2_put(block(1, UF2_NUMBER), PAGES);
    refuses("is not below their count");
    uf2_put(block(1, UF2_NUMBER), 2);
    refuses("have the same number");
    put_all(UF2_TOTAL, PAGES + 1);
    refuses("are missing");
    put_all(UF2_TOTAL, (32 << 20) / 256 + 1); /* it counts up to 32 MB */
    refuses("is not below their count");
}

static void addresses_are_those_of_pages_of_flash(void **state)
{
    static const uint32_t wrong[] = {0x0fffff00, 0x11000000, 0x10000001, 0x10000080, 0x20000000, 0};
    (void)state;
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        uf2_put(block(0, UF2_ADDRESS), wrong[i]);
        refuses("is none of a page of flash");
    }
}

/* Absolute, 57h, data, Arm and RISC-V, 5Ah, are taken; Non-secure Arm and other chips' are not. */
static void four_families_are_taken(void **state)
{
    (void)state;
    for (uint32_t family = 0xe48bff57; family <= 0xe48bff5a; family++) {
        put_all(UF2_FAMILY, family);
        takes(PAGES * PAGE, family);
    }
    put_all(UF2_FAMILY, 0xe48bff56); /* an RP2040's */
    refuses("has a family that an RP2350 ignores");
    put_all(UF2_FAMILY, 0xe48bff5b);
    refuses("has a family that an RP2350 ignores");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(pages_go_to_their_addresses_in_any_order, fresh),
        cmocka_unit_test_setup(file_begins_with_the_block_against_e10, fresh),
        cmocka_unit_test_setup(each_field_of_a_block_is_looked_at, fresh),
        cmocka_unit_test_setup(addresses_are_those_of_pages_of_flash, fresh),
        cmocka_unit_test_setup(four_families_are_taken, fresh),
    };
    return cmocka_run_group_tests(tests, make_flash, free_flash);
}
