/* Numbers of the depth lab and their text: see lab_num.h. */
#include "lab_num.h"

static int clz64(uint64_t v)
{
    const uint32_t high = (uint32_t)(v >> 32);
    return high != 0 ? fx_clz32(high) : 32 + fx_clz32((uint32_t)v);
}

struct lab_num lab_num_scaled(uint64_t v, int e)
{
    if (v == 0) {
        return (struct lab_num){0, 0};
    }
    const int up = clz64(v);
    return (struct lab_num){v << up, e - up};
}

struct lab_num lab_num_of(uint64_t v)
{
    return lab_num_scaled(v, 0);
}

uint64_t lab_mulhi_u64(uint64_t a, uint64_t b)
{
    const uint32_t a0 = (uint32_t)a, a1 = (uint32_t)(a >> 32), b0 = (uint32_t)b, b1 = (uint32_t)(b >> 32);
    const uint64_t low = fx_mul_wide_u(a0, b0), cross1 = fx_mul_wide_u(a1, b0), cross2 = fx_mul_wide_u(a0, b1);
    const uint64_t middle = (low >> 32) + (uint32_t)cross1 + (uint32_t)cross2;
    return fx_mul_wide_u(a1, b1) + (cross1 >> 32) + (cross2 >> 32) + (middle >> 32);
}

struct lab_num lab_num_mul(struct lab_num a, struct lab_num b)
{
    return lab_num_scaled(lab_mulhi_u64(a.m, b.m), a.e + b.e + 64);
}

struct lab_num lab_num_div(struct lab_num a, struct lab_num b)
{
    const bool fits = a.m < b.m; /* else a / 2 is below b */
    uint64_t rest = fits ? a.m : a.m >> 1, quotient = 0;
    for (int i = 0; i < 64; i++) { /* one bit a turn; few numbers are printed */
        const bool carry = rest >> 63 != 0;
        rest <<= 1;
        quotient <<= 1;
        if (carry || rest >= b.m) {
            rest -= b.m;
            quotient |= 1;
        }
    }
    return lab_num_scaled(quotient, a.e - b.e - (fits ? 64 : 63));
}

uint64_t lab_log2_q56(uint32_t v)
{
    const int zeros = fx_clz32(v);
    uint64_t m = (uint64_t)v << zeros << 32, log = (uint64_t)(31 - zeros); /* m in 2^63 .. 2^64: 1 .. 2 */
    for (int i = 0; i < 56; i++) {
        m = lab_mulhi_u64(m, m); /* 2^62 .. 2^64: 1 .. 4 */
        log = log << 1 | m >> 63;
        m = m >> 63 != 0 ? m : m << 1;
    }
    return log;
}

/* v 10^n with n >= 0, or v / 10^-n. */
static struct lab_num times_ten(struct lab_num v, int n)
{
    const struct lab_num ten = lab_num_of(10);
    for (; n > 0; n--) {
        v = lab_num_mul(v, ten);
    }
    for (; n < 0; n++) {
        v = lab_num_div(v, ten);
    }
    return v;
}

/* v rounded to an integer, a tie up; v below 2^63. */
static uint64_t nearest(struct lab_num v)
{
    if (v.m == 0 || v.e < -64) {
        return 0;
    }
    const uint64_t half = (uint64_t)1 << (-v.e - 1);
    return (-v.e == 64 ? 0 : v.m >> -v.e) + ((v.m & half) != 0);
}

static char *put_digits(char *to, uint64_t v, int digits)
{
    for (int i = digits; i-- > 0; v /= 10) {
        to[i] = (char)('0' + v % 10);
    }
    return to + digits;
}

/* Writes digits[0 .. count - 1], the first of which has the weight 10^exponent. */
static void place_point(char *to, const char *digits, int count, int exponent) /* called as form */
{
    for (int i = exponent < 0 ? exponent : 0; i < count || i <= exponent; i++) {
        if (i == exponent + 1 && i > 0) {
            *to++ = '.';
        }
        *to++ = i >= 0 && i < count ? digits[i] : '0';
        if (i == exponent && exponent < 0) {
            *to++ = '.';
        }
    }
    *to = '\0';
}

static void exponent_form(char *to, const char *digits, int count, int exponent) /* called as form */
{
    *to++ = digits[0];
    if (count > 1) {
        *to++ = '.';
    }
    for (int i = 1; i < count; i++) {
        *to++ = digits[i];
    }
    *to++ = 'e';
    *to++ = exponent < 0 ? '-' : '+';
    to = put_digits(to, (uint32_t)(exponent < 0 ? -exponent : exponent), 2);
    *to = '\0';
}

#define DIGITS_MAX 10

/* Writes v with `places` significant digits, up to DIGITS_MAX, without the zeros at their end. */
static void put_number(struct lab_num v, int places, char text[LAB_TEXT_SIZE])
{
    if (v.m == 0) {
        text[0] = '0';
        text[1] = '\0';
        return;
    }
    int exponent = (v.e + 63) * 301 / 1000; /* about log10 */
    uint64_t least = 1;
    for (int i = 1; i < places; i++) {
        least *= 10;
    }
    uint64_t value = nearest(times_ten(v, places - 1 - exponent));
    while (value < least) {
        value = nearest(times_ten(v, places - 1 - --exponent));
    }
    while (value >= least * 10) {
        value = nearest(times_ten(v, places - 1 - ++exponent));
    }
    char digits[DIGITS_MAX];
    put_digits(digits, value, places);
    int count = places;
    while (count > 1 && digits[count - 1] == '0') {
        count--;
    }
    (exponent < -4 || exponent > 8 ? exponent_form : place_point)(text, digits, count, exponent); /* calls form */
}

void lab_num_text(struct lab_num v, char text[LAB_TEXT_SIZE])
{
    put_number(v, 6, text);
}

void lab_length_text(uint32_t lsbs, char text[LAB_TEXT_SIZE])
{
    put_number(lab_num_scaled(lsbs, -16), DIGITS_MAX, text);
}

void lab_u32_text(uint32_t v, char text[LAB_TEXT_SIZE])
{
    int digits = 1;
    for (uint32_t rest = v; rest >= 10; rest /= 10) {
        digits++;
    }
    *put_digits(text, v, digits) = '\0';
}

void lab_fx_text(fx_t v, char text[LAB_TEXT_SIZE])
{
    const uint32_t part = (uint32_t)v & 0xffff;
    lab_u32_text((uint32_t)v >> 16, text);
    if (part == 0) {
        return;
    }
    uint32_t scale = 1, decimal;
    int digits = 0;
    do { /* five digits are always enough */
        scale *= 10;
        digits++;
        decimal = (uint32_t)(((uint64_t)part * scale + 32768) >> 16);
    } while ((((uint64_t)decimal << 16) + scale / 2) / scale != part);
    char *to = text;
    while (*to != '\0') {
        to++;
    }
    *to++ = '.';
    *put_digits(to, decimal, digits) = '\0';
}
