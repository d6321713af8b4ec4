/* demo_draw_meshes: see demo_scene.h. */
#include "demo_scene.h"

enum { SORTED = 64 };

/* Whether the mesh is one through which something is seen, so that the order counts. */
static bool is_seen_through(const struct ph_mesh *mesh)
{
    const struct ph_blend *const blend = mesh->materials->blend;
    return blend != NULL && (blend->kind == PH_BLEND_ALPHA || blend->kind == PH_BLEND_ADD);
}

/* The z of the middle of the mesh's box as the camera sees it: the farther, the less. */
static fx_t depth_of(const struct ph_mesh *mesh, const struct ph_xform *to_eye)
{
    struct fx_vec3 least = mesh->positions[0], most = least;
    for (uint32_t i = 1; i < mesh->vertex_count; i++) {
        const struct fx_vec3 *const p = &mesh->positions[i];
        least.x = p->x < least.x ? p->x : least.x;
        least.y = p->y < least.y ? p->y : least.y;
        least.z = p->z < least.z ? p->z : least.z;
        most.x = p->x > most.x ? p->x : most.x;
        most.y = p->y > most.y ? p->y : most.y;
        most.z = p->z > most.z ? p->z : most.z;
    }
    const struct fx_vec3 middle = {least.x / 2 + most.x / 2, least.y / 2 + most.y / 2, least.z / 2 + most.z / 2};
    return ph_xform_point(to_eye, middle).z;
}

/* Finds the meshes that are seen through, the farthest first, those equally far as they come. Returns how many; 0: also
 * if there are more than SORTED. */
static uint32_t sort(const struct ph_mesh *meshes, uint32_t count, const struct ph_xform *to_eye,
                     uint16_t order[SORTED])
{
    fx_t depth[SORTED];
    uint32_t n = 0;
    for (uint32_t i = 0; i < count; i++) {
        if (!is_seen_through(&meshes[i])) {
            continue;
        }
        if (n == SORTED) {
            return 0;
        }
        const fx_t z = depth_of(&meshes[i], to_eye);
        uint32_t k = n++;
        for (; k > 0 && depth[k - 1] > z; k--) {
            depth[k] = depth[k - 1];
            order[k] = order[k - 1];
        }
        depth[k] = z;
        order[k] = (uint16_t)i;
    }
    return n;
}

int demo_draw_meshes(struct ph_renderer *r, const struct ph_mesh *meshes, uint32_t count, const struct ph_xform *place)
{
    const struct ph_xform to_eye = ph_xform_mul(&r->view, place);
    uint16_t order[SORTED];
    const uint32_t n = sort(meshes, count, &to_eye, order);
    int status = PH_OK;
    for (uint32_t i = 0; i < count && status == PH_OK; i++) {
        status = n > 0 && is_seen_through(&meshes[i]) ? PH_OK : ph_draw_mesh(r, &meshes[i], place);
    }
    for (uint32_t k = 0; k < n && status == PH_OK; k++) {
        status = ph_draw_mesh(r, &meshes[order[k]], place);
    }
    return status;
}
