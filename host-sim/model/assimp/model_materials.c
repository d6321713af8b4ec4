#include "model_materials.h"

#include "png_in.h"
#include "model_texture.h"

#include <assimp/material.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* How a material takes the light of the turntable; files give reliable colours only. */
#define AMBIENT        (FX_ONE / 6)
#define DIFFUSE        (FX_ONE * 3 / 4)
#define GLOSS          (FX_ONE / 4)
#define SHININESS_LOG2 5

#define PATH_BYTES 4096

/* The colour of a model without materials. */
static const struct aiColor4D plain = {.86f, .80f, .70f, 1};

/* Turns one channel, 0 .. 1, into a value of the display. */
static uint8_t channel(float value, bool is_linear)
{
    const float v = value > 0 ? (value < 1 ? value : 1) : 0; /* NaN gives 0 */
    if (!is_linear) {
        return (uint8_t)lroundf(v * 255);
    }
    return (uint8_t)lroundf(255 * (v <= .0031308f ? 12.92f * v : 1.055f * powf(v, 1 / 2.4f) - .055f));
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

/* Why a picture was not read, from its first bytes. */
static const char *why_unread(const uint8_t *bytes, size_t n)
{
    if (n >= 2 && bytes[0] == 0xFF && bytes[1] == 0xD8) {
        return "is JPEG: only PNG is read";
    }
    return n >= 4 && memcmp(bytes, "\x89PNG", 4) == 0 ? png_in_reason : "is no PNG: only PNG is read";
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
    return why_unread(bytes, n);
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
        return status == 0 ? NULL : why_unread((const uint8_t *)embedded->pcData, embedded->mWidth);
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

/* Returns the texture of a material. NULL: it has none, or one that cannot be used; a note says so. */
static const struct ph_texture *read_texture(struct model_shared *shared, const struct aiScene *scene,
                                             const struct aiMaterial *from, const char *model_path)
{
    const enum aiTextureType type =
        aiGetMaterialTextureCount(from, aiTextureType_DIFFUSE) > 0 ? aiTextureType_DIFFUSE : aiTextureType_BASE_COLOR;
    struct aiString name;
    if (aiGetMaterialTexture(from, type, 0, &name, NULL, NULL, NULL, NULL, NULL, NULL) != aiReturn_SUCCESS) {
        return NULL;
    }
    struct ppm picture;
    const char *why = load_picture(scene, model_path, name.data, &picture);
    if (why != NULL) {
        model_shared_note(shared, "texture %.100s is left out: it %s", name.data, why);
        return NULL;
    }
    struct ph_texture *texture = demo_alloc(&shared->arena, sizeof *texture);
    const int status = texture != NULL ? model_texture_make(&shared->arena, &picture, texture) : PH_ERR_NOMEM;
    free(picture.rgb);
    if (status != 0) {
        model_shared_note(shared, "texture %.100s is left out: no memory", name.data);
        return NULL;
    }
    const unsigned width = 1u << texture->log2_width, height = 1u << texture->log2_height;
    if (width != picture.width || height != picture.height) {
        model_shared_note(shared, "texture %.100s is resized from %ux%u to %ux%u", name.data, (unsigned)picture.width,
                          (unsigned)picture.height, width, height);
    }
    texture->wrap = wrap_of(from, type);
    return texture;
}

/* In glTF a mode says whether alpha counts; OBJ and others give the opacity itself. */
static bool is_transparent(const struct aiMaterial *from)
{
    struct aiString mode;
    ai_real opacity = 1;
    if (aiGetMaterialString(from, "$mat.gltf.alphaMode", 0, 0, &mode) == aiReturn_SUCCESS) {
        return strcmp(mode.data, "OPAQUE") != 0;
    }
    aiGetMaterialFloatArray(from, AI_MATKEY_OPACITY, &opacity, NULL);
    return opacity < 1 || aiGetMaterialTextureCount(from, aiTextureType_OPACITY) > 0;
}

static bool read_material(struct model_shared *shared, const struct aiScene *scene, const struct aiMaterial *from,
                          const char *path, bool is_linear, struct ph_material *to)
{
    uint16_t *ramp = demo_alloc(&shared->arena, sizeof *ramp * PH_RAMP_SIZE);
    if (ramp == NULL) {
        return false;
    }
    struct aiColor4D c = plain;
    struct aiString name = {0};
    int two_sided = 0;
    aiGetMaterialString(from, AI_MATKEY_NAME, &name);
    if (strcmp(name.data, AI_DEFAULT_MATERIAL_NAME) != 0) {
        aiGetMaterialColor(from, AI_MATKEY_COLOR_DIFFUSE, &c);
    }
    aiGetMaterialIntegerArray(from, AI_MATKEY_TWOSIDED, &two_sided, NULL);
    if (is_transparent(from)) {
        model_shared_note(shared, "transparency is ignored");
    }
    const uint8_t r = channel(c.r, is_linear), g = channel(c.g, is_linear), b = channel(c.b, is_linear);
    ph_material_ramp(ramp, r, g, b, GLOSS);
    *to = (struct ph_material){.shading = PH_SHADE_GOURAUD,
                               .two_sided = two_sided != 0,
                               .shininess_log2 = SHININESS_LOG2,
                               .ambient = AMBIENT,
                               .diffuse = DIFFUSE,
                               .specular = GLOSS,
                               .colour = ph_rgb565(r, g, b),
                               .ramp = ramp,
                               .texture = read_texture(shared, scene, from, path)};
    return true;
}

struct ph_material *model_materials_read(struct model_shared *shared, const struct aiScene *scene, const char *path,
                                         bool is_linear)
{
    struct ph_material *materials = demo_alloc(&shared->arena, sizeof *materials * scene->mNumMaterials);
    for (unsigned i = 0; materials != NULL && i < scene->mNumMaterials; i++) {
        if (!read_material(shared, scene, scene->mMaterials[i], path, is_linear, &materials[i])) {
            return NULL;
        }
    }
    return materials;
}
