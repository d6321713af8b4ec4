/* model_normals: normals for a surface whose file has none. */
#ifndef MODEL_NORMALS_H
#define MODEL_NORMALS_H

#include <stddef.h>
#include <stdint.h>

/* Returns a normal for each of 3 * count corners of triangles: the mean of the normals of the triangles that meet at
 * its position, as far as they are at most 66 degrees from its own triangle's. Those of triangles without an area are
 * 0, and count for nothing. Of more than 1024 corners in one position, 1024 count. NULL: no memory. */
float (*model_normals_make(float (*corners)[3], size_t count))[3];

#endif
