/* hal/linux/spi: what is asked of spidev, by a kernel that the test plays: open, ioctl, close and fopen stand here in
 * place of the C library's. Numbers of requests and what they mean are those of Linux' spidev.rst. */
#define _POSIX_C_SOURCE 200809L /* O_CLOEXEC */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "../../../hal/linux/spi.h"
#include "hal.h"

#include <errno.h>
#include <fcntl.h>
#include <linux/spi/spidev.h>
#include <stdio.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

enum { DEVICE = 4711 };

static struct {
    int refused; /* errno of opening, or 0 */
    int fails;   /* errno of the request `at`, or 0 */
    int at, requests;
    uint32_t most_hz; /* the controller's limit */
    int64_t says;     /* the clock that it tells; below 0: that which it keeps */
    uint32_t hz;
    unsigned mode, word_bits;
    char path[LINUX_PATH_SIZE];
    int flags, opened;
    struct spi_ioc_transfer transfers[2];
    unsigned transfer_count;
    char *bufsiz; /* what its parameter reads; NULL: there is no spidev */
} kernel;

static int plug(void **state)
{
    (void)state;
    memset(&kernel, 0, sizeof kernel);
    kernel.most_hz = 125000000;
    kernel.says = -1;
    kernel.mode = kernel.word_bits = 99;
    return 0;
}

int open(const char *path, int flags, ...)
{
    strncpy(kernel.path, path, sizeof kernel.path - 1);
    kernel.flags = flags;
    if (kernel.refused != 0) {
        errno = kernel.refused;
        return -1;
    }
    kernel.opened++;
    return DEVICE;
}

int close(int descriptor)
{
    kernel.opened -= descriptor == DEVICE;
    errno = EINTR; /* what was wrong before must have been kept */
    return 0;
}

static int transfer(const struct spi_ioc_transfer *from, unsigned n)
{
    memcpy(kernel.transfers, from, n * sizeof *from);
    kernel.transfer_count = n;
    return 3;
}

int ioctl(int descriptor, unsigned long request, ...)
{
    va_list arguments;
    va_start(arguments, request);
    void *const at = va_arg(arguments, void *);
    va_end(arguments);
    assert_int_equal(descriptor, DEVICE);
    if (kernel.requests++ == kernel.at && kernel.fails != 0) {
        errno = kernel.fails;
        return -1;
    }
    if (request == SPI_IOC_WR_MODE) {
        kernel.mode = *(uint8_t *)at;
    } else if (request == SPI_IOC_WR_BITS_PER_WORD) {
        kernel.word_bits = *(uint8_t *)at;
    } else if (request == SPI_IOC_WR_MAX_SPEED_HZ) {
        kernel.hz = *(uint32_t *)at < kernel.most_hz ? *(uint32_t *)at : kernel.most_hz;
    } else if (request == SPI_IOC_RD_MAX_SPEED_HZ) {
        *(uint32_t *)at = kernel.says >= 0 ? (uint32_t)kernel.says : kernel.hz;
    } else {
        assert_true(request == SPI_IOC_MESSAGE(1) || request == SPI_IOC_MESSAGE(2));
        return transfer(at, request == SPI_IOC_MESSAGE(1) ? 1 : 2);
    }
    return 0;
}

FILE *fopen(const char *path, const char *mode)
{
    assert_string_equal(path, "/sys/module/spidev/parameters/bufsiz");
    return kernel.bufsiz != NULL ? fmemopen(kernel.bufsiz, strlen(kernel.bufsiz), mode) : NULL;
}

static const struct board board = {.spi_bus = 3, .spi_select = 1, .spi_mode = 2, .spi_hz = 40000000};
static struct linux_spi spi;
static char error[LINUX_ERROR_SIZE];

/* bufsiz limits the sum of transfers that are rounded up to 128 bytes, or to 8 where bufsiz is below that. */
static void a_piece_is_the_most_that_fits(void **state)
{
    static const struct {
        size_t left, bufsiz, piece;
    } cases[] = {{5000, 4096, 4096}, {100, 4096, 100}, {4096, 4096, 4096}, {5000, 4100, 4096}, {5000, 4223, 4096},
                 {500, 200, 128},    {500, 128, 128},  {500, 127, 120},    {500, 12, 8},       {500, 8, 8},
                 {500, 5, 5},        {3, 5, 3},        {500, 129, 128}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        assert_int_equal(linux_spi_piece(cases[i].left, cases[i].bufsiz), cases[i].piece);
    }
}

static void the_limit_of_a_message_is_a_parameter_of_spidev(void **state)
{
    static const struct {
        char text[16];
        size_t bytes;
    } cases[] = {{"65536\n", 65536}, {"1\n", 1}, {"0\n", 4096}, {"(null)\n", 4096}, {"1234567890", 123456789}};
    (void)state;
    assert_int_equal(linux_spi_bufsiz(), 0);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char text[16];
        memcpy(text, cases[i].text, sizeof text);
        kernel.bufsiz = text;
        assert_int_equal(linux_spi_bufsiz(), cases[i].bytes);
    }
}

static void the_boards_device_is_opened_in_its_mode(void **state)
{
    (void)state;
    assert_int_equal(linux_spi_open(&spi, &board, NULL, error), HAL_OK);
    assert_string_equal(kernel.path, "/dev/spidev3.1");
    assert_string_equal(spi.name, "/dev/spidev3.1");
    assert_int_equal(spi.descriptor, DEVICE);
    assert_true((kernel.flags & O_ACCMODE) == O_RDWR && (kernel.flags & O_CLOEXEC) != 0 &&
                (kernel.flags & O_NOCTTY) != 0);
    assert_true(kernel.mode == 2 && kernel.word_bits == 8 && kernel.requests == 2 && kernel.opened == 1);
    plug(NULL);
    assert_int_equal(linux_spi_open(&spi, &board, "/dev/spidev0.0", error), HAL_OK);
    assert_string_equal(kernel.path, "/dev/spidev0.0");
}

static void a_path_may_have_63_characters(void **state)
{
    char path[65];
    (void)state;
    memset(path, '/', 64), path[64] = 0;
    assert_int_equal(linux_spi_open(&spi, &board, path, error), HAL_EINVAL);
    assert_non_null(strstr(error, "longer than 63 characters"));
    assert_true(kernel.flags == 0 && spi.descriptor == -1);
    path[63] = 0;
    assert_int_equal(linux_spi_open(&spi, &board, path, error), HAL_OK);
    assert_string_equal(kernel.path, path);
}

static void what_is_refused_is_told_with_its_cure(void **state)
{
    static const struct {
        int number, at; /* at -1: while it is opened; else in that request */
        int status;
        const char *line;
    } cases[] = {{ENOENT, -1, HAL_ENODEV, "/dev/spidev3.1 is not there: SPI is off"},
                 {ENODEV, -1, HAL_ENODEV, "dtparam=spi=on"},
                 {ENXIO, -1, HAL_ENODEV, "is not there"},
                 {EACCES, -1, HAL_EACCES, "/dev/spidev3.1: no permission; add yourself to the group spi"},
                 {EPERM, -1, HAL_EACCES, "60-pinhole.rules"},
                 {ENOMEM, -1, HAL_EIO, "make spidev.bufsiz smaller (it is 0)"},
                 {EBUSY, -1, HAL_EBUSY, "/dev/spidev3.1 cannot be opened: Device or resource busy"},
                 {ENOTTY, 0, HAL_ENODEV, "/dev/spidev3.1 is no SPI device"},
                 {ENOTTY, 1, HAL_ENODEV, "is no SPI device"},
                 {EINVAL, 0, HAL_EINVAL, "SPI mode 2 is refused: Invalid argument"},
                 {EINVAL, 1, HAL_EINVAL, "SPI mode 2 is refused: Invalid argument"}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        plug(NULL);
        kernel.refused = cases[i].at < 0 ? cases[i].number : 0;
        kernel.fails = cases[i].number, kernel.at = cases[i].at;
        assert_int_equal(linux_spi_open(&spi, &board, NULL, error), cases[i].status);
        assert_non_null(strstr(error, cases[i].line));
        assert_true(kernel.opened == 0 && spi.descriptor == -1);
    }
}

static void the_clock_is_that_which_spidev_keeps(void **state)
{
    static const struct {
        uint32_t most, asked;
        int fails, at;
        int32_t got;
    } cases[] = {{125000000, 40000000, 0, 0, 40000000},     {32000000, 40000000, 0, 0, 32000000},
                 {UINT32_MAX, UINT32_MAX, 0, 0, INT32_MAX}, {1, 1, 0, 0, 1},
                 {1000, 1000, EINVAL, 0, HAL_EINVAL},       {1000, 1000, ENODEV, 1, HAL_ENODEV}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        plug(NULL);
        spi = (struct linux_spi){.name = "x", .descriptor = DEVICE, .clock_hz = 5};
        kernel.most_hz = cases[i].most, kernel.fails = cases[i].fails, kernel.at = cases[i].at;
        assert_int_equal(linux_spi_clock(&spi, cases[i].asked, error), cases[i].got);
        assert_int_equal(spi.clock_hz, cases[i].got > 0 ? cases[i].got : 5);
    }
    assert_non_null(strstr(error, "x: a clock of 1000 Hz cannot be set: No such device"));
    plug(NULL);
    for (kernel.says = 0; kernel.says < 2000; kernel.says += 1001) {
        assert_int_equal(linux_spi_clock(&spi, 1000, error), HAL_EINVAL);
        assert_string_equal(error, "x: no clock as slow as 1000 Hz");
    }
}

static void bytes_go_out_in_one_transfer_and_come_in_after_a_command(void **state)
{
    uint8_t bytes[300] = {0};
    (void)state;
    spi = (struct linux_spi){.name = "x", .descriptor = DEVICE, .clock_hz = 12345};
    assert_int_equal(linux_spi_send(&spi, bytes, 300, error), HAL_OK);
    const struct spi_ioc_transfer *t = kernel.transfers;
    assert_int_equal(kernel.transfer_count, 1);
    assert_true(t->tx_buf == (uintptr_t)bytes && t->rx_buf == 0 && t->len == 300);
    assert_true(t->speed_hz == 12345 && t->bits_per_word == 8 && t->cs_change == 0 && t->delay_usecs == 0);
    assert_int_equal(linux_spi_read(&spi, 0x04, bytes, 4, error), HAL_OK);
    assert_int_equal(kernel.transfer_count, 2);
    assert_true(t[0].tx_buf != 0 && t[0].rx_buf == 0 && t[0].len == 1);
    assert_true(t[1].tx_buf == 0 && t[1].rx_buf == (uintptr_t)bytes && t[1].len == 4 && t[1].speed_hz == 12345);
    kernel.requests = 0, kernel.fails = ETIMEDOUT;
    assert_int_equal(linux_spi_send(&spi, bytes, 300, error), HAL_ETIMEDOUT);
    assert_non_null(strstr(error, "x: sending 300 bytes at 12345 Hz failed: Connection timed out"));
    kernel.requests = 0;
    assert_int_equal(linux_spi_read(&spi, 4, bytes, 4, error), HAL_ETIMEDOUT);
    assert_non_null(strstr(error, "sending 5 bytes"));
    kernel.requests = 0, kernel.fails = ESHUTDOWN;
    assert_int_equal(linux_spi_send(&spi, bytes, 300, error), HAL_ENODEV);
    assert_string_equal(error, "x is gone: the SPI device was removed while in use; start again");
}

static void a_look_leaves_nothing_open(void **state)
{
    struct linux_spi_look look;
    (void)state;
    kernel.most_hz = 32000000;
    strcpy(error, "old");
    assert_int_equal(linux_spi_look(&board, NULL, &look, error), HAL_OK);
    assert_true(look.asked_hz == 40000000 && look.got_hz == 32000000 && kernel.opened == 0 && error[0] == 0);
    assert_string_equal(look.path, "/dev/spidev3.1");
    plug(NULL);
    kernel.fails = EINVAL, kernel.at = 2; /* the clock */
    assert_int_equal(linux_spi_look(&board, "/dev/y", &look, error), HAL_EINVAL);
    assert_true(look.got_hz == 0 && kernel.opened == 0 && strstr(error, "/dev/y: a clock of") != NULL);
    plug(NULL);
    kernel.refused = ENOENT;
    look.got_hz = 1;
    assert_int_equal(linux_spi_look(&board, "/dev/z", &look, error), HAL_ENODEV);
    assert_true(look.asked_hz == 40000000 && look.got_hz == 0 && kernel.requests == 0);
    assert_string_equal(look.path, "/dev/z");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_piece_is_the_most_that_fits),
        cmocka_unit_test_setup(the_limit_of_a_message_is_a_parameter_of_spidev, plug),
        cmocka_unit_test_setup(the_boards_device_is_opened_in_its_mode, plug),
        cmocka_unit_test_setup(a_path_may_have_63_characters, plug),
        cmocka_unit_test(what_is_refused_is_told_with_its_cure),
        cmocka_unit_test(the_clock_is_that_which_spidev_keeps),
        cmocka_unit_test_setup(bytes_go_out_in_one_transfer_and_come_in_after_a_command, plug),
        cmocka_unit_test_setup(a_look_leaves_nothing_open, plug),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
