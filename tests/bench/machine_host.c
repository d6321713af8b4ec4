/* This computer: instructions are counted by callgrind, which dumps its counters at each stop: the n-th dump is the
 * n-th "counted". */
#define _POSIX_C_SOURCE 200809L

#include "bench.h"

#include <stdio.h>
#include <valgrind/callgrind.h>

static int words;
static char **word_list;

void machine_start(void)
{
    CALLGRIND_ZERO_STATS;
}

void machine_stop(const char *const what[3], uint32_t frame)
{
    CALLGRIND_DUMP_STATS;
    printf("%s %s %s %u counted\n", what[0], what[1], what[2], (unsigned)frame);
}

void machine_known_loop(void)
{
    uint32_t turns = 1000000;
    __asm__ volatile("1: sub $1, %0\n jne 1b" : "+r"(turns) : : "cc");
}

void machine_print(const char *text)
{
    fputs(text, stdout);
}

const char *machine_word(unsigned i)
{
    return (int)i + 1 < words ? word_list[i + 1] : "";
}

__attribute__((constructor)) static void take_words(int argc, char **argv)
{
    words = argc;
    word_list = argv;
}
