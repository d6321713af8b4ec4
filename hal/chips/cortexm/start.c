/* Start, time, faults: see start.h. Registers as in the ARMv7-M Architecture Reference Manual, B3. */
#include "chips/cortexm/start.h"

#include "panel.h"
#include "board.h"
#include "port.h"

#define SYST_CSR REG32(0xE000E010)
#define SYST_RVR REG32(0xE000E014)
#define SYST_CVR REG32(0xE000E018)
#define ICSR     REG32(0xE000ED04)
#define VTOR     REG32(0xE000ED08)
#define CFSR     REG32(0xE000ED28)
#define BFAR     REG32(0xE000ED38)
#define SHCSR    REG32(0xE000ED24)
#define MPU_CTRL REG32(0xE000ED94)
#define MPU_RNR  REG32(0xE000ED98)
#define MPU_RBAR REG32(0xE000ED9C)
#define MPU_RASR REG32(0xE000EDA0)

#define TICK_US     1000
#define STACK_PAINT 0x57AC57ACu

/* Symbols of the linker script. */
extern uint32_t ld_data_start[], ld_data_end[], ld_data_load[], ld_bss_start[], ld_bss_end[], ld_stack_guard[],
    ld_stack_start[], ld_stack_top[];

int main(void);
void cortexm_start(void);                                            /* for sections.ld */
void cortexm_fault_report(uint32_t pc, uint32_t lr, uint32_t saved); /* for on_fault */

#define SYSTEM_VECTORS 16
typedef void handler(void);
static handler *const vectors[SYSTEM_VECTORS];

static struct {
    uint32_t tick_us_at; /* time at the last tick */
    uint32_t clocks;     /* of the CPU in a microsecond */
    bool ending;
} machine;

static void tick(void) /* called as vector */
{
    machine.tick_us_at += TICK_US;
}

/* Counts a tick of SysTick within an exception, where its interrupt has to wait. */
static void tick_in_fault(void)
{
    if ((ICSR & 511) != 0 && (SYST_CSR & 1U << 16) != 0) {
        tick();
    }
}

uint32_t cortexm_time_us(void *context)
{
    uint32_t before, left;
    (void)context;
    tick_in_fault();
    do { /* reads again if a tick came in between */
        before = *(volatile uint32_t *)&machine.tick_us_at;
        left = SYST_CVR;
    } while (before != *(volatile uint32_t *)&machine.tick_us_at);
    return before + (TICK_US * machine.clocks - 1 - left) / machine.clocks;
}

void cortexm_delay_us(void *context, uint32_t us)
{
    const uint32_t from = cortexm_time_us(context);
    while (cortexm_time_us(context) - from <= us) {
    }
}

static void start_time(uint32_t clock_hz)
{
    machine.clocks = clock_hz / 1000000;
    SYST_RVR = TICK_US * machine.clocks - 1;
    SYST_CVR = 0;
    SYST_CSR = 7; /* on, interrupt, CPU clock */
}

/* The words from one address to another. They are compared as numbers: to C each symbol of the linker script is an
 * object of its own, and pointers into two objects may not be compared. */
static uint32_t words_between(const uint32_t *from, const uint32_t *to)
{
    return (uint32_t)(((uintptr_t)to - (uintptr_t)from) / 4);
}

static void fill(uint32_t *to, uint32_t words, uint32_t value)
{
    for (uint32_t i = 0; i < words; i++) {
        to[i] = value;
    }
}

/* Fills the unused stack with its own addresses, but for the frame of this very function. */
static __attribute__((noinline)) void paint_stack(void)
{
    const uint32_t below = words_between(ld_stack_start, (const uint32_t *)__builtin_frame_address(0));
    fill(ld_stack_start, below - 16, STACK_PAINT);
}

/* Forbids the 128 bytes below the stack to everybody. The rest of memory stays as without an MPU. */
static void guard_stack(void)
{
    MPU_RNR = 0;
    MPU_RBAR = (uint32_t)(uintptr_t)ld_stack_guard;
    MPU_RASR = 6U << 1 | 1U;
    MPU_CTRL = 5;
}

uint32_t port_stack_used(void)
{
    const uint32_t words = words_between(ld_stack_start, ld_stack_top);
    uint32_t unused = 0;
    while (unused < words && ld_stack_start[unused] == STACK_PAINT) {
        unused++;
    }
    return 4 * (words - unused);
}

/* The reset vector. A boot loader before the image may have left its own vectors in VTOR. */
void cortexm_start(void) /* called as vector */
{
    VTOR = (uint32_t)(uintptr_t)vectors;
    const uint32_t words = words_between(ld_data_start, ld_data_end);
    for (uint32_t i = 0; i < words; i++) {
        ld_data_start[i] = ld_data_load[i];
    }
    fill(ld_bss_start, words_between(ld_bss_start, ld_bss_end), 0);
    paint_stack();
    guard_stack();
    SHCSR |= 7U << 16; /* gives memory, bus and usage faults handlers of their own */
    start_time(port_start());
    port_exit(main());
}

/* ---- the end -------------------------------------------------------------------------------------- */

/* Asks a debugger or an emulator (Arm semihosting specification). The arguments lie in r0 and r1. */
__attribute__((naked, noinline)) static void semihosting(uint32_t operation __attribute__((unused)),
                                                         const uint32_t *block __attribute__((unused)))
{
    __asm__ volatile("bkpt 0xAB\n"
                     "bx lr\n");
}

static void semihosting_exit(int status)
{
    const uint32_t block[2] = {0x20026, (uint32_t)status}; /* ADP_Stopped_ApplicationExit */
    semihosting(0x20, block);                              /* SYS_EXIT_EXTENDED */
}

void cortexm_dark(void)
{
    struct panel_driver d = {.hal = port_hal(), .config = {.panel = board_here->panel}};
    port_bus_stop();
    panel_close(&d);
}

/* Ends the image. Without a debugger or emulator the semihosting call is a fault, which comes back here. */
void port_exit(int status)
{
    if (!machine.ending) {
        machine.ending = true;
        cortexm_dark();
        semihosting_exit(status);
    }
    for (;;) {
        __asm__ volatile("wfi");
    }
}

/* ---- faults ---------------------------------------------------------------------------------------- */

static void log_hex(const char *name, uint32_t value)
{
    char text[] = " 00000000";
    for (int i = 8; i > 0; i--, value >>= 4) {
        text[i] = "0123456789ABCDEF"[value & 15];
    }
    port_log(name);
    port_log(text);
}

/* Reports a fault and ends. saved: the stack had room for pc and lr, so they are known. */
void cortexm_fault_report(uint32_t pc, uint32_t lr, uint32_t saved)
{
    if (machine.ending) {
        port_exit(1);
    }
    log_hex("\r\nfault", ICSR & 511);
    if (saved != 0) {
        log_hex(": pc", pc);
        log_hex(", lr", lr);
    } else {
        port_log(": the stack ran over");
    }
    log_hex(", cause", CFSR);
    log_hex(", address", BFAR);
    port_log("\r\n");
    port_exit(1);
}

/* Reads what the exception saved, then starts the report on an empty stack, for the old one may be full. */
__attribute__((naked)) static void on_fault(void) /* called as vector */
{
    __asm__ volatile("mrs r3, msp\n"
                     "ldr r2, =ld_stack_start\n"
                     "cmp r3, r2\n"
                     "ittte hs\n"
                     "ldrhs r0, [r3, #24]\n"
                     "ldrhs r1, [r3, #20]\n"
                     "movhs r2, #1\n"
                     "movlo r2, #0\n"
                     "ldr r3, =ld_stack_top\n"
                     "mov sp, r3\n"
                     "b cortexm_fault_report\n");
}

__attribute__((section(".vectors"), used)) static handler *const vectors[SYSTEM_VECTORS] = {
    (handler *)ld_stack_top,
    cortexm_start,
    on_fault,
    on_fault,
    on_fault,
    on_fault,
    on_fault,
    on_fault,
    on_fault,
    on_fault,
    on_fault,
    on_fault,
    on_fault,
    on_fault,
    on_fault,
    tick,
};
