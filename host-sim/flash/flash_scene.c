/* See flash_scene.h. */
#include "flash_scene.h"

#include "scene_file.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int flash_scene_read(struct flash_image *image, const char *path, char *error)
{
    const size_t most = FLASH_SPAN - FLASH_SCENE;
    *image = (struct flash_image){.sectors = 0};
    FILE *file = fopen(path, "rb");
    if (file == NULL) {
        return flash_image_wrong(error, "cannot be read: %s", strerror(errno));
    }
    uint8_t *bytes = malloc(most + 1);
    const size_t n = bytes != NULL ? fread(bytes, 1, most + 1, file) : 0;
    fclose(file);
    const char *wrong = bytes == NULL ? "needs too much memory"
                        : n > most    ? "is too large"
                                      : scene_file_wrong(bytes, n);
    int status = wrong != NULL ? flash_image_wrong(error, "%s", wrong) : 0;
    if (status == 0) {
        status = flash_image_make(image, FLASH_SCENE + (uint32_t)n, error);
    }
    if (status == 0) {
        flash_image_put(image, FLASH_SCENE, bytes, (uint32_t)n);
    }
    free(bytes);
    return status;
}
