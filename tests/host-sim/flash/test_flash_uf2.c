/* flash_uf2: UF2 files of three pages by the specification, of which one field is changed at a time. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "flash_uf2.h"
#include "uf2_make.h"

#include <stdlib.h>
#include <string.h>

enum { PAGES = 3, BYTES = 256 * PAGES, FILE_BYTES = UF2_BLOCK * PAGES };
enum { NO_BLOCK = 0x1, CONTAINER = 0x1000, FAMILY = 0x2000 }; /* flags */

static uint8_t bin[BYTES], file[FILE_BYTES];
static struct flash_image image;
static char error[FLASH_ERROR_SIZE];

static int fresh(void **state)
{
    (void)state;
    uf2_make_bin(bin, BYTES, 7);
    uf2_make(file, bin, BYTES);
    memset(error, 0, sizeof error);
    image = (struct flash_image){.sectors = 0};
    return 0;
}

static void change(unsigned block, unsigned field, uint32_t value)
{
    uf2_put(file + (size_t)block * UF2_BLOCK + field, value);
}

static void refuse(size_t n, const char *reason)
{
    assert_int_equal(flash_uf2_parse(&image, file, n, error), PH_ERR_INVAL);
    assert_string_equal(error, reason);
    assert_null(image.bytes);
}

static void expect_page(uint32_t offset, uint32_t page)
{
    assert_memory_equal(image.bytes + offset, bin + (size_t)256 * page, 256);
}

static void each_page_goes_to_its_address(void **state)
{
    (void)state;
    change(0, UF2_ADDRESS, 0x10000000 + 2 * 4096 + 256); /* in another order, and with a gap */
    change(2, UF2_ADDRESS, 0x10000000);
    change(0, UF2_NUMBER, 2);
    change(2, UF2_NUMBER, 0);
    assert_int_equal(flash_uf2_parse(&image, file, FILE_BYTES, error), 0);
    assert_int_equal(image.chip, FLASH_RP2040);
    assert_int_equal(image.sectors, 3);
    assert_int_equal(image.size, BYTES);
    assert_memory_equal(image.used, "\1\0\1", 3);
    expect_page(2 * 4096 + 256, 0);
    expect_page(256, 1);
    expect_page(0, 2);
    for (uint32_t i = 512; i < 3 * 4096; i++) {
        assert_true(image.bytes[i] == 0xFF || i / 256 == 2 * 16 + 1);
    }
    flash_image_free(&image);
}

static void the_last_page_of_the_flash_is_taken(void **state)
{
    (void)state;
    change(2, UF2_ADDRESS, 0x10FFFF00);
    assert_int_equal(flash_uf2_parse(&image, file, FILE_BYTES, error), 0);
    assert_int_equal(image.sectors, 4096);
    expect_page(0xFFFF00, 2);
    flash_image_free(&image);
}

static void a_file_is_known_by_any_of_its_magic_numbers(void **state)
{
    (void)state;
    static const struct {
        unsigned field;
        size_t least;
    } numbers[] = {{UF2_MAGIC_0, 4}, {UF2_MAGIC_1, 8}, {UF2_MAGIC_END, 512}};
    for (int k = 0; k < 3; k++) {
        uint8_t block[UF2_BLOCK] = {0};
        memcpy(block + numbers[k].field, file + numbers[k].field, 4);
        assert_true(flash_uf2_is(block, numbers[k].least));
        assert_false(flash_uf2_is(block, numbers[k].least - 1));
        for (unsigned i = 0; i < 4; i++) {
            block[numbers[k].field + i] ^= 0x10;
            assert_false(flash_uf2_is(block, UF2_BLOCK));
            block[numbers[k].field + i] ^= 0x10;
        }
    }
}

static void a_wrong_field_is_told(void **state)
{
    static const struct {
        unsigned block, field;
        uint32_t value;
        const char *reason;
    } wrong[] = {
        {1, UF2_MAGIC_0, 0x0A324654, "damaged: block 1 has wrong magic numbers"},
        {2, UF2_MAGIC_1, 0x9E5D5156, "damaged: block 2 has wrong magic numbers"},
        {0, UF2_MAGIC_END, 0x0AB16F31, "damaged: block 0 has wrong magic numbers"},
        {1, UF2_TOTAL, 4, "truncated: block 1 says that there are 4 blocks, the file has 3"},
        {0, UF2_TOTAL, 2, "damaged: block 0 says that there are 2 blocks, the file has 3"},
        {2, UF2_NUMBER, 3, "damaged: block 2 has the number 3 of 3"},
        {2, UF2_NUMBER, 1, "damaged: block 2 has the number 1, which another one has"},
        {1, UF2_SIZE, 255, "damaged: block 1 has 255 bytes, the chip takes 256 a block"},
        {1, UF2_SIZE, 476, "damaged: block 1 has 476 bytes, the chip takes 256 a block"},
        {1, UF2_ADDRESS, 0x0FFFFF00,
         "block 1 is for address 0x0fffff00, outside of the flash (0x10000000 to 0x10ffffff)"},
        {1, UF2_ADDRESS, 0x11000000,
         "block 1 is for address 0x11000000, outside of the flash (0x10000000 to 0x10ffffff)"},
        {1, UF2_ADDRESS, 0x10000080, "damaged: block 1 is for address 0x10000080, no multiple of 256"},
        {1, UF2_ADDRESS, 0x10000000, "damaged: block 1 overlaps another one at address 0x10000000"},
        {1, UF2_FLAGS, FAMILY | CONTAINER, "block 1 is of a file container, not of a flash image"},
        {0, UF2_FLAGS, 0, "block 0 does not say for which chip it is; the board would ignore it"},
        {0, UF2_FAMILY, 0x57755A57, "for STM32F4 (family 0x57755a57), not a program for an RP2040 or RP2350"},
        {0, UF2_FAMILY, 0x68ED2B88, "for SAMD21 (family 0x68ed2b88), not a program for an RP2040 or RP2350"},
        {0, UF2_FAMILY, 0x55114460, "for SAMD51 (family 0x55114460), not a program for an RP2040 or RP2350"},
        {0, UF2_FAMILY, 0xADA52840, "for nRF52840 (family 0xada52840), not a program for an RP2040 or RP2350"},
        {0, UF2_FAMILY, 0xE48BFF58, "for RP2350, data (family 0xe48bff58), not a program for an RP2040 or RP2350"},
        {0, UF2_FAMILY, 0xE48BFF5B,
         "for RP2350, non-secure (family 0xe48bff5b), not a program for an RP2040 or RP2350"},
        {0, UF2_FAMILY, 0, "for another chip (family 0x00000000), not a program for an RP2040 or RP2350"},
        {1, UF2_FAMILY, 0xE48BFF59,
         "block 1 is for RP2350, those before it for RP2040: no image has blocks for two chips"},
        {1, UF2_FAMILY, 0xE48BFF57,
         "block 1 is for RP2350, absolute, those before it for RP2040: no image has blocks for two chips"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        fresh(state);
        change(wrong[i].block, wrong[i].field, wrong[i].value);
        refuse(FILE_BYTES, wrong[i].reason);
    }
}

static void a_part_of_a_block_is_refused(void **state)
{
    (void)state;
    refuse(FILE_BYTES - 1, "truncated: 1535 bytes are no multiple of 512");
    refuse(UF2_BLOCK, "truncated: block 0 says that there are 3 blocks, the file has 1");
    refuse(UF2_BLOCK - 1, "truncated: 511 bytes are no multiple of 512");
}

/* Such a block is counted, and nothing of it is looked at but its number. */
static void a_block_that_is_not_for_the_flash_is_passed_over(void **state)
{
    (void)state;
    change(1, UF2_FLAGS, NO_BLOCK | CONTAINER);
    change(1, UF2_ADDRESS, 1);
    assert_int_equal(flash_uf2_parse(&image, file, FILE_BYTES, error), 0);
    assert_int_equal(image.size, 512);
    expect_page(0, 0);
    expect_page(512, 2);
    assert_int_equal(image.bytes[256], 0xFF);
    flash_image_free(&image);
    fresh(state);
    change(1, UF2_FLAGS, NO_BLOCK);
    change(1, UF2_NUMBER, 0);
    refuse(FILE_BYTES, "damaged: block 1 has the number 0, which another one has");
    fresh(state);
    for (unsigned i = 0; i < PAGES; i++) {
        change(i, UF2_FLAGS, FAMILY | NO_BLOCK);
    }
    refuse(FILE_BYTES, "no block is for the flash");
}

static void families_name_the_chip(void **state)
{
    static const struct {
        uint32_t family;
        enum flash_chip chip;
    } families[] = {
        {0xE48BFF56, FLASH_RP2040}, {0xE48BFF57, FLASH_RP2350}, {0xE48BFF59, FLASH_RP2350}, {0xE48BFF5A, FLASH_RP2350}};
    for (size_t k = 0; k < sizeof families / sizeof families[0]; k++) {
        fresh(state);
        for (unsigned i = 0; i < PAGES; i++) {
            change(i, UF2_FAMILY, families[k].family);
        }
        assert_int_equal(flash_uf2_parse(&image, file, FILE_BYTES, error), 0);
        assert_int_equal(image.chip, families[k].chip);
        flash_image_free(&image);
    }
    fresh(state);
    change(0, UF2_FAMILY, 0xE48BFF5A);
    refuse(FILE_BYTES, "block 1 is for RP2040, those before it for RP2350, RISC-V: no image has blocks for two chips");
}

/* What makes the first block one against the erratum; without any of it the block is one of the image, and a wrong
 * one: it says that there are two. */
static void the_block_against_an_erratum_is_not_of_the_image(void **state)
{
    static const struct {
        unsigned field;
        uint32_t value;
    } others[] = {{UF2_MAGIC_0, 0},          {UF2_FLAGS, 0x8000}, {UF2_FAMILY, 0xE48BFF59},
                  {UF2_ADDRESS, 0x10FFFE00}, {UF2_NUMBER, 1},     {UF2_TOTAL, 3}};
    (void)state;
    uint8_t with[UF2_BLOCK + FILE_BYTES];
    uf2_for_rp2350(file, PAGES);
    memcpy(with + UF2_BLOCK, file, FILE_BYTES);
    uf2_make_e10(with);
    assert_int_equal(flash_uf2_parse(&image, with, sizeof with, error), 0);
    assert_int_equal(image.size, BYTES);
    assert_int_equal(image.sectors, 1);
    assert_int_equal(image.chip, FLASH_RP2350);
    flash_image_free(&image);
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++) {
        uf2_make_e10(with);
        uf2_put(with + others[i].field, others[i].value);
        assert_int_equal(flash_uf2_parse(&image, with, sizeof with, error), PH_ERR_INVAL);
    }
    uf2_make_e10(with); /* alone it is one of two */
    assert_int_equal(flash_uf2_parse(&image, with, UF2_BLOCK, error), PH_ERR_INVAL);
    assert_string_equal(error, "truncated: block 0 says that there are 2 blocks, the file has 1");
    uf2_put(with + UF2_BLOCK + UF2_TOTAL, 1); /* one page beside it is an image */
    assert_int_equal(flash_uf2_parse(&image, with, 2 * UF2_BLOCK, error), 0);
    assert_int_equal(image.size, 256);
    flash_image_free(&image);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(each_page_goes_to_its_address, fresh),
        cmocka_unit_test_setup(the_last_page_of_the_flash_is_taken, fresh),
        cmocka_unit_test_setup(a_file_is_known_by_any_of_its_magic_numbers, fresh),
        cmocka_unit_test(a_wrong_field_is_told),
        cmocka_unit_test_setup(a_part_of_a_block_is_refused, fresh),
        cmocka_unit_test_setup(a_block_that_is_not_for_the_flash_is_passed_over, fresh),
        cmocka_unit_test(families_name_the_chip),
        cmocka_unit_test_setup(the_block_against_an_erratum_is_not_of_the_image, fresh),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
