/* See model_ply.h. The header becomes a list of elements and properties, by which text and binary data are read
 * alike. */
#include "model_ply.h"

#include "model_bytes.h"
#include "model_mtl.h"
#include "model_polygon.h"
#include "model_text.h"
#include "model_weld.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- the header -------------------------------------------------------------------------------------------------- */

enum type { INT8, UINT8, INT16, UINT16, INT32, UINT32, FLOAT32, FLOAT64, TYPES };

static const struct {
    const char *names[2];
    uint8_t bytes;
    double most; /* what a colour of this type is divided by */
} types[TYPES] = {{{"char", "int8"}, 1, 127},        {{"uchar", "uint8"}, 1, 255},
                  {{"short", "int16"}, 2, 32767},    {{"ushort", "uint16"}, 2, 65535},
                  {{"int", "int32"}, 4, 2147483647}, {{"uint", "uint32"}, 4, 4294967295.0},
                  {{"float", "float32"}, 4, 1},      {{"double", "float64"}, 8, 1}};

/* What a property means. */
enum { X, Y, Z, NX, NY, NZ, RED, GREEN, BLUE, U, V, MEANINGS, INDICES = MEANINGS, UVS, NOTHING };

static const struct {
    const char *name;
    uint8_t meaning;
} meanings[] = {{"x", X},     {"y", Y},   {"z", Z},         {"nx", NX},   {"ny", NY},       {"nz", NZ},
                {"red", RED}, {"r", RED}, {"green", GREEN}, {"g", GREEN}, {"blue", BLUE},   {"b", BLUE},
                {"s", U},     {"t", V},   {"u", U},         {"v", V},     {"texture_u", U}, {"texture_v", V}};

#define PROPERTIES_MAX 64 /* of an element */
#define ELEMENTS_MAX   16

struct property {
    uint8_t type, count_type, meaning; /* count_type TYPES: it is no list */
};

enum kind { VERTEX, FACE, STRIPS, OTHER };

struct element {
    enum kind kind;
    uint64_t count;
    struct property properties[PROPERTIES_MAX];
    uint32_t property_count;
};

enum format { TEXT, LITTLE, BIG };

struct vertex {
    float of[MEANINGS];
};

struct corner {
    uint32_t vertex;
    float uv[2];
};

struct ply {
    struct model_shared *shared;
    struct model_text text; /* its end is the end of the file; binary data begin at `at`, too */
    const char *begin;
    enum format format;
    struct element elements[ELEMENTS_MAX];
    uint32_t element_count;
    struct model_word texture; /* n 0: none */
    bool has[MEANINGS], has_uvs_of_faces;
    struct vertex *vertices;
    uint32_t vertex_count;
    struct corner *corners; /* three for each triangle */
    uint32_t triangle_count;
};

/* Says what is broken, and in which line or at which byte. */
static bool fail_at(const struct ply *ply, const char *what)
{
    if (ply->format == TEXT) {
        return model_shared_failed(ply->shared, "is broken in line %u: %s: export it again", ply->text.line, what);
    }
    return model_shared_failed(ply->shared, "is broken at byte %zu: %s: export it again",
                               (size_t)(ply->text.at - ply->begin), what);
}

static bool read_type(struct model_text *text, uint8_t *type)
{
    struct model_word word;
    if (!model_text_word(text, &word)) {
        return false;
    }
    for (*type = 0; *type < TYPES; ++*type) {
        if (model_word_is(&word, types[*type].names[0]) || model_word_is(&word, types[*type].names[1])) {
            return true;
        }
    }
    return false;
}

static uint8_t meaning_of(const struct element *element, const struct property *property, const struct model_word *name)
{
    const bool is_list = property->count_type != TYPES;
    if (is_list) {
        return model_word_is(name, "vertex_indices") || model_word_is(name, "vertex_index") ? INDICES
               : model_word_is(name, "texcoord")                                            ? UVS
                                                                                            : NOTHING;
    }
    for (size_t i = 0; element->kind == VERTEX && i < sizeof meanings / sizeof meanings[0]; i++) {
        if (model_word_is(name, meanings[i].name)) {
            return meanings[i].meaning;
        }
    }
    return NOTHING;
}

static bool read_property(struct ply *ply)
{
    struct element *element = ply->element_count > 0 ? &ply->elements[ply->element_count - 1] : NULL;
    struct property property = {.count_type = TYPES};
    struct model_text before = ply->text;
    struct model_word word;
    if (element == NULL || element->property_count == PROPERTIES_MAX) {
        return fail_at(ply, "a property without an element, or more than 64");
    }
    if (model_text_word(&ply->text, &word) && model_word_is(&word, "list")) {
        if (!read_type(&ply->text, &property.count_type) || property.count_type >= FLOAT32) {
            return fail_at(ply, "a list without a type of count");
        }
    } else {
        ply->text = before;
    }
    if (!read_type(&ply->text, &property.type) || !model_text_word(&ply->text, &word)) {
        return fail_at(ply, "a property without a type or a name");
    }
    property.meaning = meaning_of(element, &property, &word);
    if (property.meaning < MEANINGS) {
        ply->has[property.meaning] = true;
    }
    element->properties[element->property_count++] = property;
    return true;
}

static bool read_element(struct ply *ply)
{
    struct model_word name, number;
    int64_t count = -1;
    if (ply->element_count == ELEMENTS_MAX || !model_text_word(&ply->text, &name) ||
        !model_text_word(&ply->text, &number) || !model_word_whole(&number, &count) || count < 0) {
        return fail_at(ply, "an element without a name or a count, or more than 16");
    }
    ply->elements[ply->element_count++] = (struct element){.kind = model_word_is(&name, "vertex")      ? VERTEX
                                                                   : model_word_is(&name, "face")      ? FACE
                                                                   : model_word_is(&name, "tristrips") ? STRIPS
                                                                                                       : OTHER,
                                                           .count = (uint64_t)count};
    return true;
}

static bool read_format(struct ply *ply, bool *is_known)
{
    struct model_word word;
    *is_known = true;
    if (!model_text_word(&ply->text, &word)) {
        return fail_at(ply, "a format without a name");
    }
    ply->format = model_word_is(&word, "binary_little_endian") ? LITTLE
                  : model_word_is(&word, "binary_big_endian")  ? BIG
                                                               : TEXT;
    return ply->format != TEXT || model_word_is(&word, "ascii") || fail_at(ply, "a format that is not known");
}

static void read_comment(struct ply *ply)
{
    struct model_word word;
    if (model_text_word(&ply->text, &word) && model_word_is(&word, "TextureFile")) {
        ply->texture = model_text_rest(&ply->text);
    }
}

/* Reads the header, up to the data. */
static bool read_header(struct ply *ply)
{
    struct model_word word;
    bool has_format = false;
    enum format format = TEXT;
    if (!model_text_word(&ply->text, &word) || !model_word_is(&word, "ply")) {
        return fail_at(ply, "a PLY begins with ply");
    }
    while (model_text_next(&ply->text)) {
        bool done = true;
        if (!model_text_word(&ply->text, &word) || model_word_is(&word, "obj_info")) {
            continue;
        }
        if (model_word_is(&word, "end_header")) {
            model_text_next(&ply->text);
            ply->format = format;
            return has_format || fail_at(ply, "a header without a format");
        }
        if (model_word_is(&word, "comment")) {
            read_comment(ply);
        } else if (model_word_is(&word, "format")) {
            done = read_format(ply, &has_format);
            format = ply->format;
            ply->format = TEXT; /* of the header's lines */
        } else if (model_word_is(&word, "element")) {
            done = read_element(ply);
        } else {
            done = model_word_is(&word, "property") ? read_property(ply) : fail_at(ply, "a word that no header has");
        }
        if (!done && ply->text.at < ply->text.end) {
            return false;
        }
    }
    return model_shared_failed(ply->shared, "is broken: a PLY header without its end: export it again");
}

/* ---- numbers ----------------------------------------------------------------------------------------------------- */

static double binary_number(const char *p, uint8_t type, bool is_big)
{
    switch (type) {
    case INT8:
        return (int8_t)*p;
    case UINT8:
        return (uint8_t)*p;
    case INT16:
        return (int16_t)model_bytes_u16(p, is_big);
    case UINT16:
        return model_bytes_u16(p, is_big);
    case INT32:
        return (int32_t)model_bytes_u32(p, is_big);
    case UINT32:
        return model_bytes_u32(p, is_big);
    case FLOAT32:
        return (double)model_bytes_float(p, is_big);
    default:
        return model_bytes_double(p, is_big);
    }
}

/* The next number of the data. */
static bool read_number(struct ply *ply, uint8_t type, double *to)
{
    struct model_word word;
    if (ply->format == TEXT) {
        return (model_text_any_word(&ply->text, &word) && model_word_number(&word, to)) ||
               fail_at(ply, "a number is missing");
    }
    if ((size_t)(ply->text.end - ply->text.at) < types[type].bytes) {
        return fail_at(ply, "the file ends before its last number");
    }
    *to = binary_number(ply->text.at, type, ply->format == BIG);
    ply->text.at += types[type].bytes;
    return true;
}

/* Reads how many numbers a list has, which the file must be long enough for. */
static bool read_count(struct ply *ply, const struct property *property, uint32_t *count)
{
    double number;
    const uint64_t left = (uint64_t)(ply->text.end - ply->text.at);
    if (!read_number(ply, property->count_type, &number)) {
        return false;
    }
    const double bytes = ply->format == TEXT ? 2 : types[property->type].bytes; /* a digit and white space */
    if (!(number >= 0 && number * bytes <= (double)left + 1) || number != floor(number)) {
        return fail_at(ply, "a list has a length that the file cannot hold");
    }
    *count = (uint32_t)number;
    return true;
}

/* Bytes of an element at least. */
static uint64_t least_bytes(const struct ply *ply, const struct element *element)
{
    uint64_t sum = 0;
    for (uint32_t i = 0; i < element->property_count; i++) {
        const struct property *p = &element->properties[i];
        sum += ply->format == TEXT ? 2 : types[p->count_type != TYPES ? p->count_type : p->type].bytes;
    }
    return sum;
}

/* ---- elements ---------------------------------------------------------------------------------------------------- */

/* The numbers of the lists of one element, by meaning from INDICES on; they are used again for the next. */
struct list {
    double *numbers;
    uint32_t count;
};

static bool read_list(struct ply *ply, const struct property *property, struct list *to)
{
    if (!read_count(ply, property, &to->count)) {
        return false;
    }
    double *more = realloc(to->numbers, sizeof *more * ((size_t)to->count + 1));
    if (more == NULL) {
        return model_shared_failed(ply->shared, "needs too much memory");
    }
    to->numbers = more;
    for (uint32_t i = 0; i < to->count; i++) {
        if (!read_number(ply, property->type, &more[i])) {
            return false;
        }
    }
    return true;
}

static void set_vertex(struct ply *ply, const struct property *property, double number)
{
    const bool is_colour = property->meaning >= RED && property->meaning <= BLUE;
    if (property->meaning < MEANINGS) {
        ply->vertices[ply->vertex_count].of[property->meaning] =
            (float)(is_colour ? number / types[property->type].most : number);
    }
}

static bool add_triangle(struct ply *ply, const struct corner *a, const struct corner *b, const struct corner *c)
{
    struct corner(*more)[3] = model_shared_grow(ply->corners, ply->triangle_count, sizeof *more);
    if (more == NULL) {
        return model_shared_failed(ply->shared, "needs too much memory");
    }
    ply->corners = more[0];
    more[ply->triangle_count][0] = *a;
    more[ply->triangle_count][1] = *b;
    more[ply->triangle_count++][2] = *c;
    return ply->triangle_count <= MODEL_TRIANGLES_MAX ||
           model_shared_failed(ply->shared, "has more than %u triangles, the limit", MODEL_TRIANGLES_MAX);
}

static bool set_corner_of(struct ply *ply, double index, struct corner *to)
{
    if (!(index >= 0 && index < ply->vertex_count) || index != floor(index)) {
        return fail_at(ply, "a face has a vertex that is not there");
    }
    to->vertex = (uint32_t)index;
    return true;
}

/* Cuts a face of n >= 3 corners. */
static bool add_face(struct ply *ply, const struct corner *corners, uint32_t n)
{
    float(*points)[3] = calloc(n, sizeof *points);
    uint32_t(*cut)[3] = calloc(n, sizeof *cut);
    bool done = points != NULL && cut != NULL;
    for (uint32_t i = 0; done && i < n; i++) {
        memcpy(points[i], &ply->vertices[corners[i].vertex].of[X], sizeof *points);
    }
    const bool is_cut = done && model_polygon_cut(points, n, cut);
    done = is_cut;
    for (uint32_t i = 0; done && i + 2 < n; i++) {
        done = add_triangle(ply, &corners[cut[i][0]], &corners[cut[i][1]], &corners[cut[i][2]]);
    }
    free(points);
    free(cut);
    return is_cut ? done : fail_at(ply, "a face that is not convex has too many corners");
}

static bool add_polygon(struct ply *ply, const struct list *indices, const struct list *uvs)
{
    const uint32_t n = indices->count;
    const bool has_uvs = uvs->count == 2 * (uint64_t)n;
    if (n < 3) {
        return true; /* a point or a line */
    }
    struct corner *corners = calloc(n, sizeof *corners);
    if (corners == NULL) {
        return model_shared_failed(ply->shared, "needs too much memory");
    }
    bool done = true;
    for (uint32_t i = 0; done && i < n; i++) {
        done = set_corner_of(ply, indices->numbers[i], &corners[i]);
        for (uint32_t k = 0; has_uvs && k < 2; k++) {
            corners[i].uv[k] = (float)uvs->numbers[2 * (size_t)i + k];
        }
    }
    ply->has_uvs_of_faces = ply->has_uvs_of_faces || has_uvs;
    done = done && (n == 3 ? add_triangle(ply, &corners[0], &corners[1], &corners[2]) : add_face(ply, corners, n));
    free(corners);
    return done;
}

static bool add_strips(struct ply *ply, const struct list *strips)
{
    const double *const indices = strips->numbers;
    uint32_t length = 0; /* of the strip so far */
    for (uint32_t i = 0; i < strips->count; i++) {
        struct corner corner[3] = {{.vertex = 0}};
        length = indices[i] == -1 ? 0 : length + 1;
        for (uint32_t k = 0; k < 3 && length >= 3; k++) {
            if (!set_corner_of(ply, indices[i - 2 + k], &corner[k])) {
                return false;
            }
        }
        const bool is_odd = length % 2 == 0; /* every other one turns the other way */
        if (length >= 3 && !add_triangle(ply, &corner[is_odd ? 1 : 0], &corner[is_odd ? 0 : 1], &corner[2])) {
            return false;
        }
    }
    return true;
}

/* Reads one element; one of text is a line of its own. */
static bool read_one(struct ply *ply, const struct element *element, struct list *lists)
{
    struct model_word word;
    for (uint32_t i = 0; i < element->property_count; i++) {
        const struct property *p = &element->properties[i];
        double number = 0;
        if (p->count_type != TYPES) {
            if (!read_list(ply, p, &lists[p->meaning - INDICES])) {
                return false;
            }
        } else if (!read_number(ply, p->type, &number)) {
            return false;
        } else if (element->kind == VERTEX) {
            set_vertex(ply, p, number);
        }
    }
    if (ply->format == TEXT && model_text_word(&ply->text, &word)) {
        return fail_at(ply, "a line has more numbers than the header says");
    }
    ply->vertex_count += element->kind == VERTEX;
    return element->kind == FACE     ? add_polygon(ply, &lists[0], &lists[UVS - INDICES])
           : element->kind == STRIPS ? add_strips(ply, &lists[0])
                                     : true;
}

static bool read_elements(struct ply *ply, const struct element *element)
{
    const uint64_t least = least_bytes(ply, element), left = (uint64_t)(ply->text.end - ply->text.at) + 1;
    struct list lists[NOTHING - INDICES + 1] = {{.count = 0}};
    if (least == 0) {
        return true; /* it has no properties */
    }
    if (element->count > left / least) {
        return fail_at(ply, "the header says more elements than the file can hold");
    }
    if (element->kind == VERTEX) {
        if (ply->vertices != NULL) {
            return fail_at(ply, "the header has vertices twice");
        }
        ply->vertices = calloc(element->count + 1, sizeof *ply->vertices);
        if (ply->vertices == NULL) {
            return model_shared_failed(ply->shared, "needs too much memory");
        }
    }
    bool done = true;
    for (uint64_t i = 0; done && i < element->count; i++) {
        done = read_one(ply, element, lists);
    }
    for (int i = 0; i <= NOTHING - INDICES; i++) {
        free(lists[i].numbers);
    }
    return done;
}

/* ---- the mesh ---------------------------------------------------------------------------------------------------- */

static void set_corner(const void *context, size_t i, struct model_vertex *to)
{
    const struct ply *ply = context;
    const struct corner *corner = &ply->corners[i];
    const float *of = ply->vertices[corner->vertex].of;
    const float *uv = ply->has_uvs_of_faces ? corner->uv : &of[U];
    memcpy(to->position, &of[X], sizeof to->position);
    if (ply->has[NX]) {
        memcpy(to->normal, &of[NX], sizeof to->normal);
    }
    if (ply->has[RED]) {
        memcpy(to->colour, &of[RED], sizeof to->colour);
    }
    if (ply->has_uvs_of_faces || ply->has[U]) {
        to->uv[0] = uv[0];
        to->uv[1] = 1 - uv[1];
    }
}

static bool make_mesh(struct ply *ply, struct model_scene *scene)
{
    if (!model_mtl_white(ply->shared, scene, &ply->texture)) {
        return false;
    }
    return (model_weld(scene, &(struct model_triangles){.count = ply->triangle_count,
                                                        .has_normals = ply->has[NX],
                                                        .has_uvs = ply->has_uvs_of_faces || ply->has[U],
                                                        .has_colours = ply->has[RED],
                                                        .corner = set_corner,
                                                        .context = ply}) &&
            model_scene_one_node(scene)) ||
           model_shared_failed(ply->shared, "needs too much memory");
}

bool model_ply_read(struct model_shared *shared, struct model_scene *scene)
{
    size_t n = 0;
    const char *bytes = model_text_load(shared->folder.model, &n);
    struct ply *ply = calloc(1, sizeof *ply);
    if (bytes == NULL || ply == NULL) {
        return model_shared_failed(shared, "cannot be read, or needs too much memory");
    }
    *ply = (struct ply){.shared = shared, .begin = bytes, .text = {.at = bytes, .end = bytes + n, .line = 1}};
    bool done = read_header(ply);
    for (uint32_t i = 0; done && i < ply->element_count; i++) {
        done = read_elements(ply, &ply->elements[i]);
    }
    return done && make_mesh(ply, scene);
}
