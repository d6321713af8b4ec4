/* model_obj and model_mtl: what each line of an OBJ or MTL file becomes, and what is refused with its line. */
#include "model_obj.h"
#include "scene_read.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#define TRIANGLE "v 0 0 0\nv 1 0 0\nv 0 1 0\n"

static struct model_scene *read_text(const char *text)
{
    return scene_read_good(model_obj_read, file_text("a.obj", text));
}

static void refuse(const char *text, const char *reason)
{
    scene_refuse(model_obj_read, file_text("a.obj", text), reason);
}

static void corners_have_positions_coordinates_and_normals(void **state)
{
    static const float uvs[3][2] = {{.25f, .25f}, {.5f, 1}, {.75f, .5f}};
    (void)state;
    const struct model_scene *scene =
        read_text("# a comment\n" TRIANGLE "vt .25 .75\nvt .5\nvt .75 .5 9\nvn 0 0 2\nvn 3 0 "
                  "0\r\nf 1/1/2 2/2/1 -1/-1/-2 # behind\nf 1/1/2 3/3/1 2/2/1\n");
    const struct model_mesh *mesh = scene->meshes;
    assert_int_equal(scene->mesh_count, 1);
    assert_int_equal(mesh->triangle_count, 2);
    assert_int_equal(mesh->vertex_count, 3);
    assert_null(mesh->colours);
    for (int i = 0; i < 3; i++) {
        assert_true(mesh->uvs[i][0] == uvs[i][0] && mesh->uvs[i][1] == uvs[i][1]);
        assert_true(mesh->normals[i][0] == (i == 0 ? 3 : 0) && mesh->normals[i][2] == (i == 0 ? 0 : 2));
        assert_true(mesh->positions[i][0] == (i == 1) && mesh->positions[i][1] == (i == 2));
        assert_int_equal(mesh->triangles[0][i], i);
        assert_int_equal(mesh->triangles[1][i], (3 - i) % 3);
    }
}

static void a_vertex_may_have_a_weight_or_a_colour(void **state)
{
    (void)state;
    const struct model_mesh *mesh = read_text("v 2 4 6 2\nv 1 0 0 .25 .5 .75\nv 0 1 0\nf 1 2 3\n")->meshes;
    assert_true(mesh->positions[0][0] == 1 && mesh->positions[0][1] == 2 && mesh->positions[0][2] == 3);
    assert_true(mesh->colours[1][0] == .25f && mesh->colours[1][1] == .5f && mesh->colours[1][2] == .75f);
    assert_true(mesh->colours[2][0] == 1);
}

static void a_line_may_go_on_behind_a_backslash(void **state)
{
    (void)state;
    assert_int_equal(read_text(TRIANGLE "v 1 \\\n1 0\\\n\nf 1 2\\\r\n 4 \\\n3\n")->meshes->triangle_count, 2);
}

static void corners_without_normals_get_smooth_ones(void **state)
{
    (void)state;
    const struct model_mesh *mesh = read_text(TRIANGLE "v 1 1 -.1\nvn 1 0 0\nf 1//1 2 3\nf 3 2 4\n")->meshes;
    assert_int_equal(mesh->vertex_count, 4);
    assert_true(mesh->normals[0][0] == 1 && mesh->normals[1][2] > 0);
}

/* A square of two triangles beside a slope of one: the square counts once where it is one face, twice where it is two.
 */
static void a_face_counts_once_for_normals(void **state)
{
    static const char *const faces[2] = {"f 1 2 3 4\nf 2 5 3\n", "f 2 3 4\nf 2 4 1\nf 2 5 3\n"};
    (void)state;
    for (int i = 0; i < 2; i++) {
        char text[256];
        snprintf(text, sizeof text, "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 .75\n%s", faces[i]);
        const struct model_mesh *mesh = read_text(text)->meshes;
        uint32_t at = 0;
        while (mesh->positions[at][0] != 1 || mesh->positions[at][1] != 0) {
            at++;
        }
        /* (0, 0, 1) and (-.6, 0, .8) */
        assert_true(fabsf(mesh->normals[at][0] / mesh->normals[at][2] - (i == 0 ? -.6f / 1.8f : -.6f / 2.8f)) < 1e-5f);
    }
}

static void polygons_keep_their_area(void **state)
{
    (void)state;
    /* an L of 5 squares, whose inner corner lies in the fan of the first */
    const struct model_mesh *mesh =
        read_text("v 0 0 0\nv 3 0 0\nv 3 1 0\nv 1 1 0\nv 1 3 0\nv 0 3 0\nf 2 3 4 5 6 1\n")->meshes;
    assert_int_equal(mesh->triangle_count, 4);
    assert_true(scene_area_z(mesh) == 5);
    for (uint32_t t = 0; t < 4; t++) {
        struct model_mesh one = *mesh;
        one.triangles += t;
        one.triangle_count = 1;
        assert_true(scene_area_z(&one) > 0);
    }
}

static void meshes_begin_with_materials_objects_and_groups(void **state)
{
    static const uint32_t materials[6] = {0, 1, 1, 2, 1, 1};
    (void)state;
    const struct model_scene *scene = read_text(
        TRIANGLE "g x\ng x\nf 1 2 3\nusemtl a\nusemtl b\nusemtl a\nf 1 2 3\nf 1 2 3\nusemtl a\ng y\ng y\nf 1 2 "
                 "3\nusemtl b\nf 1 2 3\nusemtl a\nf 1 2 3\no z\nf 1 2 3\ng y\nf 1 2 3\nl 1 2\np 1\nf 1 2\n");
    assert_int_equal(scene->mesh_count, 6);
    for (int i = 0; i < 6; i++) {
        assert_int_equal(scene->meshes[i].material, materials[i]);
        assert_int_equal(scene->meshes[i].triangle_count, i == 1 || i == 5 ? 2 : 1);
    }
    assert_int_equal(scene->nodes->mesh_count, 6);
    assert_int_equal(scene->material_count, 3);
}

static void mtl_gives_colours_and_opacity(void **state)
{
    (void)state;
    file_text("a.mtl",
              "Kd 1 1 1\nnewmtl one\nKd 1 0 .5\nKe 0 .25 0\nd .5\nnewmtl two  \nKd .5\nTr .25\n# x\nnewmtl three\n"
              "d -halo 0\nKd spectral x\n");
    const struct model_scene *scene =
        read_text("mtllib a.mtl\n" TRIANGLE "usemtl three\nf 1 2 3\nusemtl two\nf 1 2 3\nusemtl one\nf 1 2 3\n");
    const struct model_material *m = scene->materials;
    assert_int_equal(scene->material_count, 4);
    assert_int_equal(scene->meshes[0].material, 3);
    assert_int_equal(scene->meshes[2].material, 1);
    assert_int_equal(m[1].surface.colour, ph_rgb565(255, 0, 128));
    assert_int_equal(m[1].surface.blend->alpha, 16);
    assert_int_equal(m[2].surface.colour, ph_rgb565(128, 128, 128));
    assert_int_equal(m[2].surface.blend->alpha, 24);
    assert_int_equal(m[3].surface.colour, ph_rgb565(153, 153, 153));
    assert_null(m[3].surface.blend);
    const struct model_mesh *mesh =
        read_text("mtllib a.mtl\nusemtl one\n" TRIANGLE "vt .5 .25\nf 1/1 2/1 3/1\n")->meshes;
    assert_true(mesh->uvs[0][0] == .5f && mesh->uvs[0][1] == .75f);
}

/* A bitmap that no reader knows: what matters is where it was looked for. */
static void pictures_are_looked_for_beside_the_mtl_then_beside_the_obj(void **state)
{
    struct model_shared *shared;
    struct model_scene *scene;
    (void)state;
    mkdir(file_path("sub"), 0700);
    file_text("sub/own.png", "x");
    file_text("own.png", "y");
    file_text("top.png", "z");
    file_text("sub/b.mtl",
              "newmtl a\nmap_Kd -clamp on -s 2 2 1 own.png\nnewmtl b\nmap_Kd top.png\nnewmtl c\nmap_Kd no.png\n");
    const char *const path = file_text("a.obj", "mtllib sub/b.mtl\n" TRIANGLE "f 1 2 3\n");
    assert_true(scene_read(model_obj_read, path, &shared, &scene));
    assert_non_null(strstr(shared->note, "own.png is left out: it is no PNG"));
    assert_non_null(strstr(shared->note, "top.png is left out: it is no PNG"));
    assert_non_null(strstr(shared->note, "no.png is left out: it cannot be opened"));
    assert_int_equal(remove(file_path("own.png")), 0); /* the one beside the MTL is found */
    assert_true(scene_read(model_obj_read, path, &shared, &scene));
    assert_non_null(strstr(shared->note, "own.png is left out: it is no PNG"));
}

static void options_of_a_map_move_its_coordinates(void **state)
{
    (void)state;
    file_text("o.mtl", "newmtl a\nmap_Kd -blendu on -o .5 .25 -s 2 4 1 -mm 0 1 no such.png\n");
    struct model_shared *shared;
    struct model_scene *scene;
    assert_true(scene_read(model_obj_read,
                           file_text("a.obj", "mtllib o.mtl\nusemtl a\n" TRIANGLE "vt 0 0\nvt 1 1\nf 1/1 2/2 3/2\n"),
                           &shared, &scene));
    assert_string_equal(shared->note, "texture no such.png is left out: it cannot be opened");
    assert_true(scene->meshes->uvs[0][0] == .5f && scene->meshes->uvs[0][1] == .75f);
    assert_true(scene->meshes->uvs[1][0] == 2.5f && scene->meshes->uvs[1][1] == -3.25f);
}

static void what_is_broken_is_refused_with_its_line(void **state)
{
    (void)state;
    refuse("v 0 0\n", "line 1: a vertex needs 3 numbers and has 2");
    refuse("\n\nv 0 0x1 0\n", "line 3: a vertex needs 3");
    refuse("\\\nv\\\n 0\n", "line 3: a vertex needs 3");
    refuse("vt x\n", "line 1: a texture coordinate without");
    refuse("vn 1 2\n", "line 1: a normal needs 3 numbers and has 2");
    refuse(TRIANGLE "f 1 2 x\n", "line 4: x is no corner");
    refuse(TRIANGLE "f 1 2 0\n", "line 4: 0 is no corner");
    refuse(TRIANGLE "f 1 2 -4\n", "line 4: -4 is no corner");
    refuse(TRIANGLE "f 1 2 3x\n", "line 4: 3x is no corner");
    refuse(TRIANGLE "f 1 2 3/1/1/1\n", "line 4: 3/1/1/1 is no corner");
    refuse(TRIANGLE "f 1 2 99999999999999999999\n", "is no corner");
    refuse(TRIANGLE "f 1 2 4\n", "line 4: a face has a vertex that is not there");
    refuse(TRIANGLE "f 1/1 2/1 3/1\n", "line 4: a face has a vertex that is not there");
    refuse(TRIANGLE "f 1//1 2//1 3//1\n", "line 4: a face has a vertex that is not there");
}

static void what_lies_behind_the_last_line_is_not_read(void **state)
{
    (void)state;
    assert_int_equal(read_text(TRIANGLE "f 1/ 2// 3")->meshes->triangle_count, 1);
    assert_int_equal(read_text("\n")->mesh_count, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(corners_have_positions_coordinates_and_normals),
        cmocka_unit_test(a_vertex_may_have_a_weight_or_a_colour),
        cmocka_unit_test(a_line_may_go_on_behind_a_backslash),
        cmocka_unit_test(corners_without_normals_get_smooth_ones),
        cmocka_unit_test(a_face_counts_once_for_normals),
        cmocka_unit_test(polygons_keep_their_area),
        cmocka_unit_test(meshes_begin_with_materials_objects_and_groups),
        cmocka_unit_test(mtl_gives_colours_and_opacity),
        cmocka_unit_test(pictures_are_looked_for_beside_the_mtl_then_beside_the_obj),
        cmocka_unit_test(options_of_a_map_move_its_coordinates),
        cmocka_unit_test(what_is_broken_is_refused_with_its_line),
        cmocka_unit_test(what_lies_behind_the_last_line_is_not_read),
    };
    return cmocka_run_group_tests(tests, files_begin, files_end);
}
