/* hal/linux/i2c: what is asked of i2c-dev, by a kernel that the test plays: open, ioctl, write and close stand here in
 * place of the C library's. The number of I2C_SLAVE is that of Linux' dev-interface.rst. */
#define _POSIX_C_SOURCE 200809L /* O_CLOEXEC */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "../../../hal/linux/i2c.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

enum { DEVICE = 4711 };

static struct {
    int refused, held, fails; /* errno of opening, of I2C_SLAVE, of a write; or 0 */
    bool is_short;
    char path[LINUX_PATH_SIZE];
    int flags, opened;
    unsigned long address;
    uint8_t bytes[300];
    size_t count;
} kernel;

static char error[LINUX_ERROR_SIZE];
static const struct board board = {.name = "mine", .spi_bus = 1, .i2c_address = 0x3C};

static int plug(void **state)
{
    (void)state;
    memset(&kernel, 0, sizeof kernel);
    error[0] = 0;
    return 0;
}

int open(const char *path, int flags, ...)
{
    strncpy(kernel.path, path, sizeof kernel.path - 1);
    kernel.flags = flags;
    errno = kernel.refused;
    kernel.opened += kernel.refused == 0;
    return kernel.refused == 0 ? DEVICE : -1;
}

int close(int descriptor)
{
    kernel.opened -= descriptor == DEVICE;
    errno = EINTR; /* what was wrong before must have been kept */
    return 0;
}

int ioctl(int descriptor, unsigned long request, ...)
{
    va_list arguments;
    va_start(arguments, request);
    kernel.address = va_arg(arguments, unsigned long);
    va_end(arguments);
    assert_true(descriptor == DEVICE && request == 0x0703);
    errno = kernel.held;
    return kernel.held == 0 ? 0 : -1;
}

ssize_t write(int descriptor, const void *bytes, size_t n)
{
    if (descriptor != DEVICE) { /* the test's own output */
        return (ssize_t)n;
    }
    assert_true(n <= sizeof kernel.bytes);
    memcpy(kernel.bytes, bytes, n);
    kernel.count = n;
    errno = kernel.fails;
    return kernel.fails != 0 ? -1 : (ssize_t)n - kernel.is_short;
}

static void the_boards_bus_is_opened_for_its_address(void **state)
{
    (void)state;
    struct linux_spi bus;
    assert_int_equal(linux_i2c_open(&bus, &board, NULL, error), HAL_OK);
    assert_string_equal(kernel.path, "/dev/i2c-1");
    assert_true((kernel.flags & (O_RDWR | O_CLOEXEC)) == (O_RDWR | O_CLOEXEC));
    assert_true(bus.descriptor == DEVICE && kernel.address == 0x3C && kernel.opened == 1);
    assert_int_equal(linux_i2c_open(&bus, &board, "/dev/i2c-20", error), HAL_OK);
    assert_string_equal(kernel.path, "/dev/i2c-20");
    char path[100];
    memset(path, 'x', sizeof path);
    path[99] = 0;
    assert_int_equal(linux_i2c_open(&bus, &board, path, error), HAL_EINVAL);
    assert_int_equal(bus.descriptor, -1);
}

static void what_is_missing_is_told(void **state)
{
    (void)state;
    static const struct {
        int refused, held, status;
        const char *says;
    } cases[] = {{ENOENT, 0, HAL_ENODEV, "dtparam=i2c_arm=on"},
                 {EACCES, 0, HAL_EACCES, "group i2c"},
                 {EMFILE, 0, HAL_EIO, "cannot be opened"},
                 {0, EBUSY, HAL_EBUSY, "address 3Ch"},
                 {0, ENOTTY, HAL_ENODEV, "no I2C bus"}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct linux_spi bus;
        kernel.refused = cases[i].refused;
        kernel.held = cases[i].held;
        assert_int_equal(linux_i2c_open(&bus, &board, NULL, error), cases[i].status);
        assert_non_null(strstr(error, "/dev/i2c-1"));
        assert_non_null(strstr(error, cases[i].says));
        assert_true(bus.descriptor == -1 && kernel.opened == 0);
    }
}

static void a_message_begins_with_its_control_byte(void **state)
{
    (void)state;
    struct linux_spi bus;
    uint8_t bytes[LINUX_I2C_BYTES];
    memset(bytes, 0x5A, sizeof bytes);
    assert_int_equal(linux_i2c_open(&bus, &board, NULL, error), HAL_OK);
    assert_int_equal(linux_i2c_send(&bus, HAL_COMMAND, bytes, 3, error), HAL_OK);
    assert_int_equal(kernel.count, 4);
    assert_memory_equal(kernel.bytes, "\x00\x5A\x5A\x5A", 4);
    assert_int_equal(linux_i2c_send(&bus, HAL_DATA, bytes, sizeof bytes, error), HAL_OK);
    assert_int_equal(kernel.count, 257);
    assert_true(kernel.bytes[0] == 0x40 && kernel.bytes[256] == 0x5A);
}

static void who_does_not_answer_is_told(void **state)
{
    (void)state;
    struct linux_spi bus;
    const uint8_t byte = 0;
    static const struct {
        int number, status;
        const char *says;
    } cases[] = {{EREMOTEIO, HAL_EIO, "no display answers"},
                 {ENXIO, HAL_EIO, "no display answers"},
                 {ETIMEDOUT, HAL_ETIMEDOUT, "sending 1 bytes failed"}};
    assert_int_equal(linux_i2c_open(&bus, &board, NULL, error), HAL_OK);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        kernel.fails = cases[i].number;
        assert_int_equal(linux_i2c_send(&bus, HAL_DATA, &byte, 1, error), cases[i].status);
        assert_non_null(strstr(error, cases[i].says));
    }
    kernel.fails = 0;
    kernel.is_short = true;
    assert_int_equal(linux_i2c_send(&bus, HAL_DATA, &byte, 1, error), HAL_EIO);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(the_boards_bus_is_opened_for_its_address, plug),
        cmocka_unit_test_setup(what_is_missing_is_told, plug),
        cmocka_unit_test_setup(a_message_begins_with_its_control_byte, plug),
        cmocka_unit_test_setup(who_does_not_answer_is_told, plug),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
