/*
 * pinhole-flash against a board that is a program: what it does to the flash, in which order, and that whatever fails
 * wherever ends in a line, and is mended by running it again. (On the real libusb and kernel: long_guest_flash.sh.)
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "flash_file.h"
#include "flash_job.h"
#include "uf2_make.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { CHIP_BYTES = 2 << 20, IMAGE_BYTES = 3 * 4096 + 256, COMMANDS = 4096 };
enum { EXCLUSIVE = 1, REBOOT = 2, ERASE = 3, WRITE = 5, EXIT_XIP = 6, REBOOT2 = 10, READ = 0x84 };

/* ---- the board ---------------------------------------------------------------------------------- */

struct board {
    uint8_t *flash;
    uint32_t size;
    bool repeats; /* beyond its size; else that is refused */
    uint32_t token;
    uint8_t id, refusal; /* the last command's */
    uint32_t address, left;
    bool exclusive, answered, rebooted, is_rp2350;
    struct {
        uint8_t id;
        uint32_t address;
    } log[COMMANDS];
    uint32_t count;
    /* faults */
    uint32_t calls, fail_at; /* the call of that number fails, */
    int fail_with;           /* so; */
    bool for_ever;           /* and all that follow do */
    bool stall_once[256];    /* by command: the next one is refused */
    uint32_t worn;           /* address at which a bit stays 0; 0: none */
    volatile sig_atomic_t *stop;
    uint32_t stop_at;
};

static int struck(struct board *b)
{
    b->calls++;
    if (b->stop != NULL && b->calls == b->stop_at) {
        *b->stop = 2;
    }
    const bool now = b->calls == b->fail_at || (b->for_ever && b->fail_at != 0 && b->calls > b->fail_at);
    return now ? b->fail_with : 0;
}

static uint8_t *cell(const struct board *b, uint32_t address)
{
    return &b->flash[(address - FLASH_BASE) % b->size];
}

static int refuse(struct board *b, uint8_t why)
{
    b->refusal = why;
    b->left = 0;
    b->answered = true;
    return FLASH_STALL;
}

static int begin(struct board *b, const uint8_t *c)
{
    static const uint8_t argument_bytes[256] = {
        [EXCLUSIVE] = 1, [REBOOT] = 12, [REBOOT2] = 16, [ERASE] = 8, [WRITE] = 8, [READ] = 8};
    b->id = c[8];
    b->address = uf2_get(c + 16);
    const uint32_t n = uf2_get(c + 20);
    const bool data = b->id == READ || b->id == WRITE, in_flash = data || b->id == ERASE;
    assert_int_equal(uf2_get(c), 0x431FD10B);
    assert_true(uf2_get(c + 4) > b->token);
    assert_int_equal(c[9], argument_bytes[b->id]);
    assert_int_equal(c[10] | c[11], 0);
    assert_int_equal(uf2_get(c + 12), data ? n : 0);
    b->token = uf2_get(c + 4);
    b->log[b->count].id = b->id;
    b->log[b->count++].address = b->address;
    assert_true(b->count < COMMANDS);
    if (b->stall_once[b->id]) {
        b->stall_once[b->id] = false;
        return refuse(b, 1);
    }
    if (in_flash && !b->repeats && b->address - FLASH_BASE + n > b->size) {
        return refuse(b, 4);
    }
    assert_true(!in_flash || b->exclusive);
    assert_true(b->id != ERASE || (n == 4096 && b->address % 4096 == 0));
    assert_true(b->id != WRITE || (n % 256 == 0 && b->address % 256 == 0));
    b->exclusive = b->exclusive || (b->id == EXCLUSIVE && c[16] == 1);
    assert_int_not_equal(b->id, b->is_rp2350 ? REBOOT : REBOOT2);
    b->rebooted = (b->id == REBOOT && b->address == 0 && n == 0) ||
                  (b->id == REBOOT2 && b->address == 0 && n == 100 && uf2_get(c + 24) == 0 && uf2_get(c + 28) == 0);
    b->left = data ? n : 0;
    b->answered = false;
    if (b->id == ERASE) {
        memset(cell(b, b->address), 0xFF, 4096);
    }
    return 0;
}

static int take(void *context, const void *bytes, size_t n)
{
    struct board *b = context;
    const uint8_t *from = bytes;
    const int fault = struck(b);
    if (fault < 0) {
        return fault == FLASH_STALL ? refuse(b, 8) : fault;
    }
    if (b->answered && n == 32) {
        return begin(b, from);
    }
    if (b->id == READ && b->left == 0 && n == 0) { /* the empty packet after data */
        b->answered = true;
        return 0;
    }
    assert_int_equal(b->id, WRITE);
    assert_int_equal(n, b->left);
    for (size_t i = 0; i < n; i++) {
        *cell(b, b->address + (uint32_t)i) &= from[i];
    }
    if (b->worn != 0) {
        *cell(b, b->worn) &= 0xFE;
    }
    b->left = 0;
    return (int)n;
}

static int give(void *context, void *bytes, size_t n)
{
    struct board *b = context;
    uint8_t *to = bytes;
    const int fault = struck(b);
    if (fault < 0) {
        return fault == FLASH_STALL ? refuse(b, 8) : fault;
    }
    if (n == 0) {
        assert_int_equal(b->left, 0);
        assert_false(b->answered);
        b->answered = true;
        return 0;
    }
    assert_int_equal(b->id, READ);
    assert_int_equal(n, b->left);
    for (size_t i = 0; i < n; i++) {
        to[i] = *cell(b, b->address + (uint32_t)i);
    }
    b->left = 0;
    return (int)n;
}

static int tell(void *context, uint8_t answer[16])
{
    struct board *b = context;
    memset(answer, 0, 16);
    answer[4] = b->refusal;
    return struck(b);
}

static int reset(void *context)
{
    struct board *b = context;
    b->exclusive = false;
    b->answered = true;
    b->left = 0;
    return struck(b);
}

static const struct flash_link_ops ops = {.out = take, .in = give, .status = tell, .reset = reset};

/* ---- a run -------------------------------------------------------------------------------------- */

static uint8_t bin[CHIP_BYTES], before[CHIP_BYTES], flash[CHIP_BYTES];
static struct board board;
static struct flash_image image;
static struct flash_job job;
static struct flash_boot boot;

static void make_image(uint32_t n)
{
    char error[FLASH_ERROR_SIZE];
    flash_image_free(&image);
    uf2_make_bin(bin, n, 7);
    assert_int_equal(flash_file_parse(&image, bin, n, error), 0);
}

/* Another image's flash, and the board as if it were just plugged in. */
static int setup(void **state)
{
    (void)state;
    make_image(IMAGE_BYTES);
    uf2_make_bin(before, CHIP_BYTES, 3);
    memcpy(flash, before, CHIP_BYTES);
    board = (struct board){.flash = flash, .size = CHIP_BYTES, .repeats = true, .answered = true};
    return 0;
}

static int teardown(void **state)
{
    (void)state;
    flash_image_free(&image);
    return 0;
}

static void plug_in_again(void)
{
    const uint32_t size = board.size;
    const bool repeats = board.repeats;
    board = (struct board){.flash = flash, .size = size, .repeats = repeats, .answered = true};
}

static int run(bool verify, bool reboot, const volatile sig_atomic_t *stop)
{
    boot = (struct flash_boot){.ops = &ops, .context = &board, .is_rp2350 = board.is_rp2350};
    job = (struct flash_job){.boot = &boot, .image = &image, .verify = verify, .reboot = reboot, .stop = stop};
    return flash_job_run(&job);
}

static void assert_written(uint32_t n)
{
    const uint32_t end = (n + 4095) / 4096 * 4096;
    assert_memory_equal(flash, bin, n);
    for (uint32_t i = n; i < end; i++) {
        assert_int_equal(flash[i], 0xFF);
    }
    assert_memory_equal(flash + end, before + end, CHIP_BYTES - end);
}

static uint32_t count(uint8_t id)
{
    uint32_t found = 0;
    for (uint32_t i = 0; i < board.count; i++) {
        found += board.log[i].id == id;
    }
    return found;
}

/* ---- without faults ----------------------------------------------------------------------------- */

static void the_flash_holds_the_image_and_the_rest_is_as_it_was(void **state)
{
    (void)state;
    assert_int_equal(run(true, true, NULL), 0);
    assert_written(IMAGE_BYTES);
    assert_true(board.rebooted);
    assert_int_equal(count(ERASE), 4);
    assert_int_equal(count(WRITE), 4);
    assert_int_equal(count(READ), 4);
}

/* An RP2350 is rebooted by REBOOT2: kind 0, which is a normal boot, and milliseconds. */
static void an_rp2350_is_written_likewise_and_rebooted(void **state)
{
    (void)state;
    board.is_rp2350 = true;
    assert_int_equal(run(true, true, NULL), 0);
    assert_written(IMAGE_BYTES);
    assert_true(board.rebooted);
    assert_int_equal(count(REBOOT2), 1);
}

static void a_locked_rp2350_says_so(void **state)
{
    (void)state;
    boot.refusal = 10;
    assert_string_equal(flash_boot_refusal(&boot), "not permitted");
    boot.refusal = 99;
    assert_string_equal(flash_boot_refusal(&boot), "unknown refusal");
}

static void the_first_sector_is_erased_first_and_written_last(void **state)
{
    (void)state;
    static const struct {
        uint8_t id;
        uint32_t address;
    } expected[] = {{EXCLUSIVE, 1},      {EXIT_XIP, 0},       {ERASE, 0x10000000}, {ERASE, 0x10001000},
                    {WRITE, 0x10001000}, {ERASE, 0x10002000}, {WRITE, 0x10002000}, {ERASE, 0x10003000},
                    {WRITE, 0x10003000}, {WRITE, 0x10000000}};
    assert_int_equal(run(false, false, NULL), 0);
    assert_int_equal(board.count, sizeof expected / sizeof expected[0]);
    for (uint32_t i = 0; i < board.count; i++) {
        assert_int_equal(board.log[i].id, expected[i].id);
        assert_int_equal(board.log[i].address, expected[i].address);
    }
    assert_written(IMAGE_BYTES);
    assert_false(board.exclusive); /* the drive has the board again */
}

static void sectors_that_the_image_leaves_out_stay(void **state)
{
    (void)state;
    static uint8_t blocks[2 * IMAGE_BYTES];
    char error[FLASH_ERROR_SIZE];
    uf2_make(blocks, bin, IMAGE_BYTES);
    uf2_put(blocks + (IMAGE_BYTES / 256 - 1) * UF2_BLOCK + UF2_ADDRESS, 0x10080100); /* its last page elsewhere */
    flash_image_free(&image);
    assert_int_equal(flash_file_parse(&image, blocks, sizeof blocks, error), 0);
    assert_int_equal(run(true, true, NULL), 0);
    assert_memory_equal(flash, bin, 3 * 4096);
    assert_memory_equal(flash + 3 * 4096, before + 3 * 4096, 0x80000 - 3 * 4096);
    assert_memory_equal(flash + 0x80100, bin + 3 * 4096, 256);
    assert_int_equal(flash[0x800FF] & flash[0x80200], 0xFF);
    assert_memory_equal(flash + 0x81000, before + 0x81000, CHIP_BYTES - 0x81000);
}

/* An entry of a program's binary information, with the text that its value points to, if it has one. */
struct told {
    uint32_t id, value;
    const char *text;
};
enum { NAME = 0x02031c86, END = 0x68f465de };
#define FEATURE 0xa1f4b453U

/* Makes the flash hold a program that tells about itself, as picotool reads it: a header in marks and a table of
 * pointers to entries. */
static void put_told(uint32_t header_at, const struct told *told, uint32_t entries)
{
    const uint32_t table = 0x3000, places = 0x3100, texts = 0x3200, text_bytes = 64;
    const uint32_t header[5] = {0x7188ebf2, FLASH_BASE + table, FLASH_BASE + table + 4 * entries, 0, 0xe71aa390};
    for (uint32_t i = 0; i < 5; i++) {
        uf2_put(flash + header_at + 4 * i, header[i]);
    }
    for (uint32_t i = 0; i < entries; i++) {
        const uint32_t text = texts + text_bytes * i;
        uf2_put(flash + table + 4 * i, FLASH_BASE + places + 12 * i);
        uf2_put(flash + places + 12 * i + 4, told[i].id);
        uf2_put(flash + places + 12 * i + 8, told[i].text != NULL ? FLASH_BASE + text : told[i].value);
        if (told[i].text != NULL) {
            strcpy((char *)flash + text, told[i].text);
        }
    }
}

static void put_program(uint32_t header_at, uint32_t end)
{
    const struct told told[] = {{NAME, 0x10000300, NULL}, {END, end, NULL}};
    put_told(header_at, told, 2);
}

static void make_data(uint32_t at)
{
    static uint8_t blocks[2 * UF2_BLOCK];
    char error[FLASH_ERROR_SIZE];
    uf2_make(blocks, bin, 512);
    uf2_put(blocks + UF2_ADDRESS, at);
    uf2_put(blocks + UF2_BLOCK + UF2_ADDRESS, at + 256);
    flash_image_free(&image);
    assert_int_equal(flash_file_parse(&image, blocks, sizeof blocks, error), 0);
}

static void data_do_not_overwrite_the_program(void **state)
{
    static const uint32_t headers[] = {256, 448, 508};
    (void)state;
    for (size_t k = 0; k < sizeof headers / sizeof headers[0]; k++) {
        memcpy(flash, before, CHIP_BYTES);
        put_program(headers[k], 0x10080001);
        make_data(0x10080000);
        plug_in_again();
        assert_int_equal(run(true, true, NULL), FLASH_DIFFERS);
        assert_string_equal(job.error,
                            "the program on the board ends at 0x10080000 and would be overwritten from 0x10080000 on; "
                            "make the scene a part of the image (make firmware SCENE=); nothing was changed");
        assert_int_equal(count(ERASE) + count(WRITE), 0);
        put_program(headers[k], 0x10080000);
        plug_in_again();
        assert_int_equal(run(true, true, NULL), 0);
        assert_memory_equal(flash + 0x80000, bin, 512);
    }
}

/* Garbage in place of the header's numbers is a flash without a program. */
static void a_program_that_says_nothing_right_is_none(void **state)
{
    static const uint32_t wrong[] = {0, 0x10000001, 0x0FFFFFFF, 0x20000000, 0x11000000, 0xFFFFFFFF};
    (void)state;
    for (size_t k = 0; k < 2 * sizeof wrong / sizeof wrong[0]; k++) {
        memcpy(flash, before, CHIP_BYTES);
        put_program(256, 0x10080001);
        uf2_put(flash + (k % 2 != 0 ? 256 + 8 : 0x3004), wrong[k / 2]);
        make_data(0x10080000);
        plug_in_again();
        const int status = run(true, true, NULL);
        assert_int_equal(status, 0);
    }
}

static int run_scene(void)
{
    make_data(0x10080000);
    plug_in_again();
    boot = (struct flash_boot){.ops = &ops, .context = &board};
    job = (struct flash_job){.boot = &boot, .image = &image, .verify = true, .reboot = true, .is_scene = true};
    return flash_job_run(&job);
}

static void assert_nothing_shows_it(const char *what)
{
    char line[FLASH_ERROR_SIZE];
    snprintf(line, sizeof line,
             "nothing would show the scene: %s; write an image first (make flash BOARD=x), or add --force; nothing was "
             "changed",
             what);
    assert_int_equal(run_scene(), FLASH_DIFFERS);
    assert_string_equal(job.error, line);
    assert_int_equal(count(ERASE) + count(WRITE), 0);
    assert_false(board.rebooted);
}

static void a_scene_is_refused_where_no_program_would_show_it(void **state)
{
    const struct told other[] = {{NAME, 0, "blink"}, {END, 0x10004000, NULL}};
    const struct told depth[] = {{NAME, 0, "Pinhole depth"}};
    const struct told elsewhere[] = {{NAME, 0, "Pinhole demos"}, {FEATURE, 0, "takes a scene at 0x10100000"}};
    const struct told unnamed[] = {{END, 0x10004000, NULL}};
    const struct told odd[] = {{NAME, 0, "a\033[31m\xff name of more than thirty-nine letters"}};
    (void)state;
    assert_nothing_shows_it("the board has a program without a name");
    put_told(256, unnamed, 1);
    assert_nothing_shows_it("the board has a program without a name");
    put_told(256, other, 2);
    assert_nothing_shows_it("the board has 'blink', which takes no scene at 0x10080000");
    put_told(508, depth, 1);
    assert_nothing_shows_it("the board has 'Pinhole depth', which takes no scene at 0x10080000");
    put_told(508, elsewhere, 2);
    assert_nothing_shows_it("the board has 'Pinhole demos', which takes no scene at 0x10080000");
    put_told(508, odd, 1);
    assert_nothing_shows_it("the board has 'a?[31m? name of more than thirty-nine l', which takes no scene at "
                            "0x10080000");
    memset(flash, 0xFF, CHIP_BYTES);
    assert_nothing_shows_it("the flash is erased");
}

static void a_scene_is_written_where_an_image_says_that_it_takes_one(void **state)
{
    const struct told told[] = {{NAME, 0, "Pinhole demos"},
                                {FEATURE, 0, "something else"},
                                {FEATURE, 0, "takes a scene at 0x10080000"},
                                {END, 0x10030000, NULL}};
    (void)state;
    put_told(256, told, 4);
    assert_int_equal(run_scene(), 0);
    assert_memory_equal(flash + 0x80000, bin, 512);
    assert_true(board.rebooted);
}

static void a_scene_does_not_overwrite_the_program_that_takes_it(void **state)
{
    const struct told told[] = {{FEATURE, 0, "takes a scene at 0x10080000"}, {END, 0x10080004, NULL}};
    (void)state;
    put_told(256, told, 2);
    assert_int_equal(run_scene(), FLASH_DIFFERS);
    assert_non_null(strstr(job.error, "the program on the board ends at 0x10080003 and would be overwritten"));
    assert_int_equal(count(ERASE) + count(WRITE), 0);
}

/* ---- does it fit? ------------------------------------------------------------------------------- */

static const char too_small[] =
    "the image ends at 0x10095fff, the board's flash of 524288 bytes at 0x1007ffff; nothing was changed";

static void flash_that_is_too_small_is_left_alone(void **state)
{
    (void)state;
    make_image(0x95800);
    board.size = 512 << 10;
    for (int repeats = 0; repeats < 2; repeats++) {
        plug_in_again();
        board.repeats = repeats != 0;
        assert_int_equal(run(true, true, NULL), FLASH_DIFFERS);
        assert_string_equal(job.error, too_small);
        assert_memory_equal(flash, before, CHIP_BYTES);
        assert_int_equal(count(ERASE) + count(WRITE), 0);
    }
}

static void small_flash_that_is_erased_shows_when_it_is_read_back(void **state)
{
    (void)state;
    make_image(0x95800);
    board.size = 512 << 10;
    memset(flash, 0xFF, CHIP_BYTES);
    assert_int_equal(run(true, true, NULL), FLASH_DIFFERS);
    assert_non_null(strstr(job.error, " was read back at 0x100"));
    assert_false(board.rebooted);
}

/* Two images in one flash begin alike. */
static void flash_that_holds_an_image_twice_is_not_too_small(void **state)
{
    (void)state;
    make_image(0x95800);
    memcpy(flash + (256 << 10), flash, 100 << 10);
    memcpy(flash + (512 << 10), flash, 100 << 10);
    assert_int_equal(run(true, true, NULL), 0);
    assert_memory_equal(flash, bin, 0x95800);
}

/* ---- faults ------------------------------------------------------------------------------------- */

static void assert_line(const char *start)
{
    assert_true(strlen(job.error) > 20 && strlen(job.error) < FLASH_ERROR_SIZE - 1);
    assert_null(strchr(job.error, '\n'));
    if (strncmp(job.error, start, strlen(start)) != 0) {
        fail_msg("'%s' does not start with '%s'", job.error, start);
    }
}

/* An error may strike at any call: the job gives its status and its line, or was done; run again, it is done. */
static void every_call_can_fail(int status, const char *line, uint32_t least)
{
    uint32_t failed = 0;
    for (uint32_t at = 1;; at++) {
        setup(NULL);
        board.fail_at = at;
        board.fail_with = status;
        board.for_ever = true;
        const int result = run(true, true, NULL);
        if (board.calls < at) {
            break;
        }
        if (result != 0) {
            failed++;
            assert_int_equal(result, status);
            assert_line(line);
        } else {
            assert_written(IMAGE_BYTES);
        }
        plug_in_again();
        assert_int_equal(run(true, true, NULL), 0);
        assert_written(IMAGE_BYTES);
    }
    assert_true(failed >= least);
}

static void a_board_that_is_pulled_at_any_moment(void **state)
{
    (void)state;
    every_call_can_fail(HAL_ENODEV, "unplugged while ", 37);
}

static void a_board_that_does_not_answer_any_more(void **state)
{
    (void)state;
    every_call_can_fail(HAL_ETIMEDOUT, "no answer for 3 s while ", 37);
}

static void a_bus_that_fails_at_any_moment(void **state)
{
    (void)state;
    every_call_can_fail(HAL_EIO, "USB error while ", 37);
}

static void a_board_that_refuses_from_any_moment_on(void **state)
{
    (void)state;
    every_call_can_fail(FLASH_STALL, "the board refuses ", 37);
}

static void a_pulled_board_is_one_clear_line(void **state)
{
    (void)state;
    board.fail_at = 7;
    board.fail_with = HAL_ENODEV;
    assert_int_equal(run(true, true, NULL), HAL_ENODEV);
    assert_string_equal(job.error,
                        "unplugged while erasing 0x10000000; plug it in with BOOTSEL held and run this again");
}

static void a_refusal_has_its_reason(void **state)
{
    (void)state;
    board.size = 8192;
    board.repeats = false;
    assert_int_equal(run(true, true, NULL), FLASH_STALL);
    assert_string_equal(job.error, "the board refuses erasing 0x10002000 (bad address); pull it out, plug it in with "
                                   "BOOTSEL held and run this again");
}

static void one_refusal_anywhere_is_overcome(void **state)
{
    (void)state;
    assert_int_equal(run(true, true, NULL), 0);
    const uint32_t calls = board.calls;
    assert_true(calls > 37);
    for (uint32_t at = 2; at <= calls; at++) { /* the first one resets the interface */
        setup(NULL);
        board.fail_at = at;
        board.fail_with = FLASH_STALL;
        assert_int_equal(run(true, true, NULL), 0);
        assert_true(board.calls > calls);
        assert_written(IMAGE_BYTES);
        assert_true(board.rebooted);
    }
}

static void each_command_may_be_refused_once(void **state)
{
    (void)state;
    memset(board.stall_once, 1, sizeof board.stall_once);
    assert_int_equal(run(true, true, NULL), 0);
    assert_written(IMAGE_BYTES);
    assert_true(board.rebooted);
}

static void what_is_read_back_is_compared_bit_by_bit(void **state)
{
    (void)state;
    const uint32_t last = IMAGE_BYTES - 2;
    board.worn = 0x10000000 + last;
    bin[last] |= 1;
    image.bytes[last] |= 1;
    assert_int_equal(run(true, true, NULL), FLASH_DIFFERS);
    assert_line("0x");
    assert_non_null(strstr(job.error, " was read back at 0x100030fe instead of 0x"));
    assert_false(board.rebooted);
    plug_in_again();
    board.worn = 0x10000000 + last;
    assert_int_equal(run(false, true, NULL), 0); /* nobody looks */
}

static void a_signal_stops_between_commands_and_a_second_run_completes(void **state)
{
    (void)state;
    uint32_t stopped = 0;
    for (uint32_t at = 1; at < 60; at++) {
        volatile sig_atomic_t stop = 0;
        setup(NULL);
        board.stop = &stop;
        board.stop_at = at;
        if (run(true, true, &stop) == FLASH_STOPPED) {
            stopped++;
            assert_line("stopped before ");
            assert_true(board.answered);
            assert_false(board.exclusive);
        }
        board.token = 0;
        assert_int_equal(run(true, true, NULL), 0);
        assert_written(IMAGE_BYTES);
    }
    assert_true(stopped > 25);
}

static void a_signal_before_the_first_command_changes_nothing(void **state)
{
    (void)state;
    volatile sig_atomic_t stop = 15;
    assert_int_equal(run(true, true, &stop), FLASH_STOPPED);
    assert_string_equal(job.error,
                        "stopped before erasing 0x10000000; the board stays in its boot loader: run this again");
    assert_int_equal(count(ERASE) + count(WRITE), 0);
    assert_memory_equal(flash, before, CHIP_BYTES);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(the_flash_holds_the_image_and_the_rest_is_as_it_was, setup),
        cmocka_unit_test_setup(an_rp2350_is_written_likewise_and_rebooted, setup),
        cmocka_unit_test_setup(a_locked_rp2350_says_so, setup),
        cmocka_unit_test_setup(the_first_sector_is_erased_first_and_written_last, setup),
        cmocka_unit_test_setup(sectors_that_the_image_leaves_out_stay, setup),
        cmocka_unit_test_setup(data_do_not_overwrite_the_program, setup),
        cmocka_unit_test_setup(a_program_that_says_nothing_right_is_none, setup),
        cmocka_unit_test_setup(a_scene_is_refused_where_no_program_would_show_it, setup),
        cmocka_unit_test_setup(a_scene_is_written_where_an_image_says_that_it_takes_one, setup),
        cmocka_unit_test_setup(a_scene_does_not_overwrite_the_program_that_takes_it, setup),
        cmocka_unit_test_setup(flash_that_is_too_small_is_left_alone, setup),
        cmocka_unit_test_setup(small_flash_that_is_erased_shows_when_it_is_read_back, setup),
        cmocka_unit_test_setup(flash_that_holds_an_image_twice_is_not_too_small, setup),
        cmocka_unit_test_setup(a_board_that_is_pulled_at_any_moment, setup),
        cmocka_unit_test_setup(a_board_that_does_not_answer_any_more, setup),
        cmocka_unit_test_setup(a_bus_that_fails_at_any_moment, setup),
        cmocka_unit_test_setup(a_board_that_refuses_from_any_moment_on, setup),
        cmocka_unit_test_setup(a_pulled_board_is_one_clear_line, setup),
        cmocka_unit_test_setup(a_refusal_has_its_reason, setup),
        cmocka_unit_test_setup(one_refusal_anywhere_is_overcome, setup),
        cmocka_unit_test_setup(each_command_may_be_refused_once, setup),
        cmocka_unit_test_setup(what_is_read_back_is_compared_bit_by_bit, setup),
        cmocka_unit_test_setup(a_signal_before_the_first_command_changes_nothing, setup),
        cmocka_unit_test_setup(a_signal_stops_between_commands_and_a_second_run_completes, setup),
    };
    return cmocka_run_group_tests(tests, NULL, teardown);
}
