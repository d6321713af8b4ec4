#include "option_table.h"

#include "complain.h"

#include <stdio.h>
#include <string.h>

static const struct option_row *find(const struct option_table *table, const char *name, size_t length)
{
    for (size_t i = 0; i < table->count; i++) {
        const char *known = table->rows[i].name;
        if (strlen(known) == length && memcmp(known, name, length) == 0) {
            return &table->rows[i];
        }
    }
    return NULL;
}

int option_table_read(const struct option_table *table, void *options, int argc, char *const argv[], int i)
{
    const char *text = strcmp(argv[i], "-h") == 0 ? "--help" : argv[i];
    const size_t length = strcspn(text, "=");
    const bool dashes = strncmp(text, "--", 2) == 0 && length > 2;
    const struct option_row *row = dashes ? find(table, text + 2, length - 2) : NULL;
    if (row == NULL) {
        complain(EXIT_USAGE, "%s: no such option; --help lists them", text);
        return 0;
    }
    const char *value = text[length] == '=' ? text + length + 1 : NULL;
    if (row->argument == NULL && value != NULL) {
        complain(EXIT_USAGE, "--%s takes no value", row->name);
        return 0;
    }
    const bool optional = row->argument != NULL && row->argument[0] == '[';
    if (optional && value == NULL && i + 1 < argc && argv[i + 1][0] != '-') {
        value = argv[++i];
    } else if (row->argument != NULL && !optional && value == NULL) {
        value = ++i < argc ? argv[i] : NULL;
        if (value == NULL) {
            complain(EXIT_USAGE, "--%s needs a value: %s", row->name, row->argument);
            return 0;
        }
    }
    if (!row->set(options, value)) {
        complain(EXIT_USAGE, "--%s '%s': must be %s", row->name, value, row->allowed);
        return 0;
    }
    return i + 1;
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
    }
}
