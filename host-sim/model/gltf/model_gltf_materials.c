/* See model_gltf.h. Converts materials; linear colours become those of the display (sRGB), since the renderer has
 * no other. */
#include "model_gltf.h"

#include "model_surface.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define CLAMP_TO_EDGE          33071
#define MIRRORED_REPEAT        33648
#define NEAREST                9728
#define LINEAR                 9729
#define NEAREST_MIPMAP_NEAREST 9984 /* the first of those with levels */

/* The colour of a primitive without a material. */
static const uint8_t plain[3] = {219, 204, 179};

static double to_display(double linear)
{
    const double v = linear > 0 ? (linear < 1 ? linear : 1) : 0; /* NaN gives 0 */
    return v <= .0031308 ? 12.92 * v : 1.055 * pow(v, 1 / 2.4) - .055;
}

static double to_linear(double display)
{
    return display <= .04045 ? display / 12.92 : pow((display + .055) / 1.055, 2.4);
}

uint8_t model_gltf_channel(double linear)
{
    return (uint8_t)lround(255 * to_display(linear));
}

/* Multiplies the picture by a linear factor: what the file means, as the display shows it. */
static void multiply(struct ppm *picture, const double factor[3])
{
    uint8_t table[3][256];
    for (int c = 0; c < 3; c++) {
        for (int i = 0; i < 256; i++) {
            table[c][i] = model_gltf_channel(factor[c] * to_linear(i / 255.0));
        }
    }
    const size_t n = (size_t)picture->width * picture->height;
    for (size_t i = 0; i < 3 * n; i++) {
        picture->rgb[i] = table[i % 3][picture->rgb[i]];
    }
}

/* Doubles an image along u (0) or v (1), the second half mirrored. NULL: no memory. */
static uint8_t *mirrored(const uint8_t *from, uint32_t w, uint32_t h, size_t pixel_bytes, int along)
{
    const uint32_t wide = along == 0 ? 2 * w : w, high = along == 1 ? 2 * h : h;
    uint8_t *to = malloc((size_t)wide * high * pixel_bytes);
    for (uint32_t y = 0; to != NULL && y < high; y++) {
        for (uint32_t x = 0; x < wide; x++) {
            const uint32_t from_x = x < w ? x : 2 * w - 1 - x, from_y = y < h ? y : 2 * h - 1 - y;
            memcpy(to + ((size_t)y * wide + x) * pixel_bytes, from + ((size_t)from_y * w + from_x) * pixel_bytes,
                   pixel_bytes);
        }
    }
    return to;
}

static bool mirror(struct picture_in *in, int along)
{
    struct ppm *picture = &in->picture;
    const uint32_t w = picture->width, h = picture->height;
    uint8_t *rgb = mirrored(picture->rgb, w, h, 3, along);
    uint8_t *alpha = in->alpha != NULL ? mirrored(in->alpha, w, h, 1, along) : NULL;
    if (rgb == NULL || (in->alpha != NULL && alpha == NULL)) {
        free(rgb);
        free(alpha);
        return false;
    }
    picture_in_free(in);
    *picture = (struct ppm){along == 0 ? 2 * w : w, along == 1 ? 2 * h : h, rgb};
    in->alpha = alpha;
    in->width *= along == 0 ? 2 : 1;
    in->height *= along == 1 ? 2 : 1;
    return true;
}

/* Reads the picture of a texture of this number; its name is for notes. NULL, or why there is none. */
static const char *load_picture(struct gltf_file *file, uint32_t number, struct model_surface *to)
{
    const struct gltf_json *texture = gltf_file_item(file, GLTF_TEXTURES, number);
    const struct gltf_json *webp = gltf_json_get(gltf_json_get(texture, "extensions"), "EXT_texture_webp");
    const uint32_t i = gltf_file_whole(texture, "source", gltf_file_whole(webp, "source", GLTF_NONE));
    const struct gltf_json *image = gltf_file_item(file, GLTF_IMAGES, i);
    const char *uri = gltf_json_text(gltf_json_get(image, "uri"));
    const char *name = gltf_json_text(gltf_json_get(image, "name"));
    const bool is_file = uri != NULL && strncmp(uri, "data:", 5) != 0;
    if (is_file || name != NULL) {
        snprintf(to->name, sizeof to->name, "%.100s", is_file ? uri : name);
    } else {
        snprintf(to->name, sizeof to->name, "%u", i);
    }
    if (image == NULL) {
        snprintf(to->name, sizeof to->name, "%u", number);
        return "names no image that the file has";
    }
    const struct gltf_span bytes =
        uri != NULL ? gltf_file_uri(file, uri) : gltf_file_view(file, gltf_file_whole(image, "bufferView", GLTF_NONE));
    if (bytes.bytes == NULL) {
        file->error[0] = '\0'; /* a model without its picture is still a model */
        return "cannot be opened";
    }
    to->picture.most = 1u << TEXTURE_LOG2_MAX;
    const char *why = picture_in_memory(&to->picture, bytes.bytes, bytes.n);
    if (uri != NULL) {
        free((void *)(uintptr_t)bytes.bytes);
    }
    return why;
}

/* Reads KHR_texture_transform: offset, rotation and scale, in this order from the left. */
static void read_transform(const struct gltf_json *info, struct model_gltf_uv *uv)
{
    const struct gltf_json *from = gltf_json_get(gltf_json_get(info, "extensions"), "KHR_texture_transform");
    double offset[2] = {0, 0}, scale[2] = {1, 1};
    gltf_file_vector(from, "offset", 2, offset);
    gltf_file_vector(from, "scale", 2, scale);
    const double turn = gltf_file_number(from, "rotation", 0), c = cos(turn), s = sin(turn);
    uv->set = gltf_file_whole(from, "texCoord", gltf_file_whole(info, "texCoord", 0));
    memcpy(uv->m[0], (double[3]){c * scale[0], s * scale[1], offset[0]}, sizeof uv->m[0]);
    memcpy(uv->m[1], (double[3]){-s * scale[0], c * scale[1], offset[1]}, sizeof uv->m[1]);
}

/* Reads the wrap modes; a mirrored picture is doubled, and its coordinates are halved. */
static void read_wrap(struct model_shared *shared, const struct gltf_json *sampler, struct model_surface *to,
                      struct model_gltf_uv *uv)
{
    static const char *const keys[2] = {"wrapS", "wrapT"};
    for (int along = 0; along < 2; along++) {
        const uint32_t mode = gltf_file_whole(sampler, keys[along], 0);
        if (mode == CLAMP_TO_EDGE) {
            to->wrap |= (uint8_t)(PH_WRAP_CLAMP_U << along);
        }
        if (mode != MIRRORED_REPEAT) {
            continue;
        }
        if (!mirror(&to->picture, along)) {
            model_shared_note(shared, "texture %s is too large to be mirrored", to->name);
            continue;
        }
        for (int i = 0; i < 3; i++) {
            uv->m[along][i] /= 2;
        }
    }
}

/* The filter that comes nearest to a sampler's: levels are for texels that are not magnified by the nearest one. */
static const struct ph_filter *filter_of(const struct gltf_json *sampler)
{
    const uint32_t larger = gltf_file_whole(sampler, "magFilter", 0),
                   smaller = gltf_file_whole(sampler, "minFilter", 0);
    return larger == NEAREST                       ? PH_FILTER_NEAREST
           : smaller >= NEAREST_MIPMAP_NEAREST     ? PH_FILTER_MIPMAP
           : larger == LINEAR || smaller == LINEAR ? PH_FILTER_BILINEAR
                                                   : PH_FILTER_NEAREST;
}

static void read_texture(struct model_shared *shared, struct gltf_file *file, const struct gltf_json *info,
                         const double factor[3], struct model_surface *to, struct model_gltf_uv *uv)
{
    if (info == NULL) {
        return;
    }
    const uint32_t i = gltf_file_whole(info, "index", GLTF_NONE), count = file->lists[GLTF_TEXTURES].count;
    const struct gltf_json *texture = gltf_file_item(file, GLTF_TEXTURES, i);
    if (i == GLTF_NONE) {
        model_shared_note(shared, "a material has a texture without an index");
        return;
    }
    if (texture == NULL) {
        model_shared_note(shared, "a material names texture %u, and the file has %u", i, count);
        return;
    }
    const char *why = load_picture(file, i, to);
    if (why != NULL) {
        model_shared_note(shared, "texture %s is left out: it %s", to->name, why);
        return;
    }
    if (factor[0] != 1 || factor[1] != 1 || factor[2] != 1) {
        multiply(&to->picture.picture, factor);
    }
    read_transform(info, uv);
    const struct gltf_json *sampler =
        gltf_file_item(file, GLTF_SAMPLERS, gltf_file_whole(texture, "sampler", GLTF_NONE));
    read_wrap(shared, sampler, to, uv);
    to->filter = filter_of(sampler);
}

/* Reads the emissive texture, which needs the texture's own coordinates. */
static void read_glow(struct model_shared *shared, struct gltf_file *file, const struct gltf_json *emissive,
                      const double glow[3], struct model_surface *to, struct model_gltf_uv *uv)
{
    struct model_surface from = {.is_unlit = true};
    struct model_gltf_uv other = *uv;
    read_texture(shared, file, emissive, glow, &from, &other);
    free(from.picture.alpha); /* it means nothing there */
    from.picture.alpha = NULL;
    const bool has_texture = to->picture.picture.rgb != NULL;
    /* NOLINTNEXTLINE(bugprone-suspicious-memory-comparison,cert-exp42-c,cert-flp37-c): the same bits are meant */
    if (has_texture && (other.set != uv->set || memcmp(other.m, uv->m, sizeof other.m) != 0 || from.wrap != to->wrap)) {
        model_shared_note(shared, "emissive textures with coordinates of their own are ignored");
        picture_in_free(&from.picture);
        return;
    }
    *uv = other;
    to->glowing = from.picture;
    if (!has_texture) {
        memcpy(to->name, from.name, sizeof to->name);
        to->wrap = from.wrap;
        to->filter = from.filter;
    }
}

/* Reads the pictures of a material, `base` that of its colour. What emits light by a picture and is black otherwise is
 * that picture, unlit. */
static void read_pictures(struct model_shared *shared, struct gltf_file *file, const struct gltf_json *from,
                          const struct gltf_json *base, double glow[3], struct model_surface *to,
                          struct model_gltf_uv *uv)
{
    const double *factor = uv->factor;
    const struct gltf_json *emissive = gltf_json_get(from, "emissiveTexture");
    const bool glows = emissive != NULL && glow[0] + glow[1] + glow[2] > 0 && !to->is_unlit;
    const bool is_black = factor[0] + factor[1] + factor[2] == 0;
    if (!glows || !is_black) {
        read_texture(shared, file, base, factor, to, uv);
    }
    if (!glows) {
        return;
    }
    read_glow(shared, file, emissive, glow, to, uv);
    if (to->glowing.picture.rgb == NULL) {
        memset(glow, 0, 3 * sizeof *glow);
    } else if (is_black) {
        to->picture = to->glowing;
        to->glowing = (struct picture_in){.picture.rgb = NULL};
        to->is_unlit = true;
    }
}

/* Whether an extension is read, or changes how a surface shines and no more. */
static bool is_silent(const char *extension)
{
    static const char *const names[] = {"unlit",
                                        "emissive_strength",
                                        "pbrSpecularGlossiness",
                                        "anisotropy",
                                        "clearcoat",
                                        "dispersion",
                                        "ior",
                                        "iridescence",
                                        "sheen",
                                        "specular",
                                        "volume" /* beside transmission, which is not silent */};
    static const char all[] = "KHR_materials_";
    bool is_one = false;
    for (size_t i = 0; i < sizeof names / sizeof names[0] && strncmp(extension, all, sizeof all - 1) == 0; i++) {
        is_one = is_one || strcmp(extension + sizeof all - 1, names[i]) == 0;
    }
    return is_one;
}

/* Says what the material asks for and does not get: each kind once. */
static void note_ignored(struct model_shared *shared, const struct gltf_json *from)
{
    const struct gltf_json *pbr = gltf_json_get(from, "pbrMetallicRoughness"), *extension;
    if (gltf_json_get(from, "normalTexture") != NULL) {
        model_shared_note(shared, "normal maps are ignored");
    }
    if (gltf_json_get(from, "occlusionTexture") != NULL) {
        model_shared_note(shared, "occlusion maps are ignored");
    }
    if (gltf_json_get(pbr, "metallicRoughnessTexture") != NULL) {
        model_shared_note(shared, "maps of metal and roughness are ignored");
    }
    GLTF_JSON_EACH(extension, gltf_json_get(from, "extensions"))
    {
        if (extension->key != NULL && !is_silent(extension->key)) {
            model_shared_note(shared, "%.60s is ignored", extension->key);
        }
    }
}

static enum model_alpha read_mode(const struct gltf_json *from)
{
    const char *mode = gltf_json_text(gltf_json_get(from, "alphaMode"));
    return mode == NULL                 ? MODEL_OPAQUE
           : strcmp(mode, "MASK") == 0  ? MODEL_MASK
           : strcmp(mode, "BLEND") == 0 ? MODEL_BLEND
                                        : MODEL_OPAQUE;
}

static bool read_material(struct model_shared *shared, struct gltf_file *file, const struct gltf_json *from,
                          struct model_material *to, struct model_gltf_uv *uv)
{
    const struct gltf_json *pbr = gltf_json_get(from, "pbrMetallicRoughness");
    const struct gltf_json *extensions = gltf_json_get(from, "extensions");
    const struct gltf_json *gloss = gltf_json_get(extensions, "KHR_materials_pbrSpecularGlossiness");
    const struct gltf_json *strength = gltf_json_get(extensions, "KHR_materials_emissive_strength");
    const double times = gltf_file_number(strength, "emissiveStrength", 1);
    double *factor = uv->factor, glow[3] = {0, 0, 0};
    note_ignored(shared, from);
    gltf_file_vector(pbr, "baseColorFactor", 4, factor);
    gltf_file_vector(gloss, "diffuseFactor", 4, factor);
    gltf_file_vector(from, "emissiveFactor", 3, glow);
    struct model_surface surface = {.two_sided = gltf_json_is(gltf_json_get(from, "doubleSided"), GLTF_JSON_TRUE),
                                    .is_unlit = gltf_json_get(extensions, "KHR_materials_unlit") != NULL,
                                    .mode = read_mode(from),
                                    .alpha = factor[3],
                                    .cutoff = gltf_file_number(from, "alphaCutoff", .5)};
    for (int c = 0; c < 3; c++) {
        glow[c] *= times;
    }
    const struct gltf_json *const base =
        gloss != NULL ? gltf_json_get(gloss, "diffuseTexture") : gltf_json_get(pbr, "baseColorTexture");
    read_pictures(shared, file, from, base, glow, &surface, uv);
    for (int c = 0; c < 3; c++) {
        surface.colour[c] = model_gltf_channel(factor[c]);
        surface.glow[c] = model_gltf_channel(glow[c]);
        factor[c] = surface.picture.picture.rgb != NULL ? 1 : factor[c];
    }
    return model_surface_make(shared, &surface, to);
}

struct model_material *model_gltf_materials(struct model_shared *shared, struct gltf_file *file,
                                            struct model_gltf_uv *uvs)
{
    const uint32_t n = file->lists[GLTF_MATERIALS].count;
    struct model_material *materials = demo_alloc(&shared->arena, sizeof *materials * (n + 1));
    if (materials == NULL) {
        return NULL;
    }
    for (uint32_t i = 0; i <= n; i++) {
        uvs[i] = (struct model_gltf_uv){0, {{1, 0, 0}, {0, 1, 0}}, {1, 1, 1, 1}};
        if (i < n && !read_material(shared, file, gltf_file_item(file, GLTF_MATERIALS, i), &materials[i], &uvs[i])) {
            return NULL;
        }
    }
    struct model_surface surface = {.colour = {plain[0], plain[1], plain[2]}};
    return model_surface_make(shared, &surface, &materials[n]) ? materials : NULL;
}
