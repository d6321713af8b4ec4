/* glTF: generated files, one feature each, with the colour or place that is expected. */
#include "complain.h"
#include "model_files.h"

#include <png.h>

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <setjmp.h>
#include <cmocka.h>

#define HEAD "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
#define BUFFER                                                                                                         \
    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":60},{\"buffer\":0,\"byteOffset\":36,\"byteLength\":24}],"           \
    "\"buffers\":[{\"byteLength\":60,\"uri\":\"gltf.bin\"}]}"
#define ACCESSORS                                                                                                      \
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"},"                          \
    "{\"bufferView\":1,\"componentType\":5126,\"count\":3,\"type\":\"VEC2\"}],"
#define MESH "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"TEXCOORD_0\":1},\"material\":0}]}],"

/* Positions (0,0,0) (1,0,0) (0,1,0), coordinates (0,0) (1,0) (0,1). */
static void write_triangle(void)
{
    static const int places[4] = {3, 7, 11, 14};
    file_ones("gltf.bin", places, 4, 60);
}

/* A picture of two pixels: grey of 128, and white. */
static void write_picture(const char *name)
{
    static const uint8_t pixels[6] = {128, 128, 128, 255, 255, 255};
    png_image image = {.version = PNG_IMAGE_VERSION, .width = 2, .height = 1, .format = PNG_FORMAT_RGB};
    assert_true(png_image_write_to_file(&image, file_path(name), 0, pixels, 0, NULL));
}

/* A triangle with this material; the texture's name and its sampler and extras are given, too. */
static struct model *with_material(const char *material, const char *uri, const char *sampler)
{
    char text[4096];
    write_triangle();
    snprintf(text, sizeof text,
             HEAD MESH "\"materials\":[{%s}],\"textures\":[{\"source\":0,\"sampler\":0}],\"samplers\":[{%s}],"
                       "\"images\":[{\"uri\":\"%s\"}]," ACCESSORS BUFFER,
             material, sampler, uri);
    return open_good(file_text("feature.gltf", text));
}

static void a_factor_multiplies_its_texture_in_linear_light(void **state)
{
    (void)state;
    write_picture("a b.png");
    struct model *model = with_material("\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.2158605,1,0,1],"
                                        "\"baseColorTexture\":{\"index\":0}}",
                                        "a%20b.png", "");
    const struct ph_texture *texture = model->meshes->materials->texture;
    assert_null(model->note);
    assert_non_null(texture);
    /* sRGB 128 is .2158605 in linear light; its square .0465958 is 61 (oracle: the formula of IEC 61966-2-1). */
    assert_int_equal(texture->texels[0], ph_rgb565(61, 128, 0));
    assert_int_equal(texture->texels[1], ph_rgb565(128, 255, 0));
    model_close(model);
}

static void a_mirrored_texture_is_doubled(void **state)
{
    (void)state;
    write_picture("two.png");
    struct model *model = with_material("\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}", "two.png",
                                        "\"wrapS\":33648,\"wrapT\":10497");
    const struct ph_texture *texture = model->meshes->materials->texture;
    const uint16_t grey = ph_rgb565(128, 128, 128), white = ph_rgb565(255, 255, 255);
    const uint16_t expected[4] = {grey, white, white, grey};
    assert_int_equal(texture->log2_width, 2);
    assert_memory_equal(texture->texels, expected, sizeof expected);
    for (uint32_t i = 0; i < 3; i++) {
        const struct fx_vec3 *p = &model->meshes->positions[i];
        assert_int_equal(model->meshes->uvs[i][0], p->x > 0 ? FX_ONE / 2 : 0);
        assert_int_equal(model->meshes->uvs[i][1], p->y > 0 ? FX_ONE : 0);
    }
    model_close(model);
}

/* Without --filter they are drawn by their nearest texels, and a note says what the file asks for. */
static void a_sampler_names_the_filter(void **state)
{
    static const struct {
        const char *sampler;
        const struct ph_filter *filter;
    } cases[] = {{"", PH_FILTER_NEAREST},
                 {"\"magFilter\":9728,\"minFilter\":9984", PH_FILTER_NEAREST},
                 {"\"magFilter\":9729,\"minFilter\":9729", PH_FILTER_BILINEAR},
                 {"\"magFilter\":9729", PH_FILTER_BILINEAR},
                 {"\"magFilter\":9729,\"minFilter\":9987", PH_FILTER_MIPMAP},
                 {"\"minFilter\":9985", PH_FILTER_MIPMAP}};
    static const struct model_options as_the_file = {.filter = "file"}, bilinear = {.filter = "bilinear"};
    (void)state;
    write_picture("two.png");
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct model *model =
            with_material("\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}", "two.png", cases[i].sampler);
        assert_ptr_equal(model->meshes->materials->texture->filter, PH_FILTER_NEAREST);
        assert_int_equal(model->note != NULL, cases[i].filter != PH_FILTER_NEAREST);
        model_close(model);
        assert_int_equal(model_open(&model, file_path("feature.gltf"), &as_the_file), 0);
        assert_ptr_equal(model->meshes->materials->texture->filter, cases[i].filter);
        assert_null(model->note);
        model_close(model);
        assert_int_equal(model_open(&model, file_path("feature.gltf"), &bilinear), 0);
        assert_ptr_equal(model->meshes->materials->texture->filter, PH_FILTER_BILINEAR);
        model_close(model);
    }
}

static void a_texture_transform_moves_turns_and_scales(void **state)
{
    (void)state;
    write_picture("two.png");
    struct model *model =
        with_material("\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0,\"extensions\":{"
                      "\"KHR_texture_transform\":{\"offset\":[0.25,0.5],\"rotation\":1.5707963267948966,"
                      "\"scale\":[2,3]}}}}",
                      "two.png", "");
    for (uint32_t i = 0; i < 3; i++) { /* u' = .25 + 3 v, v' = .5 - 2 u */
        const struct fx_vec3 *p = &model->meshes->positions[i];
        assert_int_equal(model->meshes->uvs[i][0], FX_ONE / 4 + (p->y > 0 ? 3 * FX_ONE : 0));
        assert_int_equal(model->meshes->uvs[i][1], FX_ONE / 2 - (p->x > 0 ? 2 * FX_ONE : 0));
    }
    model_close(model);
}

static void emission_is_in_the_ramp_and_unlit_has_none(void **state)
{
    (void)state;
    struct model *model = with_material("\"pbrMetallicRoughness\":{\"baseColorFactor\":[0,0,0,1]},"
                                        "\"emissiveFactor\":[1,0,0]",
                                        "none.png", "");
    const uint16_t darkest = model->meshes->materials->ramp[0];
    assert_int_equal(darkest & ph_rgb565(255, 0, 0), ph_rgb565(255, 0, 0));
    assert_ptr_equal(model->meshes->materials->shading, PH_SHADE_GOURAUD);
    model_close(model);
    model = with_material("\"pbrMetallicRoughness\":{\"baseColorFactor\":[0,1,0,1]},"
                          "\"extensions\":{\"KHR_materials_unlit\":{}}",
                          "none.png", "");
    assert_ptr_equal(model->meshes->materials->shading, PH_SHADE_UNLIT);
    assert_int_equal(model->meshes->materials->colour, ph_rgb565(0, 255, 0));
    model_close(model);
}

static void a_texture_that_glows_on_black_is_drawn_unlit(void **state)
{
    (void)state;
    write_picture("glow.png");
    struct model *model = with_material("\"pbrMetallicRoughness\":{\"baseColorFactor\":[0,0,0,1]},"
                                        "\"emissiveFactor\":[1,0.2158605,0],\"emissiveTexture\":{\"index\":0}",
                                        "glow.png", "");
    const struct ph_material *material = model->meshes->materials;
    assert_null(model->note);
    assert_ptr_equal(material->shading, PH_SHADE_TEXTURE);
    assert_int_equal(material->texture->texels[0], ph_rgb565(128, 61, 0));
    model_close(model);
}

/* The same triangle again, nearer by a code, unlit, and added; with and without a texture below. */
static void a_glow_is_drawn_over_its_surface(void **state)
{
    static const char *const surfaces[] = {"", "\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}},"};
    (void)state;
    write_picture("glow.png");
    for (int k = 0; k < 2; k++) {
        char material[256];
        snprintf(material, sizeof material, "%s\"emissiveFactor\":[1,0.2158605,0],\"emissiveTexture\":{\"index\":0}",
                 surfaces[k]);
        struct model *model = with_material(material, "glow.png", "");
        const struct ph_material *glow = model->meshes[1].materials;
        assert_null(model->note);
        assert_int_equal(model->mesh_count, 2);
        assert_ptr_equal(model->meshes[0].materials->shading, k == 0 ? PH_SHADE_GOURAUD : PH_SHADE_TEXTURE_GOURAUD);
        assert_null(model->meshes[0].materials->blend);
        assert_ptr_equal(glow->shading, PH_SHADE_TEXTURE);
        assert_int_equal(glow->texture->texels[0], ph_rgb565(128, 61, 0));
        assert_int_equal(glow->blend->kind, PH_BLEND_ADD);
        assert_in_range(glow->depth_bias, 8, 56);
        assert_memory_equal(model->meshes[0].positions, model->meshes[1].positions, 3 * sizeof(struct fx_vec3));
        model_close(model);
    }
    struct model *model =
        with_material("\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}},\"emissiveFactor\":[1,1,1],"
                      "\"emissiveTexture\":{\"index\":0,\"texCoord\":1}",
                      "glow.png", "");
    assert_string_equal(model->note, "emissive textures with coordinates of their own are ignored");
    assert_int_equal(model->mesh_count, 1);
    model_close(model);
}

/* Pixels of alpha 255, 150, 100 and 0, 4 x 1. */
static void write_alphas(const char *name)
{
    static const uint8_t pixels[16] = {255, 0, 0, 255, 255, 0, 0, 150, 255, 0, 0, 100, 255, 0, 0, 0};
    png_image image = {.version = PNG_IMAGE_VERSION, .width = 4, .height = 1, .format = PNG_FORMAT_RGBA};
    assert_true(png_image_write_to_file(&image, file_path(name), 0, pixels, 0, NULL));
}

/* The green of a texel, 0 .. 63. */
static unsigned green(uint16_t texel)
{
    uint8_t bytes[2];
    memcpy(bytes, &texel, sizeof bytes);
    return ((unsigned)bytes[0] << 8 | bytes[1]) >> 5 & 63;
}

#define ALPHA_MATERIAL "\"pbrMetallicRoughness\":{\"baseColorFactor\":[1,1,1,%s],\"baseColorTexture\":{\"index\":0}}%s"

static struct model *with_alpha(const char *factor, const char *mode)
{
    char material[512];
    write_alphas("alpha.png");
    snprintf(material, sizeof material, ALPHA_MATERIAL, factor, mode);
    return with_material(material, "alpha.png", "");
}

/* What is drawn has an alpha of at least one half in the texture of greys: scene.h. */
static void a_mask_cuts_out_below_its_cut_off(void **state)
{
    static const struct {
        const char *factor, *mode;
        unsigned left; /* how many of the four texels are drawn */
    } cases[] = {{"1", ",\"alphaMode\":\"MASK\"", 2},
                 {"1", ",\"alphaMode\":\"MASK\",\"alphaCutoff\":0.3", 3},
                 {"1", ",\"alphaMode\":\"MASK\",\"alphaCutoff\":0.9", 1},
                 {"0.5", ",\"alphaMode\":\"MASK\",\"alphaCutoff\":0.25", 2}};
    (void)state;
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
        struct model *model = with_alpha(cases[k].factor, cases[k].mode);
        const struct ph_blend *blend = model->meshes->materials->blend;
        assert_non_null(blend);
        assert_int_equal(blend->kind, PH_BLEND_MASK);
        for (unsigned i = 0; i < 4; i++) {
            assert_int_equal(green(blend->alphas->texels[i]) >= 32, i < cases[k].left);
        }
        assert_null(model->note);
        model_close(model);
    }
    struct model *model = with_alpha("1", ",\"alphaMode\":\"MASK\",\"alphaCutoff\":0");
    assert_null(model->meshes->materials->blend);
    model_close(model);
}

static void a_blend_has_the_alpha_of_factor_and_texture(void **state)
{
    static const unsigned low[4] = {63, 37, 24, 0}; /* alpha * 63 / 255, rounded down */
    (void)state;
    struct model *model = with_alpha("0.25", ",\"alphaMode\":\"BLEND\"");
    const struct ph_blend *blend = model->meshes->materials->blend;
    assert_non_null(blend);
    assert_int_equal(blend->kind, PH_BLEND_ALPHA);
    assert_int_equal(blend->alpha, 8);
    for (unsigned i = 0; i < 4; i++) {
        assert_in_range(green(blend->alphas->texels[i]), low[i], low[i] + 1);
    }
    model_close(model);
    model = with_alpha("0.25", "");
    assert_null(model->meshes->materials->blend); /* opaque, says glTF, whatever alpha is */
    model_close(model);
    write_picture("whole.png");
    model = with_material("\"alphaMode\":\"BLEND\",\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}",
                          "whole.png", "");
    assert_null(model->meshes->materials->blend); /* alpha is 1 everywhere */
    model_close(model);
}

static void what_a_material_does_not_get_is_said_once(void **state)
{
    (void)state;
    struct model *model =
        with_material("\"normalTexture\":{\"index\":0},\"occlusionTexture\":{\"index\":0},"
                      "\"pbrMetallicRoughness\":{\"metallicRoughnessTexture\":{\"index\":0}},"
                      "\"extensions\":{\"KHR_materials_transmission\":{},\"KHR_materials_clearcoat\":{}}",
                      "none.png", "");
    assert_string_equal(model->note, "normal maps are ignored; occlusion maps are ignored; maps of metal and roughness "
                                     "are ignored; KHR_materials_transmission is ignored");
    model_close(model);
}

static void a_texture_that_is_not_there_is_told_by_its_number(void **state)
{
    (void)state;
    struct model *model =
        with_material("\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":77}}", "none.png", "");
    assert_string_equal(model->note, "a material names texture 77, and the file has 1");
    assert_null(model->meshes->materials->texture);
    model_close(model);
    model = with_material("\"pbrMetallicRoughness\":{\"baseColorTexture\":{}}", "none.png", "");
    assert_string_equal(model->note, "a material has a texture without an index");
    model_close(model);
    write_triangle();
    model = open_good(file_text("feature.gltf", HEAD MESH
                                "\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}}],"
                                "\"textures\":[{}]," ACCESSORS BUFFER));
    assert_string_equal(model->note, "texture 0 is left out: it names no image that the file has");
    model_close(model);
}

/* Colours of three vertices: bytes with alpha, and floats without it, multiplied by the factor in linear light. */
static void vertex_colours_are_multiplied_in_linear_light(void **state)
{
    static const char form[] =
        HEAD "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"COLOR_0\":1},\"material\":0}]}],"
             "\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.2158605,1,1,1]}}],"
             "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"},"
             "{\"bufferView\":1,\"componentType\":%s,\"count\":3}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":"
             "36},{\"buffer\":0,\"byteOffset\":36,\"byteLength\":%d}],\"buffers\":[{\"byteLength\":%d,\"uri\":"
             "\"gltf.bin\"}]}";
    /* (1,0,0) (0,1,0) and .2158605 or 55 / 255 of white, which the display shows as 128 */
    static const uint8_t some[12] = {255, 0, 0, 255, 0, 255, 0, 0, 55, 55, 55, 255};
    static const float others[9] = {1, 0, 0, 0, 1, 0, .2158605f, .2158605f, .2158605f};
    static const float places[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    (void)state;
    for (int k = 0; k < 2; k++) {
        uint8_t bytes[72] = {0};
        char text[1024];
        const size_t n = k == 0 ? sizeof some : sizeof others;
        memcpy(bytes, places, sizeof places);
        memcpy(bytes + 36, k == 0 ? (const void *)some : others, n);
        file_bytes("gltf.bin", bytes, 36 + n);
        snprintf(text, sizeof text, form,
                 k == 0 ? "5121,\"normalized\":true,\"type\":\"VEC4\"" : "5126,\"type\":\"VEC3\"", (int)n,
                 (int)(36 + n));
        struct model *model = open_good(file_text("colours.gltf", text));
        const struct ph_mesh *mesh = model->meshes;
        assert_string_equal(model->note != NULL ? model->note : "",
                            k == 0 ? "alphas of vertex colours are ignored" : "");
        assert_non_null(mesh->colours);
        for (uint32_t i = 0; i < 3; i++) {
            const struct fx_vec3 *p = &mesh->positions[i];
            const uint16_t expected = p->x > 0   ? ph_rgb565(0, 255, 0)
                                      : p->y > 0 ? ph_rgb565(61, 128, 128)
                                                 : ph_rgb565(128, 0, 0);
            assert_int_equal(mesh->colours[i], expected);
        }
        model_close(model);
    }
}

#define QUANTIZED "\"extensionsUsed\":[\"KHR_mesh_quantization\"],"

/* A mesh with a position accessor, a buffer of n bytes and what else is given. */
static const char *with_accessor(const char *accessor, const char *views, const void *bytes, size_t n)
{
    char text[2048];
    file_bytes("gltf.bin", bytes, n);
    snprintf(text, sizeof text,
             HEAD QUANTIZED
             "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],\"accessors\":[{%s,\"type\":"
             "\"VEC3\"}],\"bufferViews\":[%s],\"buffers\":[{\"byteLength\":%u,\"uri\":\"gltf.bin\"}]}",
             accessor, views, (unsigned)n);
    return file_text("accessor.gltf", text);
}

/* The right triangle, fitted: its long side is the diameter of the sphere, so the others are sqrt(2) long. */
static void assert_triangle(const char *path)
{
    struct model *model = open_good(path);
    const struct ph_mesh *mesh = model->meshes;
    assert_null(model->note);
    assert_int_equal(mesh->triangle_count, 1);
    for (uint32_t i = 0; i < 3; i++) {
        assert_in_range(abs(mesh->positions[i].x), 46340, 46342);
        assert_in_range(abs(mesh->positions[i].y), 46340, 46342);
        assert_int_equal(mesh->positions[i].x > 0, i == 1);
        assert_int_equal(mesh->positions[i].y > 0, i == 2);
    }
    model_close(model);
}

static void every_component_type_is_read_interleaved(void **state)
{
    static const unsigned types[6] = {5120, 5121, 5122, 5123, 5125, 5126}, sizes[6] = {1, 1, 2, 2, 4, 4};
    (void)state;
    for (int k = 0; k < 6; k++) {
        uint8_t bytes[60] = {0};
        char accessor[128];
        const float one = 1;
        for (unsigned v = 1; v < 3; v++) { /* strides of 20 bytes from byte 4 on; x of vertex 1, y of vertex 2 */
            uint8_t *to = bytes + 4 + 20 * v + (v - 1) * sizes[k];
            *to = 1;
            if (k == 5) {
                memcpy(to, &one, sizeof one);
            }
        }
        snprintf(accessor, sizeof accessor, "\"bufferView\":0,\"byteOffset\":4,\"componentType\":%u,\"count\":3",
                 types[k]);
        assert_triangle(with_accessor(accessor, "{\"buffer\":0,\"byteLength\":60,\"byteStride\":20}", bytes, 60));
    }
}

static void integer_positions_without_their_extension_are_told(void **state)
{
    static const uint8_t bytes[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    (void)state;
    file_bytes("gltf.bin", bytes, sizeof bytes);
    struct model *model = open_good(file_text(
        "whole.gltf", HEAD "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],\"accessors\":[{"
                           "\"bufferView\":0,\"componentType\":5120,\"count\":3,\"type\":\"VEC3\"}],"
                           "\"bufferViews\":[{\"buffer\":0,\"byteLength\":9}],"
                           "\"buffers\":[{\"byteLength\":9,\"uri\":\"gltf.bin\"}]}"));
    assert_string_equal(model->note, "its positions are integers, which takes the extension KHR_mesh_quantization, and "
                                     "it does not name that");
    model_close(model);
}

static void sparse_values_replace_zeros(void **state)
{
    (void)state;
    uint8_t bytes[28] = {1, 2};
    const float one = 1;
    memcpy(bytes + 4, &one, 4);
    memcpy(bytes + 4 + 16, &one, 4);
    static const char accessor[] =
        "\"componentType\":5126,\"count\":3,\"sparse\":{\"count\":2,\"indices\":{\"bufferView\":0,"
        "\"componentType\":5121},\"values\":{\"bufferView\":0,\"byteOffset\":4}}";
    assert_triangle(with_accessor(accessor, "{\"buffer\":0,\"byteLength\":28}", bytes, 28));
    bytes[1] = 3;
    struct model *model;
    char said[1024];
    const char *path = with_accessor(accessor, "{\"buffer\":0,\"byteLength\":28}", bytes, 28);
    assert_int_equal(open_caught(&model, path, said), COMPLAINED);
    assert_non_null(strstr(said, "an index that is not there"));
}

static void assert_file_refused(const char *path, const char *reason)
{
    struct model *model;
    char said[1024];
    assert_int_equal(open_caught(&model, path, said), COMPLAINED);
    if (strstr(said, reason) == NULL) {
        fail_msg("wanted '%s', got: %s", reason, said);
    }
    assert_ptr_equal(strchr(said, '\n'), said + strlen(said) - 1);
}

static void assert_refused(const char *text, const char *reason)
{
    write_triangle();
    assert_file_refused(file_text("wrong.gltf", text), reason);
}

static void what_cannot_be_read_is_refused_in_one_line(void **state)
{
    (void)state;
    assert_refused("{\"asset\":{\"version\":\"2.0\"},\"extensionsRequired\":[\"KHR_draco_mesh_compression\"]}",
                   "it needs the extension KHR_draco_mesh_compression");
    assert_refused(HEAD MESH "\"materials\":[{}]," ACCESSORS "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36},{}],"
                             "\"buffers\":[{\"byteLength\":36}]}",
                   "buffer 0 has 0 bytes of 36");
    assert_refused(HEAD MESH "\"materials\":[{}]," ACCESSORS "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36},{}],"
                             "\"buffers\":[{\"byteLength\":100000000000,\"uri\":\"gltf.bin\"}]}",
                   "buffer 0 has a byteLength of 100000000000, and at most 1073741824 are read");
    assert_refused(HEAD MESH "\"materials\":[{}]," ACCESSORS "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36},{}],"
                             "\"buffers\":[{\"uri\":\"gltf.bin\"}]}",
                   "buffer 0 is missing, or has no length");
    assert_refused(HEAD MESH ACCESSORS BUFFER, "a material that is not there");
    assert_refused("{\"asset\":{\"version\":\"1.0\"}}", "no glTF of version 2");
    assert_refused(HEAD MESH "\"materials\":[{}],\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":"
                             "4000000000,\"type\":\"VEC3\"}]," BUFFER,
                   "a type or count that cannot be");
    assert_refused(HEAD MESH "\"materials\":[{}],\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":6,"
                             "\"type\":\"VEC3\"}]," BUFFER,
                   "not inside bufferView 0");
}

static void a_glb_that_is_cut_off_is_told_by_its_length(void **state)
{
    static const struct {
        size_t n;
        const char *reason;
    } cases[] = {{0, "empty"},
                 {3, "it is 3 bytes long, its header alone 12: it is cut off"},
                 {12, "it is 12 bytes long, its header says 24: it is cut off"},
                 {19, "it is 19 bytes long, its header says 24: it is cut off"},
                 {23, "it is 23 bytes long, its header says 24: it is cut off"},
                 {24, "no glTF of version 2"}};
    static const char glb[25] = "glTF\2\0\0\0\30\0\0\0\4\0\0\0JSON{  }";
    char bytes[24];
    (void)state;
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
        file_bytes("cut.glb", glb, cases[k].n);
        assert_file_refused(file_path("cut.glb"), cases[k].reason);
    }
    memcpy(bytes, glb, sizeof bytes);
    bytes[4] = 1;
    file_bytes("cut.glb", bytes, sizeof bytes);
    assert_file_refused(file_path("cut.glb"), "a GLB of version 1, not 2");
}

/* Two roots of two triangles in all, and one below the second root; a scene that is named must be there. */
static void a_file_without_scenes_shows_its_roots(void **state)
{
    (void)state;
#define WITHOUT(scene)                                                                                                 \
    "{\"asset\":{\"version\":\"2.0\"}," scene                                                                          \
    "\"nodes\":[{\"mesh\":0},{\"translation\":[0,0,5],\"mesh\":0},{\"children\":[1]}]," MESH                           \
    "\"materials\":[{}]," ACCESSORS BUFFER
    write_triangle();
    struct model *model = open_good(file_text("none.gltf", WITHOUT("")));
    assert_int_equal(model->triangle_count, 2);
    model_close(model);
    assert_refused(WITHOUT("\"scene\":0,"), "its scene is not there");
    assert_refused(WITHOUT("\"scenes\":[{}],\"scene\":1,"), "its scene is not there");
}

/* 30 nodes that name the next one twice would be a model of 2^30 parts. */
static void a_node_with_two_parents_is_refused(void **state)
{
    char text[4096] = "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[";
    (void)state;
    for (int i = 1; i < 30; i++) {
        snprintf(text + strlen(text), 64, "{\"children\":[%d,%d]},", i, i);
    }
    strcat(text, "{\"mesh\":0}]," MESH "\"materials\":[{}]," ACCESSORS BUFFER);
    assert_refused(text, "has two parents");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_factor_multiplies_its_texture_in_linear_light),
        cmocka_unit_test(a_mirrored_texture_is_doubled),
        cmocka_unit_test(a_sampler_names_the_filter),
        cmocka_unit_test(a_texture_transform_moves_turns_and_scales),
        cmocka_unit_test(emission_is_in_the_ramp_and_unlit_has_none),
        cmocka_unit_test(a_texture_that_glows_on_black_is_drawn_unlit),
        cmocka_unit_test(a_glow_is_drawn_over_its_surface),
        cmocka_unit_test(a_mask_cuts_out_below_its_cut_off),
        cmocka_unit_test(a_blend_has_the_alpha_of_factor_and_texture),
        cmocka_unit_test(what_a_material_does_not_get_is_said_once),
        cmocka_unit_test(a_texture_that_is_not_there_is_told_by_its_number),
        cmocka_unit_test(vertex_colours_are_multiplied_in_linear_light),
        cmocka_unit_test(every_component_type_is_read_interleaved),
        cmocka_unit_test(integer_positions_without_their_extension_are_told),
        cmocka_unit_test(sparse_values_replace_zeros),
        cmocka_unit_test(what_cannot_be_read_is_refused_in_one_line),
        cmocka_unit_test(a_glb_that_is_cut_off_is_told_by_its_length),
        cmocka_unit_test(a_file_without_scenes_shows_its_roots),
        cmocka_unit_test(a_node_with_two_parents_is_refused),
    };
    return cmocka_run_group_tests(tests, files_begin, files_end);
}
