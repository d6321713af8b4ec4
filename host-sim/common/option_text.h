/* option_text: strict readers for the values of options. A reader returns true, or false and leaves *out alone. */
#ifndef OPTION_TEXT_H
#define OPTION_TEXT_H

#include "geom.h"

#include <stdbool.h>
#include <stdint.h>

/* Reads a number of decimal digits only, min .. max. */
bool option_text_u32(const char *text, uint32_t min, uint32_t max, uint32_t *out);

/* Reads "WxH", each 1 .. max. */
bool option_text_size(const char *text, uint16_t max, uint16_t *width, uint16_t *height);

/* Reads one decimal number that fits Q16.16, without a space before it; *rest is the text behind it. */
bool option_text_fx(const char *text, fx_t *out, const char **rest);

/* Reads `count` numbers with commas between them; *rest is the text behind them. */
bool option_text_fx_list(const char *text, fx_t *out, int count, const char **rest);

/* Returns the index of text in names[count], or PH_ERR_INVAL. */
int option_text_choice(const char *text, const char *const names[], int count);

/* Reads "0", "90", "180" or "270" degrees as quarter turns. */
bool option_text_turns(const char *text, uint8_t *out);

/* What --depth takes: a format, NULL where none was given, which means auto; and bits of exponent of a float
 * ("float16-e5"), 0: as the lens needs. */
struct option_depth {
    const struct ph_depth_format *format;
    uint8_t exponent;
};

bool option_text_depth(const char *text, struct option_depth *out);

#define OPTION_DEPTH_NAME 16 /* room for a format's name */
const char *option_text_depth_name(struct option_depth depth, char text[OPTION_DEPTH_NAME]);

#define OPTION_DEPTH_ALIAS "format" /* the other name of --depth, in all programs */

/* The values of --depth, as a help shows them and in words. */
#define OPTION_DEPTH_CHOICES "auto" PH_DEPTH_EACH(OPTION_DEPTH_CHOICE)
#define OPTION_DEPTH_VALUES  "auto" PH_DEPTH_EACH(OPTION_DEPTH_VALUE) ", or a float with -e3 .. -e6 behind it"

#define OPTION_DEPTH_VALUE(id, name, coding, bits, octaves, small)  ", " name
#define OPTION_DEPTH_CHOICE(id, name, coding, bits, octaves, small) "|" name OPTION_DEPTH_CHOICE_##coding
#define OPTION_DEPTH_CHOICE_FIXED
#define OPTION_DEPTH_CHOICE_FLOAT "[-eN]"
#define OPTION_DEPTH_CHOICE_LINEAR

/* Returns whether the name of a file has this ending and something before it. */
bool option_text_ends(const char *name, const char *ending);

#endif
