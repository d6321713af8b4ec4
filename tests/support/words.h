/* words: a command line as main() gets it. */
#ifndef WORDS_H
#define WORDS_H

#define WORDS_MAX 40

/* Splits a line at its spaces into words, behind the name of a program. Returns how many words there are with it; they
 * last until the next call. */
int words_of(const char *line, char *words[WORDS_MAX]);

#endif
