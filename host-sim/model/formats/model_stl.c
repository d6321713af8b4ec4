/* See model_stl.h. Text and binary files become the same list of corners, three a triangle. */
#include "model_stl.h"

#include "model_bytes.h"
#include "model_mtl.h"
#include "model_normals.h"
#include "model_text.h"
#include "model_weld.h"

#include <stdlib.h>
#include <string.h>

#define HEAD        84 /* bytes: a comment of 80, and the count */
#define FACET       50 /* 12 numbers, of which the first three are the normal, and an attribute */
#define HAS_COLOUR  0x8000u
#define PLAIN_LIGHT .6f /* of facets without a colour where others have one */

/* Three corners for each triangle. */
struct facets {
    float (*corners)[3], (*normals)[3];
    float (*colours)[3]; /* of each triangle, or NULL */
    uint32_t count;
};

static void set_corner(const void *context, size_t i, struct model_vertex *to)
{
    const struct facets *from = context;
    memcpy(to->position, from->corners[i], sizeof to->position);
    memcpy(to->normal, from->normals[i], sizeof to->normal);
    if (from->colours != NULL) {
        memcpy(to->colour, from->colours[i / 3], sizeof to->colour);
    }
}

/* ---- binary ------------------------------------------------------------------------------------------------------ */

/* The colour of a facet: five bits a channel. Files with COLOR= in their head have red lowest, others blue. */
static bool read_colour(struct facets *to, uint32_t i, uint32_t attribute, bool is_red_first)
{
    if ((attribute & HAS_COLOUR) == 0) {
        return true;
    }
    if (to->colours == NULL) {
        to->colours = calloc(to->count, sizeof *to->colours);
        for (uint32_t k = 0; to->colours != NULL && k < 3 * to->count; k++) {
            to->colours[k / 3][k % 3] = PLAIN_LIGHT;
        }
    }
    for (int c = 0; to->colours != NULL && c < 3; c++) {
        to->colours[i][is_red_first ? c : 2 - c] = (float)(attribute >> 5 * c & 31) / 31;
    }
    return to->colours != NULL;
}

static bool has_colour_in_head(const char *bytes)
{
    for (int i = 0; i + 6 <= 80; i++) {
        if (memcmp(bytes + i, "COLOR=", 6) == 0) {
            return true;
        }
    }
    return false;
}

static bool read_binary(struct model_shared *shared, const char *bytes, size_t n, struct facets *to)
{
    const bool is_red_first = has_colour_in_head(bytes);
    const uint64_t said = model_bytes_u32(bytes + 80, false), held = (n - HEAD) / FACET;
    if (said > held) {
        return model_shared_failed(
            shared,
            "is broken at byte 80: its %u facets take %llu bytes, and the file has %zu: it is cut "
            "off: export it again",
            (unsigned)said, (unsigned long long)(HEAD + FACET * said), n);
    }
    const uint64_t count = said > 0 ? said : held;
    if (count > MODEL_TRIANGLES_MAX) {
        return model_shared_failed(shared, "has more than %u triangles, the limit", MODEL_TRIANGLES_MAX);
    }
    to->count = (uint32_t)count;
    to->corners = calloc(3 * (size_t)count + 1, sizeof *to->corners);
    bool done = to->corners != NULL;
    for (uint32_t i = 0; done && i < count; i++) {
        const char *facet = bytes + HEAD + (size_t)FACET * i;
        for (uint32_t k = 0; k < 9; k++) {
            to->corners[3 * (size_t)i + k / 3][k % 3] = model_bytes_float(facet + 12 + 4 * (size_t)k, false);
        }
        done = read_colour(to, i, model_bytes_u16(facet + 48, false), is_red_first);
    }
    return done || model_shared_failed(shared, "needs too much memory");
}

/* ---- text -------------------------------------------------------------------------------------------------------- */

static bool fail_at(struct model_shared *shared, const struct model_text *text, const char *what)
{
    return model_shared_failed(shared, "is broken in line %u: %s: export it again", text->line, what);
}

/* Reads the three numbers behind `vertex` as corner i of a facet. */
static bool read_vertex(struct model_shared *shared, struct model_text *text, struct facets *to, uint32_t i)
{
    double numbers[3];
    if (i >= 3) {
        return fail_at(shared, text, "a facet has more than 3 corners");
    }
    if (model_text_numbers(text, 3, numbers) < 3) {
        return fail_at(shared, text, "a corner needs 3 numbers");
    }
    for (int axis = 0; axis < 3; axis++) {
        to->corners[3 * (size_t)to->count + i][axis] = (float)numbers[axis];
    }
    return true;
}

/* Reads a facet behind its first word, up to `endfacet`. */
static bool read_facet(struct model_shared *shared, struct model_text *text, struct facets *to)
{
    struct model_word word;
    uint32_t corners = 0;
    float(*more)[9] = model_shared_grow(to->corners, to->count, sizeof *more);
    if (more == NULL) {
        return model_shared_failed(shared, "needs too much memory");
    }
    to->corners = (float(*)[3])more;
    model_text_rest(text); /* the normal */
    while (model_text_any_word(text, &word) && !model_word_is(&word, "endfacet")) {
        if (model_word_is(&word, "vertex")) {
            if (!read_vertex(shared, text, to, corners++)) {
                return false;
            }
        } else if (!model_word_is(&word, "outer") && !model_word_is(&word, "loop") &&
                   !model_word_is(&word, "endloop")) {
            return fail_at(shared, text, "a facet without its endfacet");
        }
    }
    to->count++;
    if (to->count > MODEL_TRIANGLES_MAX) {
        return model_shared_failed(shared, "has more than %u triangles, the limit", MODEL_TRIANGLES_MAX);
    }
    return corners == 3 || fail_at(shared, text, "a facet has less than 3 corners");
}

static bool read_text(struct model_shared *shared, const char *bytes, size_t n, struct facets *to)
{
    struct model_text text = {.at = bytes, .end = bytes + n, .line = 1};
    struct model_word word;
    while (model_text_any_word(&text, &word)) {
        if (model_word_is(&word, "facet")) {
            if (!read_facet(shared, &text, to)) {
                return false;
            }
        } else if (model_word_is(&word, "solid") || model_word_is(&word, "endsolid")) {
            model_text_rest(&text); /* the name */
        } else {
            return fail_at(shared, &text, "a word that is no facet");
        }
    }
    return true;
}

/* Binary files may begin with "solid", too: one with a 0 near its beginning is binary, or one that is exactly as long
 * as its count says. */
static bool is_text(const char *bytes, size_t n)
{
    struct model_text text = {.at = bytes, .end = bytes + n, .line = 1};
    struct model_word word;
    const bool fits = n >= HEAD && n - HEAD == FACET * (uint64_t)model_bytes_u32(bytes + 80, false);
    return !(fits && n > HEAD) && memchr(bytes, 0, n < 512 ? n : 512) == NULL && model_text_any_word(&text, &word) &&
           model_word_is(&word, "solid");
}

/* Makes the normals of all corners. false: no memory. */
static bool make_normals(struct facets *facets)
{
    const size_t n = 3 * (size_t)facets->count;
    float(*faces)[3] = calloc(n + 1, sizeof *faces);
    for (size_t i = 0; faces != NULL && i < n; i++) {
        float(*corners)[3] = &facets->corners[i - i % 3];
        model_normals_face(corners[0], corners[1], corners[2], faces[i]);
    }
    facets->normals = faces != NULL ? model_normals_make(facets->corners, faces, n) : NULL;
    free(faces);
    return facets->normals != NULL;
}

bool model_stl_read(struct model_shared *shared, struct model_scene *scene)
{
    size_t n = 0;
    char *bytes = model_text_load(shared->folder.model, &n);
    struct facets facets = {.count = 0};
    if (bytes == NULL) {
        return model_shared_failed(shared, "cannot be read, or needs too much memory");
    }
    const bool has_text = is_text(bytes, n);
    if (!has_text && n < HEAD) {
        return model_shared_failed(
            shared, "is broken: an STL has at least %d bytes, or begins with solid: export it again", HEAD);
    }
    if (!(has_text ? read_text : read_binary)(shared, bytes, n, &facets) || !model_mtl_plain(shared, scene)) {
        return false;
    }
    free(bytes);
    return (make_normals(&facets) &&
            model_weld(scene, &(struct model_triangles){.count = facets.count,
                                                        .has_normals = true,
                                                        .has_colours = facets.colours != NULL,
                                                        .corner = set_corner,
                                                        .context = &facets}) &&
            model_scene_one_node(scene)) ||
           model_shared_failed(shared, "needs too much memory");
}
