/* fx_text: what the writers of decimal text share. */
#ifndef FX_TEXT_H
#define FX_TEXT_H

#include <stdint.h>

/* Writes the digits of a whole number below 100000, without a final zero; returns how many. */
int fx_text_whole(uint32_t whole, char *text);

#endif
