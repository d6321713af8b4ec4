/* model_ply: the same mesh of text and of both byte orders in every type, and what is refused with its line or byte. */
#include "model_ply.h"
#include "scene_read.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define HEAD   "ply\nformat ascii 1.0\n"
#define XYZ    "property float x\nproperty float y\nproperty float z\n"
#define FACES  "property list uchar int vertex_indices\n"
#define THREE  "0 0 0\n1 0 0\n0 1 0\n"
#define SIMPLE HEAD "element vertex 3\n" XYZ "element face 1\n" FACES "end_header\n" THREE

static struct model_scene *read_text(const char *text)
{
    return scene_read_good(model_ply_read, file_text("a.ply", text));
}

static void refuse(const char *text, const char *reason)
{
    scene_refuse(model_ply_read, file_text("a.ply", text), reason);
}

/* ---- every type, in text and both orders ------------------------------------------------------------------------- */

static const char *const types[8][2] = {{"char", "int8"},     {"uchar", "uint8"},   {"short", "int16"},
                                        {"ushort", "uint16"}, {"int", "int32"},     {"uint", "uint32"},
                                        {"float", "float32"}, {"double", "float64"}};

/* Puts a number of a type into `to`, highest byte first if is_big. Returns its bytes. */
static size_t put(uint8_t *to, int type, int value, bool is_big)
{
    static const size_t sizes[8] = {1, 1, 2, 2, 4, 4, 4, 8};
    const int32_t whole = value;
    const float single = (float)value;
    const double wide = value;
    uint8_t bytes[8];
    memcpy(bytes,
           type == 6   ? (const void *)&single
           : type == 7 ? (const void *)&wide
                       : (const void *)&whole,
           type == 7 ? 8 : 4);
    for (size_t i = 0; i < sizes[type]; i++) {
        to[i] = bytes[is_big ? sizes[type] - 1 - i : i]; /* this machine has the lowest byte first */
    }
    return sizes[type];
}

/* A square with x, y, z, a property that nobody reads, an element between, and a face of a count and indices. */
static size_t make_square(uint8_t *to, int type, int count_type, int index_type, int format)
{
    static const char *const formats[3] = {"ascii", "binary_little_endian", "binary_big_endian"};
    static const int corners[4][2] = {{0, 0}, {100, 0}, {100, 100}, {0, 100}};
    const char *name = types[type][format % 2];
    size_t n =
        (size_t)sprintf((char *)to,
                        "ply\nformat %s 1.0\ncomment x\nelement vertex 4\nproperty %s x\nproperty list uchar short "
                        "odd\nproperty %s y\nproperty %s z\nelement extra 1\nproperty double q\nelement face "
                        "1\nproperty list %s %s vertex_index\nobj_info y\nelement none 1\nend_header\n",
                        formats[format], name, name, name, types[count_type][1], types[index_type][0]);
    for (int i = 0; i < 4; i++) {
        if (format == 0) {
            n += (size_t)sprintf((char *)to + n, "%d 2 7 7 %d 0\n", corners[i][0], corners[i][1]);
            continue;
        }
        n += put(to + n, type, corners[i][0], format == 2);
        n += put(to + n, 1, 2, format == 2);
        n += put(to + n, 2, 7, format == 2);
        n += put(to + n, 2, 7, format == 2);
        n += put(to + n, type, corners[i][1], format == 2);
        n += put(to + n, type, 0, format == 2);
    }
    if (format == 0) {
        return n + (size_t)sprintf((char *)to + n, "1\n4 0 1 2 3\n");
    }
    n += put(to + n, 7, 1, format == 2);
    n += put(to + n, count_type, 4, format == 2);
    for (int i = 0; i < 4; i++) {
        n += put(to + n, index_type, i, format == 2);
    }
    return n;
}

static void every_type_is_read_in_text_and_both_orders(void **state)
{
    uint8_t bytes[1024];
    (void)state;
    for (int i = 0; i < 8 * 6 * 8 * 3; i++) {
        const size_t n = make_square(bytes, i % 8, i / 8 % 6, i / 48 % 8, i / 384);
        const struct model_mesh *mesh = scene_read_good(model_ply_read, file_bytes("a.ply", bytes, n))->meshes;
        assert_int_equal(mesh->vertex_count, 4);
        assert_true(scene_area_z(mesh) == 10000);
        assert_null(mesh->normals);
    }
}

static void what_is_cut_off_is_refused(void **state)
{
    uint8_t bytes[1024];
    (void)state;
    for (int format = 0; format < 3; format++) {
        const size_t n = make_square(bytes, 6, 1, 4, format);
        for (size_t less = format == 0 ? 2 : 1; less <= n; less++) { /* a last line needs no end */
            scene_refuse(model_ply_read, file_bytes("a.ply", bytes, n - less), "is broken");
        }
    }
}

/* ---- properties -------------------------------------------------------------------------------------------------- */

static void normals_colours_and_coordinates_are_read(void **state)
{
    (void)state;
    const struct model_mesh *mesh =
        read_text(HEAD
                  "element vertex 3\n" XYZ "property float nx\nproperty float ny\nproperty float nz\nproperty uchar "
                  "red\nproperty ushort green\nproperty float blue\nproperty float s\nproperty float t\nelement face "
                  "1\n" FACES
                  "end_header\n0 0 0 0 0 2 255 65535 .5 .25 .25\n1 0 0 0 0 2 51 0 0 0 0\n0 1 0 0 0 2 0 0 0 0 "
                  "0\n3 0 1 2\n")
            ->meshes;
    assert_true(mesh->normals[0][2] == 2);
    assert_true(mesh->colours[0][0] == 1 && mesh->colours[0][1] == 1 && mesh->colours[0][2] == .5f);
    assert_true(mesh->colours[1][0] == .2f);
    assert_true(mesh->uvs[0][0] == .25f && mesh->uvs[0][1] == .75f);
}

static void faces_may_have_coordinates_of_their_own(void **state)
{
    (void)state;
    const struct model_mesh *mesh =
        read_text(HEAD "element vertex 3\n" XYZ "element face 2\n" FACES "property list uchar float texcoord\n"
                       "property list uchar float other\nend_header\n" THREE "3 0 1 2 6 .5 0 1 0 1 1 2 9 9\n"
                       "3 0 1 2 6 0 0 1 0 1 1 0\n")
            ->meshes;
    assert_int_equal(mesh->vertex_count, 4);
    assert_true(mesh->uvs[0][0] == .5f && mesh->uvs[2][1] == 0);
}

static void strips_and_polygons_become_triangles(void **state)
{
    (void)state;
    const struct model_mesh *mesh = read_text(HEAD "element vertex 4\n" XYZ "element tristrips 1\n" FACES
                                                   "end_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n8 0 1 2 3 -1 1 3 2\n")
                                        ->meshes;
    assert_int_equal(mesh->triangle_count, 3);
    assert_true(scene_area_z(mesh) == 1.5);
    mesh = read_text(HEAD "element vertex 6\n" XYZ "element face 2\n" FACES
                          "end_header\n0 0 0\n3 0 0\n3 1 0\n1 1 0\n1 3 0\n0 3 0\n6 0 1 2 3 4 5\n2 0 1\n")
               ->meshes;
    assert_int_equal(mesh->triangle_count, 4);
    assert_true(scene_area_z(mesh) == 5);
}

static void a_comment_names_the_texture(void **state)
{
    struct model_shared *shared;
    struct model_scene *scene;
    (void)state;
    assert_true(scene_read(model_ply_read,
                           file_text("a.ply", HEAD "comment TextureFile my picture.png\nelement vertex 3\n" XYZ
                                                   "element face 1\n" FACES "end_header\n" THREE "3 0 1 2\n"),
                           &shared, &scene));
    assert_string_equal(shared->note, "texture my picture.png is left out: it cannot be opened");
}

/* ---- refused ----------------------------------------------------------------------------------------------------- */

static void what_is_broken_is_refused_with_its_line(void **state)
{
    (void)state;
    refuse("plx\n", "line 1: a PLY begins with ply");
    refuse("ply\nformat ascii 1.0\nend_heade\n", "line 3: a word that no header has");
    refuse("ply\nend_header\n0", "a header without a format");
    refuse("ply\nformat ascii2 1.0\nx\n", "line 2: a format that is not known");
    refuse(HEAD "element vertex -1\nx\n", "line 3: an element without");
    refuse(HEAD "element vertex\nx\n", "line 3: an element without");
    refuse(HEAD "element vertex 99999999999999999999\nx\n", "line 3: an element without");
    refuse(HEAD "property float x\nx\n", "line 3: a property without an element");
    refuse(HEAD "element vertex 1\nproperty floa x\nx\n", "line 4: a property without a type");
    refuse(HEAD "element vertex 1\nproperty list float int x\nx\n", "line 4: a list without a type");
    refuse(HEAD "element vertex 3\n" XYZ "element vertex 3\n" XYZ "end_header\n" THREE THREE, "vertices twice");
    refuse(SIMPLE "3 0 1 3\n", "line 13: a face has a vertex that is not there");
    refuse(SIMPLE "3 0 1 -1\n", "line 13: a face has a vertex that is not there");
    refuse(SIMPLE "3 0 1 1.5\n", "line 13: a face has a vertex that is not there");
    refuse(SIMPLE "3 0 1 x\n", "line 13: a number is missing");
    refuse(SIMPLE "3 0 1 2 3\n", "line 13: a line has more numbers");
    refuse(SIMPLE "-1 0 1 2\n", "line 13: a list has a length");
    refuse(SIMPLE "2.5 0 1 2\n", "line 13: a list has a length");
    refuse(SIMPLE "200 0 1 2\n", "line 13: a list has a length");
}

static void counts_that_the_file_cannot_hold_are_refused(void **state)
{
    static const char *const counts[] = {"7", "1000000", "4294967296", "9223372036854775807"};
    (void)state;
    for (int i = 0; i < 8; i++) {
        char text[256];
        snprintf(text, sizeof text,
                 "ply\nformat %s 1.0\nelement %s %s\n" XYZ "end_header\n0 0 0 0 0 0 1 1 1 1 1 1 0 1\n",
                 i % 2 != 0 ? "ascii" : "binary_big_endian", i < 4 ? "vertex" : "other", counts[i % 4]);
        refuse(text, "more elements than the file can hold");
    }
    /* What has no properties takes no bytes and no time. */
    assert_int_equal(read_text("ply\nformat ascii 1.0\nelement other 9223372036854775807\nend_header\n")->mesh_count,
                     0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_type_is_read_in_text_and_both_orders),
        cmocka_unit_test(what_is_cut_off_is_refused),
        cmocka_unit_test(normals_colours_and_coordinates_are_read),
        cmocka_unit_test(faces_may_have_coordinates_of_their_own),
        cmocka_unit_test(strips_and_polygons_become_triangles),
        cmocka_unit_test(a_comment_names_the_texture),
        cmocka_unit_test(what_is_broken_is_refused_with_its_line),
        cmocka_unit_test(counts_that_the_file_cannot_hold_are_refused),
    };
    return cmocka_run_group_tests(tests, files_begin, files_end);
}
