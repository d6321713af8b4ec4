/*
 * pinhole-depth scenes: surfaces that meet at steep angles, through the renderer. At each pixel that two surfaces cover
 * the one that shows is compared with the one that is nearer on the ray of the pixel, in double precision. A sphere
 * drawn twice, the second time in another shading, must not show the second time: of equal depths the first stays.
 */
#include "complain.h"
#include "depth_planes_scene.h"
#include "progress.h"

#include <math.h>

#define TILES    15
#define SEGMENTS 24
#define RINGS    11 /* of vertices between the poles */

/* Three or four corners in one plane, counter-clockwise or not. */
struct face {
    struct fx_vec3 corners[4];
    uint16_t count;
};

/* The surface drawn first, and the other. */
struct pair {
    struct face first, second;
};

struct result {
    uint32_t pixels, wrong;
    double largest_m, at_m; /* how far the surface that shows lies behind the other, and where */
};

static fx_t to_fx(double v)
{
    return (fx_t)floor(v * 65536 + 0.5);
}

static struct fx_vec3 point(double x, double y, double distance)
{
    return (struct fx_vec3){to_fx(x), to_fx(y), to_fx(-distance)};
}

/* A floor below the eye from `from` to `to`, and a wall that stands on it and faces the camera. */
static struct pair floor_and_wall(double eye, double half, double from, double to, double wall)
{
    return (struct pair){
        {{point(-half, -eye, from), point(half, -eye, from), point(half, -eye, to), point(-half, -eye, to)}, 4},
        {{point(-half, -2 * eye, wall), point(half, -2 * eye, wall), point(half, eye, wall), point(-half, eye, wall)},
         4}};
}

/* Scene: 0 and 1 a floor with a wall, 2 tiles with a card on each, 3 triangles from near to far that cross. */
static uint32_t pair_count(int scene)
{
    return scene == 2 ? TILES : 1;
}

static struct pair make_pair(const struct depth_lab *lab, int scene, uint32_t i)
{
    const double n = depth_metres(lab->near_z), f = depth_metres(lab->far_z), side = f / 5;
    const double from = fmax(1.1 * n, 0.03 * f), eye = 0.016 * f, across = side * ((int)(i % 3) - 1);
    if (scene < 2) {
        return scene == 0 ? floor_and_wall(eye, side, 0.6 * f, 0.8 * f, 2 * f / 3)
                          : floor_and_wall(from / 20, side, from, 0.999 * f, fmin(2 * from, 0.9 * f));
    }
    if (scene == 2) {
        const double start = 1.1 * n + (f - side - 1.2 * n) * (i + 0.37) / TILES;
        struct pair tile = floor_and_wall(eye, side / 2, start, start + side, start + side * 0.43);
        for (int k = 0; k < 4; k++) {
            tile.first.corners[k].x += to_fx(across);
            tile.second.corners[k].x += to_fx(across);
        }
        return tile;
    }
    const double deep = 0.95 * f, wide = depth_pixel_slope(lab) * lab->height / 2, near_wide = from * wide;
    return (struct pair){
        {{point(-near_wide, -near_wide, from), point(deep * wide, -deep * wide / 2, deep), point(0, deep * wide, deep)},
         3},
        {{point(near_wide, -near_wide, 1.05 * from), point(0, deep * wide / 2, deep / 2),
          point(-deep * wide, -deep * wide / 2, deep)},
         3}};
}

/* ---- two surfaces ----------------------------------------------------------------------------------------- */

static void draw_face(struct planes_canvas *canvas, const struct face *face, uint16_t colour)
{
    static const uint16_t triangles[][3] = {{0, 1, 2}, {0, 2, 3}};
    static const int16_t normals[4][3] = {{0, 0, 16384}, {11585, 0, 11585}, {0, 11585, 11585}, {0, 0, 16384}};
    static const fx_t uvs[4][2] = {{0, 0}, {FX_ONE, 0}, {FX_ONE, FX_ONE}, {0, FX_ONE}};
    const struct ph_part part = {.count = face->count - 2u};
    const struct ph_mesh mesh = {.positions = face->corners,
                                 .normals = normals,
                                 .uvs = uvs,
                                 .vertex_count = face->count,
                                 .triangles = triangles,
                                 .triangle_count = face->count - 2u,
                                 .parts = &part,
                                 .part_count = 1,
                                 .materials = depth_planes_paint(canvas, colour)};
    ph_draw_mesh(&canvas->renderer, &mesh, &ph_xform_identity);
}

static void draw_faces(struct planes_canvas *canvas, const struct face *first, const struct face *second)
{
    ph_frame_begin(&canvas->renderer, &canvas->view, &canvas->projection, NULL, PLANES_NONE);
    if (first != NULL) {
        draw_face(canvas, first, PLANES_BEHIND);
    }
    if (second != NULL) {
        draw_face(canvas, second, PLANES_FRONT);
    }
    ph_frame_bands(&canvas->renderer);
    ph_draw_band(&canvas->renderer, 0, canvas->pixels);
}

/* The distance at which the ray of a pixel meets the plane of a face. */
static double distance_m(const struct planes_canvas *canvas, const struct face *face, uint32_t pixel)
{
    const struct planes_ray ray = depth_planes_ray(canvas, pixel % canvas->lab->width, pixel / canvas->lab->width);
    const struct fx_vec3 a = face->corners[0], b = face->corners[1], c = face->corners[2];
    const double ux = (double)b.x - a.x, uy = (double)b.y - a.y, uz = (double)b.z - a.z;
    const double vx = (double)c.x - a.x, vy = (double)c.y - a.y, vz = (double)c.z - a.z;
    const double nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
    return (nx * a.x + ny * a.y + nz * a.z) / (nx * ray.right + ny * ray.up - nz) / 65536;
}

static void count_pair(struct planes_canvas *canvas, const struct pair *pair, struct result *result)
{
    const uint32_t area = (uint32_t)canvas->lab->width * canvas->lab->height;
    draw_faces(canvas, &pair->first, NULL);
    for (uint32_t i = 0; i < area; i++) {
        canvas->verdicts[i] = canvas->pixels[i] != PLANES_NONE;
    }
    draw_faces(canvas, NULL, &pair->second);
    for (uint32_t i = 0; i < area; i++) {
        canvas->verdicts[i] = canvas->verdicts[i] != 0 && canvas->pixels[i] != PLANES_NONE;
    }
    draw_faces(canvas, &pair->first, &pair->second);
    for (uint32_t i = 0; i < area; i++) {
        if (canvas->verdicts[i] == 0) {
            continue;
        }
        const double first = distance_m(canvas, &pair->first, i), second = distance_m(canvas, &pair->second, i);
        const double behind = canvas->pixels[i] == PLANES_BEHIND ? first - second : second - first;
        result->pixels++;
        result->wrong += behind > 0;
        if (behind > result->largest_m) {
            result->largest_m = behind;
            result->at_m = fmax(first, second);
        }
    }
}

/* ---- the sphere ------------------------------------------------------------------------------------------- */

struct sphere {
    struct fx_vec3 positions[RINGS * SEGMENTS + 2];
    int16_t normals[RINGS * SEGMENTS + 2][3];
    fx_t uvs[RINGS * SEGMENTS + 2][2];
    uint16_t triangles[2 * RINGS * SEGMENTS][3];
};

static void make_sphere(struct sphere *sphere, double distance, double radius)
{
    const uint16_t top = RINGS * SEGMENTS, bottom = top + 1;
    uint32_t n = 0;
    for (uint16_t i = 0; i < top + 2; i++) {
        const double down = i < top    ? depth_radians(180) * (i / SEGMENTS + 1) / (RINGS + 1)
                            : i == top ? 0
                                       : 4 * atan(1);
        const double around = depth_radians(360) * (i % SEGMENTS) / SEGMENTS;
        const double x = sin(down) * cos(around), y = cos(down), z = sin(down) * sin(around);
        sphere->positions[i] = point(radius * x, radius * y, distance - radius * z);
        sphere->normals[i][0] = (int16_t)(16384 * x);
        sphere->normals[i][1] = (int16_t)(16384 * y);
        sphere->normals[i][2] = (int16_t)(16384 * z);
        sphere->uvs[i][0] = to_fx(around);
        sphere->uvs[i][1] = to_fx(down);
    }
    for (uint16_t i = 0; i < top; i++) {
        const uint16_t right = (uint16_t)(i % SEGMENTS == SEGMENTS - 1 ? i + 1 - SEGMENTS : i + 1);
        const bool last = i / SEGMENTS == RINGS - 1, first = i < SEGMENTS;
        const uint16_t faces[2][3] = {{i, right, (uint16_t)(last ? bottom : i + SEGMENTS)},
                                      {right, i, (uint16_t)(first ? top : right - SEGMENTS)}};
        for (int k = 0; k < 6; k++) {
            sphere->triangles[n + (uint32_t)k / 3][k % 3] = faces[k / 3][k % 3];
        }
        n += 2;
    }
}

static void draw_sphere(struct planes_canvas *canvas, const struct sphere *sphere, uint16_t colour)
{
    const struct ph_part part = {.count = 2 * RINGS * SEGMENTS};
    const struct ph_mesh mesh = {.positions = sphere->positions,
                                 .normals = sphere->normals,
                                 .uvs = sphere->uvs,
                                 .vertex_count = RINGS * SEGMENTS + 2,
                                 .triangles = sphere->triangles,
                                 .triangle_count = 2 * RINGS * SEGMENTS,
                                 .parts = &part,
                                 .part_count = 1,
                                 .materials = depth_planes_paint(canvas, colour)};
    ph_draw_mesh(&canvas->renderer, &mesh, &ph_xform_identity);
}

/* The sphere in each shading, and in the row's shading over it. */
static void count_sphere(struct planes_canvas *canvas, struct result *result)
{
    const double n = depth_metres(canvas->lab->near_z), f = depth_metres(canvas->lab->far_z);
    const double distance = fmax(0.3 * f, (n + f) / 2 - 0.2 * f), radius = fmin(0.1 * f, (f - n) / 4);
    const uint8_t shading = canvas->shading;
    struct sphere sphere;
    make_sphere(&sphere, distance, radius);
    for (unsigned below = 0; below < DEPTH_SHADINGS; below++) {
        ph_frame_begin(&canvas->renderer, &canvas->view, &canvas->projection, NULL, PLANES_NONE);
        canvas->shading = (uint8_t)below;
        draw_sphere(canvas, &sphere, PLANES_BEHIND);
        canvas->shading = shading;
        draw_sphere(canvas, &sphere, PLANES_FRONT);
        ph_frame_bands(&canvas->renderer);
        ph_draw_band(&canvas->renderer, 0, canvas->pixels);
        for (uint32_t i = 0; i < (uint32_t)canvas->lab->width * canvas->lab->height; i++) {
            result->pixels += canvas->pixels[i] != PLANES_NONE;
            result->wrong += canvas->pixels[i] == PLANES_FRONT;
        }
    }
}

/* ---- the table -------------------------------------------------------------------------------------------- */

static void put_scene(struct planes_canvas *canvas, const struct lab_format *format, int scene)
{
    static const char *const names[] = {"floor and wall", "long floor", "tiles", "crossing", "sphere twice"};
    const struct depth_lab *lab = canvas->lab;
    struct result result = {0, 0, 0, 0};
    for (uint32_t i = 0; scene < 4 && i < pair_count(scene); i++) {
        const struct pair pair = make_pair(lab, scene, i);
        count_pair(canvas, &pair, &result);
    }
    if (scene == 4) {
        count_sphere(canvas, &result);
    }
    fprintf(lab->rows, "%s,%u,%.10g,%.10g,%s,%s,%u,%u,", format->name, format->bits, depth_metres(lab->near_z),
            depth_metres(lab->far_z), names[scene], depth_shading_names[canvas->shading], (unsigned)result.pixels,
            (unsigned)result.wrong);
    if (result.largest_m > 0) {
        fprintf(lab->rows, "%.10g,%.6g,%.4g\n", result.largest_m, result.at_m,
                depth_step_m(format->format, lab, result.at_m));
    } else {
        fputs(",,\n", lab->rows);
    }
}

static int put_format(const struct depth_lab *lab, const struct lab_format *format)
{
    struct planes_canvas canvas;
    const int status = depth_planes_open(&canvas, lab, format->format);
    for (int scene = 0; scene < 5 && status == 0; scene++) {
        for (unsigned shading = 0; shading < DEPTH_SHADINGS; shading++) {
            canvas.shading = (uint8_t)shading;
            put_scene(&canvas, format, scene);
        }
    }
    depth_planes_close(&canvas);
    return status;
}

int depth_scenes(const struct depth_lab *lab)
{
    const uint32_t rows = depth_drawn_formats(lab);
    int status =
        rows != 0 ? 0 : complain_usage("--depth: scenes draws with the renderer's own formats; --help lists them");
    fputs("format,bits,near,far,scene,shading,pixels,wrong,largest_wrong_m,at_m,step_m\n", lab->rows);
    for (uint32_t i = 0; i < lab_format_count && status == 0; i++) {
        const struct depth_lab own = depth_lab_of(lab, i);
        depth_lab_progress("scenes", rows, i);
        status = (rows >> i & 1) != 0 ? put_format(&own, &lab_formats[i]) : 0;
    }
    progress_show("scenes", 1, 1);
    return status;
}
