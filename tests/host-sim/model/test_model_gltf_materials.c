/* model_gltf_materials: what glTF 2.0, KHR_texture_transform, KHR_materials_unlit and KHR_materials_emissive_strength
 * say of a material, as a surface. Surfaces and the reader of pictures are played by the test; colours are those of
 * IEC 61966-2-1 (sRGB). */
#include "files.h"
#include "model_gltf.h"
#include "model_surface.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static struct model_shared shared;
static struct gltf_file file;
static struct model_gltf_uv uvs[4];
static struct model_surface got[4];
static uint32_t got_count, room;

/* In place of model_surface.c. */
bool model_surface_make(struct model_shared *to, struct model_surface *from, struct model_material *material)
{
    assert_true(to == &shared && material != NULL);
    if (got_count == room) {
        return false;
    }
    got[got_count++] = *from;
    return true;
}

/* In place of picture_in.c. A file is W, H, the colours and an alpha for each pixel. */
const char *picture_in_memory(struct picture_in *in, const void *bytes, size_t n)
{
    const uint8_t *from = bytes;
    assert_int_equal(in->most, 1024);
    if (n < 2 || n != 2 + (size_t)4 * from[0] * from[1]) {
        return "is broken";
    }
    const size_t pixels = (size_t)from[0] * from[1];
    in->width = from[0], in->height = from[1];
    in->picture = (struct ppm){from[0], from[1], malloc(3 * pixels)};
    in->alpha = malloc(pixels);
    assert_true(in->picture.rgb != NULL && in->alpha != NULL);
    memcpy(in->picture.rgb, from + 2, 3 * pixels);
    memcpy(in->alpha, from + 2 + 3 * pixels, pixels);
    return NULL;
}

void picture_in_free(struct picture_in *in)
{
    free(in->picture.rgb);
    free(in->alpha);
    in->picture.rgb = in->alpha = NULL;
}

/* Four pixels; the first is 128, 255, 0 with alpha 10, the second 1, 2, 3 with alpha 20. */
static const uint8_t four[18] = {2, 2, 128, 255, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 20, 30, 40};

/* Reads materials; texture 0 is `four` with this sampler, texture 1 the same without, 2 has no image, 3 is broken.
 * 6 is `four` as a WebP picture, 7 the same with a broken PNG for readers that cannot read it. */
static void read_file(const char *materials, const char *sampler)
{
    static uint8_t arena[4096];
    char text[4096];
    char *const data = file_base64(four, sizeof four);
    snprintf(
        text, sizeof text,
        "{\"asset\":{\"version\":\"2.0\"},\"materials\":[%s],\"samplers\":[{%s}],\"textures\":[{\"source\":0,"
        "\"sampler\":0},{\"source\":0},{\"source\":7},{\"source\":1},{\"source\":2},{\"source\":3},{\"extensions\":"
        "{\"EXT_texture_webp\":{\"source\":0}}},{\"source\":1,\"extensions\":{\"EXT_texture_webp\":{\"source\":0}}}],"
        "\"images\":["
        "{\"name\":\"four\",\"uri\":\"data:image/png;base64,%s\"},{\"uri\":\"data:image/png;base64,AAAA\"},"
        "{\"uri\":\"none.png\"},{\"bufferView\":0}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":18}],"
        "\"buffers\":[{\"byteLength\":18,\"uri\":\"data:;base64,%s\"}]}",
        materials, sampler, data, data);
    free(data);
    shared = (struct model_shared){.arena = {.base = arena, .size = sizeof arena}};
    shared.folder.model = file_text("a.gltf", text);
    file = (struct gltf_file){.folder = NULL};
    got_count = 0;
    assert_true(gltf_file_open(&file, &shared.folder));
    assert_int_equal(model_gltf_materials(&shared, &file, uvs) != NULL, room >= file.lists[GLTF_MATERIALS].count + 1);
}

static void read_one(const char *material, const char *sampler)
{
    char text[1024];
    room = 2;
    snprintf(text, sizeof text, "{%s}", material);
    read_file(text, sampler);
    assert_int_equal(got_count, 2);
}

static void expect_three(const uint8_t *colour, int r, int g, int b)
{
    assert_int_equal(colour[0], r);
    assert_int_equal(colour[1], g);
    assert_int_equal(colour[2], b);
}

static void light_becomes_that_of_a_display(void **state)
{
    static const struct {
        double linear;
        int channel;
    } cases[] = {{0, 0},    {.0003, 1}, {.0028865, 10}, {.003, 10}, {.0032, 11}, {.01, 25}, {.2158605, 128},
                 {.5, 188}, {1, 255},   {9, 255},       {-1, 0},    {NAN, 0},    {.9, 243}, {INFINITY, 255}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        assert_int_equal(model_gltf_channel(cases[i].linear), cases[i].channel);
    }
}

static void what_a_material_does_not_say_has_the_default_of_gltf(void **state)
{
    (void)state;
    read_one("", "");
    expect_three(got[0].colour, 255, 255, 255);
    expect_three(got[0].glow, 0, 0, 0);
    assert_true(got[0].alpha == 1 && got[0].cutoff == .5 && got[0].mode == MODEL_OPAQUE);
    assert_true(!got[0].two_sided && !got[0].is_unlit);
    expect_three(got[1].colour, 219, 204, 179); /* of primitives without a material */
    for (int i = 0; i < 2; i++) {
        const double one[6] = {1, 0, 0, 0, 1, 0}, white[4] = {1, 1, 1, 1};
        assert_memory_equal(uvs[i].m, one, sizeof one);
        assert_memory_equal(uvs[i].factor, white, sizeof white);
        assert_int_equal(uvs[i].set, 0);
        assert_null(got[i].picture.picture.rgb);
    }
    assert_string_equal(shared.note, "");
}

static void members_are_read(void **state)
{
    static const char *const modes[4] = {"OPAQUE", "MASK", "BLEND", "else"};
    static const uint8_t expected[4] = {MODEL_OPAQUE, MODEL_MASK, MODEL_BLEND, MODEL_OPAQUE};
    (void)state;
    read_one("\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.2158605,0.5,1,0.25]},\"emissiveFactor\":[0.1079302,0.25,"
             "0.005],\"doubleSided\":true,\"alphaCutoff\":0.75,\"extensions\":{\"KHR_materials_emissive_strength\":{"
             "\"emissiveStrength\":2},\"KHR_materials_unlit\":{}}",
             "");
    expect_three(got[0].colour, 128, 188, 255);
    expect_three(got[0].glow, 128, 188, 25);
    assert_true(got[0].alpha == .25 && got[0].cutoff == .75 && got[0].two_sided && got[0].is_unlit);
    assert_true(uvs[0].factor[1] == .5 && uvs[0].factor[3] == .25);
    assert_string_equal(shared.note, "");
    for (int i = 0; i < 4; i++) {
        char text[64];
        snprintf(text, sizeof text, "\"alphaMode\":\"%s\",\"doubleSided\":false", modes[i]);
        read_one(text, "");
        assert_true(got[0].mode == expected[i] && !got[0].two_sided);
    }
}

/* 128 is .2158605 of light, whose square is .0465958, which is 61; 255 times .5 is 188; 0 stays 0. */
static void a_factor_multiplies_the_light_of_a_picture(void **state)
{
    (void)state;
    read_one("\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.2158605,0.5,1,0.5],\"baseColorTexture\":{\"index\":1}}",
             "");
    expect_three(got[0].picture.picture.rgb, 61, 188, 0);
    assert_int_equal(got[0].picture.alpha[0], 10);
    assert_string_equal(got[0].name, "four");
    read_one("\"pbrMetallicRoughness\":{\"baseColorFactor\":[1,1,0,1],\"baseColorTexture\":{\"index\":5}}", "");
    expect_three(got[0].picture.picture.rgb, 128, 255, 0);
    expect_three(got[0].picture.picture.rgb + 3, 1, 2, 0);
    assert_string_equal(got[0].name, "3"); /* an image of a view has its number */
}

static void a_transform_scales_then_turns_then_moves(void **state)
{
    static const double m[2][3] = {{1.7320508075688772, 2, .25}, {-1, 3.4641016151377544, .125}};
    (void)state;
    read_one("\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":1,\"texCoord\":3,\"extensions\":{"
             "\"KHR_texture_transform\":{\"offset\":[0.25,0.125],\"rotation\":0.5235987755982988,\"scale\":[2,4]}}}}",
             "");
    for (int i = 0; i < 6; i++) {
        assert_true(fabs(uvs[0].m[i / 3][i % 3] - m[i / 3][i % 3]) < 1e-12);
    }
    assert_int_equal(uvs[0].set, 3);
    read_one("\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":1,\"texCoord\":3,\"extensions\":{"
             "\"KHR_texture_transform\":{\"texCoord\":2}}}}",
             "");
    assert_int_equal(uvs[0].set, 2);
    assert_true(uvs[0].m[0][0] == 1 && uvs[0].m[1][1] == 1 && uvs[0].m[0][1] == 0 && uvs[0].m[1][2] == 0);
}

#define PICTURE "\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}"

static void a_mirrored_picture_is_doubled_and_its_coordinates_halved(void **state)
{
    static const uint8_t along_u[8] = {10, 20, 20, 10, 30, 40, 40, 30}, along_v[8] = {10, 20, 30, 40, 30, 40, 10, 20};
    (void)state;
    for (int axis = 0; axis < 2; axis++) {
        read_one(PICTURE, axis == 0 ? "\"wrapS\":33648,\"wrapT\":33071" : "\"wrapT\":33648,\"wrapS\":10497");
        const struct picture_in *p = &got[0].picture;
        assert_memory_equal(p->alpha, axis == 0 ? along_u : along_v, 8);
        expect_three(p->picture.rgb + (axis == 0 ? 9 : 18), 128, 255, 0);
        assert_true(p->width == (axis == 0 ? 4 : 2) && p->height == (axis == 0 ? 2 : 4));
        assert_true(p->picture.width == p->width && p->picture.height == p->height);
        assert_true(uvs[0].m[0][0] == (axis == 0 ? .5 : 1) && uvs[0].m[1][1] == (axis == 0 ? 1 : .5));
        assert_int_equal(got[0].wrap, axis == 0 ? PH_WRAP_CLAMP_V : PH_WRAP_REPEAT);
    }
}

static void a_sampler_gives_the_nearest_filter_that_there_is(void **state)
{
    static const struct {
        const char *sampler;
        const struct ph_filter *filter;
    } cases[] = {{"", PH_FILTER_NEAREST},
                 {"\"magFilter\":9728,\"minFilter\":9987", PH_FILTER_NEAREST},
                 {"\"magFilter\":9729", PH_FILTER_BILINEAR},
                 {"\"minFilter\":9729", PH_FILTER_BILINEAR},
                 {"\"minFilter\":9728", PH_FILTER_NEAREST},
                 {"\"minFilter\":9984", PH_FILTER_MIPMAP},
                 {"\"magFilter\":9729,\"minFilter\":9987", PH_FILTER_MIPMAP}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        read_one(PICTURE, cases[i].sampler);
        assert_ptr_equal(got[0].filter, cases[i].filter);
    }
}

#define GLOW        "\"emissiveFactor\":[1,1,1],\"emissiveTexture\":"
#define IS_IGNORED  "emissive textures with coordinates of their own are ignored"
#define MOVED(what) "{\"index\":1,\"extensions\":{\"KHR_texture_transform\":{" what "}}}"

static void a_glowing_picture_lies_on_the_coordinates_of_the_texture(void **state)
{
    static const struct {
        const char *material, *note;
    } cases[] = {
        {"\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":1}}," GLOW "{\"index\":1}", ""},
        {"\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":1}}," GLOW "{\"index\":1,\"texCoord\":1}",
         IS_IGNORED},
        {"\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":1}}," GLOW MOVED("\"offset\":[0,1]"), IS_IGNORED},
        {"\"pbrMetallicRoughness\":{\"baseColorTexture\":" MOVED("\"offset\":[0,1]") "}," GLOW MOVED(
             "\"offset\":[0,1]"),
         ""},
        {"\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":1}}," GLOW "{\"index\":0}", IS_IGNORED},
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        read_one(cases[i].material, "\"wrapT\":33071");
        assert_string_equal(shared.note, cases[i].note);
        assert_non_null(got[0].picture.picture.rgb);
        assert_int_equal(got[0].glowing.picture.rgb != NULL, cases[i].note[0] == '\0');
        assert_null(got[0].glowing.alpha);
        expect_three(got[0].glow, cases[i].note[0] != '\0' ? 0 : 255, cases[i].note[0] != '\0' ? 0 : 255,
                     cases[i].note[0] != '\0' ? 0 : 255);
        assert_false(got[0].is_unlit);
    }
}

static void a_glow_without_a_texture_brings_its_own_wrap_and_filter(void **state)
{
    (void)state;
    read_one("\"pbrMetallicRoughness\":{\"baseColorFactor\":[0,0,0.5,1]}," GLOW "{\"index\":0,\"texCoord\":1}",
             "\"wrapS\":33071,\"magFilter\":9729");
    assert_true(got[0].glowing.picture.rgb != NULL && got[0].picture.picture.rgb == NULL && !got[0].is_unlit);
    assert_int_equal(got[0].wrap, PH_WRAP_CLAMP_U);
    assert_ptr_equal(got[0].filter, PH_FILTER_BILINEAR);
    assert_string_equal(got[0].name, "four");
    assert_int_equal(uvs[0].set, 1);
    read_one("\"pbrMetallicRoughness\":{\"baseColorFactor\":[0,0,0,1],\"baseColorTexture\":{\"index\":0}},"
             "\"emissiveFactor\":[0.5,1,1],\"emissiveTexture\":{\"index\":1}",
             "");
    assert_true(got[0].is_unlit && got[0].glowing.picture.rgb == NULL); /* black that glows is the picture, unlit */
    expect_three(got[0].picture.picture.rgb, 92, 255, 0);               /* half the light of 128 */
    read_one(GLOW "{\"index\":1},\"extensions\":{\"KHR_materials_unlit\":{}}", "");
    assert_null(got[0].glowing.picture.rgb);
    read_one("\"emissiveFactor\":[0,0,0],\"emissiveTexture\":{\"index\":1}", "");
    assert_null(got[0].glowing.picture.rgb);
}

static void a_picture_may_be_webp(void **state)
{
    (void)state;
    read_one("\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":6}}", "");
    assert_non_null(got[0].picture.picture.rgb);
    expect_three(got[0].picture.picture.rgb, 128, 255, 0);
    assert_string_equal(shared.note, "");
}

/* KHR_materials_pbrSpecularGlossiness: its diffuse colour stands in place of the base colour, all of it. */
static void a_diffuse_colour_is_the_base_colour(void **state)
{
    (void)state;
    read_one("\"pbrMetallicRoughness\":{\"baseColorFactor\":[1,1,1,1],\"baseColorTexture\":{\"index\":3}},"
             "\"alphaMode\":\"BLEND\",\"extensions\":{\"KHR_materials_pbrSpecularGlossiness\":{"
             "\"diffuseFactor\":[0.5,0.01,1,0.25],\"diffuseTexture\":{\"index\":1}}}",
             "");
    expect_three(got[0].colour, 188, 25, 255);
    assert_true(got[0].alpha == .25);
    expect_three(got[0].picture.picture.rgb, 92, 25, 0);
    assert_string_equal(shared.note, "");
    read_one("\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":1}},\"extensions\":{"
             "\"KHR_materials_pbrSpecularGlossiness\":{}}",
             "");
    expect_three(got[0].colour, 255, 255, 255);
    assert_null(got[0].picture.picture.rgb);
}

static void what_is_not_there_or_not_read_is_noted(void **state)
{
    static const struct {
        const char *material, *note;
    } cases[] = {
        {"\"pbrMetallicRoughness\":{\"baseColorTexture\":{}}", "a material has a texture without an index"},
        {"\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":8}}",
         "a material names texture 8, and the file has 8"},
        {"\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":2}}",
         "texture 2 is left out: it names no image that the file has"},
        {"\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":3}}", "texture 1 is left out: it is broken"},
        {"\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":4}}",
         "texture none.png is left out: it cannot be opened"},
        {"\"normalTexture\":{}", "normal maps are ignored"},
        {"\"occlusionTexture\":{}", "occlusion maps are ignored"},
        {"\"pbrMetallicRoughness\":{\"metallicRoughnessTexture\":{}}", "maps of metal and roughness are ignored"},
        {"\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":7}}", "texture 1 is left out: it is broken"},
        {"\"extensions\":{\"KHR_materials_unlit\":{},\"EXT_a\":{},\"KHR_materials_emissive_strength\":{},\"EXT_b\":{}}",
         "EXT_a is ignored; EXT_b is ignored"},
        {"\"extensions\":{\"KHR_materials_volume\":{},\"KHR_materials_sheen\":{},\"KHR_materials_transmission\":{}}",
         "KHR_materials_transmission is ignored"},
        {"\"extensions\":{\"KHR_materials_anisotropy\":{},\"sheen\":{},\"KHR_materials_\":{}}",
         "sheen is ignored; KHR_materials_ is ignored"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        read_one(cases[i].material, "");
        assert_string_equal(shared.note, cases[i].note);
        assert_string_equal(file.error, "");
        assert_null(got[0].picture.picture.rgb);
    }
}

static void each_material_has_its_place_and_without_memory_there_are_none(void **state)
{
    static const char materials[] = "{\"alphaCutoff\":0.25},{\"alphaCutoff\":0.125},{\"alphaCutoff\":1}";
    (void)state;
    for (room = 0; room <= 4; room++) {
        read_file(materials, "");
        assert_int_equal(got_count, room);
    }
    assert_true(got[0].cutoff == .25 && got[1].cutoff == .125 && got[2].cutoff == 1 && got[3].colour[0] == 219);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(light_becomes_that_of_a_display),
        cmocka_unit_test(what_a_material_does_not_say_has_the_default_of_gltf),
        cmocka_unit_test(members_are_read),
        cmocka_unit_test(a_factor_multiplies_the_light_of_a_picture),
        cmocka_unit_test(a_transform_scales_then_turns_then_moves),
        cmocka_unit_test(a_mirrored_picture_is_doubled_and_its_coordinates_halved),
        cmocka_unit_test(a_sampler_gives_the_nearest_filter_that_there_is),
        cmocka_unit_test(a_glowing_picture_lies_on_the_coordinates_of_the_texture),
        cmocka_unit_test(a_glow_without_a_texture_brings_its_own_wrap_and_filter),
        cmocka_unit_test(a_picture_may_be_webp),
        cmocka_unit_test(a_diffuse_colour_is_the_base_colour),
        cmocka_unit_test(what_is_not_there_or_not_read_is_noted),
        cmocka_unit_test(each_material_has_its_place_and_without_memory_there_are_none),
    };
    return cmocka_run_group_tests(tests, files_begin, files_end);
}
