/*
 * model_text: a whole file in memory, and its lines, words and numbers.
 *
 * A word is what stands between white space of one line; a line ends with \n, \r or both. Whatever the bytes are, each
 * call comes nearer to their end.
 */
#ifndef MODEL_TEXT_H
#define MODEL_TEXT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Reads a whole file, at most MODEL_FILE_MAX bytes, and puts a 0 behind it; free() it. NULL: it cannot be opened. */
char *model_text_load(const char *path, size_t *n);

struct model_text {
    const char *at, *end; /* *end is 0 */
    uint32_t line;        /* from 1 on */
    bool is_joined;       /* a \ at the end of a line joins it with the next */
};

struct model_word {
    const char *text;
    size_t n;
};

/* The next word of the line. false: there is none. */
bool model_text_word(struct model_text *text, struct model_word *word);

/* What is left of the line, without white space around it. */
struct model_word model_text_rest(struct model_text *text);

/* Goes to the next line. false: the text ends. */
bool model_text_next(struct model_text *text);

/* The next word of this line or of those behind it. */
bool model_text_any_word(struct model_text *text, struct model_word *word);

/* Whether the word is this one, in capitals or not. */
bool model_word_is(const struct model_word *word, const char *other);

/* A decimal number, nan or inf. */
bool model_word_number(const struct model_word *word, double *number);

/* A whole number that fits. */
bool model_word_whole(const struct model_word *word, int64_t *number);

/* Reads numbers from the line, at most `most`; returns how many come before something else. */
uint32_t model_text_numbers(struct model_text *text, uint32_t most, double *numbers);

#endif
