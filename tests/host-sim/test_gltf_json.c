/* gltf_json: what RFC 8259 allows is read, everything else is refused with the byte where it breaks off. */
#include "gltf_json.h"

#include <math.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <setjmp.h>
#include <cmocka.h>

static char text[4096];

static struct gltf_json *parse(const char *from, const char **why, size_t *at)
{
    snprintf(text, sizeof text, "%s", from);
    return gltf_json_parse(text, strlen(text), why, at);
}

static struct gltf_json *right(const char *from)
{
    const char *why = "";
    size_t at = 0;
    struct gltf_json *json = parse(from, &why, &at);
    if (json == NULL) {
        fail_msg("%s: byte %zu: %s", from, at, why);
    }
    return json;
}

static void values_of_every_type_are_read(void **state)
{
    (void)state;
    struct gltf_json *const json =
        right("\xef\xbb\xbf { \"a\" : [ 1 , -2.5e1,0.125,1E+2, true,false,null,\"x\",{},[] ],"
              "\"b\":{\"c\":{\"d\":7}}, \"a\":2}\r\n\t ");
    const struct gltf_json *const a = gltf_json_get(json, "a");
    static const double numbers[4] = {1, -25, .125, 100};
    static const enum gltf_json_type types[10] = {
        GLTF_JSON_NUMBER, GLTF_JSON_NUMBER, GLTF_JSON_NUMBER, GLTF_JSON_NUMBER, GLTF_JSON_TRUE,
        GLTF_JSON_FALSE,  GLTF_JSON_NULL,   GLTF_JSON_STRING, GLTF_JSON_OBJECT, GLTF_JSON_ARRAY};
    assert_int_equal(json->count, 3);
    assert_true(gltf_json_is(a, GLTF_JSON_ARRAY)); /* the first of two of the same name */
    assert_int_equal(a->count, 10);
    for (uint32_t i = 0; i < 10; i++) {
        assert_int_equal(gltf_json_at(a, i)->type, types[i]);
        assert_true(i >= 4 || gltf_json_at(a, i)->number == numbers[i]);
    }
    assert_null(gltf_json_at(a, 10));
    assert_string_equal(gltf_json_text(gltf_json_at(a, 7)), "x");
    assert_null(gltf_json_text(gltf_json_at(a, 0)));
    assert_true(gltf_json_get(gltf_json_get(gltf_json_get(json, "b"), "c"), "d")->number == 7);
    assert_null(gltf_json_get(json, "d"));
    assert_null(gltf_json_get(NULL, "d"));
    free(json);
}

static void escapes_become_utf8(void **state)
{
    (void)state;
    struct gltf_json *const json =
        right("{\"\\u0061\\t\":\"\\\"\\\\\\/\\b\\f\\n\\r\\t \\u00e9\\u20AC\\uD83D\\uDE00 \xc3\xa9\"}");
    assert_string_equal(json->child->key, "a\t");
    assert_string_equal(json->child->text, "\"\\/\b\f\n\r\t \xc3\xa9\xe2\x82\xac\xf0\x9f\x98\x80 \xc3\xa9");
    free(json);
}

static void what_is_no_json_is_refused_where_it_breaks_off(void **state)
{
    static const struct {
        const char *text;
        size_t at;
    } wrong[] = {{"", 0},
                 {"[1]", 0},
                 {"1", 0},
                 {"{", 1},
                 {"{\"a\"", 4},
                 {"{\"a\" 1}", 5},
                 {"{\"a\":}", 5},
                 {"{\"a\":1", 6},
                 {"{\"a\":1,}", 7},
                 {"{\"a\":1]", 6},
                 {"{\"a\":[1,]}", 8},
                 {"{\"a\":[,1]}", 6},
                 {"{\"a\":[1 2]}", 8},
                 {"{\"a\":[1}", 7},
                 {"{a:1}", 1},
                 {"{\"a\":1} x", 8},
                 {"{\"a\":01}", 6},
                 {"{\"a\":+1}", 5},
                 {"{\"a\":.5}", 5},
                 {"{\"a\":1.}", 7},
                 {"{\"a\":1e}", 7},
                 {"{\"a\":1e+}", 8},
                 {"{\"a\":-}", 6},
                 {"{\"a\":0x10}", 6},
                 {"{\"a\":nan}", 5},
                 {"{\"a\":True}", 5},
                 {"{\"a\":\"b}", 8},
                 {"{\"a\":\"\n\"}", 6},
                 {"{\"a\":\"\\x\"}", 7},
                 {"{\"a\":\"\\u12g4\"}", 10},
                 {"{\"a\":\"\\u0000\"}", 12},
                 {"{\"a\":\"\\ud800\"}", 12},
                 {"{\"a\":\"\\udc00\"}", 12},
                 {"{\"a\":\"\\ud800\\u0061\"}", 18},
                 {"{\"a\":\"\\ud800\\ud800\"}", 18}};
    (void)state;
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        const char *why = NULL;
        size_t at = 0;
        struct gltf_json *const json = parse(wrong[i].text, &why, &at);
        if (json != NULL || why == NULL || at != wrong[i].at) {
            fail_msg("%s: %s at byte %zu", wrong[i].text, json != NULL ? "is read" : why, at);
        }
    }
}

/* A parser that calls itself would take a stack of many megabytes. */
static void brackets_may_be_as_deep_as_they_like(void **state)
{
    enum { DEEP = 1000000 };
    char *const deep = malloc(2 * DEEP + 8);
    const char *why = NULL;
    size_t at = 0;
    (void)state;
    assert_non_null(deep);
    memcpy(deep, "{\"a\":", 5);
    memset(deep + 5, '[', DEEP);
    memset(deep + 5 + DEEP, ']', DEEP);
    memcpy(deep + 5 + 2 * DEEP, "}", 2);
    struct gltf_json *const json = gltf_json_parse(deep, 2 * DEEP + 6, &why, &at);
    assert_non_null(json);
    free(json);
    memcpy(deep, "{\"a\":", 5); /* it was decoded in place */
    assert_null(gltf_json_parse(deep, 2 * DEEP + 5, &why, &at));
    assert_int_equal(at, 2 * DEEP + 5);
    free(deep);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_of_every_type_are_read),
        cmocka_unit_test(escapes_become_utf8),
        cmocka_unit_test(what_is_no_json_is_refused_where_it_breaks_off),
        cmocka_unit_test(brackets_may_be_as_deep_as_they_like),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
