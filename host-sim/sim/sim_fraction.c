/* See sim_fraction.h. */
#include "sim_fraction.h"

#include <stdbool.h>

struct sim_fraction sim_fraction_reduced(sim_wide over, sim_wide under)
{
    sim_wide a = over < 0 ? -over : over, b = under < 0 ? -under : under;
    while (b != 0) {
        const sim_wide rest = a % b;
        a = b, b = rest;
    }
    const sim_wide by = under < 0 ? -a : a;
    return by == 0 ? (struct sim_fraction){0, 1} : (struct sim_fraction){over / by, under / by};
}

struct sim_fraction sim_fraction_of(int32_t value, int bits)
{
    return sim_fraction_reduced(value, (sim_wide)1 << bits);
}

struct sim_fraction sim_fraction_add(struct sim_fraction a, struct sim_fraction b)
{
    const struct sim_fraction common = sim_fraction_reduced(a.under, b.under);
    return sim_fraction_reduced(a.over * common.under + b.over * common.over, a.under * common.under);
}

struct sim_fraction sim_fraction_times(struct sim_fraction a, struct sim_fraction b)
{
    const struct sim_fraction c = sim_fraction_reduced(a.over, b.under), d = sim_fraction_reduced(b.over, a.under);
    return sim_fraction_reduced(c.over * d.over, c.under * d.under);
}

struct sim_fraction sim_fraction_minus(struct sim_fraction a)
{
    return (struct sim_fraction){-a.over, a.under};
}

struct sim_fraction sim_fraction_divide(struct sim_fraction a, struct sim_fraction b)
{
    return sim_fraction_times(a, sim_fraction_reduced(b.under, b.over));
}

fx_t sim_fraction_code(struct sim_fraction a)
{
    const bool negative = a.over < 0;
    const sim_wide over = negative ? -a.over : a.over, whole = over / a.under, rest = over % a.under;
    const sim_wide code =
        whole > FX_MAX ? (sim_wide)FX_MAX + 1 : whole * FX_ONE + (rest * 2 * FX_ONE + a.under) / (2 * a.under);
    return negative ? (fx_t)(code > -(sim_wide)FX_MIN ? FX_MIN : -code) : (fx_t)(code > FX_MAX ? FX_MAX : code);
}

static void put_wide(FILE *file, sim_wide value)
{
    char digits[48];
    int at = (int)sizeof digits - 1;
    const bool negative = value < 0;
    digits[at] = '\0';
    do {
        digits[--at] = (char)('0' + (int)(negative ? -(value % 10) : value % 10));
        value /= 10;
    } while (value != 0);
    fprintf(file, "%s%s", negative ? "-" : "", digits + at);
}

static void put_value(FILE *file, long double value, fx_t code)
{
    fprintf(file, " %.12Lg %ld %+.3Lf\n", value, (long)code, (long double)code - value * FX_ONE);
}

void sim_fraction_print(FILE *file, const char *name, struct sim_fraction exact, fx_t code)
{
    fprintf(file, "%s ", name);
    put_wide(file, exact.over);
    if (exact.under != 1) {
        fputc('/', file);
        put_wide(file, exact.under);
    }
    put_value(file, (long double)exact.over / (long double)exact.under, code);
}

void sim_decimal_print(FILE *file, const char *name, long double value, fx_t code)
{
    fprintf(file, "%s -", name);
    put_value(file, value, code);
}
