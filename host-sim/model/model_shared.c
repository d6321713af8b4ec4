/* See model_shared.h. */
#define _DEFAULT_SOURCE /* strcasecmp */

#include "model_shared.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

bool model_shared_failed(struct model_shared *shared, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(shared->error, sizeof shared->error, format, arguments);
    va_end(arguments);
    return false;
}

void model_shared_note(struct model_shared *shared, const char *format, ...)
{
    char text[sizeof shared->note];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    const size_t used = strlen(shared->note);
    if (strstr(shared->note, text) == NULL && used + strlen(text) + 3 <= sizeof shared->note) {
        snprintf(shared->note + used, sizeof shared->note - used, "%s%s", used > 0 ? "; " : "", text);
    }
}

bool model_shared_ends(const struct model_shared *shared, const char *ending)
{
    const size_t n = strlen(shared->folder.model), m = strlen(ending);
    return n >= m && strcasecmp(shared->folder.model + n - m, ending) == 0;
}

void *model_shared_grow(void *list, size_t count, size_t bytes)
{
    if (list != NULL && (count < 16 || (count & (count - 1)) != 0)) {
        return list;
    }
    return realloc(list, (count < 16 ? 16 : 2 * count) * bytes);
}
