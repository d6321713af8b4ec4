/* pinhole-depth compare: a log of the depth image against the same measurements here, byte for byte. */
#define _XOPEN_SOURCE 700 /* open_memstream */

#include "complain.h"
#include "depth_lab.h"
#include "lab_request.h"
#include "progress.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#define MEMORY_BYTES ((size_t)1 << 20)

static void put_text(void *context, const char *text)
{
    fputs(text, context);
}

/* What the request in a line is answered here; to be freed, or NULL when one line has said why. */
static char *answer_of(const char *line)
{
    char request[64], *text = NULL;
    size_t length;
    void *const memory = malloc(MEMORY_BYTES);
    FILE *const file = open_memstream(&text, &length);
    snprintf(request, sizeof request, "%.*s", (int)strcspn(line, "\n"), line);
    int status =
        memory == NULL || file == NULL ? PH_ERR_NOMEM : lab_request(request, memory, MEMORY_BYTES, put_text, file);
    if (file != NULL && fclose(file) != 0) {
        status = PH_ERR_NOMEM;
    }
    free(memory);
    if (status != 0) {
        complain(status == PH_ERR_INVAL ? "compare: no such request: %s" : "compare: %s cannot be measured here",
                 request);
        free(text);
        return NULL;
    }
    return text;
}

/* Compares line by line; *lines: how many there are. */
static int compare_lines(const char *log, const char *here, unsigned *lines)
{
    for (*lines = 0; *here != '\0'; ++*lines) {
        const size_t n = strcspn(here, "\n") + 1;
        if (strncmp(log, here, n) != 0) {
            return complain("compare: line %u of the answer differs: `%.*s` there, `%.*s` here", *lines + 1,
                            (int)strcspn(log, "\n"), log, (int)n - 1, here);
        }
        log += n;
        here += n;
    }
    return 0;
}

/* A terminal may have written the ends of lines as CR LF. */
static void drop_returns(char *text)
{
    char *to = text;
    for (; *text != '\0'; text++) {
        if (*text != '\r') {
            *to++ = *text;
        }
    }
    *to = '\0';
}

static int compare_log(const struct depth_lab *lab, char *log)
{
    const size_t mark = strlen(LAB_REQUEST_MARK);
    unsigned requests = 0, lines;
    uint64_t line_number = 0, line_count = 0;
    drop_returns(log);
    for (const char *at = log; *at != '\0'; at++) {
        line_count += *at == '\n';
    }
    fputs("near,far,format,lines,verdict\n", lab->rows);
    for (const char *line = log; *line != '\0'; line += strcspn(line, "\n"), line += *line == '\n', line_number++) {
        if (strncmp(line, LAB_REQUEST_MARK, mark) != 0) {
            continue;
        }
        progress_show("compare: line", line_number, line_count);
        char *const here = answer_of(line + mark), near_text[32], far_text[32], format[32];
        const int status = here == NULL ? COMPLAINED : compare_lines(line, here, &lines);
        free(here);
        if (status != 0) {
            return status;
        }
        sscanf(line + mark, "%31s %31s %31s", near_text, far_text, format);
        fprintf(lab->rows, "%s,%s,%s,%u,same\n", near_text, far_text, format, lines);
        requests++;
    }
    progress_show("compare", 1, 1);
    return requests > 0
               ? 0
               : complain("compare: the log has no answer; one begins with `" LAB_REQUEST_MARK "0.1 1000 float16`");
}

/* Returns all of a stream, to be freed, or NULL. */
static char *read_all(FILE *from)
{
    char *text = NULL, piece[4096];
    size_t length, n;
    FILE *const to = open_memstream(&text, &length);
    while (to != NULL && (n = fread(piece, 1, sizeof piece, from)) > 0) {
        fwrite(piece, 1, n, to);
    }
    const bool is_whole = to != NULL && fclose(to) == 0 && !ferror(from);
    if (!is_whole) {
        free(text);
    }
    return is_whole ? text : NULL;
}

int depth_compare(const struct depth_lab *lab)
{
    const bool is_stdin = strcmp(lab->kind, "-") == 0;
    FILE *const file = is_stdin ? stdin : fopen(lab->kind, "r");
    if (file == NULL) {
        return complain("%s: cannot be read: %s", lab->kind, strerror(errno));
    }
    char *const log = read_all(file);
    if (!is_stdin) {
        fclose(file);
    }
    const int status = log != NULL ? compare_log(lab, log) : complain("%s: cannot be read", lab->kind);
    free(log);
    return status;
}
