/* See flash_join.h. */
#include "flash_join.h"

#include "flash_file.h"
#include "flash_program.h"
#include "flash_scene.h"
#include "flash_uf2.h"
#include "scene_file.h"

#include <stdlib.h>
#include <string.h>

enum { ADDRESS_AT = 12, NUMBER_AT = 20, TOTAL_AT = 24 }; /* in a block */

/* Is the UF2 file an image that shows a scene, with room for it? */
static int check_image(const uint8_t *uf2, size_t n, char *error)
{
    struct flash_image image;
    struct flash_program program;
    if (!flash_uf2_is(uf2, n)) {
        return flash_image_wrong(error, "is no UF2 file: a scene goes into a UF2 image");
    }
    const int status = flash_file_parse(&image, uf2, n, error);
    if (status != 0) {
        return status;
    }
    const uint32_t end = FLASH_BASE + image.sectors * FLASH_SECTOR;
    flash_program_find(&image, &program);
    flash_image_free(&image);
    if (!program.takes_scene) {
        return flash_image_wrong(error,
                                 "'%s' takes no scene at 0x%08x; an image of all demos does (make firmware BOARD=x)",
                                 program.name, FLASH_BASE + FLASH_SCENE);
    }
    if (end > FLASH_BASE + FLASH_SCENE) {
        return flash_image_wrong(error, "the image ends at 0x%08x, and the scene is to begin at 0x%08x", end - 1,
                                 FLASH_BASE + FLASH_SCENE);
    }
    return 0;
}

static int check_scene(const uint8_t *scene, size_t n, uint32_t flash_bytes, char *error)
{
    const char *const wrong = scene_file_wrong(scene, n);
    if (wrong != NULL) {
        return flash_image_wrong(error, "the scene %s", wrong);
    }
    if (n > flash_bytes - FLASH_SCENE) {
        return flash_image_wrong(
            error,
            "the scene has %zu bytes, and the board's flash %u for it; take fewer triangles, or smaller textures", n,
            flash_bytes - FLASH_SCENE);
    }
    return 0;
}

static void put_u32(uint8_t *to, uint32_t value)
{
    for (int i = 0; i < 4; i++) {
        to[i] = (uint8_t)(value >> (8 * i));
    }
}

/* Writes the scene's blocks, with a header like that of a block of the image. */
static void put_scene(uint8_t *to, const uint8_t *like, uint32_t number, const uint8_t *scene, size_t n)
{
    for (size_t at = 0; at < n; at += FLASH_PAGE, to += FLASH_UF2_BLOCK) {
        memcpy(to, like, FLASH_UF2_BLOCK);
        put_u32(to + ADDRESS_AT, FLASH_BASE + FLASH_SCENE + (uint32_t)at);
        put_u32(to + NUMBER_AT, number++);
        memset(to + FLASH_UF2_HEADER, 0, FLASH_PAGE);
        memcpy(to + FLASH_UF2_HEADER, scene + at, n - at < FLASH_PAGE ? n - at : FLASH_PAGE);
    }
}

uint8_t *flash_join(const uint8_t *uf2, size_t n, const uint8_t *scene, size_t scene_n, uint32_t flash_bytes,
                    size_t *joined_n, char *error)
{
    if (check_image(uf2, n, error) != 0 || check_scene(scene, scene_n, flash_bytes, error) != 0) {
        return NULL;
    }
    *joined_n = n + (scene_n + FLASH_PAGE - 1) / FLASH_PAGE * FLASH_UF2_BLOCK;
    uint8_t *const joined = malloc(*joined_n);
    if (joined == NULL) {
        flash_image_wrong(error, "not enough memory");
        return NULL;
    }
    const size_t first = flash_uf2_first(uf2, n);
    memcpy(joined, uf2, n);
    put_scene(joined + n, uf2 + flash_uf2_last(uf2, n), (uint32_t)((n - first) / FLASH_UF2_BLOCK), scene, scene_n);
    for (size_t at = first; at < *joined_n; at += FLASH_UF2_BLOCK) {
        put_u32(joined + at + TOTAL_AT, (uint32_t)((*joined_n - first) / FLASH_UF2_BLOCK));
    }
    return joined;
}
