/* fx_text_rounded: decimal text with a given number of places. See fx_math.h. */
#include "fx_math.h"
#include "fx_text.h"
#include "tier.h"

#include <stdbool.h>

/* Adds one to the last of n decimal digits. Returns whether all were nines, which become zeros. */
PH_TIER(seldom) static bool carry(char *digits, int n)
{
    while (n > 0 && digits[n - 1] == '9') {
        digits[--n] = '0';
    }
    if (n > 0) {
        digits[n - 1]++;
    }
    return n == 0;
}

PH_TIER(seldom) int fx_to_text_rounded(fx_t a, int places, char text[FX_TEXT_SIZE])
{
    enum { MOST = 16 }; /* from there on there is nothing to round */
    char digits[MOST];
    places = places < 0 ? 0 : places > MOST ? MOST : places;
    uint32_t whole = fx_magnitude(a) >> 16;
    uint32_t part = fx_magnitude(a) & 0xffff;
    bool zero = true;
    for (int i = 0; i < places; i++) {
        part = (part & 0xffff) * 10;
        digits[i] = (char)('0' + (part >> 16));
    }
    part &= 0xffff;
    if (part > FX_HALF || (part == FX_HALF && a > 0)) {
        whole += carry(digits, places);
    }
    for (int i = 0; i < places; i++) {
        zero = zero && digits[i] == '0';
    }
    int n = 0;
    if (a < 0 && !(zero && whole == 0)) {
        text[n++] = '-';
    }
    n += fx_text_whole(whole, &text[n]);
    if (places > 0) {
        text[n++] = '.';
    }
    for (int i = 0; i < places; i++) {
        text[n++] = digits[i];
    }
    text[n] = '\0';
    return n;
}
