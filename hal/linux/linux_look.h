/*
 * linux_look: what `pinhole-panel doctor` tells of a computer's SPI and lines. It looks and takes nothing. Callers
 * include linux.h.
 */
#ifndef HAL_LINUX_LOOK_H
#define HAL_LINUX_LOOK_H

#include "board.h"

#include <stddef.h>

#define LINUX_ERROR_SIZE 384
#define LINUX_PATH_SIZE  64

/* spidev's limit on one message, bytes; 0: there is no spidev. */
size_t linux_spi_bufsiz(void);

struct linux_spi_look {
    char path[LINUX_PATH_SIZE];
    uint32_t asked_hz, got_hz; /* got: what spidev keeps, as asked; the controller's clock may be less */
};

/*
 * Opens the board's SPI or I2C device (or path, if not NULL), sets mode and clock as linux_ops would, and closes it.
 * Returns 0, or the error that open would return, with its line in error.
 */
int linux_spi_look(const struct board *board, const char *path, struct linux_spi_look *look,
                   char error[LINUX_ERROR_SIZE]);

struct linux_line_look {
    char chip[LINUX_PATH_SIZE]; /* "/dev/gpiochip0" */
    char label[32], name[32];   /* as the kernel says */
    unsigned offset;
    bool taken;
    char holder[32]; /* if taken: the consumer's name, "" if it gave none */
};

/* Finds the line of a wired pin of the board. Returns 0, or the error that open would return, with its line in error.
 */
int linux_line_look(const struct board *board, const struct board_pin *pin, struct linux_line_look *look,
                    char error[LINUX_ERROR_SIZE]);

/* The version of libgpiod, "1.6.3"; NULL: built without libgpiod. */
const char *linux_gpiod_version(void);

#endif
