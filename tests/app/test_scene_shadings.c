/*
 * A program that lists fewer shadings and filters than a binary scene may name: its own lists take the places of those
 * that are linked otherwise. It draws the scenes that do with these, and refuses the others with the name of what it
 * lacks.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "crc32.h"
#include "scene_file.h"

#include <string.h>

const struct scene_file_shading scene_file_shadings[SCENE_FILE_SHADINGS] = {
    [SCENE_FILE_UNLIT] = {.is_there = true, .shading = PH_SHADE_UNLIT},
    [SCENE_FILE_FLAT] = {.lacks = "no flat"},
    [SCENE_FILE_GOURAUD] = {.is_there = true, .shading = PH_SHADE_GOURAUD},
    [SCENE_FILE_TEXTURE] = {.is_there = true, .shading = PH_SHADE_TEXTURE},
    [SCENE_FILE_TEXTURE_LIT] = {.lacks = "no texture-lit"},
    [SCENE_FILE_TEXTURE_GOURAUD] = {.lacks = "no texture-gouraud"},
};

const struct scene_file_filter scene_file_filters[SCENE_FILE_FILTERS] = {
    [SCENE_FILE_NEAREST] = {.is_there = true, .filter = PH_FILTER_NEAREST},
    [SCENE_FILE_BILINEAR] = {.is_there = true, .filter = PH_FILTER_BILINEAR},
    [SCENE_FILE_MIPMAP] = {.lacks = "no mipmap"},
};

/* Two meshes of one triangle. */
static struct {
    struct scene_file_head head;
    struct scene_file_mesh meshes[2];
    struct fx_vec3 positions[3];
    fx_t uvs[3][2];
    int16_t normals[3][3], spare;
    uint16_t triangle[3], also_spare;
    uint16_t ramp[PH_RAMP_SIZE], texels[2];
} scene;

#define OFFSET(member) ((uint32_t)((const uint8_t *)scene.member - (const uint8_t *)&scene))

static void seal(void)
{
    scene.head.crc = crc32_update(0, (const uint8_t *)&scene + 16, sizeof scene - 16);
}

static void make(uint8_t first, uint8_t second)
{
    scene.head = (struct scene_file_head){.magic = SCENE_FILE_MAGIC,
                                          .version = SCENE_FILE_VERSION,
                                          .bytes = sizeof scene,
                                          .mesh_count = 2,
                                          .vertex_max = 8,
                                          .triangle_max = 8,
                                          .name = "two triangles"};
    memcpy(scene.triangle, (const uint16_t[]){0, 1, 2}, sizeof scene.triangle);
    for (int i = 0; i < 2; i++) {
        const uint8_t shading = i == 0 ? first : second;
        const bool textured = shading >= SCENE_FILE_TEXTURE;
        scene.meshes[i] = (struct scene_file_mesh){.positions = OFFSET(positions),
                                                   .normals = OFFSET(normals),
                                                   .uvs = textured ? OFFSET(uvs) : 0,
                                                   .triangles = OFFSET(triangle),
                                                   .ramp = OFFSET(ramp),
                                                   .vertex_count = 3,
                                                   .triangle_count = 1,
                                                   .diffuse = FX_ONE,
                                                   .texture.texels = textured ? OFFSET(texels) : 0,
                                                   .shading = shading};
    }
    seal();
}

static void scenes_in_the_listed_shadings_are_taken(void **state)
{
    (void)state;
    struct demo_arena arena;
    uint64_t room[128];
    make(SCENE_FILE_UNLIT, SCENE_FILE_GOURAUD);
    assert_null(scene_file_wrong(&scene, sizeof scene));
    arena = (struct demo_arena){(uint8_t *)room, sizeof room, 0};
    const struct ph_mesh *const meshes = scene_file_meshes(&scene, &arena);
    assert_non_null(meshes);
    assert_ptr_equal(meshes[0].materials->shading, PH_SHADE_UNLIT);
    assert_ptr_equal(meshes[1].materials->shading, PH_SHADE_GOURAUD);
}

static void a_scene_that_needs_another_shading_is_refused_with_its_name(void **state)
{
    (void)state;
    for (uint8_t i = 0; i < (uint8_t)SCENE_FILE_SHADINGS; i++) {
        const char *const lacks = scene_file_shadings[i].lacks;
        if (lacks != NULL) {
            make(SCENE_FILE_GOURAUD, i);
            assert_string_equal(scene_file_wrong(&scene, sizeof scene), lacks);
            make(i, SCENE_FILE_UNLIT);
            assert_string_equal(scene_file_wrong(&scene, sizeof scene), lacks);
        }
    }
}

static void a_scene_that_needs_another_filter_is_refused_with_its_name(void **state)
{
    (void)state;
    struct demo_arena arena;
    uint64_t room[128];
    make(SCENE_FILE_UNLIT, SCENE_FILE_TEXTURE);
    scene.meshes[1].texture.filter = SCENE_FILE_BILINEAR;
    scene.meshes[0].texture.filter = SCENE_FILE_MIPMAP; /* without texels it does not count */
    seal();
    assert_null(scene_file_wrong(&scene, sizeof scene));
    arena = (struct demo_arena){(uint8_t *)room, sizeof room, 0};
    const struct ph_mesh *const meshes = scene_file_meshes(&scene, &arena);
    assert_non_null(meshes);
    assert_ptr_equal(meshes[1].materials->texture->filter, PH_FILTER_BILINEAR);
    scene.meshes[1].texture.filter = SCENE_FILE_MIPMAP;
    seal();
    assert_string_equal(scene_file_wrong(&scene, sizeof scene), "no mipmap");
    make(SCENE_FILE_UNLIT, SCENE_FILE_UNLIT);
    scene.meshes[1].uvs = OFFSET(uvs);
    scene.meshes[1].blend = SCENE_FILE_MASK;
    scene.meshes[1].alphas = (struct scene_file_texture){.texels = OFFSET(texels), .filter = SCENE_FILE_MIPMAP};
    seal();
    assert_string_equal(scene_file_wrong(&scene, sizeof scene), "no mipmap");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(scenes_in_the_listed_shadings_are_taken),
        cmocka_unit_test(a_scene_that_needs_another_shading_is_refused_with_its_name),
        cmocka_unit_test(a_scene_that_needs_another_filter_is_refused_with_its_name),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
