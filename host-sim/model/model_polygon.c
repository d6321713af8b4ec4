/* See model_polygon.h. A convex polygon becomes a fan; from any other one ears are cut, one corner after the other. */
#include "model_polygon.h"

#include <math.h>
#include <stdlib.h>

/* A ring of the corners that are left, seen as points of a plane in which it turns anticlockwise. */
struct ring {
    double (*points)[2];
    uint32_t *next, *before;
};

/* Twice the area of the triangle, positive if it turns anticlockwise. */
static double area(const struct ring *r, uint32_t a, uint32_t b, uint32_t c)
{
    const double *p = r->points[a], *q = r->points[b], *s = r->points[c];
    return (q[0] - p[0]) * (s[1] - p[1]) - (q[1] - p[1]) * (s[0] - p[0]);
}

/* Projects the corners along the longest axis of the polygon's normal. */
static void project(float (*corners)[3], uint32_t n, double (*points)[2])
{
    double normal[3] = {0, 0, 0};
    for (uint32_t i = 0; i < n; i++) {
        for (int axis = 0; axis < 3; axis++) {
            const int a = (axis + 1) % 3, b = (axis + 2) % 3;
            const float *p = corners[i], *q = corners[(i + 1) % n], *o = corners[0];
            normal[axis] += ((double)p[a] - (double)o[a]) * ((double)q[b] - (double)o[b]) -
                            ((double)p[b] - (double)o[b]) * ((double)q[a] - (double)o[a]);
        }
    }
    const int longest = fabs(normal[0]) > fabs(normal[1]) ? (fabs(normal[0]) > fabs(normal[2]) ? 0 : 2)
                                                          : (fabs(normal[1]) > fabs(normal[2]) ? 1 : 2);
    const int a = (longest + 1) % 3, b = (longest + 2) % 3;
    for (uint32_t i = 0; i < n; i++) {
        points[i][0] = (double)corners[i][a];
        points[i][1] = normal[longest] < 0 ? -(double)corners[i][b] : (double)corners[i][b];
    }
}

/* Whether no corner turns back, and all turns together are one. */
static bool is_convex(const struct ring *r, uint32_t n)
{
    uint32_t ups = 0;
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t j = (i + 1) % n, k = (i + 2) % n;
        if (area(r, i, j, k) < 0) {
            return false;
        }
        ups += r->points[j][1] <= r->points[i][1] && r->points[k][1] > r->points[j][1];
    }
    return ups <= 1;
}

/* Whether no other corner lies in the triangle at b or on its border, except in its corners. */
static bool is_ear(const struct ring *r, uint32_t b)
{
    const uint32_t a = r->before[b], c = r->next[b];
    if (area(r, a, b, c) <= 0) {
        return false;
    }
    for (uint32_t i = r->next[c]; i != a; i = r->next[i]) {
        const double *p = r->points[i];
        bool is_corner = false;
        for (int k = 0; k < 3; k++) {
            const double *q = r->points[k == 0 ? a : k == 1 ? b : c];
            is_corner = is_corner || (p[0] == q[0] && p[1] == q[1]);
        }
        if (!is_corner && area(r, a, b, i) >= 0 && area(r, b, c, i) >= 0 && area(r, c, a, i) >= 0) {
            return false;
        }
    }
    return true;
}

static void cut_ears(const struct ring *r, uint32_t n, uint32_t (*triangles)[3])
{
    uint32_t at = 1;
    bool has_ears = true; /* where there is none it crosses itself, or has no area: then any corner goes */
    for (uint32_t left = n; left > 3; left--) {
        uint32_t tried = 0;
        while (has_ears && !is_ear(r, at)) {
            at = r->next[at];
            has_ears = ++tried < left;
        }
        const uint32_t a = r->before[at], c = r->next[at];
        (*triangles)[0] = a, (*triangles)[1] = at, (*triangles)[2] = c;
        triangles++;
        r->next[a] = c;
        r->before[c] = a;
        at = c;
    }
    (*triangles)[0] = r->before[at], (*triangles)[1] = at, (*triangles)[2] = r->next[at];
}

static bool cut(float (*corners)[3], uint32_t n, struct ring *r, uint32_t (*triangles)[3])
{
    project(corners, n, r->points);
    if (is_convex(r, n)) {
        for (uint32_t i = 0; i + 2 < n; i++) {
            triangles[i][0] = 0, triangles[i][1] = i + 1, triangles[i][2] = i + 2;
        }
        return true;
    }
    for (uint32_t i = 0; i < n; i++) {
        r->next[i] = (i + 1) % n;
        r->before[i] = (i + n - 1) % n;
    }
    if (n <= MODEL_POLYGON_MAX) {
        cut_ears(r, n, triangles);
    }
    return n <= MODEL_POLYGON_MAX;
}

/* Whether corner i of four turns back: then the diagonal from it is the one that stays inside. */
static bool is_concave(float (*corners)[3], int i)
{
    double along[3][3], length[3] = {0, 0, 0}, across[2] = {0, 0};
    for (int k = 0; k < 3; k++) {
        for (int axis = 0; axis < 3; axis++) {
            along[k][axis] = (double)corners[(i + 1 + k) % 4][axis] - (double)corners[i][axis];
            length[k] += along[k][axis] * along[k][axis];
        }
    }
    for (int k = 0; k < 2; k++) {
        for (int axis = 0; axis < 3; axis++) {
            across[k] += along[2 * k][axis] * along[1][axis];
        }
        across[k] = acos(fmax(-1, fmin(1, across[k] / sqrt(length[2 * k] * length[1]))));
    }
    return across[0] + across[1] > 3.14159265358979323846;
}

bool model_polygon_cut(float (*corners)[3], uint32_t n, uint32_t (*triangles)[3])
{
    if (n == 3) {
        triangles[0][0] = 0, triangles[0][1] = 1, triangles[0][2] = 2;
        return true;
    }
    if (n == 4) {
        uint32_t i = 0;
        while (i < 4 && !is_concave(corners, (int)i)) {
            i++;
        }
        triangles[0][0] = triangles[1][0] = i % 4, triangles[0][1] = (i + 1) % 4;
        triangles[0][2] = triangles[1][1] = (i + 2) % 4, triangles[1][2] = (i + 3) % 4;
        return true;
    }
    struct ring r = {calloc(n, sizeof *r.points), calloc(n, sizeof *r.next), calloc(n, sizeof *r.before)};
    const bool done = r.points != NULL && r.next != NULL && r.before != NULL && cut(corners, n, &r, triangles);
    free(r.points);
    free(r.next);
    free(r.before);
    return done;
}
