/* See depth_table.h. Reads the CSV twice: once for the widths of the columns, once to print it. */
#include "depth_table.h"

#include "json_text.h"

#include <stdbool.h>
#include <string.h>

#define COLUMNS_MAX 24
#define CELL_SIZE   256

/* Widens the columns to fit a line. A cell ends at a comma or at the end of the line. */
static void measure(const char *line, size_t width[COLUMNS_MAX])
{
    for (int column = 0; column < COLUMNS_MAX; column++) {
        const size_t n = strcspn(line, ",\n");
        width[column] = n > width[column] ? n : width[column];
        line += n;
        if (*line++ != ',') {
            return;
        }
    }
}

/* Prints a line; the first column is text and stands on the left. */
static void print_line(FILE *file, const char *line, const size_t width[COLUMNS_MAX])
{
    for (int column = 0; column < COLUMNS_MAX; column++) {
        const size_t n = strcspn(line, ",\n");
        const int pad = (int)(width[column] - n);
        if (column == 0) {
            fprintf(file, "%.*s%*s", (int)n, line, pad, "");
        } else {
            fprintf(file, "  %*s%.*s", pad, "", (int)n, line);
        }
        line += n;
        if (*line++ != ',') {
            break;
        }
    }
    fputc('\n', file);
}

static const char *next_line(const char *line)
{
    const char *end = strchr(line, '\n');
    return end != NULL ? end + 1 : line + strlen(line);
}

/* Prints the remarks that begin with this mark, without it. */
static void print_remarks(FILE *file, const char *csv, const char *mark)
{
    for (const char *line = csv; *line != '\0'; line = next_line(line)) {
        if (strncmp(line, mark, strlen(mark)) == 0) {
            const char *text = line + strlen(mark) + strspn(line + strlen(mark), " ");
            fprintf(file, "%.*s\n", (int)strcspn(text, "\n"), text);
        }
    }
}

void depth_table_print(FILE *file, const char *csv, const char *headings)
{
    size_t width[COLUMNS_MAX] = {0};
    const char *rows = headings != NULL ? next_line(csv) : csv;
    if (headings != NULL) {
        measure(headings, width);
    }
    for (const char *line = rows; *line != '\0'; line = next_line(line)) {
        if (*line != '#') {
            measure(line, width);
        }
    }
    print_remarks(file, csv, "#!");
    if (headings != NULL) {
        print_line(file, headings, width);
    }
    for (const char *line = rows; *line != '\0'; line = next_line(line)) {
        if (*line != '#') {
            print_line(file, line, width);
        }
    }
    print_remarks(file, csv, "# ");
}

/* Is the text a number of JSON? -1.5e-05 is one; .5, 07 and inf are none. */
static bool is_number(const char *text)
{
    const char *at = text + (*text == '-');
    const size_t whole = strspn(at, "0123456789");
    if (whole == 0 || (at[0] == '0' && whole > 1)) {
        return false;
    }
    at += whole;
    if (*at == '.') {
        const size_t part = strspn(at + 1, "0123456789");
        at += part > 0 ? part + 1 : 0;
    }
    if (*at == 'e' || *at == 'E') {
        const char *power = at + 1 + (at[1] == '-' || at[1] == '+');
        const size_t digits = strspn(power, "0123456789");
        at = digits > 0 ? power + digits : at;
    }
    return *at == '\0';
}

/* The text of cell number `column` of the line, cut to what fits. */
static void cell(const char *line, int column, char text[CELL_SIZE])
{
    while (column > 0 && *line != '\0' && *line != '\n') {
        column -= *line++ == ',';
    }
    const size_t n = strcspn(line, ",\n");
    snprintf(text, CELL_SIZE, "%.*s", (int)n, line);
}

static void print_object(FILE *file, const char *names, const char *line)
{
    char name[CELL_SIZE], value[CELL_SIZE];
    int columns = 1;
    for (const char *at = names; *at != '\n' && *at != '\0'; at++) {
        columns += *at == ',';
    }
    for (int i = 0; i < columns; i++) {
        cell(names, i, name);
        cell(line, i, value);
        fputs(i == 0 ? "{" : ", ", file);
        json_text(file, name);
        fputs(": ", file);
        if (is_number(value) || value[0] == '\0') {
            fputs(value[0] != '\0' ? value : "null", file);
        } else {
            json_text(file, value);
        }
    }
    fputc('}', file);
}

void depth_table_json(FILE *file, const char *csv)
{
    const char *separator = "[\n";
    for (const char *line = next_line(csv); *line != '\0'; line = next_line(line)) {
        if (*line != '#') {
            fputs(separator, file);
            print_object(file, csv, line);
            separator = ",\n";
        }
    }
    fputs(separator[0] == '[' ? "[]\n" : "\n]\n", file);
}

void depth_table_drop_remarks(char *csv)
{
    char *to = csv;
    for (const char *line = csv; *line != '\0';) {
        const char *end = strchr(line, '\n');
        const size_t n = end != NULL ? (size_t)(end - line) + 1 : strlen(line);
        if (*line != '#') {
            memmove(to, line, n);
            to += n;
        }
        line += n;
    }
    *to = '\0';
}
