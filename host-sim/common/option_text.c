/* See option_text.h. */
#include "option_text.h"

#include "render.h"

#include <stdio.h>
#include <string.h>

static const char *read_digits(const char *text, uint32_t max, uint32_t *out)
{
    uint64_t value = 0;
    const char *at = text;
    for (; *at >= '0' && *at <= '9'; at++) {
        value = value * 10 + (uint64_t)(*at - '0');
        if (value > max) {
            return NULL;
        }
    }
    *out = (uint32_t)value;
    return at == text ? NULL : at;
}

bool option_text_u32(const char *text, uint32_t min, uint32_t max, uint32_t *out)
{
    uint32_t value;
    const char *end = read_digits(text, max, &value);
    if (end == NULL || *end != '\0' || value < min) {
        return false;
    }
    *out = value;
    return true;
}

bool option_text_size(const char *text, uint16_t max, uint16_t *width, uint16_t *height)
{
    uint32_t w, h;
    const char *x = read_digits(text, max, &w);
    if (x == NULL || *x != 'x' || w == 0 || !option_text_u32(x + 1, 1, max, &h)) {
        return false;
    }
    *width = (uint16_t)w;
    *height = (uint16_t)h;
    return true;
}

bool option_text_fx(const char *text, fx_t *out, const char **rest)
{
    if (*text == '\0' || strchr("+-.0123456789", *text) == NULL) {
        return false;
    }
    return fx_from_text(text, out, rest) == 0;
}

bool option_text_fx_list(const char *text, fx_t *out, int count, const char **rest)
{
    fx_t values[4];
    for (int i = 0; i < count; i++) {
        if (i > 0 && *text++ != ',') {
            return false;
        }
        if (!option_text_fx(text, &values[i], &text)) {
            return false;
        }
    }
    memcpy(out, values, sizeof *out * (size_t)count);
    *rest = text;
    return true;
}

int option_text_choice(const char *text, const char *const names[], int count)
{
    for (int i = 0; i < count; i++) {
        if (strcmp(text, names[i]) == 0) {
            return i;
        }
    }
    return PH_ERR_INVAL;
}

bool option_text_turns(const char *text, uint8_t *out)
{
    static const char *const degrees[] = {"0", "90", "180", "270"};
    const int turns = option_text_choice(text, degrees, 4);
    *out = turns >= 0 ? (uint8_t)turns : *out;
    return turns >= 0;
}

bool option_text_depth(const char *text, struct option_depth *out)
{
    const char *const end = strstr(text, "-e");
    const size_t n = end != NULL ? (size_t)(end - text) : strlen(text);
    if (end != NULL && (end[2] < '3' || end[2] > '6' || end[3] != '\0')) {
        return false;
    }
    for (int i = 0; i < PH_DEPTH_FORMATS; i++) {
        const struct ph_depth_format *const format = ph_depth_formats[i];
        if (strlen(format->name) == n && memcmp(format->name, text, n) == 0 &&
            (end == NULL || format->coding == PH_DEPTH_IS_FLOAT)) {
            *out = (struct option_depth){format, (uint8_t)(end != NULL ? end[2] - '0' : 0)};
            return true;
        }
    }
    return false;
}

const char *option_text_depth_name(struct option_depth depth, char text[OPTION_DEPTH_NAME])
{
    const int n = snprintf(text, OPTION_DEPTH_NAME, "%s", depth.format->name);
    if (depth.exponent != 0) {
        snprintf(text + n, (size_t)(OPTION_DEPTH_NAME - n), "-e%u", (unsigned)depth.exponent);
    }
    return text;
}

bool option_text_ends(const char *name, const char *ending)
{
    const size_t n = strlen(name), m = strlen(ending);
    return n > m && strcmp(name + n - m, ending) == 0;
}
