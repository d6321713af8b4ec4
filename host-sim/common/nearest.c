/* See nearest.h. The distance of two names is the count of letters to change, insert or remove (Levenshtein). */
#include "nearest.h"

#include <stdio.h>
#include <string.h>

#define NAME_BYTES 64

static size_t least(size_t a, size_t b)
{
    return a < b ? a : b;
}

/* The distance of Levenshtein, row by row of its table; both are shorter than NAME_BYTES. */
static size_t distance(const char *a, const char *b)
{
    size_t row[NAME_BYTES];
    const size_t n = strlen(b);
    for (size_t k = 0; k <= n; k++) {
        row[k] = k;
    }
    for (size_t i = 0; a[i] != '\0'; i++) {
        size_t before = row[0]++; /* one row up, one column to the left */
        for (size_t k = 0; k < n; k++) {
            const size_t above = row[k + 1];
            row[k + 1] = least(least(above, row[k]) + 1, before + (a[i] != b[k]));
            before = above;
        }
    }
    return row[n];
}

const char *nearest_name(const char *wrong, nearest_list *list, const void *from)
{
    const char *best = NULL, *name;
    size_t found = 0;
    for (size_t i = 0; strlen(wrong) < NAME_BYTES && (name = list(from, i)) != NULL; i++) {
        const size_t d = strlen(name) < NAME_BYTES ? distance(wrong, name) : NAME_BYTES;
        const size_t longer = strlen(name) > strlen(wrong) ? strlen(name) : strlen(wrong);
        if (3 * d <= longer && (best == NULL || d < found)) {
            best = name;
            found = d;
        }
    }
    return best;
}

const char *nearest_text(const char *wrong, nearest_list *list, const void *from)
{
    static char text[NAME_BYTES + 20];
    const char *const best = nearest_name(wrong, list, from);
    snprintf(text, sizeof text, "did you mean %s? ", best != NULL ? best : "");
    return best != NULL ? text : "";
}
