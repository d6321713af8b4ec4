/* Binary scenes: what is damaged is refused, whatever the damage. */
#include "asset.h"
#include "crc32.h"
#include "flash_scene.h"
#include "model_files.h"
#include "model_texture.h"
#include "scene_file.h"

#include <assimp/cimport.h> /* tests/run.sh skips this program where a library is not installed */

#include <stdlib.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <cmocka.h>

static uint8_t *whole;
static size_t size;
static struct demo counted; /* by pinhole-asset */

static int make(void **state, const char *path)
{
    files_begin(state);
    struct asset asset;
    const struct asset_limits limits = {.triangles = UINT32_MAX, .texture_log2 = 3, .file_name = path};
    struct model *model = open_good(path);
    assert_int_equal(asset_make(&asset, model, &limits), 0);
    size = asset_scene(&asset, NULL);
    whole = calloc(1, size);
    assert_non_null(whole);
    assert_int_equal(asset_scene(&asset, whole), size);
    counted = asset_demo(&asset);
    counted.arena_bytes += asset_table_bytes(&asset, false);
    counted.arena_bytes_32 += (uint32_t)asset_table_bytes(&asset, true);
    asset_free(&asset);
    model_close(model);
    return 0;
}

/* Four meshes with a mask, a blend, vertex colours and a plain one, as bytes. */
static int make_scene(void **state)
{
    return make(state, "tests/host-sim/asset/surfaces.gltf");
}

/* Three meshes that move: with a skin, by a node, with morph targets; two clips. */
static int make_moving(void **state)
{
    return make(state, "tests/host-sim/asset/moving.gltf");
}

static int drop_scene(void **state)
{
    free(whole);
    return files_end(state);
}

static void seal(uint8_t *bytes)
{
    const uint32_t crc = crc32_update(0, bytes + 16, size - 16);
    memcpy(bytes + 12, &crc, sizeof crc);
}

static void its_checksum_is_that_of_ieee(void **state)
{
    (void)state;
    assert_int_equal(crc32_update(0, (const uint8_t *)"123456789", 9), 0xCBF43926);
}

/* On a 32-bit target, whose pointers are shorter, too: else the list of triangles would get the arena's memory. */
static void its_memory_is_what_the_tool_counted(void **state)
{
    (void)state;
    const struct demo demo = scene_file_demo(whole);
    assert_int_equal(demo.arena_bytes, counted.arena_bytes);
    assert_int_equal(demo.arena_bytes_32, counted.arena_bytes_32);
    assert_in_range(demo.arena_bytes_32, 1, demo.arena_bytes - 1);
}

static void every_bit_that_changed_is_seen(void **state)
{
    (void)state;
    assert_null(scene_file_wrong(whole, size));
    assert_null(scene_file_wrong(whole, size + 4096)); /* flash goes on behind it */
    for (size_t i = 0; i < size * 8; i++) {
        whole[i / 8] ^= (uint8_t)(1 << i % 8);
        assert_non_null(scene_file_wrong(whole, size));
        whole[i / 8] ^= (uint8_t)(1 << i % 8);
    }
}

static void what_is_cut_off_or_erased_is_seen(void **state)
{
    (void)state;
    for (size_t n = 0; n < size; n++) {
        uint8_t *part = malloc(n + 1);
        assert_non_null(part);
        memcpy(part, whole, n);
        assert_non_null(scene_file_wrong(part, n));
        free(part);
    }
    uint8_t *flash = malloc(size);
    assert_non_null(flash);
    for (size_t n = 0; n < size; n += 64) { /* an interrupted write: the rest is erased, or is an older scene's */
        memcpy(flash, whole, size);
        memset(flash + n, 0xFF, size - n);
        assert_non_null(scene_file_wrong(flash, size));
    }
    free(flash);
}

static uint16_t last_texel(const struct ph_texture *t)
{
    return t->texels[model_texture_texels(t, t->levels) - 1];
}

/* Reads what the renderer could read; the sanitizers see what lies outside. */
static void read_all(const struct ph_mesh *mesh)
{
    const struct ph_material *material = mesh->materials;
    volatile int64_t sum = material->ramp[127];
    for (uint32_t i = 0; i < mesh->triangle_count * 3; i++) {
        const uint16_t corner = mesh->triangles[i / 3][i % 3];
        assert_true(corner < mesh->vertex_count);
        sum += (int64_t)mesh->positions[corner].x + mesh->normals[corner][2];
        sum += mesh->uvs != NULL ? mesh->uvs[corner][1] : 0;
        sum += mesh->colours != NULL ? mesh->colours[corner] : 0;
    }
    assert_true((material->texture == NULL && (material->blend == NULL || material->blend->alphas == NULL)) ||
                mesh->uvs != NULL);
    sum += material->texture != NULL ? last_texel(material->texture) : 0;
    sum += material->blend != NULL && material->blend->alphas != NULL ? last_texel(material->blend->alphas) : 0;
    (void)sum;
}

/* Draws nothing, but moves what moves, through two seconds, in no more memory than the scene says. */
static void play(const uint8_t *bytes)
{
    struct demo_arena arena = {.size = scene_file_arena_bytes(bytes, false)};
    const struct scene_file_head *head = (const void *)bytes;
    if (arena.size > 1u << 24) { /* crafted: all meshes share one long list of vertices */
        return;
    }
    arena.base = malloc(arena.size + 1);
    assert_non_null(arena.base);
    const struct ph_mesh *meshes = scene_file_meshes(bytes, &arena);
    assert_non_null(meshes);
    if (head->motion != 0) {
        const struct animation *animation = scene_motion_make(head, &arena);
        assert_non_null(animation);
        const struct animation_stage *stage = animation_begin(&arena, animation, meshes, head->mesh_count);
        assert_non_null(stage);
        for (uint32_t frame = 0; frame < 60; frame += 19) {
            animation_move(stage, NULL, frame);
        }
        meshes = stage->meshes;
    }
    for (uint32_t m = 0; m < head->mesh_count; m++) {
        read_all(&meshes[m]);
    }
    free(arena.base);
}

/* With the right checksum, every number of the scene is set to numbers that cannot be. */
static void no_number_leads_out_of_the_scene(void **state)
{
    static const uint32_t wrong[] = {0, 1, 2, 4, 0x7FFFFFFC, 0x80000000, 0xFFFFFFFC, 0xFFFFFFFF};
    uint8_t *bytes = malloc(size);
    (void)state;
    assert_non_null(bytes);
    for (size_t at = 8; at + 4 <= size; at += 4) {
        for (size_t k = 0; k < sizeof wrong / sizeof wrong[0]; k++) {
            memcpy(bytes, whole, size);
            memcpy(bytes + at, &wrong[k], 4);
            seal(bytes);
            if (scene_file_wrong(bytes, size) == NULL) { /* then all that it names can be read */
                play(bytes);
            }
        }
    }
    free(bytes);
}

static void a_corner_that_is_not_there_is_seen(void **state)
{
    (void)state;
    uint8_t *bytes = malloc(size);
    assert_non_null(bytes);
    memcpy(bytes, whole, size);
    const struct scene_file_mesh *mesh = (const void *)(bytes + sizeof(struct scene_file_head));
    const uint16_t corner = (uint16_t)mesh->vertex_count;
    memcpy(bytes + mesh->triangles, &corner, sizeof corner);
    seal(bytes);
    assert_string_equal(scene_file_wrong(bytes, size), "is broken: a mesh is not inside it");
    free(bytes);
}

/* pinhole-flash --at-scene writes its sectors and no other; a scene is refused as the image would refuse it. */
static void it_becomes_an_image_behind_the_programs(void **state)
{
    (void)state;
    struct flash_image image;
    char error[FLASH_ERROR_SIZE];
    assert_int_equal(flash_scene_read(&image, file_bytes("scene.phs", whole, size), error), 0);
    assert_int_equal(image.sectors, FLASH_SCENE / FLASH_SECTOR + (size + FLASH_SECTOR - 1) / FLASH_SECTOR);
    assert_memory_equal(image.bytes + FLASH_SCENE, whole, size);
    for (uint32_t i = 0; i < image.sectors; i++) {
        assert_int_equal(image.used[i], i >= FLASH_SCENE / FLASH_SECTOR);
    }
    flash_image_free(&image);
    assert_true(flash_scene_read(&image, file_bytes("half.phs", whole, size / 2), error) < 0);
    assert_string_equal(error, "is not whole, or too large");
    assert_true(flash_scene_read(&image, file_path("none.phs"), error) < 0);
    assert_non_null(strstr(error, "cannot be read"));
}

/* A number of the animation that leads out of the scene. Its place is found in the whole scene. */
static void is_refused(const void *number, size_t width, uint32_t wrong)
{
    uint8_t *const at = whole + ((const uint8_t *)number - whole);
    uint32_t right = 0;
    memcpy(&right, at, width);
    memcpy(at, &wrong, width);
    seal(whole);
    assert_string_equal(scene_file_wrong(whole, size), "is broken: its animation is not inside it");
    memcpy(at, &right, width);
    seal(whole);
    assert_null(scene_file_wrong(whole, size));
}

static const struct scene_file_motion *motion_of_whole(void)
{
    return (const void *)(whole + ((const struct scene_file_head *)(const void *)whole)->motion);
}

static void a_clip_outside_of_it_is_seen(void **state)
{
    (void)state;
    const struct scene_file_motion *const motion = motion_of_whole();
    const struct scene_file_clip *const clip = (const void *)(whole + motion->clips);
    const struct scene_file_track *const track = (const void *)(whole + clip->tracks);
    assert_true(clip->track_count > 0 && track->path == PH_PATH_ROTATION);
    is_refused(&motion->playing, 4, motion->clip_count);
    is_refused(&clip->time_shift, 4, 16);
    is_refused(&clip->duration, 4, UINT32_MAX);
    is_refused(&track->node, 2, motion->node_count);
    is_refused(&track->width, 1, 3);
    is_refused(&track->interpolation, 1, PH_KEYS_CUBIC + 1);
    is_refused(&track->frac, 1, 7);
    is_refused(&track->frac, 1, 25);
    is_refused(&track->key_count, 2, 60000);
}

static void a_skin_outside_of_it_is_seen(void **state)
{
    (void)state;
    const struct scene_file_motion *const motion = motion_of_whole();
    const struct scene_file_mesh *const mesh = (const void *)(whole + sizeof(struct scene_file_head));
    const struct scene_file_moving *const moving = (const void *)(whole + mesh[2].moving);
    const struct ph_rig_node *const node = (const void *)(whole + motion->nodes);
    const struct ph_influence *const influence = (const void *)(whole + moving->influences);
    const uint16_t *const joints = (const void *)(whole + moving->joints);
    assert_true(moving->influences != 0);
    is_refused(&node->parent, 2, 0);
    is_refused(&node->parent, 2, 0xFFFE);
    is_refused(&joints[moving->joint_count - 1], 2, motion->node_count);
    is_refused(&influence->joints[3], 1, moving->joint_count);
    is_refused(&moving->frac, 4, 11);
    is_refused(&moving->joint_count, 4, 257);
    is_refused(&moving->target_count, 4, motion->weight_count + 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(its_memory_is_what_the_tool_counted),     cmocka_unit_test(its_checksum_is_that_of_ieee),
        cmocka_unit_test(every_bit_that_changed_is_seen),          cmocka_unit_test(what_is_cut_off_or_erased_is_seen),
        cmocka_unit_test(no_number_leads_out_of_the_scene),        cmocka_unit_test(a_corner_that_is_not_there_is_seen),
        cmocka_unit_test(it_becomes_an_image_behind_the_programs),
    };
    const struct CMUnitTest moving[] = {
        cmocka_unit_test(its_memory_is_what_the_tool_counted), cmocka_unit_test(every_bit_that_changed_is_seen),
        cmocka_unit_test(what_is_cut_off_or_erased_is_seen),   cmocka_unit_test(no_number_leads_out_of_the_scene),
        cmocka_unit_test(a_clip_outside_of_it_is_seen),        cmocka_unit_test(a_skin_outside_of_it_is_seen),
    };
    return cmocka_run_group_tests(tests, make_scene, drop_scene) +
           cmocka_run_group_tests(moving, make_moving, drop_scene);
}
