/*
 * fuzz: what the fuzzers of readers (tests/FOLDER/fuzz_*.c) share: random numbers, changes of right files, a file in
 * memory, and the command line. Input number i depends on seed + i alone, so that one that fails can be run again.
 */
#ifndef FUZZ_H
#define FUZZ_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* 0 .. n - 1 */
uint32_t fuzz_below(uint32_t n);

/* A number that readers stumble over, or any. */
uint32_t fuzz_number(void);

/* Changes a few bytes, numbers or pieces of n bytes, of which there may become `room`. Returns how many they are. */
size_t fuzz_change(uint8_t *bytes, size_t n, size_t room);

/* Changes a text: numbers become other numbers, words other words of the text. */
size_t fuzz_change_text(char *text, size_t n, size_t room);

/* The path of a file with these bytes, which the next call writes over. */
const char *fuzz_file(const void *bytes, size_t n);

/* What a reader has said on stderr since the last call; the text is cut to what fits. It fails unless that is nothing
 * where the input was taken, else one line. */
const char *fuzz_said(bool is_taken);

/* Ends the run with a line that names the input. */
_Noreturn void fuzz_fail(const char *what);

struct fuzz {
    const char *name;
    uint32_t quick, most; /* inputs of `quick` and of `long` */
    bool (*one)(void);    /* makes an input and reads it: was it taken? */
};

/* NAME [quick | long | INPUTS [SEED]]. The exit status: 1 also if a run of `quick` or more took all or none. */
int fuzz_main(const struct fuzz *fuzz, int argc, char *const argv[]);

#endif
