/* record: writes the events on an emulated chip's wires (host-sim/wire/wire_events.h has the format). */
#ifndef RECORD_H
#define RECORD_H

#include "chip.h"

#include <stdio.h>

void record_open(FILE *to, const struct chip *chip);
void record_name(uint32_t pin, const char *name);
void record_levels(void);
void record_word_start(void);
void record_word(const struct spi *spi, uint32_t bits);
void record_note(const char *text);
/* The levels of an unfinished word count, too. Returns false when not all could be written. */
bool record_close(void);

#endif
