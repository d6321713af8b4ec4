/* See asset_reuse.h. */
#include "asset_reuse.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#define NONE    UINT32_MAX
#define VALENCE 8 /* more triangles of a vertex score as so many */

/* The triangles of each vertex that are not written yet, and the triangles that are. */
struct around {
    unsigned *live;   /* how many triangles of each vertex are left */
    unsigned *firsts; /* where those of each vertex begin in `faces` */
    unsigned *faces;
    bool *written; /* of each triangle */
    size_t done;   /* triangles that are written */
};

static void free_around(struct around *a)
{
    free(a->live);
    free(a->firsts);
    free(a->faces);
    free(a->written);
}

/* The caller frees *a in any case. False: no memory. */
static bool make_around(struct around *a, const struct asset_corners *from)
{
    *a = (struct around){.live = calloc(from->vertex_count + 1, sizeof *a->live),
                         .firsts = malloc(sizeof *a->firsts * (from->vertex_count + 1)),
                         .faces = malloc(sizeof *a->faces * (from->count + 1)),
                         .written = calloc(from->count / 3 + 1, sizeof *a->written)};
    if (a->live == NULL || a->firsts == NULL || a->faces == NULL || a->written == NULL) {
        return false;
    }
    for (size_t i = 0; i < from->count; i++) {
        a->live[from->indices[i]]++;
    }
    unsigned first = 0;
    for (size_t v = 0; v < from->vertex_count; v++) {
        a->firsts[v] = first;
        first += a->live[v];
        a->live[v] = 0;
    }
    for (size_t i = 0; i < from->count; i++) {
        const unsigned v = from->indices[i];
        a->faces[a->firsts[v] + a->live[v]++] = (unsigned)(i / 3);
    }
    return true;
}

static void write_face(struct around *a, const struct asset_corners *from, unsigned face, unsigned *to)
{
    memcpy(to + 3 * a->done, from->indices + 3 * (size_t)face, 3 * sizeof *to);
    a->written[face] = true;
    a->done++;
}

/* ---- a queue of vertices -------------------------------------------------------------------------------- */

/* ages[v]: the number of the fetch that brought v last. A vertex is kept while `now` is at most a queue further. */
static bool is_kept(const unsigned *ages, unsigned v, unsigned now)
{
    return now - ages[v] <= ASSET_REUSE_CACHE;
}

static unsigned fetch(unsigned *ages, unsigned v, unsigned now)
{
    if (!is_kept(ages, v, now)) {
        ages[v] = now++;
    }
    return now;
}

unsigned asset_reuse_fetches(const struct asset_corners *from, unsigned *ages)
{
    const unsigned begin = ASSET_REUSE_CACHE + 1;
    unsigned now = begin;
    memset(ages, 0, sizeof *ages * from->vertex_count);
    for (size_t i = 0; i < from->count; i++) {
        now = fetch(ages, from->indices[i], now);
    }
    return now - begin;
}

/* ---- fans ----------------------------------------------------------------------------------------------- */

struct fans {
    struct around around;
    unsigned *ages, now;
    unsigned *stack; /* corners of all triangles that are written, the last ones on top */
    size_t top;
    unsigned cursor; /* vertices before it have no triangles left */
};

/* Writes all triangles of a vertex that are left. */
static void write_fan(struct fans *f, const struct asset_corners *from, unsigned centre, unsigned degree, unsigned *to)
{
    struct around *const a = &f->around;
    const unsigned *const faces = a->faces + a->firsts[centre];
    for (unsigned i = 0; i < degree; i++) {
        if (a->written[faces[i]]) {
            continue;
        }
        for (size_t k = 0; k < 3; k++) {
            const unsigned v = from->indices[3 * (size_t)faces[i] + k];
            f->stack[f->top++] = v;
            a->live[v]--;
            f->now = fetch(f->ages, v, f->now);
        }
        write_face(a, from, faces[i], to);
    }
}

/* Returns the vertex for the next fan among those of the last one: the one that came first into the queue, of those
 * that stay in it while their own fans are written. NONE: none has triangles left. */
static unsigned next_near(const struct fans *f, size_t begin)
{
    const unsigned *const live = f->around.live;
    unsigned best = NONE;
    int64_t best_age = -1;
    for (size_t i = begin; i < f->top; i++) {
        const unsigned v = f->stack[i], age = f->now - f->ages[v];
        const int64_t counts = 2 * live[v] + age <= ASSET_REUSE_CACHE ? age : 0;
        if (live[v] > 0 && counts > best_age) {
            best = v;
            best_age = counts;
        }
    }
    return best;
}

/* Returns the vertex that was used last and has triangles left, or the first one of the mesh; NONE: all is written. */
static unsigned next_far(struct fans *f, size_t vertex_count)
{
    while (f->top > 0) {
        const unsigned v = f->stack[--f->top];
        if (f->around.live[v] > 0) {
            return v;
        }
    }
    while (f->cursor < vertex_count && f->around.live[f->cursor] == 0) {
        f->cursor++;
    }
    return f->cursor < vertex_count ? f->cursor : NONE;
}

bool asset_reuse_fans(const struct asset_corners *from, unsigned *to)
{
    struct fans f = {.now = ASSET_REUSE_CACHE + 1};
    f.ages = calloc(from->vertex_count + 1, sizeof *f.ages);
    f.stack = malloc(sizeof *f.stack * (from->count + 1));
    unsigned *const degrees = malloc(sizeof *degrees * (from->vertex_count + 1));
    const bool is_made = make_around(&f.around, from) && f.ages != NULL && f.stack != NULL && degrees != NULL;
    if (is_made) {
        memcpy(degrees, f.around.live, sizeof *degrees * from->vertex_count);
    }
    for (unsigned v = is_made && from->count > 0 ? 0 : NONE; v != NONE;) {
        const size_t begin = f.top;
        write_fan(&f, from, v, degrees[v], to);
        const unsigned near = next_near(&f, begin);
        v = near != NONE ? near : next_far(&f, from->vertex_count);
    }
    free_around(&f.around);
    free(f.ages);
    free(f.stack);
    free(degrees);
    return is_made;
}

/* ---- scores --------------------------------------------------------------------------------------------- */

/* The score of a place in the queue, the first one being none; and of triangles that are left. */
static const float place_scores[1 + ASSET_REUSE_CACHE] = {0.F,    0.779F, 0.791F, 0.789F, 0.981F, 0.843F,
                                                          0.726F, 0.847F, 0.882F, 0.867F, 0.799F, 0.642F,
                                                          0.613F, 0.600F, 0.568F, 0.372F, 0.234F};
static const float live_scores[1 + VALENCE] = {0.F, 0.995F, 0.713F, 0.450F, 0.404F, 0.059F, 0.005F, 0.147F, 0.006F};

struct scores {
    struct around around;
    float *of_vertex, *of_face;
    unsigned queue[ASSET_REUSE_CACHE + 3]; /* the vertices used last, and those that this triangle drives out */
    size_t kept, used;                     /* elements of the queue: before the next triangle, and with it */
    unsigned cursor;                       /* triangles before it are written */
};

static float score(const struct scores *s, unsigned v, size_t place)
{
    const unsigned live = s->around.live[v] < VALENCE ? s->around.live[v] : VALENCE;
    return place_scores[place < ASSET_REUSE_CACHE ? 1 + place : 0] + live_scores[live];
}

static void begin_scores(struct scores *s, const struct asset_corners *from)
{
    for (size_t v = 0; v < from->vertex_count; v++) {
        s->of_vertex[v] = score(s, (unsigned)v, ASSET_REUSE_CACHE);
    }
    for (size_t i = 0; i < from->count / 3; i++) {
        const unsigned *const c = from->indices + 3 * i;
        s->of_face[i] = s->of_vertex[c[0]] + s->of_vertex[c[1]] + s->of_vertex[c[2]];
    }
}

/* Puts the corners of a triangle before the vertices of the queue. */
static void put_first(struct scores *s, const unsigned c[3])
{
    unsigned queue[ASSET_REUSE_CACHE + 3] = {c[0], c[1], c[2]};
    size_t n = 3;
    for (size_t i = 0; i < s->kept; i++) {
        const unsigned v = s->queue[i];
        if (v != c[0] && v != c[1] && v != c[2]) {
            queue[n++] = v;
        }
    }
    memcpy(s->queue, queue, sizeof *queue * n);
    s->used = n;
    s->kept = n < ASSET_REUSE_CACHE ? n : ASSET_REUSE_CACHE;
}

static void leave(struct around *a, unsigned v, unsigned face)
{
    unsigned *const faces = a->faces + a->firsts[v];
    for (unsigned i = 0; i < a->live[v]; i++) {
        if (faces[i] == face) {
            faces[i] = faces[--a->live[v]];
            return;
        }
    }
}

/* Scores the vertices of the queue and their triangles anew. Returns the best triangle, or NONE. */
static unsigned best_near(struct scores *s)
{
    unsigned best = NONE;
    float best_score = 0;
    for (size_t i = 0; i < s->used; i++) {
        const unsigned v = s->queue[i];
        const float now = score(s, v, i), more = now - s->of_vertex[v];
        s->of_vertex[v] = now;
        for (unsigned k = 0; k < s->around.live[v]; k++) {
            const unsigned face = s->around.faces[s->around.firsts[v] + k];
            s->of_face[face] += more;
            if (best_score < s->of_face[face]) {
                best = face;
                best_score = s->of_face[face];
            }
        }
    }
    return best;
}

static unsigned next_face(struct scores *s, size_t face_count)
{
    const unsigned near = best_near(s);
    while (near == NONE && s->cursor < face_count && s->around.written[s->cursor]) {
        s->cursor++;
    }
    return near != NONE ? near : s->cursor < face_count ? s->cursor : NONE;
}

bool asset_reuse_scores(const struct asset_corners *from, unsigned *to)
{
    struct scores s = {.cursor = 0};
    s.of_vertex = malloc(sizeof *s.of_vertex * (from->vertex_count + 1));
    s.of_face = malloc(sizeof *s.of_face * (from->count / 3 + 1));
    const bool is_made = make_around(&s.around, from) && s.of_vertex != NULL && s.of_face != NULL;
    if (is_made) {
        begin_scores(&s, from);
    }
    for (unsigned face = is_made && from->count > 0 ? 0 : NONE; face != NONE;) {
        const unsigned *const c = from->indices + 3 * (size_t)face;
        write_face(&s.around, from, face, to);
        put_first(&s, c);
        for (size_t k = 0; k < 3; k++) {
            leave(&s.around, c[k], face);
        }
        face = next_face(&s, from->count / 3);
    }
    free_around(&s.around);
    free(s.of_vertex);
    free(s.of_face);
    return is_made;
}
