/*
 * The functions that the compiler calls for 32-bit / and %. They use the SIO's divider (RP2040 datasheet 2.3.1.5),
 * which takes 8 cycles; libgcc takes 50 to 140. Each core has a divider of its own, and no handler divides. The linker
 * takes these before libgcc's. Division by zero is as undefined as in C.
 */
#include <registers.h>
#include "hal.h"

uint32_t __aeabi_uidiv(uint32_t dividend, uint32_t divisor);
int32_t __aeabi_idiv(int32_t dividend, int32_t divisor);
uint64_t __aeabi_uidivmod(uint32_t dividend, uint32_t divisor);
uint64_t __aeabi_idivmod(int32_t dividend, int32_t divisor);

HAL_TIER(loop) static void wait(void)
{
    while ((REG(SIO_DIV_CSR) & 1) == 0) {
    }
}

HAL_TIER(loop) static void divide(uint32_t dividend, uint32_t divisor)
{
    REG(SIO_DIV_UDIVIDEND) = dividend;
    REG(SIO_DIV_UDIVISOR) = divisor;
    wait();
}

HAL_TIER(loop) static void divide_signed(int32_t dividend, int32_t divisor)
{
    REG(SIO_DIV_SDIVIDEND) = (uint32_t)dividend;
    REG(SIO_DIV_SDIVISOR) = (uint32_t)divisor;
    wait();
}

/* Reads both results of a division: the quotient goes into r0, the remainder into r1. Reading the quotient, the last,
 * marks the divider as free. */
HAL_TIER(loop) static uint64_t both(void)
{
    const uint32_t remainder = REG(SIO_DIV_REMAINDER);
    const uint32_t quotient = REG(SIO_DIV_QUOTIENT);
    return (uint64_t)remainder << 32 | quotient;
}

HAL_TIER(loop) uint32_t __aeabi_uidiv(uint32_t dividend, uint32_t divisor)
{
    divide(dividend, divisor);
    return REG(SIO_DIV_QUOTIENT);
}

HAL_TIER(loop) int32_t __aeabi_idiv(int32_t dividend, int32_t divisor)
{
    divide_signed(dividend, divisor);
    return (int32_t)REG(SIO_DIV_QUOTIENT);
}

HAL_TIER(loop) uint64_t __aeabi_uidivmod(uint32_t dividend, uint32_t divisor)
{
    divide(dividend, divisor);
    return both();
}

HAL_TIER(loop) uint64_t __aeabi_idivmod(int32_t dividend, int32_t divisor)
{
    divide_signed(dividend, divisor);
    return both();
}
