/* Decimal text: no overflow and no bad shift; every number to text, and all texts of up to 12 characters. */
#include "proof.h"

#include "../../firmware/core/fx/fx_text.c"
#include "../../firmware/core/fx/fx_text_rounded.c"

void proof_to_text(void)
{
    char text[FX_TEXT_SIZE];
    const int length = fx_to_text(nondet_i32(), text);
    CLAIM(length > 0 && length < FX_TEXT_SIZE && text[length] == '\0');
}

#define LONGEST 12

void proof_from_text(void)
{
    char text[LONGEST + 1];
    const char *end;
    fx_t out;
    text[LONGEST] = '\0';
    fx_from_text(text, &out, &end);
    CLAIM(end >= text && end <= text + LONGEST);
}

void proof_to_text_rounded(void)
{
    char text[FX_TEXT_SIZE];
    fx_to_text_rounded(nondet_i32(), nondet_i32(), text);
}
