/* c_text: arrays of numbers in C that was written, read back from its text. */
#ifndef C_TEXT_H
#define C_TEXT_H

#include <stddef.h>
#include <stdint.h>

#define C_TEXT_MAX 256

/* Reads the numbers, decimal or hexadecimal, between "NAME... = {" and the next "};". Returns how many there are, or
 * -1: no such array, or more than C_TEXT_MAX. */
int c_text_numbers(const char *text, const char *name, int64_t numbers[C_TEXT_MAX]);

/* Fails the test unless the array has just these numbers. */
void c_text_expect_i16(const char *text, const char *name, const int16_t *values, size_t n);
void c_text_expect_u16(const char *text, const char *name, const uint16_t *values, size_t n);
void c_text_expect_i32(const char *text, const char *name, const int32_t *values, size_t n);

#endif
