/* The renderer and its memory for tests: see ref_rig.h. */
#include "ref_rig.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void *get_memory(size_t count, size_t size)
{
    void *memory = calloc(count ? count : 1, size);
    if (!memory) {
        abort();
    }
    return memory;
}

static fx_t q16(double v)
{
    return (fx_t)lrint(v * 65536);
}

void rig_open(struct rig *rig, int width, int height, int band_height, const struct ph_depth_format *format,
              int vertex_max, int triangle_max)
{
    size_t bands = (size_t)((height + band_height - 1) / band_height);
    size_t pixels = (size_t)width * (size_t)height;
    memset(rig, 0, sizeof(*rig));
    rig->width = width;
    rig->height = height;
    rig->pixels = get_memory(pixels, sizeof(*rig->pixels));
    rig->depth = get_memory(pixels, sizeof(*rig->depth));
    rig->band_depth = get_memory((size_t)width * (size_t)band_height, ph_depth_bytes(format));
    rig->vertices = get_memory((size_t)vertex_max, ph_vertex_bytes);
    rig->triangles = get_memory((size_t)triangle_max, ph_triangle_bytes);
    rig->bins = get_memory(bands, sizeof(*rig->bins));
    struct ph_config config = {.width = (uint16_t)width,
                               .height = (uint16_t)height,
                               .band_height = (uint16_t)band_height,
                               .depth_format = format,
                               .occlusion = PH_COARSE_DEPTH,
                               .colouring = PH_COLOURS,
                               .vertices = rig->vertices,
                               .vertex_max = (uint32_t)vertex_max,
                               .triangles = rig->triangles,
                               .triangle_max = (uint32_t)triangle_max,
                               .bins = rig->bins,
                               .bin_max = (uint32_t)bands,
                               .depth = rig->band_depth};
    if (ph_renderer_init(&rig->r, &config) != PH_OK) {
        abort();
    }
}

void rig_close(struct rig *rig)
{
    free(rig->pixels);
    free(rig->depth);
    free(rig->band_depth);
    free(rig->vertices);
    free(rig->triangles);
    free(rig->bins);
}

bool rig_finish(struct rig *rig)
{
    uint32_t bands = ph_frame_bands(&rig->r), row = 0;
    for (uint32_t band = 0; band < bands; band++) {
        if (row >= (uint32_t)rig->height) {
            return false;
        }
        size_t at = (size_t)row * (size_t)rig->width;
        uint32_t lines = ph_draw_band(&rig->r, band, rig->pixels + at);
        if (lines == 0 || lines > (uint32_t)rig->height - row) {
            return false;
        }
        for (size_t i = 0; i < lines * (size_t)rig->width; i++) {
            rig->depth[at + i] = ph_depth_bytes(rig->r.config.depth_format) == 4
                                     ? ((const uint32_t *)rig->band_depth)[i]
                                     : ((const uint16_t *)rig->band_depth)[i];
        }
        row += lines;
    }
    return row == (uint32_t)rig->height;
}

void rig_begin(struct rig *rig)
{
    struct ph_projection projection;
    struct ph_scene_light light = {.ambient = q16(.2), .count = 1};
    double to_light[3];
    ref_light(to_light);
    light.lights[0] = (struct ph_light){.kind = PH_LIGHT_DIRECTIONAL,
                                        .intensity = q16(.8),
                                        .to_light_q30 = {(int32_t)lrint(ldexp(to_light[0], 30)),
                                                         (int32_t)lrint(ldexp(to_light[1], 30)),
                                                         (int32_t)lrint(ldexp(to_light[2], 30))}};
    if (ph_projection_perspective(&projection, FX_INT(60), (fx_t)lrint(65536. * rig->width / rig->height),
                                  q16(ref_benchmark.near_z), q16(ref_benchmark.far_z)) != PH_OK ||
        ph_frame_begin(&rig->r, &ph_xform_identity, &projection, &light, 0) != PH_OK) {
        abort();
    }
}

void rig_rgb(const struct rig *rig, int x, int y, double rgb[3])
{
    uint8_t wire[2];
    memcpy(wire, &rig->pixels[y * rig->width + x], 2);
    unsigned code = (unsigned)wire[0] << 8 | wire[1];
    rgb[0] = (code >> 11) * 255. / 31;
    rgb[1] = (code >> 5 & 63) * 255. / 63;
    rgb[2] = (code & 31) * 255. / 31;
}

/* See depth.h: N/z - N/f of an unsigned float, or (0 bits of exponent) of a fixed-point number, from its code in units
 * of fixed16's. */
static double complementary(int bits, double code)
{
    if (bits == 0) {
        return (code - 16.25) / 65536;
    }
    double f = code - 8, octave = ldexp(1, 16 - bits);
    int exponent = (int)fmax(floor(f / octave), 1);
    return ldexp(f / octave - (exponent - 1), exponent - (1 << bits));
}

double rig_format_distance(const struct ph_depth_format *format, int bits, double code, double near_z, double far_z)
{
    double n = near_z * (1 - ldexp(1, bits > 4 ? bits - 13 : -9));
    if (format->coding == PH_DEPTH_IS_LINEAR) {
        return far_z - (code - 16) / (65536 * (1 - 1. / 512)) * (far_z - near_z);
    }
    double unit = ph_depth_bytes(format) == 4 ? 256 : 1;
    if (format->coding == PH_DEPTH_IS_FIXED) {
        n *= fmin(far_z / (far_z - near_z), 8);
    }
    return n / (complementary(bits, code / unit) + n / far_z);
}

double rig_distance(const struct rig *rig, uint32_t code, double near_z, double far_z)
{
    const struct ph_stats *s = &rig->r.stats;
    return rig_format_distance(s->depth_format, s->depth_exponent, code + .5, near_z, far_z);
}

uint16_t rig_fill_colour(int quad)
{
    return ph_rgb565((uint8_t)(30 * quad + 20), (uint8_t)(255 - 25 * quad), (uint8_t)(quad & 1 ? 200 : 90));
}

static void materials_build(struct rig_mesh *m, const struct ref_scene *scene)
{
    static const struct ph_shading *const shading[REF_SCENES] = {PH_SHADE_GOURAUD, PH_SHADE_TEXTURE, PH_SHADE_UNLIT,
                                                                 PH_SHADE_GOURAUD, PH_SHADE_GOURAUD};
    uint32_t parts = scene->id == REF_FILL ? 8 : 1, each = (uint32_t)scene->triangle_count / parts;
    ph_material_ramp(m->ramp, 255, 160, 64, 0);
    for (int y = 0; y < REF_TEXTURE_SIZE; y++) {
        for (int x = 0; x < REF_TEXTURE_SIZE; x++) {
            uint32_t rgb = ref_texel(x, y);
            m->texels[y * REF_TEXTURE_SIZE + x] = ph_rgb565((uint8_t)(rgb >> 16), (uint8_t)(rgb >> 8), (uint8_t)rgb);
        }
    }
    m->texture = (struct ph_texture){.texels = m->texels, .log2_width = 6, .log2_height = 6, .wrap = PH_WRAP_REPEAT};
    for (uint32_t i = 0; i < parts; i++) {
        m->parts[i] = (struct ph_part){i * each, each, (uint16_t)i};
        m->materials[i] = (struct ph_material){.shading = shading[scene->id],
                                               .ambient = FX_ONE,
                                               .diffuse = FX_ONE,
                                               .colour = rig_fill_colour((int)i),
                                               .ramp = m->ramp,
                                               .texture = &m->texture};
    }
    m->mesh.parts = m->parts;
    m->mesh.part_count = parts;
    m->mesh.materials = m->materials;
}

void rig_mesh_build(struct rig_mesh *m, const struct ref_scene *scene)
{
    size_t vertices = (size_t)scene->vertex_count, triangles = (size_t)scene->triangle_count;
    memset(m, 0, sizeof(*m));
    m->positions = get_memory(vertices, sizeof(*m->positions));
    m->normals = get_memory(vertices, sizeof(*m->normals));
    m->uvs = get_memory(vertices, sizeof(*m->uvs));
    m->triangles = get_memory(triangles, sizeof(*m->triangles));
    for (size_t i = 0; i < vertices; i++) {
        const struct ref_vertex *v = &scene->vertices[i];
        m->positions[i] = (struct fx_vec3){q16(v->p[0]), q16(v->p[1]), q16(v->p[2])};
        for (int k = 0; k < 3; k++) {
            m->normals[i][k] = (int16_t)lrint(v->n[k] * 16384);
        }
        m->uvs[i][0] = q16(v->uv[0]);
        m->uvs[i][1] = q16(v->uv[1]);
    }
    for (size_t i = 0; i < triangles; i++) {
        for (int k = 0; k < 3; k++) {
            m->triangles[i][k] = (uint16_t)scene->triangles[i][k];
        }
    }
    m->mesh = (struct ph_mesh){.positions = m->positions,
                               .normals = (const int16_t(*)[3])m->normals,
                               .uvs = (const fx_t(*)[2])m->uvs,
                               .triangles = (const uint16_t(*)[3])m->triangles,
                               .vertex_count = (uint32_t)vertices,
                               .triangle_count = (uint32_t)triangles};
    materials_build(m, scene);
}

void rig_mesh_free(struct rig_mesh *m)
{
    free(m->positions);
    free(m->normals);
    free(m->uvs);
    free(m->triangles);
}

void rig_one_triangle(struct rig_one *one, const struct ph_mesh *mesh, int i)
{
    memset(one, 0, sizeof(*one));
    for (uint16_t k = 0; k < 3; k++) {
        uint16_t from = mesh->triangles[i][k];
        one->positions[k] = mesh->positions[from];
        if (mesh->normals) {
            memcpy(one->normals[k], mesh->normals[from], sizeof(one->normals[k]));
        }
        if (mesh->uvs) {
            memcpy(one->uvs[k], mesh->uvs[from], sizeof(one->uvs[k]));
        }
        one->triangle[0][k] = k;
    }
    for (uint32_t part = 0; part < mesh->part_count; part++) {
        if ((uint32_t)i - mesh->parts[part].first < mesh->parts[part].count) {
            one->material = mesh->materials[mesh->parts[part].material];
        }
    }
    one->part = (struct ph_part){0, 1, 0};
    one->mesh = (struct ph_mesh){.positions = one->positions,
                                 .normals = (const int16_t(*)[3])one->normals,
                                 .uvs = (const fx_t(*)[2])one->uvs,
                                 .triangles = (const uint16_t(*)[3])one->triangle,
                                 .parts = &one->part,
                                 .materials = &one->material,
                                 .vertex_count = 3,
                                 .triangle_count = 1,
                                 .part_count = 1};
}

struct ph_xform rig_pose(const struct ref_scene *scene, int frame)
{
    double pose[3][4];
    struct ph_xform x;
    ref_scene_pose(scene, frame, pose);
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            x.r[i][k] = (int32_t)lrint(ldexp(pose[i][k], 30));
        }
    }
    x.t = (struct fx_vec3){q16(pose[0][3]), q16(pose[1][3]), q16(pose[2][3])};
    return x;
}
