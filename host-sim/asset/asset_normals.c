/* See asset_mesh.h. Normals of faces, for a mesh whose triangles are no longer those of the file. */
#include "asset_mesh.h"

#include <math.h>

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

void asset_normals(const struct fx_vec3 *places, size_t count, int16_t (*normals)[3])
{
    for (size_t i = 0; i < count; i++) {
        double face[3];
        face_normal(&places[i / 3 * 3], face);
        const double length = sqrt(face[0] * face[0] + face[1] * face[1] + face[2] * face[2]);
        for (int axis = 0; axis < 3; axis++) {
            normals[i][axis] = length > 0 ? (int16_t)lround(face[axis] / length * 16384) : 0;
        }
    }
}
