/* See machine_bare.h and bench.h. */
#include "machine_bare.h"

#include "bench.h"

#define WORDS 2

extern uint32_t data_load[], data_start[], data_end[], bss_start[], bss_end[]; /* bench.ld */
int main(void);

static uint32_t started;
static char command_line[64];

void machine_run(void)
{
    for (uint32_t *to = data_start, *from = data_load; (uintptr_t)to < (uintptr_t)data_end;) {
        *to++ = *from++;
    }
    for (uint32_t *to = bss_start; (uintptr_t)to < (uintptr_t)bss_end;) {
        *to++ = 0;
    }
    machine_command_line(command_line, sizeof command_line);
    machine_quit(main());
}

void machine_start(void)
{
    started = machine_count();
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
    const uint32_t instructions = machine_count() - started;
    for (int i = 0; i < 3; i++) {
        machine_print(what[i]);
        machine_print(" ");
    }
    print_number(frame);
    machine_print(" ");
    print_number(instructions);
    machine_print("\n");
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
