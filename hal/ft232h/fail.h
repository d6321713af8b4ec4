/* fail: one line for people about an error. Private to hal/ft232h, but for the size. */
#ifndef HAL_FT232H_FAIL_H
#define HAL_FT232H_FAIL_H

#define FT232H_ERROR_SIZE 384

/* Writes the line to error (FT232H_ERROR_SIZE), cut to what fits, and returns status. */
int ft232h_fail(char *error, int status, const char *format, ...) __attribute__((format(printf, 3, 4)));

#endif
