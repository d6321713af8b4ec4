/*
 * depth_scene: the frames of a demo or a model file, drawn by the renderer, and what lies at each of their pixels: all
 * surfaces, also those that are hidden. A surface is what has one material.
 *
 * The renderer lists a frame's triangles; here each of them is drawn alone, so that the renderer itself says which
 * pixels it covers, and its plane says how far away it is there.
 */
#ifndef DEPTH_SCENE_H
#define DEPTH_SCENE_H

#include "demo.h"
#include "depth_lab.h"

#define SCENE_LAYERS 6 /* the nearest that are kept of a pixel */

struct scene_layer {
    double z_m;
    double slope_m; /* how far the distance changes from pixel to pixel, down its steepest way */
    uint16_t surface;
};

struct scene_pixel {
    uint32_t count;
    struct scene_layer layers[SCENE_LAYERS]; /* the nearest first; of two that are as near the one drawn first */
};

struct depth_scene {
    const struct depth_lab *lab;
    const struct demo *demo;
    struct model *model; /* NULL: a built-in demo */
    struct demo model_demo;
    struct demo_context context;
    struct ph_renderer renderer;
    struct ph_projection lens; /* of the first frame, before another near plane was asked for */
    uint16_t *pixels;
    struct scene_pixel *layers;
    const struct ph_material **surfaces;
    uint16_t (*ramps)[PH_RAMP_SIZE]; /* each filled with the number of a surface, from 1 on */
    uint32_t surface_count, surface_max;
    void *memory[3];
};

/* Opens what lab->demo or lab->model names, and finds its lens. 0, COMPLAINED or PH_ERR_INVAL. Close it in any case. */
int depth_scene_open(struct depth_scene *s, const struct depth_lab *lab);
void depth_scene_close(struct depth_scene *s);

/* Sets up a frame in a format, with another near plane. 0 or COMPLAINED. */
int depth_scene_frame(struct depth_scene *s, uint32_t frame, const struct lab_format *format, fx_t near_z);

/* What lies at each pixel of the frame, in s->layers; the format must be float24. */
void depth_scene_layers(struct depth_scene *s);

/* What the renderer shows: s->pixels has the number of the surface, from 1 on, or 0. After it set up a frame again. */
void depth_scene_show(struct depth_scene *s);

/* The colour of a surface as "#rrggbb". */
void depth_scene_colour(const struct depth_scene *s, uint32_t surface, char text[8]);

#endif
