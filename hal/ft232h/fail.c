/* See fail.h. */
#include "fail.h"

#include <stdarg.h>
#include <stdio.h>

int ft232h_fail(char *error, int status, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(error, FT232H_ERROR_SIZE, format, arguments);
    va_end(arguments);
    return status;
}
