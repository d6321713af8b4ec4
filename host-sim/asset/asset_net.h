/*
 * asset_net: the meshes of a model as one net, for asset_simplify.
 *
 * Vertices in one place are a point of the net, whatever their mesh: no gap opens along a seam of the texture, a
 * crease, or between two meshes. At a point there is a wedge for each way in which the vertices there differ: in mesh,
 * texture coordinates, normal, colour, joints. A triangle has three wedges.
 */
#ifndef ASSET_NET_H
#define ASSET_NET_H

#include "model.h"

#define ASSET_NET_NONE UINT32_MAX

struct asset_wedge {
    uint32_t point, mesh;
    unsigned source; /* a vertex of the model; they are numbered through all meshes */
};

struct asset_net {
    struct asset_wedge *wedges;
    double *x, *quadrics;     /* of each wedge: `dimensions` numbers, of which the first three are its place, in
                                 sizes of the model; a quadric (asset_quadric.h) */
    double *areas;            /* of the triangles that each wedge stands for */
    uint32_t (*triangles)[3]; /* wedges */
    bool *is_live;            /* of each triangle */
    uint32_t *heads, *next;   /* of each point its first corner; of each corner the next at its point, or NONE. A
                                 corner is 3 * triangle + 0 .. 2 */
    uint32_t wedge_count, point_count, triangle_count;
    double size;             /* of the model: its largest coordinate is as far from 0 */
    int dimensions, numbers; /* of a wedge; of its quadric */
};

/* Makes the net of all triangles whose corners are in three places. The caller frees it in any case. False: no memory.
 */
bool asset_net_make(struct asset_net *net, const struct model *model);
void asset_net_free(struct asset_net *net);

/* Whether each triangle of a mesh has one normal for all its corners, or the mesh has none. */
bool asset_net_is_flat(const struct ph_mesh *mesh);

/* The wedge, and the point, of a corner. */
static inline uint32_t asset_net_wedge(const struct asset_net *net, uint32_t corner)
{
    return net->triangles[corner / 3][corner % 3];
}

static inline uint32_t asset_net_point(const struct asset_net *net, uint32_t corner)
{
    return net->wedges[asset_net_wedge(net, corner)].point;
}

static inline const double *asset_net_x(const struct asset_net *net, uint32_t wedge)
{
    return net->x + (size_t)wedge * (size_t)net->dimensions;
}

static inline double *asset_net_quadric(const struct asset_net *net, uint32_t wedge)
{
    return net->quadrics + (size_t)wedge * (size_t)net->numbers;
}

/* The normal of a triangle of places, twice as long as its area. */
void asset_net_normal(const double *const corners[3], double normal[3]);

#endif
