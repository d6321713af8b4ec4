/* See asset_quadric.h. */
#include "asset_quadric.h"

#include <math.h>
#include <stddef.h>

static double dot(const double *a, const double *b, int n)
{
    double sum = 0;
    for (int i = 0; i < n; i++) {
        sum += a[i] * b[i];
    }
    return sum;
}

/* to = a - b, less what it has of a direction (NULL: nothing), with length one; 0 where nothing is left. */
static void direction(double *to, const double *a, const double *b, const double *less, int n)
{
    for (int i = 0; i < n; i++) {
        to[i] = a[i] - b[i];
    }
    const double share = less != NULL ? dot(to, less, n) : 0;
    for (int i = 0; i < n && less != NULL; i++) {
        to[i] -= share * less[i];
    }
    const double length = sqrt(dot(to, to, n));
    for (int i = 0; i < n; i++) {
        to[i] = length > 1e-12 ? to[i] / length : 0;
    }
}

void asset_quadric_triangle(double *q, int n, const double *const corners[3], double weight)
{
    const double *const p = corners[0];
    double e[ASSET_DIMENSIONS_MAX], f[ASSET_DIMENSIONS_MAX];
    direction(e, corners[1], p, NULL, n);
    direction(f, corners[2], p, e, n);
    const double pe = dot(p, e, n), pf = dot(p, f, n);
    for (int i = 0; i < n; i++) {
        for (int j = 0; j <= i; j++) {
            *q++ += weight * ((i == j) - e[i] * e[j] - f[i] * f[j]);
        }
    }
    for (int i = 0; i < n; i++) {
        *q++ += weight * (pe * e[i] + pf * f[i] - p[i]);
    }
    *q += weight * (dot(p, p, n) - pe * pe - pf * pf);
}

void asset_quadric_plane(double *q, int n, const double normal[3], double d, double weight)
{
    double *const b = q + n * (n + 1) / 2;
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j <= i; j++) {
            *q++ += weight * normal[i] * normal[j];
        }
        b[i] -= weight * d * normal[i];
    }
    b[n] += weight * d * d;
}

double asset_quadric_at(const double *q, int n, const double *x)
{
    const double *const b = q + n * (n + 1) / 2;
    double sum = b[n];
    for (int i = 0; i < n; i++) {
        double row = 2 * b[i];
        for (int j = 0; j < i; j++) {
            row += 2 * *q++ * x[j];
        }
        row += *q++ * x[i];
        sum += row * x[i];
    }
    return sum > 0 ? sum : 0;
}
