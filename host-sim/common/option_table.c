/* See option_table.h. A name that is not in the table is refused with the nearest one that is. */
#include "option_table.h"

#include "complain.h"
#include "option_text.h"

#include <stdio.h>
#include <string.h>

static bool is_name(const char *name, const char *text, size_t length)
{
    return name != NULL && strlen(name) == length && memcmp(name, text, length) == 0;
}

const struct option_row *option_table_find(const struct option_table *table, const char *text)
{
    const size_t length = strcspn(text, "=");
    for (size_t i = 0; i < table->count && strncmp(text, "--", 2) == 0; i++) {
        const struct option_row *row = &table->rows[i];
        if (is_name(row->name, text + 2, length - 2) || is_name(row->alias, text + 2, length - 2)) {
            return row;
        }
    }
    return NULL;
}

/* Whether `words` with | between them has this one. */
static bool has_word(const char *words, const char *word)
{
    for (const char *at = words; at != NULL; at = strchr(at, '|'), at += at != NULL) {
        if (strcspn(at, "|") == strlen(word) && strncmp(at, word, strlen(word)) == 0) {
            return true;
        }
    }
    return false;
}

static const char *row_name(const void *from, size_t i)
{
    const struct option_table *table = from;
    const struct option_row *row = &table->rows[i / 2];
    return i / 2 >= table->count ? NULL : i % 2 != 0 && row->alias != NULL ? row->alias : row->name;
}

/* Returns "did you mean --NAME? ", or an empty text. Of an option whose other name is nearest it has the main name. */
static const char *suggest(const struct option_table *table, const char *text)
{
    static char hint[96];
    char name[64];
    snprintf(name, sizeof name, "%.*s", (int)(strcspn(text, "=") < 60 ? strcspn(text, "=") : 60), text);
    const char *const near = strncmp(name, "--", 2) == 0 ? nearest_name(name + 2, row_name, table) : NULL;
    if (near == NULL) {
        return "";
    }
    snprintf(name, sizeof name, "--%.60s", near);
    snprintf(hint, sizeof hint, "did you mean --%s? ", option_table_find(table, name)->name);
    return hint;
}

static bool store(const struct option_row *row, void *options, const char *value)
{
    void *at = (char *)options + row->at;
    if (row->set != NULL) {
        return row->set(options, value);
    }
    if (row->most != 0) {
        return option_text_u32(value, row->least, row->most, at);
    }
    if (value == NULL) {
        *(bool *)at = true;
        return true;
    }
    *(const char **)at = value;
    return row->check != NULL ? row->check(value) : row->words != NULL ? has_word(row->words, value) : *value != '\0';
}

int option_table_read(const struct option_table *table, void *options, int argc, char *const argv[], int i)
{
    const char *text = strcmp(argv[i], "-h") == 0 ? "--help" : argv[i];
    const struct option_row *row = option_table_find(table, text);
    if (row == NULL) {
        return complain_usage("%s: no such option; %s--help lists them", text, suggest(table, text));
    }
    const char *equals = strchr(text, '='), *value = equals != NULL ? equals + 1 : NULL;
    const char *const name = is_name(row->name, text + 2, strcspn(text, "=") - 2) ? row->name : row->alias;
    if (row->argument == NULL && value != NULL) {
        return complain_usage("--%s takes no value", name);
    }
    const bool optional = row->argument != NULL && row->argument[0] == '[';
    if (optional && value == NULL && i + 1 < argc && argv[i + 1][0] != '-') {
        value = argv[++i];
    } else if (row->argument != NULL && !optional && value == NULL) {
        value = ++i < argc ? argv[i] : NULL;
        if (value == NULL) {
            return complain_usage("--%s needs a value: %s", name, row->argument);
        }
    }
    if (!store(row, options, value)) {
        const char *const meant = row->names != NULL ? nearest_text(value, row->names, NULL) : "";
        return complain_usage("--%s '%s': must be %s%s%.*s", name, value, row->allowed, *meant != '\0' ? "; " : "",
                              *meant != '\0' ? (int)strlen(meant) - 1 : 0, meant);
    }
    return i + 1;
}

int option_table_words(const struct option_table *table, void *options, int argc, char *const argv[],
                       const char *words[], int most)
{
    int count = 0;
    for (int i = 1; i < argc;) {
        if (argv[i][0] == '-') {
            i = option_table_read(table, options, argc, argv, i);
            if (i < 0) {
                return i;
            }
        } else if (count == most) {
            return complain_usage("'%s': a word too many; see --help", argv[i]);
        } else {
            words[count++] = argv[i++];
        }
    }
    return count;
}

void option_table_help(const struct option_table *table)
{
    for (size_t i = 0; i < table->count; i++) {
        const struct option_row *row = &table->rows[i];
        printf("  --%s%s%s\n        %s\n", row->name, row->argument ? " " : "", row->argument ? row->argument : "",
               row->help);
        if (row->allowed != NULL) {
            printf("        takes: %s\n", row->allowed);
        }
        if (row->alias != NULL) {
            printf("        also: --%s\n", row->alias);
        }
    }
    puts("  --version\n        as the only word: prints the version"); /* complain_begin() answers it */
}
