/* lab_search: against all pairs of distances, one by one, for codes that the test plays: those that fall in steps, and
 * those that rise at times. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "lab_search.h"

enum { NEAR = 1000, MOST = 3000 };

static uint32_t codes[MOST];
static struct lab_probe probe;
static struct lab_search search;
static const struct lab_format monotone = {.name = "falls", .kind = LAB_LINEAR, .bits = 24},
                               other = {.name = "rises", .kind = LAB_NDC_Q16, .bits = 24};

/* In place of lab_probe.c. */
uint32_t lab_code(struct lab_probe *p, fx_t w)
{
    assert_in_range(w, p->near_z, p->far_z);
    return codes[w - NEAR];
}

static uint32_t seed = 1;

static uint32_t random_below(uint32_t n)
{
    seed = seed * 1664525 + 1013904223;
    return (uint32_t)((uint64_t)seed * n >> 32);
}

static void open_range(const struct lab_format *format, uint32_t n)
{
    probe = (struct lab_probe){.format = format, .near_z = NEAR, .far_z = NEAR + (fx_t)n - 1};
    lab_search_open(&search, &probe);
}

/* Codes that fall by 1 after plateaus of up to `longest`, and one of `special` somewhere. */
static void make_plateaus(uint32_t n, uint32_t longest, uint32_t special)
{
    const uint32_t at = random_below(n);
    uint32_t code = 1 << 20;
    for (uint32_t i = 0; i < n;) {
        const uint32_t length = i <= at && at < i + longest ? special : 1 + random_below(longest);
        for (uint32_t k = 0; k < length && i < n; k++, i++) {
            codes[i] = code;
        }
        code--;
    }
}

/* The plateau around i by going from place to place. */
static uint32_t plateau_around(uint32_t i, uint32_t n)
{
    uint32_t first = i, last = i;
    while (first > 0 && codes[first - 1] == codes[i]) {
        first--;
    }
    while (last + 1 < n && codes[last + 1] == codes[i]) {
        last++;
    }
    return last - first + 1;
}

static void the_longest_plateau_is_found(void **state)
{
    (void)state;
    for (int run = 0; run < 400; run++) {
        const uint32_t n = 2 + random_below(MOST - 1), longest = 1 + random_below(40);
        make_plateaus(n, longest, 1 + random_below(3 * longest));
        open_range(&monotone, n);
        uint32_t most = 0;
        for (uint32_t i = 0; i < n; i++) {
            const uint32_t length = plateau_around(i, n);
            most = length > most ? length : most;
        }
        assert_int_equal(lab_search_worst(&search, &probe), most);
    }
}

/* A plateau that the near or the far plane cuts counts as long as its neighbour, if that is longer. */
static void the_plateau_of_a_distance_is_found(void **state)
{
    (void)state;
    for (int run = 0; run < 100; run++) {
        const uint32_t n = 2 + random_below(500);
        make_plateaus(n, 1 + random_below(40), 1 + random_below(90));
        open_range(&monotone, n);
        for (uint32_t i = 0; i < n; i++) {
            uint32_t expected = plateau_around(i, n);
            if (codes[i] == codes[n - 1] && codes[0] != codes[i]) {
                const uint32_t beside = plateau_around(n - expected - 1, n);
                expected = beside > expected ? beside : expected;
            } else if (codes[i] == codes[0] && codes[n - 1] != codes[i]) {
                const uint32_t beside = plateau_around(expected, n);
                expected = beside > expected ? beside : expected;
            }
            assert_int_equal(lab_search_at(&search, &probe, NEAR + (fx_t)i), expected);
        }
    }
}

/* The largest j - i with i <= z <= j that is ordered wrongly, plus one; z < 0: over all. */
static uint32_t all_pairs(uint32_t n, int32_t z)
{
    uint32_t most = 0;
    for (uint32_t i = 0; i < n && (z < 0 || i <= (uint32_t)z); i++) {
        for (uint32_t j = z > (int32_t)i ? (uint32_t)z : i + 1; j < n; j++) {
            most = codes[j] >= codes[i] && j > i && j - i > most ? j - i : most;
        }
    }
    return most + 1;
}

static void wrong_pairs_are_found_where_codes_rise(void **state)
{
    (void)state;
    for (int run = 0; run < 60; run++) {
        const uint32_t n = 2 + random_below(run < 40 ? 300 : MOST - 1), noise = 1 + random_below(60);
        for (uint32_t i = 0; i < n; i++) {
            codes[i] = 100000 - 3 * i + random_below(noise);
        }
        codes[random_below(n)] += random_below(2000);
        open_range(&other, n);
        assert_int_equal(lab_search_worst(&search, &probe), all_pairs(n, -1));
        for (int k = 0; k < 10; k++) {
            const uint32_t z = random_below(n);
            assert_int_equal(lab_search_at(&search, &probe, NEAR + (fx_t)z), all_pairs(n, (int32_t)z));
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_longest_plateau_is_found),
        cmocka_unit_test(the_plateau_of_a_distance_is_found),
        cmocka_unit_test(wrong_pairs_are_found_where_codes_rise),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
