/* What pinhole-flash takes for an image of an RP2040 or RP2350, and every line with which it refuses another. */
#define _POSIX_C_SOURCE 200809L
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "flash_file.h"
#include "uf2_make.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { BYTES = 5 * 1024, BLOCKS = BYTES / 256, FILE_BYTES = 2 * BYTES };

static uint8_t bin[BYTES], file[FILE_BYTES + UF2_BLOCK];

static int setup(void **state)
{
    (void)state;
    uf2_make_bin(bin, BYTES, 1);
    uf2_make(file, bin, BYTES);
    return 0;
}

static uint8_t *block(uint32_t index)
{
    return file + (size_t)index * UF2_BLOCK;
}

static void refuses(size_t n, const char *line)
{
    struct flash_image image;
    char error[FLASH_ERROR_SIZE] = "";
    assert_int_equal(flash_file_parse(&image, file, n, error), PH_ERR_INVAL);
    assert_string_equal(error, line);
    assert_null(image.bytes);
    assert_null(image.used);
}

/* A field of a block is changed: this line; and back. */
static void refuses_field(uint32_t index, int field, uint32_t value, const char *line)
{
    const uint32_t was = uf2_get(block(index) + field);
    uf2_put(block(index) + field, value);
    refuses(FILE_BYTES, line);
    uf2_put(block(index) + field, was);
}

static void accepts(const uint8_t *bytes, size_t n, struct flash_image *image)
{
    char error[FLASH_ERROR_SIZE] = "";
    if (flash_file_parse(image, bytes, n, error) != 0) {
        fail_msg("%s", error);
    }
}

/* ---- what is right ------------------------------------------------------------------------------ */

static void assert_is_bin(const struct flash_image *image)
{
    assert_int_equal(image->sectors, 2);
    assert_int_equal(image->size, BYTES);
    assert_int_equal(image->used[0], 1);
    assert_int_equal(image->used[1], 1);
    assert_memory_equal(image->bytes, bin, BYTES);
    for (uint32_t i = BYTES; i < 2 * FLASH_SECTOR; i++) {
        assert_int_equal(image->bytes[i], 0xFF);
    }
}

static void a_uf2_is_its_payload(void **state)
{
    (void)state;
    struct flash_image image;
    accepts(file, FILE_BYTES, &image);
    assert_is_bin(&image);
    flash_image_free(&image);
    assert_null(image.bytes);
}

static void a_bin_is_itself(void **state)
{
    (void)state;
    struct flash_image image;
    accepts(bin, BYTES, &image);
    assert_is_bin(&image);
    flash_image_free(&image);
}

static void blocks_come_in_any_order(void **state)
{
    (void)state;
    struct flash_image image;
    uint8_t other[UF2_BLOCK];
    for (uint32_t i = 0; i < BLOCKS / 2; i++) {
        memcpy(other, block(i), UF2_BLOCK);
        memcpy(block(i), block(BLOCKS - 1 - i), UF2_BLOCK);
        memcpy(block(BLOCKS - 1 - i), other, UF2_BLOCK);
    }
    accepts(file, FILE_BYTES, &image);
    assert_is_bin(&image);
    flash_image_free(&image);
}

static void blocks_that_are_not_for_the_flash_are_left_out(void **state)
{
    (void)state;
    struct flash_image image;
    uf2_put(block(18) + UF2_FLAGS, 0x2001);
    uf2_put(block(18) + UF2_ADDRESS, 0x20000000);
    accepts(file, FILE_BYTES, &image);
    assert_int_equal(image.size, BYTES - 256);
    for (uint32_t i = 18 * 256; i < 19 * 256; i++) {
        assert_int_equal(image.bytes[i], 0xFF);
    }
    assert_memory_equal(image.bytes + 19 * 256, bin + 19 * 256, 256);
    flash_image_free(&image);
}

static void sectors_without_a_block_are_not_used(void **state)
{
    (void)state;
    struct flash_image image;
    uf2_put(block(BLOCKS - 1) + UF2_ADDRESS, 0x10FFFF00);
    accepts(file, FILE_BYTES, &image);
    assert_int_equal(image.sectors, 4096);
    for (uint32_t i = 0; i < 4096; i++) {
        assert_int_equal(image.used[i], i < 2 || i == 4095);
    }
    assert_memory_equal(image.bytes + FLASH_SPAN - 256, bin + BYTES - 256, 256);
    flash_image_free(&image);
}

static void data_alone_needs_no_boot2(void **state)
{
    (void)state;
    struct flash_image image;
    for (uint32_t i = 0; i < BLOCKS; i++) {
        uf2_put(block(i) + UF2_ADDRESS, 0x10100000 + 256 * i);
    }
    accepts(file, FILE_BYTES, &image);
    assert_int_equal(image.used[0], 0);
    assert_memory_equal(image.bytes + 0x100000, bin, BYTES);
    flash_image_free(&image);
}

/* What follows the payload, tags of the specification say, is not looked at. */
static void padding_is_ignored(void **state)
{
    (void)state;
    struct flash_image image;
    uf2_put(block(3) + UF2_FLAGS, 0xA000);
    memset(block(3) + UF2_DATA + 256, 0x55, 476 - 256);
    accepts(file, FILE_BYTES, &image);
    assert_is_bin(&image);
    flash_image_free(&image);
}

/* ---- what is wrong ------------------------------------------------------------------------------ */

static void magic_numbers(void **state)
{
    (void)state;
    refuses_field(0, UF2_MAGIC_0, 0, "damaged: block 0 has wrong magic numbers");
    refuses_field(7, UF2_MAGIC_0, 0x0A324654, "damaged: block 7 has wrong magic numbers");
    refuses_field(7, UF2_MAGIC_1, 0x9E5D5156, "damaged: block 7 has wrong magic numbers");
    refuses_field(19, UF2_MAGIC_END, 0, "damaged: block 19 has wrong magic numbers");
}

static void truncated_files(void **state)
{
    (void)state;
    refuses(FILE_BYTES - 1, "truncated: 10239 bytes are no multiple of 512");
    refuses(100, "truncated: 100 bytes are no multiple of 512");
    refuses(FILE_BYTES - UF2_BLOCK, "truncated: block 0 says that there are 20 blocks, the file has 19");
    refuses(UF2_BLOCK, "truncated: block 0 says that there are 20 blocks, the file has 1");
    refuses(0, "the file is empty");
}

static void block_numbers_and_totals(void **state)
{
    (void)state;
    refuses_field(4, UF2_TOTAL, 21, "truncated: block 4 says that there are 21 blocks, the file has 20");
    refuses_field(4, UF2_TOTAL, 19, "damaged: block 4 says that there are 19 blocks, the file has 20");
    refuses_field(4, UF2_TOTAL, 0, "damaged: block 4 says that there are 0 blocks, the file has 20");
    refuses_field(4, UF2_NUMBER, 20, "damaged: block 4 has the number 20 of 20");
    refuses_field(4, UF2_NUMBER, 0xFFFFFFFF, "damaged: block 4 has the number 4294967295 of 20");
    refuses_field(4, UF2_NUMBER, 3, "damaged: block 4 has the number 3, which another one has");
    memcpy(block(BLOCKS), block(0), UF2_BLOCK);
    refuses(FILE_BYTES + UF2_BLOCK, "damaged: block 0 says that there are 20 blocks, the file has 21");
}

static void sizes_and_places(void **state)
{
    (void)state;
    refuses_field(2, UF2_SIZE, 476, "damaged: block 2 has 476 bytes, the chip takes 256 a block");
    refuses_field(2, UF2_SIZE, 0, "damaged: block 2 has 0 bytes, the chip takes 256 a block");
    refuses_field(2, UF2_SIZE, 0xFFFFFFFF, "damaged: block 2 has 4294967295 bytes, the chip takes 256 a block");
    refuses_field(2, UF2_ADDRESS, 0x10000201, "damaged: block 2 is for address 0x10000201, no multiple of 256");
    refuses_field(2, UF2_ADDRESS, 0x20000000,
                  "block 2 is for address 0x20000000, outside of the flash (0x10000000 to 0x10ffffff)");
    refuses_field(2, UF2_ADDRESS, 0x11000000,
                  "block 2 is for address 0x11000000, outside of the flash (0x10000000 to 0x10ffffff)");
    refuses_field(2, UF2_ADDRESS, 0x0FFFFF00,
                  "block 2 is for address 0x0fffff00, outside of the flash (0x10000000 to 0x10ffffff)");
    refuses_field(2, UF2_ADDRESS, 0x10000100, "damaged: block 2 overlaps another one at address 0x10000100");
}

static void families(void **state)
{
    (void)state;
    refuses_field(0, UF2_FAMILY, 0x57755A57, "for STM32F4 (family 0x57755a57), not a program for an RP2040 or RP2350");
    refuses_field(0, UF2_FAMILY, 0xE48BFF58,
                  "for RP2350, data (family 0xe48bff58), not a program for an RP2040 or RP2350");
    refuses_field(0, UF2_FAMILY, 0xE48BFF5B,
                  "for RP2350, non-secure (family 0xe48bff5b), not a program for an RP2040 or RP2350");
    refuses_field(9, UF2_FAMILY, 0xE48BFF59,
                  "block 9 is for RP2350, those before it for RP2040: no image has blocks for two chips");
    refuses_field(9, UF2_FAMILY, 7, "for another chip (family 0x00000007), not a program for an RP2040 or RP2350");
    refuses_field(9, UF2_FLAGS, 0, "block 9 does not say for which chip it is; the board would ignore it");
    refuses_field(9, UF2_FLAGS, 0x3000, "block 9 is of a file container, not of a flash image");
    for (uint32_t i = 0; i < BLOCKS; i++) {
        uf2_put(block(i) + UF2_FLAGS, 0x2001);
    }
    refuses(FILE_BYTES, "no block is for the flash");
}

static void an_rp2350_starts_what_has_a_definition(void **state)
{
    (void)state;
    static uint8_t with_e10[UF2_BLOCK + FILE_BYTES];
    struct flash_image image;
    uf2_for_rp2350(file, BLOCKS);
    uf2_make_e10(with_e10);
    memcpy(with_e10 + UF2_BLOCK, file, FILE_BYTES);
    accepts(with_e10, sizeof with_e10, &image);
    assert_int_equal(image.chip, FLASH_RP2350);
    assert_int_equal(image.size, BYTES);
    memcpy(file, image.bytes, BYTES); /* as a BIN */
    flash_image_free(&image);
    accepts(file, BYTES, &image);
    assert_int_equal(image.chip, FLASH_RP2350);
    flash_image_free(&image);
    memcpy(file, with_e10 + UF2_BLOCK, FILE_BYTES);
    refuses_field(0, UF2_DATA, 0, "no image for an RP2350: its first 4096 bytes have no image definition");
    memcpy(file, with_e10, UF2_BLOCK); /* it is of no use elsewhere, or alone */
    refuses(UF2_BLOCK, "truncated: block 0 says that there are 2 blocks, the file has 1");
}

static void an_rp2350_has_three_families(void **state)
{
    (void)state;
    static const uint32_t theirs[] = {0xE48BFF59, 0xE48BFF5A, 0xE48BFF57};
    uf2_for_rp2350(file, BLOCKS);
    for (size_t k = 0; k < sizeof theirs / sizeof theirs[0]; k++) {
        struct flash_image image;
        for (uint32_t i = 0; i < BLOCKS; i++) {
            uf2_put(block(i) + UF2_FAMILY, theirs[k]);
        }
        accepts(file, FILE_BYTES, &image);
        assert_int_equal(image.chip, FLASH_RP2350);
        flash_image_free(&image);
    }
}

static const char no_boot2[] = "no image for an RP2040: its first 256 bytes (boot2) have a wrong checksum";

static void an_image_without_boot2_would_not_start(void **state)
{
    (void)state;
    block(0)[UF2_DATA + 251] ^= 1;
    refuses(FILE_BYTES, no_boot2);
    block(0)[UF2_DATA + 251] ^= 1;
    block(0)[UF2_DATA + 255] ^= 0x80;
    refuses(FILE_BYTES, no_boot2);
    memcpy(file, bin, BYTES);
    file[0] ^= 1;
    refuses(BYTES, no_boot2);
    memcpy(file, "PHHS", 4);
    refuses(BYTES, "a binary scene: add --at-scene");
}

static void files_of_other_kinds(void **state)
{
    (void)state;
    snprintf((char *)file, BYTES, "\177ELF\1\1\1");
    refuses(BYTES, "an ELF file, which is for debuggers; give the .uf2 or .bin beside it");
    snprintf((char *)file, BYTES, ":020000041000EA\r\n");
    refuses(BYTES, "looks like Intel HEX; give a UF2 or BIN file");
    memcpy(file, bin, BYTES);
    refuses(255, "255 bytes are no image: not even boot2, its first 256, is whole");
}

static void a_bin_larger_than_the_address_space(void **state)
{
    (void)state;
    struct flash_image image;
    char error[FLASH_ERROR_SIZE];
    uint8_t *large = calloc(FLASH_SPAN + 1, 1);
    assert_non_null(large);
    memcpy(large, bin, 256);
    assert_int_equal(flash_file_parse(&image, large, FLASH_SPAN, error), 0);
    assert_int_equal(image.sectors, 4096);
    flash_image_free(&image);
    assert_int_equal(flash_file_parse(&image, large, FLASH_SPAN + 1, error), PH_ERR_INVAL);
    assert_string_equal(error, "16777217 bytes do not fit into the flash: the chip addresses 16777216");
    free(large);
}

/* ---- files -------------------------------------------------------------------------------------- */

static void files_are_read_whole(void **state)
{
    (void)state;
    char path[] = "/tmp/pinhole-uf2-XXXXXX", error[FLASH_ERROR_SIZE] = "";
    struct flash_image image;
    const int fd = mkstemp(path);
    assert_true(fd >= 0);
    assert_int_equal(write(fd, file, FILE_BYTES), FILE_BYTES);
    assert_int_equal(flash_file_read(&image, path, error), 0);
    assert_is_bin(&image);
    flash_image_free(&image);
    assert_int_equal(ftruncate(fd, 64L << 20), 0); /* a hole: takes no room */
    close(fd);
    assert_int_equal(flash_file_read(&image, path, error), PH_ERR_INVAL);
    assert_string_equal(error, "too large for an image: more than 67108864 bytes");
    assert_null(image.bytes);
    unlink(path);
    assert_int_equal(flash_file_read(&image, path, error), PH_ERR_INVAL);
    assert_string_equal(error, "cannot be opened: No such file or directory");
    assert_int_equal(flash_file_read(&image, "/tmp", error), PH_ERR_INVAL);
    assert_string_equal(error, "cannot be read: Is a directory");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(a_uf2_is_its_payload, setup),
        cmocka_unit_test_setup(a_bin_is_itself, setup),
        cmocka_unit_test_setup(blocks_come_in_any_order, setup),
        cmocka_unit_test_setup(blocks_that_are_not_for_the_flash_are_left_out, setup),
        cmocka_unit_test_setup(sectors_without_a_block_are_not_used, setup),
        cmocka_unit_test_setup(data_alone_needs_no_boot2, setup),
        cmocka_unit_test_setup(padding_is_ignored, setup),
        cmocka_unit_test_setup(magic_numbers, setup),
        cmocka_unit_test_setup(truncated_files, setup),
        cmocka_unit_test_setup(block_numbers_and_totals, setup),
        cmocka_unit_test_setup(sizes_and_places, setup),
        cmocka_unit_test_setup(families, setup),
        cmocka_unit_test_setup(an_rp2350_starts_what_has_a_definition, setup),
        cmocka_unit_test_setup(an_rp2350_has_three_families, setup),
        cmocka_unit_test_setup(an_image_without_boot2_would_not_start, setup),
        cmocka_unit_test_setup(files_of_other_kinds, setup),
        cmocka_unit_test_setup(a_bin_larger_than_the_address_space, setup),
        cmocka_unit_test_setup(files_are_read_whole, setup),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
