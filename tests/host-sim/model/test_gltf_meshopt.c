/*
 * gltf_meshopt: what libmeshoptimizer's encoder packed comes back; filters against the equations of
 * EXT_meshopt_compression, by floating point; a glTF file's views; and what cannot be is refused.
 */
#include "gltf_meshopt.h"

#include "gltf_file.h"
#include "model_files.h"
#include "ref_random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <meshoptimizer.h> /* tests/run.sh skips this program where the library is not installed */

#include <cmocka.h>

enum { COUNT = 300, MOST = 16384 };

static uint8_t packed[MOST], bytes[MOST];
static size_t packed_n;

static const char *unpack(uint32_t count, uint32_t stride, enum gltf_meshopt_mode mode, enum gltf_meshopt_filter filter)
{
    const struct gltf_meshopt_view view = {count, stride, mode, filter};
    memset(bytes, 0xA5, sizeof bytes);
    return gltf_meshopt_unpack(&view, packed, packed_n, bytes);
}

static void pack(const void *from, uint32_t count, uint32_t stride)
{
    packed_n = meshopt_encodeVertexBuffer(packed, sizeof packed, from, count, stride);
    assert_true(packed_n > 0);
}

static void attributes_of_each_stride_come_back(void **state)
{
    (void)state;
    static uint8_t from[COUNT * 32];
    ref_seed(1);
    for (size_t i = 0; i < sizeof from; i++) {
        from[i] = (uint8_t)ref_uniform(0, 256);
    }
    for (uint32_t stride = 4; stride <= 32; stride += 4) {
        pack(from, COUNT, stride);
        assert_null(unpack(COUNT, stride, GLTF_MESHOPT_ATTRIBUTES, GLTF_MESHOPT_NONE));
        assert_memory_equal(bytes, from, (size_t)COUNT * stride);
    }
}

/* Index i, of 2 or 4 bytes. */
static uint32_t index_at(size_t i, uint32_t stride)
{
    uint32_t index = 0;
    memcpy(&index, bytes + i * stride, stride);
    return index;
}

/* Triangles may begin with another of their corners. */
static void indices_of_two_and_four_bytes_come_back(void **state)
{
    (void)state;
    static unsigned from[3 * COUNT];
    for (unsigned i = 0; i < 3 * COUNT; i++) {
        from[i] = i / 3 + i % 3; /* a strip */
    }
    for (uint32_t stride = 2; stride <= 4; stride += 2) {
        packed_n = meshopt_encodeIndexSequence(packed, sizeof packed, from, 3 * COUNT);
        assert_null(unpack(3 * COUNT, stride, GLTF_MESHOPT_INDICES, GLTF_MESHOPT_NONE));
        for (size_t i = 0; i < 3 * COUNT; i++) {
            assert_int_equal(index_at(i, stride), from[i]);
        }
        packed_n = meshopt_encodeIndexBuffer(packed, sizeof packed, from, 3 * COUNT);
        assert_null(unpack(3 * COUNT, stride, GLTF_MESHOPT_TRIANGLES, GLTF_MESHOPT_NONE));
        for (size_t i = 0; i < 3 * COUNT; i++) {
            const size_t first = i / 3 * 3, turn = index_at(first, stride) - from[first];
            assert_true(turn < 3);
            assert_int_equal(index_at(i, stride), from[first + (i + turn) % 3]);
        }
    }
}

/* A direction is the point of an octahedron |x| + |y| + |z| = 1 above or below it, whose lower half is folded out. */
static void octahedral_normals_are_directions(void **state)
{
    (void)state;
    int8_t from[COUNT][4];
    ref_seed(2);
    for (int i = 0; i < COUNT; i++) {
        from[i][0] = (int8_t)ref_uniform(-127, 128);
        from[i][1] = (int8_t)ref_uniform(-127, 128);
        from[i][2] = 127;
        from[i][3] = (int8_t)i;
    }
    pack(from, COUNT, 4);
    assert_null(unpack(COUNT, 4, GLTF_MESHOPT_ATTRIBUTES, GLTF_MESHOPT_OCTAHEDRAL));
    for (int i = 0; i < COUNT; i++) {
        const double u = from[i][0] / 127.0, v = from[i][1] / 127.0, z = 1 - fabs(u) - fabs(v);
        const double x = z >= 0 ? u : copysign(1 - fabs(v), u), y = z >= 0 ? v : copysign(1 - fabs(u), v);
        const double expected[3] = {x, y, z}, length = sqrt(x * x + y * y + z * z);
        const int8_t *got = (const int8_t *)bytes + (size_t)4 * i;
        for (int c = 0; c < 3; c++) {
            assert_true(fabs(got[c] - 127 * expected[c] / length) <= .52); /* a square root of 12 bits */
        }
        assert_int_equal(got[3], (int8_t)i);
    }
}

/* The three smaller components, and which one the fourth is, in the lowest two bits. */
static void quaternions_have_length_one(void **state)
{
    (void)state;
    int16_t from[COUNT][4];
    ref_seed(3);
    for (int i = 0; i < COUNT; i++) {
        for (int c = 0; c < 3; c++) {
            from[i][c] = (int16_t)ref_uniform(-1100, 1100);
        }
        from[i][3] = (int16_t)(2044 | (i & 3));
    }
    pack(from, COUNT, 8);
    assert_null(unpack(COUNT, 8, GLTF_MESHOPT_ATTRIBUTES, GLTF_MESHOPT_QUATERNION));
    for (int i = 0; i < COUNT; i++) {
        double rest = 1;
        int16_t got[4];
        memcpy(got, bytes + (size_t)8 * i, sizeof got);
        for (int c = 0; c < 3; c++) {
            const double expected = from[i][c] / 2047.0 / sqrt(2);
            assert_true(fabs(got[(i + 1 + c) & 3] - 32767 * expected) <= .51);
            rest -= expected * expected;
        }
        assert_true(fabs(got[i & 3] - 32767 * sqrt(rest > 0 ? rest : 0)) <= .51);
    }
}

static void exponents_scale_whole_numbers(void **state)
{
    (void)state;
    int32_t from[COUNT][3];
    ref_seed(4);
    for (int i = 0; i < COUNT; i++) {
        for (int c = 0; c < 3; c++) {
            from[i][c] = (int32_t)((uint32_t)(i % 60 - 30) << 24 | ((uint32_t)ref_uniform(0, 1 << 24) & 0xFFFFFF));
        }
    }
    pack(from, COUNT, 12);
    assert_null(unpack(COUNT, 12, GLTF_MESHOPT_ATTRIBUTES, GLTF_MESHOPT_EXPONENTIAL));
    for (int i = 0; i < COUNT; i++) {
        for (int c = 0; c < 3; c++) {
            float got;
            memcpy(&got, bytes + (size_t)12 * i + (size_t)4 * c, sizeof got);
            const int32_t low = from[i][c] & 0xFFFFFF;
            assert_true(got == ldexpf((float)(low < 1 << 23 ? low : low - (1 << 24)), i % 60 - 30));
        }
    }
}

static void what_cannot_be_is_refused(void **state)
{
    (void)state;
    static const struct gltf_meshopt_view wrong[] = {
        {COUNT, 0, GLTF_MESHOPT_ATTRIBUTES, GLTF_MESHOPT_NONE},
        {COUNT, 6, GLTF_MESHOPT_ATTRIBUTES, GLTF_MESHOPT_NONE},
        {COUNT, 260, GLTF_MESHOPT_ATTRIBUTES, GLTF_MESHOPT_NONE},
        {COUNT, 12, GLTF_MESHOPT_ATTRIBUTES, GLTF_MESHOPT_OCTAHEDRAL},
        {COUNT, 4, GLTF_MESHOPT_ATTRIBUTES, GLTF_MESHOPT_QUATERNION},
        {COUNT, 1, GLTF_MESHOPT_INDICES, GLTF_MESHOPT_NONE},
        {COUNT, 4, GLTF_MESHOPT_INDICES, GLTF_MESHOPT_EXPONENTIAL},
        {COUNT + 1, 4, GLTF_MESHOPT_TRIANGLES, GLTF_MESHOPT_NONE},
    };
    const uint8_t from[4 * COUNT] = {0};
    pack(from, COUNT, 4);
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        assert_string_equal(gltf_meshopt_unpack(&wrong[i], packed, packed_n, bytes),
                            "is compressed with a stride, count or filter that cannot be");
    }
    assert_non_null(unpack(COUNT, 8, GLTF_MESHOPT_ATTRIBUTES, GLTF_MESHOPT_NONE));
    packed_n--;
    assert_string_equal(unpack(COUNT, 4, GLTF_MESHOPT_ATTRIBUTES, GLTF_MESHOPT_NONE),
                        "is compressed, and broken, or packed in a newer way than the libmeshoptimizer here reads");
}

/* Opens a glTF file of one packed view, and reads 3 floats of each of the elements of its accessor. */
static float *read_view(struct gltf_file *file, const char *said, uint32_t *count)
{
    static struct model_folder folder;
    char text[4096], *data = file_base64(packed, packed_n);
    snprintf(text, sizeof text,
             "{\"asset\":{\"version\":\"2.0\"},\"extensionsRequired\":[\"EXT_meshopt_compression\"],"
             "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"}],"
             "\"bufferViews\":[{\"buffer\":1,\"byteLength\":48,\"byteStride\":12,\"extensions\":{"
             "\"EXT_meshopt_compression\":{\"buffer\":0,\"byteLength\":%zu,%s}}}],"
             "\"buffers\":[{\"byteLength\":%zu,\"uri\":\"data:;base64,%s\"},"
             "{\"byteLength\":48,\"extensions\":{\"EXT_meshopt_compression\":{\"fallback\":true}}}]}",
             packed_n, said, packed_n, data);
    free(data);
    folder = (struct model_folder){.model = file_text("packed.gltf", text)};
    assert_true(gltf_file_open(file, &folder));
    return gltf_file_numbers(file, 0, 3, count);
}

static void a_view_of_a_file_is_unpacked_once(void **state)
{
    (void)state;
    const float from[4][3] = {{1, 2, 3}, {-1.5F, 0, 1e6F}, {0, 0, 0}, {4, 5, 6}};
    struct gltf_file file;
    uint32_t count = 0;
    pack(from, 4, 12);
    float *got = read_view(&file, "\"byteStride\":12,\"count\":4,\"mode\":\"ATTRIBUTES\"", &count);
    assert_non_null(got);
    assert_int_equal(count, 4);
    assert_memory_equal(got, from, sizeof from);
    assert_ptr_equal(gltf_file_view(&file, 0).bytes, gltf_file_view(&file, 0).bytes);
    assert_int_equal(gltf_file_view(&file, 0).n, 48);
    free(got);
}

static void views_that_cannot_be_are_refused_in_one_line(void **state)
{
    static const struct {
        const char *said, *error;
    } cases[] = {
        {"\"byteStride\":12,\"count\":4,\"mode\":\"TEXT\"", "bufferView 0 is compressed in a way that is not known"},
        {"\"byteStride\":12,\"count\":4,\"filter\":\"COLOR\"", "bufferView 0 is compressed in a way that is not known"},
        {"\"byteStride\":12,\"count\":4,\"filter\":4", "bufferView 0 is compressed in a way that is not known"},
        {"\"byteStride\":12", "bufferView 0 is too large"},
        {"\"byteStride\":256,\"count\":4194305", "bufferView 0 is too large"},
        {"\"byteStride\":12,\"count\":3", "an accessor is not inside bufferView 0"},
        {"\"byteStride\":12,\"count\":4,\"byteOffset\":1", "bufferView 0 is not inside a buffer"},
    };
    (void)state;
    const float from[4][3] = {{1, 2, 3}};
    pack(from, 4, 12);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct gltf_file file;
        uint32_t count = 0;
        assert_null(read_view(&file, cases[i].said, &count));
        assert_string_equal(file.error, cases[i].error);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(attributes_of_each_stride_come_back),
        cmocka_unit_test(indices_of_two_and_four_bytes_come_back),
        cmocka_unit_test(octahedral_normals_are_directions),
        cmocka_unit_test(quaternions_have_length_one),
        cmocka_unit_test(exponents_scale_whole_numbers),
        cmocka_unit_test(what_cannot_be_is_refused),
        cmocka_unit_test(a_view_of_a_file_is_unpacked_once),
        cmocka_unit_test(views_that_cannot_be_are_refused_in_one_line),
    };
    return cmocka_run_group_tests(tests, files_begin, files_end);
}
