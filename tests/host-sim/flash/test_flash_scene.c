/* flash_scene: a file becomes an image at its place if it is a scene that can be drawn and has room. */
#define _XOPEN_SOURCE 700 /* truncate */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "files.h"
#include "flash_scene.h"
#include "made_asset.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define ROOM (0x1000000 - 0x80000) /* from the place of scenes to the end of the flash */

static uint8_t *scene;
static size_t size;
static struct flash_image image;
static char error[FLASH_ERROR_SIZE];

static int make_scene(void **state)
{
    const struct asset *const asset = made_asset(false);
    size = asset_scene(asset, NULL);
    scene = calloc(1, size);
    return scene == NULL || asset_scene(asset, scene) != size ? -1 : files_begin(state);
}

static int drop_scene(void **state)
{
    free(scene);
    return files_end(state);
}

static void refuse(const char *path, const char *reason)
{
    memset(&image, 0x55, sizeof image);
    assert_int_equal(flash_scene_read(&image, path, error), PH_ERR_INVAL);
    assert_string_equal(error, reason);
    assert_null(image.bytes);
    assert_int_equal(image.sectors, 0);
}

static void a_scene_lies_behind_the_programs(void **state)
{
    (void)state;
    assert_int_equal(flash_scene_read(&image, file_bytes("a.phs", scene, size), error), 0);
    assert_int_equal(image.chip, FLASH_ANY);
    assert_int_equal(image.size, size);
    assert_int_equal(image.sectors, 128 + (size + 4095) / 4096);
    for (uint32_t i = 0; i < image.sectors; i++) {
        assert_int_equal(image.used[i], i >= 128);
    }
    assert_memory_equal(image.bytes + 0x80000, scene, size);
    flash_image_free(&image);
}

static void what_is_no_scene_is_refused(void **state)
{
    (void)state;
    refuse(file_path("none"), "cannot be read: No such file or directory");
    refuse(file_bytes("empty", "", 0), "is no binary scene");
    refuse(file_bytes("part", scene, size - 1), "is not whole, or too large");
    scene[size - 1] ^= 1;
    refuse(file_bytes("broken", scene, size), "has a wrong checksum: write it again");
    scene[size - 1] ^= 1;
}

/* What follows a scene in its file is written, too, as far as the flash reaches. */
static void a_file_that_does_not_fit_is_refused(void **state)
{
    (void)state;
    const char *const path = file_bytes("long", scene, size);
    assert_int_equal(truncate(path, ROOM), 0);
    assert_int_equal(flash_scene_read(&image, path, error), 0);
    assert_int_equal(image.size, ROOM);
    assert_int_equal(image.sectors, 4096);
    flash_image_free(&image);
    assert_int_equal(truncate(path, ROOM + 1), 0);
    refuse(path, "is too large");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_scene_lies_behind_the_programs),
        cmocka_unit_test(what_is_no_scene_is_refused),
        cmocka_unit_test(a_file_that_does_not_fit_is_refused),
    };
    return cmocka_run_group_tests(tests, make_scene, drop_scene);
}
