/* What beginners do wrong is told: by a status, by ph_check_mesh or by ph_why_empty. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "render.h"

#include <string.h>

enum { SIDE = 64, LINES = 16, VERTICES = 16, TRIANGLES = 16 };

/* A lit triangle with all that a mesh can have; it is right. */
struct scene {
    uint64_t memory[PH_MEMORY(SIDE, LINES, VERTICES, TRIANGLES)];
    struct fx_vec3 positions[3];
    int16_t normals[3][3];
    fx_t uvs[3][2];
    uint16_t triangles[1][3], texels[64], ramp[PH_RAMP_SIZE];
    struct ph_part part;
    struct ph_material material;
    struct ph_texture texture;
    struct ph_blend blend;
    struct ph_mesh mesh;
    struct ph_xform view, place;
    struct ph_projection lens;
    struct ph_scene_light light;
    struct ph_config config;
    struct ph_renderer r;
    uint32_t seen;                     /* pixels that are not black */
    uint32_t left, right, top, bottom; /* of these; ends are exclusive */
    bool does_not_begin;
};

static int count_seen(void *context, uint32_t x, uint32_t y, uint32_t width, uint32_t height, const void *pixels)
{
    struct scene *const s = context;
    for (uint32_t i = 0; i < width * height; i++) {
        const uint32_t column = x + i % width, row = y + i / width;
        if (((const uint16_t *)pixels)[i] != 0) {
            s->left = s->seen == 0 || column < s->left ? column : s->left;
            s->right = s->seen == 0 || column >= s->right ? column + 1 : s->right;
            s->top = s->seen == 0 ? row : s->top;
            s->bottom = row + 1;
            s->seen++;
        }
    }
    return 0;
}

static void make_scene(struct scene *s)
{
    static const struct fx_vec3 corners[3] = {{-FX_ONE, -FX_ONE, 0}, {FX_ONE, -FX_ONE, 0}, {0, FX_ONE, 0}};
    *s = (struct scene){.triangles = {{0, 1, 2}}, .part = {.count = 1}};
    for (int i = 0; i < 3; i++) {
        s->positions[i] = corners[i];
        s->normals[i][2] = 16384;
        s->uvs[i][0] = corners[i].x;
        s->uvs[i][1] = corners[i].y;
    }
    memset(s->texels, 0xff, sizeof s->texels);
    ph_material_ramp(s->ramp, 255, 160, 0, 0);
    s->texture = (struct ph_texture){.texels = s->texels, .log2_width = 3, .log2_height = 3};
    s->blend = (struct ph_blend){.draw = ph_draw_blended, .kind = PH_BLEND_ALPHA, .alpha = 16};
    s->material = (struct ph_material){.shading = PH_SHADE_GOURAUD,
                                       .ambient = FX_ONE / 4,
                                       .diffuse = FX_ONE,
                                       .colour = 0xffff,
                                       .ramp = s->ramp,
                                       .texture = &s->texture};
    s->mesh = (struct ph_mesh){.positions = s->positions,
                               .normals = (const int16_t(*)[3])s->normals,
                               .uvs = (const fx_t(*)[2])s->uvs,
                               .triangles = (const uint16_t(*)[3])s->triangles,
                               .parts = &s->part,
                               .materials = &s->material,
                               .vertex_count = 3,
                               .triangle_count = 1,
                               .part_count = 1,
                               .material_count = 1};
    s->view = ph_xform_translate(0, 0, FX_INT(-3));
    s->place = ph_xform_identity;
    assert_int_equal(ph_projection_perspective(&s->lens, FX_INT(45), FX_ONE, FX_HALF, FX_INT(10)), PH_OK);
    s->light = (struct ph_scene_light){
        .ambient = FX_ONE, .count = 1, .lights = {{.intensity = FX_ONE, .to_light_q30 = {0, 0, FX_Q30_ONE}}}};
    s->config = (struct ph_config){.width = SIDE,
                                   .height = SIDE,
                                   .band_height = LINES,
                                   .depth_format = PH_DEPTH_FIXED16,
                                   .vertex_max = VERTICES,
                                   .triangle_max = TRIANGLES};
}

/* Draws it as one does who looks at no status but that of the draw, which it returns. */
static int draw(struct scene *s)
{
    struct ph_config c = s->config;
    (void)ph_config_memory(&c, s->memory, sizeof s->memory);
    (void)ph_renderer_init(&s->r, &c);
    if (!s->does_not_begin) {
        (void)ph_frame_begin(&s->r, &s->view, &s->lens, &s->light, 0);
    }
    s->seen = 0;
    const int status = ph_draw_mesh(&s->r, &s->mesh, &s->place);
    (void)ph_show(&s->r, count_seen, s);
    return status;
}

static void what_is_right_is_seen_and_nothing_is_said(void **state)
{
    struct scene s;
    (void)state;
    make_scene(&s);
    assert_int_equal(draw(&s), PH_OK);
    assert_true(s.seen > 1000);
    assert_null(ph_check_mesh(&s.mesh).what);
    assert_null(ph_why_empty(&s.r));
    s.material.shading = PH_SHADE_TEXTURE_GOURAUD;
    s.material.blend = &s.blend;
    assert_int_equal(draw(&s), PH_OK);
    assert_true(s.seen > 1000);
    assert_null(ph_check_mesh(&s.mesh).what);
}

/* ---- meshes ----------------------------------------------------------------------------------------------------- */

static struct scene wrong;

static void small_positions(struct scene *s)
{
    for (int i = 0; i < 3; i++) {
        s->positions[i] = (struct fx_vec3){s->positions[i].x / FX_ONE, s->positions[i].y / FX_ONE, 0};
    }
}

static void small_uvs(struct scene *s)
{
    for (int i = 0; i < 3; i++) {
        s->uvs[i][0] /= FX_ONE;
        s->uvs[i][1] /= FX_ONE;
    }
}

/* A row: a mistake, the status of ph_draw_mesh, and what is said: words and a number. The scene is `wrong`. */
#define MISTAKE(name, lines, status, words, at)                                                                        \
    static void name(void **state)                                                                                     \
    {                                                                                                                  \
        struct scene *const s = &wrong;                                                                                \
        (void)state;                                                                                                   \
        make_scene(s);                                                                                                 \
        lines;                                                                                                         \
        assert_int_equal(draw(s), status);                                                                             \
        const struct ph_finding found = ph_check_mesh(&s->mesh);                                                       \
        assert_non_null(found.what);                                                                                   \
        assert_non_null(strstr(found.what, words));                                                                    \
        assert_int_equal(found.number, at);                                                                            \
    }

#define SWAP(a, b) (s->triangles[0][1] = (b), s->triangles[0][2] = (a))

MISTAKE(no_vertices, s->mesh.vertex_count = 0, PH_ERR_INVAL, "vertex_count", 0)
MISTAKE(no_positions, s->mesh.positions = NULL, PH_ERR_INVAL, "positions are NULL", 0)
MISTAKE(no_triangles, s->mesh.triangles = NULL, PH_ERR_INVAL, "triangles are NULL", 0)
MISTAKE(no_triangle_count, s->mesh.triangle_count = 0, PH_ERR_INVAL, "triangle_count", 0)
MISTAKE(no_parts, s->mesh.part_count = 0, PH_OK, "no parts", 0)
MISTAKE(no_materials, s->mesh.materials = NULL, PH_ERR_INVAL, "materials are NULL", 0)
MISTAKE(an_index_too_large, s->triangles[0][2] = 3, PH_ERR_INVAL, "triangle names a vertex", 0)
MISTAKE(a_part_of_nothing, s->part.count = 0, PH_OK, "part has no triangles", 0)
MISTAKE(a_part_too_long, s->part.count = 2, PH_ERR_INVAL, "part names triangles", 0)
MISTAKE(a_material_too_far, s->part.material = 1, PH_ERR_INVAL, "part names a material", 0)
MISTAKE(edges_of_none, s->material.shading = PH_SHADE_WIRE, PH_OK, "drawn as edges", 0)
MISTAKE(clockwise, SWAP(1, 2), PH_OK, "face away", 0)
MISTAKE(sizes_as_integers, small_positions(s), PH_OK, "positions lie within", 0)
MISTAKE(uvs_as_integers, small_uvs(s), PH_OK, "uvs lie within", 0)
MISTAKE(normals_as_integers, s->normals[1][2] = 1, PH_OK, "no unit vector", 1)
MISTAKE(light_without_normals, s->mesh.normals = NULL, PH_OK, "no normals", 0)
MISTAKE(shares_as_integers, s->material.ambient = s->material.diffuse = 1, PH_OK, "reflects no light", 0)
MISTAKE(a_share_too_large, s->material.diffuse = FX_INT(2), PH_OK, "not 0 .. FX_ONE", 0)
MISTAKE(shininess_as_a_number, s->material.shininess_log2 = 32, PH_OK, "shininess_log2", 0)
#define TEXTURED s->material.shading = PH_SHADE_TEXTURE
MISTAKE(no_texture, (TEXTURED, s->material.texture = NULL), PH_OK, "takes a texture", 0)
MISTAKE(no_uvs, (TEXTURED, s->mesh.uvs = NULL), PH_OK, "no uvs", 0)
MISTAKE(no_texels, (TEXTURED, s->texture.texels = NULL), PH_ERR_INVAL, "without texels", 0)
MISTAKE(a_side_as_texels, (TEXTURED, s->texture.log2_width = 64), PH_ERR_INVAL, "side above 1024", 0)
#define BLENDED s->material.blend = &s->blend
MISTAKE(a_blend_by_nothing, (BLENDED, s->blend.draw = NULL), PH_OK, "without `draw`", 0)
MISTAKE(alpha_zero, (BLENDED, s->blend.alpha = 0), PH_OK, "alpha is not", 0)
MISTAKE(alpha_of_255, (BLENDED, s->blend.alpha = 255), PH_OK, "alpha is not", 0)
MISTAKE(alphas_of_a_colour, (BLENDED, s->blend.alphas = &s->texture), PH_OK, "ph_draw_blended_alphas", 0)

/* A tetrahedron without normals: of the two windings one encloses a negative volume. */
static void a_body_inside_out_is_seen_without_normals(void **state)
{
    static const struct fx_vec3 corners[] = {{0, 0, 0}, {FX_ONE, 0, 0}, {0, FX_ONE, 0}, {0, 0, FX_ONE}};
    static const uint16_t out[][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}},
                          in[][3] = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
    static const struct ph_part part = {.count = 4};
    struct ph_material material = {.colour = 1};
    struct ph_mesh mesh = {.positions = corners,
                           .triangles = out,
                           .parts = &part,
                           .materials = &material,
                           .vertex_count = 4,
                           .triangle_count = 4,
                           .part_count = 1};
    (void)state;
    assert_null(ph_check_mesh(&mesh).what);
    mesh.triangles = in;
    assert_non_null(strstr(ph_check_mesh(&mesh).what, "face away"));
    material.two_sided = 1;
    assert_null(ph_check_mesh(&mesh).what);
}

static void no_mesh_is_told(void **state)
{
    (void)state;
    assert_string_equal(ph_check_mesh(NULL).what, "the mesh is NULL");
}

/* ---- empty pictures --------------------------------------------------------------------------------------------- */

#define EMPTY(name, lines, words)                                                                                      \
    static void name(void **state)                                                                                     \
    {                                                                                                                  \
        struct scene *const s = &wrong;                                                                                \
        (void)state;                                                                                                   \
        make_scene(s);                                                                                                 \
        lines;                                                                                                         \
        (void)draw(s);                                                                                                 \
        assert_int_equal(s->seen, 0);                                                                                  \
        assert_non_null(ph_why_empty(&s->r));                                                                          \
        assert_non_null(strstr(ph_why_empty(&s->r), words));                                                           \
    }

EMPTY(a_renderer_that_was_refused, s->config.height = 2000, "not initialised")
EMPTY(a_frame_that_did_not_begin, s->does_not_begin = true, "no frame has begun")
EMPTY(a_frame_that_was_refused, s->lens.near_z = 0, "no frame has begun")
EMPTY(behind_the_camera, s->view = ph_xform_translate(0, 0, FX_INT(3)), "off the picture")
EMPTY(beyond_the_far_plane, s->view = ph_xform_translate(0, 0, FX_INT(-30)), "off the picture")
EMPTY(a_placement_of_zeros, memset(&s->place, 0, sizeof s->place), "to_world")
EMPTY(vertices_without_room, s->config.vertex_max = 2, "vertex_max")
EMPTY(a_blend_without_draw, (BLENDED, s->blend.draw = NULL), "lacks its `draw`")
EMPTY(a_mesh_that_was_refused, s->mesh.positions = NULL, "ph_draw_mesh and the others returned")
EMPTY(parts_of_nothing, s->part.count = 0, "no part of a mesh has triangles")

static void bands_that_are_not_drawn_are_told(void **state)
{
    struct scene s;
    (void)state;
    make_scene(&s);
    assert_int_equal(ph_config_memory(&s.config, s.memory, sizeof s.memory), PH_OK);
    assert_int_equal(ph_renderer_init(&s.r, &s.config), PH_OK);
    assert_int_equal(ph_frame_begin(&s.r, &s.view, &s.lens, NULL, 0), PH_OK);
    assert_int_equal(ph_draw_mesh(&s.r, &s.mesh, &s.place), PH_OK);
    assert_non_null(strstr(ph_why_empty(&s.r), "no band was drawn"));
}

/* A renderer of zeros, on which ph_renderer_init was never called, refuses every call. */
static void a_renderer_of_zeros_refuses_all(void **state)
{
    struct scene s;
    (void)state;
    make_scene(&s);
    const struct ph_points points = {.positions = s.positions, .count = 3, .size = FX_ONE};
    const struct ph_fog fog = {0, FX_ONE, FX_INT(2)};
    assert_int_equal(ph_frame_begin(&s.r, &s.view, &s.lens, NULL, 0), PH_ERR_STATE);
    assert_int_equal(ph_frame_camera(&s.r, &s.view, &s.lens), PH_ERR_STATE);
    assert_int_equal(ph_frame_fog(&s.r, &fog), PH_ERR_STATE);
    assert_int_equal(ph_draw_mesh(&s.r, &s.mesh, &s.place), PH_ERR_STATE);
    assert_int_equal(ph_draw_billboard(&s.r, s.positions[0], FX_ONE, FX_ONE, &s.material), PH_ERR_STATE);
    assert_int_equal(ph_draw_line(&s.r, s.positions[0], s.positions[1], &s.material), PH_ERR_STATE);
    assert_int_equal(ph_draw_points(&s.r, &points, &s.place, &s.material), PH_ERR_STATE);
    assert_int_equal(ph_frame_bands(&s.r), 0);
    assert_int_equal(ph_draw_band(&s.r, 0, s.texels), 0);
    assert_int_equal(ph_show(&s.r, count_seen, &s), PH_ERR_STATE);
}

/* ---- where a frame draws ---------------------------------------------------------------------------------------- */

enum drawn { DRAWN_MESH, DRAWN_LINE, DRAWN_POINTS, DRAWN_NOTHING };

/* Draws with the triangle this far to the right and nearer, and compares the box with what is seen. */
static void assert_box(struct scene *s, enum drawn what, fx_t right, fx_t nearer, uint32_t slack)
{
    struct ph_rectangle box = {1, 2, 3, 4};
    const struct ph_points points = {.positions = s->positions, .count = 3, .size = FX_INT(3)};
    s->place = ph_xform_translate(right, 0, nearer);
    assert_int_equal(ph_frame_begin(&s->r, &s->view, &s->lens, &s->light, 0), PH_OK);
    assert_false(ph_frame_box(&s->r, &box));
    assert_int_equal(box.width | box.height, 0);
    if (what == DRAWN_MESH) {
        assert_int_equal(ph_draw_mesh(&s->r, &s->mesh, &s->place), PH_OK);
    } else if (what == DRAWN_LINE) {
        assert_int_equal(ph_draw_line(&s->r, s->positions[0], s->positions[2], &s->material), PH_OK);
    } else if (what == DRAWN_POINTS) {
        assert_int_equal(ph_draw_points(&s->r, &points, &s->place, &s->material), PH_OK);
    }
    const bool any = ph_frame_box(&s->r, &box);
    s->seen = 0;
    assert_int_equal(ph_show(&s->r, count_seen, s), PH_OK);
    assert_true(any || s->seen == 0);
    if (s->seen > 0) {
        assert_true(box.x <= s->left && box.x + box.width >= s->right && box.y <= s->top &&
                    box.y + box.height >= s->bottom);
        assert_true(box.x + slack >= s->left && box.x + box.width <= s->right + slack && box.y + slack >= s->top &&
                    box.y + box.height <= s->bottom + slack);
    }
    assert_false(ph_frame_box(&s->r, &box)); /* its bands are made */
}

static void the_box_holds_what_is_drawn_and_no_more(void **state)
{
    struct scene s;
    (void)state;
    make_scene(&s);
    assert_int_equal(ph_config_memory(&s.config, s.memory, sizeof s.memory), PH_OK);
    assert_int_equal(ph_renderer_init(&s.r, &s.config), PH_OK);
    for (fx_t right = -FX_INT(3); right <= FX_INT(3); right += FX_ONE / 7) {
        assert_box(&s, DRAWN_MESH, right, 0, SIDE); /* its part on the picture may be lower than it */
        assert_box(&s, DRAWN_MESH, right, FX_ONE * 2, SIDE);
    }
    assert_box(&s, DRAWN_MESH, 0, 0, 3);
    assert_true(s.seen > 1000);
    s.material.shading = PH_SHADE_TEXTURE;
    s.material.blend = &s.blend;
    s.positions[2].z = FX_INT(4); /* clipped by the near plane */
    assert_box(&s, DRAWN_MESH, 0, 0, SIDE);
    assert_true(s.seen > 0 && s.r.stats.triangles_clipped == 1);
    s.material.shading = PH_SHADE_UNLIT;
    s.positions[2].z = 0;
    assert_box(&s, DRAWN_LINE, 0, 0, 2);
    assert_true(s.seen > 0);
    assert_box(&s, DRAWN_POINTS, 0, 0, SIDE);
    assert_true(s.seen > 0);
    assert_box(&s, DRAWN_NOTHING, 0, 0, 0);
}

static void the_box_of_samples_is_in_pixels(void **state)
{
    static uint32_t depth[SIDE * LINES * 2], samples[SIDE * LINES * 2];
    struct scene s;
    (void)state;
    make_scene(&s);
    assert_int_equal(ph_config_memory(&s.config, s.memory, sizeof s.memory), PH_OK);
    s.config.depth = depth;
    s.config.samples = (uint16_t *)samples;
    s.config.antialiasing = PH_ANTIALIAS_2X2;
    assert_int_equal(ph_renderer_init(&s.r, &s.config), PH_OK);
    for (fx_t right = -FX_INT(2); right <= FX_INT(2); right += FX_ONE / 7) {
        assert_box(&s, DRAWN_MESH, right, 0, SIDE); /* its part on the picture may be lower than it */
    }
    assert_box(&s, DRAWN_MESH, 0, 0, 3);
    assert_true(s.seen > 1000);
}

/* ---- memory ----------------------------------------------------------------------------------------------------- */

/* All pictures of 1 .. 1024 lines fit, and the tallest one has no word to spare. */
static void the_constant_is_what_the_renderer_takes(void **state)
{
    enum { WIDTH = 37, BAND = 3, WORDS = PH_MEMORY(WIDTH, BAND, 11, 7) };
    static uint64_t memory[WORDS];
    (void)state;
    for (uint16_t height = BAND; height <= 1024; height++) {
        struct ph_renderer r;
        struct ph_config c = {.width = WIDTH,
                              .height = height,
                              .band_height = BAND,
                              .depth_format = PH_DEPTH_FLOAT16,
                              .vertex_max = 11,
                              .triangle_max = 7};
        const struct ph_config before = c;
        assert_int_equal(ph_config_memory(&c, memory, sizeof memory - (height > 1023) * sizeof memory[0]),
                         height > 1023 ? PH_ERR_NOMEM : PH_OK);
        assert_true(height <= 1023 || memcmp(&c, &before, sizeof c) == 0);
        assert_int_equal(ph_config_memory(&c, memory, sizeof memory), PH_OK);
        assert_int_equal(ph_renderer_init(&r, &c), PH_OK);
        assert_ptr_equal(c.vertices, memory);
        assert_ptr_equal(c.triangles, (uint8_t *)c.vertices + 11 * ph_vertex_bytes);
        assert_ptr_equal(c.bins, (uint8_t *)c.triangles + 7 * ph_triangle_bytes);
        assert_ptr_equal(c.depth, c.bins + (height + BAND - 1) / BAND);
        assert_ptr_equal(c.pixels, (uint16_t *)c.depth + WIDTH * BAND);
        assert_true((uint8_t *)c.pixels + WIDTH * BAND * 2 <= (uint8_t *)memory + sizeof memory);
    }
}

static void memory_for_nothing_is_refused(void **state)
{
    uint64_t memory[PH_MEMORY(8, 8, 4, 4)];
    struct ph_config c = {.width = 8, .height = 8, .band_height = 8};
    (void)state;
    assert_int_equal(ph_config_memory(NULL, memory, sizeof memory), PH_ERR_INVAL);
    assert_int_equal(ph_config_memory(&c, NULL, sizeof memory), PH_ERR_INVAL);
    assert_int_equal(ph_config_memory(&c, memory, sizeof memory), PH_ERR_FORMAT);
    c.depth_format = PH_DEPTH_FIXED16;
    c.vertex_max = UINT32_MAX;
    assert_int_equal(ph_config_memory(&c, memory, sizeof memory), PH_ERR_NOMEM);
    c.vertex_max = 4;
    c.antialiasing = PH_ANTIALIAS_2X2;
    assert_int_equal(ph_config_memory(&c, memory, sizeof memory), PH_ERR_INVAL);
    c.antialiasing = NULL;
    c.band_height = 0;
    assert_int_equal(ph_config_memory(&c, memory, sizeof memory), PH_ERR_INVAL);
}

int main(void)
{
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_right_is_seen_and_nothing_is_said),
        cmocka_unit_test(no_vertices),
        cmocka_unit_test(no_positions),
        cmocka_unit_test(no_triangles),
        cmocka_unit_test(no_triangle_count),
        cmocka_unit_test(no_parts),
        cmocka_unit_test(no_materials),
        cmocka_unit_test(an_index_too_large),
        cmocka_unit_test(a_part_of_nothing),
        cmocka_unit_test(a_part_too_long),
        cmocka_unit_test(a_material_too_far),
        cmocka_unit_test(edges_of_none),
        cmocka_unit_test(clockwise),
        cmocka_unit_test(sizes_as_integers),
        cmocka_unit_test(uvs_as_integers),
        cmocka_unit_test(normals_as_integers),
        cmocka_unit_test(light_without_normals),
        cmocka_unit_test(shares_as_integers),
        cmocka_unit_test(a_share_too_large),
        cmocka_unit_test(shininess_as_a_number),
        cmocka_unit_test(no_texture),
        cmocka_unit_test(no_uvs),
        cmocka_unit_test(no_texels),
        cmocka_unit_test(a_side_as_texels),
        cmocka_unit_test(a_blend_by_nothing),
        cmocka_unit_test(alpha_zero),
        cmocka_unit_test(alpha_of_255),
        cmocka_unit_test(alphas_of_a_colour),
        cmocka_unit_test(a_body_inside_out_is_seen_without_normals),
        cmocka_unit_test(no_mesh_is_told),
        cmocka_unit_test(a_renderer_that_was_refused),
        cmocka_unit_test(a_frame_that_did_not_begin),
        cmocka_unit_test(a_frame_that_was_refused),
        cmocka_unit_test(behind_the_camera),
        cmocka_unit_test(beyond_the_far_plane),
        cmocka_unit_test(a_placement_of_zeros),
        cmocka_unit_test(vertices_without_room),
        cmocka_unit_test(a_blend_without_draw),
        cmocka_unit_test(a_mesh_that_was_refused),
        cmocka_unit_test(parts_of_nothing),
        cmocka_unit_test(bands_that_are_not_drawn_are_told),
        cmocka_unit_test(a_renderer_of_zeros_refuses_all),
        cmocka_unit_test(the_box_holds_what_is_drawn_and_no_more),
        cmocka_unit_test(the_box_of_samples_is_in_pixels),
        cmocka_unit_test(the_constant_is_what_the_renderer_takes),
        cmocka_unit_test(memory_for_nothing_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
