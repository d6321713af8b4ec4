/* Binary scenes: what is damaged is refused, whatever the damage. */
#include "asset.h"
#include "crc32.h"
#include "flash_scene.h"
#include "model_files.h"
#include "model_texture.h"
#include "picture_in.h"
#include "scene_file.h"

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
    for (uint32_t m = 0; m < head->mesh_count; m++) {
        assert_true((scene_file_table(head)[m].moving != 0) == (meshes[m].bounds == NULL));
    }
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
    is_refused(&clip->duration, 4, UINT32_MAX);
    is_refused(&track->node, 2, motion->node_count);
    is_refused(&track->width, 1, 3);
    is_refused(&track->interpolation, 1, PH_KEYS_CUBIC + 1);
    is_refused(&track->frac, 1, 7);
    is_refused(&track->frac, 1, 25);
    is_refused(&track->key_count, 2, 60000);
}

/* What moves the first mesh of a scene that follows several joints. */
static const struct scene_file_moving *skinned_in(const uint8_t *bytes)
{
    const struct scene_file_mesh *mesh = (const void *)(bytes + sizeof(struct scene_file_head));
    while (mesh->moving == 0 ||
           ((const struct scene_file_moving *)(const void *)(bytes + mesh->moving))->influences == 0) {
        mesh++;
    }
    return (const void *)(bytes + mesh->moving);
}

static void a_skin_outside_of_it_is_seen(void **state)
{
    (void)state;
    const struct scene_file_motion *const motion = motion_of_whole();
    const struct scene_file_moving *const moving = skinned_in(whole);
    const struct ph_rig_node *const node = (const void *)(whole + motion->nodes);
    const struct ph_influence *const influence = (const void *)(whole + moving->influences);
    const uint16_t *const joints = (const void *)(whole + moving->joints);
    is_refused(&node->parent, 2, 0);
    is_refused(&node->parent, 2, 0xFFFE);
    is_refused(&joints[moving->joint_count - 1], 2, motion->node_count);
    is_refused(&influence->joints[3], 1, moving->joint_count);
    is_refused(&moving->frac, 1, 11);
    is_refused(&moving->frac, 1, 25);
    is_refused(&moving->scales_axes, 1, 2);
    is_refused(&moving->spare, 2, 1);
    is_refused(&motion->outline, 4, 4);
    is_refused(&motion->outline_count, 4, 1 << 28);
    is_refused(&moving->joint_count, 4, 257);
    is_refused(&moving->target_count, 4, motion->weight_count + 1);
}

/* ---- what is inside, and wrong ---- */

/* The first mesh with a texture, or with alphas, or the first one. */
enum which { ANY, TEXTURED, MASKED, OPAQUE };

static struct scene_file_mesh *mesh_in(uint8_t *bytes, enum which which)
{
    const struct scene_file_head *const head = (const void *)bytes;
    struct scene_file_mesh *const table = (void *)(bytes + sizeof *head);
    for (uint32_t i = 0; i < head->mesh_count; i++) {
        if (which == ANY || (which == TEXTURED && table[i].texture.texels != 0) ||
            (which == MASKED && table[i].blend == SCENE_FILE_MASK) ||
            (which == OPAQUE && table[i].blend == SCENE_FILE_OPAQUE)) {
            return &table[i];
        }
    }
    fail_msg("no such mesh");
    return table;
}

/* Copies the whole scene, with a camera that is right. */
static struct scene_file_head *copy_with_camera(uint8_t *bytes)
{
    struct scene_file_head *const head = (void *)bytes;
    memcpy(bytes, whole, size);
    head->flags = SCENE_FILE_CAMERA;
    memset(head->r, 0, sizeof head->r);
    head->r[0][0] = head->r[1][1] = head->r[2][2] = 1 << 30;
    head->lens_kind = PH_PERSPECTIVE;
    head->scale_x_q20 = head->scale_y_q20 = 2 << 20;
    head->near_z = FX_ONE;
    head->far_z = 100 * FX_ONE;
    return head;
}

/* NOLINTBEGIN(readability-non-const-parameter): all kinds are functions of one type. */
/* Each breaks one thing of a scene that has a camera; line: how it is refused, or NULL: it is meant. */
#define KIND(what, line, statement)                                                                                    \
    static void what(uint8_t *bytes, struct scene_file_head *head)                                                     \
    {                                                                                                                  \
        (void)bytes, (void)head;                                                                                       \
        statement;                                                                                                     \
    }                                                                                                                  \
    static const char *const what##_line = line;

#define CAMERA  "is broken: it cannot be seen through its camera"
#define SURFACE "is broken: the surface of a mesh is none that can be drawn"
#define PLAYED  "is broken: its animation cannot be played"
#define INSIDE  "is broken: a mesh is not inside it"
#define NO_NAME "is broken: its name is no text"
#define NO_FLAG "is broken: it has unknown flags"
#define NO_LAMP "is broken: its lamp is none"

KIND(an_unknown_flag, NO_FLAG, head->flags |= 16)
KIND(a_name_without_an_end, NO_NAME, memset(head->name, 'x', SCENE_FILE_NAME))
KIND(a_name_that_moves_the_cursor, NO_NAME, memcpy(head->name, "\033[2J", 5))
KIND(no_mesh, "has no mesh", head->mesh_count = 0)
KIND(another_lens, CAMERA, head->lens_kind = PH_FISHEYE)
KIND(a_near_plane_behind_the_far_one, CAMERA, head->near_z = head->far_z)
KIND(a_near_plane_in_the_eye, CAMERA, head->near_z = 0)
KIND(a_lens_without_a_scale, CAMERA, head->scale_y_q20 = 0)
KIND(a_lens_of_a_telescope, CAMERA, head->scale_x_q20 = INT32_MAX)
KIND(a_camera_that_scales, CAMERA, head->r[1][1] = INT32_MAX)
KIND(a_camera_without_directions, CAMERA, memset(head->r, 0, sizeof head->r))
KIND(a_camera_that_is_mirrored, CAMERA, head->r[0][0] = -(1 << 30))
KIND(a_camera_that_shears, CAMERA, head->r[0][1] = 1 << 29)
KIND(a_camera_that_shears_the_other_way, CAMERA, head->r[0][1] = -(1 << 29))
KIND(a_surface_of_three_sides, SURFACE, mesh_in(bytes, ANY)->two_sided = 2)
KIND(light_below_zero, SURFACE, mesh_in(bytes, ANY)->diffuse = -1)
KIND(light_above_one, SURFACE, mesh_in(bytes, ANY)->specular = FX_ONE + 1)
KIND(alpha_above_one, SURFACE, mesh_in(bytes, ANY)->alpha = 33)
KIND(an_unknown_blend, SURFACE, mesh_in(bytes, ANY)->blend = SCENE_FILE_TIMES + 1)
KIND(a_shading_between_others_that_is_none, SURFACE, mesh_in(bytes, OPAQUE)->shading = SCENE_FILE_TEXTURE_LIT + 1)
KIND(a_mask_that_is_not_there, SURFACE, mesh_in(bytes, OPAQUE)->blend = SCENE_FILE_MASK)
KIND(a_mask_that_is_not_used, SURFACE, mesh_in(bytes, MASKED)->blend = SCENE_FILE_OPAQUE)
KIND(a_texture_that_is_not_used, INSIDE, mesh_in(bytes, TEXTURED)->shading = SCENE_FILE_GOURAUD)
KIND(a_texture_of_other_sizes, INSIDE, mesh_in(bytes, TEXTURED)->texture.log2_width = 10)
KIND(more_levels_than_sides, INSIDE, mesh_in(bytes, TEXTURED)->texture.levels = 10)
KIND(a_reserved_byte, INSIDE, mesh_in(bytes, TEXTURED)->texture.spare[2] = 1)

static uint16_t *corners_in(uint8_t *bytes)
{
    return (void *)(bytes + mesh_in(bytes, ANY)->triangles);
}

static int16_t *normals_in(uint8_t *bytes)
{
    return (void *)(bytes + mesh_in(bytes, ANY)->normals);
}

KIND(no_room_for_vertices, NULL, head->vertex_max = 0)
KIND(a_camera_on_bare_ground, NULL, head->flags |= SCENE_FILE_BARE)
KIND(a_lens_that_nobody_looks_through, NULL, (head->flags = 0, head->near_z = -1))
KIND(an_empty_name, NULL, head->name[0] = '\0')
KIND(a_mesh_without_triangles, NULL, mesh_in(bytes, ANY)->triangle_count = 0)
KIND(equal_corners, NULL, corners_in(bytes)[1] = corners_in(bytes)[0])
KIND(a_normal_of_length_0, NULL, memset(normals_in(bytes), 0, sizeof(int16_t[3])))
KIND(a_normal_of_length_2, NULL, normals_in(bytes)[0] = INT16_MAX)
KIND(a_position_far_away, NULL, *(int32_t *)(void *)(bytes + mesh_in(bytes, OPAQUE)->positions) = INT32_MIN)
KIND(nothing_of_a_mesh_shows, NULL, mesh_in(bytes, MASKED)->alpha = 0)

/* Writes a studio where the first mesh has its data. */
static void put_studio(struct scene_file_head *head, uint16_t has_lamp, fx_t up)
{
    const struct demo_studio studio = {.has_lamp = has_lamp, .to_lamp_q30 = {0, up, 0}};
    head->flags |= SCENE_FILE_STUDIO;
    memcpy((uint8_t *)head + scene_file_studio(head), &studio, sizeof studio);
}

KIND(a_lamp_without_a_direction, NO_LAMP, put_studio(head, 1, 0))
KIND(a_lamp_that_is_too_bright, NO_LAMP, put_studio(head, 1, INT32_MAX))
KIND(two_lamps, NO_LAMP, put_studio(head, 2, 1 << 30))
KIND(a_lamp_above, NULL, put_studio(head, 1, 1 << 30))
KIND(no_lamp, NULL, put_studio(head, 0, 0))

struct kind {
    const char *name;
    void (*change)(uint8_t *bytes, struct scene_file_head *head);
    const char *const *line;
};
#define ROW(what)                                                                                                      \
    {                                                                                                                  \
#what, what, &what##_line                                                                                      \
    }

static void check_kinds(const struct kind *kinds, size_t count)
{
    uint8_t *const bytes = malloc(size);
    assert_non_null(bytes);
    copy_with_camera(bytes);
    seal(bytes);
    assert_null(scene_file_wrong(bytes, size));
    for (size_t i = 0; i < count; i++) {
        kinds[i].change(bytes, copy_with_camera(bytes));
        seal(bytes);
        const char *const wrong = scene_file_wrong(bytes, size), *const line = *kinds[i].line;
        if ((wrong == NULL) != (line == NULL) || (line != NULL && strcmp(line, wrong) != 0)) {
            fail_msg("%s: \"%s\"", kinds[i].name, wrong != NULL ? wrong : "is drawn");
        }
        if (wrong == NULL) {
            play(bytes);
        }
    }
    free(bytes);
}

static void each_kind_of_wrong_content_is_refused_or_is_meant(void **state)
{
    static const struct kind kinds[] = {ROW(an_unknown_flag),
                                        ROW(a_lamp_without_a_direction),
                                        ROW(a_lamp_that_is_too_bright),
                                        ROW(two_lamps),
                                        ROW(a_lamp_above),
                                        ROW(no_lamp),
                                        ROW(a_name_without_an_end),
                                        ROW(a_name_that_moves_the_cursor),
                                        ROW(no_mesh),
                                        ROW(another_lens),
                                        ROW(a_near_plane_behind_the_far_one),
                                        ROW(a_near_plane_in_the_eye),
                                        ROW(a_lens_without_a_scale),
                                        ROW(a_lens_of_a_telescope),
                                        ROW(a_camera_that_scales),
                                        ROW(a_camera_without_directions),
                                        ROW(a_camera_that_is_mirrored),
                                        ROW(a_camera_that_shears),
                                        ROW(a_camera_that_shears_the_other_way),
                                        ROW(a_surface_of_three_sides),
                                        ROW(light_below_zero),
                                        ROW(light_above_one),
                                        ROW(alpha_above_one),
                                        ROW(an_unknown_blend),
                                        ROW(a_shading_between_others_that_is_none),
                                        ROW(a_mask_that_is_not_there),
                                        ROW(a_mask_that_is_not_used),
                                        ROW(a_texture_that_is_not_used),
                                        ROW(a_texture_of_other_sizes),
                                        ROW(more_levels_than_sides),
                                        ROW(a_reserved_byte),
                                        ROW(no_room_for_vertices),
                                        ROW(a_camera_on_bare_ground),
                                        ROW(a_lens_that_nobody_looks_through),
                                        ROW(an_empty_name),
                                        ROW(a_mesh_without_triangles),
                                        ROW(equal_corners),
                                        ROW(a_normal_of_length_0),
                                        ROW(a_normal_of_length_2),
                                        ROW(a_position_far_away),
                                        ROW(nothing_of_a_mesh_shows)};
    (void)state;
    if (strstr(png_in_reason, "without libpng") != NULL) { /* then the scene has no texture */
        skip();
    }
    check_kinds(kinds, sizeof kinds / sizeof kinds[0]);
}

/* ---- ... of what moves ---- */

static struct scene_file_motion *motion_in(uint8_t *bytes)
{
    return (void *)(bytes + ((const struct scene_file_head *)(const void *)bytes)->motion);
}

static struct scene_file_clip *clip_in(uint8_t *bytes)
{
    return (void *)(bytes + motion_in(bytes)->clips);
}

/* The first track of the first clip; it is a rotation. */
static struct scene_file_track *track_in(uint8_t *bytes)
{
    return (void *)(bytes + clip_in(bytes)->tracks);
}

static fx_t *times_in(uint8_t *bytes)
{
    assert_true(track_in(bytes)->key_count >= 2);
    return (void *)(bytes + track_in(bytes)->times);
}

static struct ph_rig_node *nodes_in(uint8_t *bytes)
{
    return (void *)(bytes + motion_in(bytes)->nodes);
}

static struct ph_influence *influence_in(uint8_t *bytes)
{
    return (void *)(bytes + skinned_in(bytes)->influences);
}

KIND(times_that_fall, PLAYED, times_in(bytes)[0] = times_in(bytes)[1] + 1)
KIND(a_rotation_of_length_2, PLAYED, nodes_in(bytes)->rest.r = ((struct fx_quat){INT32_MAX, 0, 0, 0}))
KIND(a_rotation_of_length_0, PLAYED, nodes_in(bytes)->rest.r = ((struct fx_quat){0, 0, 0, 0}))
KIND(shares_below_one, PLAYED, influence_in(bytes)->weights[0]--)
KIND(shares_above_one, PLAYED, influence_in(bytes)->weights[3]++)
KIND(times_that_are_equal, NULL, times_in(bytes)[0] = times_in(bytes)[1])
KIND(a_clip_of_no_length, NULL, clip_in(bytes)->duration = 0)
KIND(a_track_without_keys, NULL, track_in(bytes)->key_count = 0)
KIND(a_key_of_length_0, NULL, memset(bytes + track_in(bytes)->keys, 0, sizeof(int16_t[4])))
KIND(no_clip, NULL, motion_in(bytes)->clip_count = 0)
KIND(a_node_of_no_size, NULL, nodes_in(bytes)->rest.s = ((struct fx_vec3){0, 0, 0}))
KIND(a_root_of_no_size, NULL, memset(motion_in(bytes)->r, 0, sizeof motion_in(bytes)->r))
/* NOLINTEND(readability-non-const-parameter) */

static void each_kind_of_wrong_motion_is_refused_or_is_meant(void **state)
{
    static const struct kind kinds[] = {ROW(times_that_fall),        ROW(a_rotation_of_length_2),
                                        ROW(a_rotation_of_length_0), ROW(shares_below_one),
                                        ROW(shares_above_one),       ROW(times_that_are_equal),
                                        ROW(a_clip_of_no_length),    ROW(a_track_without_keys),
                                        ROW(a_key_of_length_0),      ROW(no_clip),
                                        ROW(a_node_of_no_size),      ROW(a_root_of_no_size)};
    (void)state;
    check_kinds(kinds, sizeof kinds / sizeof kinds[0]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(its_memory_is_what_the_tool_counted),
        cmocka_unit_test(its_checksum_is_that_of_ieee),
        cmocka_unit_test(every_bit_that_changed_is_seen),
        cmocka_unit_test(what_is_cut_off_or_erased_is_seen),
        cmocka_unit_test(no_number_leads_out_of_the_scene),
        cmocka_unit_test(a_corner_that_is_not_there_is_seen),
        cmocka_unit_test(it_becomes_an_image_behind_the_programs),
        cmocka_unit_test(each_kind_of_wrong_content_is_refused_or_is_meant),
    };
    const struct CMUnitTest moving[] = {
        cmocka_unit_test(its_memory_is_what_the_tool_counted),
        cmocka_unit_test(every_bit_that_changed_is_seen),
        cmocka_unit_test(what_is_cut_off_or_erased_is_seen),
        cmocka_unit_test(no_number_leads_out_of_the_scene),
        cmocka_unit_test(a_clip_outside_of_it_is_seen),
        cmocka_unit_test(a_skin_outside_of_it_is_seen),
        cmocka_unit_test(each_kind_of_wrong_motion_is_refused_or_is_meant),
    };
    return cmocka_run_group_tests(tests, make_scene, drop_scene) +
           cmocka_run_group_tests(moving, make_moving, drop_scene);
}
