/* See gltf_json.h. */
#include "gltf_json.h"

#include <stdlib.h>
#include <string.h>

struct parser {
    char *at, *end;
    struct gltf_json *values;
    size_t used;
    const char *why; /* what is wrong at `at` */
};

static bool fail(struct parser *p, const char *why)
{
    p->why = why;
    return false;
}

static void skip_space(struct parser *p)
{
    while (p->at < p->end && strchr(" \t\r\n", *p->at) != NULL && *p->at != '\0') {
        p->at++;
    }
}

/* Takes the character if it comes next. */
static bool take(struct parser *p, char c)
{
    const bool is_there = p->at < p->end && *p->at == c;
    p->at += is_there;
    return is_there;
}

/* ---- strings ----------------------------------------------------------------------------------------------------- */

/* Reads four hexadecimal digits; UINT32_MAX: there are none. */
static uint32_t read_hex(struct parser *p)
{
    static const char digits[] = "0123456789abcdefABCDEF";
    uint32_t value = 0;
    for (int i = 0; i < 4; i++, p->at++) {
        const char *digit = p->at < p->end && *p->at != '\0' ? strchr(digits, *p->at) : NULL;
        if (digit == NULL) {
            return UINT32_MAX;
        }
        const uint32_t d = (uint32_t)(digit - digits);
        value = value * 16 + (d < 16 ? d : d - 6);
    }
    return value;
}

/* Writes a character as UTF-8, which is never longer than its escape. */
static char *put_utf8(char *to, uint32_t c)
{
    static const uint8_t first[5] = {0, 0, 0xc0, 0xe0, 0xf0};
    const int n = c < 0x80 ? 1 : c < 0x800 ? 2 : c < 0x10000 ? 3 : 4;
    for (int i = n - 1; i > 0; i--, c >>= 6) {
        to[i] = (char)(0x80 | (c & 0x3f));
    }
    to[0] = (char)(first[n] | c);
    return to + n;
}

/* A character behind a backslash; two escapes of UTF-16 may make one. */
static bool read_escape(struct parser *p, char **to)
{
    static const char names[] = "\"\\/bfnrt", meant[] = "\"\\/\b\f\n\r\t";
    const char *name = p->at < p->end && *p->at != '\0' ? strchr(names, *p->at) : NULL;
    if (name != NULL) {
        *(*to)++ = meant[name - names];
        p->at++;
        return true;
    }
    uint32_t c = take(p, 'u') ? read_hex(p) : UINT32_MAX;
    if (c >= 0xd800 && c < 0xdc00 && take(p, '\\') && take(p, 'u')) {
        const uint32_t low = read_hex(p);
        c = low >= 0xdc00 && low < 0xe000 ? 0x10000 + ((c - 0xd800) << 10) + (low - 0xdc00) : UINT32_MAX;
    }
    if (c == 0 || c > 0x10ffff || (c >= 0xd800 && c < 0xe000)) {
        return fail(p, "an escape that is no character");
    }
    *to = put_utf8(*to, c);
    return true;
}

/* Reads a string behind its first quote, and ends it with a 0 in place. NULL: p->why. */
static const char *read_string(struct parser *p)
{
    char *const begin = p->at, *to = begin;
    while (p->at < p->end && *p->at != '"') {
        if ((unsigned char)*p->at < ' ') {
            fail(p, "a control character in a string");
            return NULL;
        }
        if (!take(p, '\\')) {
            *to++ = *p->at++;
        } else if (!read_escape(p, &to)) {
            return NULL;
        }
    }
    if (!take(p, '"')) {
        fail(p, "a string without its end");
        return NULL;
    }
    *to = '\0';
    return begin;
}

/* ---- values ------------------------------------------------------------------------------------------------------ */

static bool take_digits(struct parser *p)
{
    const char *const begin = p->at;
    while (p->at < p->end && *p->at >= '0' && *p->at <= '9') {
        p->at++;
    }
    return p->at > begin;
}

static bool read_number(struct parser *p, struct gltf_json *to)
{
    const char *const begin = p->at;
    take(p, '-');
    if (!take(p, '0') && !take_digits(p)) {
        return fail(p, "a value that is none");
    }
    if (take(p, '.') && !take_digits(p)) {
        return fail(p, "a number that is none");
    }
    if (take(p, 'e') || take(p, 'E')) {
        if (!take(p, '+')) {
            take(p, '-');
        }
        if (!take_digits(p)) {
            return fail(p, "a number that is none");
        }
    }
    to->type = GLTF_JSON_NUMBER;
    to->number = strtod(begin, NULL);
    return true;
}

static bool take_word(struct parser *p, const char *word)
{
    const size_t n = strlen(word);
    const bool is_there = (size_t)(p->end - p->at) >= n && memcmp(p->at, word, n) == 0;
    p->at += is_there ? n : 0;
    return is_there;
}

/* Reads a value, but of an array or object only its bracket. */
static bool read_value(struct parser *p, struct gltf_json *to)
{
    if (take(p, '{') || take(p, '[')) {
        to->type = p->at[-1] == '{' ? GLTF_JSON_OBJECT : GLTF_JSON_ARRAY;
        return true;
    }
    if (take(p, '"')) {
        to->type = GLTF_JSON_STRING;
        to->text = read_string(p);
        return to->text != NULL;
    }
    if (take_word(p, "true") || take_word(p, "false")) {
        to->type = p->at[-2] == 'u' ? GLTF_JSON_TRUE : GLTF_JSON_FALSE;
        return true;
    }
    return take_word(p, "null") || read_number(p, to); /* GLTF_JSON_NULL is 0 */
}

/* Reads the name of a member and its colon. */
static bool read_key(struct parser *p, struct gltf_json *to)
{
    to->key = take(p, '"') ? read_string(p) : NULL;
    if (to->key == NULL) {
        return p->why == NULL ? fail(p, "a member without a name") : false;
    }
    skip_space(p);
    const bool has_colon = take(p, ':');
    skip_space(p);
    return has_colon || fail(p, "a name without a colon");
}

/* Adds a value to the end of `parent`, whose last child is *last. */
static struct gltf_json *add_value(struct parser *p, struct gltf_json *parent, struct gltf_json *last)
{
    struct gltf_json *const to = &p->values[p->used++];
    *to = (struct gltf_json){.parent = parent};
    if (last != NULL) {
        last->next = to;
    } else if (parent != NULL) {
        parent->child = to;
    }
    if (parent != NULL) {
        parent->count++;
    }
    return to;
}

static bool read_all(struct parser *p)
{
    struct gltf_json *parent = NULL, *last = NULL; /* what the next value goes into, and behind which one */
    do {
        skip_space(p);
        const bool is_closed = parent != NULL && last == NULL && take(p, parent->type == GLTF_JSON_OBJECT ? '}' : ']');
        if (!is_closed) {
            struct gltf_json *const value = add_value(p, parent, last);
            if ((parent != NULL && parent->type == GLTF_JSON_OBJECT && !read_key(p, value)) || !read_value(p, value)) {
                return false;
            }
            last = value;
            if (value->type >= GLTF_JSON_ARRAY) {
                parent = value;
                last = NULL;
                continue;
            }
        } else {
            last = parent;
            parent = parent->parent;
        }
        for (skip_space(p); parent != NULL && take(p, parent->type == GLTF_JSON_OBJECT ? '}' : ']'); skip_space(p)) {
            last = parent;
            parent = parent->parent;
        }
        if (parent != NULL && !take(p, ',')) {
            return fail(p, "a value without a comma or a bracket behind it");
        }
    } while (parent != NULL);
    return true;
}

/* NOLINTNEXTLINE(readability-non-const-parameter): strings are decoded in place */
struct gltf_json *gltf_json_parse(char *text, size_t n, const char **why, size_t *at)
{
    struct parser p = {.at = text, .end = text + n};
    size_t most = 2; /* a value stands at the beginning, or behind one of these */
    for (size_t i = 0; i < n; i++) {
        most += text[i] == ',' || text[i] == '[' || text[i] == '{';
    }
    p.values = calloc(most, sizeof *p.values);
    take_word(&p, "\xef\xbb\xbf"); /* some write a byte order mark */
    skip_space(&p);
    bool is_read = p.values != NULL && p.at < p.end && *p.at == '{' && read_all(&p);
    while (is_read && p.at < p.end && *p.at == '\0') {
        p.at++;
    }
    if (is_read && p.at < p.end) {
        is_read = fail(&p, "something behind the text");
    }
    if (is_read) {
        return p.values;
    }
    *why = p.values == NULL ? "it needs too much memory" : p.why != NULL ? p.why : "no object";
    *at = (size_t)(p.at - text);
    free(p.values);
    return NULL;
}

/* ---- what is in it ----------------------------------------------------------------------------------------------- */

const struct gltf_json *gltf_json_get(const struct gltf_json *object, const char *key)
{
    const struct gltf_json *item;
    GLTF_JSON_EACH(item, object)
    {
        if (item->key != NULL && strcmp(item->key, key) == 0) {
            return item;
        }
    }
    return NULL;
}

const struct gltf_json *gltf_json_at(const struct gltf_json *array, uint32_t i)
{
    const struct gltf_json *item = array != NULL ? array->child : NULL;
    for (; i > 0 && item != NULL; i--) {
        item = item->next;
    }
    return item;
}

const char *gltf_json_text(const struct gltf_json *value)
{
    return value != NULL ? value->text : NULL;
}

bool gltf_json_is(const struct gltf_json *value, enum gltf_json_type type)
{
    return value != NULL && value->type == type;
}
