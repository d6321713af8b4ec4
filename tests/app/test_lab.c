/* lab: which pairs are ordered wrongly, against all pairs of a list of codes; at which distances steps are looked at,
 * and the ideal ones against the formulas of lab.h in double precision. The test plays codes and searches. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "lab.h"
#include "lab_search.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static struct lab lab;
static uint64_t memory[8192];
static char text[16384];
static fx_t asked[64];
static uint32_t codes[64], calls;
static int probe_status;

/* ---- in place of probe and search --------------------------------------------------------------------------- */

int lab_probe_open(struct lab_probe *p, const struct lab_format *format, fx_t near_z, fx_t far_z)
{
    *p = (struct lab_probe){.format = format, .near_z = near_z, .far_z = far_z};
    return probe_status;
}

uint32_t lab_code(struct lab_probe *p, fx_t w)
{
    assert_true(w >= p->near_z && w <= p->far_z);
    asked[calls % 64] = w;
    return codes[calls++ % 64];
}

void lab_search_open(struct lab_search *s, struct lab_probe *p)
{
    assert_true(s != NULL && p->format != NULL);
}

uint32_t lab_search_at(struct lab_search *s, struct lab_probe *p, fx_t z)
{
    assert_true(s != NULL && p->format != NULL);
    asked[calls++ % 64] = z;
    return 300;
}

uint32_t lab_search_worst(struct lab_search *s, struct lab_probe *p)
{
    assert_true(s != NULL && p->format != NULL);
    return 700;
}

/* ---- the tests ---------------------------------------------------------------------------------------------- */

static void put(void *context, const char *part)
{
    assert_ptr_equal(context, text);
    assert_true(strlen(text) + strlen(part) < sizeof text);
    strcat(text, part);
}

static int fresh(void **state)
{
    (void)state;
    lab = (struct lab){.near_z = 100,
                       .far_z = 116,
                       .formats = 1,
                       .count = 16,
                       .memory = memory,
                       .memory_bytes = sizeof memory,
                       .put = put,
                       .context = text};
    text[0] = '\0';
    calls = 0;
    probe_status = 0;
    return 0;
}

static uint32_t row_of(const char *name, int bits)
{
    uint32_t i = 0;
    while (strcmp(lab_formats[i].name, name) != 0 || lab_formats[i].bits != bits) {
        i++;
    }
    return i;
}

/* Cell `column` of line `row`, 0 the header. */
static const char *cell(int row, int column)
{
    static char cells[2][40];
    static int next;
    const char *at = text;
    for (; row > 0; row--) {
        at = strchr(at, '\n') + 1;
    }
    for (; column > 0; column--) {
        at = strchr(at, ',') + 1;
    }
    char *const is = cells[next++ % 2];
    snprintf(is, sizeof cells[0], "%.*s", (int)strcspn(at, ",\n"), at);
    return is;
}

static void pairs_are_counted_as_all_pairs_are(void **state)
{
    uint32_t random = 1;
    (void)state;
    for (int list = 0; list < 60; list++) {
        uint32_t equal = 0, swap = 0, widest = 0;
        fresh(NULL);
        for (uint32_t i = 0; i <= 16; i++) { /* they fall, more or less */
            random = random * 1664525u + 1013904223u;
            codes[i] =
                list < 6 ? 100 - i / (1 + (uint32_t)list) : 200 - 4 * i + (random >> 16) % (1 + (uint32_t)list / 2);
        }
        for (uint32_t i = 0; i <= 16; i++) {
            equal += i > 0 && codes[i] == codes[i - 1];
            swap += i > 0 && codes[i] > codes[i - 1];
            for (uint32_t j = i + 1; j <= 16; j++) {
                widest = codes[j] >= codes[i] && j - i > widest ? j - i : widest;
            }
        }
        assert_int_equal(lab_pairs(&lab), 0);
        assert_int_equal(calls, 17);
        assert_int_equal(strtol(cell(1, 6), NULL, 10), equal);
        assert_int_equal(strtol(cell(1, 7), NULL, 10), swap);
        assert_true(fabs(strtod(cell(1, 8), NULL) * 65536 - widest) < .01);
    }
}

static void distances_are_evenly_spread(void **state)
{
    (void)state;
    lab.far_z = 131;
    lab.count = 10;
    assert_int_equal(lab_pairs(&lab), 0);
    for (uint32_t i = 0; i <= 10; i++) {
        assert_int_equal(asked[i], 100 + (int)floor(3.1 * i + .5));
    }
    assert_string_equal(cell(1, 4), "linear");
    assert_string_equal(cell(1, 5), "10");
    fresh(NULL);
    lab.near_z = FX_ONE, lab.far_z = FX_INT(16), lab.count = 12;
    lab.spacing = LAB_LOG_SPACED;
    assert_int_equal(lab_pairs(&lab), 0);
    for (uint32_t i = 0; i <= 12; i++) { /* powers of two exactly, others upwards */
        const double ideal = exp2(16 + i / 3.);
        assert_true(i % 3 == 0 ? asked[i] == (fx_t)lround(ideal) : asked[i] == (fx_t)ceil(ideal));
    }
    assert_string_equal(cell(1, 4), "log");
}

static void steps_are_looked_at_in_each_decade(void **state)
{
    static const char *const cells[] = {"0.0006", "0.001", "0.002", "0.005", "0.01", "0.02", "0.03", "S_worst"};
    (void)state;
    lab.near_z = 39, lab.far_z = 1966;
    assert_int_equal(lab_resolve(&lab), 0);
    assert_ptr_equal(strstr(text, "format,bits,near,far,z_m,ideal_m,measured_m,ratio\nfixed16,16,"), text);
    for (int i = 0; i < 8; i++) {
        assert_string_equal(cell(i + 1, 4), cells[i]);
    }
    assert_int_equal(asked[1], 66);
    assert_int_equal(calls, 7);
    const fx_t at[2] = {50, 1966};
    fresh(NULL);
    lab.near_z = 50, lab.far_z = 1966, lab.at = at, lab.at_count = 2, lab.formats = 5;
    assert_int_equal(lab_resolve(&lab), 0);
    assert_true(calls == 4 && asked[0] == 50 && asked[1] == 1966 && asked[2] == 50);
    assert_string_equal(cell(4, 0), "fixed24");
    fresh(NULL);
    lab.near_z = FX_INT(9000), lab.far_z = FX_INT(20000);
    assert_int_equal(lab_resolve(&lab), 0);
    assert_true(calls == 3 && asked[1] == FX_INT(10000) && asked[2] == FX_INT(20000)); /* once */
}

/* The step at z in LSBs. */
static double ideal(const struct lab_format *f, double n, double far, double z)
{
    const double most = exp2(f->bits) - 1;
    const int exponent = lab_exponent(f, (fx_t)n, (fx_t)far);
    if (f->kind == LAB_LOG) {
        return z * log(far / n) / most;
    }
    if (f->kind == LAB_LINEAR || (f->kind == LAB_DRAWN && f->format->coding == PH_DEPTH_IS_LINEAR)) {
        return (far - n) / most;
    }
    if (exponent == 0) {
        return z * z * (far - n) / (far * n * most);
    }
    const bool drawn = f->kind == LAB_DRAWN; /* others hold n/w, without head room */
    const double head = !drawn ? n : n * (1 - (exponent > 4 ? exp2(exponent - 13) : 1 / 512.));
    const double d = head / z - (drawn ? head / far : 0), octave = fmin(floor(-log2(d)), (1 << exponent) - 2);
    return z * z / head * exp2(-(f->bits - exponent + 1 + octave));
}

static void is_near(const char *number, double want, double part)
{
    if (!(fabs(strtod(number, NULL) - want) <= part * want)) {
        fail_msg("%s, not %.9g:\n%s", number, want, text);
    }
}

static void ideal_steps_are_those_of_the_formulas(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < lab_format_count; i++) {
        const double n = 6554, far = 1966080;
        static const fx_t at[] = {6600, 20000, 65536, 300000, 1900000};
        fresh(NULL);
        lab.near_z = (fx_t)n, lab.far_z = (fx_t)far, lab.formats = 1u << i, lab.at = at, lab.at_count = 5;
        assert_int_equal(lab_resolve(&lab), 0);
        for (int k = 0; k < 5; k++) {
            const double want = ideal(&lab_formats[i], n, far, at[k]);
            is_near(cell(1 + k, 5), want / 65536, 6e-6);
            is_near(cell(1 + k, 6), 300 / 65536., 1e-5);
            is_near(cell(1 + k, 7), 300 / want, 6e-6);
        }
    }
}

/* No distance has a larger step, and one comes close. */
static void worst_ideal_step_is_the_largest_of_all_distances(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < lab_format_count; i++) {
        double worst = 0;
        fresh(NULL);
        lab.near_z = 3000, lab.far_z = 30000, lab.formats = 1u << i;
        for (fx_t z = lab.near_z; z <= lab.far_z; z++) {
            worst = fmax(worst, ideal(&lab_formats[i], lab.near_z, lab.far_z, z == lab.far_z ? z - .001 : z));
        }
        const fx_t at = lab.near_z;
        lab.at = &at, lab.at_count = 1;
        assert_int_equal(lab_resolve(&lab), 0);
        is_near(cell(2, 5), worst / 65536, 1e-3);
        assert_string_equal(cell(2, 4), "S_worst");
        is_near(cell(2, 6), 700 / 65536., 1e-5);
    }
}

static void what_is_impossible_is_refused_before_a_word(void **state)
{
    const fx_t outside[2] = {99, 117};
    (void)state;
    for (int i = 0; i < 7; i++) {
        fresh(NULL);
        lab.near_z = i == 0 ? 0 : i == 1 ? 116 : 100;
        lab.count = i == 2 ? 0 : i == 3 ? LAB_COUNT_MAX + 1 : 16;
        lab.memory_bytes = i == 4 ? lab_bytes(&lab) - 1 : lab_bytes(&lab);
        lab.at = i < 5 ? NULL : &outside[i - 5];
        lab.at_count = 1;
        assert_int_equal(lab_resolve(&lab), i == 4 ? PH_ERR_NOMEM : PH_ERR_INVAL);
        assert_int_equal(i < 5 ? lab_pairs(&lab) : PH_ERR_INVAL, i == 4 ? PH_ERR_NOMEM : PH_ERR_INVAL);
        assert_string_equal(text, "");
    }
    fresh(NULL);
    lab.memory_bytes = lab_bytes(&lab);
    assert_int_equal(lab_pairs(&lab), 0);
    probe_status = PH_ERR_INVAL;
    assert_int_equal(lab_pairs(&lab), PH_ERR_INVAL);
    lab.formats = 1u << row_of("log", 24);
    probe_status = 0;
    text[0] = '\0';
    assert_int_equal(lab_pairs(&lab), 0);
    assert_ptr_equal(strstr(text, "format,bits,near,far,spacing,count,equal,swap,max_wrong_m\nlog,24,"), text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(pairs_are_counted_as_all_pairs_are, fresh),
        cmocka_unit_test_setup(distances_are_evenly_spread, fresh),
        cmocka_unit_test_setup(steps_are_looked_at_in_each_decade, fresh),
        cmocka_unit_test_setup(ideal_steps_are_those_of_the_formulas, fresh),
        cmocka_unit_test_setup(worst_ideal_step_is_the_largest_of_all_distances, fresh),
        cmocka_unit_test_setup(what_is_impossible_is_refused_before_a_word, fresh),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
