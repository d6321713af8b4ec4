/* See sim_fraction.h. */
#include "sim_fraction.h"
#include "lab_num.h"

#include <math.h>

/* ---- 128 bits ---- */

static struct sim_wide wide_of(uint64_t value)
{
    return (struct sim_wide){0, value};
}

static bool is_zero(struct sim_wide a)
{
    return (a.high | a.low) == 0;
}

static bool is_below(struct sim_wide a, struct sim_wide b)
{
    return a.high != b.high ? a.high < b.high : a.low < b.low;
}

static struct sim_wide plus(struct sim_wide a, struct sim_wide b)
{
    const uint64_t low = a.low + b.low;
    return (struct sim_wide){a.high + b.high + (low < a.low), low};
}

static struct sim_wide minus(struct sim_wide a, struct sim_wide b)
{
    return (struct sim_wide){a.high - b.high - (a.low < b.low), a.low - b.low};
}

static struct sim_wide times(struct sim_wide a, struct sim_wide b)
{
    return (struct sim_wide){lab_mulhi_u64(a.low, b.low) + a.high * b.low + a.low * b.high, a.low * b.low};
}

/* Shifts to the left, or, below 0, to the right. n: -127 .. 127. */
static struct sim_wide shifted(struct sim_wide a, int n)
{
    if (n >= 64) {
        return (struct sim_wide){a.low << (n - 64), 0};
    }
    if (n <= -64) {
        return (struct sim_wide){0, a.high >> (-n - 64)};
    }
    return n == 0  ? a
           : n > 0 ? (struct sim_wide){a.high << n | a.low >> (64 - n), a.low << n}
                   : (struct sim_wide){a.high >> -n, a.low >> -n | a.high << (64 + n)};
}

/* The number of bits that a takes. */
static int bits_of(struct sim_wide a)
{
    return a.high != 0 ? 128 - __builtin_clzll(a.high) : a.low != 0 ? 64 - __builtin_clzll(a.low) : 0;
}

/* a / b, bit by bit; *rest becomes what is left. b is not 0. */
static struct sim_wide divided(struct sim_wide a, struct sim_wide b, struct sim_wide *rest)
{
    struct sim_wide quotient = wide_of(0);
    for (int n = bits_of(a) - bits_of(b); n >= 0; n--) {
        const struct sim_wide part = shifted(b, n);
        if (!is_below(a, part)) {
            a = minus(a, part);
            quotient = plus(quotient, shifted(wide_of(1), n));
        }
    }
    *rest = a;
    return quotient;
}

/* Takes the zeros at the end off; a is not 0. Returns how many there were. */
static int odd_part(struct sim_wide *a)
{
    const int n = a->low != 0 ? __builtin_ctzll(a->low) : 64 + __builtin_ctzll(a->high);
    *a = shifted(*a, -n);
    return n;
}

/* The largest number that divides both (J. Stein's way); the other one if one is 0. */
static struct sim_wide common_divisor(struct sim_wide a, struct sim_wide b)
{
    if (is_zero(a) || is_zero(b)) {
        return is_zero(a) ? b : a;
    }
    const int of_a = odd_part(&a), of_b = odd_part(&b);
    while (is_below(a, b) || is_below(b, a)) {
        if (is_below(a, b)) {
            const struct sim_wide swapped = a;
            a = b;
            b = swapped;
        }
        a = minus(a, b);
        odd_part(&a);
    }
    return shifted(a, of_a < of_b ? of_a : of_b);
}

static long double real_of(struct sim_wide a)
{
    return ldexpl((long double)a.high, 64) + (long double)a.low;
}

/* ---- fractions ---- */

/* over / under in lowest terms; 0 / 0 is 0. */
static struct sim_fraction reduced(bool is_negative, struct sim_wide over, struct sim_wide under)
{
    const struct sim_wide by = common_divisor(over, under);
    struct sim_wide rest;
    if (is_zero(by)) {
        return (struct sim_fraction){over, wide_of(1), false};
    }
    return (struct sim_fraction){divided(over, by, &rest), divided(under, by, &rest), is_negative && !is_zero(over)};
}

struct sim_fraction sim_fraction_of(int32_t value, int bits)
{
    const uint64_t size = value < 0 ? 0 - (uint64_t)value : (uint64_t)value;
    return reduced(value < 0, wide_of(size), wide_of((uint64_t)1 << bits));
}

struct sim_fraction sim_fraction_add(struct sim_fraction a, struct sim_fraction b)
{
    const struct sim_fraction common = reduced(false, a.under, b.under);
    const struct sim_wide left = times(a.over, common.under), right = times(b.over, common.over),
                          under = times(a.under, common.under);
    if (a.is_negative == b.is_negative) {
        return reduced(a.is_negative, plus(left, right), under);
    }
    return is_below(left, right) ? reduced(b.is_negative, minus(right, left), under)
                                 : reduced(a.is_negative, minus(left, right), under);
}

struct sim_fraction sim_fraction_times(struct sim_fraction a, struct sim_fraction b)
{
    const struct sim_fraction c = reduced(false, a.over, b.under), d = reduced(false, b.over, a.under);
    return reduced(a.is_negative != b.is_negative, times(c.over, d.over), times(c.under, d.under));
}

struct sim_fraction sim_fraction_minus(struct sim_fraction a)
{
    return (struct sim_fraction){a.over, a.under, !a.is_negative && !is_zero(a.over)};
}

struct sim_fraction sim_fraction_divide(struct sim_fraction a, struct sim_fraction b)
{
    return sim_fraction_times(a, (struct sim_fraction){b.under, b.over, b.is_negative});
}

bool sim_fraction_is_0(struct sim_fraction a)
{
    return is_zero(a.over);
}

fx_t sim_fraction_code(struct sim_fraction a)
{
    struct sim_wide rest, unused;
    const struct sim_wide whole = divided(a.over, a.under, &rest), twice = shifted(rest, 17);
    const struct sim_wide steps = divided(plus(twice, a.under), shifted(a.under, 1), &unused);
    const uint64_t most = (uint64_t)FX_MAX + a.is_negative;
    const uint64_t code = whole.high != 0 || whole.low > FX_MAX ? most : whole.low * FX_ONE + steps.low;
    const int64_t held = (int64_t)(code < most ? code : most);
    return (fx_t)(a.is_negative ? -held : held);
}

static void put_wide(FILE *file, struct sim_wide value)
{
    char digits[48];
    int at = (int)sizeof digits - 1;
    digits[at] = '\0';
    do {
        struct sim_wide digit;
        value = divided(value, wide_of(10), &digit);
        digits[--at] = (char)('0' + (int)digit.low);
    } while (!is_zero(value));
    fputs(digits + at, file);
}

static void put_value(FILE *file, long double value, fx_t code)
{
    fprintf(file, " %.12Lg %ld %+.3Lf\n", value, (long)code, (long double)code - value * FX_ONE);
}

long double sim_fraction_real(struct sim_fraction a)
{
    const long double size = real_of(a.over) / real_of(a.under);
    return a.is_negative ? -size : size;
}

void sim_fraction_print(FILE *file, const char *name, struct sim_fraction exact, fx_t code)
{
    fprintf(file, "%s %s", name, exact.is_negative ? "-" : "");
    put_wide(file, exact.over);
    if (exact.under.high != 0 || exact.under.low != 1) {
        fputc('/', file);
        put_wide(file, exact.under);
    }
    put_value(file, sim_fraction_real(exact), code);
}

void sim_decimal_print(FILE *file, const char *name, long double value, fx_t code)
{
    fprintf(file, "%s -", name);
    put_value(file, value, code);
}
