/* See depth_layers.h. ph_draw_mesh is replaced at link time by a recorder; each triangle is then drawn alone. */
#include "depth_layers.h"

#include "complain.h"
#include "depth_budget_terms.h"
#include "model.h"
#include "nearest.h"
#include "progress.h"
#include "wire_colour.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SPARE         4096 /* triangles for what another camera clips */
#define SURFACES_MAX  4096
#define DRAWS_MAX     65536
#define TRIANGLES_MAX 1000000
#define CHUNK         16384 /* triangles of a mesh: it has at most 65536 vertices */

static const struct lab_format float24 = {.format = PH_DEPTH_FLOAT24};

/* ---- recording ---------------------------------------------------------------------------------------------- */

/* The linker's name for ph_draw_mesh itself where depth_layers_draw_mesh stands for it: see the Makefile. */
// NOLINTNEXTLINE(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)
int __real_ph_draw_mesh(struct ph_renderer *r, const struct ph_mesh *mesh, const struct ph_xform *to_world);

static struct depth_layers *recording; /* the scene whose demo is at work, or NULL */

static void name_colour(struct scene_surface *surface)
{
    const struct ph_material *const m = &surface->look;
    const bool lit = (m->shading == PH_SHADE_FLAT || m->shading == PH_SHADE_GOURAUD) && m->ramp != NULL;
    const uint16_t wire = lit ? m->ramp[PH_RAMP_SIZE * 3 / 4] : m->colour;
    uint8_t rgb[3];
    wire_colour(wire, rgb);
    snprintf(surface->colour, sizeof surface->colour, "#%02x%02x%02x", rgb[0], rgb[1], rgb[2]);
}

/* The number of a material. Materials beyond the last number count as the last. */
static uint16_t surface_of(struct depth_layers *s, const struct ph_material *material)
{
    uint32_t i = 0;
    while (i < s->surface_count && s->surfaces[i].material != material) {
        i++;
    }
    if (i == SURFACES_MAX) {
        return SURFACES_MAX - 1;
    }
    if (i == s->surface_count) {
        s->surfaces[i] = (struct scene_surface){.material = material, .look = *material};
        s->numbers[i] = (struct ph_material){.shading = PH_SHADE_UNLIT,
                                             .two_sided = material->two_sided,
                                             .depth_bias = material->depth_bias,
                                             .colour = (uint16_t)(i + 1)};
        name_colour(&s->surfaces[i]);
        s->surface_count++;
    }
    return (uint16_t)i;
}

static void record(struct depth_layers *s, const struct ph_mesh *mesh, const struct ph_xform *to_world)
{
    if (s->draw_count == DRAWS_MAX || mesh->triangle_count > TRIANGLES_MAX - s->triangle_count) {
        s->status = complain("advise: a frame of more than %d triangles", TRIANGLES_MAX);
        return;
    }
    struct scene_draw *const draw = &s->draws[s->draw_count++];
    *draw = (struct scene_draw){*to_world, s->renderer.view, s->renderer.projection, s->triangle_count, 0};
    for (uint32_t i = 0; i < mesh->part_count; i++) {
        const struct ph_part *const part = &mesh->parts[i];
        const struct ph_material *const material = &mesh->materials[part->material];
        const uint16_t surface = surface_of(s, material);
        for (uint32_t k = part->first; k < part->first + part->count && material->shading != PH_SHADE_WIRE; k++) {
            const uint16_t *const corner = mesh->triangles[k];
            const struct fx_vec3 *const p = mesh->positions;
            s->triangles[s->triangle_count++] =
                (struct scene_triangle){{p[corner[0]], p[corner[1]], p[corner[2]]}, surface};
        }
    }
    draw->count = s->triangle_count - draw->first;
}

int depth_layers_draw_mesh(struct ph_renderer *r, const struct ph_mesh *mesh, const struct ph_xform *to_world)
{
    if (recording != NULL && recording->status == 0) {
        record(recording, mesh, to_world);
    }
    return __real_ph_draw_mesh(r, mesh, to_world);
}

double depth_layers_file_scale(const struct depth_layers *s)
{
    return s->model != NULL ? s->model->scale : 0;
}

/* ---- opening ------------------------------------------------------------------------------------------------ */

static int find(struct depth_layers *s, const struct depth_lab *lab)
{
    if (lab->model == NULL) {
        s->demo = demo_find(lab->demo);
        if (s->demo == NULL) {
            return complain_usage("--demo '%s': no such demo; %spinhole-sim --list shows them", lab->demo,
                                  nearest_text(lab->demo, nearest_demo, NULL));
        }
    } else {
        const struct model_options options = {.allow_outside = lab->allow_outside};
        const int status = model_open(&s->model, lab->model, &options);
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

/* Sets the camera as pinhole-sim does: the demo's own lens fits its own view only. */
static void set_camera(struct depth_layers *s, const struct depth_lab *lab)
{
    struct demo_camera *const camera = &s->context.camera;
    camera->view_set = lab->camera.set;
    camera->view = lab->camera.view;
    camera->projection_set = lab->camera.set || lab->fov_set || lab->near_set || lab->far_set;
    depth_lab_projection(lab, &camera->projection);
}

static int open_memory(struct depth_layers *s)
{
    const size_t area = (size_t)s->lab->width * s->lab->height;
    const uint32_t vertices = s->demo->vertex_max > 3 * CHUNK ? s->demo->vertex_max : 3 * CHUNK;
    const uint32_t triangles = 2 * (s->demo->triangle_max > CHUNK ? s->demo->triangle_max : CHUNK) + SPARE;
    s->context.arena.size = s->demo->arena_bytes + 64;
    s->context.arena.base = s->memory[0] = calloc(1, s->context.arena.size);
    s->memory[1] = calloc(vertices, ph_vertex_bytes);
    s->memory[2] = calloc(triangles, ph_triangle_bytes);
    s->depth = calloc(area + 1, sizeof(uint32_t)); /* and a bin */
    s->pixels = calloc(area, sizeof *s->pixels);
    s->layers = calloc(area, sizeof *s->layers);
    s->surfaces = calloc(SURFACES_MAX, sizeof *s->surfaces);
    s->numbers = calloc(SURFACES_MAX, sizeof *s->numbers);
    s->draws = calloc(DRAWS_MAX, sizeof *s->draws);
    s->triangles = calloc(TRIANGLES_MAX, sizeof *s->triangles);
    if (s->memory[0] == NULL || s->memory[1] == NULL || s->memory[2] == NULL || s->depth == NULL || s->pixels == NULL ||
        s->layers == NULL || s->surfaces == NULL || s->numbers == NULL || s->draws == NULL || s->triangles == NULL) {
        return complain("no memory for this scene at %ux%u", s->lab->width, s->lab->height);
    }
    s->renderer.config = (struct ph_config){.width = s->lab->width,
                                            .height = s->lab->height,
                                            .band_height = s->lab->height,
                                            .depth_format = PH_DEPTH_FIXED16,
                                            .colouring = PH_COLOURS,
                                            .vertices = s->memory[1],
                                            .vertex_max = vertices,
                                            .triangles = s->memory[2],
                                            .triangle_max = triangles,
                                            .bins = (uint32_t *)s->depth + area,
                                            .bin_max = 1,
                                            .depth = s->depth};
    return 0;
}

static int start(struct depth_layers *s, const struct lab_format *format)
{
    struct ph_config config = s->renderer.config;
    config.depth_format = format->format;
    config.depth_exponent = format->exponent;
    return ph_renderer_init(&s->renderer, &config);
}

static int record_frame(struct depth_layers *s, uint32_t frame)
{
    s->draw_count = s->triangle_count = 0;
    int status = start(s, &lab_formats[0]);
    if (status == 0) {
        recording = s;
        status = s->demo->frame(&s->context, &s->renderer, frame);
        recording = NULL;
    }
    return s->status != 0 ? s->status
           : status != 0  ? complain("frame %u cannot be drawn with this camera (%d)", (unsigned)frame, status)
                          : 0;
}

int depth_layers_open(struct depth_layers *s, const struct depth_lab *lab)
{
    *s = (struct depth_layers){.lab = lab, .context = {.width = lab->width, .height = lab->height, .view = lab->view}};
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
    status = record_frame(s, lab->start);
    s->lens = s->renderer.projection;
    return status;
}

void depth_layers_close(struct depth_layers *s)
{
    for (int i = 0; i < 3; i++) {
        free(s->memory[i]);
    }
    free(s->depth);
    free(s->pixels);
    free(s->layers);
    free(s->surfaces);
    free(s->numbers);
    free(s->draws);
    free(s->triangles);
    model_close(s->model);
}

/* ---- drawing ------------------------------------------------------------------------------------------------ */

/* Lists up to CHUNK triangles of a draw, in colours that are the numbers of their surfaces. */
static int draw_chunk(struct depth_layers *s, const struct scene_draw *draw, uint32_t first, uint32_t count)
{
    static struct fx_vec3 positions[3 * CHUNK];
    static uint16_t faces[CHUNK][3];
    static struct ph_part parts[CHUNK];
    for (uint32_t i = 0; i < count; i++) {
        const struct scene_triangle *const t = &s->triangles[first + i];
        for (uint32_t k = 0; k < 3; k++) {
            positions[3 * i + k] = t->p[k];
            faces[i][k] = (uint16_t)(3 * i + k);
        }
        parts[i] = (struct ph_part){i, 1, t->surface};
    }
    const struct ph_mesh mesh = {.positions = positions,
                                 .vertex_count = 3 * count,
                                 .triangles = faces,
                                 .triangle_count = count,
                                 .parts = parts,
                                 .part_count = count,
                                 .materials = s->numbers};
    return __real_ph_draw_mesh(&s->renderer, &mesh, &draw->to_world);
}

static void draw_band(struct depth_layers *s)
{
    ph_frame_bands(&s->renderer);
    ph_draw_band(&s->renderer, 0, s->pixels);
}

/* Begins with a camera of a draw, or sets it in the same frame. */
static int set_lens(struct depth_layers *s, const struct scene_draw *draw, fx_t near_z, bool begin)
{
    struct ph_projection lens = draw->lens;
    lens.near_z = near_z != 0 ? near_z : lens.near_z;
    return begin ? ph_frame_begin(&s->renderer, &draw->view, &lens, NULL, 0)
                 : ph_frame_camera(&s->renderer, &draw->view, &lens);
}

int depth_layers_show(struct depth_layers *s, const struct lab_format *format, fx_t near_z)
{
    int status = start(s, format);
    for (uint32_t i = 0; i < s->draw_count && status == 0; i++) {
        const struct scene_draw *const draw = &s->draws[i];
        status = set_lens(s, draw, near_z, i == 0);
        for (uint32_t k = 0; k < draw->count && status == 0; k += CHUNK) {
            status = draw_chunk(s, draw, draw->first + k, draw->count - k < CHUNK ? draw->count - k : CHUNK);
        }
    }
    memset(s->pixels, 0, (size_t)s->lab->width * s->lab->height * sizeof *s->pixels);
    if (status == 0 && s->draw_count > 0) {
        draw_band(s);
    }
    return status == 0 && s->renderer.stats.triangles_dropped == 0
               ? 0
               : complain("%s: too many triangles for this camera", s->demo->name);
}

/* ---- what lies at the pixels -------------------------------------------------------------------------------- */

/* A triangle before the eye: n.p = c, x to the right, y up, distances along the view; and how far away it reaches. */
struct plane {
    double n[3], c, nearest, farthest;
};

static void to_view(const struct scene_draw *draw, struct fx_vec3 p, double out[3])
{
    const struct ph_xform *const steps[2] = {&draw->to_world, &draw->view};
    double v[3] = {p.x / 65536.0, p.y / 65536.0, p.z / 65536.0};
    for (int step = 0; step < 2; step++) {
        const double t[3] = {steps[step]->t.x / 65536.0, steps[step]->t.y / 65536.0, steps[step]->t.z / 65536.0};
        for (int i = 0; i < 3; i++) {
            out[i] = t[i];
            for (int k = 0; k < 3; k++) {
                out[i] += ldexp(steps[step]->r[i][k], -30) * v[k];
            }
        }
        memcpy(v, out, sizeof v);
    }
    out[2] = -out[2];
}

static struct plane plane_of(const struct scene_draw *draw, const struct scene_triangle *t)
{
    const bool fisheye = draw->lens.kind == PH_FISHEYE;
    double p[3][3], a[3], b[3];
    struct plane plane = {.c = 0, .nearest = HUGE_VAL};
    for (int i = 0; i < 3; i++) {
        to_view(draw, t->p[i], p[i]);
        const double distance = fisheye ? hypot(hypot(p[i][0], p[i][1]), p[i][2]) : p[i][2];
        plane.nearest = fmin(plane.nearest, distance);
        plane.farthest = fmax(plane.farthest, distance);
    }
    for (int i = 0; i < 3; i++) {
        a[i] = p[1][i] - p[0][i];
        b[i] = p[2][i] - p[0][i];
    }
    for (int i = 0; i < 3; i++) {
        plane.n[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
        plane.c += plane.n[i] * p[0][i];
    }
    if (fisheye) { /* the nearest point need not be a corner */
        plane.nearest = fmin(plane.nearest, fabs(plane.c) / hypot(hypot(plane.n[0], plane.n[1]), plane.n[2]));
    }
    return plane;
}

/* The ray through a point of the picture, in pixels; a fisheye's has the length 1, a perspective's goes 1 along the
 * view, and so does that of a parallel projection from the point that it begins at. */
static void ray_at(const struct depth_layers *s, const struct ph_projection *lens, double column, double row,
                   double ray[3])
{
    const double sx = ldexp(lens->scale_x_q20, -20), sy = ldexp(lens->scale_y_q20, -20);
    const double right = 2 * column / s->lab->width - 1 + lens->shift_x / 65536.0;
    const double up = 1 - 2 * row / s->lab->height + lens->shift_y / 65536.0;
    const double aspect = (double)s->lab->width / s->lab->height, angle = hypot(right * aspect, up) / sy;
    if (lens->kind != PH_FISHEYE) {
        ray[0] = right / sx;
        ray[1] = up / sy;
        ray[2] = 1;
        return;
    }
    const double g = angle > 0 ? sin(angle) / angle : 1;
    ray[0] = g * right * aspect / sy;
    ray[1] = g * up / sy;
    ray[2] = cos(angle);
}

/* n.ray in the middle of a pixel, moved by so much of a pixel. */
static double along_ray(const struct depth_layers *s, const struct ph_projection *lens, const struct plane *plane,
                        double column, double row)
{
    double ray[3];
    ray_at(s, lens, column + 0.5, row + 0.5, ray);
    return plane->n[0] * ray[0] + plane->n[1] * ray[1] + plane->n[2] * ray[2];
}

static struct scene_layer layer_at(const struct depth_layers *s, const struct scene_draw *draw,
                                   const struct plane *plane, uint32_t column, uint32_t row)
{
    const struct ph_projection *const lens = &draw->lens;
    const bool parallel = lens->kind == PH_ORTHOGRAPHIC;
    const double at = along_ray(s, lens, plane, column, row), along = parallel ? plane->n[2] : at;
    const double z = (parallel ? plane->c - (at - plane->n[2]) : plane->c) / along;
    const double from = plane->nearest, to = plane->farthest;
    const double within = fmin(fmax(z, from), to); /* NaN: edge-on */
    const double right = along_ray(s, lens, plane, column + 0.5, row) - along_ray(s, lens, plane, column - 0.5, row);
    const double down = along_ray(s, lens, plane, column, row + 0.5) - along_ray(s, lens, plane, column, row - 0.5);
    const double slope = fabs((parallel ? 1 : within) / along) * hypot(right, down), most = to - from;
    return (struct scene_layer){.z_m = within, .slope_m = slope < most ? slope : most, .parallel = parallel};
}

/* A bias of 8 is about 2^-12 of the distance towards the eye. */
static double order_of(const struct scene_layer *layer)
{
    return layer->z_m * (1 - ldexp(layer->bias, -15));
}

static void insert(struct scene_pixel *pixel, const struct scene_layer *layer)
{
    uint32_t at = pixel->count;
    if (at < SCENE_LAYERS) {
        pixel->count++;
    } else if (order_of(layer) >= order_of(&pixel->layers[--at])) {
        return;
    }
    for (; at > 0 && order_of(&pixel->layers[at - 1]) > order_of(layer); at--) {
        pixel->layers[at] = pixel->layers[at - 1];
    }
    pixel->layers[at] = *layer;
}

/* The distance that a pixel's float24 depth stands for; depth_bias moves it by an eighth of a code of 16 bits. */
static double stored_m(const struct depth_layers *s, const struct ph_projection *lens, uint32_t at, unsigned bias)
{
    struct depth_lab lab = *s->lab;
    lab.near_z = lens->near_z;
    lab.far_z = lens->far_z;
    lab.exponent = s->renderer.stats.depth_exponent;
    return depth_distance_of(PH_DEPTH_FLOAT24, &lab, ((const uint32_t *)s->depth)[at] + 0.5 - 32.0 * bias);
}

static int add_triangle(struct depth_layers *s, const struct scene_draw *draw, uint32_t i)
{
    const struct scene_triangle *const t = &s->triangles[i];
    const uint32_t width = s->lab->width, height = s->lab->height;
    const struct plane plane = plane_of(draw, t);
    int status = set_lens(s, draw, 0, true);
    if (status == 0) {
        status = draw_chunk(s, draw, i, 1);
    }
    if (status != 0 || s->renderer.stats.triangles_drawn == 0) {
        return status;
    }
    draw_band(s);
    for (uint32_t at = 0; at < width * height; at++) {
        if (s->pixels[at] != 0) {
            struct scene_layer layer = layer_at(s, draw, &plane, at % width, at / width);
            layer.surface = t->surface;
            layer.bias = s->surfaces[t->surface].look.depth_bias;
            layer.off_m =
                draw->lens.kind == PH_FISHEYE ? fabs(stored_m(s, &draw->lens, at, layer.bias) - layer.z_m) : 0;
            insert(&s->layers[at], &layer);
        }
    }
    return 0;
}

int depth_layers_find(struct depth_layers *s, uint32_t frame)
{
    int status = record_frame(s, frame);
    s->fisheye = false;
    for (uint32_t i = 0; i < s->draw_count; i++) {
        s->fisheye |= s->draws[i].lens.kind == PH_FISHEYE;
    }
    if (status == 0 && s->fisheye) {
        status = start(s, &float24);
    }
    memset(s->layers, 0, (size_t)s->lab->width * s->lab->height * sizeof *s->layers);
    for (uint32_t i = 0; i < s->draw_count && status == 0; i++) {
        const struct scene_draw *const draw = &s->draws[i];
        for (uint32_t k = 0; k < draw->count && status == 0; k++) {
            status = add_triangle(s, draw, draw->first + k);
            progress_show("surfaces", draw->first + k, s->triangle_count);
        }
    }
    progress_show("surfaces", 1, 1);
    return status == 0 || status == COMPLAINED ? status
                                               : complain("frame %u cannot be drawn (%d)", (unsigned)frame, status);
}
