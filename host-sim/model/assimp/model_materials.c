#include "model_materials.h"

#include "png_in.h"
#include "model_surface.h"

#include <assimp/material.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define PATH_BYTES 4096

/* The colour of a model without materials. */
static const struct aiColor4D plain = {.86f, .80f, .70f, 1};

/* Turns one channel, 0 .. 1, into a value of the display. */
static uint8_t channel(float value)
{
    return (uint8_t)lroundf((value > 0 ? (value < 1 ? value : 1) : 0) * 255); /* NaN gives 0 */
}

/* Makes the path of the file that a material names, which stands beside the model. */
static bool beside(char out[PATH_BYTES], const char *model_path, const char *name)
{
    const char *slash = strrchr(model_path, '/');
    const int folder = slash == NULL || name[0] == '/' ? 0 : (int)(slash + 1 - model_path);
    const int n = snprintf(out, PATH_BYTES, "%.*s%s", folder, model_path, name);
    for (char *at = out; *at != '\0'; at++) {
        *at = *at == '\\' ? '/' : *at;
    }
    return n < PATH_BYTES;
}

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

void model_materials_note_missing(struct model_shared *shared, const char *model_path)
{
    static const char keyword[] = "mtllib ";
    char line[1024], path[PATH_BYTES];
    FILE *model = fopen(model_path, "r");
    while (model != NULL && fgets(line, sizeof line, model) != NULL) {
        if (strncmp(line, keyword, sizeof keyword - 1) != 0) {
            continue;
        }
        const char *name = line + sizeof keyword - 1;
        line[strcspn(line, "\r\n")] = '\0';
        FILE *file = beside(path, model_path, name) ? fopen(path, "r") : NULL;
        if (file == NULL) {
            model_shared_note(shared, "materials %.100s cannot be opened", name);
        } else {
            fclose(file);
        }
    }
    if (model != NULL) {
        fclose(model);
    }
}

static const char *why_file_unread(const char *path)
{
    uint8_t bytes[4];
    FILE *file = fopen(path, "rb");
    if (file == NULL) {
        return "cannot be opened";
    }
    const size_t n = fread(bytes, 1, sizeof bytes, file);
    fclose(file);
    return model_surface_why(bytes, n);
}

/* NULL, or why there is no picture. */
static const char *load_picture(const struct aiScene *scene, const char *model_path, const char *name,
                                struct ppm *picture)
{
    const struct aiTexture *embedded = find_embedded(scene, name);
    if (embedded != NULL) { /* a height of 0 marks a file in memory; its width is its bytes */
        if (embedded->mHeight != 0) {
            return "is raw: only PNG is read";
        }
        const int status = png_in_memory(embedded->pcData, embedded->mWidth, picture);
        return status == 0 ? NULL : model_surface_why((const uint8_t *)embedded->pcData, embedded->mWidth);
    }
    char path[PATH_BYTES];
    if (!beside(path, model_path, name)) {
        return "has too long a name";
    }
    return png_in_file(path, picture) == 0 ? NULL : why_file_unread(path);
}

static uint8_t wrap_of(const struct aiMaterial *from, enum aiTextureType type)
{
    int mode = aiTextureMapMode_Wrap;
    aiGetMaterialIntegerArray(from, AI_MATKEY_MAPPINGMODE_U(type, 0), &mode, NULL);
    return mode == aiTextureMapMode_Clamp ? PH_WRAP_CLAMP : PH_WRAP_REPEAT;
}

/* Reads the texture of a material into the surface; a note says why it cannot be used. */
static void read_texture(struct model_shared *shared, const struct aiScene *scene, const struct aiMaterial *from,
                         const char *model_path, struct model_surface *to)
{
    const enum aiTextureType type =
        aiGetMaterialTextureCount(from, aiTextureType_DIFFUSE) > 0 ? aiTextureType_DIFFUSE : aiTextureType_BASE_COLOR;
    struct aiString name;
    if (aiGetMaterialTexture(from, type, 0, &name, NULL, NULL, NULL, NULL, NULL, NULL) != aiReturn_SUCCESS) {
        return;
    }
    snprintf(to->name, sizeof to->name, "%.100s", name.data);
    to->wrap[0] = to->wrap[1] = wrap_of(from, type);
    const char *why = load_picture(scene, model_path, name.data, &to->picture);
    if (why != NULL) {
        model_shared_note(shared, "texture %s is left out: it %s", to->name, why);
    }
}

static bool is_transparent(const struct aiMaterial *from)
{
    ai_real opacity = 1;
    aiGetMaterialFloatArray(from, AI_MATKEY_OPACITY, &opacity, NULL);
    return opacity < 1 || aiGetMaterialTextureCount(from, aiTextureType_OPACITY) > 0;
}

static bool read_material(struct model_shared *shared, const struct aiScene *scene, const struct aiMaterial *from,
                          const char *path, struct ph_material *to)
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
    struct model_surface surface = {.colour = {channel(c.r), channel(c.g), channel(c.b)},
                                    .glow = {channel(glow.r), channel(glow.g), channel(glow.b)},
                                    .two_sided = two_sided != 0,
                                    .is_transparent = is_transparent(from)};
    read_texture(shared, scene, from, path, &surface);
    return model_surface_make(shared, &surface, to);
}

struct ph_material *model_materials_read(struct model_shared *shared, const struct aiScene *scene, const char *path)
{
    struct ph_material *materials = demo_alloc(&shared->arena, sizeof *materials * scene->mNumMaterials);
    for (unsigned i = 0; materials != NULL && i < scene->mNumMaterials; i++) {
        if (!read_material(shared, scene, scene->mMaterials[i], path, &materials[i])) {
            return NULL;
        }
    }
    return materials;
}
