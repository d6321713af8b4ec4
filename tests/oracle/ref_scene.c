/* The five benchmark scenes from their formulas; see ref.h. */
#include "ref.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846

#define TORUS_MAJOR   32
#define TORUS_MINOR   16
#define SPHERE_LEVELS 4
#define GROUND_CELLS  20

static void *get_memory(size_t count, size_t size)
{
    void *memory = calloc(count, size);
    if (!memory) {
        abort();
    }
    return memory;
}

static void scene_alloc(struct ref_scene *scene, int vertices, int triangles)
{
    scene->vertices = get_memory((size_t)vertices, sizeof(*scene->vertices));
    scene->triangles = get_memory((size_t)triangles, sizeof(*scene->triangles));
    scene->faces = get_memory((size_t)triangles, sizeof(*scene->faces));
    for (int i = 0; i < triangles; i++) {
        scene->faces[i] = i;
    }
}

static void normalise(double v[3])
{
    double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int k = 0; k < 3; k++) {
        v[k] /= length;
    }
}

static void add_triangle(struct ref_scene *scene, int a, int b, int c)
{
    int *t = scene->triangles[scene->triangle_count++];
    t[0] = a;
    t[1] = b;
    t[2] = c;
}

static void build_torus(struct ref_scene *scene)
{
    scene_alloc(scene, TORUS_MAJOR * TORUS_MINOR, 2 * TORUS_MAJOR * TORUS_MINOR);
    for (int i = 0; i < TORUS_MAJOR; i++) {
        for (int j = 0; j < TORUS_MINOR; j++) {
            double u = 2 * PI * i / TORUS_MAJOR, v = 2 * PI * j / TORUS_MINOR;
            struct ref_vertex *at = &scene->vertices[scene->vertex_count++];
            *at = (struct ref_vertex){.p = {(1 + .4 * cos(v)) * cos(u), (1 + .4 * cos(v)) * sin(u), .4 * sin(v)},
                                      .n = {cos(v) * cos(u), cos(v) * sin(u), sin(v)}};
            int i1 = (i + 1) % TORUS_MAJOR, j1 = (j + 1) % TORUS_MINOR;
            int a = i * TORUS_MINOR + j, b = i1 * TORUS_MINOR + j, c = i1 * TORUS_MINOR + j1, d = i * TORUS_MINOR + j1;
            add_triangle(scene, a, b, c);
            add_triangle(scene, a, c, d);
        }
    }
}

static void build_cube(struct ref_scene *scene)
{
    static const double faces[6][3][3] = {
        {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}},  {{0, 0, -1}, {-1, 0, 0}, {0, 1, 0}}, {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}},
        {{-1, 0, 0}, {0, 0, 1}, {0, 1, 0}}, {{0, 1, 0}, {1, 0, 0}, {0, 0, -1}},  {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}},
    };
    static const double corners[4][2] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    scene_alloc(scene, 24, 12);
    for (int face = 0; face < 6; face++) {
        int first = scene->vertex_count;
        for (int corner = 0; corner < 4; corner++) {
            double u = corners[corner][0], v = corners[corner][1];
            struct ref_vertex *at = &scene->vertices[scene->vertex_count++];
            for (int k = 0; k < 3; k++) {
                at->n[k] = faces[face][0][k];
                at->p[k] = at->n[k] + (2 * u - 1) * faces[face][1][k] + (1 - 2 * v) * faces[face][2][k];
            }
            at->uv[0] = u;
            at->uv[1] = v;
        }
        scene->faces[scene->triangle_count] = face;
        add_triangle(scene, first, first + 1, first + 2);
        scene->faces[scene->triangle_count] = face;
        add_triangle(scene, first, first + 2, first + 3);
    }
}

static void build_fill(struct ref_scene *scene)
{
    static const double depths[8] = {10, 8, 6, 4, 5, 7, 9, 11};
    static const int corners[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    scene_alloc(scene, 32, 16);
    for (int quad = 0; quad < 8; quad++) {
        double h = 1.02 * tan(PI / 6) * depths[quad], w = 4. / 3 * h;
        int first = scene->vertex_count;
        for (int corner = 0; corner < 4; corner++) {
            scene->vertices[scene->vertex_count++] = (struct ref_vertex){
                .p = {corners[corner][0] * w, corners[corner][1] * h, -depths[quad]}, .n = {0, 0, 1}};
        }
        scene->faces[scene->triangle_count] = quad;
        add_triangle(scene, first, first + 1, first + 2);
        scene->faces[scene->triangle_count] = quad;
        add_triangle(scene, first, first + 2, first + 3);
    }
}

/* The vertex half way between two others; each edge is asked for twice, `made` remembers (a pair, its vertex). */
static int midpoint(struct ref_scene *scene, int a, int b, int (*made)[3], int *made_count)
{
    int low = a < b ? a : b, high = a < b ? b : a;
    for (int i = 0; i < *made_count; i++) {
        if (made[i][0] == low && made[i][1] == high) {
            return made[i][2];
        }
    }
    struct ref_vertex *at = &scene->vertices[scene->vertex_count];
    for (int k = 0; k < 3; k++) {
        at->p[k] = (scene->vertices[a].p[k] + scene->vertices[b].p[k]) / 2;
    }
    normalise(at->p);
    memcpy(at->n, at->p, sizeof(at->n));
    memcpy(made[*made_count], (int[3]){low, high, scene->vertex_count}, sizeof(made[0]));
    (*made_count)++;
    return scene->vertex_count++;
}

static void subdivide(struct ref_scene *scene)
{
    int count = scene->triangle_count, made_count = 0;
    int(*old)[3] = get_memory((size_t)count, sizeof(*old));
    int(*made)[3] = get_memory((size_t)count * 3 / 2, sizeof(*made));
    memcpy(old, scene->triangles, (size_t)count * sizeof(*old));
    scene->triangle_count = 0;
    for (int i = 0; i < count; i++) {
        int a = old[i][0], b = old[i][1], c = old[i][2];
        int ab = midpoint(scene, a, b, made, &made_count);
        int bc = midpoint(scene, b, c, made, &made_count);
        int ca = midpoint(scene, c, a, made, &made_count);
        add_triangle(scene, a, ab, ca);
        add_triangle(scene, ab, b, bc);
        add_triangle(scene, ca, bc, c);
        add_triangle(scene, ab, bc, ca);
    }
    free(made);
    free(old);
}

/* The icosahedron's faces are the triples of vertices that are mutually nearest: no table to copy wrongly. */
static void build_icosahedron(struct ref_scene *scene)
{
    double phi = (1 + sqrt(5)) / 2, edge2 = 4 / (1 + phi * phi);
    for (int axis = 0; axis < 3; axis++) {
        for (int signs = 0; signs < 4; signs++) {
            struct ref_vertex *at = &scene->vertices[scene->vertex_count++];
            at->p[axis] = signs & 1 ? 1 : -1;
            at->p[(axis + 1) % 3] = signs & 2 ? phi : -phi;
            normalise(at->p);
            memcpy(at->n, at->p, sizeof(at->n));
        }
    }
    const struct ref_vertex *v = scene->vertices;
    for (int a = 0; a < 12; a++) {
        for (int b = 0; b < 12; b++) {
            for (int c = 0; c < 12; c++) {
                double ab[3], ac[3], bc2 = 0, ab2 = 0, ac2 = 0, volume = 0;
                for (int k = 0; k < 3; k++) {
                    ab[k] = v[b].p[k] - v[a].p[k];
                    ac[k] = v[c].p[k] - v[a].p[k];
                    ab2 += ab[k] * ab[k];
                    ac2 += ac[k] * ac[k];
                    bc2 += (v[c].p[k] - v[b].p[k]) * (v[c].p[k] - v[b].p[k]);
                }
                for (int k = 0; k < 3; k++) {
                    int l = (k + 1) % 3, m = (k + 2) % 3;
                    volume += v[a].p[k] * (ab[l] * ac[m] - ab[m] * ac[l]);
                }
                bool near = fabs(ab2 - edge2) < 1e-9 && fabs(ac2 - edge2) < 1e-9 && fabs(bc2 - edge2) < 1e-9;
                if (near && volume > 0 && a < b && a < c) {
                    add_triangle(scene, a, b, c);
                }
            }
        }
    }
}

static void build_sphere(struct ref_scene *scene)
{
    scene_alloc(scene, 2562, 5120);
    build_icosahedron(scene);
    for (int level = 0; level < SPHERE_LEVELS; level++) {
        subdivide(scene);
    }
}

static void build_ground(struct ref_scene *scene)
{
    const int side = GROUND_CELLS + 1;
    scene_alloc(scene, side * side, 2 * GROUND_CELLS * GROUND_CELLS);
    for (int i = 0; i < side; i++) {
        for (int j = 0; j < side; j++) {
            double x = j - GROUND_CELLS / 2, z = i - GROUND_CELLS / 2;
            struct ref_vertex *at = &scene->vertices[scene->vertex_count++];
            *at = (struct ref_vertex){.p = {x, 0, z}, .n = {.5 * sin(1.3 * x), 1, .5 * cos(1.7 * z)}};
            normalise(at->n);
        }
    }
    for (int i = 0; i < GROUND_CELLS; i++) {
        for (int j = 0; j < GROUND_CELLS; j++) {
            int a = i * side + j, b = a + 1, d = a + side, c = d + 1;
            add_triangle(scene, a, d, c);
            add_triangle(scene, a, c, b);
        }
    }
}

void ref_scene_build(struct ref_scene *scene, enum ref_scene_id id)
{
    static const struct {
        const char *name;
        void (*build)(struct ref_scene *scene);
    } kinds[REF_SCENES] = {{"S1 torus", build_torus},
                           {"S2 cube", build_cube},
                           {"S3 fill", build_fill},
                           {"S4 sphere", build_sphere},
                           {"S5 ground", build_ground}};
    memset(scene, 0, sizeof(*scene));
    scene->id = id;
    scene->name = kinds[id].name;
    kinds[id].build(scene);
}

void ref_scene_free(struct ref_scene *scene)
{
    free(scene->vertices);
    free(scene->triangles);
    free(scene->faces);
}

void ref_scene_pose(const struct ref_scene *scene, int frame, double pose[3][4])
{
    double a = 2 * PI * (frame + .5) / 64, b = .2 + .3 * frame / 64;
    double ca = cos(a), sa = sin(a), cb = cos(b), sb = sin(b);
    double r[3][3] = {{ca, 0, sa}, {sb * sa, cb, -sb * ca}, {-cb * sa, sb, cb * ca}};
    memset(pose, 0, 3 * sizeof(pose[0]));
    for (int i = 0; i < 3; i++) {
        if (scene->id == REF_FILL) {
            pose[i][i] = 1;
            continue;
        }
        memcpy(pose[i], r[i], sizeof(r[i]));
        if (scene->id == REF_GROUND) {
            pose[i][3] = -.5 * r[i][1];
        } else {
            pose[i][3] = i == 2 ? -3 : 0;
        }
    }
}

void ref_light(double direction[3])
{
    direction[0] = .5;
    direction[1] = .6;
    direction[2] = .7;
    normalise(direction);
}

uint32_t ref_texel(int x, int y)
{
    uint32_t blue = ((x >> 3) ^ (y >> 3)) & 1 ? 255 : 64;
    return (uint32_t)(4 * x) << 16 | (uint32_t)(4 * y) << 8 | blue;
}
