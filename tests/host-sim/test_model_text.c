/* model_text: words, numbers and ends of lines as OBJ, MTL and PLY files have them, in texts of a few bytes. */
#define _XOPEN_SOURCE 700 /* mkstemp, truncate */

#include "model_text.h"

#include <errno.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

static struct model_text text_of(const char *bytes)
{
    return (struct model_text){.at = bytes, .end = bytes + strlen(bytes), .line = 1};
}

static void assert_same(const struct model_word *word, const char *expected)
{
    assert_int_equal(word->n, strlen(expected));
    assert_memory_equal(word->text, expected, word->n);
}

static void assert_word(struct model_text *text, const char *expected)
{
    struct model_word word;
    assert_int_equal(model_text_word(text, &word), expected != NULL);
    assert_same(&word, expected != NULL ? expected : "");
}

static struct model_word word_of(const char *bytes)
{
    return (struct model_word){bytes, strlen(bytes)};
}

static void words_stand_between_white_space_of_one_line(void **state)
{
    struct model_text text = text_of(" \tv\v1\f-2.5  \nf");
    (void)state;
    assert_word(&text, "v");
    assert_word(&text, "1");
    assert_word(&text, "-2.5");
    assert_word(&text, NULL);
    assert_word(&text, NULL); /* it stays at the end of the line */
    assert_true(model_text_next(&text));
    assert_word(&text, "f");
    assert_word(&text, NULL);
}

static void a_line_ends_with_cr_lf_or_both(void **state)
{
    struct model_text text = text_of("a\nb\rc\r\nd\n\re");
    (void)state;
    static const char *const lines[] = {"a", "b", "c", "d", NULL, "e"};
    for (uint32_t i = 0; i < 6; i++) {
        assert_int_equal(text.line, i + 1);
        assert_word(&text, lines[i]);
        assert_int_equal(model_text_next(&text), i < 5);
    }
    assert_ptr_equal(text.at, text.end);
}

static void the_rest_of_a_line_is_passed_over(void **state)
{
    struct model_text text = text_of("usemtl a b c\nd");
    (void)state;
    assert_word(&text, "usemtl");
    assert_true(model_text_next(&text));
    assert_word(&text, "d");
    assert_false(model_text_next(&text));
    struct model_text last = text_of("a\n");
    assert_false(model_text_next(&last)); /* nothing is behind it */
    last = text_of("a\r\n");
    assert_false(model_text_next(&last));
    struct model_text none = text_of("");
    assert_word(&none, NULL);
    assert_false(model_text_next(&none));
}

/* OBJ: "a line may be joined with the next by a backslash at its end". PLY has no such rule. */
static void a_backslash_joins_lines_where_the_format_says_so(void **state)
{
    static const char bytes[] = "f 1 \\\n2\\\r\n3 4\\5 \\\\\n6\nv";
    struct model_text text = text_of(bytes);
    (void)state;
    text.is_joined = true;
    static const char *const words[] = {"f", "1", "2", "3", "4\\5", "\\", "6", NULL};
    for (int i = 0; i < 8; i++) {
        assert_word(&text, words[i]);
    }
    assert_int_equal(text.line, 4);
    assert_true(model_text_next(&text));
    assert_word(&text, "v");
    assert_int_equal(text.line, 5);
    text = text_of(bytes);
    assert_word(&text, "f");
    assert_word(&text, "1");
    assert_word(&text, "\\");
    assert_word(&text, NULL);
    text = text_of("a \\");
    text.is_joined = true;
    assert_word(&text, "a");
    assert_word(&text, "\\"); /* no line ends here */
    assert_word(&text, NULL);
}

static void the_rest_of_a_line_has_no_white_space_around_it(void **state)
{
    struct model_text text = text_of("newmtl  dark \t red \t\r\nKd");
    (void)state;
    assert_word(&text, "newmtl");
    const struct model_word rest = model_text_rest(&text);
    assert_same(&rest, "dark \t red");
    const struct model_word none = model_text_rest(&text);
    assert_int_equal(none.n, 0);
    assert_true(model_text_next(&text));
    assert_word(&text, "Kd");
    struct model_text blank = text_of("   ");
    assert_int_equal(model_text_rest(&blank).n, 0);
}

static void any_word_looks_in_the_lines_behind_too(void **state)
{
    struct model_text text = text_of("a\n\n \r\nb c\n");
    struct model_word word;
    (void)state;
    assert_word(&text, "a");
    assert_true(model_text_any_word(&text, &word));
    assert_same(&word, "b");
    assert_int_equal(text.line, 4);
    assert_true(model_text_any_word(&text, &word));
    assert_same(&word, "c");
    assert_int_equal(text.line, 4);
    assert_false(model_text_any_word(&text, &word));
}

static void a_word_is_the_same_in_capitals(void **state)
{
    const struct model_word word = {"KdX", 2};
    (void)state;
    assert_true(model_word_is(&word, "kD"));
    assert_false(model_word_is(&word, "K"));
    assert_false(model_word_is(&word, "KdX"));
    assert_false(model_word_is(&word, "Ks"));
}

static void a_number_is_decimal_nan_or_inf(void **state)
{
    static const struct {
        const char *word;
        double value;
    } good[] = {{"0", 0}, {"-1.5", -1.5}, {"+.25", .25}, {"1e-2", .01}, {"2.E3", 2000}, {"inf", INFINITY}};
    static const char *const wrong[] = {"", "1.5a", "a", "0x10", "0X1", "1,5", "--1", "1/2", "e5"};
    double number;
    (void)state;
    for (size_t i = 0; i < sizeof good / sizeof good[0]; i++) {
        const struct model_word word = word_of(good[i].word);
        assert_true(model_word_number(&word, &number));
        assert_true(number == good[i].value);
    }
    const struct model_word nan = word_of("nan");
    assert_true(model_word_number(&nan, &number) && isnan(number));
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        const struct model_word word = word_of(wrong[i]);
        assert_false(model_word_number(&word, &number));
    }
}

static void a_whole_number_fits_in_64_bits(void **state)
{
    static const struct {
        const char *word;
        int64_t value;
    } good[] = {{"0", 0}, {"-12", -12}, {"+7", 7}, {"010", 10}, {"9223372036854775807", INT64_MAX}};
    static const char *const wrong[] = {"", "1.0", "1e3", "0x10", "9223372036854775808", "1/2", "-"};
    int64_t number;
    (void)state;
    for (size_t i = 0; i < sizeof good / sizeof good[0]; i++) {
        const struct model_word word = word_of(good[i].word);
        errno = ERANGE; /* of a call before */
        assert_true(model_word_whole(&word, &number));
        assert_int_equal(number, good[i].value);
    }
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        const struct model_word word = word_of(wrong[i]);
        assert_false(model_word_whole(&word, &number));
    }
}

static void numbers_are_read_up_to_something_else(void **state)
{
    double n[4] = {9, 9, 9, 9};
    struct model_text text = text_of("1 2 3 4\n5 6\n7 x 8");
    (void)state;
    assert_int_equal(model_text_numbers(&text, 3, n), 3);
    assert_true(n[0] == 1 && n[1] == 2 && n[2] == 3 && n[3] == 9);
    assert_word(&text, "4"); /* no more than asked for are taken */
    assert_true(model_text_next(&text));
    assert_int_equal(model_text_numbers(&text, 4, n), 2);
    assert_true(n[0] == 5 && n[1] == 6);
    assert_true(model_text_next(&text));
    assert_int_equal(model_text_numbers(&text, 4, n), 1);
    assert_true(n[0] == 7);
    assert_int_equal(model_text_numbers(&text, 0, n), 0);
}

static void a_file_is_read_whole_with_a_0_behind_it(void **state)
{
    static const char bytes[] = "a\0b\r\n";
    char path[] = "/tmp/model_textXXXXXX";
    size_t n = 99;
    (void)state;
    const int file = mkstemp(path);
    assert_true(file >= 0);
    assert_int_equal(write(file, bytes, 5), 5);
    close(file);
    char *text = model_text_load(path, &n);
    assert_non_null(text);
    assert_int_equal(n, 5);
    assert_memory_equal(text, bytes, 6);
    free(text);
    assert_int_equal(truncate(path, 0), 0);
    text = model_text_load(path, &n);
    assert_non_null(text);
    assert_int_equal(n, 0);
    assert_int_equal(text[0], 0);
    free(text);
    unlink(path);
    assert_null(model_text_load(path, &n));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(words_stand_between_white_space_of_one_line),
        cmocka_unit_test(a_line_ends_with_cr_lf_or_both),
        cmocka_unit_test(the_rest_of_a_line_is_passed_over),
        cmocka_unit_test(a_backslash_joins_lines_where_the_format_says_so),
        cmocka_unit_test(the_rest_of_a_line_has_no_white_space_around_it),
        cmocka_unit_test(any_word_looks_in_the_lines_behind_too),
        cmocka_unit_test(a_word_is_the_same_in_capitals),
        cmocka_unit_test(a_number_is_decimal_nan_or_inf),
        cmocka_unit_test(a_whole_number_fits_in_64_bits),
        cmocka_unit_test(numbers_are_read_up_to_something_else),
        cmocka_unit_test(a_file_is_read_whole_with_a_0_behind_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
