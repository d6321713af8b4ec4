/* What a program for qemu-riscv32 has in place of a C library: its start, and printf with %s and %08lx. The numbers of
 * the system calls are those of Linux for RISC-V. */
#include "stdio.h"

#include <stdarg.h>

int main(void);
void start(void);

static long call(long number, long a, long b, long c)
{
    register long a0 __asm__("a0") = a, a1 __asm__("a1") = b, a2 __asm__("a2") = c, a7 __asm__("a7") = number;
    __asm__ volatile("ecall" : "+r"(a0) : "r"(a1), "r"(a2), "r"(a7) : "memory");
    return a0;
}

static void put(char c)
{
    call(64, 1, (long)&c, 1); /* write */
}

static void put_hex(unsigned long value)
{
    for (int shift = 28; shift >= 0; shift -= 4) {
        put("0123456789abcdef"[value >> shift & 15]);
    }
}

int printf(const char *format, ...)
{
    va_list list;
    va_start(list, format);
    for (; *format != '\0'; format++) {
        if (format[0] == '%' && format[1] == 's') {
            for (const char *text = va_arg(list, const char *); *text != '\0'; text++) {
                put(*text);
            }
            format += 1;
        } else if (format[0] == '%') {
            put_hex(va_arg(list, unsigned long));
            format += 4;
        } else {
            put(*format);
        }
    }
    va_end(list);
    return 0;
}

__attribute__((used)) void start(void)
{
    call(93, main(), 0, 0); /* exit */
}

__attribute__((naked)) void _start(void)
{
    __asm__ volatile(".option push\n"
                     ".option norelax\n"
                     "la gp, __global_pointer$\n"
                     ".option pop\n"
                     "andi sp, sp, -16\n"
                     "j start");
}
