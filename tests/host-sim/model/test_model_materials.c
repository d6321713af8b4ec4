/* model_materials: what becomes of the colours, textures and alphas of assimp's materials. The test makes those
 * materials property by property, and plays pictures and surfaces. */
#include "assimp/model_materials.h"

#include <assimp/material.h>
#include <assimp/scene.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { MATERIALS = 2, PROPERTIES = 8 };

static struct aiMaterialProperty properties[MATERIALS][PROPERTIES], *lists[MATERIALS][PROPERTIES];
static struct aiMaterial materials[MATERIALS], *all[MATERIALS];
static char data[MATERIALS][PROPERTIES][sizeof(struct aiString)];
static struct aiTexture embedded[2], *textures[2];
static struct aiScene scene;

static uint8_t memory[1 << 12];
static struct model_shared shared;
static struct model_surface surfaces[MATERIALS];
static unsigned made, masks;
static char loaded[128]; /* the pictures that were loaded */

/* ---- in place of pictures and surfaces ---------------------------------------------------------------------- */

static const char *load(struct picture_in *in, const char *name)
{
    assert_int_equal(in->most, 1u << TEXTURE_LOG2_MAX);
    strcat(strcat(loaded, name), " ");
    if (strstr(name, "broken") != NULL) {
        return "is broken";
    }
    in->picture = (struct ppm){1, 1, calloc(3, 1)};
    in->alpha = calloc(1, 1);
    return NULL;
}

const char *picture_in_file(struct picture_in *in, const char *path)
{
    return load(in, path);
}

const char *picture_in_memory(struct picture_in *in, const void *bytes, size_t n)
{
    char name[32];
    snprintf(name, sizeof name, "%.*s:%u", (int)n, (const char *)bytes, (unsigned)n);
    return load(in, name);
}

bool model_folder_find(struct model_folder *folder, const char *name, char path[MODEL_PATH_BYTES])
{
    assert_ptr_equal(folder, &shared.folder);
    snprintf(path, MODEL_PATH_BYTES, "/%s", name);
    return strstr(name, "missing") == NULL;
}

uint8_t model_surface_channel(float value)
{
    return (uint8_t)(value * 100 + .5f);
}

void model_surface_mask(struct model_surface *surface)
{
    surface->mode = MODEL_MASK;
    masks++;
}

bool model_surface_make(struct model_shared *of, struct model_surface *from, struct model_material *to)
{
    assert_true(of == &shared && to != NULL);
    surfaces[made++] = *from;
    free(from->picture.picture.rgb);
    free(from->picture.alpha);
    free(from->mask.picture.rgb);
    free(from->mask.alpha);
    return strcmp(from->name, "full.png") != 0;
}

/* ---- the tests ---------------------------------------------------------------------------------------------- */

static void put(int material, const char *key, unsigned semantic, enum aiPropertyTypeInfo type, const void *bytes,
                size_t n)
{
    struct aiMaterial *const m = &materials[material];
    struct aiMaterialProperty *const p = &properties[material][m->mNumProperties];
    assert_true(m->mNumProperties < PROPERTIES);
    memcpy(data[material][m->mNumProperties], bytes, n);
    *p = (struct aiMaterialProperty){
        .mSemantic = semantic, .mDataLength = (unsigned)n, .mType = type, .mData = data[material][m->mNumProperties]};
    p->mKey.length = (ai_uint32)strlen(key);
    strcpy(p->mKey.data, key);
    m->mNumProperties++;
}

static void put_text(int material, const char *key, unsigned semantic, const char *text)
{
    struct aiString s = {.length = (ai_uint32)strlen(text)};
    strcpy(s.data, text);
    put(material, key, semantic, aiPTI_String, &s, sizeof s.length + strlen(text) + 1);
}

static void put_colour(int material, const char *key, float r, float g, float b)
{
    const float c[4] = {r, g, b, 1};
    put(material, key, 0, aiPTI_Float, c, sizeof c);
}

static void put_number(int material, const char *key, unsigned semantic, int value)
{
    put(material, key, semantic, aiPTI_Integer, &value, sizeof value);
}

static void put_opacity(float value)
{
    put(0, "$mat.opacity", 0, aiPTI_Float, &value, sizeof value);
}

#define COLOUR   "$clr.diffuse"
#define GLOW     "$clr.emissive"
#define FILE_KEY "$tex.file"

static int fresh(void **state)
{
    static char first[] = "one", second[] = "second";
    (void)state;
    memset(&shared, 0, sizeof shared);
    shared.arena = (struct demo_arena){.base = memory, .size = sizeof memory};
    made = masks = 0;
    loaded[0] = '\0';
    for (int i = 0; i < MATERIALS; i++) {
        for (int k = 0; k < PROPERTIES; k++) {
            lists[i][k] = &properties[i][k];
        }
        materials[i] = (struct aiMaterial){.mProperties = lists[i], .mNumAllocated = PROPERTIES};
        all[i] = &materials[i];
    }
    embedded[0] = (struct aiTexture){.mWidth = 3, .pcData = (struct aiTexel *)(void *)first};
    embedded[1] = (struct aiTexture){.mWidth = 6, .pcData = (struct aiTexel *)(void *)second};
    strcpy(embedded[1].mFilename.data, "inside.png");
    textures[0] = &embedded[0], textures[1] = &embedded[1];
    scene = (struct aiScene){.mNumMaterials = 1, .mMaterials = all, .mNumTextures = 2, .mTextures = textures};
    return 0;
}

static const struct model_surface *read_first(void)
{
    made = 0;
    loaded[0] = shared.note[0] = '\0';
    assert_non_null(model_materials_read(&shared, &scene));
    assert_int_equal(made, scene.mNumMaterials);
    return &surfaces[0];
}

static void colours_are_the_files_but_those_of_a_default(void **state)
{
    (void)state;
    scene.mNumMaterials = 2;
    put_colour(0, COLOUR, .1f, .2f, .3f);
    put_colour(0, GLOW, .4f, .5f, .6f);
    put_number(0, "$mat.twosided", 0, 1);
    const struct model_surface *const s = read_first();
    assert_memory_equal(s[0].colour, ((uint8_t[]){10, 20, 30}), 3);
    assert_memory_equal(s[0].glow, ((uint8_t[]){40, 50, 60}), 3);
    assert_true(s[0].two_sided && !s[1].two_sided && s[0].mode == MODEL_OPAQUE && s[0].alpha == 1);
    assert_memory_equal(s[1].colour, ((uint8_t[]){86, 80, 70}), 3); /* nothing is said */
    assert_memory_equal(s[1].glow, ((uint8_t[]){0, 0, 0}), 3);
    put_text(0, "?mat.name", 0, AI_DEFAULT_MATERIAL_NAME);
    read_first();
    assert_memory_equal(s[0].colour, ((uint8_t[]){86, 80, 70}), 3);
    assert_memory_equal(s[0].glow, ((uint8_t[]){0, 0, 0}), 3);
    assert_string_equal(loaded, "");
}

static void diffuse_comes_before_the_base_colour(void **state)
{
    (void)state;
    put_text(0, FILE_KEY, aiTextureType_BASE_COLOR, "base.png");
    assert_string_equal(read_first()->name, "base.png");
    assert_string_equal(loaded, "/base.png ");
    assert_non_null(surfaces[0].picture.picture.rgb);
    assert_null(surfaces[0].picture.alpha); /* that of a colour does not count */
    put_text(0, FILE_KEY, aiTextureType_DIFFUSE, "diffuse.png");
    assert_string_equal(read_first()->name, "diffuse.png");
    assert_string_equal(loaded, "/diffuse.png ");
    assert_string_equal(shared.note, "");
}

static void a_texture_is_clamped_where_its_own_kind_says_so(void **state)
{
    (void)state;
    put_text(0, FILE_KEY, aiTextureType_DIFFUSE, "a.png");
    put_number(0, "$tex.mapmodeu", aiTextureType_BASE_COLOR, aiTextureMapMode_Clamp);
    assert_int_equal(read_first()->wrap, PH_WRAP_REPEAT);
    put_number(0, "$tex.mapmodeu", aiTextureType_DIFFUSE, aiTextureMapMode_Clamp);
    assert_int_equal(read_first()->wrap, PH_WRAP_CLAMP);
}

static void embedded_pictures_are_named_by_number_or_name(void **state)
{
    static const char *const cases[][2] = {
        {"*0", "one:3 "}, {"*1", "second:6 "}, {"*2", "/*2 "}, {"inside.png", "second:6 "}, {"1", "/1 "}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        fresh(NULL);
        put_text(0, FILE_KEY, aiTextureType_DIFFUSE, cases[i][0]);
        read_first();
        assert_string_equal(loaded, cases[i][1]);
    }
    embedded[1].mHeight = 1;
    put_text(0, FILE_KEY, aiTextureType_DIFFUSE, "inside.png");
    materials[0].mNumProperties = 0;
    put_text(0, FILE_KEY, aiTextureType_DIFFUSE, "inside.png");
    read_first();
    assert_string_equal(loaded, "");
    assert_string_equal(shared.note, "texture inside.png is left out: it is raw: only PNG, JPEG and WebP are read");
}

static void a_picture_that_is_none_is_left_out_and_told(void **state)
{
    (void)state;
    put_text(0, FILE_KEY, aiTextureType_DIFFUSE, "broken.png");
    assert_null(read_first()->picture.picture.rgb);
    assert_string_equal(shared.note, "texture broken.png is left out: it is broken");
    materials[0].mNumProperties = 0;
    put_text(0, FILE_KEY, aiTextureType_OPACITY, "missing.png");
    assert_null(read_first()->mask.picture.rgb);
    assert_string_equal(shared.note, "transparency missing.png is left out: it cannot be opened");
    assert_int_equal(masks, 0);
}

static void opacity_blends_and_a_map_of_it_is_the_mask(void **state)
{
    static const struct {
        float opacity;
        double alpha;
        uint8_t mode;
    } cases[] = {{1, 1, MODEL_OPAQUE}, {.5f, .5, MODEL_BLEND}, {0, 1, MODEL_OPAQUE}, {-1, 1, MODEL_OPAQUE}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        materials[0].mNumProperties = 0;
        put_opacity(cases[i].opacity);
        const struct model_surface *const s = read_first();
        assert_true(s->alpha == cases[i].alpha && s->mode == cases[i].mode);
    }
    put_text(0, FILE_KEY, aiTextureType_OPACITY, "mask.png");
    const struct model_surface *const s = read_first();
    assert_true(masks == 1 && s->mode == MODEL_MASK && s->mask.alpha != NULL && s->picture.picture.rgb == NULL);
    assert_string_equal(loaded, "/mask.png ");
}

static void an_arena_that_is_full_ends_it(void **state)
{
    (void)state;
    scene.mNumMaterials = 2;
    put_text(0, FILE_KEY, aiTextureType_DIFFUSE, "full.png");
    assert_null(model_materials_read(&shared, &scene));
    assert_int_equal(made, 1);
    shared.arena.size = sizeof(struct model_material) * 2 - 1;
    shared.arena.used = 0;
    assert_null(model_materials_read(&shared, &scene));
    assert_int_equal(made, 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(colours_are_the_files_but_those_of_a_default, fresh),
        cmocka_unit_test_setup(diffuse_comes_before_the_base_colour, fresh),
        cmocka_unit_test_setup(a_texture_is_clamped_where_its_own_kind_says_so, fresh),
        cmocka_unit_test_setup(embedded_pictures_are_named_by_number_or_name, fresh),
        cmocka_unit_test_setup(a_picture_that_is_none_is_left_out_and_told, fresh),
        cmocka_unit_test_setup(opacity_blends_and_a_map_of_it_is_the_mask, fresh),
        cmocka_unit_test_setup(an_arena_that_is_full_ends_it, fresh),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
