/* See fuzz.h. */
#define _GNU_SOURCE /* memfd_create */

#include "fuzz.h"

#include <ctype.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

static uint64_t state, input;
static int said = -1;

void fuzz_fail(const char *what)
{
    dprintf(STDERR_FILENO, "input %" PRIu64 ": %s\n", input, what);
    abort();
}

uint32_t fuzz_below(uint32_t n)
{
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)((state >> 32) * n >> 32);
}

uint32_t fuzz_number(void)
{
    static const uint32_t odd[] = {
        0,     1,     2,     3,     4,          7,          8,          9,          15,         16,         31,
        63,    64,    127,   128,   255,        256,        1023,       1024,       4095,       4096,       32767,
        32768, 65535, 65536, 65537, 0x7fffffff, 0x80000000, 0xfffffffc, 0xfffffffe, UINT32_MAX, 0x40000000, 0x55555556};
    const uint32_t n = sizeof odd / sizeof odd[0], i = fuzz_below(n + 2);
    return i < n ? odd[i] : fuzz_below(UINT32_MAX) >> fuzz_below(32);
}

/* Copies a piece of the bytes over another, moves all behind it, or leaves it out. */
static size_t change_piece(uint8_t *bytes, size_t n, size_t room)
{
    const uint32_t from = fuzz_below((uint32_t)n), to = fuzz_below((uint32_t)n);
    const size_t most = n - (from > to ? from : to), piece = fuzz_below((uint32_t)(most < 64 ? most : 64)) + 1;
    switch (fuzz_below(4)) {
    case 0:
        memmove(bytes + to, bytes + from, piece);
        return n;
    case 1:
        memmove(bytes + to, bytes + to + piece, n - to - piece);
        return n - piece;
    case 2:
        if (n + piece > room) {
            return n;
        }
        memmove(bytes + to + piece, bytes + to, n - to);
        return n + piece;
    default:
        return fuzz_below(4) == 0 ? to : n;
    }
}

size_t fuzz_change(uint8_t *bytes, size_t n, size_t room)
{
    for (uint32_t i = 1 + fuzz_below(4); i > 0 && n > 4; i--) {
        const uint32_t at = fuzz_below((uint32_t)n - 4), number = fuzz_number();
        switch (fuzz_below(6)) {
        case 0:
            bytes[at] ^= (uint8_t)(1u << fuzz_below(8));
            break;
        case 1:
            bytes[at] = (uint8_t)number;
            break;
        case 2:
            memcpy(bytes + (at & ~3u), &number, 4);
            break;
        case 3:
            memcpy(bytes + (at & ~1u), &number, 2);
            break;
        default:
            n = change_piece(bytes, n, room);
            break;
        }
    }
    return n;
}

/* Replaces the number or word at or behind a place. */
static size_t change_word(char *text, size_t n, size_t room)
{
    static const char *const words[] = {"",
                                        "-",
                                        "-1",
                                        "-0",
                                        "1e39",
                                        "1e-40",
                                        "nan",
                                        "inf",
                                        "0x10",
                                        "1/2/3",
                                        "#",
                                        "+",
                                        "\\",
                                        "18446744073709551615",
                                        "18446744073709551616",
                                        "4294967296",
                                        "99999999999999999999"};
    char with[24];
    size_t at = fuzz_below((uint32_t)n), old = 0;
    while (at < n && !isalnum((unsigned char)text[at])) {
        at++;
    }
    while (at + old < n && isalnum((unsigned char)text[at + old])) {
        old++;
    }
    const uint32_t i = fuzz_below(2 * sizeof words / sizeof words[0]);
    if (i < sizeof words / sizeof words[0]) {
        snprintf(with, sizeof with, "%s", words[i]);
    } else {
        const uint32_t number = fuzz_number();
        snprintf(with, sizeof with, i % 2 != 0 ? "%u" : "%x", (unsigned)number);
    }
    const size_t length = strlen(with);
    if (n - old + length > room) {
        return n;
    }
    memmove(text + at + length, text + at + old, n - at - old);
    memcpy(text + at, with, length);
    return n - old + length;
}

size_t fuzz_change_text(char *text, size_t n, size_t room)
{
    for (uint32_t i = 1 + fuzz_below(4); i > 0 && n > 4; i--) {
        n = fuzz_below(4) != 0 ? change_word(text, n, room) : fuzz_change((uint8_t *)text, n, room);
    }
    return n;
}

const char *fuzz_file(const void *bytes, size_t n)
{
    static int file = -1;
    static char path[40];
    if (file < 0) {
        file = memfd_create("fuzz", 0);
        snprintf(path, sizeof path, "/proc/self/fd/%d", file);
    }
    if (file < 0 || ftruncate(file, 0) != 0 || pwrite(file, bytes, n, 0) != (ssize_t)n) {
        fuzz_fail("no file in memory");
    }
    return path;
}

const char *fuzz_said(bool is_taken)
{
    static char text[4096];
    fflush(stderr);
    const ssize_t n = pread(said, text, sizeof text - 1, 0);
    text[n > 0 ? n : 0] = '\0';
    if (n < 0 || ftruncate(said, 0) != 0 || lseek(said, 0, SEEK_SET) != 0) {
        fuzz_fail("no file in memory");
    }
    const char *const end = strchr(text, '\n');
    if (is_taken ? text[0] != '\0' : end == NULL || end[1] != '\0') {
        fuzz_fail("not one line, or one for what was taken");
    }
    return text;
}

/* From now on the stream stderr writes into a file in memory; sanitizers go on to write to the descriptor. */
static void catch_stderr(void)
{
    said = memfd_create("said", 0);
    FILE *const file = said >= 0 ? fdopen(said, "w") : NULL;
    if (file == NULL) {
        fuzz_fail("no file in memory");
    }
    stderr = file; /* glibc allows that */
}

int fuzz_main(const struct fuzz *fuzz, int argc, char *const argv[])
{
    uint32_t inputs = fuzz->quick, taken = 0;
    uint64_t seed = 20261126;
    if (argc > 3 || (argc > 1 && argv[1][0] == '-')) {
        fprintf(argc == 2 ? stdout : stderr, "usage: %s [quick | long | INPUTS [SEED]]\n", fuzz->name);
        return argc == 2 && strcmp(argv[1], "--help") == 0 ? 0 : 2;
    }
    if (argc > 1 && strcmp(argv[1], "quick") != 0) {
        inputs = strcmp(argv[1], "long") == 0 ? fuzz->most : (uint32_t)strtoul(argv[1], NULL, 10);
    }
    if (argc > 2) {
        seed = strtoull(argv[2], NULL, 10);
    }
    printf("%s: %" PRIu32 " inputs, seed %" PRIu64 "\n", fuzz->name, inputs, seed);
    fflush(stdout);
    catch_stderr();
    for (uint32_t i = 0; i < inputs; i++) {
        input = seed + i;
        state = input * 0xd1342543de82ef95u;
        taken += fuzz->one();
    }
    printf("%" PRIu32 " taken\n", taken);
    return inputs < fuzz->quick || (taken > inputs / 100 && taken < inputs) ? 0 : 1;
}
