/* The functions of string.h. What lies on word boundaries moves in words. -fno-builtin keeps the compiler from making
 * these loops into calls of themselves. */
#include "include/string.h"

#include <stdint.h>

typedef uint32_t __attribute__((may_alias)) word;

static inline int aligned(const void *a, const void *b)
{
    return (((uintptr_t)a | (uintptr_t)b) & 3) == 0;
}

void *memcpy(void *restrict to, const void *restrict from, size_t n)
{
    uint8_t *t = to;
    const uint8_t *f = from;
    if (aligned(t, f)) {
        for (; n >= 16; n -= 16, t += 16, f += 16) {
            const word *in = (const word *)(const void *)f;
            word *out = (word *)(void *)t;
            const word a = in[0], b = in[1], c = in[2], d = in[3];
            out[0] = a;
            out[1] = b;
            out[2] = c;
            out[3] = d;
        }
        for (; n >= 4; n -= 4, t += 4, f += 4) {
            *(word *)(void *)t = *(const word *)(const void *)f;
        }
    }
    while (n-- > 0) {
        *t++ = *f++;
    }
    return to;
}

/* Forwards like memcpy, which reads each word before it writes it, unless the end would be lost. */
void *memmove(void *to, const void *from, size_t n)
{
    uint8_t *t = to;
    const uint8_t *f = from;
    if ((uintptr_t)t - (uintptr_t)f >= n) {
        return memcpy(to, from, n);
    }
    while (n-- > 0) {
        t[n] = f[n];
    }
    return to;
}

void *memset(void *to, int value, size_t n)
{
    uint8_t *t = to;
    const word all = (uint8_t)value * 0x01010101u;
    for (; n > 0 && ((uintptr_t)t & 3) != 0; n--) {
        *t++ = (uint8_t)value;
    }
    for (; n >= 16; n -= 16, t += 16) {
        word *out = (word *)(void *)t;
        out[0] = all;
        out[1] = all;
        out[2] = all;
        out[3] = all;
    }
    while (n-- > 0) {
        *t++ = (uint8_t)value;
    }
    return to;
}

int memcmp(const void *a, const void *b, size_t n)
{
    const uint8_t *p = a, *q = b;
    for (; n > 0; n--, p++, q++) {
        if (*p != *q) {
            return *p - *q;
        }
    }
    return 0;
}

int strcmp(const char *a, const char *b)
{
    while (*a != '\0' && *a == *b) {
        a++;
        b++;
    }
    return (uint8_t)*a - (uint8_t)*b;
}

size_t strlen(const char *text)
{
    size_t n = 0;
    while (text[n] != '\0') {
        n++;
    }
    return n;
}
