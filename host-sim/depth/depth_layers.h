/*
 * depth_layers: the frames of a demo or a model file, and what lies at each of their pixels: all surfaces, also those
 * that are hidden. A surface is what has one material.
 *
 * The triangles that the demo draws are recorded. The renderer draws each of them alone, and so says which pixels it
 * covers; how far away it is there follows from its corners in double precision. Lines are left out.
 *
 * Under a fisheye distances are those from the eye. It draws a triangle as pieces, and a piece is flat in the picture:
 * inside it the depth that is stored is up to 1/80 off. So the depth that a triangle drawn alone leaves is read back
 * (float24), and how far it is off counts as the sub-pixel grid does.
 */
#ifndef DEPTH_LAYERS_H
#define DEPTH_LAYERS_H

#include "demo.h"
#include "depth_lab.h"

#define SCENE_LAYERS 6 /* the nearest that are kept of a pixel */

struct scene_layer {
    double z_m;
    double slope_m; /* how far the distance changes from pixel to pixel, down its steepest way */
    double off_m;   /* under a fisheye: how far the stored depth is off in any format */
    uint16_t surface;
    uint8_t bias;  /* depth_bias of the material */
    bool parallel; /* under a parallel projection */
};

struct scene_pixel {
    uint32_t count;
    struct scene_layer layers[SCENE_LAYERS]; /* the nearest first; of two that are as near the one drawn first */
};

struct scene_surface {
    const void *material; /* the demo's, to know it again */
    struct ph_material look;
    char colour[8]; /* "#rrggbb" */
};

/* Triangles that follow each other, of one camera and transform. */
struct scene_draw {
    struct ph_xform to_world, view;
    struct ph_projection lens;
    uint32_t first, count;
};

struct scene_triangle {
    struct fx_vec3 p[3];
    uint16_t surface;
};

struct depth_layers {
    const struct depth_lab *lab;
    const struct demo *demo;
    struct model *model; /* NULL: a built-in demo */
    struct demo model_demo;
    struct demo_context context;
    struct ph_renderer renderer;
    struct ph_projection lens; /* of the first frame */
    uint16_t *pixels;
    struct scene_pixel *layers;
    struct scene_surface *surfaces;
    struct ph_material *numbers; /* each surface in the colour that is its number, from 1 on */
    struct scene_draw *draws;
    struct scene_triangle *triangles;
    uint32_t surface_count, draw_count, triangle_count;
    void *memory[3], *depth;
    bool fisheye; /* some camera is one */
    int status;   /* of the recording */
};

/* Metres of the scene in a unit of the model's file; 0: they are the same. */
double depth_layers_file_scale(const struct depth_layers *s);

/* Opens what lab->demo or lab->model names, and finds its lens. 0, COMPLAINED or PH_ERR_INVAL. Close it in any case. */
int depth_layers_open(struct depth_layers *s, const struct depth_lab *lab);
void depth_layers_close(struct depth_layers *s);

/* Records a frame and finds what lies at each of its pixels: s->layers. 0 or COMPLAINED. */
int depth_layers_find(struct depth_layers *s, uint32_t frame);

/* What the linker calls in place of ph_draw_mesh, with the same contract. */
int depth_layers_draw_mesh(struct ph_renderer *r, const struct ph_mesh *mesh, const struct ph_xform *to_world);

/* Draws that frame in a format, with another near plane: s->pixels has the number of the surface that shows, from 1 on,
 * or 0. 0 or COMPLAINED. */
int depth_layers_show(struct depth_layers *s, const struct lab_format *format, fx_t near_z);

#endif
