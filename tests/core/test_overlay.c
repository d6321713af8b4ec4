/* The overlay: its letters as ASCII pictures, outlines, clipping at the edges, bands, and the text of statistics. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "overlay.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#define WIDTH  40
#define HEIGHT 24
#define INK    0x1234
#define EDGE   0x4321
#define PAPER  0x5555

static void draw(uint16_t *pixels, int band_height, int x, int y, const char *text, uint8_t scale)
{
    const struct ph_overlay_style style = {INK, EDGE, scale};
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        pixels[i] = PAPER;
    }
    for (int y0 = 0; y0 < HEIGHT; y0 += band_height) {
        const struct ph_overlay_band band = {pixels + y0 * WIDTH, WIDTH, y0,
                                             y0 + band_height < HEIGHT ? band_height : HEIGHT - y0};
        ph_overlay_text(&band, x, y, text, &style);
    }
}

static char letter_of(uint16_t pixel)
{
    return pixel == INK ? '#' : pixel == EDGE ? 'o' : pixel == PAPER ? '.' : '?';
}

static void expect(const uint16_t *pixels, const char *const *rows, int count)
{
    for (int y = 0; y < count; y++) {
        for (int x = 0; rows[y][x] != '\0'; x++) {
            if (letter_of(pixels[y * WIDTH + x]) != rows[y][x]) {
                fail_msg("(%d, %d): %c instead of %c", x, y, letter_of(pixels[y * WIDTH + x]), rows[y][x]);
            }
        }
    }
}

static void letters_have_a_dark_outline(void **state)
{
    static const char *const rows[] = {"..ooo....", ".oo#oo...", "oo#o#oo..", "o#ooo#o..", "o#ooo#o..",
                                       "o#####o..", "o#ooo#o..", "o#o.o#o..", "ooo.ooo..", "........."};
    uint16_t pixels[WIDTH * HEIGHT];
    (void)state;
    draw(pixels, HEIGHT, 1, 1, "A", 1);
    expect(pixels, rows, 10);
}

/* In the letters' own pixels, by another way: an outline pixel has ink next to it, a paper pixel has none. */
static void outline_is_one_pixel_wide_at_every_scale(void **state)
{
    uint16_t pixels[WIDTH * HEIGHT];
    (void)state;
    for (uint8_t scale = 1; scale <= 3; scale++) {
        draw(pixels, HEIGHT, 2, 2, scale == 1 ? "W4%?q" : "R!", scale);
        int ink = 0;
        for (int y = 1; y < HEIGHT - 1; y++) {
            for (int x = 1; x < WIDTH - 1; x++) {
                bool near = false;
                for (int i = 0; i < 9; i++) {
                    near |= pixels[(y + i / 3 - 1) * WIDTH + x + i % 3 - 1] == INK;
                }
                const uint16_t pixel = pixels[y * WIDTH + x];
                ink += pixel == INK;
                assert_true(pixel == INK || pixel == (near ? EDGE : PAPER));
            }
        }
        assert_true(ink > 20);
    }
}

static void larger_scales_are_the_same_letters(void **state)
{
    uint16_t one[WIDTH * HEIGHT], two[WIDTH * HEIGHT];
    (void)state;
    draw(one, HEIGHT, 0, 0, "K8:", 1);
    draw(two, HEIGHT, 0, 0, "K8:", 2);
    for (int y = 0; y < 14; y++) {
        for (int x = 0; x < 36; x++) {
            assert_int_equal(two[y * WIDTH + x] == INK, one[y / 2 * WIDTH + x / 2] == INK);
        }
    }
}

static void text_does_not_depend_on_the_band_height(void **state)
{
    uint16_t whole[WIDTH * HEIGHT], banded[WIDTH * HEIGHT];
    (void)state;
    for (int y = -10; y < HEIGHT + 2; y++) {
        draw(whole, HEIGHT, 3, y, "9.7 MS", 2);
        for (int lines = 1; lines <= 7; lines += 3) {
            draw(banded, lines, 3, y, "9.7 MS", 2);
            assert_memory_equal(whole, banded, sizeof(whole));
        }
    }
}

/* Letter by letter off each side: what is left is the part of the picture that a larger one shows. */
static void text_is_cut_at_the_picture(void **state)
{
    uint16_t middle[WIDTH * HEIGHT], cut[WIDTH * HEIGHT];
    (void)state;
    draw(middle, HEIGHT, 10, 8, "X", 1);
    for (int dx = -20; dx <= 40; dx++) {
        draw(cut, HEIGHT, 10 + dx, 8, "X", 1);
        for (int i = 0; i < WIDTH * HEIGHT; i++) {
            const int from = i % WIDTH - dx;
            const uint16_t want = from < 0 || from >= WIDTH ? PAPER : middle[i / WIDTH * WIDTH + from];
            assert_int_equal(cut[i], want);
        }
    }
    draw(cut, HEIGHT, INT32_MAX, INT32_MIN, "X", 1);
    draw(cut, HEIGHT, 0, 0, "", 1);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        assert_int_equal(cut[i], PAPER);
    }
}

static void letters_all_differ(void **state)
{
    static const char letters[] = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZ!%'()*+,-./:<=>?~ ";
    static uint16_t pictures[sizeof(letters)][WIDTH * HEIGHT];
    (void)state;
    for (size_t i = 0; letters[i] != '\0'; i++) {
        const char text[2] = {letters[i], '\0'};
        draw(pictures[i], HEIGHT, 1, 1, text, 1);
        for (size_t k = 0; k < i; k++) {
            assert_memory_not_equal(pictures[i], pictures[k], sizeof(pictures[i]));
        }
        for (int y = 0; y < 8; y++) { /* the gap to the next letter */
            assert_int_not_equal(pictures[i][(y + 1) * WIDTH + 6], INK);
        }
    }
    draw(pictures[0], HEIGHT, 1, 1, "tri", 1);
    draw(pictures[1], HEIGHT, 1, 1, "TRI", 1);
    assert_memory_equal(pictures[0], pictures[1], sizeof(pictures[0]));
    draw(pictures[0], HEIGHT, 1, 1, "\x80~", 1); /* boxes, whatever the sign of char */
    draw(pictures[1], HEIGHT, 1, 1, "~\xff", 1);
    assert_memory_equal(pictures[0], pictures[1], sizeof(pictures[0]));
}

static void statistics_are_rounded_to_a_tenth(void **state)
{
    static const uint32_t cases[][2] = {{0, 0},        {49, 7},     {50, 1},       {16660, 1152},
                                        {99949, 9999}, {99950, 10}, {1000000, 42}, {UINT32_MAX, UINT32_MAX}};
    (void)state;
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        char text[PH_OVERLAY_STATS_SIZE], want[64];
        const unsigned long long tenths = (cases[i][0] + 50ull) / 100;
        snprintf(want, sizeof(want), "%llu.%llu MS %lu TRI", tenths / 10, tenths % 10, (unsigned long)cases[i][1]);
        assert_int_equal(ph_overlay_stats(text, cases[i][0], cases[i][1]), strlen(want));
        assert_string_equal(text, want);
    }
    assert_int_equal(ph_overlay_width("16.7 MS", 2), 84);
    assert_int_equal(ph_overlay_width("", 2), 0);
}

/* Draws proportional text in INK without an outline, and compares it with a picture. */
static void assert_text(const char *text, const char *const *picture, int lines)
{
    const struct ph_overlay_style style = {INK, INK, 1};
    const int width = (int)strlen(picture[0]);
    for (int band_height = 1; band_height <= HEIGHT; band_height += HEIGHT - 1) {
        static uint16_t pixels[WIDTH * HEIGHT];
        for (int i = 0; i < WIDTH * HEIGHT; i++) {
            pixels[i] = PAPER;
        }
        for (int y0 = 0; y0 < HEIGHT; y0 += band_height) {
            const struct ph_overlay_band band = {pixels + y0 * WIDTH, WIDTH, y0, band_height};
            ph_text(&band, 1, 2, text, &style);
        }
        for (int i = 0; i < WIDTH * HEIGHT; i++) {
            const int x = i % WIDTH - 1, y = i / WIDTH - 2;
            const bool inside = x >= 0 && x < width && y >= 0 && y < lines;
            assert_int_equal(pixels[i], inside && picture[y][x] == '#' ? INK : PAPER);
        }
    }
    assert_int_equal(ph_text_width(text, 1), width);
    assert_int_equal(ph_text_width(text, 3), 3 * width);
}

static void proportional_letters_are_as_wide_as_they_are_drawn(void **state)
{
    (void)state;
    static const char *const il[] = {"#.#.", "..#.", "#.#.", "#.#.", "#.#.", "#.#.", "#..#"};
    static const char *const gap[] = {"#....#", "......", "#....#", "#....#", "#....#", "#....#", "#....#"};
    static const char *const jy[] = {".#......", "........", ".#.#...#", ".#.#...#",
                                     ".#.#...#", ".#..####", ".#.....#", "#...###."};
    assert_text("il", il, 7);
    assert_text("i i", gap, 7);
    assert_text("jy", jy, 8);
    assert_int_equal(ph_text_width("", 1), 0);
    assert_int_equal(ph_text_width("1", 1), ph_text_width("0", 1));
    assert_true(ph_text_width("\x80", 1) == 5); /* a box */
}

static void numbers_are_written_without_printf(void **state)
{
    (void)state;
    static const int32_t values[] = {0, 7, -1, 10, 65535, -40960, 2147483647, -2147483647 - 1};
    for (unsigned i = 0; i < sizeof values / sizeof values[0]; i++) {
        char text[PH_TEXT_NUMBER_SIZE], expected[16];
        const int length = snprintf(expected, sizeof expected, "%d", values[i]);
        assert_int_equal(ph_text_number(text, values[i]), length);
        assert_string_equal(text, expected);
    }
}

/* Key, alpha and the edges of the picture, against the definition in double precision. */
static void sprites_cover_what_their_key_and_alpha_leave(void **state)
{
    (void)state;
    static const int places[][2] = {{3, 4}, {-2, -3}, {WIDTH - 3, HEIGHT - 2}, {WIDTH, 0}, {0, -9}, {-32769, 0}};
    uint16_t picture[5 * 6];
    uint8_t alphas[5 * 6];
    for (int i = 0; i < 30; i++) {
        picture[i] = i % 7 == 0 ? EDGE : (uint16_t)(i * 40503);
        alphas[i] = (uint8_t)(i % 33);
    }
    for (unsigned k = 0; k < 2 * sizeof places / sizeof places[0]; k++) {
        const int x0 = places[k / 2][0], y0 = places[k / 2][1];
        const struct ph_sprite sprite = {picture, 5, 6, (uint8_t)(k % 2 ? 32 : 20), true, EDGE, k % 2 ? alphas : NULL};
        static uint16_t pixels[WIDTH * HEIGHT];
        for (int i = 0; i < WIDTH * HEIGHT; i++) {
            pixels[i] = PAPER;
        }
        for (int y = 0; y < HEIGHT; y += 5) {
            const struct ph_overlay_band band = {pixels + y * WIDTH, WIDTH, y, y + 5 < HEIGHT ? 5 : HEIGHT - y};
            ph_overlay_sprite(&band, x0, y0, &sprite);
        }
        for (int i = 0; i < WIDTH * HEIGHT; i++) {
            const int x = i % WIDTH - x0, y = i / WIDTH - y0;
            const bool inside = x0 > -32768 && x >= 0 && x < 5 && y >= 0 && y < 6 && picture[y * 5 + x] != EDGE;
            const double a = !inside ? 0 : k % 2 ? alphas[y * 5 + x] / 32. : 20 / 32.;
            static const int from[] = {11, 5, 0}, top[] = {31, 63, 31};
            for (int c = 0; c < 3; c++) {
                const int got = (pixels[i] >> 8 | (pixels[i] & 255) << 8) >> from[c] & top[c];
                const int paper = (PAPER >> 8 | (PAPER & 255) << 8) >> from[c] & top[c];
                const int own =
                    inside ? (picture[y * 5 + x] >> 8 | (picture[y * 5 + x] & 255) << 8) >> from[c] & top[c] : 0;
                const double off = got - (paper + a * (own - paper));
                assert_true(off <= .51 && off >= -.51);
            }
        }
    }
}

/* Pictures of every width to 3 turns of the loop that copies, over each edge; an alpha above 32 covers, too. */
static void a_picture_that_covers_is_copied(void **state)
{
    (void)state;
    static uint16_t picture[25 * 3], pixels[WIDTH * HEIGHT];
    for (unsigned i = 0; i < 25 * 3; i++) {
        picture[i] = (uint16_t)(i + 1);
    }
    for (int wide = 1; wide <= 25; wide++) {
        const struct ph_sprite sprite = {.pixels = picture, .width = (uint16_t)wide, .height = 3, .alpha = 33};
        for (int x0 = -26; x0 <= WIDTH; x0++) {
            const int y0 = (x0 + 26) % (HEIGHT + 4) - 3;
            const struct ph_overlay_band band = {pixels, WIDTH, 0, HEIGHT};
            memset(pixels, 0, sizeof pixels);
            ph_overlay_sprite(&band, x0, y0, &sprite);
            for (int i = 0; i < WIDTH * HEIGHT; i++) {
                const int x = i % WIDTH - x0, y = i / WIDTH - y0;
                const bool inside = x >= 0 && x < wide && y >= 0 && y < 3;
                assert_int_equal(pixels[i], inside ? y * wide + x + 1 : 0);
            }
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(letters_have_a_dark_outline),
        cmocka_unit_test(outline_is_one_pixel_wide_at_every_scale),
        cmocka_unit_test(larger_scales_are_the_same_letters),
        cmocka_unit_test(text_does_not_depend_on_the_band_height),
        cmocka_unit_test(text_is_cut_at_the_picture),
        cmocka_unit_test(letters_all_differ),
        cmocka_unit_test(statistics_are_rounded_to_a_tenth),
        cmocka_unit_test(proportional_letters_are_as_wide_as_they_are_drawn),
        cmocka_unit_test(numbers_are_written_without_printf),
        cmocka_unit_test(sprites_cover_what_their_key_and_alpha_leave),
        cmocka_unit_test(a_picture_that_covers_is_copied),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
