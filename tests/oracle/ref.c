/* The reference: rays through pixel centres. See ref.h. */
#include "ref.h"

#include <math.h>
#include <stdlib.h>

#define PI 3.14159265358979323846

const struct ref_camera ref_benchmark = {320, 240, PI / 3, .5, 100};

struct view_vertex {
    double p[3];
    double intensity;
    double uv[2];
};

/* An edge as the plane through it and the eye: q.m < 0 for the rays q that pass inside (front faces). */
struct edge {
    double m[3];
    bool owns_zero; /* a left or top edge: rays that meet the edge itself are inside */
};

struct view_triangle {
    const struct view_vertex *v[3];
    struct edge edges[3]; /* edges[k] is opposite vertex k */
    double volume;
};

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double out[3])
{
    for (int k = 0; k < 3; k++) {
        int l = (k + 1) % 3, m = (k + 2) % 3;
        out[k] = a[l] * b[m] - a[m] * b[l];
    }
}

static void pixel_ray(const struct ref_camera *camera, int x, int y, double q[3])
{
    double focal = camera->height / 2. / tan(camera->fov_y / 2);
    q[0] = (x + .5 - camera->width / 2.) / focal;
    q[1] = -(y + .5 - camera->height / 2.) / focal;
    q[2] = -1;
}

static void view_vertices(const struct ref_scene *scene, int frame, struct view_vertex *out)
{
    double pose[3][4], light[3];
    ref_scene_pose(scene, frame, pose);
    ref_light(light);
    for (int i = 0; i < scene->vertex_count; i++) {
        const struct ref_vertex *in = &scene->vertices[i];
        double lit = 0;
        for (int k = 0; k < 3; k++) {
            out[i].p[k] = dot(pose[k], in->p) + pose[k][3];
            lit += dot(pose[k], in->n) * light[k];
        }
        out[i].intensity = .2 + .8 * fmax(0, lit);
        out[i].uv[0] = in->uv[0];
        out[i].uv[1] = in->uv[1];
    }
}

/* False for back faces and triangles seen edge-on. */
static bool triangle_set_up(struct view_triangle *t, const struct view_vertex *v, const int index[3])
{
    for (int k = 0; k < 3; k++) {
        t->v[k] = &v[index[k]];
    }
    for (int k = 0; k < 3; k++) {
        struct edge *e = &t->edges[k];
        cross(t->v[(k + 1) % 3]->p, t->v[(k + 2) % 3]->p, e->m);
        /* Inside is where q.m falls; to the right of a left edge, and, screen y pointing down, below a top one. */
        e->owns_zero = e->m[0] < 0 || (e->m[0] == 0 && e->m[1] > 0);
    }
    t->volume = dot(t->v[0]->p, t->edges[0].m);
    return t->volume < 0;
}

static bool ray_meets(const struct view_triangle *t, const double q[3], double weight[3])
{
    for (int k = 0; k < 3; k++) {
        weight[k] = dot(q, t->edges[k].m);
        if (weight[k] > 0 || (weight[k] == 0 && !t->edges[k].owns_zero)) {
            return false;
        }
    }
    return weight[0] + weight[1] + weight[2] < 0;
}

static void shade_pixel(const struct ref_camera *camera, const struct view_triangle *t, int number, const double q[3],
                        struct ref_pixel *pixel)
{
    double weight[3];
    if (!ray_meets(t, q, weight)) {
        return;
    }
    double sum = weight[0] + weight[1] + weight[2], z = t->volume / sum;
    if (z < camera->near_z || z > camera->far_z) {
        return;
    }
    pixel->count++;
    if (pixel->triangle >= 0 && z >= pixel->z) {
        return;
    }
    *pixel = (struct ref_pixel){.triangle = number, .count = pixel->count, .z = z};
    for (int k = 0; k < 3; k++) {
        pixel->intensity += weight[k] / sum * t->v[k]->intensity;
        pixel->uv[0] += weight[k] / sum * t->v[k]->uv[0];
        pixel->uv[1] += weight[k] / sum * t->v[k]->uv[1];
    }
}

/* Pixels that may meet the triangle: all where a vertex lies before the near plane, else a box with a pixel to spare.
 */
static void pixel_box(const struct ref_camera *camera, const struct view_triangle *t, int low[2], int high[2])
{
    double focal = camera->height / 2. / tan(camera->fov_y / 2), size[2] = {camera->width, camera->height};
    double least[2] = {size[0], size[1]}, most[2] = {0, 0};
    for (int k = 0; k < 3; k++) {
        const double *p = t->v[k]->p;
        for (int axis = 0; axis < 2; axis++) {
            if (-p[2] < camera->near_z) {
                least[axis] = 0;
                most[axis] = size[axis];
                continue;
            }
            double s = size[axis] / 2 + focal * (axis ? -p[1] : p[0]) / -p[2];
            least[axis] = fmin(least[axis], s);
            most[axis] = fmax(most[axis], s);
        }
    }
    for (int axis = 0; axis < 2; axis++) {
        low[axis] = (int)fmax(0, fmin(least[axis], size[axis]) - 1);
        high[axis] = (int)fmin(size[axis] - 1, fmax(most[axis], 0) + 1);
    }
}

void ref_draw(struct ref_picture *picture, const struct ref_camera *camera, const struct ref_scene *scene, int frame)
{
    int pixels = camera->width * camera->height;
    struct view_vertex *v = calloc((size_t)scene->vertex_count, sizeof(*v));
    picture->camera = *camera;
    picture->pixels = calloc((size_t)pixels, sizeof(*picture->pixels));
    if (!v || !picture->pixels) {
        abort();
    }
    for (int i = 0; i < pixels; i++) {
        picture->pixels[i].triangle = -1;
    }
    view_vertices(scene, frame, v);
    for (int i = 0; i < scene->triangle_count; i++) {
        struct view_triangle t;
        int low[2], high[2];
        if (!triangle_set_up(&t, v, scene->triangles[i])) {
            continue;
        }
        pixel_box(camera, &t, low, high);
        for (int y = low[1]; y <= high[1]; y++) {
            for (int x = low[0]; x <= high[0]; x++) {
                double q[3];
                pixel_ray(camera, x, y, q);
                shade_pixel(camera, &t, i, q, &picture->pixels[y * camera->width + x]);
            }
        }
    }
    free(v);
}

void ref_picture_free(struct ref_picture *picture)
{
    free(picture->pixels);
}

struct ref_pixel ref_at(const struct ref_picture *picture, int x, int y)
{
    if (x < 0 || y < 0 || x >= picture->camera.width || y >= picture->camera.height) {
        return (struct ref_pixel){.triangle = -1};
    }
    return picture->pixels[y * picture->camera.width + x];
}

double ref_window_depth(const struct ref_camera *camera, double z)
{
    double n = camera->near_z, f = camera->far_z;
    return (1 / n - 1 / z) / (1 / n - 1 / f);
}
