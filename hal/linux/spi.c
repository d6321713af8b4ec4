/* See spi.h. Source: Linux, Documentation/spi/spidev.rst. */
#define _POSIX_C_SOURCE 200809L
#include "spi.h"

#include "fail.h"
#include "hal.h"
#include "i2c.h"

#include <errno.h>
#include <fcntl.h>
#include <linux/spi/spidev.h>
#include <stdio.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

enum { BUFSIZ_DEFAULT = 4096, ALIGNMENT = 128, ALIGNMENT_LEAST = 8 };

size_t linux_spi_piece(size_t left, size_t bufsiz)
{
    const size_t alignment = bufsiz >= ALIGNMENT ? ALIGNMENT : ALIGNMENT_LEAST;
    const size_t most = bufsiz > alignment ? bufsiz - bufsiz % alignment : bufsiz;
    return left < most ? left : most;
}

size_t linux_spi_bufsiz(void)
{
    unsigned long bytes = 0;
    FILE *file = fopen("/sys/module/spidev/parameters/bufsiz", "r");
    if (file == NULL) {
        return 0;
    }
    if (fscanf(file, "%9lu", &bytes) != 1 || bytes == 0) { /* NOLINT(cert-err34-c): 9 digits fit */
        bytes = BUFSIZ_DEFAULT;
    }
    fclose(file);
    return bytes;
}

static int find_name(char name[LINUX_PATH_SIZE], const struct board *board, const char *path,
                     char error[LINUX_ERROR_SIZE])
{
    const int n = path != NULL ? snprintf(name, LINUX_PATH_SIZE, "%s", path)
                               : snprintf(name, LINUX_PATH_SIZE, "/dev/spidev%u.%u", board->spi_bus, board->spi_select);
    return n < LINUX_PATH_SIZE ? HAL_OK
                               : linux_fail(error, HAL_EINVAL, "%s..: longer than %d characters; give a /dev/spidev",
                                            name, LINUX_PATH_SIZE - 1);
}

static int refused(const char *name, int number, char error[LINUX_ERROR_SIZE])
{
    const int status = linux_status(number);
    switch (number) {
    case ENOENT:
    case ENODEV:
    case ENXIO:
        return linux_fail(error, status,
                          "%s is not there: SPI is off; on a Raspberry Pi add dtparam=spi=on to config.txt and restart "
                          "(other boards: their device tree overlay)",
                          name);
    case EACCES:
    case EPERM:
        return linux_fail(
            error, status,
            "%s: no permission; add yourself to the group spi (usermod -aG spi NAME, then log in again) or "
            "install boards/udev/60-pinhole.rules",
            name);
    case ENOMEM:
        return linux_fail(error, status, "%s: no memory for its buffers; make spidev.bufsiz smaller (it is %zu)", name,
                          linux_spi_bufsiz());
    default:
        return linux_fail(error, status, "%s cannot be opened: %s", name, strerror(number));
    }
}

int linux_spi_open(struct linux_spi *spi, const struct board *board, const char *path, char error[LINUX_ERROR_SIZE])
{
    uint8_t mode = board->spi_mode;
    uint8_t word_bits = 8;
    spi->descriptor = -1;
    const int named = find_name(spi->name, board, path, error);
    if (named < 0) {
        return named;
    }
    const int opened = open(spi->name, O_RDWR | O_CLOEXEC | O_NOCTTY);
    if (opened < 0) {
        return refused(spi->name, errno, error);
    }
    if (ioctl(opened, SPI_IOC_WR_MODE, &mode) < 0 || ioctl(opened, SPI_IOC_WR_BITS_PER_WORD, &word_bits) < 0) {
        const int number = errno;
        close(opened);
        return number == ENOTTY ? linux_fail(error, HAL_ENODEV, "%s is no SPI device; give a /dev/spidev", spi->name)
                                : linux_fail(error, linux_status(number), "%s: SPI mode %u is refused: %s", spi->name,
                                             board->spi_mode, strerror(number));
    }
    spi->descriptor = opened;
    return HAL_OK;
}

int32_t linux_spi_clock(struct linux_spi *spi, uint32_t hz, char error[LINUX_ERROR_SIZE])
{
    uint32_t got = hz > INT32_MAX ? INT32_MAX : hz;
    if (ioctl(spi->descriptor, SPI_IOC_WR_MAX_SPEED_HZ, &got) < 0 ||
        ioctl(spi->descriptor, SPI_IOC_RD_MAX_SPEED_HZ, &got) < 0) {
        return linux_fail(error, linux_status(errno), "%s: a clock of %u Hz cannot be set: %s; ask for another",
                          spi->name, (unsigned)hz, strerror(errno));
    }
    if (got == 0 || got > hz || got > INT32_MAX) {
        return linux_fail(error, HAL_EINVAL, "%s: no clock as slow as %u Hz", spi->name, (unsigned)hz);
    }
    spi->clock_hz = got;
    return (int32_t)got;
}

static int message_failed(const struct linux_spi *spi, size_t n, char error[LINUX_ERROR_SIZE])
{
    const int number = errno;
    const int status = linux_status(number);
    if (status == HAL_ENODEV) {
        return linux_fail(error, status, "%s is gone: the SPI device was removed while in use; start again", spi->name);
    }
    return linux_fail(error, status, "%s: sending %zu bytes at %u Hz failed: %s; dmesg may say more", spi->name, n,
                      (unsigned)spi->clock_hz, strerror(number));
}

static struct spi_ioc_transfer transfer_of(const struct linux_spi *spi, const void *out, void *in, size_t n)
{
    struct spi_ioc_transfer transfer;
    memset(&transfer, 0, sizeof transfer);
    transfer.tx_buf = (uintptr_t)out;
    transfer.rx_buf = (uintptr_t)in;
    transfer.len = (uint32_t)n;
    transfer.speed_hz = spi->clock_hz;
    transfer.bits_per_word = 8;
    return transfer;
}

int linux_spi_send(const struct linux_spi *spi, const uint8_t *bytes, size_t n, char error[LINUX_ERROR_SIZE])
{
    struct spi_ioc_transfer transfer = transfer_of(spi, bytes, NULL, n);
    return ioctl(spi->descriptor, SPI_IOC_MESSAGE(1), &transfer) < 0 ? message_failed(spi, n, error) : HAL_OK;
}

int linux_spi_read(const struct linux_spi *spi, uint8_t command, uint8_t *bytes, size_t n, char error[LINUX_ERROR_SIZE])
{
    struct spi_ioc_transfer transfers[2] = {transfer_of(spi, &command, NULL, 1), transfer_of(spi, NULL, bytes, n)};
    return ioctl(spi->descriptor, SPI_IOC_MESSAGE(2), transfers) < 0 ? message_failed(spi, n + 1, error) : HAL_OK;
}

int linux_spi_look(const struct board *board, const char *path, struct linux_spi_look *look,
                   char error[LINUX_ERROR_SIZE])
{
    struct linux_spi spi;
    error[0] = 0;
    look->asked_hz = board->spi_hz;
    look->got_hz = 0;
    const bool i2c = board->i2c_address != 0;
    const int opened = i2c ? linux_i2c_open(&spi, board, path, error) : linux_spi_open(&spi, board, path, error);
    memcpy(look->path, spi.name, sizeof look->path);
    if (opened < 0) {
        return opened;
    }
    if (i2c) {
        close(spi.descriptor);
        look->got_hz = board->spi_hz;
        return HAL_OK;
    }
    const int32_t got = linux_spi_clock(&spi, board->spi_hz, error);
    close(spi.descriptor);
    look->got_hz = got < 0 ? 0 : (uint32_t)got;
    return got < 0 ? (int)got : HAL_OK;
}
