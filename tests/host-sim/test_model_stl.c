/* model_stl: text and binary, counts that lie, colours, and what is refused with its line or byte. */
#include "model_stl.h"
#include "scene_read.h"

#include <stdlib.h>
#include <string.h>

#define FACET "facet normal 9 9 9\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"

static struct model_scene *read_text(const char *text)
{
    return scene_read_good(model_stl_read, file_text("a.stl", text));
}

static void refuse(const char *text, const char *reason)
{
    scene_refuse(model_stl_read, file_text("a.stl", text), reason);
}

static void text_is_read_whatever_its_case_and_lines(void **state)
{
    static const char *const texts[] = {"solid a b c\n" FACET "endsolid a b c\n",
                                        "\r\n  SOLID\r\nFacet Normal 0 0 1\r\n  Outer Loop\r\n\tVERTEX 0 0 "
                                        "0\r\n\r\nvertex 1 0 0\r\nvertex 0 1 0 \r\nEndLoop\r\n"
                                        "EndFacet\r\nEndSolid",
                                        "solid\n" FACET "endsolid\nsolid facet\nendsolid\n"};
    (void)state;
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        const struct model_mesh *mesh = read_text(texts[i])->meshes;
        assert_int_equal(mesh->triangle_count, 1);
        assert_int_equal(mesh->vertex_count, 3);
        assert_true(scene_area_z(mesh) == .5);
        assert_true(mesh->normals[0][0] == 0 && mesh->normals[0][2] == 1); /* not the file's */
        assert_null(mesh->colours);
        assert_null(mesh->uvs);
    }
    assert_int_equal(read_text("solid a\n" FACET FACET "endsolid\n")->meshes->vertex_count, 3);
}

static void text_that_is_broken_is_refused_with_its_line(void **state)
{
    (void)state;
    refuse("solid\nfacet\nvertex 1 2\n", "line 3: a corner needs 3 numbers");
    refuse("solid\nfacet\nvertex 1 2 x\n", "line 3: a corner needs 3 numbers");
    refuse("solid\nfacet\nvertex 0 0 0\nvertex 1 0 0\nendfacet\n", "line 5: a facet has less than 3");
    refuse("solid\nfacet\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 0 0\nvertex 1 0 0\n", "line 6: a facet has more than 3");
    refuse("solid\nfacet\nvertex 0 0 0\nfacet\n", "line 4: a facet without its endfacet");
    refuse("solid\nfacet\nvertex 0 0 0\n", "a facet has less than 3");
    refuse("solid\n" FACET "vertex 0 0 0\n", "line 9: a word that is no facet");
}

/* A binary file of n facets, with room for more bytes. */
static uint8_t *make_binary(uint32_t said, uint32_t n, const char *head, uint16_t attribute)
{
    uint8_t *bytes = calloc(84 + 50 * (size_t)n + 50, 1);
    memcpy(bytes, head, strlen(head));
    memcpy(bytes + 80, &said, 4); /* this machine has the byte order of the file */
    for (uint32_t i = 0; i < n; i++) {
        const float corners[12] = {0, 0, 0, (float)i, 0, 0, (float)i + 1, 0, 0, (float)i, 1, 0};
        memcpy(bytes + 84 + 50 * (size_t)i, corners, sizeof corners);
        memcpy(bytes + 84 + 50 * (size_t)i + 48, &attribute, sizeof attribute);
    }
    return bytes;
}

static struct model_scene *read_binary(uint32_t said, uint32_t n, const char *head, uint16_t attribute, size_t more)
{
    uint8_t *bytes = make_binary(said, n, head, attribute);
    const char *path = file_bytes("b.stl", bytes, 84 + 50 * (size_t)n + more);
    free(bytes);
    return scene_read_good(model_stl_read, path);
}

static void a_count_that_is_smaller_or_0_is_read(void **state)
{
    (void)state;
    assert_int_equal(read_binary(3, 3, "", 0, 0)->meshes->triangle_count, 3);
    assert_int_equal(read_binary(3, 3, "solid", 0, 0)->meshes->triangle_count, 3);
    assert_int_equal(read_binary(2, 3, "solid", 0, 0)->meshes->triangle_count, 2);
    assert_int_equal(read_binary(0, 3, "", 0, 0)->meshes->triangle_count, 3);
    assert_int_equal(read_binary(0, 3, "", 0, 49)->meshes->triangle_count, 3);
    assert_int_equal(read_binary(0, 0, "", 0, 0)->mesh_count, 0);
    assert_true(scene_area_z(read_binary(3, 3, "", 0, 0)->meshes) == 1.5);
}

static void a_count_that_the_file_cannot_hold_is_refused(void **state)
{
    static const uint32_t counts[] = {4, 0x01000000, 0x7fffffff, 0xffffffff};
    (void)state;
    for (size_t i = 0; i < sizeof counts / sizeof counts[0]; i++) {
        uint8_t *bytes = make_binary(counts[i], 3, "", 0);
        scene_refuse(model_stl_read, file_bytes("b.stl", bytes, 84 + 150 + 49), "at byte 80: its ");
        free(bytes);
    }
    scene_refuse(model_stl_read, file_bytes("b.stl", "\1\2\3", 3), "at least 84 bytes");
}

static void facets_have_colours_of_15_bits(void **state)
{
    (void)state;
    const float(*blue_first)[3] = (const float(*)[3])read_binary(3, 3, "", 0x8000 | 31 << 10 | 5, 0)->meshes->colours;
    assert_true(blue_first[0][0] == 1 && blue_first[0][1] == 0 && blue_first[0][2] == 5.f / 31);
    const float(*red_first)[3] =
        (const float(*)[3])read_binary(3, 3, "a COLOR=abcd", 0x8000 | 31 << 10 | 5, 0)->meshes->colours;
    assert_true(red_first[0][2] == 1 && red_first[0][1] == 0 && red_first[0][0] == 5.f / 31);
    assert_null(read_binary(3, 3, "COLOR=abcd", 31, 0)->meshes->colours);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(text_is_read_whatever_its_case_and_lines),
        cmocka_unit_test(text_that_is_broken_is_refused_with_its_line),
        cmocka_unit_test(a_count_that_is_smaller_or_0_is_read),
        cmocka_unit_test(a_count_that_the_file_cannot_hold_is_refused),
        cmocka_unit_test(facets_have_colours_of_15_bits),
    };
    return cmocka_run_group_tests(tests, files_begin, files_end);
}
