/* Requests in text: see lab_request.h. */
#include "lab_request.h"
#include "lab_num.h"

static bool same_word(const char *a, const char *b)
{
    while (*a == *b && *a != '\0') {
        a++;
        b++;
    }
    return *a == *b;
}

/* The rows of lab_formats called so, as bits. */
static uint32_t rows_called(const char *name)
{
    uint32_t rows = 0;
    for (uint32_t i = 0; i < lab_format_count; i++) {
        rows |= same_word(name, "all") || same_word(name, lab_formats[i].name) ? (uint32_t)1 << i : 0;
    }
    return rows;
}

static const char *without_spaces(const char *text)
{
    while (*text == ' ') {
        text++;
    }
    return text;
}

/* Returns the name of the format, or NULL. */
static const char *read_request(const char *line, struct lab *lab)
{
    const char *rest;
    if (fx_from_text(without_spaces(line), &lab->near_z, &rest) != 0 || *rest != ' ' ||
        fx_from_text(without_spaces(rest), &lab->far_z, &rest) != 0 || *rest != ' ') {
        return NULL;
    }
    const char *const name = without_spaces(rest);
    lab->formats = rows_called(name);
    return lab->formats != 0 && lab->near_z > 0 && lab->near_z < lab->far_z ? name : NULL;
}

int lab_request(const char *line, void *memory, size_t memory_bytes, lab_put *put, void *context)
{
    struct lab lab = {
        .count = LAB_REQUEST_COUNT, .memory = memory, .memory_bytes = memory_bytes, .put = put, .context = context};
    const char *const name = read_request(line, &lab);
    if (name == NULL) {
        return PH_ERR_INVAL;
    }
    const char *const words[] = {LAB_REQUEST_MARK, NULL, " ", NULL, " ", name, "\n"};
    for (int i = 0; i < 7; i++) {
        char text[LAB_TEXT_SIZE];
        if (words[i] == NULL) {
            lab_fx_text(i == 1 ? lab.near_z : lab.far_z, text);
        }
        put(context, words[i] != NULL ? words[i] : text);
    }
    int status = lab_pairs(&lab);
    status = status == 0 ? lab_resolve(&lab) : status;
    put(context, status == 0 ? "done\n" : "failed\n");
    return status;
}
