/* --model: each format, what is odd but right, and what is wrong. The files are made here, byte by byte. */
#define _XOPEN_SOURCE 700 /* mkfifo, truncate */

#include "complain.h"
#include "model_files.h"
#include "stderr_capture.h"

#include <png.h>

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <setjmp.h>
#include <cmocka.h>

#define CUBE_SIDE 37837 /* 1 / sqrt(3): where the fitted cube's faces are */
#define ONE_NODE  "[{\"mesh\":0}]"

/* Asserts everything that the renderer takes for granted of a model. */
static void assert_sound(const struct model *model)
{
    uint32_t total = 0;
    assert_true(model->mesh_count > 0);
    for (uint32_t m = 0; m < model->mesh_count; m++) {
        const struct ph_mesh *mesh = &model->meshes[m];
        assert_true(mesh->vertex_count <= MODEL_VERTICES_MAX && mesh->vertex_count <= model->vertex_max);
        for (uint32_t t = 0; t < mesh->triangle_count; t++) {
            for (int i = 0; i < 3; i++) {
                assert_true(mesh->triangles[t][i] < mesh->vertex_count);
            }
        }
        assert_int_equal(mesh->part_count, 1);
        assert_int_equal(mesh->parts->first, 0);
        assert_int_equal(mesh->parts->count, mesh->triangle_count);
        assert_non_null(mesh->materials[mesh->parts->material].ramp);
        total += mesh->triangle_count;
    }
    assert_int_equal(total, model->triangle_count);
}

static double dot_of_face_and_normal(const struct ph_mesh *mesh, uint32_t t)
{
    double p[3][3], n[3] = {0, 0, 0};
    for (int i = 0; i < 3; i++) {
        const struct fx_vec3 *v = &mesh->positions[mesh->triangles[t][i]];
        p[i][0] = v->x / 65536.0;
        p[i][1] = v->y / 65536.0;
        p[i][2] = v->z / 65536.0;
        for (int axis = 0; axis < 3; axis++) {
            n[axis] += mesh->normals[mesh->triangles[t][i]][axis] / 16384.0 / 3;
        }
    }
    double dot = 0, length = 0;
    for (int axis = 0; axis < 3; axis++) {
        const int a = (axis + 1) % 3, b = (axis + 2) % 3;
        const double cross = (p[1][a] - p[0][a]) * (p[2][b] - p[0][b]) - (p[1][b] - p[0][b]) * (p[2][a] - p[0][a]);
        dot += cross * n[axis];
        length += cross * cross;
    }
    return dot / sqrt(length);
}

/*
 * 12 triangles of the fitted cube, looking outwards, with the normals of faces. OBJ and STL keep its edges sharp: 24
 * vertices. PLY and glTF have no normals: flat triangles, 36 vertices.
 */
static void assert_cube(const struct model *model, uint32_t vertices)
{
    assert_sound(model);
    assert_int_equal(model->mesh_count, 1);
    const struct ph_mesh *mesh = model->meshes;
    assert_int_equal(mesh->triangle_count, 12);
    assert_int_equal(mesh->vertex_count, vertices);
    for (uint32_t i = 0; i < vertices; i++) {
        const struct fx_vec3 p = mesh->positions[i];
        assert_true(abs(p.x) == CUBE_SIDE && abs(p.y) == CUBE_SIDE && abs(p.z) == CUBE_SIDE);
        const int16_t *n = mesh->normals[i];
        const double dot = ((double)n[0] * p.x + (double)n[1] * p.y + (double)n[2] * p.z) / 16384 / CUBE_SIDE;
        assert_true(dot == 1);
        assert_true(fabs(sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) - 16384) < 1);
    }
    for (uint32_t t = 0; t < 12; t++) {
        assert_true(dot_of_face_and_normal(mesh, t) > .99);
    }
}

static void open_cube(const char *path, uint32_t vertices)
{
    struct model *model = open_good(path);
    assert_cube(model, vertices);
    model_close(model);
}

static void obj_stl_ply_gltf_and_glb_give_the_same_cube(void **state)
{
    (void)state;
    open_cube(cube_obj(), 24);
    open_cube(cube_stl_text(), 24);
    open_cube(cube_stl_binary(), 24);
    open_cube(cube_ply_text(), 36);
    open_cube(cube_ply_binary(), 36);
    open_cube(cube_gltf(ONE_NODE), 36);
    open_cube(cube_glb(ONE_NODE), 36);
}

static void cube_scaled_and_moved_is_fitted(void **state)
{
    (void)state;
    struct model *model = open_good(cube_gltf("[{\"mesh\":0,\"translation\":[10,-50,7],\"scale\":[0.5,0.5,0.5]}]"));
    assert_cube(model, 36);
    assert_true(fabs(model->scale * .5 * sqrt(3) - 1) < 1e-6); /* half an edge of the cube: 1 in its file, now .5 */
    model_close(model);
}

static void node_transforms_are_applied_in_their_order(void **state)
{
    (void)state;
    /* A child 4 to the right of its parent's own cube, the parent turned a quarter about z: the child is above. */
    struct model *model = open_good(
        cube_glb("[{\"mesh\":0,\"translation\":[5,6,7],\"rotation\":[0,0,0.7071067811865476,0.7071067811865476],"
                 "\"children\":[1]},{\"mesh\":0,\"translation\":[4,0,0]}]"));
    int32_t width = 0, height = 0;
    for (uint32_t i = 0; i < model->meshes->vertex_count; i++) {
        width = abs(model->meshes->positions[i].x) > width ? abs(model->meshes->positions[i].x) : width;
        height = abs(model->meshes->positions[i].y) > height ? abs(model->meshes->positions[i].y) : height;
    }
    assert_sound(model);
    assert_int_equal(model->triangle_count, 24);
    assert_in_range(width, 19759, 19761);  /* 1 / sqrt(1 + 9 + 1) */
    assert_in_range(height, 59279, 59281); /* 3 / sqrt(11) */
    model_close(model);
}

static void mirrored_node_still_looks_outwards(void **state)
{
    (void)state;
    open_cube(cube_gltf("[{\"mesh\":0,\"scale\":[-1,1,1]}]"), 36);
}

static void normals_of_the_file_follow_scaled_and_mirrored_nodes(void **state)
{
    (void)state;
    /* The triangle (1,0,0) (0,1,0) (0,0,1) with the normal (1,1,1) at each corner. */
    static const int places[12] = {0, 4, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17};
    file_ones("slope.bin", places, 12, 72);
    struct model *model = open_good(file_text(
        "slope.gltf",
        "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],"
        "\"nodes\":[{\"mesh\":0,\"scale\":[1,4,-2]}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":1}}]}],"
        "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\","
        "\"min\":[0,0,0],\"max\":[1,1,1]},{\"bufferView\":1,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36},{\"buffer\":0,\"byteOffset\":36,\"byteLength\":36}],"
        "\"buffers\":[{\"byteLength\":72,\"uri\":\"slope.bin\"}]}"));
    assert_sound(model);
    assert_true(dot_of_face_and_normal(model->meshes, 0) > .999);
    model_close(model);
}

static void n_gons_and_negative_indices_are_read(void **state)
{
    (void)state;
    /* A concave pentagon: 3 triangles with its area and no more. */
    struct model *model =
        open_good(file_text("gon.obj", "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 2 1 0\nv 0 4 0\nf -5 -4 -3 -2 -1\n"));
    const struct ph_mesh *mesh = model->meshes;
    double area = 0;
    assert_sound(model);
    assert_int_equal(mesh->triangle_count, 3);
    for (uint32_t t = 0; t < 3; t++) {
        const struct fx_vec3 a = mesh->positions[mesh->triangles[t][0]], b = mesh->positions[mesh->triangles[t][1]],
                             c = mesh->positions[mesh->triangles[t][2]];
        const double twice = ((double)(b.x - a.x) * (c.y - a.y) - (double)(b.y - a.y) * (c.x - a.x)) / 65536 / 65536;
        assert_true(twice > 0);
        area += twice / 2;
    }
    assert_true(fabs(area - 10 / 8.0) < 1e-3); /* 16 - 6, scaled by 1 / sqrt(8) each way */
    model_close(model);
}

static void normals_of_the_file_are_kept(void **state)
{
    (void)state;
    struct model *model =
        open_good(file_text("normal.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 30 40\nf 1//1 2//1 3//1\n"));
    assert_int_equal(model->meshes->normals[0][0], 0);
    assert_int_equal(model->meshes->normals[0][1], 9830); /* .6 */
    assert_int_equal(model->meshes->normals[0][2], 13107);
    model_close(model);
}

static void normals_are_smooth_below_the_crease_angle(void **state)
{
    (void)state;
    /* Two triangles that meet at about 11 degrees share the two vertices of their edge. */
    struct model *model =
        open_good(file_text("smooth.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 -.1\nf 1 2 3\nf 3 2 4\n"));
    assert_int_equal(model->meshes->vertex_count, 4);
    model_close(model);
}

static void a_zero_normal_is_no_fault(void **state)
{
    (void)state;
    struct model *model = open_good(file_text("zero.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 0\nf 1//1 2//1 3//1\n"));
    assert_sound(model);
    model_close(model);
}

static void materials_become_colours(void **state)
{
    (void)state;
    file_text("two.mtl", "newmtl red\nKd 1 0 0\nnewmtl half\nKd 0 .5 2\n");
    struct model *model = open_good(file_text("two.obj", "mtllib two.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\n"
                                                         "usemtl red\nf 1 2 3\nusemtl half\nf 2 4 3\n"));
    assert_sound(model);
    assert_int_equal(model->mesh_count, 2);
    const uint16_t red = ph_rgb565(255, 0, 0), half = ph_rgb565(0, 128, 255);
    const uint16_t first = model->meshes[0].materials->colour, second = model->meshes[1].materials->colour;
    assert_true((first == red && second == half) || (first == half && second == red));
    assert_null(model->note);
    assert_ptr_equal(model->meshes[0].materials->shading, PH_SHADE_GOURAUD);
    model_close(model);
}

static void gltf_colours_are_linear_and_sides_are_read(void **state)
{
    (void)state;
    struct model *model = open_good(cube_gltf(ONE_NODE));
    assert_int_equal(model->meshes->materials->colour, ph_rgb565(255, 0, 128)); /* .2158605 is linear for .5 */
    assert_true(model->meshes->materials->two_sided);
    model_close(model);
}

static void write_png(const char *name);

/* Two triangles of two materials, with vertex colours: red. */
static const char *red_obj(const char *materials)
{
    file_text("red.mtl", materials);
    return file_text("red.obj", "mtllib red.mtl\nv 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 0 1 0 1 0 0\nv 1 1 0 1 0 0\n"
                                "vt 0 0\nvt 1 0\nvt 0 1\nusemtl a\nf 1/1 2/2 3/3\nusemtl b\nf 2/1 4/2 3/3\n");
}

static void what_is_ignored_is_noted_once(void **state)
{
    (void)state;
    write_png("six.png");
    struct model *model = open_good(red_obj("newmtl a\nmap_Kd six.png\nd .5\nnewmtl b\nmap_Kd six.png\nd .5\n"));
    assert_string_equal(model->note, "texture six.png is resized from 3x2 to 4x2; vertex colours of textured meshes "
                                     "that are not opaque are ignored");
    model_close(model);
    model = open_good(cube_obj());
    assert_null(model->note);
    model_close(model);
    model = open_good(cube_gltf(ONE_NODE));
    assert_null(model->note);
    model_close(model);
}

/* d blends, map_d by its grey: the pixels of six.png are seldom black or white; those of a mask are. */
static void opacity_blends_and_a_mask_cuts_out(void **state)
{
    static const uint8_t mask[4] = {255, 0, 0, 255};
    png_image image = {.version = PNG_IMAGE_VERSION, .width = 2, .height = 2, .format = PNG_FORMAT_GRAY};
    (void)state;
    write_png("six.png");
    assert_true(png_image_write_to_file(&image, file_path("mask.png"), 0, mask, 0, NULL));
    struct model *model = open_good(red_obj("newmtl a\nKd 0 1 0\nd .5\nnewmtl b\nKd 1 0 0\nmap_d mask.png\n"));
    assert_null(model->note);
    assert_int_equal(model->mesh_count, 2);
    for (uint32_t m = 0; m < 2; m++) {
        const struct ph_mesh *mesh = &model->meshes[m];
        const struct ph_blend *blend = mesh->materials->blend;
        const bool is_b = mesh->materials->colour == ph_rgb565(255, 0, 0);
        assert_non_null(blend);
        assert_int_equal(mesh->colours == NULL, is_b); /* they are the material's */
        assert_int_equal(blend->kind, is_b ? PH_BLEND_MASK : PH_BLEND_ALPHA);
        assert_int_equal(blend->alphas != NULL, is_b);
        assert_int_equal(blend->alpha, is_b ? 0 : 16);
        if (is_b) {
            const uint16_t all = ph_rgb565(255, 255, 255), expected[4] = {all, 0, 0, all};
            assert_memory_equal(blend->alphas->texels, expected, sizeof expected);
            assert_non_null(mesh->uvs);
        }
    }
    model_close(model);
    model = open_good(red_obj("newmtl a\nd 0\nnewmtl b\nmap_d six.png\n"));
    for (uint32_t m = 0; m < 2; m++) {
        const struct ph_blend *blend = model->meshes[m].materials->blend;
        assert_true(blend == NULL || (blend->kind == PH_BLEND_ALPHA && blend->alpha == 32 && blend->alphas != NULL));
    }
    assert_true((model->meshes[0].materials->blend == NULL) != (model->meshes[1].materials->blend == NULL));
    model_close(model);
}

static const char *cube_of_size(const char *name, const char *unit)
{
    size_t n, k = 0;
    cube_obj();
    uint8_t *cube = file_read("cube.obj", &n);
    char text[2048];
    bool is_vertex = false;
    for (size_t i = 0; i < n && k + 8 < sizeof text; i++) {
        is_vertex = cube[i] == 'v' || (is_vertex && cube[i] != '\n');
        text[k++] = (char)cube[i];
        if (is_vertex && cube[i] == '1') {
            k += (size_t)snprintf(text + k, sizeof text - k, "%s", unit);
        }
    }
    text[k] = '\0';
    free(cube);
    return file_text(name, text);
}

static void a_cube_of_any_size_is_fitted(void **state)
{
    static const char *const units[] = {"e-30", "e-20", "e-9", "e-3", "e3", "e9", "e20", "e30"};
    (void)state;
    for (size_t i = 0; i < sizeof units / sizeof units[0]; i++) {
        open_cube(cube_of_size("sized.obj", units[i]), 24);
    }
    open_cube(cube_gltf("[{\"mesh\":0,\"translation\":[1e-12,0,0],\"scale\":[1e-15,1e-15,1e-15]}]"), 36);
}

static void a_missing_material_file_leaves_a_plain_model(void **state)
{
    (void)state;
    struct model *model =
        open_good(file_text("nomtl.obj", "mtllib nowhere.mtl\nusemtl x\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"));
    assert_sound(model);
    assert_int_not_equal(model->meshes->materials->colour, 0);
    assert_string_equal(model->note, "materials nowhere.mtl cannot be opened");
    model_close(model);
}

/* ---- textures ------------------------------------------------------------------------------------------------ */

static const uint8_t six_pixels[18] = {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255, 0, 0, 0, 255, 255, 0};

static void write_png(const char *name)
{
    png_image image = {.version = PNG_IMAGE_VERSION, .width = 3, .height = 2, .format = PNG_FORMAT_RGB};
    assert_true(png_image_write_to_file(&image, file_path(name), 0, six_pixels, 0, NULL));
}

static const char *textured_obj(const char *picture)
{
    char text[256];
    snprintf(text, sizeof text, "newmtl t\nKd 0 1 0\nmap_Kd %s\n", picture);
    file_text("t.mtl", text);
    return file_text("t.obj",
                     "mtllib t.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 1\nvt 1 1\nvt 0 0\nusemtl t\nf 1/1 2/2 3/3\n");
}

static void png_texture_is_resampled_to_a_power_of_two(void **state)
{
    (void)state;
    write_png("six.png");
    struct model *model = open_good(textured_obj("six.png"));
    const struct ph_mesh *mesh = model->meshes;
    const struct ph_texture *texture = mesh->materials->texture;
    assert_non_null(texture);
    assert_ptr_equal(mesh->materials->shading, PH_SHADE_TEXTURE_GOURAUD);
    assert_int_equal(texture->log2_width, 2);
    assert_int_equal(texture->log2_height, 1);
    assert_string_equal(model->note, "texture six.png is resized from 3x2 to 4x2");
    assert_int_equal(texture->texels[0], ph_rgb565(255, 0, 0));
    assert_int_equal(texture->texels[3], ph_rgb565(0, 0, 255));
    assert_int_equal(texture->texels[4], ph_rgb565(255, 255, 255));
    assert_int_equal(texture->texels[7], ph_rgb565(255, 255, 0));
    for (uint32_t i = 0; i < 3; i++) { /* v = 1 in the file is the top row, v = 0 here */
        assert_int_equal(mesh->uvs[i][1], mesh->positions[i].y > 0 ? FX_ONE : 0);
    }
    model_close(model);
}

static struct model *open_with(const char *path, struct model_options options)
{
    struct model *model;
    assert_int_equal(model_open(&model, path, &options), 0);
    return model;
}

static void up_is_z_of_stl_y_of_others_and_as_it_is_told(void **state)
{
    static const char stl[] = "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 0 3\n"
                              "endloop\nendfacet\nendsolid s\n";
    static const char *const names[2] = {"up.stl", "up.obj"}, *const ups[3] = {NULL, "y", "z"};
    static const bool is_up[2][3] = {{true, false, true}, {false, false, true}}; /* whether (0, 0, 3) is above */
    (void)state;
    file_text("up.stl", stl);
    file_text("up.obj", "v 0 0 0\nv 1 0 0\nv 0 0 3\nf 1 2 3\n");
    for (int k = 0; k < 2; k++) {
        for (int u = 0; u < 3; u++) {
            struct model *model = open_with(file_path(names[k]), (struct model_options){.up = ups[u]});
            fx_t highest = 0, nearest = 0;
            for (uint32_t i = 0; i < 3; i++) {
                const struct fx_vec3 *p = &model->meshes->positions[i];
                highest = p->y > highest ? p->y : highest;
                nearest = p->z > nearest ? p->z : nearest;
            }
            assert_in_range(is_up[k][u] ? highest : nearest, 62000, 62400); /* 3 / sqrt 10 */
            assert_int_equal(is_up[k][u] ? nearest : highest, 0);
            model_close(model);
        }
    }
}

static void a_texture_and_two_sides_are_given_to_all(void **state)
{
    struct model *model;
    char said[1024];
    struct stderr_capture c;
    (void)state;
    write_png("six.png");
    const char *const obj = textured_obj("nowhere.png");
    const struct model_options wrong = {.texture = file_path("none.png")};
    model = open_with(obj, (struct model_options){.texture = file_path("six.png"), .two_sided = true});
    assert_int_equal(model->meshes->materials->texture->texels[0], ph_rgb565(255, 0, 0));
    assert_ptr_equal(model->meshes->materials->shading, PH_SHADE_TEXTURE_GOURAUD);
    assert_true(model->meshes->materials->two_sided);
    model_close(model);
    stderr_capture_begin(&c);
    assert_int_equal(model_open(&model, obj, &wrong), COMPLAINED);
    stderr_capture_end(&c);
    snprintf(said, sizeof said, "%.1000s", c.text);
    assert_non_null(strstr(said, "none.png: it cannot be opened"));
    assert_ptr_equal(strchr(said, '\n'), said + strlen(said) - 1);
}

static void a_texture_that_cannot_be_used_leaves_the_colour_and_a_note(void **state)
{
    static const char *const names[] = {"missing.png", "not.png", "photo.jpg", "half.png"};
    static const char *const reasons[] = {"cannot be opened", "is no PNG, JPEG or WebP picture",
                                          "is a JPEG that cannot be read", "is a PNG that"};
    (void)state;
    file_bytes("half.png", "\x89PNG\r\n\x1a\n", 8);
    file_text("not.png", "this is no picture");
    file_bytes("photo.jpg", "\xff\xd8\xff\xe0", 4);
    for (int i = 0; i < 4; i++) {
        struct model *model = open_good(textured_obj(names[i]));
        assert_non_null(model->note);
        assert_non_null(strstr(model->note, names[i]));
        assert_non_null(strstr(model->note, reasons[i]));
        assert_null(strchr(model->note, '\n'));
        assert_null(model->meshes->materials->texture);
        assert_ptr_equal(model->meshes->materials->shading, PH_SHADE_GOURAUD);
        assert_int_equal(model->meshes->materials->colour, ph_rgb565(0, 255, 0));
        model_close(model);
    }
}

static void a_texture_inside_the_model_file_is_used(void **state)
{
    (void)state;
    size_t n;
    write_png("inside.png");
    uint8_t *png = file_read("inside.png", &n);
    char *text = file_base64(png, n), *gltf = malloc(8192);
    snprintf(
        gltf, 8192,
        "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"TEXCOORD_0\":1},\"material\":0}]}],"
        "\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}}],"
        "\"textures\":[{\"source\":0,\"sampler\":0}],\"samplers\":[{\"wrapS\":33071}],"
        "\"images\":[{\"uri\":\"data:image/png;base64,%s\"}],"
        "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\","
        "\"min\":[0,0,0],\"max\":[1,1,0]},{\"bufferView\":1,\"componentType\":5126,\"count\":3,\"type\":\"VEC2\"}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36},{\"buffer\":0,\"byteOffset\":36,\"byteLength\":24}],"
        "\"buffers\":[{\"byteLength\":60,\"uri\":\"tri.bin\"}]}",
        text);
    /* Positions (0,0,0) (1,0,0) (0,1,0), coordinates (0,0) (1,0) (0,1). */
    static const int places[4] = {3, 7, 11, 14};
    file_ones("tri.bin", places, 4, 60);
    struct model *model = open_good(file_text("inside.gltf", gltf));
    const struct ph_texture *texture = model->meshes->materials->texture;
    assert_non_null(texture);
    assert_int_equal(texture->texels[0], ph_rgb565(255, 0, 0));
    assert_int_equal(texture->wrap, PH_WRAP_CLAMP_U);
    model_close(model);
    free(gltf);
    free(text);
    free(png);
}

/* ---- large and wrong ------------------------------------------------------------------------------------------ */

/* A sheet of side x side quads. */
static const char *sheet_obj(const char *name, int side)
{
    const char *path = file_path(name);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    for (int i = 0; i < (side + 1) * (side + 1); i++) {
        fprintf(file, "v %d %d 0\n", i % (side + 1), i / (side + 1));
    }
    for (int i = 0; i < side * side; i++) {
        const int at = i / side * (side + 1) + i % side + 1;
        fprintf(file, "f %d %d %d %d\n", at, at + 1, at + side + 2, at + side + 1);
    }
    fclose(file);
    return path;
}

static void meshes_are_split_at_65535_vertices(void **state)
{
    (void)state;
    struct model *model = open_good(sheet_obj("sheet.obj", 260)); /* 68121 vertices */
    assert_sound(model);
    assert_true(model->mesh_count >= 2);
    assert_int_equal(model->triangle_count, 2 * 260 * 260);
    model_close(model);
}

/* A flat mesh as PLY, which has no normals: each triangle gets vertices of its own. */
static void flat_meshes_are_split_between_triangles(void **state)
{
    enum { SIDE = 120 }; /* 28800 triangles, 86400 vertices */
    (void)state;
    FILE *file = fopen(file_path("sheet.ply"), "w");
    assert_non_null(file);
    fprintf(file,
            "ply\nformat ascii 1.0\nelement vertex %d\nproperty float x\nproperty float y\nproperty float z\n"
            "element face %d\nproperty list uchar int vertex_indices\nend_header\n",
            (SIDE + 1) * (SIDE + 1), SIDE * SIDE);
    for (int i = 0; i < (SIDE + 1) * (SIDE + 1); i++) {
        fprintf(file, "%d %d 0\n", i % (SIDE + 1), i / (SIDE + 1));
    }
    for (int i = 0; i < SIDE * SIDE; i++) {
        const int at = i / SIDE * (SIDE + 1) + i % SIDE;
        fprintf(file, "4 %d %d %d %d\n", at, at + 1, at + SIDE + 2, at + SIDE + 1);
    }
    fclose(file);
    struct model *model = open_good(file_path("sheet.ply"));
    assert_sound(model);
    assert_int_equal(model->mesh_count, 2);
    assert_int_equal(model->triangle_count, 2 * SIDE * SIDE);
    for (uint32_t t = 0; t < model->meshes[1].triangle_count; t++) {
        assert_true(dot_of_face_and_normal(&model->meshes[1], t) > .99);
    }
    model_close(model);
}

/* Exit 1, one line that names the file and matches. */
static void assert_refused(const char *path, const char *reason)
{
    struct model *model;
    char said[1024];
    assert_int_equal(open_caught(&model, path, said), COMPLAINED);
    assert_null(model);
    assert_non_null(strstr(said, path));
    if (strstr(said, reason) == NULL) {
        fail_msg("wanted '%s', got: %s", reason, said);
    }
    assert_ptr_equal(strchr(said, '\n'), said + strlen(said) - 1);
}

static void what_is_no_file_of_a_model_is_refused(void **state)
{
    (void)state;
    assert_refused(file_path("nowhere.obj"), "No such file");
    assert_refused(file_path("."), "is a directory");
    assert_refused(file_text("empty.obj", ""), "is empty");
    mkfifo(file_path("fifo.obj"), 0600);
    assert_refused(file_path("fifo.obj"), "no regular file");
    assert_refused(file_text("letter.txt", "Dear reader,\nthis is no model.\n"), "is no model that can be read");
    assert_refused(file_text("letter.obj", "Dear reader,\nthis is no model.\n"), "has no triangles");
    assert_refused(file_text("letter.glb", "Dear reader,\nthis is no model.\n"), "no model");
    if (geteuid() != 0) {
        chmod(file_text("locked.obj", "v 0 0 0\n"), 0);
        assert_refused(file_path("locked.obj"), "cannot be read");
    }
}

static void what_has_no_triangles_is_refused(void **state)
{
    (void)state;
    assert_refused(file_text("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\np 1 2 3\n"), "no triangles");
    assert_refused(file_text("lines.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2 3\n"), "no triangles");
    assert_refused(file_text("heap.obj", "v 5 5 5\nv 5 5 5\nv 5 5 5\nf 1 2 3\n"), "one place");
}

static void what_is_broken_is_refused(void **state)
{
    (void)state;
    assert_refused(file_text("nan.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                                        "property float z\nelement face 1\nproperty list uchar int vertex_index\n"
                                        "end_header\nnan 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"),
                   "no numbers");
    assert_refused(file_text("huge.obj", "v 1e39 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), "");
    assert_refused(file_text("index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"), "");
    size_t n;
    cube_ply_binary();
    uint8_t *ply = file_read("cube-binary.ply", &n);
    ply[n - 1] = 1; /* the last index has 2^24 more */
    assert_refused(file_bytes("stray.ply", ply, n), "a vertex that is not there");
    ply[n - 1] = 0;
    assert_refused(file_bytes("head.ply", ply, 100), "a PLY header without its end");
    free(ply);
    cube_glb(ONE_NODE);
    uint8_t *glb = file_read("cube.glb", &n);
    assert_refused(file_bytes("half.glb", glb, n / 2), "no model that can be read");
    free(glb);
}

static void far_away_coordinates_are_fitted(void **state)
{
    (void)state;
    struct model *model = open_good(file_text("far.obj", "v 1e30 0 0\nv -1e30 0 0\nv 0 1e30 0\nf 1 2 3\n"));
    assert_sound(model);
    model_close(model);
}

static void what_is_too_large_is_refused(void **state)
{
    (void)state;
    assert_int_equal(truncate(file_text("long.stl", "x"), (off_t)MODEL_FILE_MAX + 1), 0);
    assert_refused(file_path("long.stl"), "the limit");
    /* A mesh of 200,000 triangles (all in one place, but they are counted before that is looked at), shown 21 times. */
    const size_t n = 36 + 6 * 200000;
    uint8_t *zeros = calloc(n, 1);
    char text[2048], nodes[512] = "[{\"children\":[1";
    for (int i = 2; i <= 21; i++) {
        snprintf(nodes + strlen(nodes), 8, ",%d", i);
    }
    strcat(nodes, "]}");
    for (int i = 1; i <= 21; i++) {
        strcat(nodes, ",{\"mesh\":0}");
    }
    snprintf(
        text, sizeof text,
        "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":%s],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1}]}],"
        "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\","
        "\"min\":[0,0,0],\"max\":[0,0,0]},"
        "{\"bufferView\":1,\"componentType\":5123,\"count\":600000,\"type\":\"SCALAR\"}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36},{\"buffer\":0,\"byteOffset\":36,\"byteLength\":1200000}],"
        "\"buffers\":[{\"byteLength\":1200036,\"uri\":\"zeros.bin\"}]}",
        nodes);
    file_bytes("zeros.bin", zeros, n);
    assert_refused(file_text("many.gltf", text), "more than 4000000 triangles");
    free(zeros);
}

/* ---- files with faults, many of them ---------------------------------------------------------------------------- */

static uint32_t random_state;

static uint32_t random_u32(void)
{
    random_state ^= random_state << 13;
    random_state ^= random_state >> 17;
    return random_state ^= random_state << 5;
}

static void open_faulty(const char *name, const uint8_t *bytes, size_t n)
{
    struct model *model;
    char said[1024];
    const int status = open_caught(&model, file_bytes(name, bytes, n), said);
    if (status == 0) {
        assert_sound(model);
        model_close(model);
        return;
    }
    assert_int_equal(status, COMPLAINED);
    assert_ptr_equal(strchr(said, '\n'), said + strlen(said) - 1);
}

static void fault(const char *path)
{
    const char *name = strrchr(path, '/') + 1;
    size_t n;
    uint8_t *bytes = file_read(name, &n), *copy = malloc(n);
    char faulty[64];
    snprintf(faulty, sizeof faulty, "faulty-%.40s", name);
    for (int i = 0; i < 10; i++) {
        open_faulty(faulty, bytes, 1 + random_u32() % (n - 1));
        memcpy(copy, bytes, n);
        for (int flips = 0; flips < 3; flips++) {
            copy[random_u32() % n] = (uint8_t)random_u32();
        }
        open_faulty(faulty, copy, n);
    }
    free(copy);
    free(bytes);
}

static void faulty_files_give_a_model_or_one_line(void **state)
{
    (void)state;
    random_state = 2463534242u;
    fault(cube_obj());
    fault(cube_stl_text());
    fault(cube_stl_binary());
    fault(cube_ply_text());
    fault(cube_ply_binary());
    fault(cube_gltf(ONE_NODE));
    fault(cube_glb(ONE_NODE));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(obj_stl_ply_gltf_and_glb_give_the_same_cube),
        cmocka_unit_test(cube_scaled_and_moved_is_fitted),
        cmocka_unit_test(node_transforms_are_applied_in_their_order),
        cmocka_unit_test(mirrored_node_still_looks_outwards),
        cmocka_unit_test(normals_of_the_file_follow_scaled_and_mirrored_nodes),
        cmocka_unit_test(n_gons_and_negative_indices_are_read),
        cmocka_unit_test(normals_of_the_file_are_kept),
        cmocka_unit_test(normals_are_smooth_below_the_crease_angle),
        cmocka_unit_test(a_zero_normal_is_no_fault),
        cmocka_unit_test(materials_become_colours),
        cmocka_unit_test(gltf_colours_are_linear_and_sides_are_read),
        cmocka_unit_test(what_is_ignored_is_noted_once),
        cmocka_unit_test(opacity_blends_and_a_mask_cuts_out),
        cmocka_unit_test(a_cube_of_any_size_is_fitted),
        cmocka_unit_test(a_missing_material_file_leaves_a_plain_model),
        cmocka_unit_test(png_texture_is_resampled_to_a_power_of_two),
        cmocka_unit_test(up_is_z_of_stl_y_of_others_and_as_it_is_told),
        cmocka_unit_test(a_texture_and_two_sides_are_given_to_all),
        cmocka_unit_test(a_texture_that_cannot_be_used_leaves_the_colour_and_a_note),
        cmocka_unit_test(a_texture_inside_the_model_file_is_used),
        cmocka_unit_test(meshes_are_split_at_65535_vertices),
        cmocka_unit_test(flat_meshes_are_split_between_triangles),
        cmocka_unit_test(what_is_no_file_of_a_model_is_refused),
        cmocka_unit_test(what_has_no_triangles_is_refused),
        cmocka_unit_test(what_is_broken_is_refused),
        cmocka_unit_test(far_away_coordinates_are_fitted),
        cmocka_unit_test(what_is_too_large_is_refused),
        cmocka_unit_test(faulty_files_give_a_model_or_one_line),
    };
    return cmocka_run_group_tests(tests, files_begin, files_end);
}
