/*
 * asset_quadric: how far a vertex is from the triangles that it stands for, in place and in all that it carries.
 *
 * A vertex is a point of n numbers: its place, then texture coordinates, normal and colour, scaled so that an error of
 * one in them is as bad as one in place. A triangle lies in a plane of two dimensions there. A quadric is the sum of
 * the squared distances from planes, times weights (M. Garland, P. Heckbert: Simplifying Surfaces with Color and
 * Texture using Quadric Error Metrics, 1998). It is an array of asset_quadric_numbers(n), at first all 0: of a
 * symmetric matrix A the lower half row by row, a vector b, and c; its value at x is x A x + 2 b x + c.
 */
#ifndef ASSET_QUADRIC_H
#define ASSET_QUADRIC_H

enum { ASSET_DIMENSIONS_MAX = 11 };

static inline int asset_quadric_numbers(int n)
{
    return n * (n + 1) / 2 + n + 1;
}

/* Adds the plane of a triangle. */
void asset_quadric_triangle(double *q, int n, const double *const corners[3], double weight);

/* Adds a plane of places: normal . x = d, with a normal of length one; what else a vertex carries does not count. */
void asset_quadric_plane(double *q, int n, const double normal[3], double d, double weight);

/* The value at x, at least 0. */
double asset_quadric_at(const double *q, int n, const double *x);

#endif
