/* depth_table: small CSV as a table, as JSON (RFC 8259, section 6, says what a number is) and without remarks. */
#define _XOPEN_SOURCE 700 /* open_memstream */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "depth_table.h"

#include <stdlib.h>
#include <string.h>

static char *said;
static size_t said_bytes;

static FILE *hear(void)
{
    FILE *const file = open_memstream(&said, &said_bytes);
    assert_non_null(file);
    return file;
}

static void expect(FILE *heard, const char *text)
{
    fclose(heard);
    assert_string_equal(said, text);
    free(said);
}

static void expect_table(const char *csv, const char *headings, const char *table)
{
    FILE *const file = hear();
    depth_table_print(file, csv, headings);
    expect(file, table);
}

static void expect_json(const char *csv, const char *json)
{
    FILE *const file = hear();
    depth_table_json(file, csv);
    expect(file, json);
}

static void columns_are_as_wide_as_their_longest_cell(void **state)
{
    (void)state;
    expect_table("a,bb,c\nlonger,2,3\nx,,12345\n", NULL,
                 "a       bb      c\n"
                 "longer   2      3\n"
                 "x           12345\n");
    expect_table("one", NULL, "one\n");
    expect_table("", NULL, "");
}

static void headings_stand_for_the_names(void **state)
{
    (void)state;
    expect_table("name,value_that_is_long\na,1\n", "What,is predicted\n",
                 "What  is predicted\n"
                 "a                1\n");
    expect_table("name\n", "What\n", "What\n");
}

static void remarks_stand_above_or_below(void **state)
{
    (void)state;
    expect_table("a,b\n# a remark that is long\n1,2\n#!   first\n3,4\n# second\n", NULL,
                 "first\n"
                 "a  b\n"
                 "1  2\n"
                 "3  4\n"
                 "a remark that is long\n"
                 "second\n");
}

static void many_columns_are_cut(void **state)
{
    (void)state;
    expect_table("1,2,3,4,5,6,7,8,9,0,1,2,3,4,5,6,7,8,9,0,1,2,3,4,5,6\n", NULL,
                 "1  2  3  4  5  6  7  8  9  0  1  2  3  4  5  6  7  8  9  0  1  2  3  4\n");
}

static void a_row_is_an_object(void **state)
{
    (void)state;
    expect_json("name,n\n# remark\na \"b\",5\nc,\n",
                "[\n{\"name\": \"a \\\"b\\\"\", \"n\": 5},\n{\"name\": \"c\", \"n\": null}\n]\n");
    expect_json("name,n\n", "[]\n");
    expect_json("name,n\n# remark\n", "[]\n");
    expect_json("x,y,z\n1,2\n", "[\n{\"x\": 1, \"y\": 2, \"z\": null}\n]\n"); /* a row that is too short */
    expect_json("x,y\n1\n2,3\n", "[\n{\"x\": 1, \"y\": null},\n{\"x\": 2, \"y\": 3}\n]\n");
    expect_json("x\n1,2", "[\n{\"x\": 1}\n]\n");
}

static void numbers_are_those_of_json(void **state)
{
    (void)state;
    static const char *const numbers[] = {"0", "-0", "7", "-12", "0.5", "10.25", "1e5", "1E+5", "-1.5e-05", "120"};
    static const char *const texts[] = {".5", "07", "inf", "nan", "-",  "1.",   "1e",    "1e+",  "0x1",
                                        "+1", "1 ", " 1",  "-.5", "00", "1.e5", "1.5.2", "none", "1-2"};
    char csv[64], json[64];
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        snprintf(csv, sizeof csv, "x\n%s\n", numbers[i]);
        snprintf(json, sizeof json, "[\n{\"x\": %s}\n]\n", numbers[i]);
        expect_json(csv, json);
    }
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        snprintf(csv, sizeof csv, "x\n%s\n", texts[i]);
        snprintf(json, sizeof json, "[\n{\"x\": \"%s\"}\n]\n", texts[i]);
        expect_json(csv, json);
    }
}

static void remarks_can_be_dropped(void **state)
{
    (void)state;
    char csv[] = "#! top\na,b\n# one\n# two\n1,#2\n\n#end";
    depth_table_drop_remarks(csv);
    assert_string_equal(csv, "a,b\n1,#2\n\n");
    char cut[] = "a\n#x\nb";
    depth_table_drop_remarks(cut);
    assert_string_equal(cut, "a\nb");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(columns_are_as_wide_as_their_longest_cell),
        cmocka_unit_test(headings_stand_for_the_names),
        cmocka_unit_test(remarks_stand_above_or_below),
        cmocka_unit_test(many_columns_are_cut),
        cmocka_unit_test(a_row_is_an_object),
        cmocka_unit_test(numbers_are_those_of_json),
        cmocka_unit_test(remarks_can_be_dropped),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
