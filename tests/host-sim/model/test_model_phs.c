/* model_phs: a binary scene of an asset that is made by hand, as a model that is compared with the asset. */
#include "complain.h"
#include "files.h"
#include "made_asset.h"
#include "model_phs.h"
#include "scene_file.h"
#include "stderr_capture.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static uint8_t bytes[1 << 16];

static size_t scene_of(struct asset *asset)
{
    const size_t n = asset_scene(asset, NULL);
    assert_in_range(n, 1, sizeof bytes - 1);
    asset_scene(asset, bytes);
    return n;
}

static struct model *open_good(const char *path)
{
    struct model *model = NULL;
    assert_int_equal(model_phs_open(&model, path), 0);
    return model;
}

static void a_scene_has_the_meshes_of_its_asset(void **state)
{
    (void)state;
    struct asset *const asset = made_asset(false);
    struct model *const model = open_good(file_bytes("a.phs", bytes, scene_of(asset)));
    assert_true(model->mesh_count == MADE_MESHES && model->triangle_count == 1 + 2 + 3 + 1 && model->vertex_max == 5);
    assert_true(!model->has_camera && model->motion == NULL && model->note == NULL);
    assert_int_equal((uintptr_t)model->scene % 16, 0);
    assert_memory_equal(model->scene, bytes, sizeof(struct scene_file_head));
    for (uint32_t m = 0; m < MADE_MESHES; m++) {
        const struct ph_mesh *const from = &asset->model.meshes[m], *const to = &model->meshes[m];
        assert_true(to->vertex_count == from->vertex_count && to->triangle_count == from->triangle_count);
        assert_memory_equal(to->positions, from->positions, sizeof *to->positions * to->vertex_count);
        assert_memory_equal(to->triangles, from->triangles, sizeof *to->triangles * to->triangle_count);
        assert_ptr_equal(to->materials->shading, from->materials->shading);
    }
    free(model);
}

static void a_camera_is_that_of_the_asset(void **state)
{
    (void)state;
    struct asset *const asset = made_asset(false);
    asset->model.has_camera = true;
    asset->model.camera.view = ph_xform_translate(1, 22, 333);
    asset->model.camera.lens = (struct ph_projection){
        .kind = PH_ORTHOGRAPHIC, .near_z = FX_ONE, .far_z = FX_INT(66), .scale_x_q20 = 1 << 20, .scale_y_q20 = 3 << 19};
    struct model *const model = open_good(file_bytes("a.phs", bytes, scene_of(asset)));
    assert_true(model->has_camera && model->camera.view.t.y == 22 && model->camera.view.t.z == 333);
    assert_true(model->camera.lens.kind == PH_ORTHOGRAPHIC && model->camera.lens.far_z == FX_INT(66));
    assert_int_equal(model->camera.lens.scale_y_q20, 3 << 19);
    free(model);
}

/* The vertices of what moves are in the bind pose: 16-bit positions with `frac` bits of fraction. */
static void what_moves_has_all_clips_and_plays_its_own(void **state)
{
    (void)state;
    for (int playing = 0; playing < MADE_CLIPS; playing++) {
        struct asset *const asset = made_asset(true);
        const struct model_motion *const from = asset->model.motion;
        asset->model.motion->animation.clip = &from->animation.clips[playing];
        struct model *const model = open_good(file_bytes("m.phs", bytes, scene_of(asset)));
        const struct model_motion *const to = model->motion;
        assert_true(to != NULL && to->animation.clip_count == MADE_CLIPS && to->animation.mesh_count == MADE_MOVING);
        for (uint32_t i = 0; i < MADE_CLIPS; i++) {
            assert_string_equal(to->animation.clips[i].name, from->animation.clips[i].name);
            assert_int_equal(to->animation.clips[i].track_count, from->animation.clips[i].track_count);
            assert_int_equal(to->animation.clips[i].duration, from->animation.clips[i].duration);
            for (uint32_t k = 0; k < to->animation.clips[i].track_count; k++) {
                const struct ph_track *const t = &to->animation.clips[i].tracks[k], *const u = &from->animation.clips[i]
                                                                                                    .tracks[k];
                assert_true(t->node == u->node && t->path == u->path && t->key_count == u->key_count);
                assert_memory_equal(t->times, u->times, t->key_count * sizeof *t->times);
            }
        }
        assert_true(to->animation.sample == NULL && to->animation.cross_fade == 12345);
        assert_ptr_equal(to->animation.clip, &to->animation.clips[playing]);
        for (uint32_t i = 0; i < MADE_MOVING; i++) {
            const struct ph_bound *const bound = &from->animation.meshes[i].bound;
            const struct ph_mesh *const mesh = &model->meshes[from->animation.meshes[i].mesh];
            for (uint32_t v = 0; v < mesh->vertex_count; v++) {
                const double x = bound->positions[v][0] * 65536.0 / (1 << bound->frac);
                assert_true(mesh->positions[v].x - x < 1 && mesh->positions[v].x - x > -1);
            }
        }
        free(model);
    }
}

static void expect_refused(const char *path, const char *reason)
{
    struct model *model = NULL;
    struct stderr_capture said;
    stderr_capture_begin(&said);
    const int status = model_phs_open(&model, path);
    stderr_capture_end(&said);
    assert_int_equal(status, COMPLAINED);
    assert_null(model);
    assert_non_null(strstr(said.text, path));
    assert_non_null(strstr(said.text, reason));
    assert_int_equal(stderr_capture_lines(&said), 1);
}

static void what_is_no_scene_is_refused(void **state)
{
    (void)state;
    const size_t n = scene_of(made_asset(true));
    expect_refused(file_path("none.phs"), "No such file");
    expect_refused(file_text("empty.phs", ""), scene_file_wrong(bytes, 0));
    expect_refused(file_bytes("short.phs", bytes, n - 1), scene_file_wrong(bytes, n - 1));
    bytes[n - 1] ^= 1;
    expect_refused(file_bytes("changed.phs", bytes, n), scene_file_wrong(bytes, n));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_scene_has_the_meshes_of_its_asset),
        cmocka_unit_test(a_camera_is_that_of_the_asset),
        cmocka_unit_test(what_moves_has_all_clips_and_plays_its_own),
        cmocka_unit_test(what_is_no_scene_is_refused),
    };
    return cmocka_run_group_tests(tests, files_begin, files_end);
}
