/* See textured_torus.h. */
#include "textured_torus.h"

#include <stdlib.h>

#define MAJOR 32
#define MINOR 16

void textured_torus_build(struct ref_scene *scene)
{
    struct ref_scene torus;
    ref_scene_build(&torus, REF_TORUS);
    *scene = torus;
    scene->id = REF_CUBE; /* the same pose, and textured */
    scene->vertex_count = (MAJOR + 1) * (MINOR + 1);
    scene->vertices = calloc((size_t)scene->vertex_count, sizeof *scene->vertices);
    if (scene->vertices == NULL) {
        abort();
    }
    for (int n = 0; n < scene->vertex_count; n++) {
        int i = n / (MINOR + 1), j = n % (MINOR + 1);
        scene->vertices[n] = torus.vertices[i % MAJOR * MINOR + j % MINOR];
        scene->vertices[n].uv[0] = 4. * i / MAJOR;
        scene->vertices[n].uv[1] = 2. * j / MINOR;
    }
    for (int n = 0; n < scene->triangle_count; n++) {
        int a = n / (2 * MINOR) * (MINOR + 1) + n / 2 % MINOR, b = a + MINOR + 1;
        scene->triangles[n][0] = a;
        scene->triangles[n][1] = n % 2 ? b + 1 : b;
        scene->triangles[n][2] = n % 2 ? a + 1 : b + 1;
    }
    free(torus.vertices);
}
