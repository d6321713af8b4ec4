/* flash_file: what BIN and UF2 files are taken for, by what they begin with, and which are refused. */
#define _XOPEN_SOURCE 700 /* truncate */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "files.h"
#include "flash_file.h"
#include "uf2_make.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { BYTES = 3 * 4096 + 256, DEFINITION = 0xFFFFDED3 };

static uint8_t bin[BYTES], blocks[2 * BYTES];
static struct flash_image image;
static char error[FLASH_ERROR_SIZE];

static int fresh(void **state)
{
    (void)state;
    uf2_make_bin(bin, BYTES, 11);
    uf2_make(blocks, bin, BYTES);
    error[0] = '\0';
    return 0;
}

static void refuse(const uint8_t *bytes, size_t n, const char *reason)
{
    memset(&image, 0x55, sizeof image);
    assert_int_equal(flash_file_parse(&image, bytes, n, error), PH_ERR_INVAL);
    assert_string_equal(error, reason);
    assert_null(image.bytes);
    assert_int_equal(image.sectors, 0);
}

static void take(const uint8_t *bytes, size_t n, enum flash_chip chip)
{
    assert_int_equal(flash_file_parse(&image, bytes, n, error), 0);
    assert_int_equal(image.chip, chip);
}

static void a_bin_file_is_the_flash_from_its_beginning(void **state)
{
    (void)state;
    take(bin, BYTES - 3, FLASH_RP2040);
    assert_int_equal(image.sectors, 4);
    assert_int_equal(image.size, BYTES - 3);
    assert_memory_equal(image.bytes, bin, BYTES - 3);
    assert_memory_equal(image.bytes + BYTES - 3, "\xff\xff\xff\xff", 4);
    flash_image_free(&image);
    take(bin, 256, FLASH_RP2040);
    flash_image_free(&image);
    refuse(bin, 255, "255 bytes are no image: not even boot2, its first 256, is whole");
    refuse(bin, 0, "the file is empty");
}

static void a_bin_file_is_not_larger_than_the_flash(void **state)
{
    (void)state;
    uint8_t *const large = calloc(1, (1 << 24) + 1);
    assert_non_null(large);
    memcpy(large, bin, 256);
    take(large, 1 << 24, FLASH_RP2040);
    flash_image_free(&image);
    refuse(large, (1 << 24) + 1, "16777217 bytes do not fit into the flash: the chip addresses 16777216");
    free(large);
}

/* A bit of boot2 that changed is seen by its checksum. */
static void what_no_rp2040_would_start_is_refused(void **state)
{
    (void)state;
    static const uint8_t places[] = {0, 100, 251, 252, 253, 254, 255};
    for (size_t i = 0; i < sizeof places; i++) {
        bin[places[i]] ^= 0x80;
        refuse(bin, BYTES, "no image for an RP2040: its first 256 bytes (boot2) have a wrong checksum");
        bin[places[i]] ^= 0x80;
    }
}

static void a_definition_in_the_first_4_kb_is_of_an_rp2350(void **state)
{
    (void)state;
    for (unsigned at = 0; at < 4096; at += 1364) {
        fresh(state);
        uf2_put(bin + at, DEFINITION);
        if (at > 0) { /* boot2 is right still */
            take(bin, BYTES, FLASH_RP2040);
            flash_image_free(&image);
        }
        bin[8] ^= 1;
        take(bin, BYTES, FLASH_RP2350);
        flash_image_free(&image);
        bin[at + 3] ^= 1;
        refuse(bin, BYTES, "no image for an RP2040: its first 256 bytes (boot2) have a wrong checksum");
        bin[at + 3] ^= 1;
    }
    fresh(state);
    uf2_put(bin + 4096, DEFINITION); /* behind */
    bin[8] ^= 1;
    refuse(bin, BYTES, "no image for an RP2040: its first 256 bytes (boot2) have a wrong checksum");
    fresh(state);
    uf2_put(bin + 1002, DEFINITION); /* on no multiple of 4 */
    bin[8] ^= 1;
    refuse(bin, BYTES, "no image for an RP2040: its first 256 bytes (boot2) have a wrong checksum");
}

static void a_uf2_file_is_what_its_chip_starts(void **state)
{
    (void)state;
    take(blocks, sizeof blocks, FLASH_RP2040);
    assert_memory_equal(image.bytes, bin, BYTES);
    flash_image_free(&image);
    blocks[UF2_DATA] ^= 1;
    refuse(blocks, sizeof blocks, "no image for an RP2040: its first 256 bytes (boot2) have a wrong checksum");
    uf2_for_rp2350(blocks, BYTES / 256);
    take(blocks, sizeof blocks, FLASH_RP2350);
    flash_image_free(&image);
    blocks[UF2_DATA] ^= 1;
    refuse(blocks, sizeof blocks, "no image for an RP2350: its first 4096 bytes have no image definition");
    refuse(blocks, sizeof blocks - 1, "truncated: 25087 bytes are no multiple of 512");
}

/* Data behind the first sector need nothing that starts. */
static void a_uf2_file_without_the_first_sector_is_data(void **state)
{
    (void)state;
    for (unsigned i = 0; i < BYTES / 256; i++) {
        uf2_put(blocks + (size_t)i * UF2_BLOCK + UF2_ADDRESS, 0x10001000 + 256 * i);
    }
    blocks[UF2_DATA] ^= 1;
    take(blocks, sizeof blocks, FLASH_RP2040);
    assert_int_equal(image.used[0], 0);
    flash_image_free(&image);
}

static void other_files_are_known_by_what_they_begin_with(void **state)
{
    (void)state;
    static const struct {
        const char *begin, *reason;
    } others[] = {{"\177ELF", "an ELF file, which is for debuggers; give the .uf2 or .bin beside it"},
                  {":100", "looks like Intel HEX; give a UF2 or BIN file"},
                  {"PHHS", "a binary scene: add --at-scene"}};
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++) {
        fresh(state);
        memcpy(bin, others[i].begin, 4);
        uf2_seal_boot2(bin);
        refuse(bin, BYTES, others[i].reason);
    }
    refuse((const uint8_t *)"\177ELF", 4, others[0].reason);
    refuse((const uint8_t *)"\177EL", 3, "3 bytes are no image: not even boot2, its first 256, is whole");
    refuse((const uint8_t *)":", 1, others[1].reason);
    fresh(state);
    memcpy(bin, "\177ELG", 4);
    uf2_seal_boot2(bin);
    take(bin, BYTES, FLASH_RP2040);
    flash_image_free(&image);
}

static void a_file_is_read_whole(void **state)
{
    (void)state;
    assert_int_equal(flash_file_read(&image, file_bytes("a.uf2", blocks, sizeof blocks), error), 0);
    assert_memory_equal(image.bytes, bin, BYTES);
    flash_image_free(&image);
    static const uint32_t sizes[] = {(1 << 20) - 1, 1 << 20, (1 << 20) + 1, 5 << 20};
    const char *const path = file_path("a.bin");
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        uint8_t *const large = calloc(1, sizes[i]);
        assert_non_null(large);
        uf2_make_bin(large, sizes[i], 3);
        file_bytes("a.bin", large, sizes[i]);
        assert_int_equal(flash_file_read(&image, path, error), 0);
        assert_int_equal(image.size, sizes[i]);
        assert_memory_equal(image.bytes, large, sizes[i]);
        flash_image_free(&image);
        free(large);
    }
}

static void a_file_that_cannot_be_read_is_told(void **state)
{
    (void)state;
    memset(&image, 0x55, sizeof image);
    assert_int_equal(flash_file_read(&image, file_path("none"), error), PH_ERR_INVAL);
    assert_string_equal(error, "cannot be opened: No such file or directory");
    assert_null(image.bytes);
    assert_int_equal(flash_file_read(&image, "/tmp", error), PH_ERR_INVAL);
    assert_string_equal(error, "cannot be read: Is a directory");
    const char *const path = file_bytes("large", bin, 256);
    assert_int_equal(truncate(path, (64 << 20) - 1), 0); /* as much as is read */
    assert_int_equal(flash_file_read(&image, path, error), PH_ERR_INVAL);
    assert_string_equal(error, "67108863 bytes do not fit into the flash: the chip addresses 16777216");
    assert_int_equal(truncate(path, (64 << 20) + 1), 0);
    assert_int_equal(flash_file_read(&image, path, error), PH_ERR_INVAL);
    assert_string_equal(error, "too large for an image: more than 67108864 bytes");
    assert_null(image.bytes);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(a_bin_file_is_the_flash_from_its_beginning, fresh),
        cmocka_unit_test_setup(a_bin_file_is_not_larger_than_the_flash, fresh),
        cmocka_unit_test_setup(what_no_rp2040_would_start_is_refused, fresh),
        cmocka_unit_test(a_definition_in_the_first_4_kb_is_of_an_rp2350),
        cmocka_unit_test_setup(a_uf2_file_is_what_its_chip_starts, fresh),
        cmocka_unit_test_setup(a_uf2_file_without_the_first_sector_is_data, fresh),
        cmocka_unit_test(other_files_are_known_by_what_they_begin_with),
        cmocka_unit_test_setup(a_file_is_read_whole, fresh),
        cmocka_unit_test_setup(a_file_that_cannot_be_read_is_told, fresh),
    };
    return cmocka_run_group_tests(tests, files_begin, files_end);
}
