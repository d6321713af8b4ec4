/* pinhole-asset: models as const data for the flash of a display kit. See asset.h. */
#define _XOPEN_SOURCE 700 /* open_memstream, isatty */

#include "asset_check.h"
#include "asset_compare.h"
#include "asset_fit.h"
#include "asset_options.h"
#include "complain.h"
#include "file_save.h"
#include "option_text.h"
#include "scene_file.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static int save(const struct asset *asset, const char *path)
{
    char *text = NULL;
    size_t length = 0;
    FILE *file = open_memstream(&text, &length);
    if (file == NULL) {
        return complain("not enough memory for the C file");
    }
    asset_write(file, asset);
    const bool is_whole = ferror(file) == 0;
    const bool is_closed = fclose(file) == 0;
    int status = 0;
    if (!is_whole || !is_closed) {
        status = complain("not enough memory for the C file");
    } else if (strcmp(path, "-") == 0) {
        fwrite(text, 1, length, stdout);
    } else {
        status = file_save_bytes(path, text, length);
    }
    free(text);
    return status;
}

static int save_scene(const struct asset *asset, const char *path)
{
    if (asset->model.mesh_count > SCENE_FILE_MESHES) {
        return complain("%s: a binary scene has at most %u meshes, not %u; write C", path, SCENE_FILE_MESHES,
                        (unsigned)asset->model.mesh_count);
    }
    const size_t n = asset_scene(asset, NULL);
    uint8_t *bytes = calloc(1, n);
    if (bytes == NULL) {
        return complain("not enough memory for the scene");
    }
    asset_scene(asset, bytes);
    const int status = file_save_bytes(path, (const char *)bytes, n);
    free(bytes);
    return status;
}

/* Looks how much simplification has changed, as the board shows it. */
static int compare(struct asset *asset, const struct model *model, const struct board *board)
{
    const uint16_t width = board != NULL ? panel_width(board->panel, board->rotation) : 240;
    const uint16_t height = board != NULL ? panel_height(board->panel, board->rotation) : 135;
    return asset->is_simplified ? asset_compare(asset, model, width, height, &asset->off) : 0;
}

static int refuse(const struct asset *asset, const struct asset_options *o)
{
    return complain("%s: of its %u triangles %u remain, and %.3g %% of its pixels are off; more than %.0f %% takes "
                    "--force (make: SCENE_FLAGS=--force), or more triangles, or a board with more room",
                    o->goal.model, (unsigned)asset->triangles_read, (unsigned)asset->model.triangle_count,
                    100 * asset->off, 100 * ASSET_OFF_MOST);
}

static int run_on(const struct model *model, const struct asset_options *o)
{
    struct asset asset;
    int status = asset_fit_make(&asset, model, &o->goal);
    status = status == 0 ? compare(&asset, model, o->goal.board) : status;
    if (status == 0 && o->report) { /* of what does not fit, too: it says by how much */
        status = asset_report(stdout, &asset, o->goal.board);
        fflush(stdout);
    }
    if (status == 0) {
        status = asset_fit_check(&asset, model, &o->goal);
    }
    if (status == 0 && asset.off > ASSET_OFF_MOST && !o->force) {
        status = refuse(&asset, o);
    }
    if (status == 0 && o->out != NULL) {
        status = (option_text_ends(o->out, ".phs") ? save_scene : save)(&asset, o->out);
    }
    asset_free(&asset);
    return status;
}

static int run(const struct asset_options *o)
{
    struct model *model;
    int status = model_open(&model, o->goal.model, &o->model_options);
    if (status != 0) {
        return status;
    }
    if (model->note != NULL) {
        complain_note("%s: %s", o->goal.model, model->note);
    }
    status = model_play(model, o->clip);
    if (status == 0 && o->clip != NULL && !model->motion->animation.in_turn) { /* the others take no flash */
        model->motion->animation.clips = model->motion->animation.clip;
        model->motion->animation.clip_count = 1;
    }
    status = status == 0 ? run_on(model, o) : status;
    model_close(model);
    return status;
}

int main(int argc, char *argv[])
{
    struct asset_options options;
    complain_begin("pinhole-asset", argc, argv);
    int status = asset_options_read(&options, argc, argv);
    if (status != 0) {
        return complain_exit(status);
    }
    if (options.help) {
        asset_options_help();
    } else if (options.out != NULL && strcmp(options.out, "-") == 0 && isatty(STDOUT_FILENO)) {
        status = complain_usage("-o -: stdout is a terminal; pipe it into a program, or use -o FILE.c");
    } else {
        status = options.check ? asset_check(options.goal.model) : run(&options);
    }
    return complain_exit(status);
}
