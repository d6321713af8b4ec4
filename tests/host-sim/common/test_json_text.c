/* json_text: every byte as RFC 8259, section 7, wants it in a string. */
#define _XOPEN_SOURCE 700 /* open_memstream */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "json_text.h"

#include <stdio.h>
#include <stdlib.h>

static void expect(const char *text, const char *json)
{
    char *said = NULL;
    size_t n = 0;
    FILE *const file = open_memstream(&said, &n);
    assert_non_null(file);
    json_text(file, text);
    fclose(file);
    assert_string_equal(said, json);
    free(said);
}

static void plain_text_and_utf8_stay(void **state)
{
    (void)state;
    expect("", "\"\"");
    expect(" a/b~", "\" a/b~\"");
    expect("\xc3\xa4\xe2\x82\xac\xff\x7f", "\"\xc3\xa4\xe2\x82\xac\xff\x7f\"");
}

static void quotes_and_backslashes_are_escaped(void **state)
{
    (void)state;
    expect("\"", "\"\\\"\"");
    expect("a\\b", "\"a\\\\b\"");
    expect("\"\"x", "\"\\\"\\\"x\"");
}

static void control_characters_are_four_digits(void **state)
{
    (void)state;
    for (unsigned c = 1; c < 0x20; c++) {
        static const char digits[] = "0123456789abcdef";
        const char text[] = {(char)c, '\0'};
        const char json[] = {'"', '\\', 'u', '0', '0', c >= 16 ? '1' : '0', digits[c % 16], '"', '\0'};
        expect(text, json);
    }
    expect("a\nb", "\"a\\u000ab\"");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plain_text_and_utf8_stay),
        cmocka_unit_test(quotes_and_backslashes_are_escaped),
        cmocka_unit_test(control_characters_are_four_digits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
