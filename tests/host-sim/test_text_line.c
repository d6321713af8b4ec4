/* line: whole lines as getline gives them, and never more than was asked for. */
#include "text_line.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* What is read from text, a line each, with '|' behind each. */
static void expect(const char *text, size_t n, size_t most, const char *lines)
{
    char found[200] = "", *line = NULL;
    size_t size = 0;
    ssize_t length;
    FILE *const file = tmpfile();
    assert_non_null(file);
    assert_int_equal(fwrite(text, 1, n, file), n);
    rewind(file);
    while ((length = text_line_read(&line, &size, most, file)) > 0) {
        assert_true((size_t)length <= most && (size_t)length < size);
        assert_int_equal(line[length], 0);
        strncat(found, line, sizeof found - strlen(found) - 2);
        strcat(found, "|");
    }
    assert_int_equal(length, 0);
    assert_true(feof(file));
    assert_string_equal(found, lines);
    free(line);
    fclose(file);
}

static void lines_keep_their_ends(void **state)
{
    (void)state;
    expect("", 0, 100, "");
    expect("a\n\nbc", 5, 100, "a\n|\n|bc|");
    expect("a\n", 2, 100, "a\n|");
}

static void a_long_line_comes_in_pieces(void **state)
{
    (void)state;
    expect("abcdefg\nh\n", 10, 3, "abc|def|g\n|h\n|");
    expect("abc\n", 4, 4, "abc\n|");
}

static void a_byte_of_zero_is_counted(void **state)
{
    (void)state;
    char *line = NULL;
    size_t size = 0;
    FILE *const file = tmpfile();
    assert_non_null(file);
    assert_int_equal(fwrite("a\0b\n", 1, 4, file), 4);
    rewind(file);
    assert_int_equal(text_line_read(&line, &size, 100, file), 4);
    assert_memory_equal(line, "a\0b\n", 5);
    free(line);
    fclose(file);
}

static void a_line_longer_than_the_first_room_is_whole(void **state)
{
    (void)state;
    char *line = NULL;
    size_t size = 0;
    FILE *const file = tmpfile();
    assert_non_null(file);
    for (int i = 0; i < 1000; i++) {
        putc('a' + i % 26, file);
    }
    rewind(file);
    assert_int_equal(text_line_read(&line, &size, 5000, file), 1000);
    for (int i = 0; i < 1000; i++) {
        assert_int_equal(line[i], 'a' + i % 26);
    }
    free(line);
    fclose(file);
}

static void a_directory_is_an_error(void **state)
{
    (void)state;
    char *line = NULL;
    size_t size = 0;
    FILE *const file = fopen("/", "r");
    assert_non_null(file);
    assert_int_equal(text_line_read(&line, &size, 100, file), -EISDIR);
    free(line);
    fclose(file);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lines_keep_their_ends),     cmocka_unit_test(a_long_line_comes_in_pieces),
        cmocka_unit_test(a_byte_of_zero_is_counted), cmocka_unit_test(a_line_longer_than_the_first_room_is_whole),
        cmocka_unit_test(a_directory_is_an_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
