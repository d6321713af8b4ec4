/*
 * What the compiler calls for 32-bit / and %: by the SIO's divider (RP2040 datasheet 2.3.1.5), 8 cycles where libgcc
 * takes some 50 to 140. Each core has its own, and no handler divides. These replace libgcc's: the linker takes them
 * first. Division by zero is as undefined as in C.
 */
#include "registers.h"

uint32_t __aeabi_uidiv(uint32_t dividend, uint32_t divisor);
int32_t __aeabi_idiv(int32_t dividend, int32_t divisor);
uint64_t __aeabi_uidivmod(uint32_t dividend, uint32_t divisor);
uint64_t __aeabi_idivmod(int32_t dividend, int32_t divisor);

static void wait(void)
{
    while ((REG(SIO_DIV_CSR) & 1) == 0) {
    }
}

static void divide(uint32_t dividend, uint32_t divisor)
{
    REG(SIO_DIV_UDIVIDEND) = dividend;
    REG(SIO_DIV_UDIVISOR) = divisor;
    wait();
}

static void divide_signed(int32_t dividend, int32_t divisor)
{
    REG(SIO_DIV_SDIVIDEND) = (uint32_t)dividend;
    REG(SIO_DIV_SDIVISOR) = (uint32_t)divisor;
    wait();
}

/* Quotient in r0, remainder in r1; the quotient is read last, which marks the divider as free. */
static uint64_t both(void)
{
    const uint32_t remainder = REG(SIO_DIV_REMAINDER);
    const uint32_t quotient = REG(SIO_DIV_QUOTIENT);
    return (uint64_t)remainder << 32 | quotient;
}

uint32_t __aeabi_uidiv(uint32_t dividend, uint32_t divisor)
{
    divide(dividend, divisor);
    return REG(SIO_DIV_QUOTIENT);
}

int32_t __aeabi_idiv(int32_t dividend, int32_t divisor)
{
    divide_signed(dividend, divisor);
    return (int32_t)REG(SIO_DIV_QUOTIENT);
}

uint64_t __aeabi_uidivmod(uint32_t dividend, uint32_t divisor)
{
    divide(dividend, divisor);
    return both();
}

uint64_t __aeabi_idivmod(int32_t dividend, int32_t divisor)
{
    divide_signed(dividend, divisor);
    return both();
}
