/* See mpsse.h. */
#include "mpsse.h"

#include <string.h>

#define MPSSE_BASE_HZ 30000000U /* 60 MHz with two edges a bit */

size_t ft232h_mpsse_pins(uint8_t out[MPSSE_PINS_MAX], uint16_t levels, uint16_t outputs, uint16_t changed)
{
    size_t n = 0;
    if ((changed & 0xFF) != 0) {
        out[n++] = MPSSE_SET_LOW;
        out[n++] = (uint8_t)levels;
        out[n++] = (uint8_t)outputs;
    }
    if ((changed >> 8) != 0) {
        out[n++] = MPSSE_SET_HIGH;
        out[n++] = (uint8_t)(levels >> 8);
        out[n++] = (uint8_t)(outputs >> 8);
    }
    return n;
}

void ft232h_mpsse_block(uint8_t out[MPSSE_BLOCK], uint8_t command, size_t n)
{
    out[0] = command;
    out[1] = (uint8_t)(n - 1);
    out[2] = (uint8_t)((n - 1) >> 8);
}

uint32_t ft232h_mpsse_clock(uint8_t out[MPSSE_CLOCK], uint32_t hz)
{
    if (hz == 0) {
        return 0;
    }
    const uint32_t parts = MPSSE_BASE_HZ / hz + (MPSSE_BASE_HZ % hz != 0);
    const uint32_t divisor = parts == 0 ? 0 : parts - 1;
    if (divisor > UINT16_MAX) {
        return 0;
    }
    out[0] = MPSSE_DIVISOR;
    out[1] = (uint8_t)divisor;
    out[2] = (uint8_t)(divisor >> 8);
    return MPSSE_BASE_HZ / (divisor + 1);
}

int ft232h_mpsse_pin(const char *name)
{
    if (strlen(name) != 3 || name[0] != 'A' || name[2] < '0' || name[2] > '7') {
        return -1;
    }
    if (name[1] != 'D' && name[1] != 'C') {
        return -1;
    }
    return name[2] - '0' + (name[1] == 'C' ? 8 : 0);
}
