/* See c_text.h. */
#include "c_text.h"

#include <setjmp.h>
#include <stdarg.h>
#include <cmocka.h>

#include <ctype.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int c_text_numbers(const char *text, const char *name, int64_t numbers[C_TEXT_MAX])
{
    char begin[64];
    int count = 0;
    snprintf(begin, sizeof begin, " %s[", name);
    const char *at = strstr(text, begin);
    at = at != NULL ? strstr(at, " = {") : NULL;
    const char *const end = at != NULL ? strstr(at, "};") : NULL;
    if (end == NULL) {
        return -1;
    }
    while (at < end && count < C_TEXT_MAX) {
        const bool is_number = isdigit((unsigned char)*at) || (*at == '-' && isdigit((unsigned char)at[1]));
        char *behind = (char *)(uintptr_t)at + 1;
        if (is_number) {
            numbers[count++] = strtoll(at, &behind, 0);
        }
        at = behind;
    }
    return at < end ? -1 : count;
}

static int64_t of_i16(const void *values, size_t i)
{
    return ((const int16_t *)values)[i];
}

static int64_t of_u16(const void *values, size_t i)
{
    return ((const uint16_t *)values)[i];
}

static int64_t of_i32(const void *values, size_t i)
{
    return ((const int32_t *)values)[i];
}

static void expect(const char *text, const char *name, const void *values, size_t n,
                   int64_t (*of)(const void *values, size_t i))
{
    int64_t numbers[C_TEXT_MAX];
    const int count = c_text_numbers(text, name, numbers);
    if (count != (int)n) {
        fail_msg("%s has %d numbers, not %u", name, count, (unsigned)n);
    }
    for (size_t i = 0; i < n; i++) {
        if (numbers[i] != of(values, i)) {
            fail_msg("%s[%u] is %lld, not %lld", name, (unsigned)i, (long long)numbers[i], (long long)of(values, i));
        }
    }
}

void c_text_expect_i16(const char *text, const char *name, const int16_t *values, size_t n)
{
    expect(text, name, values, n, of_i16);
}

void c_text_expect_u16(const char *text, const char *name, const uint16_t *values, size_t n)
{
    expect(text, name, values, n, of_u16);
}

void c_text_expect_i32(const char *text, const char *name, const int32_t *values, size_t n)
{
    expect(text, name, values, n, of_i32);
}
