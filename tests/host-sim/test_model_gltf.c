/* glTF: generated files, one feature each, with the colour or place that is expected. */
#include "complain.h"
#include "model_files.h"

#include <assimp/cimport.h> /* tests/run.sh skips this program where a library is not installed */
#include <cjson/cJSON.h>
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
    assert_int_equal(model->meshes->materials->shading, PH_SHADE_GOURAUD);
    model_close(model);
    model = with_material("\"pbrMetallicRoughness\":{\"baseColorFactor\":[0,1,0,1]},"
                          "\"extensions\":{\"KHR_materials_unlit\":{}}",
                          "none.png", "");
    assert_int_equal(model->meshes->materials->shading, PH_SHADE_UNLIT);
    assert_int_equal(model->meshes->materials->colour, ph_rgb565(0, 255, 0));
    model_close(model);
}

/* A mesh with a position accessor, a buffer of n bytes and what else is given. */
static const char *with_accessor(const char *accessor, const char *views, const void *bytes, size_t n)
{
    char text[2048];
    file_bytes("gltf.bin", bytes, n);
    snprintf(text, sizeof text,
             HEAD "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],\"accessors\":[{%s,\"type\":"
                  "\"VEC3\"}],\"bufferViews\":[%s],\"buffers\":[{\"byteLength\":%u,\"uri\":\"gltf.bin\"}]}",
             accessor, views, (unsigned)n);
    return file_text("accessor.gltf", text);
}

/* The right triangle, fitted: its long side is the diameter of the sphere, so the others are sqrt(2) long. */
static void assert_triangle(const char *path)
{
    struct model *model = open_good(path);
    const struct ph_mesh *mesh = model->meshes;
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

static void assert_refused(const char *text, const char *reason)
{
    struct model *model;
    char said[1024];
    write_triangle();
    assert_int_equal(open_caught(&model, file_text("wrong.gltf", text), said), COMPLAINED);
    if (strstr(said, reason) == NULL) {
        fail_msg("wanted '%s', got: %s", reason, said);
    }
    assert_ptr_equal(strchr(said, '\n'), said + strlen(said) - 1);
}

static void what_cannot_be_read_is_refused_in_one_line(void **state)
{
    (void)state;
    assert_refused("{\"asset\":{\"version\":\"2.0\"},\"extensionsRequired\":[\"EXT_meshopt_compression\"]}",
                   "it needs the extension EXT_meshopt_compression");
    assert_refused(HEAD MESH "\"materials\":[{}]," ACCESSORS "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36},{}],"
                             "\"buffers\":[{\"byteLength\":36}]}",
                   "buffer 0 has 0 bytes of 36"); /* the fallback buffer of a file with meshopt has no bytes */
    assert_refused(HEAD MESH ACCESSORS BUFFER, "a material that is not there");
    assert_refused("{\"asset\":{\"version\":\"1.0\"}}", "no glTF of version 2");
    assert_refused(HEAD MESH "\"materials\":[{}],\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":"
                             "4000000000,\"type\":\"VEC3\"}]," BUFFER,
                   "a type or count that cannot be");
    assert_refused(HEAD MESH "\"materials\":[{}],\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":6,"
                             "\"type\":\"VEC3\"}]," BUFFER,
                   "not inside bufferView 0");
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
        cmocka_unit_test(a_texture_transform_moves_turns_and_scales),
        cmocka_unit_test(emission_is_in_the_ramp_and_unlit_has_none),
        cmocka_unit_test(every_component_type_is_read_interleaved),
        cmocka_unit_test(sparse_values_replace_zeros),
        cmocka_unit_test(what_cannot_be_read_is_refused_in_one_line),
        cmocka_unit_test(a_node_with_two_parents_is_refused),
    };
    return cmocka_run_group_tests(tests, files_begin, files_end);
}
