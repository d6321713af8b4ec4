/* model_texture: sides become powers of two, and each texel of each level is the mean of the pixels under it, found
 * here by going through the pixels of a small picture one by one. */
#include "model_texture.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static uint8_t memory[1 << 16];

/* Draws a picture of noise. */
static struct ppm noise(uint32_t width, uint32_t height)
{
    static uint8_t rgb[3 * 70000];
    uint32_t random = 1;
    for (size_t i = 0; i < 3 * (size_t)width * height; i++) {
        random = random * 1664525 + 1013904223;
        rgb[i] = (uint8_t)(random >> 24);
    }
    return (struct ppm){.width = width, .height = height, .rgb = rgb};
}

/* Whether pixel i of n lies under texel k of `size`: the texel's share is k n / size <= i < (k + 1) n / size, rounded
 * down; where that is nothing, its first pixel. */
static bool is_under(uint32_t i, uint32_t n, uint32_t k, uint32_t size)
{
    const uint32_t first = k * n / size, behind = (k + 1) * n / size;
    return i == first || (i > first && i < behind);
}

/* The wire's two bytes of a texel: means rounded down, then to the nearest of 31, 63 and 31. */
static void check_texel(const struct ppm *p, const uint32_t texel[2], const uint32_t size[2], uint16_t is)
{
    uint32_t sum[3] = {0, 0, 0}, n = 0, q[3];
    for (uint32_t i = 0; i < p->width * p->height; i++) {
        if (is_under(i % p->width, p->width, texel[0], size[0]) &&
            is_under(i / p->width, p->height, texel[1], size[1])) {
            n++;
            for (int c = 0; c < 3; c++) {
                sum[c] += p->rgb[3 * i + (uint32_t)c];
            }
        }
    }
    for (int c = 0; c < 3; c++) {
        q[c] = (uint32_t)((double)(sum[c] / n) * (c == 1 ? 63 : 31) / 255 + .4999);
    }
    const uint8_t wire[2] = {(uint8_t)(q[0] << 3 | q[1] >> 3), (uint8_t)(q[1] << 5 | q[2])};
    assert_memory_equal(wire, &is, 2);
}

static void each_texel_of_each_level_is_a_mean(void **state)
{
    static const struct {
        uint32_t size[2];
        uint8_t log2[2];
    } cases[] = {{{1, 1}, {0, 0}},  {{2, 2}, {1, 1}},  {{3, 2}, {2, 1}},
                 {{5, 17}, {3, 5}}, {{16, 1}, {4, 0}}, {{9, 4}, {4, 2}}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const uint32_t side = cases[i].log2[0] > cases[i].log2[1] ? cases[i].log2[0] : cases[i].log2[1];
        const struct ppm picture = noise(cases[i].size[0], cases[i].size[1]);
        struct demo_arena arena = {.base = memory, .size = sizeof memory};
        struct ph_texture t;
        assert_int_equal(model_texture_make(&arena, &picture, &t), 0);
        assert_true(t.log2_width == cases[i].log2[0] && t.log2_height == cases[i].log2[1] && t.levels == side);
        assert_true(t.wrap == PH_WRAP_REPEAT && t.filter == PH_FILTER_NEAREST);
        const uint16_t *texel = t.texels;
        for (uint32_t level = 0; level <= side; level++) {
            const uint32_t size[2] = {1U << t.log2_width >> level > 0 ? 1U << t.log2_width >> level : 1,
                                      1U << t.log2_height >> level > 0 ? 1U << t.log2_height >> level : 1};
            for (uint32_t k = 0; k < size[0] * size[1]; k++) {
                check_texel(&picture, (uint32_t[2]){k % size[0], k / size[0]}, size, *texel++);
            }
            assert_int_equal(model_texture_texels(&t, (uint8_t)level), texel - t.texels);
        }
    }
}

static void a_side_has_at_most_1024_texels(void **state)
{
    uint8_t *const large = malloc(1 << 17);
    struct demo_arena arena = {.base = large, .size = 1 << 17};
    struct ppm picture = noise(3000, 3);
    struct ph_texture t;
    (void)state;
    assert_non_null(large);
    assert_int_equal(model_texture_make(&arena, &picture, &t), 0);
    assert_true(t.log2_width == 10 && t.log2_height == 2 && t.levels == 10);
    for (uint32_t k = 0; k < 4096; k += 97) {
        check_texel(&picture, (uint32_t[2]){k % 1024, k / 1024}, (const uint32_t[2]){1024, 4}, t.texels[k]);
    }
    free(large);
}

/* 4x2 texels and the levels 2x1 and 1x1 are 8 + 2 + 1 of two bytes each. */
static void the_arena_has_exactly_what_it_takes(void **state)
{
    const struct ppm picture = noise(4, 2);
    struct demo_arena arena = {.base = memory, .size = 21};
    struct ph_texture t;
    (void)state;
    assert_int_equal(model_texture_make(&arena, &picture, &t), PH_ERR_NOMEM);
    arena = (struct demo_arena){.base = memory, .size = 24};
    assert_int_equal(model_texture_make(&arena, &picture, &t), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_texel_of_each_level_is_a_mean),
        cmocka_unit_test(a_side_has_at_most_1024_texels),
        cmocka_unit_test(the_arena_has_exactly_what_it_takes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
