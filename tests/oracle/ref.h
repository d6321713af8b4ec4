/*
 * ref: the independent reference of the raster tests, in double precision.
 *
 * It shares no code with firmware/: the five benchmark scenes are built from their formulas with libm, and pixels come
 * from exact geometry instead of a pipeline. For the ray q through a pixel centre and a triangle (a, b, c) in view
 * space (eye at the origin), the signs of the volumes q.(b x c), q.(c x a), q.(a x b) say whether the ray meets the
 * triangle, and their sizes say where. No clipping, projection of vertices or interpolation can go wrong. The near and
 * far planes only compare the depth found. a x b is exactly -(b x a) in IEEE arithmetic, so two
 * triangles agree about the edge that they share, also when it passes behind the eye.
 *
 * Right-handed, y up, camera at the origin looking along -z; pixel (i, j) has its centre at (i + .5, j + .5), row 0 at
 * the top; top-left rule. Triangles are counter-clockwise seen from outside, back faces are culled. z below is the
 * positive distance along the view.
 */
#ifndef REF_H
#define REF_H

#include <stdbool.h>
#include <stdint.h>

enum ref_scene_id { REF_TORUS, REF_CUBE, REF_FILL, REF_SPHERE, REF_GROUND, REF_SCENES };

#define REF_TEXTURE_SIZE 64

struct ref_vertex {
    double p[3]; /* position in the model */
    double n[3]; /* unit normal */
    double uv[2];
};

struct ref_scene {
    enum ref_scene_id id;
    const char *name;
    int vertex_count, triangle_count;
    struct ref_vertex *vertices;
    int (*triangles)[3];
    int *faces; /* triangles of one flat face have one number (cube, fill); else the triangle's own */
};

struct ref_camera {
    int width, height;
    double fov_y; /* radians */
    double near_z, far_z;
};

struct ref_pixel {
    int triangle;     /* the nearest; -1: none */
    int count;        /* front faces that cover the pixel */
    double z;         /* of the nearest, distance along the view */
    double intensity; /* .2 + .8 max(0, n.l), perspective-correct between the vertices */
    double uv[2];
};

struct ref_picture {
    struct ref_camera camera;
    struct ref_pixel *pixels;
};

/* The camera of the benchmark. */
extern const struct ref_camera ref_benchmark;

/* All abort on lack of memory. */
void ref_scene_build(struct ref_scene *scene, enum ref_scene_id id);
void ref_scene_free(struct ref_scene *scene);

/* Model to view: rotation in columns 0..2, translation in column 3, for frame 0 .. 63. */
void ref_scene_pose(const struct ref_scene *scene, int frame, double pose[3][4]);

/* Direction to the light, unit length, in view space. */
void ref_light(double direction[3]);

/* Texel (x, y) of the benchmark's texture as 0xRRGGBB. */
uint32_t ref_texel(int x, int y);

void ref_draw(struct ref_picture *picture, const struct ref_camera *camera, const struct ref_scene *scene, int frame);
void ref_picture_free(struct ref_picture *picture);

/* Pixel (x, y); outside the picture an empty one. */
struct ref_pixel ref_at(const struct ref_picture *picture, int x, int y);

/* Window depth (1/n - 1/z) / (1/n - 1/f): 0 at the near, 1 at the far plane. */
double ref_window_depth(const struct ref_camera *camera, double z);

#endif
