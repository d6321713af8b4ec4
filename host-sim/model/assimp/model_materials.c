/* See model_materials.h. Converts assimp's materials: colour, texture, opacity. */
#include "model_materials.h"

#include "model_surface.h"

#include <assimp/material.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The colour of a model without materials. */
static const struct aiColor4D plain = {.86f, .80f, .70f, 1};

static const struct aiTexture *find_embedded(const struct aiScene *scene, const char *name)
{
    const unsigned long index = name[0] == '*' ? strtoul(name + 1, NULL, 10) : scene->mNumTextures;
    if (index < scene->mNumTextures) {
        return scene->mTextures[index];
    }
    for (unsigned i = 0; i < scene->mNumTextures; i++) {
        if (strcmp(scene->mTextures[i]->mFilename.data, name) == 0) {
            return scene->mTextures[i];
        }
    }
    return NULL;
}

/* Loads a picture. Returns NULL, or why there is none. */
static const char *load_picture(struct model_shared *shared, const struct aiScene *scene, const char *name,
                                struct picture_in *picture)
{
    const struct aiTexture *embedded = find_embedded(scene, name);
    if (embedded != NULL) { /* a height of 0 marks a file in memory; its width is its bytes */
        return embedded->mHeight != 0 ? "is raw: only PNG, JPEG and WebP are read"
                                      : picture_in_memory(picture, embedded->pcData, embedded->mWidth);
    }
    char path[MODEL_PATH_BYTES];
    return model_folder_find(&shared->folder, name, path) ? picture_in_file(picture, path) : "cannot be opened";
}

static uint8_t wrap_of(const struct aiMaterial *from, enum aiTextureType type)
{
    int mode = aiTextureMapMode_Wrap;
    aiGetMaterialIntegerArray(from, AI_MATKEY_MAPPINGMODE_U(type, 0), &mode, NULL);
    return mode == aiTextureMapMode_Clamp ? PH_WRAP_CLAMP : PH_WRAP_REPEAT;
}

/* Reads the texture of a material into the surface; a note says why it cannot be used. */
static void read_texture(struct model_shared *shared, const struct aiScene *scene, const struct aiMaterial *from,
                         struct model_surface *to)
{
    const enum aiTextureType type =
        aiGetMaterialTextureCount(from, aiTextureType_DIFFUSE) > 0 ? aiTextureType_DIFFUSE : aiTextureType_BASE_COLOR;
    struct aiString name;
    if (aiGetMaterialTexture(from, type, 0, &name, NULL, NULL, NULL, NULL, NULL, NULL) != aiReturn_SUCCESS) {
        return;
    }
    snprintf(to->name, sizeof to->name, "%.100s", name.data);
    to->picture.most = 1u << TEXTURE_LOG2_MAX;
    to->wrap = wrap_of(from, type);
    const char *why = load_picture(shared, scene, name.data, &to->picture);
    if (why != NULL) {
        model_shared_note(shared, "texture %s is left out: it %s", to->name, why);
        return;
    }
    free(to->picture.alpha); /* only map_d is alpha there */
    to->picture.alpha = NULL;
}

/* Reads alpha: MTL's d and map_d, whose alpha counts, or its grey. An opacity of 0 is written by programs that mean
 * 1. */
static void read_alpha(struct model_shared *shared, const struct aiScene *scene, const struct aiMaterial *from,
                       struct model_surface *to)
{
    struct aiString name;
    ai_real opacity = 1;
    aiGetMaterialFloatArray(from, AI_MATKEY_OPACITY, &opacity, NULL);
    to->alpha = opacity > 0 ? (double)opacity : 1;
    to->mode = to->alpha < 1 ? MODEL_BLEND : MODEL_OPAQUE;
    if (aiGetMaterialTexture(from, aiTextureType_OPACITY, 0, &name, NULL, NULL, NULL, NULL, NULL, NULL) !=
        aiReturn_SUCCESS) {
        return;
    }
    struct picture_in *mask = &to->mask;
    mask->most = 1u << TEXTURE_LOG2_MAX;
    const char *why = load_picture(shared, scene, name.data, mask);
    if (why != NULL) {
        model_shared_note(shared, "transparency %.100s is left out: it %s", name.data, why);
        return;
    }
    model_surface_mask(to);
}

static bool read_material(struct model_shared *shared, const struct aiScene *scene, const struct aiMaterial *from,
                          struct model_material *to)
{
    struct aiColor4D c = plain, glow = {0, 0, 0, 1};
    struct aiString name = {0};
    int two_sided = 0;
    aiGetMaterialString(from, AI_MATKEY_NAME, &name);
    if (strcmp(name.data, AI_DEFAULT_MATERIAL_NAME) != 0) {
        aiGetMaterialColor(from, AI_MATKEY_COLOR_DIFFUSE, &c);
        aiGetMaterialColor(from, AI_MATKEY_COLOR_EMISSIVE, &glow);
    }
    aiGetMaterialIntegerArray(from, AI_MATKEY_TWOSIDED, &two_sided, NULL);
    struct model_surface surface = {
        .colour = {model_surface_channel(c.r), model_surface_channel(c.g), model_surface_channel(c.b)},
        .glow = {model_surface_channel(glow.r), model_surface_channel(glow.g), model_surface_channel(glow.b)},
        .two_sided = two_sided != 0};
    read_texture(shared, scene, from, &surface);
    read_alpha(shared, scene, from, &surface);
    return model_surface_make(shared, &surface, to);
}

struct model_material *model_materials_read(struct model_shared *shared, const struct aiScene *scene)
{
    struct model_material *materials = demo_alloc(&shared->arena, sizeof *materials * scene->mNumMaterials);
    for (unsigned i = 0; materials != NULL && i < scene->mNumMaterials; i++) {
        if (!read_material(shared, scene, scene->mMaterials[i], &materials[i])) {
            return NULL;
        }
    }
    return materials;
}
