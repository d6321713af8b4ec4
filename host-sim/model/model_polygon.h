/* model_polygon: polygons as triangles. */
#ifndef MODEL_POLYGON_H
#define MODEL_POLYGON_H

#include <stdbool.h>
#include <stdint.h>

#define MODEL_POLYGON_MAX 10000u /* corners of a polygon that is not convex: the time grows with their square */

/*
 * Cuts a polygon of n >= 3 corners into n - 2 triangles of its corners' numbers, which turn as it does. It is seen
 * along the axis from which it looks largest. A convex one becomes a fan around its first corner; of another one ears
 * are cut off, so that its triangles stay inside of it. Where it crosses itself some may not. false: it is not convex
 * and has too many corners, or there is no memory.
 */
bool model_polygon_cut(float (*corners)[3], uint32_t n, uint32_t (*triangles)[3]);

#endif
