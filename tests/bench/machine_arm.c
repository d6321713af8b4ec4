/*
 * QEMU mps2-an385 (Cortex-M3) or mps2-an386 (M4F) under `-icount shift=0`: one instruction takes 1 ns, and CMSDK timer
 * 0 counts at 25 MHz, so a tick is 40 instructions. Application note AN385: timer 0 at 0x40000000, UART 0 at
 * 0x40004000.
 */
#include "bench.h"

#define REGISTER(address) (*(volatile uint32_t *)(address))
#define TIMER_CTRL        REGISTER(0x40000000)
#define TIMER_VALUE       REGISTER(0x40000004)
#define TIMER_RELOAD      REGISTER(0x40000008)
#define UART_DATA         REGISTER(0x40004000)
#define UART_CTRL         REGISTER(0x40004008)
#define UART_BAUDDIV      REGISTER(0x40004010)

#define INSTRUCTIONS_A_TICK 40
#define WORDS               2

extern uint32_t stack_top[], data_load[], data_start[], data_end[], bss_start[], bss_end[];
int main(void);
void reset(void);

static uint32_t started;
static char command_line[64];

/* Arm's semihosting: operation in r0, its argument in r1, where the calling convention puts them. */
__attribute__((naked, noinline)) static void semihost(uint32_t operation __attribute__((unused)),
                                                      const void *argument __attribute__((unused)))
{
    __asm__ volatile("bkpt 0xAB\n"
                     "bx lr\n");
}

static void quit(int status)
{
    const uint32_t block[2] = {0x20026, (uint32_t)status}; /* ADP_Stopped_ApplicationExit */
    semihost(0x20, block);                                 /* SYS_EXIT_EXTENDED */
}

static void read_command_line(void)
{
    const struct {
        char *text;
        uint32_t size;
    } block = {command_line, sizeof command_line};
    semihost(0x15, &block); /* SYS_GET_CMDLINE */
}

static void fault(void)
{
    machine_print("fault\n");
    quit(3);
}

__attribute__((section(".vectors"), used)) static void (*const vectors[16])(void) = {
    (void (*)(void))stack_top, reset, fault, fault, fault, fault, fault};

void reset(void)
{
    for (uint32_t *to = data_start, *from = data_load; (uintptr_t)to < (uintptr_t)data_end;) {
        *to++ = *from++;
    }
    for (uint32_t *to = bss_start; (uintptr_t)to < (uintptr_t)bss_end;) {
        *to++ = 0;
    }
    UART_BAUDDIV = 16;
    UART_CTRL = 1;
    TIMER_RELOAD = UINT32_MAX;
    TIMER_VALUE = UINT32_MAX;
    TIMER_CTRL = 1;
    read_command_line();
    quit(main());
}

void machine_start(void)
{
    started = TIMER_VALUE;
}

static void print_number(uint32_t n)
{
    char digits[11] = "";
    int at = 10;
    do {
        digits[--at] = (char)('0' + n % 10);
        n /= 10;
    } while (n > 0);
    machine_print(&digits[at]);
}

void machine_stop(const char *const what[3], uint32_t frame)
{
    const uint32_t ticks = started - TIMER_VALUE;
    for (int i = 0; i < 3; i++) {
        machine_print(what[i]);
        machine_print(" ");
    }
    print_number(frame);
    machine_print(" ");
    print_number(ticks * INSTRUCTIONS_A_TICK);
    machine_print("\n");
}

void machine_known_loop(void)
{
    uint32_t turns = 1000000;
    __asm__ volatile(".syntax unified\n1: subs %0, #1\n bne 1b" : "+l"(turns) : : "cc");
}

void machine_print(const char *text)
{
    while (*text != '\0') {
        UART_DATA = (uint8_t)*text++;
    }
}

/* The first word is the image's name; words end at a space, which is written over here. */
const char *machine_word(unsigned i)
{
    static const char *words[WORDS + 1] = {"", "", ""};
    static int known;
    if (!known) {
        known = 1;
        char *c = command_line;
        for (unsigned n = 0; n <= WORDS && *c != '\0'; n++) {
            words[n] = c;
            while (*c != '\0' && *c != ' ') {
                c++;
            }
            if (*c == ' ') {
                *c++ = '\0';
            }
        }
    }
    return i < WORDS ? words[i + 1] : "";
}
