/* See model_text.h. */
#define _DEFAULT_SOURCE /* strncasecmp */

#include "model_text.h"

#include "model.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

char *model_text_load(const char *path, size_t *n)
{
    FILE *file = fopen(path, "rb");
    const long size = file != NULL && fseek(file, 0, SEEK_END) == 0 ? ftell(file) : -1;
    char *bytes = size >= 0 && size <= (long)MODEL_FILE_MAX ? malloc((size_t)size + 1) : NULL;
    if (bytes != NULL) {
        rewind(file);
        *n = fread(bytes, 1, (size_t)size, file);
        bytes[*n] = '\0';
    }
    if (file != NULL) {
        fclose(file);
    }
    return bytes;
}

static bool is_end_of_line(char c)
{
    return c == '\n' || c == '\r';
}

static bool is_space(char c)
{
    return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

/* How many bytes the end of a line takes at a place: 0, 1 or 2. */
static size_t line_end(const struct model_text *text, const char *at)
{
    return at == text->end || !is_end_of_line(*at) ? 0 : at + 1 < text->end && at[0] == '\r' && at[1] == '\n' ? 2 : 1;
}

static void skip_space(struct model_text *text)
{
    for (;;) {
        const size_t joined =
            text->is_joined && text->at < text->end && *text->at == '\\' ? line_end(text, text->at + 1) : 0;
        if (joined > 0) {
            text->at += 1 + joined;
            text->line++;
        } else if (text->at < text->end && is_space(*text->at)) {
            text->at++;
        } else {
            return;
        }
    }
}

bool model_text_word(struct model_text *text, struct model_word *word)
{
    skip_space(text);
    word->text = text->at;
    while (text->at < text->end && !is_space(*text->at) && !is_end_of_line(*text->at) &&
           !(text->is_joined && *text->at == '\\' && line_end(text, text->at + 1) > 0)) {
        text->at++;
    }
    word->n = (size_t)(text->at - word->text);
    return word->n > 0;
}

struct model_word model_text_rest(struct model_text *text)
{
    skip_space(text);
    struct model_word rest = {text->at, 0};
    while (text->at < text->end && !is_end_of_line(*text->at)) {
        text->at++;
    }
    rest.n = (size_t)(text->at - rest.text);
    while (rest.n > 0 && is_space(rest.text[rest.n - 1])) {
        rest.n--;
    }
    return rest;
}

bool model_text_next(struct model_text *text)
{
    struct model_word word;
    while (model_text_word(text, &word)) {
    }
    text->at += line_end(text, text->at);
    text->line++;
    return text->at < text->end;
}

bool model_text_any_word(struct model_text *text, struct model_word *word)
{
    while (!model_text_word(text, word)) {
        if (!model_text_next(text)) {
            return false;
        }
    }
    return true;
}

bool model_word_is(const struct model_word *word, const char *other)
{
    return strlen(other) == word->n && strncasecmp(word->text, other, word->n) == 0;
}

/* Reads a number: strtod and strtoll end at white space or at the 0 behind the text. */
bool model_word_number(const struct model_word *word, double *number)
{
    char *end;
    *number = strtod(word->text, &end);
    return word->n > 0 && end == word->text + word->n && memchr(word->text, 'x', word->n) == NULL &&
           memchr(word->text, 'X', word->n) == NULL;
}

bool model_word_whole(const struct model_word *word, int64_t *number)
{
    char *end;
    errno = 0;
    *number = strtoll(word->text, &end, 10);
    return word->n > 0 && end == word->text + word->n && errno == 0;
}

uint32_t model_text_numbers(struct model_text *text, uint32_t most, double *numbers)
{
    struct model_word word;
    uint32_t n = 0;
    while (n < most && model_text_word(text, &word) && model_word_number(&word, &numbers[n])) {
        n++;
    }
    return n;
}
