/* See asset_mesh.h. Normals of faces, for a mesh whose triangles are no longer those of the file. */
#include "asset_mesh.h"
#include "asset_net.h"

#include <math.h>

/* The length of the normal is twice the area. */
static void face_normal(const struct fx_vec3 *corners, double normal[3])
{
    double places[3][3];
    for (int i = 0; i < 3; i++) {
        places[i][0] = corners[i].x;
        places[i][1] = corners[i].y;
        places[i][2] = corners[i].z;
    }
    asset_net_normal((const double *const[3]){places[0], places[1], places[2]}, normal);
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
