/* See hal_conformance.h: hal/linux over the real spidev and libgpiod, on the board that tests/guest/board plays. */
#define _XOPEN_SOURCE 700 /* usleep's kin, dirent */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "boards.h"
#include "boards_all.h"
#include "hal_conformance.h"
#include "linux/linux.h"

#include <dirent.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#define BOARD_PATH "/dev/virtual-board"

static struct linux_hal backend, other;

static int close_backends(void **state)
{
    (void)state;
    linux_ops.close(&backend);
    linux_ops.close(&other);
    return 0;
}

bool virtual_board_is_here(void)
{
    return access(BOARD_PATH, F_OK) == 0;
}

/* A fault or an input: tests/guest/board/board.h. */
__attribute__((format(printf, 1, 2))) static void board_do(const char *format, ...)
{
    char command[80];
    va_list arguments;
    va_start(arguments, format);
    const int n = vsnprintf(command, sizeof command, format, arguments);
    va_end(arguments);
    const int wire = open(BOARD_PATH, O_WRONLY);
    assert_true(wire >= 0);
    assert_int_equal(write(wire, command, (size_t)n), n);
    close(wire);
}

static void pause_ms(long ms)
{
    const struct timespec time = {ms / 1000, ms % 1000 * 1000000};
    nanosleep(&time, NULL);
}

/* Looks until these buttons are seen; on a busy machine the kernel takes its time to tell of an edge. */
static void expect_buttons(uint32_t expected)
{
    uint32_t seen = 0;
    for (int i = 0; i < 3000; i++) {
        pause_ms(20);
        seen = linux_ops.buttons(&backend);
        if (seen == expected) {
            return;
        }
    }
    assert_int_equal(seen, expected);
}

/* The Waveshare HAT with a TE line on GPIO23 and the panel's answers on GPIO9. */
static struct board more_wires(void)
{
    struct board board = board_rpi_waveshare_1in3;
    board.pins.tearing = (struct board_pin)BOARD_LINE("GPIO23");
    board.pins.data_in = (struct board_pin)BOARD_LINE("GPIO9");
    return board;
}

static void open_backend(struct linux_hal *one, const struct board *board)
{
    memset(one, 0, sizeof *one);
    const int status = linux_ops.open(one, board);
    if (status != 0) {
        fail_msg("%s", linux_hal_error(one));
    }
    assert_string_equal(linux_hal_error(one), "");
}

static void the_backend_keeps_the_contract(void **state)
{
    (void)state;
    static const struct board *const boards[] = {&board_rpi_waveshare_1in3, &board_rpi_pitft_2in8,
                                                 &board_rpi_pirate_audio, &board_sbc_generic};
    for (size_t i = 0; i < sizeof boards / sizeof boards[0]; i++) {
        const struct hal hal = {&linux_ops, &backend};
        memset(&backend, 0, sizeof backend);
        hal_conforms(&hal, boards[i], "linux", true);
    }
}

static void two_backends_live_side_by_side(void **state)
{
    (void)state;
    struct board second = board_rpi_pirate_audio;
    second.button_count = 0;             /* GPIO5 and 6 are the first one's */
    second.pins.backlight.wired = false; /* and so is GPIO13 */
    open_backend(&backend, &board_rpi_waveshare_1in3);
    open_backend(&other, &second);
    static const uint8_t nops[4096];
    for (int i = 0; i < 20; i++) {
        assert_int_equal(linux_ops.bus_write(&backend, HAL_DATA, nops, sizeof nops), 0);
        assert_int_equal(linux_ops.bus_write(&other, HAL_COMMAND, nops, sizeof nops), 0);
    }
    assert_int_equal(linux_ops.bus_wait(&backend), 0);
    assert_int_equal(linux_ops.bus_wait(&other), 0);
    linux_ops.close(&backend);
    linux_ops.close(&other);
}

/* 32,768 bytes take 262 ms at 1 MHz (and longer, the guest's timers being what they are). */
static void a_long_write_goes_on_by_itself(void **state)
{
    (void)state;
    static uint8_t bytes[32768];
    uint32_t started = UINT32_MAX;
    open_backend(&backend, &board_rpi_waveshare_1in3);
    board_do("wire-time 1");
    assert_int_equal(linux_ops.bus_clock(&backend, 1000000), 1000000);
    for (int tries = 0; tries < 20 && started > 100000; tries++) { /* a busy machine may stop it in between */
        const uint32_t start = linux_ops.time_us(&backend);
        assert_int_equal(linux_ops.bus_write(&backend, HAL_DATA, bytes, sizeof bytes), 0);
        started = linux_ops.time_us(&backend) - start;
        assert_int_equal(linux_ops.bus_write(&backend, HAL_COMMAND, bytes, 1), 0);
        assert_int_equal(linux_ops.bus_wait(&backend), 0);
        assert_true(linux_ops.time_us(&backend) - start >= 262144);
    }
    board_do("wire-time 0");
    assert_in_range(started, 0, 100000);
    const uint32_t rate = linux_hal_bits_per_second(&backend);
    assert_in_range(rate, 10000, 1000000);
    linux_ops.close(&backend);
}

static void an_error_of_a_long_write_is_told_once(void **state)
{
    (void)state;
    static uint8_t bytes[20000];
    open_backend(&backend, &board_rpi_waveshare_1in3);
    assert_int_equal(linux_ops.bus_clock(&backend, 20000000), 20000000);
    board_do("spi-error 3 5 1");
    assert_int_equal(linux_ops.bus_write(&backend, HAL_DATA, bytes,
                                         backend.bufsiz * 3 > sizeof bytes ? sizeof bytes : backend.bufsiz * 3),
                     0);
    const int status = linux_ops.bus_wait(&backend);
    if (backend.bufsiz * 3 <= sizeof bytes) {
        assert_int_equal(status, HAL_EIO);
        assert_non_null(strstr(linux_hal_error(&backend), "/dev/spidev0.0: sending"));
        assert_non_null(strstr(linux_hal_error(&backend), "at 20000000 Hz failed: Input/output error"));
    }
    board_do("spi-error 1 5 1");
    assert_int_equal(linux_ops.bus_write(&backend, HAL_COMMAND, bytes, 1), 0);
    assert_int_equal(linux_ops.bus_wait(&backend), HAL_EIO);
    assert_int_equal(linux_ops.bus_write(&backend, HAL_COMMAND, bytes, 1), 0);
    assert_int_equal(linux_ops.bus_wait(&backend), 0);
    linux_ops.close(&backend);
}

static void the_panel_answers(void **state)
{
    (void)state;
    uint8_t id[4] = {0, 0, 0, 0};
    const struct board board = more_wires();
    open_backend(&backend, &board);
    assert_true(linux_ops.bus_clock(&backend, 4000000) > 0);
    board_do("reply 0085a2b3");
    assert_int_equal(linux_ops.bus_read(&backend, 0x04, id, sizeof id), 0);
    assert_memory_equal(id, "\x00\x85\xa2\xb3", 4);
    linux_ops.close(&backend);
    open_backend(&backend, &board_rpi_waveshare_1in3);
    assert_int_equal(linux_ops.bus_read(&backend, 0x04, id, sizeof id), HAL_ENOSYS);
    linux_ops.close(&backend);
}

static void the_next_tearing_edge_is_waited_for(void **state)
{
    (void)state;
    const struct board board = more_wires();
    open_backend(&backend, &board);
    board_do("te 23 20");
    pause_ms(300); /* six old edges: not what is meant */
    for (int i = 0; i < 3; i++) {
        assert_int_equal(linux_ops.te_wait(&backend, 20000000), 0);
    }
    const uint32_t start = linux_ops.time_us(&backend);
    for (int i = 0; i < 4; i++) {
        assert_int_equal(linux_ops.te_wait(&backend, 20000000), 0);
    }
    assert_true(linux_ops.time_us(&backend) - start >= 100000); /* four periods of 50 ms, less jitter */
    board_do("te 23 0");
    pause_ms(100);
    const uint32_t silent = linux_ops.time_us(&backend);
    assert_int_equal(linux_ops.te_wait(&backend, 120000), HAL_ETIMEDOUT);
    assert_in_range(linux_ops.time_us(&backend) - silent, 120000, 20000000);
    assert_non_null(strstr(linux_hal_error(&backend), "no edge on the TE line for 120 ms"));
    linux_ops.close(&backend);
    open_backend(&backend, &board_rpi_waveshare_1in3);
    assert_int_equal(linux_ops.te_wait(&backend, 1000), HAL_ENOSYS);
    linux_ops.close(&backend);
}

static void buttons_are_seen(void **state)
{
    (void)state;
    static const unsigned lines[] = {6, 19, 5, 26, 13};
    for (size_t i = 0; i < 5; i++) {
        board_do("set %u 1", lines[i]);
    }
    open_backend(&backend, &board_rpi_waveshare_1in3);
    expect_buttons(0);
    board_do("set 6 0");
    expect_buttons(HAL_BUTTON_UP);
    board_do("set 13 0");
    expect_buttons(HAL_BUTTON_UP | HAL_BUTTON_SELECT);
    board_do("set 6 1");
    board_do("set 13 1");
    expect_buttons(0);
    board_do("set 26 0"); /* pressed and let go between two looks */
    pause_ms(15);
    board_do("set 26 1");
    expect_buttons(HAL_BUTTON_RIGHT);
    expect_buttons(0);
    linux_ops.close(&backend);
}

static void check_refused(const struct board *board, const char *path, int status, const char *text)
{
    struct linux_hal refused;
    memset(&refused, 0, sizeof refused);
    refused.spi_path = path;
    assert_int_equal(linux_ops.open(&refused, board), status);
    if (strstr(linux_hal_error(&refused), text) == NULL) {
        fail_msg("said: %s", linux_hal_error(&refused));
    }
}

static void what_cannot_be_opened_is_told(void **state)
{
    (void)state;
    struct board board = board_rpi_waveshare_1in3;
    check_refused(&board, "/dev/spidev7.0", HAL_ENODEV, "/dev/spidev7.0 is not there: SPI is off");
    board_do("busy 25");
    check_refused(&board, NULL, HAL_EBUSY, "line GPIO25 (/dev/gpiochip0:25) is taken by \"somebody\"");
    board_do("free 25");
    board_do("dir-error 27 5");
    check_refused(&board, NULL, HAL_EIO, "line GPIO27 (/dev/gpiochip0:27) cannot be used: Input/output error");
    board_do("dir-error 27 0");
    board.pins.dc = (struct board_pin)BOARD_LINE("GPIO99");
    check_refused(&board, NULL, HAL_ENODEV, "line GPIO99: no chip has it");
    board.pins.dc = (struct board_pin)BOARD_LINE("gpiochip7:3");
    check_refused(&board, NULL, HAL_ENODEV, "line gpiochip7:3: there is no such /dev/gpiochip");
    board.pins.dc = (struct board_pin)BOARD_LINE("gpiochip0:54"); /* it has 54 */
    check_refused(&board, NULL, HAL_ENODEV, "line gpiochip0:54: no chip has it");
    board = board_rpi_waveshare_1in3;
    open_backend(&other, &board);
    check_refused(&board, NULL, HAL_EBUSY, "is taken by \"pinhole\"");
    linux_ops.close(&other);
    open_backend(&other, &board);
    linux_ops.close(&other);
}

/* Opens the backend as the user nobody. */
static void no_permission_is_told_with_its_cure(void **state)
{
    (void)state;
    assert_int_equal(chmod("/dev/spidev0.0", 0600) | chmod("/dev/gpiochip0", 0600), 0);
    assert_int_equal(seteuid(65534), 0);
    check_refused(&board_rpi_waveshare_1in3, NULL, HAL_EACCES,
                  "/dev/spidev0.0: no permission; add yourself to the group spi");
    assert_int_equal(seteuid(0) | chmod("/dev/spidev0.0", 0666) | seteuid(65534), 0);
    check_refused(&board_rpi_waveshare_1in3, NULL, HAL_EACCES,
                  "/dev/gpiochip0: no permission (looking for line GPIO25); add yourself to the group gpio");
    assert_int_equal(seteuid(0), 0);
}

static void lines_are_found_by_chip_and_offset(void **state)
{
    (void)state;
    struct board board = board_rpi_waveshare_1in3;
    board.pins.dc.line = "gpiochip0:25";
    board.pins.reset.line = "/dev/gpiochip0:27";
    open_backend(&backend, &board);
    linux_ops.close(&backend);
    char error[LINUX_ERROR_SIZE];
    struct linux_line_look line;
    assert_int_equal(linux_line_look(&board, &board.pins.dc, &line, error), 0);
    assert_string_equal(line.chip, "/dev/gpiochip0");
    assert_int_equal(line.offset, 25);
    assert_false(line.taken);
    char by_label[LINUX_PATH_SIZE];
    snprintf(by_label, sizeof by_label, "%s:25", line.label);
    board.pins.dc.line = by_label;
    open_backend(&backend, &board);
    assert_int_equal(linux_line_look(&board, &board.pins.dc, &line, error), 0);
    assert_true(line.taken);
    assert_string_equal(line.holder, "pinhole");
    linux_ops.close(&backend);
}

static void a_look_at_spi_tells_the_clock(void **state)
{
    (void)state;
    char error[LINUX_ERROR_SIZE];
    struct linux_spi_look spi;
    assert_int_equal(linux_spi_look(&board_rpi_pirate_audio, NULL, &spi, error), 0);
    assert_string_equal(spi.path, "/dev/spidev0.1");
    assert_int_equal(spi.asked_hz, 62500000);
    assert_int_equal(spi.got_hz, 62500000);
    assert_true(linux_spi_bufsiz() > 0);
    assert_non_null(linux_gpiod_version());
}

static unsigned entries(const char *path)
{
    unsigned count = 0;
    DIR *folder = opendir(path);
    assert_non_null(folder);
    while (readdir(folder) != NULL) {
        count++;
    }
    closedir(folder);
    return count;
}

/* A thread that has ended is still listed for a moment: looks until there are so few, or for 5 s. */
static unsigned threads_left(unsigned few)
{
    unsigned count = entries("/proc/self/task");
    for (int i = 0; i < 500 && count > few; i++) {
        pause_ms(10);
        count = entries("/proc/self/task");
    }
    return count;
}

static void nothing_is_left_open(void **state)
{
    (void)state;
    static const uint8_t bytes[1000];
    const unsigned descriptors = entries("/proc/self/fd");
    const unsigned threads = entries("/proc/self/task");
    for (int i = 0; i < 50; i++) {
        open_backend(&backend, &board_rpi_waveshare_1in3);
        assert_true(linux_ops.bus_clock(&backend, 40000000) > 0);
        assert_int_equal(linux_ops.bus_write(&backend, HAL_DATA, bytes, sizeof bytes), 0);
        linux_ops.close(&backend); /* while it is being sent */
        linux_ops.close(&backend); /* a second close does nothing */
        check_refused(&board_rpi_waveshare_1in3, "/dev/null", HAL_ENODEV, "/dev/null is no SPI device");
    }
    assert_int_equal(entries("/proc/self/fd"), descriptors);
    assert_in_range(threads_left(threads), 0, threads);
}

/* Last: the board does not come back. */
static void an_unplugged_board_ends_it(void **state)
{
    (void)state;
    static const uint8_t bytes[20000];
    open_backend(&backend, &board_rpi_waveshare_1in3);
    assert_true(linux_ops.bus_clock(&backend, 40000000) > 0);
    board_do("spi-unplug 2");
    int status = 0;
    for (int i = 0; i < 100 && status == 0; i++) {
        status = linux_ops.bus_write(&backend, HAL_DATA, bytes, sizeof bytes);
        pause_ms(10);
    }
    assert_int_equal(status, HAL_ENODEV);
    assert_non_null(strstr(linux_hal_error(&backend), "/dev/spidev0.0 is gone"));
    linux_ops.buttons(&backend);
    linux_ops.pin_set(&backend, HAL_PIN_BACKLIGHT, false);
    linux_ops.close(&backend);
    check_refused(&board_rpi_waveshare_1in3, NULL, HAL_ENODEV, "/dev/spidev0.0 is not there");
}

int linux_guest_tests(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(the_backend_keeps_the_contract, close_backends),
        cmocka_unit_test_teardown(two_backends_live_side_by_side, close_backends),
        cmocka_unit_test_teardown(a_long_write_goes_on_by_itself, close_backends),
        cmocka_unit_test_teardown(an_error_of_a_long_write_is_told_once, close_backends),
        cmocka_unit_test_teardown(the_panel_answers, close_backends),
        cmocka_unit_test_teardown(the_next_tearing_edge_is_waited_for, close_backends),
        cmocka_unit_test_teardown(buttons_are_seen, close_backends),
        cmocka_unit_test_teardown(what_cannot_be_opened_is_told, close_backends),
        cmocka_unit_test_teardown(no_permission_is_told_with_its_cure, close_backends),
        cmocka_unit_test_teardown(lines_are_found_by_chip_and_offset, close_backends),
        cmocka_unit_test_teardown(a_look_at_spi_tells_the_clock, close_backends),
        cmocka_unit_test_teardown(nothing_is_left_open, close_backends),
        cmocka_unit_test_teardown(an_unplugged_board_ends_it, close_backends),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
