/*
 * gltf_file: numbers of accessors as the specification of glTF 2.0 has them (3.6.2.2, and 3.11 for normalized integers:
 * c / 127 and c / 32767, at least -1; c / 255 and c / 65535), views, chunks of a GLB, and URIs.
 */
#include "gltf_file.h"
#include "model_files.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define HEAD "{\"asset\":{\"version\":\"2.0\"}"

static struct gltf_file file;
static struct model_folder folder;

static void open_file(const char *path)
{
    folder = (struct model_folder){.model = path};
    if (!gltf_file_open(&file, &folder)) {
        fail_msg("%s", file.error);
    }
}

static void open_text(const char *text)
{
    open_file(file_text("test.gltf", text));
}

/* A file with 32 bytes in base64, one view of them from byte 4 on, and an accessor. */
static void open_accessor(const char *accessor, const char *view, const uint8_t bytes[32])
{
    char text[1024];
    char *data = file_base64(bytes, 32);
    snprintf(text, sizeof text,
             HEAD ",\"accessors\":[{%s}],\"bufferViews\":[{\"buffer\":0,\"byteOffset\":4%s}],\"buffers\":["
                  "{\"byteLength\":32,\"uri\":\"data:application/octet-stream;base64,%s\"}]}",
             accessor, view, data);
    free(data);
    open_text(text);
}

static float *numbers_of(const char *accessor, const char *view, const uint8_t bytes[32], unsigned components,
                         uint32_t *count)
{
    open_accessor(accessor, view, bytes);
    return gltf_file_numbers(&file, 0, components, count);
}

static void integers_are_numbers_and_normalized_ones_are_shares(void **state)
{
    static const struct {
        unsigned type;
        uint8_t bytes[8]; /* two numbers, least significant byte first */
        float plain[2], shares[2];
    } cases[] = {
        {5120, {0x81, 0x7F}, {-127, 127}, {-1, 1}},
        {5120, {0x80, 0x40}, {-128, 64}, {-1, 64 / 127.f}}, /* -128 / 127 is clamped */
        {5120, {0xC0, 0x01}, {-64, 1}, {-64 / 127.f, 1 / 127.f}},
        {5121, {0xFF, 0x80}, {255, 128}, {1, 128 / 255.f}},
        {5122, {0x01, 0x80, 0xFF, 0x7F}, {-32767, 32767}, {-1, 1}},
        {5122, {0x00, 0x80, 0x00, 0x40}, {-32768, 16384}, {-1, 16384 / 32767.f}},
        {5122, {0x00, 0xC0, 0x01, 0x00}, {-16384, 1}, {-16384 / 32767.f, 1 / 32767.f}},
        {5123, {0xFF, 0xFF, 0x00, 0x80}, {65535, 32768}, {1, 32768 / 65535.f}},
        {5125, {0x00, 0x00, 0x01, 0x01, 0x00, 0x00, 0x00, 0x80}, {16842752, 2147483648.f}, {16842752, 2147483648.f}},
        {5126, {0x00, 0x00, 0x80, 0x3F, 0x00, 0x00, 0x20, 0xC1}, {1, -10}, {1, -10}},
    };
    (void)state;
    for (size_t i = 0; i < 2 * sizeof cases / sizeof cases[0]; i++) {
        const bool normalized = i % 2 == 1;
        uint8_t bytes[32] = {0};
        char accessor[128];
        uint32_t count = 0;
        memcpy(bytes + 4, cases[i / 2].bytes, 8);
        snprintf(accessor, sizeof accessor, "\"bufferView\":0,\"componentType\":%u,\"count\":1,\"type\":\"VEC2\"%s",
                 cases[i / 2].type, normalized ? ",\"normalized\":true" : "");
        float *numbers = numbers_of(accessor, ",\"byteLength\":28", bytes, 2, &count);
        assert_non_null(numbers);
        assert_int_equal(count, 1);
        const float *expected = normalized ? cases[i / 2].shares : cases[i / 2].plain;
        assert_true(numbers[0] == expected[0] && numbers[1] == expected[1]);
        free(numbers);
    }
}

static void strides_and_offsets_are_counted_from_the_view(void **state)
{
    uint8_t bytes[32];
    uint32_t count = 0;
    (void)state;
    for (unsigned i = 0; i < 32; i++) {
        bytes[i] = (uint8_t)i;
    }
    static const char bytes_of_two[] =
        "\"bufferView\":0,\"byteOffset\":2,\"componentType\":5121,\"count\":3,\"type\":\"VEC2\"";
    float *numbers = numbers_of(bytes_of_two, ",\"byteLength\":28,\"byteStride\":8", bytes, 2, &count);
    static const float strided[6] = {6, 7, 14, 15, 22, 23}, packed[6] = {6, 7, 8, 9, 10, 11};
    assert_non_null(numbers);
    assert_int_equal(count, 3);
    assert_memory_equal(numbers, strided, sizeof strided);
    numbers = numbers_of(bytes_of_two, ",\"byteLength\":8", bytes, 2, &count); /* to its last byte */
    assert_non_null(numbers);
    assert_memory_equal(numbers, packed, sizeof packed);
    assert_null(numbers_of(bytes_of_two, ",\"byteLength\":7", bytes, 2, &count));
    assert_non_null(strstr(file.error, "not inside bufferView 0"));
    assert_non_null(numbers_of(bytes_of_two, ",\"byteLength\":28,\"byteStride\":12", bytes, 2, &count));
    assert_null(numbers_of(bytes_of_two, ",\"byteLength\":27,\"byteStride\":12", bytes, 2, &count));
    assert_null(numbers_of(bytes_of_two, ",\"byteLength\":28,\"byteStride\":1", bytes, 2, &count));
    assert_null(numbers_of(bytes_of_two, ",\"byteLength\":29", bytes, 2, &count)); /* 4 + 29 bytes of 32 */
    assert_null(numbers_of(bytes_of_two, ",\"byteLength\":28", bytes, 3, &count));
    assert_non_null(strstr(file.error, "has not the 3 components"));
    assert_null(numbers_of(bytes_of_two, ",\"byteLength\":28", bytes, 1, &count));
    static const char one[] = "\"bufferView\":0,\"byteOffset\":2,\"componentType\":5121,\"count\":1,\"type\":\"VEC2\"";
    assert_non_null(numbers_of(one, ",\"byteLength\":4", bytes, 2, &count));
    assert_null(numbers_of(one, ",\"byteLength\":3", bytes, 2, &count));
}

static void sparse_numbers_are_put_into_their_places(void **state)
{
    uint8_t bytes[32] = {0, 0, 0, 0, 10, 11, 12, 13, 2, 0, 0, 0, 77};
    uint32_t count = 0;
    (void)state;
    static const char form[] = "\"bufferView\":0,\"componentType\":5121,\"count\":%d,\"type\":\"SCALAR\",\"sparse\":{"
                               "\"count\":1,\"indices\":{\"bufferView\":0,\"byteOffset\":4,\"componentType\":5123},"
                               "\"values\":{\"bufferView\":0,\"byteOffset\":8}}";
    char accessor[512];
    snprintf(accessor, sizeof accessor, form, 4);
    float *numbers = numbers_of(accessor, ",\"byteLength\":28", bytes, 1, &count);
    static const float expected[4] = {10, 11, 77, 13};
    assert_non_null(numbers);
    assert_memory_equal(numbers, expected, sizeof expected);
    snprintf(accessor, sizeof accessor, form, 2); /* index 2 is not there */
    assert_null(numbers_of(accessor, ",\"byteLength\":28", bytes, 1, &count));
    assert_non_null(strstr(file.error, "an index that is not there"));
}

static void indices_are_whole_numbers_of_one_component(void **state)
{
    static const uint8_t bytes[32] = {0, 0, 0, 0, 1, 2, 255, 255, 4};
    static const struct {
        const char *type;
        uint32_t expected[2];
    } cases[] = {{"5121", {1, 2}}, {"5123", {0x201, 0xFFFF}}, {"5125", {0xFFFF0201, 4}}};
    uint32_t count = 0;
    char accessor[128];
    (void)state;
    for (size_t i = 0; i < 3; i++) {
        snprintf(accessor, sizeof accessor, "\"bufferView\":0,\"componentType\":%s,\"count\":2,\"type\":\"SCALAR\"",
                 cases[i].type);
        open_accessor(accessor, ",\"byteLength\":28", bytes);
        uint32_t *indices = gltf_file_indices(&file, 0, &count);
        assert_non_null(indices);
        assert_int_equal(count, 2);
        assert_memory_equal(indices, cases[i].expected, 8);
        free(indices);
    }
    open_accessor("\"bufferView\":0,\"componentType\":5126,\"count\":2,\"type\":\"SCALAR\"", ",\"byteLength\":28",
                  bytes);
    assert_null(gltf_file_indices(&file, 0, &count));
    open_accessor("\"bufferView\":0,\"componentType\":5121,\"count\":2,\"type\":\"VEC2\"", ",\"byteLength\":28", bytes);
    assert_null(gltf_file_indices(&file, 0, &count));
    assert_null(gltf_file_indices(&file, 1, &count));
}

static void members_of_another_kind_are_not_taken(void **state)
{
    double v[3] = {7, 7, 7};
    (void)state;
    open_text(HEAD ",\"a\":3,\"b\":3.5,\"c\":-1,\"d\":\"3\",\"e\":4294967295,\"f\":4294967294,\"v\":[1,2.5,\"x\"],"
                   "\"extensionsUsed\":[\"A\",5,\"KHR_lights_punctual\"],\"nodes\":[{},{\"a\":9}]}");
    const struct gltf_json *json = file.json;
    assert_int_equal(gltf_file_whole(json, "a", 9), 3);
    assert_int_equal(gltf_file_whole(json, "z", 9), 9);
    assert_int_equal(gltf_file_whole(json, "b", 9), GLTF_NONE);
    assert_int_equal(gltf_file_whole(json, "c", 9), GLTF_NONE);
    assert_int_equal(gltf_file_whole(json, "d", 9), GLTF_NONE);
    assert_int_equal(gltf_file_whole(json, "e", 9), GLTF_NONE);
    assert_int_equal(gltf_file_whole(json, "f", 9), 4294967294);
    assert_true(gltf_file_number(json, "b", 9) == 3.5 && gltf_file_number(json, "d", 9) == 9);
    assert_true(gltf_file_vector(json, "v", 3, v));
    assert_true(v[0] == 1 && v[1] == 2.5 && v[2] == 0);
    v[0] = 7;
    assert_false(gltf_file_vector(json, "v", 2, v));
    assert_false(gltf_file_vector(json, "a", 1, v));
    assert_true(v[0] == 7);
    assert_true(gltf_file_uses(&file, "KHR_lights_punctual"));
    assert_false(gltf_file_uses(&file, "KHR"));
    assert_int_equal(gltf_file_whole(gltf_file_item(&file, GLTF_NODES, 1), "a", 0), 9);
    assert_null(gltf_file_item(&file, GLTF_NODES, 2));
    assert_null(gltf_file_item(&file, GLTF_MESHES, 0));
}

/* RFC 4648, section 10, and RFC 3986, 2.1. */
static void uris_are_data_or_files(void **state)
{
    static const struct {
        const char *uri, *bytes;
    } data[] = {{"data:;base64,", ""},
                {"data:;base64,Zg==", "f"},
                {"data:text/plain;base64,Zm8=", "fo"},
                {"data:;base64,Zm9v", "foo"},
                {"data:;base64,Zm9vYmE=", "fooba"},
                {"data:;base64,Pz8/Pj4+", "?\?\?>>>"},
                {"a%20b%2E%62in", "in a file"},
                {"a%20b.bin", "in a file"},
                {"%6A.b%69n", "j"},
                {"half%2", "half"}};
    static const char *const wrong[] = {"data:;base64,Zm9v-", "data:,foo", "none.bin"};
    (void)state;
    open_text(HEAD "}");
    file_text("a b.bin", "in a file");
    file_text("half%2", "half");
    file_text("j.bin", "j");
    for (size_t i = 0; i < sizeof data / sizeof data[0]; i++) {
        const struct gltf_span bytes = gltf_file_uri(&file, data[i].uri);
        assert_non_null(bytes.bytes);
        assert_int_equal(bytes.n, strlen(data[i].bytes));
        assert_memory_equal(bytes.bytes, data[i].bytes, bytes.n);
    }
    assert_string_equal(file.error, "");
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        file.error[0] = '\0';
        assert_null(gltf_file_uri(&file, wrong[i]).bytes);
        assert_true(file.error[0] != '\0');
    }
}

static void the_first_error_is_kept(void **state)
{
    (void)state;
    open_text(HEAD ",\"bufferViews\":[{\"buffer\":0,\"byteLength\":3}],\"buffers\":[{\"byteLength\":4,\"uri\":"
                   "\"data:;base64,Zm9v\"}]}");
    assert_null(gltf_file_view(&file, 0).bytes);
    assert_string_equal(file.error, "buffer 0 has 3 bytes of 4");
    assert_false(gltf_file_failed(&file, "another"));
    assert_string_equal(file.error, "buffer 0 has 3 bytes of 4");
}

/* The binary chunk of a GLB is buffer 0 where that has no URI. */
static void a_glb_has_its_bytes_behind_its_json(void **state)
{
    static const char json[] = HEAD ",\"bufferViews\":[{\"buffer\":0,\"byteOffset\":1,\"byteLength\":2}],\"buffers\":["
                                    "{\"byteLength\":3}]}   ";
    uint8_t glb[256] = "glTF\2\0\0\0";
    const uint32_t n = (uint32_t)(sizeof json - 1) / 4 * 4, all = 12 + 8 + n + 8 + 4;
    (void)state;
    memcpy(glb + 8, &all, 4); /* as on this machine, of little endian */
    memcpy(glb + 12, &n, 4);
    memcpy(glb + 16, "JSON", 4);
    memcpy(glb + 20, json, n);
    memcpy(glb + 20 + n, "\4\0\0\0BIN\0abcd", 12);
    open_file(file_bytes("test.glb", glb, all));
    const struct gltf_span view = gltf_file_view(&file, 0);
    assert_int_equal(view.n, 2);
    assert_memory_equal(view.bytes, "bc", 2);
    assert_int_equal(file.glb.n, 4);
    assert_null(gltf_file_view(&file, 1).bytes);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(integers_are_numbers_and_normalized_ones_are_shares),
        cmocka_unit_test(strides_and_offsets_are_counted_from_the_view),
        cmocka_unit_test(sparse_numbers_are_put_into_their_places),
        cmocka_unit_test(indices_are_whole_numbers_of_one_component),
        cmocka_unit_test(members_of_another_kind_are_not_taken),
        cmocka_unit_test(uris_are_data_or_files),
        cmocka_unit_test(the_first_error_is_kept),
        cmocka_unit_test(a_glb_has_its_bytes_behind_its_json),
    };
    return cmocka_run_group_tests(tests, files_begin, files_end);
}
