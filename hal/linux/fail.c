/* See fail.h. */
#include "fail.h"

#include "hal.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>

int linux_status(int number)
{
    switch (number) {
    case EACCES:
    case EPERM:
        return HAL_EACCES;
    case EBUSY:
        return HAL_EBUSY;
    case ENOENT:
    case ENODEV:
    case ENXIO:
    case ESHUTDOWN: /* spidev: the device went away while it was open */
        return HAL_ENODEV;
    case EINVAL:
    case EMSGSIZE:
        return HAL_EINVAL;
    case ENOSYS:
        return HAL_ENOSYS;
    case ETIMEDOUT:
        return HAL_ETIMEDOUT;
    default:
        return HAL_EIO;
    }
}

int linux_fail(char error[LINUX_ERROR_SIZE], int status, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(error, LINUX_ERROR_SIZE, format, arguments);
    va_end(arguments);
    return status;
}
