/* See kms_fail.h. */
#include "kms_fail.h"

#include "hal.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

int kms_fail(char error[KMS_ERROR_SIZE], int number, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    const int n = vsnprintf(error, KMS_ERROR_SIZE, format, arguments);
    va_end(arguments);
    if (n >= 0 && n < KMS_ERROR_SIZE && (number == EACCES || number == EPERM)) {
        snprintf(
            error + n, KMS_ERROR_SIZE - (size_t)n,
            ": no permission; join the group video, and stop what else draws there (a desktop: take a text console)");
    } else if (n >= 0 && n < KMS_ERROR_SIZE && number != 0) {
        snprintf(error + n, KMS_ERROR_SIZE - (size_t)n, ": %s", strerror(number));
    }
    switch (number) {
    case EACCES:
    case EPERM:
        return HAL_EACCES;
    case EBUSY:
        return HAL_EBUSY;
    case 0:
    case ENOENT:
    case ENODEV:
        return HAL_ENODEV;
    default:
        return HAL_EIO;
    }
}
