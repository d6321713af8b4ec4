#include "depth_table.h"

#include <string.h>

#define COLUMNS_MAX 24

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
