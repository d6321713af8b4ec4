/* ph_check_mesh: see status.h. */
#include "status.h"

#include "check.h"
#include "list.h"

static const struct ph_finding none;

static struct ph_finding found(const char *what, uint32_t number)
{
    return (struct ph_finding){what, number};
}

/* ---- arrays and indices ----------------------------------------------------------------------------------------- */

static struct ph_finding check_arrays(const struct ph_mesh *mesh)
{
    const char *const what = mesh == NULL                                          ? "the mesh is NULL"
                             : mesh->vertex_count == 0                             ? "vertex_count is 0"
                             : mesh->vertex_count > 65536                          ? "vertex_count is above 65536"
                             : mesh->positions == NULL                             ? "positions are NULL"
                             : mesh->triangle_count > 0 && mesh->triangles == NULL ? "triangles are NULL"
                             : mesh->edge_count > 0 && mesh->edges == NULL         ? "edges are NULL"
                             : mesh->triangle_count == 0 && mesh->edge_count == 0  ? "triangle_count is 0"
                             : mesh->part_count == 0 || mesh->parts == NULL        ? "there are no parts"
                             : mesh->materials == NULL                             ? "materials are NULL"
                                                                                   : NULL;
    return found(what, 0);
}

static struct ph_finding check_part(const struct ph_mesh *mesh, uint32_t i)
{
    const struct ph_part *const part = &mesh->parts[i];
    if (mesh->material_count != 0 && part->material >= mesh->material_count) {
        return found("a part names a material that is not there", i);
    }
    if (ph_is_wire(&mesh->materials[part->material])) {
        return mesh->edge_count == 0 ? found("a part is drawn as edges, and the mesh has none", i) : none;
    }
    if (part->count == 0) {
        return found("a part has no triangles: its count is 0", i);
    }
    if (part->first > mesh->triangle_count || part->count > mesh->triangle_count - part->first) {
        return found("a part names triangles that are not there", i);
    }
    return none;
}

static struct ph_finding check_indices(const struct ph_mesh *mesh)
{
    for (uint32_t i = 0; i < mesh->triangle_count; i++) {
        const uint16_t *const t = mesh->triangles[i];
        if (t[0] >= mesh->vertex_count || t[1] >= mesh->vertex_count || t[2] >= mesh->vertex_count) {
            return found("a triangle names a vertex that is not there", i);
        }
    }
    for (uint32_t i = 0; i < mesh->edge_count; i++) {
        if (mesh->edges[i][0] >= mesh->vertex_count || mesh->edges[i][1] >= mesh->vertex_count) {
            return found("an edge names a vertex that is not there", i);
        }
    }
    return none;
}

/* ---- materials -------------------------------------------------------------------------------------------------- */

static const char *wrong_texture(const struct ph_texture *texture)
{
    return texture->texels == NULL ? "a material has a texture without texels"
           : texture->log2_width > PH_TEXTURE_LOG2_MAX || texture->log2_height > PH_TEXTURE_LOG2_MAX
               ? "a material has a texture with a side above 1024: log2_width is 6 for 64 texels"
           : texture->levels > PH_TEXTURE_LOG2_MAX ? "a material has a texture with more than 10 levels"
                                                   : NULL;
}

static const char *wrong_blend(const struct ph_material *material)
{
    const struct ph_blend *const blend = material->blend;
    if (blend->draw == NULL) {
        return "a material has a blend without `draw`: ph_draw_blended";
    }
    if (blend->kind >= PH_BLEND_TIMES && (blend->alpha == 0 || blend->alpha > 32)) {
        return "a material has a blend whose alpha is not 1 .. 32";
    }
    if (blend->alphas == NULL) {
        return blend->kind == PH_BLEND_MASK ? "a material has a blend of PH_BLEND_MASK without alphas" : NULL;
    }
    return blend->kind != PH_BLEND_KEY && ph_texels_of_blend(material) == NULL
               ? "a material has a blend with alphas and no texture: ph_draw_blended_alphas"
               : wrong_texture(blend->alphas);
}

static const char *wrong_light(const struct ph_material *material, const struct ph_mesh *mesh)
{
    const fx_t ambient = material->ambient, diffuse = material->diffuse, specular = material->specular;
    return mesh->normals == NULL ? "a material takes light, and the mesh has no normals"
           : ambient < 0 || diffuse < 0 || specular < 0 || ambient > FX_ONE || diffuse > FX_ONE || specular > FX_ONE
               ? "a material has a share of light that is not 0 .. FX_ONE"
           : ambient < FX_ONE / 256 && diffuse < FX_ONE / 256 && specular < FX_ONE / 256
               ? "a material reflects no light: ambient and diffuse are shares of FX_ONE"
           : material->shininess_log2 > 7 ? "a material has a shininess_log2 above 7"
                                          : NULL;
}

static const char *wrong_material(const struct ph_material *material, const struct ph_mesh *mesh)
{
    const char *what = NULL;
    if (ph_takes_texture(material)) {
        what = material->texture == NULL ? "a material takes a texture and has none"
               : mesh->uvs == NULL       ? "a material has a texture, and the mesh no uvs"
                                         : wrong_texture(material->texture);
    } else if (material->blend != NULL && material->blend->alphas != NULL && mesh->uvs == NULL) {
        what = "a material has alphas, and the mesh no uvs";
    }
    if (what == NULL && material->blend != NULL) {
        what = wrong_blend(material);
    }
    if (what == NULL && ph_lit_corners_of(material) != PH_NO_CORNER) {
        what = wrong_light(material, mesh);
    }
    return what;
}

/* ---- sizes ------------------------------------------------------------------------------------------------------ */

static uint32_t distance(fx_t a, fx_t b)
{
    return a > b ? (uint32_t)a - (uint32_t)b : (uint32_t)b - (uint32_t)a;
}

/* The longest side of the box around all vertices. */
static uint32_t extent_of(const struct ph_mesh *mesh)
{
    struct fx_vec3 low = mesh->positions[0], high = low;
    for (uint32_t i = 1; i < mesh->vertex_count; i++) {
        const struct fx_vec3 *const p = &mesh->positions[i];
        low = (struct fx_vec3){p->x < low.x ? p->x : low.x, p->y < low.y ? p->y : low.y, p->z < low.z ? p->z : low.z};
        high = (struct fx_vec3){p->x > high.x ? p->x : high.x, p->y > high.y ? p->y : high.y,
                                p->z > high.z ? p->z : high.z};
    }
    const uint32_t x = distance(high.x, low.x), y = distance(high.y, low.y), z = distance(high.z, low.z);
    return x > y ? (x > z ? x : z) : (y > z ? y : z);
}

static struct ph_finding check_normals(const struct ph_mesh *mesh)
{
    for (uint32_t i = 0; i < mesh->vertex_count && mesh->normals != NULL; i++) {
        const int16_t *const n = mesh->normals[i];
        const uint32_t length2 = (uint32_t)(n[0] * n[0]) + (uint32_t)(n[1] * n[1]) + (uint32_t)(n[2] * n[2]);
        if (length2 < 8192u * 8192 || length2 > 24576u * 24576) {
            return found("a vertex has a normal that is no unit vector: 16384 is 1", i);
        }
    }
    return none;
}

static struct ph_finding check_sizes(const struct ph_mesh *mesh)
{
    if (extent_of(mesh) < FX_ONE / 64) {
        return found("all positions lie within 1/64: 1 is FX_ONE, 2 is FX_INT(2)", 0);
    }
    uint32_t most = 0;
    for (uint32_t i = 0; i < mesh->vertex_count && mesh->uvs != NULL; i++) {
        const uint32_t u = fx_magnitude(mesh->uvs[i][0]), v = fx_magnitude(mesh->uvs[i][1]);
        most = most > u ? most : u;
        most = most > v ? most : v;
    }
    return most > 0 && most < FX_ONE / 1024 ? found("all uvs lie within 1/1024: the texture's width is FX_ONE", 0)
                                            : none;
}

/* ---- winding ---------------------------------------------------------------------------------------------------- */

struct facing {
    int64_t area[3], volume; /* sums: the area vectors of a closed mesh are 0 together */
    uint32_t with, against;  /* triangles that face as their normals do, and against them */
    uint32_t down;           /* positions are shifted so far, to 10 bits */
};

static void add_triangle(struct facing *f, const struct ph_mesh *mesh, const uint16_t index[3])
{
    int32_t p[3][3], facing[3];
    for (int i = 0; i < 3; i++) {
        const struct fx_vec3 *const at = &mesh->positions[index[i]], *const origin = &mesh->positions[0];
        p[i][0] = (at->x >> f->down) - (origin->x >> f->down);
        p[i][1] = (at->y >> f->down) - (origin->y >> f->down);
        p[i][2] = (at->z >> f->down) - (origin->z >> f->down);
    }
    int64_t along = 0;
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        facing[i] = (p[1][j] - p[0][j]) * (p[2][k] - p[0][k]) - (p[1][k] - p[0][k]) * (p[2][j] - p[0][j]);
        f->area[i] += facing[i];
        f->volume += (int64_t)facing[i] * p[0][i];
        for (int v = 0; v < 3 && mesh->normals != NULL; v++) {
            along += (int64_t)facing[i] * mesh->normals[index[v]][i];
        }
    }
    f->with += along > 0;
    f->against += along < 0;
}

static struct ph_finding check_winding(const struct ph_mesh *mesh, uint32_t extent)
{
    struct facing f = {.down = 0};
    while (extent >> f.down >= 1024) {
        f.down++;
    }
    for (uint32_t i = 0; i < mesh->part_count; i++) {
        const struct ph_part *const part = &mesh->parts[i];
        const struct ph_material *const material = &mesh->materials[part->material];
        if (material->two_sided != 0 || ph_is_wire(material)) {
            return none;
        }
        for (uint32_t k = 0; k < part->count; k++) {
            add_triangle(&f, mesh, mesh->triangles[part->first + k]);
        }
    }
    const bool closed = f.area[0] == 0 && f.area[1] == 0 && f.area[2] == 0;
    return (f.against > 0 && f.with == 0) || (mesh->normals == NULL && closed && f.volume < 0)
               ? found("all triangles face away: they are counter-clockwise seen from outside", 0)
               : none;
}

/* ---- all -------------------------------------------------------------------------------------------------------- */

static struct ph_finding check_parts(const struct ph_mesh *mesh)
{
    for (uint32_t i = 0; i < mesh->part_count; i++) {
        const struct ph_finding f = check_part(mesh, i);
        if (f.what != NULL) {
            return f;
        }
    }
    return none;
}

static struct ph_finding check_materials(const struct ph_mesh *mesh, bool *lit)
{
    for (uint32_t i = 0; i < mesh->part_count; i++) {
        const uint32_t number = mesh->parts[i].material;
        const struct ph_material *const material = &mesh->materials[number];
        const char *const what = wrong_material(material, mesh);
        if (what != NULL) {
            return found(what, number);
        }
        *lit = *lit || ph_lit_corners_of(material) != PH_NO_CORNER;
    }
    return none;
}

struct ph_finding ph_check_mesh(const struct ph_mesh *mesh)
{
    bool lit = false;
    struct ph_finding f = check_arrays(mesh);
    f = f.what != NULL ? f : check_parts(mesh);
    f = f.what != NULL ? f : check_indices(mesh);
    f = f.what != NULL ? f : check_materials(mesh, &lit);
    f = f.what != NULL ? f : check_sizes(mesh);
    f = f.what != NULL || !lit ? f : check_normals(mesh);
    f = f.what != NULL ? f : check_winding(mesh, extent_of(mesh));
    return f.what != NULL || ph_bounds_hold(mesh) ? f : found("a corner lies outside of the bounds: ph_mesh_bounds", 0);
}
