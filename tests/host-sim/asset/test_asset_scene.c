/* asset_scene: the bytes of a scene, read by the structs of scene_format.h, are the numbers of the asset. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "made_asset.h"
#include "scene_file.h"

#include <stdlib.h>
#include <string.h>

static struct asset *asset;
static uint8_t *bytes;
static size_t size;

/* Writes the asset between other bytes, which stay. */
static const struct scene_file_head *write_scene(void)
{
    free(bytes);
    size = asset_scene(asset, NULL);
    bytes = malloc(size + 8);
    assert_non_null(bytes);
    memset(bytes, 0, size);
    memset(bytes + size, 0x77, 8);
    assert_int_equal(asset_scene(asset, bytes), size);
    assert_memory_equal(bytes + size, "wwwwwwww", 8);
    return (const void *)bytes;
}

static int drop(void **state)
{
    (void)state;
    free(bytes);
    bytes = NULL;
    return 0;
}

static void expect_at(uint32_t offset, const void *data, size_t n)
{
    assert_true(offset >= sizeof(struct scene_file_head) && offset % 4 == 0 && offset + n <= size);
    assert_memory_equal(bytes + offset, data, n);
}

static const struct scene_file_mesh *mesh_at(uint32_t m)
{
    return &scene_file_table((const void *)bytes)[m];
}

static void a_scene_can_be_drawn_and_has_no_byte_too_many(void **state)
{
    (void)state;
    for (int moves = 1; moves >= 0; moves--) {
        asset = made_asset(moves != 0);
        const struct scene_file_head *const head = write_scene();
        assert_null(scene_file_wrong(bytes, size));
        assert_int_equal(head->bytes, size);
        assert_int_equal(size % 4, 0);
        assert_int_equal(head->motion != 0, moves);
    }
    const size_t vertices = 3 + 4 + 5 + 3, with_uvs = 4 + 5 + 3, ramps = 3;
    const size_t normals = 20 + 24 + 32 + 20, triangles = 8 + 12 + 20 + 8; /* each array on 4 bytes */
    const size_t still = sizeof(struct scene_file_head) + 4 * sizeof(struct scene_file_mesh) + vertices * 12 + normals +
                         with_uvs * 8 + triangles + ramps * 256 + 8 + 44 + 16;
    assert_int_equal(size, still);
    asset = made_asset(true);
    write_scene();
    const size_t bound = 20 + 32 + 20, skins = 8 + 3 * 48 + 4 + 48, influences = 36, targets = 60 + 60 + 20,
                 rig = 3 * 44 + 12, keys = (4 + 8) + (8 + 12) + 48 + (28 + 28);
    assert_int_equal(size, still - (3 + 5 + 3) * 12 + bound + skins + influences + targets + rig + keys +
                               3 * sizeof(struct scene_file_moving) + sizeof(struct scene_file_motion) +
                               2 * sizeof(struct scene_file_clip) + 4 * sizeof(struct scene_file_track));
}

static void the_head_says_what_the_demo_needs(void **state)
{
    (void)state;
    asset = made_asset(false);
    const struct scene_file_head *head = write_scene();
    const struct demo demo = asset_demo(asset);
    assert_memory_equal(bytes, "PHHS", 4);
    assert_int_equal(head->version, 6);
    assert_int_equal(head->mesh_count, 4);
    assert_int_equal(head->flags, 0);
    assert_int_equal(head->vertex_max, demo.vertex_max);
    assert_int_equal(head->triangle_max, 77);
    assert_string_equal(head->name, "made-by_hand");
    asset->is_bare = true;
    assert_int_equal(write_scene()->flags, SCENE_FILE_BARE);
}

static void a_camera_is_written_where_the_model_has_one(void **state)
{
    (void)state;
    static const struct demo_eye eye = {
        .view = {.r = {{0, 1 << 30, 0}, {-(1 << 30), 0, 0}, {0, 0, 1 << 30}}, .t = {5, -6, -700000}},
        .lens = {PH_ORTHOGRAPHIC, .scale_x_q20 = 1234567, .scale_y_q20 = 2345678, .near_z = 70000, .far_z = 80000}};
    asset = made_asset(false);
    asset->model.camera = eye;
    const struct scene_file_head *head = write_scene();
    assert_int_equal(head->scale_x_q20, 0);
    assert_int_equal(head->r[0][1], 0);
    asset->model.has_camera = true;
    head = write_scene();
    assert_null(scene_file_wrong(bytes, size));
    assert_int_equal(head->flags, SCENE_FILE_CAMERA);
    assert_memory_equal(head->r, eye.view.r, sizeof head->r);
    assert_true(head->t[0] == 5 && head->t[1] == -6 && head->t[2] == -700000);
    assert_int_equal(head->lens_kind, PH_ORTHOGRAPHIC);
    assert_int_equal(head->scale_x_q20, 1234567);
    assert_int_equal(head->scale_y_q20, 2345678);
    assert_int_equal(head->near_z, 70000);
    assert_int_equal(head->far_z, 80000);
}

static void arrays_are_those_of_the_meshes(void **state)
{
    (void)state;
    asset = made_asset(false);
    write_scene();
    for (uint32_t m = 0; m < MADE_MESHES; m++) {
        const struct ph_mesh *const mesh = &asset->model.meshes[m];
        const struct scene_file_mesh *const to = mesh_at(m);
        const uint32_t n = mesh->vertex_count;
        assert_int_equal(to->vertex_count, n);
        assert_int_equal(to->triangle_count, mesh->triangle_count);
        assert_int_equal(to->moving, 0);
        expect_at(to->positions, mesh->positions, (size_t)12 * n);
        expect_at(to->normals, mesh->normals, (size_t)6 * n);
        expect_at(to->triangles, mesh->triangles, (size_t)6 * mesh->triangle_count);
        expect_at(to->ramp, mesh->materials->ramp, 256);
        assert_int_equal(to->uvs != 0, m > 0);
        assert_int_equal(to->colours != 0, m == 3);
        if (m > 0) {
            expect_at(to->uvs, mesh->uvs, (size_t)8 * n);
        }
    }
    expect_at(mesh_at(3)->colours, asset->model.meshes[3].colours, 6);
    assert_int_equal(mesh_at(1)->ramp, mesh_at(0)->ramp);
    assert_int_equal(mesh_at(2)->texture.texels, mesh_at(1)->texture.texels);
    assert_int_equal(mesh_at(3)->alphas.texels, mesh_at(1)->alphas.texels);
}

static void surfaces_are_those_of_the_materials(void **state)
{
    (void)state;
    static const uint8_t shadings[] = {SCENE_FILE_GOURAUD, SCENE_FILE_TEXTURE_LIT, SCENE_FILE_TEXTURE,
                                       SCENE_FILE_UNLIT},
                         blends[] = {SCENE_FILE_OPAQUE, SCENE_FILE_ALPHA, SCENE_FILE_ADD, SCENE_FILE_ALPHA},
                         alphas[] = {0, 20, 30, 20};
    asset = made_asset(false);
    write_scene();
    for (uint32_t m = 0; m < MADE_MESHES; m++) {
        const struct ph_material *const from = made_material(m);
        const struct scene_file_mesh *const to = mesh_at(m);
        assert_int_equal(to->shading, shadings[m]);
        assert_int_equal(to->blend, blends[m]);
        assert_int_equal(to->alpha, alphas[m]);
        assert_int_equal(to->two_sided, m == 3);
        assert_int_equal(to->shininess_log2, from->shininess_log2);
        assert_int_equal(to->depth_bias, from->depth_bias);
        assert_int_equal(to->ambient, from->ambient);
        assert_int_equal(to->diffuse, from->diffuse);
        assert_int_equal(to->specular, from->specular);
        assert_int_equal(to->colour, from->colour);
        assert_int_equal(to->texture.texels != 0, m == 1 || m == 2);
        assert_int_equal(to->alphas.texels != 0, m == 1 || m == 3);
    }
    made_blend(1)->kind = PH_BLEND_MASK;
    made_blend(2)->kind = PH_BLEND_TIMES;
    write_scene();
    assert_int_equal(mesh_at(3)->blend, SCENE_FILE_MASK);
    assert_int_equal(mesh_at(2)->blend, SCENE_FILE_TIMES);
    static const struct ph_shading *const known[] = {PH_SHADE_FLAT, PH_SHADE_TEXTURE_GOURAUD};
    for (int i = 0; i < 2; i++) {
        made_material(1)->shading = known[i];
        write_scene();
        assert_int_equal(mesh_at(1)->shading, i == 0 ? SCENE_FILE_FLAT : SCENE_FILE_TEXTURE_GOURAUD);
    }
}

/* Wrap, filter and levels; and the texels of the levels: 16, 4 and 1. */
static void textures_come_with_their_levels(void **state)
{
    (void)state;
    asset = made_asset(false);
    write_scene();
    const struct scene_file_texture *const t = &mesh_at(2)->texture, *const a = &mesh_at(3)->alphas;
    expect_at(t->texels, made_material(1)->texture->texels, 42);
    assert_memory_equal(&t->log2_width, "\2\2\0\2\2\0\0\0", 8); /* repeated, PH_FILTER_MIPMAP */
    expect_at(a->texels, made_blend(3)->alphas->texels, 16);
    assert_memory_equal(&a->log2_width, "\1\2\1\1\0\0\0\0", 8); /* clamped, PH_FILTER_BILINEAR */
    static const uint8_t wraps[] = {PH_WRAP_REPEAT, PH_WRAP_CLAMP, PH_WRAP_CLAMP_V, PH_WRAP_CLAMP_U};
    for (uint8_t number = SCENE_FILE_REPEAT; number <= SCENE_FILE_CLAMP_U; number++) {
        assert_int_equal(scene_file_wrap(number), wraps[number]);
        assert_int_equal(scene_file_wrap(wraps[number]), number);
    }
}

static void what_moves_is_written_with_its_mesh(void **state)
{
    (void)state;
    asset = made_asset(true);
    const struct scene_file_head *const head = write_scene();
    const struct scene_file_moving *moving[MADE_MOVING];
    assert_int_equal(mesh_at(1)->moving, 0);
    for (uint32_t i = 0; i < MADE_MOVING; i++) {
        const struct animation_mesh *const from = made_moving(i);
        const struct scene_file_mesh *const mesh = mesh_at(from->mesh);
        const struct scene_file_moving *const to = moving[i] = scene_file_at(head, mesh->moving);
        const uint32_t n = from->bound.vertex_count, targets = from->morph.target_count;
        assert_non_null(to);
        expect_at(mesh->positions, from->bound.positions, (size_t)6 * n);
        expect_at(to->joints, from->skin.nodes, 2 * (size_t)from->skin.joint_count);
        expect_at(to->inverse_bind, from->skin.inverse_bind, 48 * (size_t)from->skin.joint_count);
        assert_int_equal(to->joint_count, from->skin.joint_count);
        assert_int_equal(to->target_count, targets);
        assert_int_equal(to->first_weight, from->first_weight);
        assert_int_equal(to->frac, from->bound.frac);
        assert_int_equal(to->influences != 0, i == 0);
        assert_int_equal(to->targets != 0, i > 0);
        assert_int_equal(to->target_normals != 0, i == 1);
        if (i > 0) {
            expect_at(to->targets, from->morph.d_positions, (size_t)6 * n * targets);
        }
    }
    expect_at(moving[0]->influences, made_moving(0)->bound.influences, 3 * 12);
    expect_at(moving[1]->target_normals, made_moving(1)->morph.d_normals, 6 * 5 * 2);
    assert_int_equal(moving[2]->joints, moving[0]->joints); /* the same skin */
    assert_int_equal(moving[2]->inverse_bind, moving[0]->inverse_bind);
}

static void a_rig_and_its_clips_are_written(void **state)
{
    (void)state;
    asset = made_asset(true);
    const struct scene_file_head *const head = write_scene();
    const struct scene_file_motion *const to = scene_file_at(head, head->motion);
    const struct model_motion *const from = asset->model.motion;
    const struct animation *const a = &from->animation;
    expect_at(to->nodes, a->rig.nodes, 3 * sizeof *a->rig.nodes);
    expect_at(to->rest_weights, a->rest_weights, 12);
    assert_int_equal(to->node_count, 3);
    assert_int_equal(to->weight_count, 3);
    assert_int_equal(to->clip_count, 2);
    assert_int_equal(to->playing, 1);
    assert_int_equal(to->cross_fade, 12345);
    assert_memory_equal(to->r, a->root.r, sizeof to->r);
    assert_true(to->t[0] == a->root.t.x && to->t[1] == a->root.t.y && to->t[2] == a->root.t.z);
    const struct scene_file_clip *const clips = scene_file_at(head, to->clips);
    for (uint32_t c = 0; c < MADE_CLIPS; c++) {
        const struct ph_clip *const clip = &from->animation.clips[c];
        assert_string_equal(clips[c].name, clip->name);
        assert_int_equal(clips[c].track_count, clip->track_count);
        assert_int_equal(clips[c].duration, clip->duration);
        for (uint32_t k = 0; k < clip->track_count; k++) {
            const struct scene_file_track *const t =
                (const struct scene_file_track *)scene_file_at(head, clips[c].tracks) + k;
            const struct ph_track *const f = &clip->tracks[k];
            const size_t numbers = (size_t)f->key_count * f->width * (f->interpolation == PH_KEYS_CUBIC ? 3 : 1);
            assert_true(t->node == f->node && t->key_count == f->key_count && t->path == f->path &&
                        t->interpolation == f->interpolation && t->width == f->width && t->frac == f->frac);
            expect_at(t->times, f->times, sizeof(fx_t) * f->key_count);
            expect_at(t->keys, f->keys, 2 * numbers);
            assert_int_equal(k > 0 && t->times == t[-1].times, c == 1 && k == 1); /* two tracks share theirs */
        }
    }
}

static void clips_that_take_turns_are_a_flag_of_the_head(void **state)
{
    (void)state;
    asset = made_asset(true);
    const uint32_t flags = write_scene()->flags;
    asset->model.motion->animation.in_turn = true;
    assert_int_equal(write_scene()->flags, flags | SCENE_FILE_IN_TURN);
    assert_null(scene_file_wrong(bytes, size));
    assert_int_equal(flags & SCENE_FILE_IN_TURN, 0);
}

/* 39 characters of a name stay; a model whose first clip plays. */
static void a_long_name_of_a_clip_is_cut(void **state)
{
    (void)state;
    asset = made_asset(true);
    struct ph_clip *const clips = (struct ph_clip *)(uintptr_t)asset->model.motion->animation.clips;
    clips[1].name = "a name that is longer than 40 characters of text";
    asset->model.motion->animation.clip = &clips[0];
    const struct scene_file_head *const head = write_scene();
    const struct scene_file_motion *const to = scene_file_at(head, head->motion);
    assert_null(scene_file_wrong(bytes, size));
    assert_string_equal(((const struct scene_file_clip *)scene_file_at(head, to->clips))[1].name,
                        "a name that is longer than 40 character");
    assert_int_equal(to->playing, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(a_scene_can_be_drawn_and_has_no_byte_too_many, drop),
        cmocka_unit_test_teardown(the_head_says_what_the_demo_needs, drop),
        cmocka_unit_test_teardown(a_camera_is_written_where_the_model_has_one, drop),
        cmocka_unit_test_teardown(arrays_are_those_of_the_meshes, drop),
        cmocka_unit_test_teardown(surfaces_are_those_of_the_materials, drop),
        cmocka_unit_test_teardown(textures_come_with_their_levels, drop),
        cmocka_unit_test_teardown(what_moves_is_written_with_its_mesh, drop),
        cmocka_unit_test_teardown(a_rig_and_its_clips_are_written, drop),
        cmocka_unit_test_teardown(clips_that_take_turns_are_a_flag_of_the_head, drop),
        cmocka_unit_test_teardown(a_long_name_of_a_clip_is_cut, drop),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
