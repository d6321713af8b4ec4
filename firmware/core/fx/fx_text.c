/* fx_text: decimal text to Q16.16 and back, both exact. See fx.h. */
#include "fx.h"
#include "fx_text.h"
#include "status.h"
#include "tier.h"

#include <stddef.h>
#include <stdbool.h>

PH_TIER(seldom) int fx_text_whole(uint32_t whole, char *text)
{
    int n = 0;
    uint32_t unit = 10000;
    while (unit > 1 && whole < unit) {
        unit /= 10;
    }
    for (; unit != 0; unit /= 10) {
        text[n++] = (char)('0' + whole / unit);
        whole %= unit;
    }
    return n;
}

PH_TIER(seldom) int fx_to_text(fx_t a, char text[FX_TEXT_SIZE])
{
    const uint32_t v = fx_magnitude(a);
    int n = 0;
    if (a < 0) {
        text[n++] = '-';
    }
    n += fx_text_whole(v >> 16, &text[n]);
    uint32_t part = v & 0xffff; /* 65536ths: at most sixteen digits, as each one removes a factor 2 */
    if (part != 0) {
        text[n++] = '.';
    }
    for (; part != 0; part &= 0xffff) {
        part *= 10;
        text[n++] = (char)('0' + (part >> 16));
    }
    text[n] = '\0';
    return n;
}

/* A number as it was read: digits with at most one point among them, and the exponent's effect. */
struct decimal {
    const char *first;
    const char *last;     /* one after the digits */
    int64_t whole_digits; /* before the point, once the exponent has moved it */
    bool negative;
};

PH_TIER(seldom) static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

/* Reads an exponent such as "e-12" at p. *end stays as it was if no digit follows the e. */
PH_TIER(seldom) static int64_t scan_exponent(const char *p, const char **end)
{
    if (*p != 'e' && *p != 'E') {
        return 0;
    }
    p++;
    const bool negative = *p == '-';
    if (*p == '-' || *p == '+') {
        p++;
    }
    int64_t e = 0;
    for (; is_digit(*p); *end = ++p) {
        if (e < INT64_MAX / 100) { /* no text is long enough to make up for more */
            e = e * 10 + (*p - '0');
        }
    }
    return negative ? -e : e;
}

/* Finds the parts of the number; *end is after it. Returns false if text is no number. */
PH_TIER(seldom) static bool scan(const char *text, struct decimal *d, const char **end)
{
    const char *p = text;
    const char *point = NULL;
    d->negative = *p == '-';
    if (*p == '-' || *p == '+') {
        p++;
    }
    d->first = p;
    bool any = false;
    for (; is_digit(*p) || (*p == '.' && point == NULL); p++) {
        if (*p == '.') {
            point = p;
        } else {
            any = true;
        }
    }
    d->last = p;
    d->whole_digits = (point != NULL ? point : p) - d->first;
    if (any) {
        *end = p;
        d->whole_digits += scan_exponent(p, end);
    }
    return any;
}

#define PLACES 17 /* decimals of a value in the middle between two others */
#define WHOLE  5  /* digits of 32768 */

PH_TIER(seldom) static uint64_t power_of_10(int64_t exponent)
{
    uint64_t power = 1;
    for (; exponent > 0; exponent--) {
        power *= 10;
    }
    return power;
}

/* Adds the digits up: whole part, fraction in 10^-17, and whether any digit is beyond. Returns false if too large. */
PH_TIER(seldom) static bool weigh(const struct decimal *d, uint32_t *whole, uint64_t *fraction, bool *rest)
{
    int64_t place = d->whole_digits - 1;
    *whole = 0;
    *fraction = 0;
    *rest = false;
    for (const char *p = d->first; p != d->last; p++) {
        if (*p == '.') {
            continue;
        }
        const uint32_t digit = (uint32_t)(*p - '0');
        if (digit != 0 && place >= WHOLE) {
            return false;
        }
        if (digit != 0 && place >= 0) {
            *whole += digit * (uint32_t)power_of_10(place);
        } else if (digit != 0 && place >= -PLACES) {
            *fraction += digit * power_of_10(PLACES + place);
        } else if (digit != 0) {
            *rest = true;
        }
        place--;
    }
    return true;
}

PH_TIER(seldom) int fx_from_text(const char *text, fx_t *out, const char **end)
{
    struct decimal d;
    const char *behind = text;
    const bool any = scan(text, &d, &behind);
    if (end != NULL) {
        *end = behind;
    }
    if (!any) {
        return PH_ERR_INVAL;
    }
    uint32_t whole;
    uint64_t part;
    bool rest;
    if (!weigh(&d, &whole, &part, &rest)) {
        return PH_ERR_RANGE;
    }
    const uint64_t one = power_of_10(PLACES);
    uint64_t v = whole;
    for (int i = 0; i < 16; i++) {
        part *= 2;
        v = v * 2 + (part >= one);
        part -= part >= one ? one : 0;
    }
    const uint64_t twice = 2 * part;
    v += twice > one || (twice == one && (rest || !d.negative)); /* a tie rounds up */
    if (v > (uint64_t)FX_MAX + d.negative) {
        return PH_ERR_RANGE;
    }
    *out = d.negative ? (fx_t)(0u - (uint32_t)v) : (fx_t)v;
    return PH_OK;
}
