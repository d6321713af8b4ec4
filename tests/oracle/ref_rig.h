/*
 * ref_rig: the renderer with all its memory, for the raster tests, driven only through its public interface; and the
 * reference's scenes, quantised to its meshes (positions Q16.16, normals Q1.14, matrices Q2.30).
 */
#ifndef REF_RIG_H
#define REF_RIG_H

#include "ref.h"
#include "render.h"

struct rig {
    struct ph_renderer r;
    int width, height;
    uint16_t *pixels; /* the whole picture, wire order */
    uint32_t *depth;  /* the whole picture's depth codes, collected band by band */
    void *vertices, *triangles;
    uint32_t *bins;
    void *band_depth;
};

/* Aborts when out of memory or when the renderer refuses the configuration. */
void rig_open(struct rig *rig, int width, int height, int band_height, const struct ph_depth_format *format,
              int vertex_max, int triangle_max);
void rig_close(struct rig *rig);

/* All bands into rig->pixels and rig->depth. False if the bands do not add up to the picture. */
bool rig_finish(struct rig *rig);

/* Begins a frame of a reference scene: camera at the origin, the benchmark's projection and light, black. */
void rig_begin(struct rig *rig);

/* A pixel as 0 .. 255 each of red, green and blue. */
void rig_rgb(const struct rig *rig, int x, int y, double rgb[3]);

/* The distance at which a perspective's depth code would be exactly this number (see depth.h), computed in double. */
double rig_format_distance(const struct ph_depth_format *format, int bits, double code, double near_z, double far_z);

/* The distance along the view that a depth code stands for: the middle of what it covers; code not 0. */
double rig_distance(const struct rig *rig, uint32_t code, double near_z, double far_z);

struct rig_mesh {
    struct ph_mesh mesh;
    struct fx_vec3 *positions;
    int16_t (*normals)[3];
    fx_t (*uvs)[2];
    uint16_t (*triangles)[3];
    struct ph_part parts[8];
    struct ph_material materials[8];
    uint16_t ramp[PH_RAMP_SIZE];
    uint16_t texels[REF_TEXTURE_SIZE * REF_TEXTURE_SIZE];
    struct ph_texture texture;
};

/* The whole scene, shaded as the benchmark says. Quad q of the fill scene has colour rig_fill_colour(q). */
void rig_mesh_build(struct rig_mesh *m, const struct ref_scene *scene);
void rig_mesh_free(struct rig_mesh *m);
uint16_t rig_fill_colour(int quad);

/* Triangle number i alone, as a mesh of three vertices; valid until the next call for the same `one`. */
struct rig_one {
    struct ph_mesh mesh;
    struct fx_vec3 positions[3];
    int16_t normals[3][3];
    fx_t uvs[3][2];
    uint16_t triangle[1][3];
    struct ph_part part;
    struct ph_material material;
};
void rig_one_triangle(struct rig_one *one, const struct ph_mesh *mesh, int i);

struct ph_xform rig_pose(const struct ref_scene *scene, int frame);

#endif
