/* See depth_planes_scene.h. */
#include "depth_planes_scene.h"

#include "complain.h"

#include <math.h>
#include <stdlib.h>

#define CORNER_MAX 1073741824.0 /* 2^30: numerators then fit 64 bits */
#define GUARD      3.9          /* half pictures that a corner may lie off the middle without being clipped */

int depth_planes_open(struct planes_canvas *canvas, const struct depth_lab *lab, const struct ph_depth_format *format)
{
    const size_t area = (size_t)lab->width * lab->height;
    const size_t vertices = PLANES_VERTICES * ph_vertex_bytes, triangles = PLANES_TRIANGLES * ph_triangle_bytes;
    *canvas = (struct planes_canvas){.lab = lab, .view = ph_xform_identity};
    depth_lab_projection(lab, &canvas->projection);
    char *memory = malloc(vertices + triangles + 8 + area * (4 + sizeof *canvas->pixels + 1));
    canvas->memory = memory;
    if (memory == NULL) {
        return complain("planes: no memory for a picture of %ux%u", lab->width, lab->height);
    }
    char *const depth = memory + vertices + triangles + 8;
    canvas->pixels = (uint16_t *)(void *)(depth + area * 4);
    canvas->verdicts = (uint8_t *)(canvas->pixels + area);
    const struct ph_config config = {.width = lab->width,
                                     .height = lab->height,
                                     .band_height = lab->height,
                                     .depth_format = format,
                                     .depth_exponent = lab->exponent,
                                     .vertices = memory,
                                     .vertex_max = PLANES_VERTICES,
                                     .triangles = memory + vertices,
                                     .triangle_max = PLANES_TRIANGLES,
                                     .bins = (uint32_t *)(void *)(memory + vertices + triangles),
                                     .bin_max = 1,
                                     .depth = (void *)depth};
    return ph_renderer_init(&canvas->renderer, &config) == PH_OK
               ? 0
               : complain("planes: the renderer does not draw this format");
}

void depth_planes_close(struct planes_canvas *canvas)
{
    free(canvas->memory);
    canvas->memory = NULL;
}

static double clamp(double v, double least, double most)
{
    return v < least ? least : v > most ? most : v;
}

struct planes_place depth_planes_whole(const struct depth_lab *lab, struct planes_lean lean, double separation_m)
{
    const double slope = tan(depth_radians(lean.tilt_deg));
    double half, side;
    depth_planes_extent(lab, lean.azimuth_deg, &half, &side);
    const double nearest = depth_metres(lab->near_z) + separation_m + 2.0 / 65536, farthest = depth_metres(lab->far_z);
    struct planes_place place = {lean, separation_m, -half, half, side, 0, 0};
    /* D = at / (1 - s slope) from nearest to farthest */
    const double at_near = slope != 0 ? (1 - lean.at_m / nearest) / slope : 0;
    const double at_far = slope != 0 ? (1 - lean.at_m / farthest) / slope : 0;
    if (slope > 0) {
        place.slope_low = clamp(at_near, -half, half);
        place.slope_high = clamp(at_far, -half, half);
    } else if (slope < 0) {
        place.slope_low = clamp(at_far, -half, half);
        place.slope_high = clamp(at_near, -half, half);
    }
    return place;
}

void depth_planes_turn(struct planes_canvas *canvas, double azimuth_deg)
{
    const double turns = -azimuth_deg / 360;
    canvas->view = ph_xform_rotate_z((uint32_t)(int64_t)floor((turns - floor(turns)) * 4294967296.0));
}

static fx_t to_fx(double v)
{
    return (fx_t)floor(v * 65536 + 0.5);
}

static bool is_inside(const struct depth_lab *lab, const struct planes_quad *quad)
{
    const int64_t d0 = -(int64_t)quad->a.z, d1 = d0 - quad->vz;
    return d0 >= lab->near_z && d0 <= lab->far_z && d1 >= lab->near_z && d1 <= lab->far_z;
}

bool depth_planes_make(const struct depth_lab *lab, const struct planes_place *place, struct planes_pair *pair)
{
    const double angle = depth_radians(place->lean.tilt_deg), lean = tan(angle), at_m = place->lean.at_m;
    const double d0 = at_m / (1 - place->slope_low * lean), d1 = at_m / (1 - place->slope_high * lean);
    const double nearest = d0 < d1 ? d0 : d1, farthest = d0 < d1 ? d1 : d0;
    const double pixel = depth_pixel_slope(lab);
    const double side = fmin(place->slope_side * farthest, GUARD * pixel * lab->width / 2 * nearest);
    const double largest = fmax(fmax(farthest, side * 2), farthest * pixel * lab->height / 2) * 65536;
    if (!(nearest > 0) || !(largest < CORNER_MAX)) {
        return false;
    }
    struct planes_quad *const behind = &pair->behind;
    behind->a =
        (struct fx_vec3){to_fx(place->slope_middle * farthest - side), to_fx(place->slope_low * d0), to_fx(-d0)};
    behind->ux = to_fx(2 * side);
    behind->vy = (to_fx(place->slope_high * d1) - behind->a.y) / PLANES_PARTS * PLANES_PARTS;
    behind->vz = (to_fx(-d1) - behind->a.z) / PLANES_PARTS * PLANES_PARTS;
    pair->front = *behind;
    pair->front.a.x += place->shift * behind->ux / (3 * PLANES_PARTS);
    pair->front.a.y += to_fx(place->separation_m * sin(angle)) + behind->vy / PLANES_PARTS * place->shift;
    pair->front.a.z += to_fx(place->separation_m * cos(angle)) + behind->vz / PLANES_PARTS * place->shift;
    return behind->ux > 0 && behind->vy > 0 && is_inside(lab, behind) && is_inside(lab, &pair->front);
}

const struct ph_material *depth_planes_paint(struct planes_canvas *canvas, uint16_t colour)
{
    struct planes_paint *const paint = &canvas->paint[colour - 1];
    for (int i = 0; i < PH_RAMP_SIZE; i++) {
        paint->ramp[i] = colour;
    }
    paint->texture = (struct ph_texture){.texels = paint->ramp};
    paint->material = (struct ph_material){.shading = depth_shadings[canvas->shading],
                                           .two_sided = 1,
                                           .ambient = FX_ONE,
                                           .diffuse = FX_ONE,
                                           .colour = colour,
                                           .ramp = paint->ramp,
                                           .texture = &paint->texture};
    return &paint->material;
}

static void draw_quad(struct planes_canvas *canvas, const struct planes_quad *quad, uint16_t colour)
{
    static const uint16_t triangles[][3] = {{0, 1, 2}, {0, 2, 3}};
    static const int16_t normals[4][3] = {{0, 0, 16384}, {11585, 0, 11585}, {0, 11585, 11585}, {0, 0, 16384}};
    static const fx_t uvs[4][2] = {{0, 0}, {FX_ONE, 0}, {FX_ONE, FX_ONE}, {0, FX_ONE}};
    const struct fx_vec3 a = quad->a;
    const struct fx_vec3 corners[] = {a,
                                      {a.x + quad->ux, a.y, a.z},
                                      {a.x + quad->ux, a.y + quad->vy, a.z + quad->vz},
                                      {a.x, a.y + quad->vy, a.z + quad->vz}};
    const struct ph_part part = {.count = 2};
    const struct ph_mesh mesh = {.positions = corners,
                                 .normals = normals,
                                 .uvs = uvs,
                                 .vertex_count = 4,
                                 .triangles = triangles,
                                 .triangle_count = 2,
                                 .parts = &part,
                                 .part_count = 1,
                                 .materials = depth_planes_paint(canvas, colour)};
    ph_draw_mesh(&canvas->renderer, &mesh, &ph_xform_identity);
}

void depth_planes_draw(struct planes_canvas *canvas, const struct planes_quad *behind, const struct planes_quad *front)
{
    struct ph_renderer *const r = &canvas->renderer;
    if (canvas->draw != NULL) {
        canvas->draw(canvas, behind, front);
        return;
    }
    ph_frame_begin(r, &canvas->view, &canvas->projection, NULL, PLANES_NONE);
    if (behind != NULL) {
        draw_quad(canvas, behind, PLANES_BEHIND);
    }
    if (front != NULL) {
        draw_quad(canvas, front, PLANES_FRONT);
    }
    ph_frame_bands(r);
    ph_draw_band(r, 0, canvas->pixels);
}

uint32_t depth_planes_code(const struct planes_canvas *canvas, uint32_t pixel)
{
    const struct ph_config *const config = &canvas->renderer.config;
    return ph_depth_bytes(config->depth_format) == 4 ? ((const uint32_t *)config->depth)[pixel]
                                                     : ((const uint16_t *)config->depth)[pixel];
}

static int64_t numerator(const struct planes_quad *quad)
{
    return (int64_t)quad->vz * quad->a.y - (int64_t)quad->a.z * quad->vy;
}

struct planes_ray depth_planes_ray(const struct planes_canvas *canvas, double x, double y)
{
    const double width = canvas->lab->width, height = canvas->lab->height;
    return (struct planes_ray){(2 * x + 1 - width) * 1048576 / (canvas->projection.scale_x_q20 * width),
                               (height - 1 - 2 * y) * 1048576 / (canvas->projection.scale_y_q20 * height)};
}

double depth_planes_distance_m(const struct planes_canvas *canvas, const struct planes_quad *quad, uint32_t pixel)
{
    const struct planes_ray ray = depth_planes_ray(canvas, pixel % canvas->lab->width, pixel / canvas->lab->width);
    const double slope = (ray.right * canvas->view.r[0][1] + ray.up * canvas->view.r[1][1]) / FX_Q30_ONE;
    return (double)numerator(quad) / (quad->vy + slope * quad->vz) / 65536;
}

bool depth_planes_front_is_nearer(const struct planes_pair *pair)
{
    const int64_t front = numerator(&pair->front), behind = numerator(&pair->behind);
    return front >= 0 ? front < behind : front > behind;
}

double depth_planes_separation_m(const struct planes_pair *pair)
{
    const double apart = (double)(numerator(&pair->behind) - numerator(&pair->front));
    return apart / hypot(pair->behind.vy, pair->behind.vz) / 65536;
}
