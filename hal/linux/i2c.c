/*
 * See i2c.h. Source: Linux, Documentation/i2c/dev-interface.rst. A write() is a message: start, address, bytes, stop.
 * The clock is that of the device tree; nobody tells it here.
 */
#define _POSIX_C_SOURCE 200809L
#include "i2c.h"

#include "fail.h"

#include <errno.h>
#include <fcntl.h>
#include <linux/i2c-dev.h>
#include <stdio.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

static int refused(const char *name, int number, char error[LINUX_ERROR_SIZE])
{
    const int status = linux_status(number);
    if (status == HAL_ENODEV) {
        return linux_fail(error, status,
                          "%s is not there: I2C is off; on a Raspberry Pi add dtparam=i2c_arm=on to config.txt, load "
                          "i2c-dev (modprobe i2c-dev) and restart",
                          name);
    }
    if (status == HAL_EACCES) {
        return linux_fail(error, status,
                          "%s: no permission; add yourself to the group i2c (usermod -aG i2c NAME, then log in again)",
                          name);
    }
    return linux_fail(error, status, "%s cannot be opened: %s", name, strerror(number));
}

int linux_i2c_open(struct linux_spi *bus, const struct board *board, const char *path, char error[LINUX_ERROR_SIZE])
{
    bus->descriptor = -1;
    const int n = path != NULL ? snprintf(bus->name, LINUX_PATH_SIZE, "%s", path)
                               : snprintf(bus->name, LINUX_PATH_SIZE, "/dev/i2c-%u", board->spi_bus);
    if (n >= LINUX_PATH_SIZE) {
        return linux_fail(error, HAL_EINVAL, "%s..: longer than %d characters; give a /dev/i2c-N", bus->name,
                          LINUX_PATH_SIZE - 1);
    }
    const int opened = open(bus->name, O_RDWR | O_CLOEXEC | O_NOCTTY);
    if (opened < 0) {
        return refused(bus->name, errno, error);
    }
    if (ioctl(opened, I2C_SLAVE, (unsigned long)board->i2c_address) < 0) {
        const int number = errno;
        close(opened);
        return number == EBUSY
                   ? linux_fail(error, HAL_EBUSY,
                                "%s: a driver of the kernel holds address %02Xh; take its overlay out of config.txt",
                                bus->name, board->i2c_address)
                   : linux_fail(error, HAL_ENODEV, "%s is no I2C bus; give a /dev/i2c-N", bus->name);
    }
    bus->descriptor = opened;
    return HAL_OK;
}

int linux_i2c_send(const struct linux_spi *bus, enum hal_dc dc, const uint8_t *bytes, size_t n,
                   char error[LINUX_ERROR_SIZE])
{
    uint8_t message[1 + LINUX_I2C_BYTES];
    message[0] = dc == HAL_DATA ? 0x40 : 0x00; /* Co = 0: all that follows has this D/C */
    memcpy(message + 1, bytes, n);
    const ssize_t sent = write(bus->descriptor, message, 1 + n);
    if (sent == (ssize_t)(1 + n)) {
        return HAL_OK;
    }
    const int number = sent < 0 ? errno : EIO;
    if (number == ENXIO || number == EREMOTEIO) {
        return linux_fail(error, HAL_EIO, "%s: no display answers; look at its wires and its address", bus->name);
    }
    return linux_fail(error, linux_status(number), "%s: sending %zu bytes failed: %s; dmesg may say more", bus->name, n,
                      strerror(number));
}
