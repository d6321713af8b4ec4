/*
 * gltf_json: a JSON text (RFC 8259) as a tree of values. It takes any bytes, and says where it breaks off. It is read
 * without recursion, so that no depth of brackets overflows a stack.
 */
#ifndef GLTF_JSON_H
#define GLTF_JSON_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum gltf_json_type {
    GLTF_JSON_NULL,
    GLTF_JSON_FALSE,
    GLTF_JSON_TRUE,
    GLTF_JSON_NUMBER,
    GLTF_JSON_STRING,
    GLTF_JSON_ARRAY,
    GLTF_JSON_OBJECT
};

struct gltf_json {
    const char *key;  /* in an object; else NULL */
    const char *text; /* of a string, in UTF-8; else NULL */
    struct gltf_json *child, *next, *parent;
    double number;  /* of a number; else 0 */
    uint32_t count; /* of children */
    enum gltf_json_type type;
};

/* Walks over the children of a value, in their order; over none where it is NULL, a number or a text. */
#define GLTF_JSON_EACH(item, list)                                                                                     \
    for ((item) = (list) != NULL ? (list)->child : NULL; (item) != NULL; (item) = (item)->next)

/* Reads n bytes; somewhere behind them there must be a 0. Strings are decoded in place. The text must be one object,
 * with nothing but white space or zeros behind it. NULL: *why says what is wrong at byte *at. Values are in one block:
 * free() what is returned. A text costs at most 64 bytes for each comma and bracket in it. */
struct gltf_json *gltf_json_parse(char *text, size_t n, const char **why, size_t *at);

/* The first member of that name; NULL: there is none, or no object. */
const struct gltf_json *gltf_json_get(const struct gltf_json *object, const char *key);

/* Child i; NULL: there is none. It walks over those before it. */
const struct gltf_json *gltf_json_at(const struct gltf_json *array, uint32_t i);

/* The text of a string, else NULL. */
const char *gltf_json_text(const struct gltf_json *value);

bool gltf_json_is(const struct gltf_json *value, enum gltf_json_type type);

#endif
