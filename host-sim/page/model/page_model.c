/* See page_model.h. */
#include "page_model.h"

#include "asset_fit.h"
#include "complain.h"
#include "json_text.h"
#include "scene_file.h"

#include <stdio.h>
#include <stdlib.h>

static struct page_model {
    char path[PAGE_MODEL_PATH];
    struct model *model;
    const struct ph_clip *clips; /* all of the file */
    uint32_t clip_count;
    struct asset asset;
    uint8_t *scene;
} page;

char *page_model_path(void)
{
    return page.path;
}

int page_model_open(int up, unsigned filter, int two_sided, int32_t background, unsigned light)
{
    static const char *const filters[] = {"nearest", "bilinear", "mipmap", "file"};
    static const char *const lights[] = {NULL, "left", "right", "front", "above", "back"};
    char colour[7];
    snprintf(colour, sizeof colour, "%06x", (unsigned)background & 0xFFFFFF);
    const struct model_options options = {.up = up == 'z'   ? "z"
                                                : up == 'y' ? "y"
                                                            : NULL,
                                          .filter = filters[filter % 4],
                                          .background = background >= 0 ? colour : NULL,
                                          .light = lights[light % 6],
                                          .two_sided = two_sided != 0};
    const int status = model_open(&page.model, page.path, &options);
    if (status == 0 && page.model->motion != NULL) {
        page.clips = page.model->motion->animation.clips;
        page.clip_count = page.model->motion->animation.clip_count;
    }
    return status;
}

/* Keeps one clip, as pinhole-asset --clip does, or all of them. */
static void choose_clip(int clip)
{
    struct model_motion *const motion = page.model->motion;
    const bool is_one = clip >= 0 && (uint32_t)clip < page.clip_count;
    if (motion != NULL && page.clip_count > 0) {
        motion->animation.clips = is_one ? &page.clips[clip] : page.clips;
        motion->animation.clip_count = is_one ? 1 : page.clip_count;
        motion->animation.clip = motion->animation.clips;
    }
}

uint32_t page_model_make(uint32_t board, uint32_t triangles, unsigned texture_log2, int turntable, int clip)
{
    const struct asset_goal goal = {.model = page.path,
                                    .board = triangles == 0 ? board_list[board % board_count] : NULL,
                                    .triangles = triangles == 0 ? UINT32_MAX : triangles,
                                    .fit = triangles == 0,
                                    .turntable = turntable != 0,
                                    .texture_log2 = (uint8_t)texture_log2,
                                    .flash_bytes = UINT32_MAX};
    asset_free(&page.asset);
    free(page.scene);
    page.scene = NULL;
    choose_clip(clip);
    if (asset_fit_make(&page.asset, page.model, &goal) != 0) {
        return 0;
    }
    if (page.asset.model.mesh_count > SCENE_FILE_MESHES) {
        complain("%s: a binary scene has at most %u meshes, not %u", page.path, SCENE_FILE_MESHES,
                 (unsigned)page.asset.model.mesh_count);
        return 0;
    }
    const size_t n = asset_scene(&page.asset, NULL);
    page.scene = calloc(1, n);
    if (page.scene == NULL) {
        complain("%s: not enough memory for the scene", page.path);
        return 0;
    }
    return (uint32_t)asset_scene(&page.asset, page.scene);
}

const uint8_t *page_model_scene(void)
{
    return page.scene;
}

static void print_boards(void)
{
    fputs(", \"boards\": [", stdout);
    for (uint32_t i = 0; i < board_count; i++) {
        printf("%s{\"needs\": %u, \"has\": %u}", i > 0 ? ", " : "",
               (unsigned)asset_frame_bytes(&page.asset, board_list[i], true), (unsigned)board_list[i]->scene_bytes);
    }
    fputs("]", stdout);
}

void page_model_report(void)
{
    const struct asset *const a = &page.asset;
    printf("{\"name\": \"%s\", \"read\": %u, \"triangles\": %u, \"error\": %.6f, \"simplified\": %s, \"bare\": %s, "
           "\"camera\": %s, \"flash\": %u, \"note\": ",
           a->name, (unsigned)a->triangles_read, (unsigned)a->model.triangle_count, a->error,
           a->is_simplified ? "true" : "false", a->is_bare ? "true" : "false",
           page.model->has_camera ? "true" : "false", (unsigned)asset_flash_bytes(a));
    json_text(stdout, page.model->note != NULL ? page.model->note : "");
    fputs(", \"clips\": [", stdout);
    for (uint32_t i = 0; i < page.clip_count; i++) {
        fputs(i > 0 ? ", " : "", stdout);
        json_text(stdout, page.clips[i].name);
    }
    fputs("]", stdout);
    print_boards();
    puts("}");
    fflush(stdout);
}

void page_model_c(void)
{
    asset_write(stdout, &page.asset);
    fflush(stdout);
}
