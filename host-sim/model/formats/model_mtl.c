/* See model_mtl.h. Reads line by line; what a line does not name keeps its default. */
#include "model_mtl.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The colour of what names no material, and the one of a material that does not say. */
static const uint8_t plain[3] = {219, 204, 179};
static const double grey[3] = {.6, .6, .6};

/* A picture that a material names. */
struct map {
    struct model_word name; /* n 0: none */
    double scale[2], offset[2];
    bool clamps;
};

struct material {
    struct model_word name;
    double colour[3], glow[3], alpha;
    struct map colours, alphas;
};

/* ---- pictures ---------------------------------------------------------------------------------------------------- */

/* Finds the picture beside the MTL file of this name, or beside the model. */
static const char *load_picture(struct model_shared *shared, const struct model_word *library, const char *name,
                                struct picture_in *picture)
{
    char beside[MODEL_PATH_BYTES], path[MODEL_PATH_BYTES];
    size_t n = library->n;
    while (n > 0 && library->text[n - 1] != '/' && library->text[n - 1] != '\\') {
        n--;
    }
    picture->most = 1u << TEXTURE_LOG2_MAX;
    const bool is_beside =
        n > 0 && name[0] != '/' && name[0] != '\\' &&
        snprintf(beside, sizeof beside, "%.*s%s", (int)n, library->text, name) < (int)sizeof beside &&
        model_folder_find(&shared->folder, beside, path);
    return is_beside || model_folder_find(&shared->folder, name, path) ? picture_in_file(picture, path)
                                                                       : "cannot be opened";
}

static void read_texture(struct model_shared *shared, const struct model_word *library, const struct map *from,
                         struct model_surface *to)
{
    char name[MODEL_PATH_BYTES];
    if (from->name.n == 0) {
        return;
    }
    snprintf(name, sizeof name, "%.*s", (int)from->name.n, from->name.text);
    snprintf(to->name, sizeof to->name, "%.100s", name);
    to->wrap = from->clamps ? PH_WRAP_CLAMP : PH_WRAP_REPEAT;
    const char *why = load_picture(shared, library, name, &to->picture);
    if (why != NULL) {
        model_shared_note(shared, "texture %s is left out: it %s", to->name, why);
        return;
    }
    free(to->picture.alpha); /* only map_d is alpha there */
    to->picture.alpha = NULL;
}

/* Reads alpha: d and map_d, whose alpha counts, or its grey. An opacity of 0 is written by programs that mean 1. */
static void read_alpha(struct model_shared *shared, const struct model_word *library, const struct material *from,
                       struct model_surface *to)
{
    char name[MODEL_PATH_BYTES];
    to->alpha = from->alpha > 0 ? from->alpha : 1;
    to->mode = to->alpha < 1 ? MODEL_BLEND : MODEL_OPAQUE;
    if (from->alphas.name.n == 0) {
        return;
    }
    snprintf(name, sizeof name, "%.*s", (int)from->alphas.name.n, from->alphas.name.text);
    const char *why = load_picture(shared, library, name, &to->mask);
    if (why != NULL) {
        model_shared_note(shared, "transparency %.100s is left out: it %s", name, why);
        return;
    }
    model_surface_mask(to);
}

/* ---- a file ------------------------------------------------------------------------------------------------------ */

/* Adds a material; mtls may be NULL. */
static bool add(struct model_shared *shared, struct model_scene *scene, struct model_mtls *mtls,
                struct model_surface *surface, const struct model_mtl *mtl)
{
    struct model_material *more = model_shared_grow(scene->materials, scene->material_count, sizeof *more);
    struct model_mtl *more_mtls = mtls != NULL ? model_shared_grow(mtls->list, mtls->count, sizeof *more_mtls) : NULL;
    scene->materials = more != NULL ? more : scene->materials;
    if (more == NULL || (mtls != NULL && more_mtls == NULL) ||
        !model_surface_make(shared, surface, &more[scene->material_count])) {
        return model_shared_failed(shared, "needs too much memory");
    }
    scene->material_count++;
    if (mtls != NULL) {
        mtls->list = more_mtls;
        mtls->list[mtls->count++] = *mtl;
    }
    return true;
}

bool model_mtl_plain(struct model_shared *shared, struct model_scene *scene)
{
    struct model_surface surface = {.colour = {plain[0], plain[1], plain[2]}, .alpha = 1};
    return add(shared, scene, NULL, &surface, NULL);
}

bool model_mtl_white(struct model_shared *shared, struct model_scene *scene, const struct model_word *texture)
{
    struct model_surface surface = {.colour = {255, 255, 255}, .two_sided = true, .alpha = 1};
    read_texture(shared, &(struct model_word){"", 0}, &(struct map){.name = *texture}, &surface);
    return add(shared, scene, NULL, &surface, NULL);
}

bool model_mtl_add_plain(struct model_shared *shared, struct model_scene *scene, struct model_mtls *mtls,
                         const struct model_word *name)
{
    const uint8_t dim = model_surface_channel((float)grey[0]);
    struct model_surface surface = {.colour = {plain[0], plain[1], plain[2]}, .alpha = 1};
    if (name->n > 0) {
        memset(surface.colour, dim, sizeof surface.colour);
    }
    return add(shared, scene, mtls, &surface, &(struct model_mtl){*name, {1, 1}, {0, 0}});
}

static bool finish(struct model_shared *shared, struct model_scene *scene, struct model_mtls *mtls,
                   const struct model_word *library, const struct material *from)
{
    struct model_surface surface = {.alpha = 1};
    if (from->name.n == 0) {
        return true;
    }
    for (int c = 0; c < 3; c++) {
        surface.colour[c] = model_surface_channel((float)from->colour[c]);
        surface.glow[c] = model_surface_channel((float)from->glow[c]);
    }
    read_texture(shared, library, &from->colours, &surface);
    read_alpha(shared, library, from, &surface);
    const struct map *map = from->colours.name.n > 0 ? &from->colours : &from->alphas;
    if (map == &from->colours && from->alphas.name.n > 0 &&
        (from->alphas.scale[0] != map->scale[0] || from->alphas.scale[1] != map->scale[1] ||
         from->alphas.offset[0] != map->offset[0] || from->alphas.offset[1] != map->offset[1])) {
        model_shared_note(shared, "-o and -s of map_d are ignored: map_Kd has others");
    }
    return add(shared, scene, mtls, &surface,
               &(struct model_mtl){from->name, {map->scale[0], map->scale[1]}, {map->offset[0], map->offset[1]}});
}

/* Reads one to three numbers; what is missing stays as it was. */
static void read_pair(struct model_text *text, double pair[2])
{
    struct model_text behind = *text;
    struct model_word word;
    double number;
    for (int i = 0; i < 3 && model_text_word(&behind, &word) && model_word_number(&word, &number); i++) {
        if (i < 2) {
            pair[i] = number;
        }
        *text = behind;
    }
}

static void read_map(struct model_text *text, struct map *to)
{
    struct model_text name = *text;
    struct model_word word;
    *to = (struct map){.scale = {1, 1}};
    while (model_text_word(text, &word) && word.text[0] == '-') {
        if (model_word_is(&word, "-o")) {
            read_pair(text, to->offset);
        } else if (model_word_is(&word, "-s")) {
            read_pair(text, to->scale);
        } else if (model_word_is(&word, "-t") || model_word_is(&word, "-mm")) {
            read_pair(text, (double[2]){0, 0});
        } else if (model_word_is(&word, "-clamp")) {
            to->clamps = model_text_word(text, &word) && model_word_is(&word, "on");
        } else {
            model_text_word(text, &word); /* the value of what is not read */
        }
        name = *text;
    }
    to->name = model_text_rest(&name);
}

static void read_colour(struct model_text *text, double colour[3])
{
    double c[3];
    const uint32_t n = model_text_numbers(text, 3, c);
    for (uint32_t i = 0; n > 0 && i < 3; i++) {
        colour[i] = c[n == 3 ? i : 0];
    }
}

static void read_line(struct model_text *text, const struct model_word *key, struct material *to)
{
    double number;
    if (model_word_is(key, "Kd")) {
        read_colour(text, to->colour);
    } else if (model_word_is(key, "Ke")) {
        read_colour(text, to->glow);
    } else if ((model_word_is(key, "d") || model_word_is(key, "Tr")) && model_text_numbers(text, 1, &number) == 1) {
        to->alpha = key->n == 1 ? number : 1 - number;
    } else if (model_word_is(key, "map_Kd")) {
        read_map(text, &to->colours);
    } else if (model_word_is(key, "map_d")) {
        read_map(text, &to->alphas);
    }
}

bool model_mtl_read(struct model_shared *shared, struct model_scene *scene, struct model_mtls *mtls,
                    const struct model_word *name)
{
    char spelled[MODEL_PATH_BYTES], path[MODEL_PATH_BYTES];
    size_t n = 0;
    snprintf(spelled, sizeof spelled, "%.*s", (int)name->n, name->text);
    const char *bytes = model_folder_find(&shared->folder, spelled, path) ? model_text_load(path, &n) : NULL;
    if (bytes == NULL) {
        model_shared_note(shared, "materials %.100s cannot be opened", spelled);
        return true;
    }
    struct model_text text = {.at = bytes, .end = bytes + n, .line = 1};
    struct material material = {.alpha = 1}; /* without a name: what stands before the first newmtl */
    do {
        struct model_word key;
        if (!model_text_word(&text, &key)) {
            continue;
        }
        if (!model_word_is(&key, "newmtl")) {
            read_line(&text, &key, &material);
            continue;
        }
        if (!finish(shared, scene, mtls, name, &material)) {
            return false;
        }
        material = (struct material){
            .name = model_text_rest(&text), .alpha = 1, .colours = {.scale = {1, 1}}, .alphas = {.scale = {1, 1}}};
        memcpy(material.colour, grey, sizeof grey);
    } while (model_text_next(&text));
    return finish(shared, scene, mtls, name, &material);
}
