/* spi: sends bytes through spidev. Private to hal/linux. Results: 0, or a status of hal.h with its line in error. */
#ifndef HAL_LINUX_SPI_H
#define HAL_LINUX_SPI_H

#include "linux_types.h"

/*
 * Bytes of the next transfer when `left` (> 0) are left. spidev limits the SUM of a message's transfers to bufsiz, each
 * rounded up to the alignment of DMA buffers (at most 128 bytes; 8 on machines whose bufsiz is below that). So the best
 * message is one transfer that is as long as that allows.
 */
size_t linux_spi_piece(size_t left, size_t bufsiz);

/* Opens the board's device, or path if not NULL, sets its mode and 8 bits a word. After an error nothing is open. */
int linux_spi_open(struct linux_spi *spi, const struct board *board, const char *path, char error[LINUX_ERROR_SIZE]);

/* Sets the clock, hz > 0; returns the clock that spidev keeps. */
int32_t linux_spi_clock(struct linux_spi *spi, uint32_t hz, char error[LINUX_ERROR_SIZE]);

/* Sends one piece (linux_spi_piece). */
int linux_spi_send(const struct linux_spi *spi, const uint8_t *bytes, size_t n, char error[LINUX_ERROR_SIZE]);

/* Sends a command byte, then reads n bytes, under one chip select. */
int linux_spi_read(const struct linux_spi *spi, uint8_t command, uint8_t *bytes, size_t n,
                   char error[LINUX_ERROR_SIZE]);

#endif
