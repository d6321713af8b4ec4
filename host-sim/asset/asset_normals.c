/* See asset_mesh.h. New normals for a simplified mesh: faces that meet at a small angle share one, others keep a
 * crease. */
#include "asset_mesh.h"

#include "model_normals.h"

#include <math.h>
#include <stdlib.h>

struct corner {
    const struct fx_vec3 *place;
    size_t index;
};

static int by_place(const void *a, const void *b)
{
    const struct corner *p = a, *q = b;
    const fx_t of_p[3] = {p->place->x, p->place->y, p->place->z}, of_q[3] = {q->place->x, q->place->y, q->place->z};
    for (int axis = 0; axis < 3; axis++) {
        if (of_p[axis] != of_q[axis]) {
            return of_p[axis] < of_q[axis] ? -1 : 1;
        }
    }
    return p->index < q->index ? -1 : p->index > q->index;
}

/* The length of the normal is twice the area. */
static void face_normal(const struct fx_vec3 *corners, double normal[3])
{
    const struct fx_vec3 *a = &corners[0], *b = &corners[1], *c = &corners[2];
    const double p[3] = {(double)b->x - a->x, (double)b->y - a->y, (double)b->z - a->z};
    const double q[3] = {(double)c->x - a->x, (double)c->y - a->y, (double)c->z - a->z};
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        normal[i] = p[j] * q[k] - p[k] * q[j];
    }
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void set_normal(int16_t normal[3], const double sum[3])
{
    const double length = sqrt(dot(sum, sum));
    for (int i = 0; i < 3; i++) {
        normal[i] = length > 0 ? (int16_t)lround(sum[i] / length * 16384) : 0;
    }
}

/* Sums the faces around this corner that its own face joins smoothly. */
static void add_neighbours(const struct corner *group, size_t count, const double (*faces)[3], const double own[3],
                           double sum[3])
{
    for (size_t i = 0; i < count; i++) {
        const double *face = faces[group[i].index / 3];
        if (dot(face, own) >= MODEL_CREASE_COSINE * sqrt(dot(face, face) * dot(own, own))) {
            for (int axis = 0; axis < 3; axis++) {
                sum[axis] += face[axis];
            }
        }
    }
}

static void smooth(const struct corner *sorted, size_t count, const double (*faces)[3], int16_t (*normals)[3])
{
    for (size_t first = 0, end; first < count; first = end) {
        end = first + 1;
        while (end < count && sorted[end].place->x == sorted[first].place->x &&
               sorted[end].place->y == sorted[first].place->y && sorted[end].place->z == sorted[first].place->z) {
            end++;
        }
        for (size_t i = first; i < end; i++) {
            double sum[3] = {0, 0, 0};
            add_neighbours(sorted + first, end - first, faces, faces[sorted[i].index / 3], sum);
            set_normal(normals[sorted[i].index], sum);
        }
    }
}

bool asset_normals(const struct fx_vec3 *places, size_t count, bool is_flat, int16_t (*normals)[3])
{
    double(*faces)[3] = malloc(sizeof *faces * (count / 3 + 1));
    struct corner *sorted = malloc(sizeof *sorted * (count + 1));
    const bool is_done = faces != NULL && sorted != NULL;
    for (size_t i = 0; is_done && i < count; i++) {
        if (i % 3 == 0) {
            face_normal(&places[i], faces[i / 3]);
        }
        set_normal(normals[i], faces[i / 3]);
        sorted[i] = (struct corner){&places[i], i};
    }
    if (is_done && !is_flat) {
        qsort(sorted, count, sizeof *sorted, by_place);
        smooth(sorted, count, (const double(*)[3])faces, normals);
    }
    free(faces);
    free(sorted);
    return is_done;
}
