/* See model_normals.h. A normal is the mean of the faces around a point, unless they meet at a crease. */
#include "model_normals.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#define NEAR        1e-4 /* of the diagonal of the box around all */
#define MEETING_MAX 1024 /* keeps the time for a fan of n triangles below n * n */

/*
 * Corners that are at most `near` apart meet: each hangs in the list of the first one that came there, which is found
 * in a hash table by its cell of a grid. A cell is as wide as two of these distances, so that only the eight cells
 * around the corner of the grid next to a point can hold what meets it. Numbers are index + 1.
 */
struct meeting {
    float (*corners)[3];
    uint32_t *slots; /* first corners */
    uint32_t *head;  /* of a first corner's list */
    uint32_t *next;
    size_t mask;
    double low[3], near;
};

static size_t hash_of(const int32_t cell[3])
{
    uint32_t hash = 2166136261u;
    for (int i = 0; i < 3; i++) {
        hash = (hash ^ (uint32_t)cell[i]) * 16777619u;
        hash ^= hash >> 15;
    }
    return hash;
}

static bool meets(const struct meeting *m, const float *p, const float *q)
{
    const double x = (double)p[0] - (double)q[0], y = (double)p[1] - (double)q[1], z = (double)p[2] - (double)q[2];
    return x * x + y * y + z * z <= m->near * m->near;
}

/* The first corner that a point meets, or a free slot for it. */
static size_t find_slot(const struct meeting *m, const float *p)
{
    int32_t own[3], other[3];
    for (int i = 0; i < 3; i++) {
        const double at = ((double)p[i] - m->low[i]) / (2 * m->near);
        own[i] = (int32_t)floor(at);
        other[i] = at - own[i] < .5 ? own[i] - 1 : own[i] + 1;
    }
    size_t slot = 0;
    for (int k = 7; k >= 0; k--) { /* its own cell comes last */
        const int32_t cell[3] = {(k & 1) != 0 ? other[0] : own[0], (k & 2) != 0 ? other[1] : own[1],
                                 (k & 4) != 0 ? other[2] : own[2]};
        for (slot = hash_of(cell) & m->mask; m->slots[slot] != 0; slot = (slot + 1) & m->mask) {
            if (meets(m, p, m->corners[m->slots[slot] - 1])) {
                return slot;
            }
        }
    }
    return slot;
}

/* Finds the box around all corners. false: it is none, or a point. */
static bool find_grid(struct meeting *m, size_t n)
{
    double size = 0;
    for (int axis = 0; axis < 3; axis++) {
        double high = -HUGE_VAL;
        m->low[axis] = HUGE_VAL;
        for (size_t i = 0; i < n; i++) {
            const double at = (double)m->corners[i][axis];
            m->low[axis] = at < m->low[axis] || !isfinite(at) ? at : m->low[axis];
            high = at > high || !isfinite(at) ? at : high;
        }
        size += (high - m->low[axis]) * (high - m->low[axis]);
    }
    m->near = NEAR * sqrt(size);
    return m->near > 0 && isfinite(m->near);
}

/* Hangs all corners into their lists. */
static void find_meetings(struct meeting *m, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        uint32_t *slot = &m->slots[find_slot(m, m->corners[i])];
        *slot = *slot != 0 ? *slot : (uint32_t)i + 1;
        m->next[i] = m->head[*slot - 1];
        m->head[*slot - 1] = (uint32_t)i + 1;
    }
}

void model_normals_face(const float *a, const float *b, const float *c, float normal[3])
{
    double p[3], q[3], cross[3];
    for (int i = 0; i < 3; i++) {
        p[i] = (double)b[i] - (double)a[i];
        q[i] = (double)c[i] - (double)a[i];
    }
    for (int i = 0; i < 3; i++) {
        cross[i] = p[(i + 1) % 3] * q[(i + 2) % 3] - p[(i + 2) % 3] * q[(i + 1) % 3];
    }
    const double length = sqrt(cross[0] * cross[0] + cross[1] * cross[1] + cross[2] * cross[2]);
    for (int i = 0; i < 3; i++) {
        normal[i] = length > 0 && isfinite(length) ? (float)(cross[i] / length) : 0;
    }
}

static double dot(const float *a, const float *b)
{
    return (double)a[0] * (double)b[0] + (double)a[1] * (double)b[1] + (double)a[2] * (double)b[2];
}

/* The mean around corner i, of any length. */
static void mean_normal(const struct meeting *m, uint32_t first, float (*faces)[3], uint32_t i, float normal[3])
{
    const float *own = faces[i];
    double sum[3] = {0, 0, 0};
    uint32_t seen = 0;
    for (uint32_t k = first; k != 0 && seen < MEETING_MAX; k = m->next[k - 1], seen++) {
        const float *other = faces[k - 1];
        if (k - 1 == i || dot(own, other) >= MODEL_CREASE_COSINE) {
            sum[0] += (double)other[0];
            sum[1] += (double)other[1];
            sum[2] += (double)other[2];
        }
    }
    const bool is_none = sum[0] == 0 && sum[1] == 0 && sum[2] == 0; /* the own one was not among those */
    for (int axis = 0; axis < 3; axis++) {
        normal[axis] = is_none ? own[axis] : (float)sum[axis];
    }
}

float (*model_normals_make(float (*corners)[3], float (*faces)[3], size_t n))[3]
{
    struct meeting m = {.corners = corners, .mask = 15};
    while (m.mask < 2 * n) {
        m.mask = m.mask * 2 + 1;
    }
    float(*normals)[3] = calloc(n + 1, sizeof *normals);
    m.slots = calloc(m.mask + 1, sizeof *m.slots);
    m.head = calloc(n + 1, sizeof *m.head);
    m.next = calloc(n + 1, sizeof *m.next);
    if (normals == NULL || m.slots == NULL || m.head == NULL || m.next == NULL) {
        free(normals);
        normals = NULL;
    } else if (find_grid(&m, n)) { /* else it has no surface */
        find_meetings(&m, n);
        for (size_t i = 0; i < n; i++) {
            mean_normal(&m, m.head[m.slots[find_slot(&m, corners[i])] - 1], faces, (uint32_t)i, normals[i]);
        }
    }
    free(m.slots);
    free(m.head);
    free(m.next);
    return normals;
}
