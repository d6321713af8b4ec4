/* See check.h, render.h. */
#include "check.h"

#include "shading.h"
#include "sphere.h"

static bool has_stray_index(const uint16_t *index, uint64_t n, uint32_t vertex_count)
{
    for (uint64_t i = 0; i < n; i++) {
        if (index[i] >= vertex_count) {
            return true;
        }
    }
    return false;
}

static bool is_stray_texture(const struct ph_texture *texture)
{
    return texture != NULL && (texture->texels == NULL || texture->log2_width > PH_TEXTURE_LOG2_MAX ||
                               texture->log2_height > PH_TEXTURE_LOG2_MAX);
}

static bool has_stray_part(const struct ph_mesh *mesh)
{
    for (uint32_t i = 0; i < mesh->part_count; i++) {
        const struct ph_part *const part = &mesh->parts[i];
        if (mesh->material_count != 0 && part->material >= mesh->material_count) {
            return true;
        }
        const struct ph_material *const material = &mesh->materials[part->material];
        if ((ph_takes_texture(material) && is_stray_texture(material->texture)) ||
            (material->blend != NULL && is_stray_texture(material->blend->alphas))) {
            return true;
        }
        if (!ph_is_wire(material) &&
            (part->first > mesh->triangle_count || part->count > mesh->triangle_count - part->first)) {
            return true;
        }
    }
    return false;
}

/* Whether one of n corners lies outside of a sphere. */
static bool has_stray_corner(const struct ph_mesh *mesh, const uint16_t *index, uint64_t n,
                             const struct ph_sphere *sphere)
{
    for (uint64_t i = 0; sphere->radius > 0 && i < n; i++) {
        if (ph_distance2(&sphere->centre, &mesh->positions[index[i]]) >
            fx_mul_wide_u((uint32_t)sphere->radius, (uint32_t)sphere->radius)) {
            return true;
        }
    }
    return false;
}

bool ph_bounds_hold(const struct ph_mesh *mesh)
{
    if (mesh->bounds == NULL) {
        return true;
    }
    for (uint32_t i = 0; i < mesh->part_count; i++) {
        const struct ph_part *const part = &mesh->parts[i];
        const bool wire = ph_is_wire(&mesh->materials[part->material]);
        const uint64_t n = wire ? 2 * (uint64_t)mesh->edge_count : 3 * (uint64_t)part->count;
        if (n == 0) { /* there may be no array */
            continue;
        }
        const uint16_t *const index =
            wire ? (const uint16_t *)mesh->edges : (const uint16_t *)&mesh->triangles[part->first];
        if (has_stray_corner(mesh, index, n, mesh->bounds) ||
            (mesh->part_count > 1 && has_stray_corner(mesh, index, n, &mesh->bounds[1 + i]))) {
            return false;
        }
    }
    return true;
}

bool ph_mesh_is_whole(const struct ph_mesh *mesh)
{
    if (mesh == NULL || (mesh->vertex_count > 0 && mesh->positions == NULL) ||
        (mesh->triangle_count > 0 && mesh->triangles == NULL) || (mesh->edge_count > 0 && mesh->edges == NULL) ||
        (mesh->part_count > 0 && (mesh->parts == NULL || mesh->materials == NULL))) {
        return false;
    }
    return !PH_CHECKED ||
           (!has_stray_part(mesh) &&
            !has_stray_index((const uint16_t *)mesh->triangles, 3 * (uint64_t)mesh->triangle_count,
                             mesh->vertex_count) &&
            !has_stray_index((const uint16_t *)mesh->edges, 2 * (uint64_t)mesh->edge_count, mesh->vertex_count) &&
            ph_bounds_hold(mesh));
}
