/* See model_surface.h. Chooses shading, textures, ramp and blend for a material of a file. */
#include "model_surface.h"
#include "wire_colour.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* How a material takes the light of the turntable; files give reliable colours only. */
#define AMBIENT        (FX_ONE / 2) /* with the lamps, half of a model is about as bright as if it were unlit */
#define DIFFUSE        (FX_ONE * 13 / 20)
#define GLOSS          (FX_ONE / 4)
#define SHININESS_LOG2 5
#define OVER_BIAS      8 /* a code of every depth format: what is drawn once more must be nearer */

uint8_t model_surface_channel(float value)
{
    return (uint8_t)lroundf((value > 0 ? (value < 1 ? value : 1) : 0) * 255); /* NaN gives 0 */
}

/* Whether alpha is nowhere between nothing and all: then it cuts out, and hides what is behind. */
static bool is_cut_out(const struct picture_in *picture)
{
    const size_t n = (size_t)picture->picture.width * picture->picture.height;
    size_t between = 0;
    for (size_t i = 0; i < n; i++) {
        between += picture->alpha[i] > 16 && picture->alpha[i] < 239;
    }
    return between * 16 <= n; /* those at the edges of a picture that was shrunk */
}

void model_surface_mask(struct model_surface *surface)
{
    struct picture_in *mask = &surface->mask;
    const size_t n = (size_t)mask->picture.width * mask->picture.height;
    if (mask->alpha == NULL) {
        mask->alpha = malloc(n);
        for (size_t i = 0; mask->alpha != NULL && i < n; i++) {
            const uint8_t *rgb = mask->picture.rgb + 3 * i;
            mask->alpha[i] = (uint8_t)((rgb[0] + rgb[1] + rgb[2]) / 3);
        }
    }
    surface->cutoff = .5;
    surface->mode = mask->alpha == NULL                       ? surface->mode
                    : is_cut_out(mask) && surface->alpha >= 1 ? MODEL_MASK
                                                              : MODEL_BLEND;
}

/* The filter that the options name, or that of the file. */
static const struct ph_filter *filter_of(struct model_shared *shared, const struct model_surface *from)
{
    const char *const name = shared->options.filter;
    if (name == NULL && from->filter != PH_FILTER_NEAREST) {
        model_shared_note(shared, "filters of textures are ignored (--filter file takes them)");
    }
    return name == NULL                   ? PH_FILTER_NEAREST
           : strcmp(name, "file") == 0    ? from->filter
           : strcmp(name, "mipmap") == 0  ? PH_FILTER_MIPMAP
           : strcmp(name, "nearest") == 0 ? PH_FILTER_NEAREST
                                          : PH_FILTER_BILINEAR;
}

/* Returns the texture of one of the surface's pictures, or NULL; a note says why. */
static const struct ph_texture *make_texture(struct model_shared *shared, const struct model_surface *from,
                                             const struct picture_in *picture)
{
    struct ph_texture *texture = demo_alloc(&shared->arena, sizeof *texture);
    if (texture == NULL || model_texture_make(&shared->arena, &picture->picture, texture) != 0) {
        model_shared_note(shared, "texture %s is left out: no memory", from->name);
        return NULL;
    }
    const unsigned width = 1u << texture->log2_width, height = 1u << texture->log2_height;
    if (width != picture->width || height != picture->height) {
        model_shared_note(shared, "texture %s is resized from %ux%u to %ux%u", from->name, (unsigned)picture->width,
                          (unsigned)picture->height, width, height);
    }
    texture->wrap = from->wrap;
    texture->filter = filter_of(shared, from);
    return texture;
}

bool model_surface_take_texture(struct model_shared *shared)
{
    const char *path = shared->options.texture;
    if (path == NULL) {
        return true;
    }
    struct model_surface surface = {.picture.most = 1u << TEXTURE_LOG2_MAX};
    snprintf(surface.name, sizeof surface.name, "%.100s", path);
    const char *why = picture_in_file(&surface.picture, path);
    if (why == NULL) {
        shared->texture = make_texture(shared, &surface, &surface.picture);
        picture_in_free(&surface.picture);
    }
    return shared->texture != NULL || model_shared_failed(shared, "cannot have the texture %.100s: it %s", path,
                                                          why != NULL ? why : "is too large");
}

static uint8_t add(unsigned a, unsigned b)
{
    return (uint8_t)(a + b < 255 ? a + b : 255);
}

/* Adds what the surface emits to each colour of the ramp. */
static void add_glow(uint16_t ramp[PH_RAMP_SIZE], const uint8_t glow[3])
{
    for (int i = 0; i < PH_RAMP_SIZE; i++) {
        uint8_t rgb[3];
        wire_colour(ramp[i], rgb);
        ramp[i] = ph_rgb565(add(rgb[0], glow[0]), add(rgb[1], glow[1]), add(rgb[2], glow[2]));
    }
}

/* Whether any alpha is less than all. */
static bool has_alpha(const struct picture_in *from)
{
    const size_t n = (size_t)from->picture.width * from->picture.height;
    for (size_t i = 0; from->alpha != NULL && i < n; i++) {
        if (from->alpha[i] < 255) {
            return true;
        }
    }
    return false;
}

/* The alpha, times this, as a texture of greys, or NULL. */
static struct ph_texture *make_alphas(struct model_shared *shared, const struct picture_in *from, double times)
{
    const struct ppm *picture = &from->picture;
    const size_t n = (size_t)picture->width * picture->height;
    const struct ppm grey = {picture->width, picture->height, malloc(n * 3)};
    struct ph_texture *texture = demo_alloc(&shared->arena, sizeof *texture);
    for (size_t i = 0; grey.rgb != NULL && i < n; i++) {
        memset(grey.rgb + 3 * i, model_surface_channel((float)(from->alpha[i] * times / 255)), 3);
    }
    const bool is_made = grey.rgb != NULL && texture != NULL && model_texture_make(&shared->arena, &grey, texture) == 0;
    free(grey.rgb);
    return is_made ? texture : NULL;
}

/* Sets the material's blend, if it needs one. What a mask lets through has an alpha of at least one half there. */
static bool make_blend(struct model_shared *shared, const struct model_surface *from, struct ph_material *to)
{
    const struct picture_in *const alphas = from->mask.alpha != NULL ? &from->mask : &from->picture;
    const bool is_mask = from->mode == MODEL_MASK, varies = shared->texture == NULL && has_alpha(alphas);
    const bool is_whole = !varies && (is_mask ? from->alpha >= from->cutoff : from->alpha >= 1);
    struct ph_blend *blend = demo_alloc(&shared->arena, sizeof *blend);
    if (from->mode == MODEL_OPAQUE || is_whole || (is_mask && from->cutoff <= 0)) {
        return true;
    }
    if (blend == NULL) {
        return false;
    }
    *blend = (struct ph_blend){.draw = ph_draw_blended,
                               .kind = is_mask && varies ? PH_BLEND_MASK : PH_BLEND_ALPHA,
                               .alpha = is_mask ? 0 : (uint8_t)lround(fmin(fmax(from->alpha, 0), 1) * 32)};
    to->blend = blend;
    if (varies) {
        struct ph_texture *texture = make_alphas(shared, alphas, is_mask ? from->alpha / from->cutoff / 2 : 1);
        if (texture == NULL) {
            return false;
        }
        texture->wrap = from->wrap;
        texture->filter = filter_of(shared, from);
        blend->alphas = texture;
        blend->draw = ph_draw_blended_alphas;
    }
    return true;
}

/* Sets what is drawn over the surface where its ramp cannot have the emission. */
static bool make_glow(struct model_shared *shared, const struct model_surface *from, struct model_material *to)
{
    const bool varies = from->glowing.picture.rgb != NULL;
    struct ph_blend *blend = demo_alloc(&shared->arena, sizeof *blend);
    if (blend == NULL) {
        return false;
    }
    const struct ph_texture *const alphas = to->surface.blend != NULL ? to->surface.blend->alphas : NULL;
    *blend = (struct ph_blend){.draw = alphas != NULL ? ph_draw_blended_alphas : ph_draw_blended,
                               .kind = PH_BLEND_ADD,
                               .alpha = 32,
                               .alphas = alphas};
    to->glow = (struct ph_material){.shading = PH_SHADE_UNLIT,
                                    .two_sided = to->surface.two_sided,
                                    .depth_bias = OVER_BIAS,
                                    .colour = ph_rgb565(from->glow[0], from->glow[1], from->glow[2]),
                                    .ramp = to->surface.ramp,
                                    .texture = varies ? make_texture(shared, from, &from->glowing) : NULL,
                                    .blend = blend};
    to->glows = !varies || to->glow.texture != NULL;
    return true;
}

/* Sets what is drawn over the surface where its vertices have colours. What shows through is multiplied, too: so the
 * surface must be opaque. */
static void make_tint(struct model_material *to)
{
    static const struct ph_blend times = {.draw = ph_draw_blended, .kind = PH_BLEND_TIMES, .alpha = 32};
    to->tint = (struct ph_material){.shading = PH_SHADE_UNLIT,
                                    .two_sided = to->surface.two_sided,
                                    .depth_bias = OVER_BIAS,
                                    .colour = 0xffff,
                                    .ramp = to->surface.ramp,
                                    .blend = &times};
    to->can_tint = to->surface.texture != NULL && to->surface.blend == NULL;
}

bool model_surface_make(struct model_shared *shared, struct model_surface *from, struct model_material *to)
{
    const uint8_t *c = from->colour, *glow = from->glow;
    uint16_t *ramp = demo_alloc(&shared->arena, sizeof *ramp * PH_RAMP_SIZE);
    if (ramp == NULL) {
        return false;
    }
    const struct ph_texture *texture = shared->texture != NULL             ? shared->texture
                                       : from->picture.picture.rgb != NULL ? make_texture(shared, from, &from->picture)
                                                                           : NULL;
    const bool glows = !from->is_unlit && (glow[0] | glow[1] | glow[2]) != 0;
    const bool is_over = glows && (texture != NULL || from->glowing.picture.rgb != NULL);
    ph_material_ramp(ramp, c[0], c[1], c[2], GLOSS);
    if (glows && !is_over) {
        add_glow(ramp, glow);
    }
    to->glows = false;
    to->surface = (struct ph_material){.shading = from->is_unlit ? PH_SHADE_UNLIT : PH_SHADE_GOURAUD,
                                       .two_sided = from->two_sided || shared->options.two_sided,
                                       .shininess_log2 = SHININESS_LOG2,
                                       .ambient = AMBIENT,
                                       .diffuse = DIFFUSE,
                                       .specular = GLOSS,
                                       .colour = ph_rgb565(c[0], c[1], c[2]),
                                       .ramp = ramp,
                                       .texture = texture};
    const bool is_made = make_blend(shared, from, &to->surface) && (!is_over || make_glow(shared, from, to));
    make_tint(to);
    picture_in_free(&from->picture);
    picture_in_free(&from->mask);
    picture_in_free(&from->glowing);
    return is_made;
}
