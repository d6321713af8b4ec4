/* option_table: command lines, one table with a row of each kind, and the lines that wrong ones get. */
#define _XOPEN_SOURCE 700 /* dup2, pread */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "complain.h"
#include "option_table.h"
#include "stderr_capture.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

struct options {
    bool flag;
    uint32_t count;
    const char *file, *kind;
    char own[16];
};

static bool set_own(void *options, const char *value)
{
    struct options *o = options;
    snprintf(o->own, sizeof o->own, "%s", value == NULL ? "(none)" : value);
    return value == NULL || *value != 'x';
}

static const char *colour(const void *from, size_t i)
{
    static const char *const colours[] = {"green", "yellow"};
    assert_null(from);
    return i < 2 ? colours[i] : NULL;
}

static const struct option_row rows[] = {
    {.name = "flag", .help = "sets it", .at = offsetof(struct options, flag)},
    {.name = "count",
     .argument = "N",
     .help = "how many",
     .allowed = "3 .. 5",
     .at = offsetof(struct options, count),
     .least = 3,
     .most = 5,
     .alias = "number"},
    {.name = "file", .argument = "FILE", .help = "which", .allowed = "a name", .at = offsetof(struct options, file)},
    {.name = "kind",
     .argument = "KIND",
     .help = "what",
     .allowed = "big, small",
     .at = offsetof(struct options, kind),
     .words = "big|small"},
    {.name = "own", .argument = "[X]", .help = "mine", .allowed = "no x", .set = set_own},
    {.name = "colour", .argument = "C", .help = "hue", .allowed = "a colour", .set = set_own, .names = colour},
};
static const struct option_table table = {rows, sizeof rows / sizeof rows[0]};

struct read {
    struct options options;
    int next;
    struct stderr_capture capture;
};

/* Reads the option word[1], of `argc` words. */
static struct read read_words(int argc, const char *a, const char *b)
{
    struct read r = {.next = 0};
    char first[64], second[64], name[] = "program", *words[] = {name, first, second};
    snprintf(first, sizeof first, "%s", a);
    snprintf(second, sizeof second, "%s", b);
    static char kept[64]; /* what the options point at */
    stderr_capture_begin(&r.capture);
    r.next = option_table_read(&table, &r.options, argc, words, 1);
    stderr_capture_end(&r.capture);
    if (r.options.file != NULL || r.options.kind != NULL) {
        snprintf(kept, sizeof kept, "%s", r.options.file != NULL ? r.options.file : r.options.kind);
        r.options.file = r.options.file != NULL ? kept : NULL;
        r.options.kind = r.options.kind != NULL ? kept : NULL;
    }
    return r;
}

static void an_option_is_found_by_its_name_or_alias(void **state)
{
    (void)state;
    assert_ptr_equal(option_table_find(&table, "--flag"), &rows[0]);
    assert_ptr_equal(option_table_find(&table, "--count=4"), &rows[1]);
    assert_ptr_equal(option_table_find(&table, "--number"), &rows[1]);
    assert_ptr_equal(option_table_find(&table, "--number=3=4"), &rows[1]);
    assert_ptr_equal(option_table_find(&table, "--colour"), &rows[5]);
    static const char *const none[] = {"flag", "-flag", "--fla", "--flags", "--", "--=", "xxflag", "-xflag", "--Flag"};
    for (size_t i = 0; i < sizeof none / sizeof none[0]; i++) {
        assert_null(option_table_find(&table, none[i]));
    }
}

static void values_go_where_the_row_says(void **state)
{
    (void)state;
    struct read r = read_words(2, "--flag", "");
    assert_true(r.next == 2 && r.options.flag);
    r = read_words(3, "--count", "3");
    assert_true(r.next == 3 && r.options.count == 3 && !r.options.flag);
    r = read_words(3, "--number=5", "4");
    assert_true(r.next == 2 && r.options.count == 5);
    r = read_words(3, "--file", "--flag");
    assert_int_equal(r.next, 3);
    assert_string_equal(r.options.file, "--flag");
    r = read_words(2, "--file=a=b", "");
    assert_string_equal(r.options.file, "a=b");
    r = read_words(3, "--kind", "small");
    assert_string_equal(r.options.kind, "small");
    assert_int_equal(r.next, 3);
    assert_true(read_words(3, "--kind", "big").next == 3);
}

static void an_optional_value_may_be_missing(void **state)
{
    (void)state;
    struct read r = read_words(3, "--own", "it");
    assert_int_equal(r.next, 3);
    assert_string_equal(r.options.own, "it");
    r = read_words(3, "--own", "--flag");
    assert_int_equal(r.next, 2);
    assert_string_equal(r.options.own, "(none)");
    r = read_words(2, "--own", "it");
    assert_int_equal(r.next, 2);
    assert_string_equal(r.options.own, "(none)");
    r = read_words(3, "--own=me", "it");
    assert_int_equal(r.next, 2);
    assert_string_equal(r.options.own, "me");
}

static void a_wrong_option_gets_a_line(void **state)
{
    (void)state;
    static const struct {
        const char *first, *second;
        int argc;
        const char *said;
    } wrong[] = {{"--flag=1", "", 2, "--flag takes no value\n"},
                 {"--flg", "", 2, "--flg: no such option; did you mean --flag? --help lists them\n"},
                 {"--coun=77777", "", 2, "--coun=77777: no such option; did you mean --count? --help lists them\n"},
                 {"--zzzz", "", 2, "--zzzz: no such option; --help lists them\n"},
                 {"-flag", "", 2, "-flag: no such option; --help lists them\n"},
                 {"-h", "", 2, "--help: no such option; --help lists them\n"},
                 {"--count", "", 2, "--count needs a value: N\n"},
                 {"--number", "", 2, "--number needs a value: N\n"},
                 {"--count", "2", 3, "--count '2': must be 3 .. 5\n"},
                 {"--number=6", "", 2, "--number '6': must be 3 .. 5\n"},
                 {"--file", "", 3, "--file '': must be a name\n"},
                 {"--file=", "", 2, "--file '': must be a name\n"},
                 {"--kind", "bi", 3, "--kind 'bi': must be big, small\n"},
                 {"--kind", "bigg", 3, "--kind 'bigg': must be big, small\n"},
                 {"--kind", "big|small", 3, "--kind 'big|small': must be big, small\n"},
                 {"--kind", "", 3, "--kind '': must be big, small\n"},
                 {"--own", "x", 3, "--own 'x': must be no x\n"},
                 {"--colour", "xellow", 3, "--colour 'xellow': must be a colour; did you mean yellow?\n"},
                 {"--colour", "x", 3, "--colour 'x': must be a colour\n"}};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        const struct read r = read_words(wrong[i].argc, wrong[i].first, wrong[i].second);
        assert_int_equal(r.next, PH_ERR_INVAL);
        assert_string_equal(r.capture.text + strlen("pinhole: "), wrong[i].said);
    }
    char name[100] = "--flag";
    memset(name + 6, 'g', sizeof name - 7);
    name[60] = '\0'; /* longer names are cut before they are compared */
    assert_int_equal(read_words(2, name, "").next, PH_ERR_INVAL);
}

static void words_stand_between_the_options(void **state)
{
    (void)state;
    struct options options = {0};
    char words[][10] = {"program", "one", "--count", "4", "two", "--flag"}, *argv[6];
    for (int i = 0; i < 6; i++) {
        argv[i] = words[i];
    }
    const char *found[3] = {NULL};
    struct stderr_capture capture;
    assert_int_equal(option_table_words(&table, &options, 6, argv, found, 2), 2);
    assert_string_equal(found[0], "one");
    assert_string_equal(found[1], "two");
    assert_true(options.flag && options.count == 4 && found[2] == NULL);
    stderr_capture_begin(&capture);
    const int status = option_table_words(&table, &options, 6, argv, found, 1);
    stderr_capture_end(&capture);
    assert_int_equal(status, PH_ERR_INVAL);
    assert_string_equal(capture.text, "pinhole: 'two': a word too many; see --help\n");
    words[3][0] = '9';
    stderr_capture_begin(&capture);
    const int wrong = option_table_words(&table, &options, 6, argv, found, 2);
    stderr_capture_end(&capture);
    assert_int_equal(wrong, PH_ERR_INVAL);
}

static void help_has_each_row_and_the_version(void **state)
{
    (void)state;
    static const struct option_table two = {rows, 2};
    FILE *const file = tmpfile();
    const int before = dup(STDOUT_FILENO);
    char text[1000];
    assert_true(file != NULL && before >= 0);
    fflush(stdout);
    dup2(fileno(file), STDOUT_FILENO);
    option_table_help(&two);
    fflush(stdout);
    dup2(before, STDOUT_FILENO);
    close(before);
    const ssize_t n = pread(fileno(file), text, sizeof text - 1, 0);
    assert_true(n >= 0);
    text[n] = '\0';
    fclose(file);
    assert_string_equal(text, "  --flag\n        sets it\n"
                              "  --count N\n        how many\n        takes: 3 .. 5\n        also: --number\n"
                              "  --version\n        as the only word: prints the version\n");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_option_is_found_by_its_name_or_alias), cmocka_unit_test(values_go_where_the_row_says),
        cmocka_unit_test(an_optional_value_may_be_missing),        cmocka_unit_test(a_wrong_option_gets_a_line),
        cmocka_unit_test(words_stand_between_the_options),         cmocka_unit_test(help_has_each_row_and_the_version),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
