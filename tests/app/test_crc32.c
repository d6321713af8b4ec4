/*
 * crc32: the check value of the catalogues of CRCs ("123456789" gives CBF43926), every byte against the division of
 * polynomials bit by bit, and any cut of a text into parts.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "crc32.h"

/* One bit at a time, as the definition has it: lowest bit first, divided by the reflected polynomial. */
static uint32_t divided(const uint8_t *bytes, size_t n)
{
    uint32_t rest = UINT32_MAX;
    for (size_t i = 0; i < 8 * n; i++) {
        const uint32_t bit = (rest ^ (uint32_t)bytes[i / 8] >> i % 8) & 1;
        rest = (rest >> 1) ^ (bit ? 0xEDB88320 : 0);
    }
    return rest ^ UINT32_MAX;
}

static void the_check_value_is_that_of_the_catalogues(void **state)
{
    (void)state;
    assert_int_equal(crc32_update(0, (const uint8_t *)"123456789", 9), 0xCBF43926);
}

/* The CRC that ends each PNG file: of the name of its last chunk, which is empty. */
static void the_last_chunk_of_a_png_has_its_crc(void **state)
{
    (void)state;
    assert_int_equal(crc32_update(0, (const uint8_t *)"IEND", 4), 0xAE426082);
}

static void no_bytes_change_nothing(void **state)
{
    (void)state;
    assert_int_equal(crc32_update(0, NULL, 0), 0);
    assert_int_equal(crc32_update(0x12345678, NULL, 0), 0x12345678);
}

static void every_byte_is_divided_as_bit_by_bit(void **state)
{
    (void)state;
    for (unsigned i = 0; i < 256; i++) {
        const uint8_t bytes[3] = {(uint8_t)i, 0xA5, (uint8_t)(255 - i)};
        assert_int_equal(crc32_update(0, bytes, 1), divided(bytes, 1));
        assert_int_equal(crc32_update(0, bytes, 3), divided(bytes, 3));
    }
}

static void parts_give_the_crc_of_the_whole(void **state)
{
    uint8_t bytes[61];
    (void)state;
    for (unsigned i = 0; i < sizeof bytes; i++) {
        bytes[i] = (uint8_t)(i * i + 3);
    }
    for (size_t cut = 0; cut <= sizeof bytes; cut++) {
        const uint32_t first = crc32_update(0, bytes, cut);
        assert_int_equal(crc32_update(first, bytes + cut, sizeof bytes - cut), divided(bytes, sizeof bytes));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_check_value_is_that_of_the_catalogues),
        cmocka_unit_test(the_last_chunk_of_a_png_has_its_crc),
        cmocka_unit_test(no_bytes_change_nothing),
        cmocka_unit_test(every_byte_is_divided_as_bit_by_bit),
        cmocka_unit_test(parts_give_the_crc_of_the_whole),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
