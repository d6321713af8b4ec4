#include "model_gltf.h"

#include "model_surface.h"
#include "png_in.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define CLAMP_TO_EDGE   33071
#define MIRRORED_REPEAT 33648

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

/* Multiplies the picture by a linear factor: what the file means, as the display shows it. */
static void multiply(struct ppm *picture, const double factor[3])
{
    uint8_t table[3][256];
    for (int c = 0; c < 3; c++) {
        for (int i = 0; i < 256; i++) {
            table[c][i] = (uint8_t)lround(255 * to_display(factor[c] * to_linear(i / 255.0)));
        }
    }
    const size_t n = (size_t)picture->width * picture->height;
    for (size_t i = 0; i < 3 * n; i++) {
        picture->rgb[i] = table[i % 3][picture->rgb[i]];
    }
}

/* Doubles the picture along u (0) or v (1), the second half mirrored. false: it would be too large. */
static bool mirror(struct ppm *picture, int along)
{
    const uint32_t w = picture->width, h = picture->height, wide = along == 0 ? 2 * w : w,
                   high = along == 1 ? 2 * h : h;
    uint8_t *rgb = wide <= PPM_SIDE_MAX && high <= PPM_SIDE_MAX ? malloc((size_t)wide * high * 3) : NULL;
    if (rgb == NULL) {
        return false;
    }
    for (uint32_t y = 0; y < high; y++) {
        for (uint32_t x = 0; x < wide; x++) {
            const uint32_t from_x = x < w ? x : 2 * w - 1 - x, from_y = y < h ? y : 2 * h - 1 - y;
            memcpy(rgb + ((size_t)y * wide + x) * 3, picture->rgb + ((size_t)from_y * w + from_x) * 3, 3);
        }
    }
    free(picture->rgb);
    *picture = (struct ppm){wide, high, rgb};
    return true;
}

/* Reads the picture of a texture; its name is for notes. NULL, or why there is none. */
static const char *load_picture(struct gltf_file *file, const struct cJSON *texture, struct model_surface *to)
{
    const uint32_t i = gltf_file_whole(texture, "source", GLTF_NONE);
    const struct cJSON *image = gltf_file_item(file, GLTF_IMAGES, i);
    const char *uri = cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(image, "uri"));
    const char *name = cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(image, "name"));
    const bool is_file = uri != NULL && strncmp(uri, "data:", 5) != 0;
    if (is_file || name != NULL) {
        snprintf(to->name, sizeof to->name, "%.100s", is_file ? uri : name);
    } else {
        snprintf(to->name, sizeof to->name, "%u", i);
    }
    const struct gltf_span bytes =
        uri != NULL ? gltf_file_uri(file, uri) : gltf_file_view(file, gltf_file_whole(image, "bufferView", GLTF_NONE));
    if (bytes.bytes == NULL) {
        file->error[0] = '\0'; /* a model without its picture is still a model */
        return "cannot be opened";
    }
    const char *why =
        png_in_memory(bytes.bytes, bytes.n, &to->picture) == 0 ? NULL : model_surface_why(bytes.bytes, bytes.n);
    if (uri != NULL) {
        free((void *)(uintptr_t)bytes.bytes);
    }
    return why;
}

/* KHR_texture_transform: offset, rotation and scale, in this order from the left. */
static void read_transform(const struct cJSON *info, struct model_gltf_uv *uv)
{
    const struct cJSON *from =
        cJSON_GetObjectItemCaseSensitive(cJSON_GetObjectItemCaseSensitive(info, "extensions"), "KHR_texture_transform");
    double offset[2] = {0, 0}, scale[2] = {1, 1};
    gltf_file_vector(from, "offset", 2, offset);
    gltf_file_vector(from, "scale", 2, scale);
    const double turn = gltf_file_number(from, "rotation", 0), c = cos(turn), s = sin(turn);
    *uv = (struct model_gltf_uv){gltf_file_whole(from, "texCoord", gltf_file_whole(info, "texCoord", 0)),
                                 {{c * scale[0], s * scale[1], offset[0]}, {-s * scale[0], c * scale[1], offset[1]}}};
}

/* Wrap modes; a mirrored picture is doubled, and its coordinates are halved. */
static void read_wrap(struct model_shared *shared, const struct cJSON *sampler, struct model_surface *to,
                      struct model_gltf_uv *uv)
{
    static const char *const keys[2] = {"wrapS", "wrapT"};
    for (int along = 0; along < 2; along++) {
        const uint32_t mode = gltf_file_whole(sampler, keys[along], 0);
        to->wrap[along] = mode == CLAMP_TO_EDGE ? PH_WRAP_CLAMP : PH_WRAP_REPEAT;
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

static void read_texture(struct model_shared *shared, struct gltf_file *file, const struct cJSON *info,
                         const double factor[4], struct model_surface *to, struct model_gltf_uv *uv)
{
    if (info == NULL) {
        return;
    }
    const struct cJSON *texture = gltf_file_item(file, GLTF_TEXTURES, gltf_file_whole(info, "index", GLTF_NONE));
    const char *why = load_picture(file, texture, to);
    if (why != NULL) {
        model_shared_note(shared, "texture %s is left out: it %s", to->name, why);
        return;
    }
    if (factor[0] < 1 || factor[1] < 1 || factor[2] < 1) {
        multiply(&to->picture, factor);
    }
    read_transform(info, uv);
    read_wrap(shared, gltf_file_item(file, GLTF_SAMPLERS, gltf_file_whole(texture, "sampler", GLTF_NONE)), to, uv);
}

static bool read_material(struct model_shared *shared, struct gltf_file *file, const struct cJSON *from,
                          struct ph_material *to, struct model_gltf_uv *uv)
{
    const struct cJSON *pbr = cJSON_GetObjectItemCaseSensitive(from, "pbrMetallicRoughness");
    const struct cJSON *extensions = cJSON_GetObjectItemCaseSensitive(from, "extensions");
    const struct cJSON *strength = cJSON_GetObjectItemCaseSensitive(extensions, "KHR_materials_emissive_strength");
    const char *mode = cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(from, "alphaMode"));
    const double times = gltf_file_number(strength, "emissiveStrength", 1);
    double factor[4] = {1, 1, 1, 1}, glow[3] = {0, 0, 0};
    gltf_file_vector(pbr, "baseColorFactor", 4, factor);
    gltf_file_vector(from, "emissiveFactor", 3, glow);
    struct model_surface surface = {.two_sided = cJSON_IsTrue(cJSON_GetObjectItemCaseSensitive(from, "doubleSided")),
                                    .is_unlit =
                                        cJSON_GetObjectItemCaseSensitive(extensions, "KHR_materials_unlit") != NULL,
                                    .is_transparent = mode != NULL && strcmp(mode, "OPAQUE") != 0};
    if (cJSON_GetObjectItemCaseSensitive(from, "emissiveTexture") != NULL && glow[0] + glow[1] + glow[2] > 0) {
        model_shared_note(shared, "emissive textures are ignored");
        memset(glow, 0, sizeof glow);
    }
    for (int c = 0; c < 3; c++) {
        surface.colour[c] = (uint8_t)lround(255 * to_display(factor[c]));
        surface.glow[c] = (uint8_t)lround(255 * to_display(glow[c] * times));
    }
    read_texture(shared, file, cJSON_GetObjectItemCaseSensitive(pbr, "baseColorTexture"), factor, &surface, uv);
    return model_surface_make(shared, &surface, to);
}

struct ph_material *model_gltf_materials(struct model_shared *shared, struct gltf_file *file, struct model_gltf_uv *uvs)
{
    const uint32_t n = file->lists[GLTF_MATERIALS].count;
    struct ph_material *materials = demo_alloc(&shared->arena, sizeof *materials * (n + 1));
    if (materials == NULL) {
        return NULL;
    }
    for (uint32_t i = 0; i <= n; i++) {
        uvs[i] = (struct model_gltf_uv){0, {{1, 0, 0}, {0, 1, 0}}};
        if (i < n && !read_material(shared, file, gltf_file_item(file, GLTF_MATERIALS, i), &materials[i], &uvs[i])) {
            return NULL;
        }
    }
    struct model_surface surface = {.colour = {plain[0], plain[1], plain[2]}};
    return model_surface_make(shared, &surface, &materials[n]) ? materials : NULL;
}
