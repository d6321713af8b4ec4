/* flash_program: binary information as pico-sdk's structure.h lays it out, written by hand into a flash that the test
 * plays; and addresses that lead nowhere. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "flash_image.h"
#include "flash_program.h"
#include "flash_scene.h"

#include <stdio.h>
#include <string.h>

enum { ROOM = 0x4000, HEADER = 0x1f4, TABLE = 0x800, ENTRIES = 0x1000, TEXTS = 0x2000 };

static uint8_t flash[ROOM];
static uint32_t asked; /* address of the read that goes on */
static unsigned reads, fails;
static uint32_t table_count;

/* The link: a command is 32 bytes; its address is at 16. */
static int out(void *context, const void *bytes, size_t n)
{
    (void)context;
    if (n == 32) {
        const uint8_t *const at = (const uint8_t *)bytes + 16;
        asked = at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24;
    }
    return 0;
}

static int in(void *context, void *bytes, size_t n)
{
    (void)context;
    if (++reads == fails) {
        return HAL_ETIMEDOUT;
    }
    assert_true(asked >= FLASH_BASE && asked - FLASH_BASE < FLASH_SPAN);
    for (size_t i = 0; i < n; i++) {
        const uint32_t offset = asked - FLASH_BASE + (uint32_t)i;
        ((uint8_t *)bytes)[i] = offset < ROOM ? flash[offset] : 0xff;
    }
    return 0;
}

static int none(void *context)
{
    (void)context;
    return 0;
}

static int no_status(void *context, uint8_t answer[16])
{
    (void)context;
    memset(answer, 0, 16);
    return 0;
}

static void put(uint32_t offset, uint32_t value)
{
    for (int i = 0; i < 4; i++) {
        flash[offset + i] = (uint8_t)(value >> 8 * i);
    }
}

static void put_header(uint32_t offset, uint32_t first, uint32_t end)
{
    put(offset, 0x7188ebf2);
    put(offset + 4, first);
    put(offset + 8, end);
    put(offset + 16, 0xe71aa390);
}

/* A program's first kilobytes without any information. */
static void clear(void)
{
    memset(flash, 0, sizeof flash);
    table_count = 0;
}

/* One more entry of type and tag, identity and value, and the header for all of them. */
static void put_entry(uint32_t id, uint32_t value)
{
    const uint32_t at = ENTRIES + 12 * table_count;
    put(TABLE + 4 * table_count++, FLASH_BASE + at);
    put(at, 0x50520006); /* string, tag "RP" */
    put(at + 4, id);
    put(at + 8, value);
    put_header(HEADER, FLASH_BASE + TABLE, FLASH_BASE + TABLE + 4 * table_count);
}

static struct flash_program read_program(int status)
{
    static const struct flash_link_ops ops = {out, in, no_status, none};
    struct flash_boot boot = {.ops = &ops};
    struct flash_program program;
    memset(&program, 0x5a, sizeof program);
    reads = 0;
    assert_int_equal(flash_program_read(&boot, &program), status);
    return program;
}

static void expect_nothing(void)
{
    const struct flash_program p = read_program(0);
    assert_true(!p.is_erased && !p.takes_scene && p.end == 0);
    assert_string_equal(p.name, "");
}

static void erased_flash_has_no_program(void **state)
{
    (void)state;
    memset(flash, 0xff, sizeof flash);
    assert_true(read_program(0).is_erased);
    flash[1023] = 0xfe;
    assert_false(read_program(0).is_erased);
    flash[1023] = 0xff;
    flash[0] = 0;
    assert_false(read_program(0).is_erased);
    flash[0] = 0xff;
    flash[1024] = 0; /* the first 1024 bytes count */
    assert_true(read_program(0).is_erased);
    clear();
    expect_nothing();
}

static void a_program_tells_its_name_its_end_and_its_scene(void **state)
{
    (void)state;
    clear();
    memcpy(flash + TEXTS, "cube\tx\x7f~ ", 10);
    strcpy((char *)flash + TEXTS + 100, "takes a scene at 0x10080000");
    put_entry(0x02031c86, FLASH_BASE + TEXTS);
    put_entry(0x68f465de, 0x10012345);
    struct flash_program p = read_program(0);
    assert_string_equal(p.name, "cube?x?~ ");
    assert_int_equal(p.end, 0x10012345);
    assert_false(p.takes_scene || p.is_erased);
    put_entry(0xa1f4b453, FLASH_BASE + TEXTS + 100);
    assert_true(read_program(0).takes_scene);
    put_entry(0xa1f4b453, FLASH_BASE + TEXTS); /* another feature after it */
    assert_true(read_program(0).takes_scene);
    flash[TEXTS + 100 + 19] = '2';
    assert_false(read_program(0).takes_scene);
    assert_int_equal(FLASH_BASE + FLASH_SCENE, 0x10080000);
}

static void a_long_name_is_cut(void **state)
{
    (void)state;
    clear();
    memset(flash + TEXTS, 'n', 500);
    put_entry(0x02031c86, FLASH_BASE + TEXTS);
    const struct flash_program p = read_program(0);
    assert_int_equal(strlen(p.name), FLASH_PROGRAM_NAME - 1);
    assert_int_equal(p.name[38], 'n');
}

static void the_header_is_found_in_the_first_kilobyte(void **state)
{
    (void)state;
    for (uint32_t at = 0; at <= 1024; at += 4) {
        clear();
        put_entry(0x68f465de, 7);
        memset(flash + HEADER, 0, 20);
        put_header(at, FLASH_BASE + TABLE, FLASH_BASE + TABLE + 4);
        assert_int_equal(read_program(0).end, at < 1024 ? 7 : 0);
    }
}

static void a_header_that_makes_no_sense_is_none(void **state)
{
    (void)state;
    static const uint32_t tables[][2] = {{FLASH_BASE + TABLE, FLASH_BASE + TABLE}, /* empty */
                                         {FLASH_BASE + TABLE, FLASH_BASE + TABLE - 4},
                                         {FLASH_BASE + TABLE, FLASH_BASE + TABLE + 4 * 129}, /* too long */
                                         {FLASH_BASE - 4, FLASH_BASE},
                                         {FLASH_BASE + FLASH_SPAN - 512, FLASH_BASE + FLASH_SPAN - 508},
                                         {0x20000000, 0x20000004}};
    for (size_t i = 0; i < sizeof tables / sizeof tables[0]; i++) {
        clear();
        put_entry(0x68f465de, 7);
        put_header(HEADER, tables[i][0], tables[i][1]);
        assert_int_equal(read_program(0).end, 0);
        assert_int_equal(reads, 1); /* nothing was followed */
    }
    clear();
    put_entry(0x68f465de, 7);
    put_header(HEADER, FLASH_BASE + TABLE, FLASH_BASE + TABLE + 4 * 128);
    assert_int_equal(read_program(0).end, 7);
    assert_int_equal(reads, 1 + 128 + 1);
    put(HEADER + 16, 0);
    expect_nothing();
    put_header(HEADER, FLASH_BASE + TABLE, FLASH_BASE + TABLE + 4);
    put(HEADER, 0x7188ebf3);
    expect_nothing();
}

static void addresses_that_lead_out_of_the_flash_are_not_followed(void **state)
{
    (void)state;
    clear();
    put_entry(0x02031c86, 0x20000000);
    expect_nothing();
    put_entry(0xa1f4b453, 0);
    expect_nothing();
    put(TABLE, 0x0fffffff);
    put(TABLE + 4, 0x11000000);
    expect_nothing();
    assert_int_equal(reads, 3);
    put_entry(0x12345678, 0x1234); /* another identity */
    expect_nothing();
}

static void every_read_may_fail(void **state)
{
    (void)state;
    clear();
    memcpy(flash + TEXTS, "cube", 5);
    put_entry(0x02031c86, FLASH_BASE + TEXTS);
    put_entry(0xa1f4b453, FLASH_BASE + TEXTS);
    (void)read_program(0);
    assert_int_equal(reads, 7); /* head; pointer, entry and text of two */
    for (fails = 1; fails <= 7; fails++) {
        (void)read_program(HAL_ETIMEDOUT);
        assert_int_equal(reads, fails);
    }
    fails = 0;
}

static void an_image_has_a_program_and_erased_bytes_behind_it(void **state)
{
    (void)state;
    struct flash_program p;
    const struct flash_image image = {.sectors = ROOM / 2 / FLASH_SECTOR, .bytes = flash};
    clear();
    memset(flash + ROOM / 2, 'x', ROOM / 2); /* not of the image */
    flash[ROOM / 2 - 1] = 'n';
    put_entry(0x02031c86, FLASH_BASE + ROOM / 2 - 1);
    flash_program_find(&image, &p);
    assert_memory_equal(p.name, "n???", 4);
    assert_false(p.takes_scene || p.is_erased);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(erased_flash_has_no_program),
        cmocka_unit_test(a_program_tells_its_name_its_end_and_its_scene),
        cmocka_unit_test(a_long_name_is_cut),
        cmocka_unit_test(the_header_is_found_in_the_first_kilobyte),
        cmocka_unit_test(a_header_that_makes_no_sense_is_none),
        cmocka_unit_test(addresses_that_lead_out_of_the_flash_are_not_followed),
        cmocka_unit_test(every_read_may_fail),
        cmocka_unit_test(an_image_has_a_program_and_erased_bytes_behind_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
