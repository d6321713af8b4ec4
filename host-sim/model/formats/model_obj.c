/* See model_obj.h. The lists of the file are read first; then the polygons of each material become a mesh. */
#include "model_obj.h"

#include "model_mtl.h"
#include "model_normals.h"
#include "model_polygon.h"
#include "model_text.h"
#include "model_weld.h"

#include <stdlib.h>
#include <string.h>

/* Indices into the lists of the file; MODEL_NONE: it has none. */
struct corner {
    uint32_t position, uv, normal;
};

struct polygon {
    uint32_t first, count; /* corners */
    uint32_t line;
};

/* Polygons that become one mesh. */
struct run {
    uint32_t first; /* polygon */
    uint32_t material;
};

/* What the file has so far. */
struct obj {
    struct model_shared *shared;
    struct model_text text;
    float (*positions)[3], (*colours)[3], (*uvs)[2], (*normals)[3];
    struct corner *corners;
    struct polygon *polygons;
    struct run *runs; /* the last one is open */
    struct model_mtls mtls;
    struct model_word group; /* the last g */
    uint32_t position_count, uv_count, normal_count, corner_count, polygon_count, run_count;
    uint64_t triangle_count;
    bool has_colours;
};

static bool no_memory(const struct obj *obj)
{
    return model_shared_failed(obj->shared, "needs too much memory");
}

/* ---- lines ------------------------------------------------------------------------------------------------------- */

static bool add_position(struct obj *obj)
{
    double n[6];
    const uint32_t count = model_text_numbers(&obj->text, 6, n);
    float(*more)[3] = model_shared_grow(obj->positions, obj->position_count, sizeof *more);
    obj->positions = more != NULL ? more : obj->positions;
    float(*colours)[3] = model_shared_grow(obj->colours, obj->position_count, sizeof *colours);
    obj->colours = colours != NULL ? colours : obj->colours;
    if (more == NULL || colours == NULL) {
        return no_memory(obj);
    }
    if (count < 3) {
        return model_shared_failed(obj->shared,
                                   "is broken in line %u: a vertex needs 3 numbers and has %u: export it again",
                                   obj->text.line, count);
    }
    for (int i = 0; i < 3; i++) {
        more[obj->position_count][i] = (float)(count == 4 ? n[i] / n[3] : n[i]);
        colours[obj->position_count][i] = count == 6 ? (float)n[3 + i] : 1;
    }
    obj->has_colours = obj->has_colours || count == 6;
    obj->position_count++;
    return true;
}

static bool add_uv(struct obj *obj)
{
    double n[2] = {0, 0};
    float(*more)[2] = model_shared_grow(obj->uvs, obj->uv_count, sizeof *more);
    obj->uvs = more != NULL ? more : obj->uvs;
    if (more == NULL) {
        return no_memory(obj);
    }
    if (model_text_numbers(&obj->text, 2, n) == 0) {
        return model_shared_failed(obj->shared,
                                   "is broken in line %u: a texture coordinate without a number: export it again",
                                   obj->text.line);
    }
    more[obj->uv_count][0] = (float)n[0];
    more[obj->uv_count++][1] = (float)n[1];
    return true;
}

static bool add_normal(struct obj *obj)
{
    double n[3];
    float(*more)[3] = model_shared_grow(obj->normals, obj->normal_count, sizeof *more);
    obj->normals = more != NULL ? more : obj->normals;
    if (more == NULL) {
        return no_memory(obj);
    }
    const uint32_t count = model_text_numbers(&obj->text, 3, n);
    if (count < 3) {
        return model_shared_failed(obj->shared,
                                   "is broken in line %u: a normal needs 3 numbers and has %u: export it again",
                                   obj->text.line, count);
    }
    for (int i = 0; i < 3; i++) {
        more[obj->normal_count][i] = (float)n[i];
    }
    obj->normal_count++;
    return true;
}

/* Reads one of the indices of v/vt/vn; one below 0 counts from the end of the list so far. */
static bool read_index(const char **at, uint32_t count, uint32_t *index)
{
    char *end;
    const long long value = **at == '-' || (**at >= '0' && **at <= '9') ? strtoll(*at, &end, 10) : 0;
    if (value == 0 || value > UINT32_MAX - 1 || value < -(long long)count) {
        return false;
    }
    *at = end;
    *index = (uint32_t)(value > 0 ? value - 1 : count + value);
    return true;
}

static bool read_corner(const struct obj *obj, const struct model_word *word, struct corner *to)
{
    const char *at = word->text, *const end = word->text + word->n;
    *to = (struct corner){MODEL_NONE, MODEL_NONE, MODEL_NONE};
    if (!read_index(&at, obj->position_count, &to->position)) {
        return false;
    }
    if (at < end && *at == '/' && at + 1 < end && *++at != '/' && !read_index(&at, obj->uv_count, &to->uv)) {
        return false;
    }
    if (at < end && *at == '/' && at + 1 < end) {
        at++;
        if (!read_index(&at, obj->normal_count, &to->normal)) {
            return false;
        }
    }
    at += at < end && *at == '/' && at + 1 == end; /* some write v/ or v// */
    return at == end;
}

static bool add_polygon(struct obj *obj)
{
    struct polygon polygon = {.first = obj->corner_count, .line = obj->text.line};
    struct model_word word;
    while (model_text_word(&obj->text, &word) && word.text[0] != '#') {
        struct corner *more = model_shared_grow(obj->corners, obj->corner_count, sizeof *more);
        if (more == NULL) {
            return no_memory(obj);
        }
        obj->corners = more;
        if (!read_corner(obj, &word, &more[obj->corner_count])) {
            return model_shared_failed(obj->shared,
                                       "is broken in line %u: %.*s is no corner of a face: export it again",
                                       obj->text.line, (int)(word.n < 40 ? word.n : 40), word.text);
        }
        obj->corner_count++;
        polygon.count++;
    }
    if (polygon.count < 3) { /* a point or a line */
        obj->corner_count = polygon.first;
        return true;
    }
    struct polygon *more = model_shared_grow(obj->polygons, obj->polygon_count, sizeof *more);
    if (more == NULL) {
        return no_memory(obj);
    }
    obj->polygons = more;
    obj->polygons[obj->polygon_count++] = polygon;
    obj->triangle_count += polygon.count - 2;
    return obj->triangle_count <= MODEL_TRIANGLES_MAX ||
           model_shared_failed(obj->shared, "has more than %u triangles, the limit", MODEL_TRIANGLES_MAX);
}

/* Begins a run with this material, unless the last one is empty: then that has it. */
static bool begin_run(struct obj *obj, uint32_t material)
{
    if (obj->run_count > 0 && obj->runs[obj->run_count - 1].first == obj->polygon_count) {
        obj->runs[obj->run_count - 1].material = material;
        return true;
    }
    struct run *more = model_shared_grow(obj->runs, obj->run_count, sizeof *more);
    if (more == NULL) {
        return no_memory(obj);
    }
    obj->runs = more;
    obj->runs[obj->run_count++] = (struct run){obj->polygon_count, material};
    return true;
}

static bool use_material(struct obj *obj, struct model_scene *scene)
{
    const struct model_word name = model_text_rest(&obj->text);
    uint32_t i = 1; /* 0 has no name */
    while (i < obj->mtls.count &&
           (obj->mtls.list[i].name.n != name.n || memcmp(obj->mtls.list[i].name.text, name.text, name.n) != 0)) {
        i++;
    }
    if (i == obj->mtls.count && !model_mtl_add_plain(obj->shared, scene, &obj->mtls, &name)) {
        return false;
    }
    return obj->runs[obj->run_count - 1].material == i || begin_run(obj, i);
}

static bool begin_group(struct obj *obj, bool is_object)
{
    const struct model_word name = model_text_rest(&obj->text);
    const bool is_same = !is_object && name.n == obj->group.n && memcmp(name.text, obj->group.text, name.n) == 0;
    obj->group = is_object ? obj->group : name;
    return is_same || begin_run(obj, obj->runs[obj->run_count - 1].material);
}

static bool read_line(struct obj *obj, struct model_scene *scene)
{
    struct model_word key;
    if (!model_text_word(&obj->text, &key)) {
        return true;
    }
    if (model_word_is(&key, "v")) {
        return add_position(obj);
    }
    if (model_word_is(&key, "vt")) {
        return add_uv(obj);
    }
    if (model_word_is(&key, "vn")) {
        return add_normal(obj);
    }
    if (model_word_is(&key, "f")) {
        return add_polygon(obj);
    }
    if (model_word_is(&key, "usemtl")) {
        return use_material(obj, scene);
    }
    if (model_word_is(&key, "mtllib")) {
        const struct model_word name = model_text_rest(&obj->text);
        return model_mtl_read(obj->shared, scene, &obj->mtls, &name);
    }
    return (!model_word_is(&key, "o") && !model_word_is(&key, "g")) || begin_group(obj, model_word_is(&key, "o"));
}

/* ---- meshes ------------------------------------------------------------------------------------------------------ */

/* The polygons of a run as triangles. Corners are numbers of obj->corners; `first` is that of the run's first one. */
struct triangles {
    const struct obj *obj;
    const struct model_mtl *mtl;
    uint32_t (*corners)[3];
    uint32_t count, first;
    float (*positions)[3], (*faces)[3], (*normals)[3]; /* of each corner from `first` on; normals may be NULL */
    bool has_uvs;
};

static void set_corner(const void *context, size_t i, struct model_vertex *to)
{
    const struct triangles *t = context;
    const struct obj *obj = t->obj;
    const uint32_t at = t->corners[i / 3][i % 3];
    const struct corner *c = &obj->corners[at];
    memcpy(to->position, obj->positions[c->position], sizeof to->position);
    memcpy(to->normal, c->normal != MODEL_NONE ? obj->normals[c->normal] : t->normals[at - t->first],
           sizeof to->normal);
    if (t->has_uvs) {
        const float none[2] = {0, 0}, *uv = c->uv != MODEL_NONE ? obj->uvs[c->uv] : none;
        to->uv[0] = (float)((double)uv[0] * t->mtl->scale[0] + t->mtl->offset[0]);
        to->uv[1] = 1 - (float)((double)uv[1] * t->mtl->scale[1] + t->mtl->offset[1]);
    }
    if (obj->has_colours) {
        memcpy(to->colour, obj->colours[c->position], sizeof to->colour);
    }
}

static bool has_corners(const struct obj *obj, const struct polygon *polygon)
{
    for (uint32_t i = polygon->first; i < polygon->first + polygon->count; i++) {
        const struct corner *c = &obj->corners[i];
        if (c->position >= obj->position_count || (c->uv != MODEL_NONE && c->uv >= obj->uv_count) ||
            (c->normal != MODEL_NONE && c->normal >= obj->normal_count)) {
            return model_shared_failed(obj->shared,
                                       "is broken in line %u: a face has a vertex that is not there: export it again",
                                       polygon->line);
        }
    }
    return true;
}

/* Cuts a polygon; its triangles go behind those that are there. */
static bool cut_polygon(const struct polygon *polygon, struct triangles *to)
{
    const struct obj *obj = to->obj;
    uint32_t(*cut)[3] = &to->corners[to->count];
    float(*positions)[3] = &to->positions[polygon->first - to->first],
    (*faces)[3] = &to->faces[polygon->first - to->first];
    for (uint32_t i = 0; i < polygon->count; i++) {
        const struct corner *c = &obj->corners[polygon->first + i];
        memcpy(positions[i], obj->positions[c->position], sizeof *positions);
        to->has_uvs = to->has_uvs || c->uv != MODEL_NONE;
    }
    if (!model_polygon_cut(positions, polygon->count, cut)) {
        return model_shared_failed(obj->shared,
                                   "has a face in line %u that cannot be cut into triangles: of one that is not convex "
                                   "at most %u corners are read",
                                   polygon->line, MODEL_POLYGON_MAX);
    }
    for (uint32_t t = 0; t < polygon->count - 2; t++) {
        float normal[3];
        model_normals_face(positions[cut[t][0]], positions[cut[t][1]], positions[cut[t][2]], normal);
        for (int i = 0; i < 3; i++) {
            memcpy(faces[cut[t][i]], normal, sizeof normal); /* a bent face has that of its last triangle there */
            cut[t][i] += polygon->first;
        }
    }
    to->count += polygon->count - 2;
    return true;
}

/* Makes normals if a corner of the run has none. false: no memory. */
static bool make_normals(struct triangles *t, uint32_t corner_count)
{
    for (uint32_t i = 0; i < corner_count; i++) {
        if (t->obj->corners[t->first + i].normal == MODEL_NONE) {
            t->normals = model_normals_make(t->positions, t->faces, corner_count);
            return t->normals != NULL;
        }
    }
    return true;
}

/* Makes a mesh of polygons first .. end - 1. */
static bool make_mesh(const struct obj *obj, struct model_scene *scene, uint32_t first, uint32_t end, uint32_t material)
{
    const struct polygon *last = &obj->polygons[end - 1];
    const uint32_t first_corner = obj->polygons[first].first, n = last->first + last->count - first_corner;
    struct triangles t = {.obj = obj,
                          .mtl = &obj->mtls.list[material],
                          .first = first_corner,
                          .corners = calloc(n, sizeof *t.corners), /* a polygon has two triangles less than corners */
                          .positions = calloc(n, sizeof *t.positions),
                          .faces = calloc(n, sizeof *t.faces)};
    bool done = t.corners != NULL && t.positions != NULL && t.faces != NULL;
    if (!done) {
        no_memory(obj);
    }
    for (uint32_t p = first; done && p < end; p++) {
        done = has_corners(obj, &obj->polygons[p]) && cut_polygon(&obj->polygons[p], &t);
    }
    done = done && ((make_normals(&t, n) && model_weld(scene, &(struct model_triangles){.count = t.count,
                                                                                        .material = material,
                                                                                        .has_normals = true,
                                                                                        .has_uvs = t.has_uvs,
                                                                                        .has_colours = obj->has_colours,
                                                                                        .corner = set_corner,
                                                                                        .context = &t})) ||
                    no_memory(obj));
    free(t.corners);
    free(t.positions);
    free(t.faces);
    free(t.normals);
    return done;
}

bool model_obj_read(struct model_shared *shared, struct model_scene *scene)
{
    size_t n = 0;
    const char *bytes = model_text_load(shared->folder.model, &n);
    if (bytes == NULL) {
        return model_shared_failed(shared, "cannot be read, or needs too much memory");
    }
    struct obj obj = {
        .shared = shared, .text = {.at = bytes, .end = bytes + n, .line = 1, .is_joined = true}, .group = {"", 0}};
    if (!model_mtl_add_plain(shared, scene, &obj.mtls, &(struct model_word){"", 0}) || !begin_run(&obj, 0)) {
        return false;
    }
    do {
        if (!read_line(&obj, scene)) {
            return false;
        }
    } while (model_text_next(&obj.text));
    for (uint32_t i = 0; i < obj.run_count; i++) {
        const uint32_t end = i + 1 < obj.run_count ? obj.runs[i + 1].first : obj.polygon_count;
        if (end > obj.runs[i].first && !make_mesh(&obj, scene, obj.runs[i].first, end, obj.runs[i].material)) {
            return false;
        }
    }
    return model_scene_one_node(scene) || no_memory(&obj);
}
