/* model_normals: normals for a surface whose file has none. */
#ifndef MODEL_NORMALS_H
#define MODEL_NORMALS_H

#include <stddef.h>
#include <stdint.h>

#define MODEL_CREASE_DEGREES 66                /* edges sharper than this stay sharp */
#define MODEL_CREASE_COSINE  .4067366430758002 /* of these degrees */

/* The normal of a triangle, of length 1; 0 where it has no area. */
void model_normals_face(const float *a, const float *b, const float *c, float normal[3]);

/* Returns a normal, of any length, for each of n corners of faces, given the normal of the face at each: the sum of
 * those that meet there, as far as they are at most MODEL_CREASE_DEGREES from its own. So a face counts once, into
 * however many triangles it is cut. Corners meet that are less than 1/10000 of the whole apart, because files round
 * them. A face normal of 0 counts for nothing. Of more than 1024 corners that meet, 1024 count. NULL: no memory. */
float (*model_normals_make(float (*corners)[3], float (*faces)[3], size_t n))[3];

#endif
