#include "depth_scene.h"

#include "complain.h"
#include "depth.h"
#include "model.h"
#include "progress.h"
#include "triangle.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SPARE        4096 /* triangles for what another camera clips */
#define SURFACES_MAX 4096

static int find(struct depth_scene *s, const struct depth_lab *lab)
{
    if (lab->model == NULL) {
        s->demo = demo_find(lab->demo);
        if (s->demo == NULL) {
            return complain_usage("--demo '%s': no such demo; pinhole-sim --list shows them", lab->demo);
        }
    } else {
        const int status = model_open(&s->model, lab->model);
        if (status != 0) {
            return status;
        }
        s->model_demo = model_demo(s->model);
        s->demo = &s->model_demo;
        s->context.state = s->model;
    }
    if (lab->view != NULL && !demo_has_view(s->demo, lab->view)) {
        return complain_usage("--view '%s': %s has no such view; pinhole-sim --list shows them", lab->view,
                              s->demo->name);
    }
    return 0;
}

/* The same camera as pinhole-sim's: the demo's own lens fits its own view only. */
static void set_camera(struct depth_scene *s, const struct depth_lab *lab)
{
    struct demo_camera *const camera = &s->context.camera;
    camera->view_set = lab->camera_set;
    if (lab->camera_set) {
        camera->view = ph_view_look_at(lab->eye, lab->target, lab->up);
    }
    camera->projection_set = lab->camera_set || lab->fov_set || lab->near_set || lab->far_set;
    depth_lab_projection(lab, &camera->projection);
}

static int open_memory(struct depth_scene *s)
{
    const size_t area = (size_t)s->lab->width * s->lab->height;
    const uint32_t vertices = s->demo->vertex_max + 8, triangles = 2 * s->demo->triangle_max + SPARE;
    s->context.arena.size = s->demo->arena_bytes + 64;
    s->memory[0] = calloc(1, s->context.arena.size);
    s->memory[1] = calloc(vertices, ph_vertex_bytes);
    s->memory[2] = calloc(triangles, ph_triangle_bytes);
    s->pixels = calloc(area + 2, sizeof *s->pixels + sizeof(uint32_t)); /* depth, bin and pixels */
    s->layers = calloc(area, sizeof *s->layers);
    s->surfaces = calloc(SURFACES_MAX, sizeof *s->surfaces);
    s->ramps = calloc(SURFACES_MAX, sizeof *s->ramps);
    s->context.arena.base = s->memory[0];
    if (s->memory[0] == NULL || s->memory[1] == NULL || s->memory[2] == NULL || s->pixels == NULL ||
        s->layers == NULL || s->surfaces == NULL || s->ramps == NULL) {
        return complain("no memory for this scene at %ux%u", s->lab->width, s->lab->height);
    }
    uint32_t *const depth = (uint32_t *)(void *)s->pixels;
    s->pixels = (uint16_t *)(void *)(depth + area + 1);
    s->renderer.config = (struct ph_config){.width = s->lab->width,
                                            .height = s->lab->height,
                                            .band_height = s->lab->height,
                                            .vertices = s->memory[1],
                                            .vertex_max = vertices,
                                            .triangles = s->memory[2],
                                            .triangle_max = triangles,
                                            .bins = depth + area,
                                            .bin_max = 1,
                                            .depth = depth};
    return 0;
}

int depth_scene_open(struct depth_scene *s, const struct depth_lab *lab)
{
    *s = (struct depth_scene){.lab = lab, .surface_max = SURFACES_MAX};
    s->context.width = lab->width;
    s->context.height = lab->height;
    s->context.view = lab->view;
    int status = find(s, lab);
    if (status == 0) {
        status = open_memory(s);
    }
    if (status != 0) {
        return status;
    }
    set_camera(s, lab);
    if (s->demo->init(&s->context) != 0) {
        return complain("%s: its arena is too small for this picture", s->demo->name);
    }
    status = depth_scene_frame(s, lab->start, &lab_formats[0], 0);
    s->lens = s->renderer.projection;
    if (status == 0 && s->lens.kind == PH_ORTHOGRAPHIC) {
        return complain_usage("%s: its projection is parallel; there fixed16 resolves a 65408th of far - near at every "
                              "distance",
                              s->demo->name);
    }
    return status;
}

void depth_scene_close(struct depth_scene *s)
{
    for (int i = 0; i < 3; i++) {
        free(s->memory[i]);
    }
    free(s->renderer.config.depth != NULL ? s->renderer.config.depth : s->pixels);
    free(s->layers);
    free(s->surfaces);
    free(s->ramps);
    model_close(s->model);
}

int depth_scene_frame(struct depth_scene *s, uint32_t frame, const struct lab_format *format, fx_t near_z)
{
    struct ph_config config = s->renderer.config;
    config.depth_format = format->format;
    config.depth_exponent = format->exponent;
    if (near_z != 0) {
        s->context.camera.projection_set = true;
        s->context.camera.projection = s->lens;
        s->context.camera.projection.near_z = near_z;
    }
    int status = ph_renderer_init(&s->renderer, &config);
    if (status == 0) {
        status = s->demo->frame(&s->context, &s->renderer, frame);
    }
    const struct ph_stats *stats = &s->renderer.stats;
    if (status != 0 || stats->triangles_dropped != 0 || stats->vertices_dropped != 0) {
        return complain("frame %u cannot be drawn with this camera (%d)", (unsigned)frame, status);
    }
    return 0;
}

/* The number of a material. Materials beyond the last number count as the last. */
static uint16_t surface_of(struct depth_scene *s, const struct ph_material *material)
{
    uint32_t i = 0;
    while (i < s->surface_count && s->surfaces[i] != material) {
        i++;
    }
    if (i == s->surface_count && i + 1 < s->surface_max) {
        s->surfaces[i] = material;
        for (int k = 0; k < PH_RAMP_SIZE; k++) {
            s->ramps[i][k] = (uint16_t)(i + 1);
        }
        s->surface_count++;
    }
    return (uint16_t)(i < s->surface_count ? i : s->surface_count - 1);
}

/* Distance from the value of a triangle's plane; it is no whole number a pixel beside. See depth.h. */
static double distance_m(const struct depth_scene *s, const struct ph_triangle *t, double value)
{
    const int bits = s->renderer.stats.depth_exponent, top = (1 << bits) - 1;
    const double head = 1 - ldexp(1, bits > 4 ? bits - 13 : -9);
    const double near_m = s->renderer.projection.near_z / 65536.0 * head,
                 far_m = s->renderer.projection.far_z / 65536.0;
    double d = ldexp(value, -32 - ph_block_exponent(t->block));
    if (t->block == PH_BLOCK_NONE) {
        const double f = ldexp(value - PH_DEPTH_BIAS_FLOAT16, -32 + bits); /* in octaves */
        const double exponent = fmin(fmax(floor(f), 1), top);
        d = ldexp(f - (exponent - 1), (int)exponent - top - 1);
    }
    return near_m / (fmax(d, 0) + near_m / far_m);
}

static struct scene_layer layer_of(const struct depth_scene *s, const struct ph_triangle *t, uint32_t x, uint32_t y)
{
    const double value = ph_plane_at(&t->depth, x, y), here = distance_m(s, t, value);
    const double right = distance_m(s, t, value + (int32_t)t->depth.gx);
    const double below = distance_m(s, t, value + (int32_t)t->depth.gy);
    return (struct scene_layer){.z_m = here, .slope_m = hypot(right - here, below - here)};
}

static void insert(struct scene_pixel *pixel, struct scene_layer layer)
{
    uint32_t at = pixel->count < SCENE_LAYERS ? pixel->count++ : SCENE_LAYERS;
    if (at == SCENE_LAYERS) {
        if (layer.z_m >= pixel->layers[--at].z_m) {
            return;
        }
    }
    for (; at > 0 && pixel->layers[at - 1].z_m > layer.z_m; at--) {
        pixel->layers[at] = pixel->layers[at - 1];
    }
    pixel->layers[at] = layer;
}

/* Draws one triangle of the list; it stands in the first place then. */
static void draw_alone(struct depth_scene *s, const struct ph_triangle *t)
{
    struct ph_triangle *const first = ph_triangles(&s->renderer);
    *first = *t;
    s->renderer.triangle_count = 1;
    ph_frame_bands(&s->renderer);
    ph_draw_band(&s->renderer, 0, s->pixels);
}

void depth_scene_layers(struct depth_scene *s)
{
    const uint32_t n = s->renderer.triangle_count, width = s->lab->width;
    const struct ph_triangle *const list = ph_triangles(&s->renderer), zero = *list;
    const uint32_t *const depth = s->renderer.config.depth;
    memset(s->layers, 0, (size_t)width * s->lab->height * sizeof *s->layers);
    for (uint32_t i = 0; i < n; i++) {
        const struct ph_triangle t = i == 0 ? zero : list[i];
        const uint16_t surface = surface_of(s, t.material);
        draw_alone(s, &t);
        for (uint32_t y = (uint32_t)t.y_top; y < (uint32_t)t.y_bottom; y++) {
            for (uint32_t x = 0; x < width; x++) {
                if (depth[y * width + x] != 0) {
                    struct scene_layer layer = layer_of(s, &t, x, y);
                    layer.surface = surface;
                    insert(&s->layers[y * width + x], layer);
                }
            }
        }
        progress_show("surfaces", i, n);
    }
    progress_show("surfaces", 1, 1);
}

void depth_scene_show(struct depth_scene *s)
{
    struct ph_triangle *const list = ph_triangles(&s->renderer);
    for (uint32_t i = 0; i < s->renderer.triangle_count; i++) {
        const uint16_t surface = surface_of(s, list[i].material);
        if (list[i].kind == PH_KIND_SMALL) {
            list[i].small.ramp = s->ramps[surface];
        } else {
            list[i].kind = PH_KIND_FLAT;
            list[i].colour = (uint16_t)(surface + 1);
        }
    }
    s->renderer.background = 0;
    ph_frame_bands(&s->renderer);
    ph_draw_band(&s->renderer, 0, s->pixels);
}

void depth_scene_colour(const struct depth_scene *s, uint32_t surface, char text[8])
{
    const struct ph_material *const m = s->surfaces[surface];
    const bool lit = (m->shading == PH_SHADE_FLAT || m->shading == PH_SHADE_GOURAUD) && m->ramp != NULL;
    const uint16_t wire = lit ? m->ramp[PH_RAMP_SIZE * 3 / 4] : m->colour;
    const uint8_t *const bytes = (const uint8_t *)&wire;
    const unsigned v = (unsigned)bytes[0] << 8 | bytes[1];
    snprintf(text, 8, "#%02x%02x%02x", (v >> 11) * 255 / 31, (v >> 5 & 63) * 255 / 63, (v & 31) * 255 / 31);
}
