/* asset_write: the numbers in the C file are those of the asset, and each name in it has its array.
 * (test_asset_cli.sh compiles and draws such files.) */
#define _XOPEN_SOURCE 700 /* open_memstream */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "asset_write.h"
#include "c_text.h"
#include "made_asset.h"

#include <stdlib.h>
#include <string.h>

static char *text;

static void write_asset(const struct asset *asset)
{
    size_t n;
    free(text);
    FILE *const file = open_memstream(&text, &n);
    assert_non_null(file);
    asset_write(file, asset);
    fclose(file);
}

static int drop(void **state)
{
    (void)state;
    free(text);
    text = NULL;
    return 0;
}

static void expect_once(const char *part)
{
    const char *const at = strstr(text, part);
    if (at == NULL || strstr(at + 1, part) != NULL) {
        fail_msg("\"%s\" is not there once in:\n%s", part, text);
    }
}

static void expect_none(const char *part)
{
    assert_null(strstr(text, part));
}

/* Colours are in wire order: the first byte of one is its high one. */
static void expect_colours(const char *name, const uint16_t *colours, size_t n)
{
    uint16_t numbers[PH_RAMP_SIZE];
    for (size_t i = 0; i < n; i++) {
        const uint8_t *const bytes = (const uint8_t *)&colours[i];
        numbers[i] = (uint16_t)(bytes[0] * 256 + bytes[1]);
    }
    c_text_expect_u16(text, name, numbers, n);
}

static const char *numbered(const char *name, unsigned number)
{
    static char full[40];
    snprintf(full, sizeof full, "%s_%u", name, number);
    return full;
}

static void arrays_are_those_of_the_meshes(void **state)
{
    (void)state;
    const struct asset *const asset = made_asset(false);
    write_asset(asset);
    for (uint32_t m = 0; m < MADE_MESHES; m++) {
        const struct ph_mesh *const mesh = &asset->model.meshes[m];
        const size_t n = mesh->vertex_count;
        c_text_expect_i32(text, numbered("positions", m), &mesh->positions->x, 3 * n);
        c_text_expect_i16(text, numbered("normals", m), mesh->normals[0], 3 * n);
        c_text_expect_u16(text, numbered("triangles", m), mesh->triangles[0], 3 * (size_t)mesh->triangle_count);
        if (m > 0) {
            c_text_expect_i32(text, numbered("uvs", m), mesh->uvs[0], 2 * n);
        }
        if (m != 1) {
            expect_colours(numbered("ramp", m), mesh->materials->ramp, PH_RAMP_SIZE);
        }
    }
    expect_colours("colours_3", asset->model.meshes[3].colours, 3);
    expect_colours("texture_texels_1", made_material(1)->texture->texels, 21);
    expect_colours("alphas_texels_1", made_blend(1)->alphas->texels, 8);
    static const char *const none[] = {"uvs_0",     "colours_0", "ramp_1[", "texture_texels_2",
                                       "blend_3 =", "alphas_2",  "eye = ",  "animation ="};
    for (size_t i = 0; i < sizeof none / sizeof none[0]; i++) {
        expect_none(none[i]);
    }
}

static void numbers_without_a_literal_are_named(void **state)
{
    (void)state;
    FILE *const file = tmpfile();
    char line[100] = "";
    assert_non_null(file);
    asset_put_vec3(file, (struct fx_vec3){INT32_MIN, INT32_MAX, -2147483647});
    rewind(file);
    assert_non_null(fgets(line, sizeof line, file));
    fclose(file);
    assert_string_equal(line, "{INT32_MIN, 2147483647, -2147483647}");
}

static void materials_name_what_they_share(void **state)
{
    static const char *const shadings[] = {"GOURAUD", "TEXTURE_LIT", "TEXTURE", "UNLIT"};
    (void)state;
    struct asset *const asset = made_asset(false);
    write_asset(asset);
    for (unsigned m = 0; m < MADE_MESHES; m++) {
        char expected[600];
        const uint8_t *const colour = (const uint8_t *)&made_material(m)->colour;
        snprintf(
            expected, sizeof expected,
            "\nstatic const struct ph_material material_%u = {\n    .shading = PH_SHADE_%s,\n    .two_sided = %s,\n"
            "    .shininess_log2 = %u,\n    .depth_bias = %u,\n    .ambient = %u,\n    .diffuse = %u,\n"
            "    .specular = %u,\n    .colour = W(0x%02X%02X),\n    .ramp = ramp_%u,\n%s%s};\n",
            m, shadings[m], m == 3 ? "true" : "false", m + 1, 5 * m, 100 + m, 2000 + m, 30000 + m, colour[0], colour[1],
            m == 1 ? 0 : m, m == 1 || m == 2 ? "    .texture = &texture_1,\n" : "",
            m == 0   ? ""
            : m == 2 ? "    .blend = &blend_2,\n"
                     : "    .blend = &blend_1,\n");
        expect_once(expected);
        expect_once(numbered("static const struct ph_part part", m));
    }
    expect_once("part_1 = {.count = 2};");
    static const struct {
        const struct ph_shading *shading;
        const char *name;
    } others[] = {{PH_SHADE_FLAT, "PH_SHADE_FLAT,"}, {PH_SHADE_TEXTURE_GOURAUD, "PH_SHADE_TEXTURE_GOURAUD,"}};
    for (int i = 0; i < 2; i++) {
        made_material(1)->shading = others[i].shading;
        write_asset(asset);
        expect_once(others[i].name);
    }
}

static void textures_and_blends_are_structs(void **state)
{
    static const struct ph_filter *const named[] = {PH_FILTER_NEAREST, PH_FILTER_BILINEAR, PH_FILTER_MIPMAP};
    static const char *const filters[] = {"NEAREST", "BILINEAR", "MIPMAP"}, *const kinds[] = {NULL, "MASK", "TIMES",
                                                                                              "ALPHA", "ADD"};
    (void)state;
    struct asset *const asset = made_asset(false);
    write_asset(asset);
    expect_once("texture_1 = {.texels = texture_texels_1, .log2_width = 2, .log2_height = 2,\n"
                "    .wrap = PH_WRAP_REPEAT, .filter = PH_FILTER_MIPMAP, .levels = 2};");
    expect_once("alphas_1 = {.texels = alphas_texels_1, .log2_width = 1, .log2_height = 2,\n"
                "    .wrap = PH_WRAP_CLAMP, .filter = PH_FILTER_BILINEAR, .levels = 0};");
    expect_once(
        "blend_1 = {.draw = ph_draw_blended_alphas, .kind = PH_BLEND_ALPHA, .alpha = 20,\n    .alphas = &alphas_1};");
    expect_once("blend_2 = {.draw = ph_draw_blended, .kind = PH_BLEND_ADD, .alpha = 30,\n    };");
    for (int i = 0; i < 3; i++) {
        char part[60];
        ((struct ph_texture *)(uintptr_t)made_blend(1)->alphas)->filter = named[i];
        made_material(1)->texture = NULL;
        made_material(2)->texture = NULL;
        write_asset(asset);
        snprintf(part, sizeof part, "PH_FILTER_%s", filters[i]);
        expect_once(part);
    }
    for (uint8_t kind = PH_BLEND_MASK; kind <= PH_BLEND_ADD; kind++) {
        char part[60];
        made_blend(2)->kind = kind;
        write_asset(asset);
        snprintf(part, sizeof part, "PH_BLEND_%s, .alpha = 30", kinds[kind]);
        expect_once(part);
    }
}

static void meshes_name_their_arrays(void **state)
{
    (void)state;
    write_asset(made_asset(false));
    expect_once("    {.normals = normals_0,\n     .triangles = triangles_0,\n     .parts = &part_0,\n"
                "     .materials = &material_0,\n     .positions = positions_0,\n     .vertex_count = 3,\n"
                "     .triangle_count = 1,\n     .part_count = 1},\n");
    expect_once("     .materials = &material_3,\n     .positions = positions_3,\n     .uvs = uvs_3,\n"
                "     .colours = colours_3,\n     .vertex_count = 3,\n");
    expect_once("     .vertex_count = 5,\n     .triangle_count = 3,");
    expect_once("     .triangle_count = 1,\n     .part_count = 1},\n};\n");
}

static void bounds_are_those_of_the_mesh(void **state)
{
    (void)state;
    struct asset *const asset = made_asset(false);
    const struct ph_sphere bounds = {{7, INT32_MIN, -9}, 65537, PH_CULL_SPHERES};
    asset->model.meshes[2].bounds = &bounds;
    write_asset(asset);
    expect_once("static const struct ph_sphere bounds_2 = {.centre = {7, INT32_MIN, -9}, .radius = 65537, .culling = "
                "PH_CULL_SPHERES};\n");
    expect_once("     .positions = positions_2,\n     .bounds = &bounds_2,\n");
    expect_none("bounds_1");
}

static void a_mesh_that_moves_has_no_positions(void **state)
{
    (void)state;
    write_asset(made_asset(true));
    expect_once("static const struct fx_vec3 positions_1[]");
    expect_none("positions_0");
    expect_none("positions_3");
    expect_once("static const struct animation animation = {");
    expect_once("    return animation_init(context, &animation, meshes, 4, NULL);\n");
    expect_once("    .select = animation_select,\n    .frame = animation_frame,\n");
}

static void a_camera_is_its_matrix_and_lens(void **state)
{
    (void)state;
    struct asset *const asset = made_asset(false);
    asset->model.has_camera = true;
    asset->model.camera = (struct demo_eye){
        .view = {.r = {{1, -2, 3}, {4, 5, 6}, {7, 8, -9}}, .t = {10, -11, 12}},
        .lens = {.kind = PH_ORTHOGRAPHIC, .scale_x_q20 = 13, .scale_y_q20 = 14, .near_z = -15, .far_z = 16}};
    write_asset(asset);
    expect_once("eye = {\n    .view = {.r = {{1, -2, 3}, {4, 5, 6}, {7, 8, -9}}, .t = {10, -11, 12}},\n    .lens = "
                "{.kind = PH_ORTHOGRAPHIC, .scale_x_q20 = 13, .scale_y_q20 = 14, .near_z = -15, .far_z = 16},\n};\n");
    expect_once("    return demo_still_init(context, meshes, 4, &eye);\n");
    expect_once("    .frame = demo_still_frame,\n");
    expect_once("\nstatic int init(struct demo_context *context)\n{\n    return demo_still_init(");
    asset->model.camera.lens.kind = PH_PERSPECTIVE;
    write_asset(asset);
    expect_once("{.kind = PH_PERSPECTIVE,");
    struct asset *const moving = made_asset(true);
    moving->model.has_camera = true;
    write_asset(moving);
    expect_once("    return animation_init(context, &animation, meshes, 4, &eye);\n");
}

static void the_demo_says_what_it_needs(void **state)
{
    (void)state;
    const struct asset *const asset = made_asset(false);
    const struct demo demo = asset_demo(asset);
    char expected[500];
    write_asset(asset);
    expect_once(" * made-by_hand: 7 triangles in 4 meshes, made by pinhole-asset.");
    expect_once("    return demo_turntable_init(context, meshes, 4, (struct fx_vec3){0, 0, 0});\n");
    snprintf(
        expected, sizeof expected,
        "\nconst struct demo demo_scene = {\n    .name = \"made-by_hand\",\n    .summary = \"a model file\",\n"
        "    .loop_frames = 256,\n    .arena_bytes = sizeof(void *) > 4 ? %u : %u,\n    .arena_bytes_32 = %u,\n"
        "    .vertex_max = %u,\n    .triangle_max = 77,\n    .init = init,\n    .frame = demo_turntable_frame,\n};\n",
        (unsigned)demo.arena_bytes, (unsigned)demo.arena_bytes_32, (unsigned)demo.arena_bytes_32,
        (unsigned)demo.vertex_max);
    expect_once(expected);
}

/* Four vertices, six triangles, ten colours a line. */
static void arrays_have_several_lines(void **state)
{
    (void)state;
    write_asset(made_asset(false));
    expect_once("}, {-72030, 2031, 46090},\n    {-72040, 2041, 46120},\n};");
    unsigned lines = 0;
    for (const char *at = strstr(text, "ramp_0[]"); *at != ';'; at++) {
        lines += *at == '\n';
    }
    assert_int_equal(lines, 13 + 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(arrays_are_those_of_the_meshes, drop),
        cmocka_unit_test(numbers_without_a_literal_are_named),
        cmocka_unit_test_teardown(materials_name_what_they_share, drop),
        cmocka_unit_test_teardown(textures_and_blends_are_structs, drop),
        cmocka_unit_test_teardown(meshes_name_their_arrays, drop),
        cmocka_unit_test_teardown(bounds_are_those_of_the_mesh, drop),
        cmocka_unit_test_teardown(a_mesh_that_moves_has_no_positions, drop),
        cmocka_unit_test_teardown(a_camera_is_its_matrix_and_lens, drop),
        cmocka_unit_test_teardown(the_demo_says_what_it_needs, drop),
        cmocka_unit_test_teardown(arrays_have_several_lines, drop),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
