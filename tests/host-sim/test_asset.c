/* pinhole-asset's parts: cameras of files, simplifying, ordering, textures, budgets. The compiled file:
 * test_asset_cli.sh.
 */
#define _XOPEN_SOURCE 700 /* open_memstream */

#include "asset.h"
#include "runner.h"
#include "model_files.h"
#include "sim_player.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <setjmp.h>
#include <cmocka.h>

static void make(struct asset *asset, const struct model *model, uint32_t triangles)
{
    const struct asset_limits limits = {triangles, 8, false, false, "some where/my model.v2.obj"};
    assert_int_equal(asset_make(asset, model, &limits), 0);
}

/* ---- cameras -------------------------------------------------------------------------------------------- */

/* Node 0 stands and is turned anywhere; below it the cube, twice as large, and a camera. */
#define PI 3.14159265358979323846

#define EYE_X 1.0
#define EYE_Y 2.0
#define EYE_Z 9.0
#define PITCH .2 /* radians, downwards */

static const char *cube_with_camera(const char *lens)
{
    char text[1024];
    snprintf(text, sizeof text,
             "[{\"translation\":[3,-2,5],\"rotation\":[0,0.25881904510252074,0,0.9659258262890683],\"children\":[1,2]},"
             "{\"mesh\":0,\"scale\":[2,2,2]},{\"camera\":0,\"name\":\"eye\",\"translation\":[%g,%g,%g],"
             "\"rotation\":[%.17g,0,0,%.17g]}],\"cameras\":[%s]",
             EYE_X, EYE_Y, EYE_Z, -sin(PITCH / 2), cos(PITCH / 2), lens);
    return cube_glb(text);
}

/* Corner k of the cube before the camera, worked out from the nodes above: what node 0 does, it does to both. */
static void corner_before(int k, double v[3])
{
    const double x = (k & 1 ? 2 : -2) - EYE_X, y = (k & 2 ? 2 : -2) - EYE_Y, z = (k & 4 ? 2 : -2) - EYE_Z;
    v[0] = x;
    v[1] = cos(PITCH) * y - sin(PITCH) * z;
    v[2] = sin(PITCH) * y + cos(PITCH) * z;
}

/* Where the model's camera sees a vertex: x, y in its picture's halves. Its depth must be within the planes. */
static void project(const struct demo_eye *eye, const struct fx_vec3 *p, double ndc[2])
{
    double v[3];
    const double t[3] = {eye->view.t.x, eye->view.t.y, eye->view.t.z};
    for (int row = 0; row < 3; row++) {
        const int32_t *r = eye->view.r[row];
        v[row] = ((double)r[0] * p->x + (double)r[1] * p->y + (double)r[2] * p->z) / (1 << 30) + t[row];
    }
    assert_true(-v[2] > eye->lens.near_z && -v[2] < eye->lens.far_z);
    const double w = eye->lens.kind == PH_ORTHOGRAPHIC ? FX_ONE : -v[2];
    ndc[0] = v[0] / w * eye->lens.scale_x_q20 / (1 << 20);
    ndc[1] = v[1] / w * eye->lens.scale_y_q20 / (1 << 20);
}

/* Each corner is seen where the file says, and nothing is seen elsewhere. slope: half width and height, at distance 1
 * or (parallel) at any. */
static void assert_seen(const struct model *model, double slope_x, double slope_y, bool is_parallel)
{
    unsigned found = 0;
    for (uint32_t i = 0; i < model->meshes->vertex_count; i++) {
        double ndc[2], v[3];
        bool is_known = false;
        project(&model->camera, &model->meshes->positions[i], ndc);
        for (int k = 0; k < 8; k++) {
            corner_before(k, v);
            const double w = is_parallel ? 1 : -v[2];
            const double off_x = ndc[0] - v[0] / w / slope_x, off_y = ndc[1] - v[1] / w / slope_y;
            if (fabs(off_x) < 1e-4 && fabs(off_y) < 1e-4) {
                is_known = true;
                found |= 1u << k;
            }
        }
        assert_true(is_known);
    }
    assert_int_equal(found, 255);
}

static void perspective_camera_sees_what_the_file_says(void **state)
{
    (void)state;
    struct model *model = open_good(cube_with_camera(
        "{\"type\":\"perspective\",\"perspective\":{\"yfov\":0.8,\"aspectRatio\":1.5,\"znear\":0.1,\"zfar\":100}}"));
    assert_true(model->has_camera);
    assert_seen(model, 1.5 * tan(.4), tan(.4), false);
    const fx_t centre = -model->camera.view.t.z; /* the planes stand close before and behind the sphere around it */
    assert_in_range(model->camera.lens.near_z, centre - FX_ONE * 101 / 100, centre - FX_ONE);
    assert_in_range(model->camera.lens.far_z, centre + FX_ONE, centre + FX_ONE * 101 / 100);
    model_close(model);
}

static void parallel_camera_sees_what_the_file_says(void **state)
{
    (void)state;
    struct model *model = open_good(cube_with_camera(
        "{\"type\":\"orthographic\",\"orthographic\":{\"xmag\":6,\"ymag\":4,\"znear\":0.1,\"zfar\":100}}"));
    assert_true(model->has_camera);
    assert_int_equal(model->camera.lens.kind, PH_ORTHOGRAPHIC);
    assert_seen(model, 6, 4, true);
    model_close(model);
}

/* On a panel of this size the frame of the file is seen whole, with square pixels and no margin on both sides. */
static void assert_framed(struct model *model, uint16_t width, uint16_t height)
{
    const struct ph_projection *lens = &model->camera.lens;
    struct sim_virtual v;
    struct sim_player p;
    assert_int_equal(sim_virtual(&v, width, height), 0);
    const struct demo demo = model_demo(model);
    const struct sim_player_setup setup = {.board = &v.board, .band_height = 16, .demo = &demo, .state = model};
    assert_int_equal(sim_player_open(&p, &setup), 0);
    assert_int_equal(sim_player_scene(&p, 0), 0);
    assert_memory_equal(&p.runner.renderer.view, &model->camera.view, sizeof p.runner.renderer.view);
    const struct ph_projection shown = p.runner.renderer.projection;
    assert_true(fabs((double)shown.scale_x_q20 * width - (double)shown.scale_y_q20 * height) < 4 * (width + height));
    assert_true(lens->scale_x_q20 == 0 || shown.scale_x_q20 <= lens->scale_x_q20 + 4);
    assert_true(shown.scale_y_q20 <= lens->scale_y_q20);
    assert_true(shown.scale_y_q20 == lens->scale_y_q20 || abs(shown.scale_x_q20 - lens->scale_x_q20) <= 4);
    assert_int_equal(sim_player_close(&p), 0);
}

static void frame_of_a_camera_is_seen_whole_on_a_panel_of_any_shape(void **state)
{
    (void)state;
    static const char *const aspects[] = {"\"aspectRatio\":1.5,", ""};
    for (int i = 0; i < 2; i++) {
        char lens[200];
        snprintf(lens, sizeof lens,
                 "{\"type\":\"perspective\",\"perspective\":{%s\"yfov\":0.8,\"znear\":0.1,\"zfar\":100}}", aspects[i]);
        struct model *model = open_good(cube_with_camera(lens));
        assert_int_equal(model->camera.lens.scale_x_q20 == 0, i == 1);
        assert_framed(model, 300, 100);
        assert_framed(model, 100, 300);
        assert_framed(model, 240, 160);
        model_close(model);
    }
}

static void a_camera_that_looks_away_is_ignored_and_noted(void **state)
{
    (void)state;
    struct model *model =
        open_good(cube_glb("[{\"mesh\":0,\"children\":[1]},{\"camera\":0,\"name\":\"eye\",\"translation\":[0,0,-9]}],"
                           "\"cameras\":[{\"type\":\"perspective\",\"perspective\":{\"yfov\":1,\"znear\":0.1}}]"));
    assert_false(model->has_camera);
    assert_string_equal(model->note, "camera eye does not see the model, and is ignored");
    model_close(model);
}

/* ---- ordering ------------------------------------------------------------------------------------------- */

/* A corner of a triangle, with everything that a picture depends on. */
struct whole_corner {
    struct fx_vec3 position;
    fx_t uv[2];
    int16_t normal[4];
};

static int by_bytes(const void *a, const void *b)
{
    return memcmp(a, b, 3 * sizeof(struct whole_corner));
}

/* All triangles of a model with their corners, sorted. free() it. */
static struct whole_corner (*list_triangles(const struct model *model))[3]
{
    struct whole_corner(*list)[3] = calloc(model->triangle_count, sizeof *list);
    size_t n = 0;
    for (uint32_t m = 0; m < model->mesh_count; m++) {
        const struct ph_mesh *mesh = &model->meshes[m];
        for (uint32_t t = 0; t < mesh->triangle_count; t++, n++) {
            for (int i = 0; i < 3; i++) {
                const uint16_t v = mesh->triangles[t][i];
                list[n][i].position = mesh->positions[v];
                memcpy(list[n][i].normal, mesh->normals[v], 6);
                if (mesh->uvs != NULL) {
                    memcpy(list[n][i].uv, mesh->uvs[v], 8);
                }
            }
        }
    }
    qsort(list, n, sizeof *list, by_bytes);
    return list;
}

/* A sphere of 48 x 24 quads; its lower half of another material, where there are materials. */
static const char *sphere(const char *name, bool has_materials)
{
    static char text[200000];
    size_t n = 0;
    if (has_materials) {
        file_text("two.mtl", "newmtl a\nKd 1 0 0\nnewmtl b\nKd 0 0 1\n");
        n += (size_t)snprintf(text, sizeof text, "mtllib two.mtl\n");
    }
    for (int j = 0; j <= 24; j++) {
        for (int i = 0; i < 48; i++) {
            const double u = i * 2 * PI / 48, v = (j / 24.0 - .5) * PI;
            n += (size_t)snprintf(text + n, sizeof text - n, "v %.6f %.6f %.6f\n", cos(u) * cos(v), sin(v),
                                  -sin(u) * cos(v));
        }
    }
    for (int j = 0; j < 24; j++) {
        if (has_materials && j % 12 == 0) {
            n += (size_t)snprintf(text + n, sizeof text - n, "usemtl %c\n", j == 0 ? 'b' : 'a');
        }
        for (int i = 0; i < 48; i++) {
            const int a = j * 48 + i + 1, b = j * 48 + (i + 1) % 48 + 1;
            if (j == 0) {
                n += (size_t)snprintf(text + n, sizeof text - n, "f %d %d %d\n", a, b + 48, a + 48);
            } else if (j == 23) {
                n += (size_t)snprintf(text + n, sizeof text - n, "f %d %d %d\n", a, b, a + 48);
            } else {
                n += (size_t)snprintf(text + n, sizeof text - n, "f %d %d %d %d\n", a, b, b + 48, a + 48);
            }
        }
    }
    return file_text(name, text);
}

static void ordering_changes_no_triangle(void **state)
{
    (void)state;
    struct asset asset;
    struct model *model = open_good(sphere("order.obj", true));
    make(&asset, model, UINT32_MAX);
    assert_false(asset.is_simplified);
    assert_int_equal(asset.model.triangle_count, model->triangle_count);
    assert_int_equal(asset.model.mesh_count, 2);
    struct whole_corner(*const before)[3] = list_triangles(model), (*const after)[3] = list_triangles(&asset.model);
    assert_memory_equal(before, after, sizeof *before * model->triangle_count);
    free(before);
    free(after);
    asset_free(&asset);
    model_close(model);
}

/* Counted in another way than asset_reuse does: vertices that are not among the last 16 different ones fetched. */
static double fetches(const struct ph_mesh *mesh)
{
    uint32_t *fetched_at = calloc(mesh->vertex_count, sizeof *fetched_at), count = 0;
    for (uint32_t i = 0; i < mesh->triangle_count * 3; i++) {
        uint32_t *at = &fetched_at[mesh->triangles[i / 3][i % 3]];
        if (*at == 0 || count - *at >= 16) {
            *at = ++count;
        }
    }
    free(fetched_at);
    return (double)count / mesh->triangle_count;
}

static void vertices_are_used_again_and_come_in_the_order_of_their_use(void **state)
{
    (void)state;
    struct asset asset;
    struct model *model = open_good(sphere("reuse.obj", false));
    make(&asset, model, UINT32_MAX);
    const struct ph_mesh *mesh = asset.model.meshes;
    uint32_t next = 0;
    for (uint32_t i = 0; i < mesh->triangle_count * 3; i++) {
        const uint32_t v = mesh->triangles[i / 3][i % 3];
        assert_true(v <= next);
        next += v == next;
    }
    assert_int_equal(next, mesh->vertex_count);
    assert_true(fetches(mesh) < .75 && fetches(mesh) <= fetches(model->meshes));
    assert_true(fabs(asset.fetched - fetches(mesh)) < .02);
    asset_free(&asset);
    model_close(model);
}

static void equal_vertices_become_one(void **state)
{
    (void)state;
    struct asset asset;
    struct model *model = open_good(cube_gltf("[{\"mesh\":0}]"));
    assert_int_equal(model->vertex_max, 36);
    make(&asset, model, UINT32_MAX);
    assert_int_equal(asset.model.vertex_max, 24);
    assert_int_equal(asset.model.triangle_count, 12);
    asset_free(&asset);
    model_close(model);
}

/* ---- simplifying ---------------------------------------------------------------------------------------- */

static bool same_place(const struct fx_vec3 *a, const struct fx_vec3 *b)
{
    return a->x == b->x && a->y == b->y && a->z == b->z;
}

static const struct fx_vec3 *corner_of(const struct whole_corner (*list)[3], size_t t, int i)
{
    return &list[t][i % 3].position;
}

/* Each edge of the model is passed once one way and once the other: the surface has no border, and does not touch
 * itself. */
static void assert_closed(const struct model *model)
{
    struct whole_corner(*const list)[3] = list_triangles(model);
    const struct whole_corner(*const all)[3] = (const struct whole_corner(*)[3])list;
    for (size_t e = 0; e < (size_t)3 * model->triangle_count; e++) {
        const struct fx_vec3 *a = corner_of(all, e / 3, (int)(e % 3)), *b = corner_of(all, e / 3, (int)(e % 3) + 1);
        int there = 0, back = 0;
        for (size_t f = 0; f < (size_t)3 * model->triangle_count; f++) {
            const struct fx_vec3 *c = corner_of(all, f / 3, (int)(f % 3)), *d = corner_of(all, f / 3, (int)(f % 3) + 1);
            there += same_place(a, c) && same_place(b, d);
            back += same_place(a, d) && same_place(b, c);
        }
        assert_int_equal(there, back);
        assert_int_equal(there, 1);
    }
    free(list);
}

/* How far the middles of the triangles lie inside of the unit sphere, and that no vertex has moved. */
static double depth_inside(const struct model *model)
{
    double most = 0;
    for (uint32_t m = 0; m < model->mesh_count; m++) {
        const struct ph_mesh *mesh = &model->meshes[m];
        for (uint32_t t = 0; t < mesh->triangle_count; t++) {
            double middle[3] = {0, 0, 0};
            for (int i = 0; i < 3; i++) {
                const struct fx_vec3 *p = &mesh->positions[mesh->triangles[t][i]];
                const double r = sqrt((double)p->x * p->x + (double)p->y * p->y + (double)p->z * p->z) / FX_ONE;
                assert_true(fabs(r - 1) < 1e-4);
                middle[0] += p->x / 3.0 / FX_ONE;
                middle[1] += p->y / 3.0 / FX_ONE;
                middle[2] += p->z / 3.0 / FX_ONE;
            }
            const double depth = 1 - sqrt(middle[0] * middle[0] + middle[1] * middle[1] + middle[2] * middle[2]);
            most = depth > most ? depth : most;
        }
    }
    return most;
}

static void a_simplified_model_keeps_its_shape_and_opens_no_gap_between_materials(void **state)
{
    (void)state;
    struct asset asset;
    struct model *model = open_good(sphere("half.obj", true));
    make(&asset, model, 600);
    assert_in_range(asset.model.triangle_count, 560, 600);
    assert_int_equal(asset.model.mesh_count, 2);
    assert_closed(&asset.model);
    const double inside = depth_inside(&asset.model);
    assert_true(inside > .005 && inside < .04);
    assert_true(asset.error > inside / 3 && asset.error < inside * 3);
    asset_free(&asset);
    model_close(model);
}

static double dot_of_normal(const struct ph_mesh *mesh, uint32_t t, int i)
{
    const struct fx_vec3 *a = &mesh->positions[mesh->triangles[t][0]], *b = &mesh->positions[mesh->triangles[t][1]],
                         *c = &mesh->positions[mesh->triangles[t][2]];
    const double p[3] = {(double)b->x - a->x, (double)b->y - a->y, (double)b->z - a->z};
    const double q[3] = {(double)c->x - a->x, (double)c->y - a->y, (double)c->z - a->z};
    const double n[3] = {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
    const int16_t *normal = mesh->normals[mesh->triangles[t][i]];
    return (n[0] * normal[0] + n[1] * normal[1] + n[2] * normal[2]) / 16384 /
           sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
}

/* The least of all corners. */
static double least_dot(const struct model *model)
{
    double least = 1;
    for (uint32_t t = 0; t < model->meshes->triangle_count; t++) {
        for (int i = 0; i < 3; i++) {
            least = fmin(least, dot_of_normal(model->meshes, t, i));
        }
    }
    return least;
}

static void a_flat_model_stays_flat(void **state)
{
    (void)state;
    struct asset asset;
    struct model *model = open_good(sphere("flat.obj", false));
    int16_t(*normals)[3] = calloc((size_t)model->triangle_count * 3, sizeof *normals);
    struct fx_vec3 *places = calloc((size_t)model->triangle_count * 3, sizeof *places);
    uint16_t(*triangles)[3] = calloc(model->triangle_count, sizeof *triangles);
    struct ph_mesh flat = model->meshes[0];
    for (uint32_t t = 0; t < model->triangle_count; t++) { /* every triangle has vertices of its own */
        const int16_t *corner = model->meshes->normals[model->meshes->triangles[t][0]];
        for (uint32_t i = 0; i < 3; i++) {
            places[3 * t + i] = model->meshes->positions[model->meshes->triangles[t][i]];
            memcpy(normals[3 * t + i], corner, sizeof *normals);
            triangles[t][i] = (uint16_t)(3 * t + i);
        }
    }
    flat.positions = places;
    flat.normals = (const int16_t(*)[3])normals;
    flat.triangles = (const uint16_t(*)[3])triangles;
    flat.vertex_count = model->triangle_count * 3;
    const struct model flat_model = {
        .meshes = &flat, .mesh_count = 1, .vertex_max = flat.vertex_count, .triangle_count = flat.triangle_count};
    make(&asset, &flat_model, 500);
    assert_in_range(asset.model.triangle_count, 450, 500);
    assert_true(least_dot(&asset.model) > .9999);
    asset_free(&asset);
    free(normals);
    free(places);
    free(triangles);
    model_close(model);
}

static void a_smooth_model_stays_smooth(void **state)
{
    (void)state;
    struct asset asset;
    struct model *model = open_good(sphere("smooth.obj", false));
    make(&asset, model, 500);
    assert_in_range(asset.model.triangle_count, 450, 500);
    const struct ph_mesh *mesh = asset.model.meshes;
    for (uint32_t i = 0; i < mesh->vertex_count; i++) { /* of a sphere the normal is the place */
        const struct fx_vec3 *p = &mesh->positions[i];
        const int16_t *n = mesh->normals[i];
        assert_true(((double)n[0] * p->x + (double)n[1] * p->y + (double)n[2] * p->z) / 16384 / FX_ONE > .97);
    }
    assert_true(least_dot(&asset.model) < .999);
    asset_free(&asset);
    model_close(model);
}

/* ---- textures ------------------------------------------------------------------------------------------- */

static uint16_t wire(unsigned red, unsigned green, unsigned blue)
{
    const uint8_t bytes[2] = {(uint8_t)(red << 3 | green >> 3), (uint8_t)(green << 5 | blue)};
    uint16_t texel;
    memcpy(&texel, bytes, sizeof texel);
    return texel;
}

static void a_texture_is_shrunk_by_its_means_and_shared_once(void **state)
{
    (void)state;
    static const struct fx_vec3 places[] = {{0, 0, 0}, {FX_ONE, 0, 0}, {0, FX_ONE, 0}};
    static const int16_t normals[3][3] = {{0, 0, 16384}, {0, 0, 16384}, {0, 0, 16384}};
    static const fx_t uvs[3][2] = {{0, 0}, {FX_ONE, 0}, {0, FX_ONE}};
    static const uint16_t corners[1][3] = {{0, 1, 2}}, ramp[PH_RAMP_SIZE] = {1, 2, 3};
    static const struct ph_part part = {.count = 1};
    uint16_t texels[8];
    for (unsigned i = 0; i < 8; i++) {
        texels[i] = wire(4 * i, 63 - 8 * i, i);
    }
    const struct ph_texture texture = {.texels = texels, .log2_width = 2, .log2_height = 1, .wrap = PH_WRAP_CLAMP};
    const struct ph_material material = {.shading = PH_SHADE_TEXTURE_LIT, .ramp = ramp, .texture = &texture};
    const struct ph_texture other_texture = {
        .texels = texels + 7, .log2_width = 0, .log2_height = 0, .wrap = PH_WRAP_REPEAT};
    struct ph_material other_material = material;
    other_material.texture = &other_texture;
    struct ph_mesh meshes[3] = {{.positions = places,
                                 .normals = normals,
                                 .uvs = uvs,
                                 .triangles = corners,
                                 .parts = &part,
                                 .materials = &material,
                                 .vertex_count = 3,
                                 .triangle_count = 1,
                                 .part_count = 1}};
    meshes[1] = meshes[0];
    meshes[2] = meshes[0];
    meshes[2].materials = &other_material;
    const struct model model = {.meshes = meshes, .mesh_count = 3, .vertex_max = 3, .triangle_count = 3};
    const struct asset_limits limits = {UINT32_MAX, 1, false, false, "t.obj"};
    struct asset asset;
    assert_int_equal(asset_make(&asset, &model, &limits), 0);
    const struct ph_texture *small = asset.model.meshes[0].materials->texture;
    assert_ptr_equal(small, asset.model.meshes[1].materials->texture);
    assert_int_equal(small->log2_width, 1);
    assert_int_equal(small->log2_height, 1);
    assert_int_equal(small->wrap, PH_WRAP_CLAMP);
    for (unsigned i = 0; i < 4; i++) { /* of two neighbours; a half is rounded up */
        assert_int_equal(small->texels[i], wire(8 * i + 2, 59 - 16 * i, 2 * i + 1));
    }
    assert_int_equal(asset.model.meshes[2].materials->texture->texels[0], texels[7]);
    assert_int_equal(asset_sizes(&asset).textures, (8 + 2 * 4) + (8 + 2));
    assert_int_equal(asset.first_ramps[2], 0);
    asset_free(&asset);
}

/* ---- budgets -------------------------------------------------------------------------------------------- */

/* The longest list of any frame, with the buttons held for a while; nothing may be left out. */
static uint32_t longest_list(struct asset *asset, const struct board *board)
{
    const struct demo demo = asset_demo(asset);
    const struct sim_player_setup setup = {.board = board,
                                           .rotation = board->rotation,
                                           .band_height = board->band_height,
                                           .demo = &demo,
                                           .state = &asset->model};
    struct sim_player p;
    uint32_t most = 0;
    assert_int_equal(sim_player_open(&p, &setup), 0);
    for (uint32_t frame = 0; frame < 320; frame++) {
        demo_input(&p.runner.context, frame < 64 ? HAL_BUTTON_UP : frame < 256 ? HAL_BUTTON_DOWN : HAL_BUTTON_LEFT);
        assert_int_equal(runner_scene(&p.runner, frame), 0);
        assert_int_equal(p.runner.renderer.stats.triangles_dropped, 0);
        assert_int_equal(p.runner.renderer.stats.vertices_dropped, 0);
        most = p.runner.renderer.stats.triangles_drawn > most ? p.runner.renderer.stats.triangles_drawn : most;
    }
    sim_player_close(&p);
    return most;
}

static void the_list_of_triangles_is_long_enough_and_little_longer(void **state)
{
    (void)state;
    struct model *model = open_good(sphere("list.obj", true));
    static const char *const boards[] = {"pico-display", "waveshare-pico-lcd-0in96", "rpi-waveshare-1in3"};
    for (int i = 0; i < 3; i++) {
        struct asset asset;
        make(&asset, model, 900);
        assert_int_equal(asset_measure(&asset, board_find(boards[i])), 0);
        const uint32_t most = longest_list(&asset, board_find(boards[i]));
        assert_in_range(asset.listed, most, most + most / 8 + 16);
        asset_free(&asset);
    }
    model_close(model);
}

/* The kit gives the scene all that it wants when the board has just what asset_frame_bytes() says, and not below. */
static void what_a_frame_needs_is_what_the_kit_takes(void **state)
{
    (void)state;
    struct model *model = open_good(sphere("need.obj", false));
    struct asset asset;
    make(&asset, model, UINT32_MAX);
    struct board board = *board_find("pico-display");
    assert_int_equal(asset_measure(&asset, &board), 0);
    const struct demo demo = asset_demo(&asset);
    const uint64_t need = asset_frame_bytes(&asset, &board, false);
    assert_true(need > asset_band_bytes(&board) + 12 * (uint64_t)asset.model.triangle_count);
    for (uint32_t less = 0; less <= 8; less += 8) {
        board.scene_bytes = (uint32_t)need - less;
        const struct sim_player_setup setup = {.board = &board,
                                               .rotation = board.rotation,
                                               .band_height = board.band_height,
                                               .demo = &demo,
                                               .state = &asset.model};
        struct sim_player p;
        assert_int_equal(sim_player_open(&p, &setup), 0);
        assert_int_equal(p.runner.renderer.config.triangle_max == demo.triangle_max, less == 0);
        sim_player_close(&p);
    }
    asset_free(&asset);
    model_close(model);
}

static void a_name_is_plain(void **state)
{
    (void)state;
    struct asset asset;
    struct model *model = open_good(cube_obj());
    make(&asset, model, UINT32_MAX);
    assert_string_equal(asset.name, "my_model_v2");
    asset_free(&asset);
    model_close(model);
}

static void the_same_model_gives_the_same_file(void **state)
{
    (void)state;
    char *texts[2];
    size_t lengths[2];
    for (int i = 0; i < 2; i++) {
        struct asset asset;
        struct model *model = open_good(sphere("twice.obj", true));
        FILE *file = open_memstream(&texts[i], &lengths[i]);
        make(&asset, model, 700);
        asset_measure(&asset, board_find("pico-display"));
        asset_write(file, &asset);
        fclose(file);
        asset_free(&asset);
        model_close(model);
    }
    assert_int_equal(lengths[0], lengths[1]);
    assert_memory_equal(texts[0], texts[1], lengths[0]);
    free(texts[0]);
    free(texts[1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(perspective_camera_sees_what_the_file_says),
        cmocka_unit_test(parallel_camera_sees_what_the_file_says),
        cmocka_unit_test(frame_of_a_camera_is_seen_whole_on_a_panel_of_any_shape),
        cmocka_unit_test(a_camera_that_looks_away_is_ignored_and_noted),
        cmocka_unit_test(ordering_changes_no_triangle),
        cmocka_unit_test(vertices_are_used_again_and_come_in_the_order_of_their_use),
        cmocka_unit_test(equal_vertices_become_one),
        cmocka_unit_test(a_simplified_model_keeps_its_shape_and_opens_no_gap_between_materials),
        cmocka_unit_test(a_flat_model_stays_flat),
        cmocka_unit_test(a_smooth_model_stays_smooth),
        cmocka_unit_test(a_texture_is_shrunk_by_its_means_and_shared_once),
        cmocka_unit_test(the_list_of_triangles_is_long_enough_and_little_longer),
        cmocka_unit_test(what_a_frame_needs_is_what_the_kit_takes),
        cmocka_unit_test(a_name_is_plain),
        cmocka_unit_test(the_same_model_gives_the_same_file),
    };
    return cmocka_run_group_tests(tests, files_begin, files_end);
}
