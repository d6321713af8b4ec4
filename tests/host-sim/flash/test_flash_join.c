/* flash_join: the blocks of an image and of a scene are those that uf2_make makes; what does not fit is refused. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "flash_join.h"
#include "flash_uf2.h"
#include "made_asset.h"
#include "uf2_make.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PAGES = 40, BYTES = PAGES * 256, TABLE = 0x400, ENTRY = 0x500, TEXT = 0x600, PLACE = 0x80000 };

static uint8_t bin[PLACE + 256], blocks[UF2_BLOCK + 2 * sizeof bin];
static uint8_t *scene;
static size_t scene_n;
static char error[FLASH_ERROR_SIZE];

/* An image of so many bytes, whose binary information has this feature. */
static void make_image(uint32_t n, const char *feature)
{
    uf2_make_bin(bin, n, 7);
    memset(bin + 0x100, 0, 0x700);
    uf2_put(bin + 0x100, 0x7188ebf2);
    uf2_put(bin + 0x104, 0x10000000 + TABLE);
    uf2_put(bin + 0x108, 0x10000000 + TABLE + 4);
    uf2_put(bin + 0x110, 0xe71aa390);
    uf2_put(bin + TABLE, 0x10000000 + ENTRY);
    uf2_put(bin + ENTRY + 4, 0xa1f4b453);
    uf2_put(bin + ENTRY + 8, 0x10000000 + TEXT);
    strcpy((char *)bin + TEXT, feature);
    uf2_make(blocks + UF2_BLOCK, bin, n);
}

static int fresh(void **state)
{
    (void)state;
    make_image(BYTES, "takes a scene at 0x10080000");
    if (scene == NULL) {
        const struct asset *const asset = made_asset(false);
        scene_n = asset_scene(asset, NULL);
        scene = calloc(1, scene_n);
        assert_int_equal(asset_scene(asset, scene), scene_n);
        assert_int_not_equal(scene_n % 256, 0);
    }
    return 0;
}

static int drop_scene(void **state)
{
    (void)state;
    free(scene);
    return 0;
}

/* The image's file begins at `first`; its blocks have this family. */
static void expect_joined(size_t first, uint32_t family)
{
    const uint32_t pages = (uint32_t)(scene_n + 255) / 256;
    uint8_t *const padded = calloc(pages, 256), *const expected = calloc(PAGES + pages, UF2_BLOCK);
    memcpy(padded, scene, scene_n);
    memcpy(expected, blocks + UF2_BLOCK, PAGES * UF2_BLOCK);
    uf2_make(expected + (size_t)PAGES * UF2_BLOCK, padded, pages * 256);
    for (uint32_t i = 0; i < PAGES + pages; i++) {
        uint8_t *const at = expected + (size_t)i * UF2_BLOCK;
        uf2_put(at + UF2_NUMBER, i);
        uf2_put(at + UF2_TOTAL, PAGES + pages);
        uf2_put(at + UF2_FAMILY, family);
        uf2_put(at + UF2_ADDRESS, i < PAGES ? 0x10000000 + 256 * i : 0x10080000 + 256 * (i - PAGES));
    }
    size_t n = 0;
    uint8_t *const joined =
        flash_join(blocks + first, (PAGES + 1) * UF2_BLOCK - first, scene, scene_n, 1 << 21, &n, error);
    assert_non_null(joined);
    assert_int_equal(n, (PAGES + 1 + pages) * UF2_BLOCK - first);
    assert_memory_equal(joined, blocks + first, UF2_BLOCK - first);
    assert_memory_equal(joined + UF2_BLOCK - first, expected, (size_t)(PAGES + pages) * UF2_BLOCK);
    struct flash_image image;
    assert_int_equal(flash_uf2_parse(&image, joined, n, error), 0);
    assert_memory_equal(image.bytes, bin, 256);
    assert_memory_equal(image.bytes + PLACE, scene, scene_n);
    flash_image_free(&image);
    free(joined);
    free(expected);
    free(padded);
}

static void a_scene_lies_behind_its_image(void **state)
{
    (void)state;
    expect_joined(UF2_BLOCK, 0xE48BFF56);
}

/* The block against erratum E10 stays the first of two, and the scene is of the image's family. */
static void an_image_for_an_rp2350_keeps_its_first_block(void **state)
{
    (void)state;
    uf2_put(bin, 0xFFFFDED3);
    uf2_for_rp2350(blocks + UF2_BLOCK, PAGES);
    expect_joined(UF2_BLOCK, 0xE48BFF59);
    uf2_make_e10(blocks);
    expect_joined(0, 0xE48BFF59);
    for (uint32_t i = 1; i <= PAGES; i++) {
        uf2_put(blocks + i * UF2_BLOCK + UF2_FAMILY, 0xE48BFF5A);
    }
    expect_joined(0, 0xE48BFF5A);
}

/* A block that boot loaders pass over may be the last one of a file; the scene's blocks are for the flash all the same.
 */
static void a_block_that_is_not_for_the_flash_may_come_last(void **state)
{
    (void)state;
    uf2_put(blocks + PAGES * UF2_BLOCK + UF2_FLAGS, 0x2001);
    expect_joined(UF2_BLOCK, 0xE48BFF56);
}

static void refuse(const uint8_t *uf2, size_t n, size_t bytes, uint32_t flash_bytes, const char *reason)
{
    size_t joined_n = 0;
    assert_null(flash_join(uf2, n, scene, bytes, flash_bytes, &joined_n, error));
    assert_string_equal(error, reason);
}

static void what_does_not_go_together_is_refused(void **state)
{
    (void)state;
    const uint8_t *const uf2 = blocks + UF2_BLOCK;
    const size_t n = (size_t)PAGES * UF2_BLOCK;
    char text[FLASH_ERROR_SIZE];
    refuse(bin, BYTES, scene_n, 1 << 21, "is no UF2 file: a scene goes into a UF2 image");
    refuse(uf2, n - 1, scene_n, 1 << 21, "truncated: 20479 bytes are no multiple of 512");
    refuse(uf2, n, scene_n - 1, 1 << 21, "the scene is not whole, or too large");
    snprintf(text, sizeof text,
             "the scene has %zu bytes, and the board's flash %zu for it; take fewer triangles, or smaller textures",
             scene_n, scene_n - 1);
    refuse(uf2, n, scene_n, (uint32_t)(PLACE + scene_n - 1), text);
    size_t joined_n = 0;
    uint8_t *const joined = flash_join(uf2, n, scene, scene_n, (uint32_t)(PLACE + scene_n), &joined_n, error);
    assert_non_null(joined); /* it just fits */
    free(joined);
    make_image(BYTES, "takes a scene at 0x10090000");
    refuse(uf2, n, scene_n, 1 << 21,
           "'' takes no scene at 0x10080000; an image of all demos does (make firmware BOARD=x)");
}

static void an_image_may_end_where_the_scene_begins(void **state)
{
    (void)state;
    size_t n = 0;
    make_image(PLACE, "takes a scene at 0x10080000");
    uint8_t *const joined = flash_join(blocks + UF2_BLOCK, 2 * PLACE, scene, scene_n, 1 << 21, &n, error);
    assert_non_null(joined);
    free(joined);
    make_image(PLACE + 256, "takes a scene at 0x10080000");
    refuse(blocks + UF2_BLOCK, 2 * (PLACE + 256), scene_n, 1 << 21,
           "the image ends at 0x10080fff, and the scene is to begin at 0x10080000");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(a_scene_lies_behind_its_image, fresh),
        cmocka_unit_test_setup(an_image_for_an_rp2350_keeps_its_first_block, fresh),
        cmocka_unit_test_setup(a_block_that_is_not_for_the_flash_may_come_last, fresh),
        cmocka_unit_test_setup(what_does_not_go_together_is_refused, fresh),
        cmocka_unit_test_setup(an_image_may_end_where_the_scene_begins, fresh),
    };
    return cmocka_run_group_tests(tests, NULL, drop_scene);
}
