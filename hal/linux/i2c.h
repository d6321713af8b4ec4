/* i2c: sends bytes through i2c-dev. Private to hal/linux. Results: 0, or a status of hal.h with its line in error. */
#ifndef HAL_LINUX_I2C_H
#define HAL_LINUX_I2C_H

#include "linux_types.h"

#define LINUX_I2C_BYTES 256 /* the longest message, without its control byte; adapters take at least as much */

/* Opens /dev/i2c-BUS of the board, or path if not NULL, for the board's address. After an error nothing is open. */
int linux_i2c_open(struct linux_spi *bus, const struct board *board, const char *path, char error[LINUX_ERROR_SIZE]);

/* Sends n bytes (at most LINUX_I2C_BYTES) as one message: the control byte, then these. */
int linux_i2c_send(const struct linux_spi *bus, enum hal_dc dc, const uint8_t *bytes, size_t n,
                   char error[LINUX_ERROR_SIZE]);

#endif
