/* fail: one line for people about an error. Private to hal/linux. */
#ifndef HAL_LINUX_FAIL_H
#define HAL_LINUX_FAIL_H

#include "linux_look.h"

/* Converts Linux' errno (> 0) to a status of hal.h. A number that hal.h does not list becomes HAL_EIO. */
int linux_status(int number);

/* Writes the line, cut if it is too long, and returns status. */
int linux_fail(char error[LINUX_ERROR_SIZE], int status, const char *format, ...) __attribute__((format(printf, 3, 4)));

#endif
