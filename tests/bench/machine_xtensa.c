/*
 * QEMU's Xtensa board lx60-nommu with the core lx106 (the ESP8266's) under `-icount shift=0`: one instruction takes 1
 * ns. RAM is at 0x60000000. CCOUNT counts at 40 MHz, so a tick is 25 instructions. `simcall` calls the emulator with
 * the numbers of Tensilica's simulator.
 */
#include "bench.h"
#include "machine_bare.h"

#include <string.h>

enum { SIM_EXIT = 1, SIM_WRITE = 4, SIM_ARGV = 1002, STDOUT = 1, INSTRUCTIONS_A_TICK = 25 };

/* Exceptions go to VECBASE + 0x30 (kernel), 0x50 (user) and 0x70 (double). The stack pointer of C is a1. */
__asm__(".section .vectors, \"ax\"\n"
        "vectors:\n"
        ".literal_position\n" /* constants lie before the code that loads them */
        ".irp vector, 0x30, 0x50, 0x70\n"
        ".org \\vector\n"
        "movi a3, fault\n"
        "jx a3\n"
        ".endr\n"
        ".align 4\n"
        ".global reset\n"
        "reset:\n"
        "movi a3, vectors\n"
        "wsr a3, vecbase\n"
        "movi a3, 0\n"
        "wsr a3, ps\n"
        "rsync\n"
        "movi a1, stack_top\n"
        "movi a3, machine_run\n"
        "jx a3\n"
        "call_emulator:\n"
        "simcall\n"
        "ret\n"
        ".text\n");

/* The calling convention puts these where `simcall` looks for them. */
void call_emulator(int number, uint32_t a, uint32_t b, uint32_t c);
void fault(void);

void machine_quit(int status)
{
    call_emulator(SIM_EXIT, (uint32_t)status, 0, 0);
}

__attribute__((used)) void fault(void)
{
    machine_print("fault\n");
    machine_quit(3);
}

/* The emulator writes the addresses of the words, 0, and the words one after the other. */
void machine_command_line(char *text, uint32_t size)
{
    static uint32_t words[64] = {0};
    const char *const end = text + size - 1;
    call_emulator(SIM_ARGV, (uint32_t)(uintptr_t)words, 0, 0);
    for (uint32_t i = 0; words[i] != 0; i++) {
        for (const char *c = (const char *)(uintptr_t)words[i]; *c != '\0' && text < end; c++) {
            *text++ = *c;
        }
        if (text < end) {
            *text++ = ' ';
        }
    }
    *text = '\0';
}

uint32_t machine_count(void)
{
    uint32_t ticks;
    __asm__ volatile("rsr %0, ccount" : "=r"(ticks));
    return ticks * INSTRUCTIONS_A_TICK;
}

void machine_known_loop(void)
{
    uint32_t turns = 1000000;
    __asm__ volatile("1: addi %0, %0, -1\n bnez %0, 1b" : "+r"(turns));
}

void machine_print(const char *text)
{
    call_emulator(SIM_WRITE, STDOUT, (uint32_t)(uintptr_t)text, (uint32_t)strlen(text));
}
