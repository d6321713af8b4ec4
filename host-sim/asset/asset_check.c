/*
 * Looks whether the meshes of a written file keep within their bounds (asset_check.h). Of a C file it reads the lines
 * that asset_write.c has written, in their form.
 */
#define _XOPEN_SOURCE 700 /* getline */

#include "asset_check.h"
#include "complain.h"
#include "model.h"
#include "option_text.h"
#include "render.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define POSITIONS "static const struct fx_vec3 positions_"
#define BOUNDS    "static const struct ph_sphere bounds_"

/* The positions of the array that was read last. */
struct positions {
    struct fx_vec3 *list;
    size_t count, room;
    bool is_open; /* more of them follow */
};

/* Reads "{x, y, z}" from a text. Returns what is behind it, or NULL. */
static const char *read_vec3(const char *text, struct fx_vec3 *v)
{
    fx_t *const to[3] = {&v->x, &v->y, &v->z};
    text = strchr(text, '{');
    for (int i = 0; i < 3 && text != NULL; i++) {
        char *end = NULL;
        text += strspn(text, "{, ");
        const bool is_least = strncmp(text, "INT32_MIN", 9) == 0;
        *to[i] = is_least ? INT32_MIN : (fx_t)strtol(text, &end, 10);
        text = is_least ? text + 9 : end != text ? end : NULL;
    }
    return text;
}

/* Adds the positions of a line. False: no memory. */
static bool add_positions(struct positions *p, const char *line)
{
    struct fx_vec3 v;
    for (const char *at = line; (at = read_vec3(at, &v)) != NULL;) {
        if (p->count == p->room) {
            p->room = 2 * p->room + 64;
            struct fx_vec3 *const more = realloc(p->list, p->room * sizeof *more);
            if (more == NULL) {
                return false;
            }
            p->list = more;
        }
        p->list[p->count++] = v;
    }
    return true;
}

static bool is_within(const struct ph_sphere *sphere, const struct fx_vec3 *p)
{
    const int64_t x = (int64_t)p->x - sphere->centre.x, y = (int64_t)p->y - sphere->centre.y,
                  z = (int64_t)p->z - sphere->centre.z, radius = sphere->radius;
    return radius == 0 || (llabs(x) <= radius && llabs(y) <= radius && llabs(z) <= radius &&
                           (uint64_t)(x * x) + (uint64_t)(y * y) + (uint64_t)(z * z) <= (uint64_t)(radius * radius));
}

/* Compares the positions with the bounds of a line. */
static int check_bounds(const char *path, const struct positions *p, const char *line)
{
    struct ph_sphere sphere = {.radius = 0};
    const unsigned long mesh = strtoul(line + strlen(BOUNDS), NULL, 10);
    const char *const centre = strstr(line, ".centre = "), *const radius = strstr(line, ".radius = ");
    if (centre == NULL || radius == NULL || read_vec3(centre, &sphere.centre) == NULL) {
        return complain("%s: the bounds of mesh %lu are none that pinhole-asset has written", path, mesh);
    }
    sphere.radius = (fx_t)strtol(radius + 10, NULL, 10);
    for (size_t i = 0; i < p->count; i++) {
        if (!is_within(&sphere, &p->list[i])) {
            return complain("%s: vertex %zu of mesh %lu lies outside of its bounds: make the file again", path, i,
                            mesh);
        }
    }
    return 0;
}

static int check_lines(const char *path, FILE *file)
{
    struct positions p = {.count = 0};
    char *line = NULL;
    size_t room = 0, bounds = 0;
    int status = 0;
    while (status == 0 && getline(&line, &room, file) >= 0) {
        const bool begins = strncmp(line, POSITIONS, strlen(POSITIONS)) == 0;
        p.count = begins ? 0 : p.count;
        p.is_open = begins || (p.is_open && strncmp(line, "};", 2) != 0);
        if (strncmp(line, BOUNDS, strlen(BOUNDS)) == 0) {
            bounds++;
            status = check_bounds(path, &p, line);
        } else if (p.is_open && !begins && !add_positions(&p, line)) {
            status = complain("%s: not enough memory", path);
        }
    }
    free(line);
    free(p.list);
    return status != 0 || bounds > 0 ? status : complain("%s: has no bounds: pinhole-asset has not written it", path);
}

int asset_check(const char *path)
{
    if (!option_text_ends(path, ".c")) {
        struct model *model;
        const struct model_options none = {0};
        const int status = model_open(&model, path, &none);
        if (status == 0) {
            model_close(model);
        }
        return status;
    }
    FILE *const file = fopen(path, "r");
    if (file == NULL) {
        return complain("%s: %s", path, strerror(errno));
    }
    const int status = check_lines(path, file);
    fclose(file);
    return status;
}
