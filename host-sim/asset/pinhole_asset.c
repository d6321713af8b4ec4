/* pinhole-asset: models as const data for the flash of a display kit. See asset.h. */
#define _XOPEN_SOURCE 700 /* open_memstream, isatty */

#include "asset.h"
#include "asset_options.h"
#include "complain.h"
#include "file_save.h"
#include "runner.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define TRIES           12  /* attempts to fit; each comes nearer */
#define TRIANGLES_LEAST 16  /* fewer give no picture */
#define TRIANGLES_FEW   400 /* below this the platter of the turntable costs more triangles than it is worth */

/* Measures the list of triangles on the board, or on every board to find the longest list. */
static int measure(struct asset *asset, const struct board *board)
{
    for (uint32_t i = 0; i < board_count; i++) {
        const int status = board == NULL || board == board_list[i] ? asset_measure(asset, board_list[i]) : 0;
        if (status != 0) {
            return status;
        }
    }
    return 0;
}

static uint64_t texture_bytes(const struct asset *asset)
{
    return asset_sizes(asset).textures;
}

/* Returns the share of the triangles that board and flash have room for: 1 or more if all fit, 0 if none does. */
static double room(const struct asset *asset, const struct asset_options *o)
{
    const double flash = (double)(asset_flash_bytes(asset) - texture_bytes(asset));
    double share = ((double)o->flash_bytes - (double)texture_bytes(asset)) / flash;
    if (o->board != NULL) {
        const double bands = (double)asset_band_bytes(o->board);
        const double frame =
            ((double)runner_budget(o->board) - bands) / ((double)asset_frame_bytes(asset, o->board) - bands);
        share = frame < share ? frame : share;
    }
    return share > 0 ? share : 0;
}

static bool fits(const struct asset *asset, const struct asset_options *o)
{
    return asset_flash_bytes(asset) <= o->flash_bytes &&
           (o->board == NULL || asset_frame_bytes(asset, o->board) <= runner_budget(o->board));
}

/* Tells which texture size fits when the textures alone are too large for the flash. */
static int refuse_textures(const struct asset *asset, const struct asset_options *o)
{
    uint8_t log2 = o->texture_log2;
    while (log2 > 0 && asset_texture_bytes(asset, log2) > o->flash_bytes / 2) {
        log2--;
    }
    const uint32_t side = 1u << log2;
    return complain("%s: its textures take %llu of the %u bytes that the flash has for it; --texture-size %u "
                    "has room (make: SCENE_TEXTURE=%u)",
                    o->model, (unsigned long long)texture_bytes(asset), (unsigned)o->flash_bytes, (unsigned)side,
                    (unsigned)side);
}

/* Makes the asset once, with at most that many triangles. */
static int make(struct asset *asset, const struct model *model, const struct asset_options *o, uint32_t triangles,
                bool is_bare)
{
    const struct asset_limits limits = {triangles, o->texture_log2, o->filter, o->turntable, is_bare, o->model};
    const int status = asset_make(asset, model, &limits);
    return status == 0 ? measure(asset, o->board) : status;
}

/*
 * Returns the next number to try between `fitting` and `too_many`: the estimate from the asset's need, else the middle.
 */
static uint32_t guess(const struct asset *asset, const struct asset_options *o, uint32_t fitting, uint32_t too_many)
{
    const double hope = asset->model.triangle_count * room(asset, o) * .98;
    return hope > fitting && hope < too_many ? (uint32_t)hope : fitting + (too_many - fitting) / 2;
}

/* Finds the largest number of triangles that fits, to one in 32. */
static int make_less(struct asset *asset, const struct model *model, const struct asset_options *o, bool is_bare)
{
    uint32_t fitting = 0, too_many = model->triangle_count;
    int status = make(asset, model, o, UINT32_MAX, is_bare);
    for (int i = 0; i < TRIES && status == 0 && asset_can_simplify; i++) {
        if ((i == 0 && fits(asset, o)) || too_many < TRIANGLES_LEAST || too_many - fitting <= too_many / 32) {
            break;
        }
        const uint32_t triangles = guess(asset, o, fitting, too_many);
        asset_free(asset);
        status = make(asset, model, o, triangles, is_bare);
        if (status == 0 && fits(asset, o)) {
            fitting = triangles;
        } else {
            too_many = triangles;
        }
    }
    if (status == 0 && !fits(asset, o) && fitting >= TRIANGLES_LEAST) {
        asset_free(asset);
        status = make(asset, model, o, fitting, is_bare);
    }
    return status;
}

static int make_fitting(struct asset *asset, const struct model *model, const struct asset_options *o)
{
    const int status = make_less(asset, model, o, false);
    const bool is_full = fits(asset, o) && asset->model.triangle_count == model->triangle_count;
    if (status != 0 || is_full || asset->model.has_camera || asset->model.triangle_count >= TRIANGLES_FEW) {
        return status;
    }
    asset_free(asset);
    return make_less(asset, model, o, true);
}

/* Says that the model was simplified. */
static void tell(const struct asset *asset, const struct asset_options *o)
{
    if (o->fit && asset->way != ASSET_WHOLE) {
        complain_note(
            "%s: %u of its %u triangles have room on %s%s; it was simplified, its surface moved by about %.2g %% "
            "of its radius",
            o->model, (unsigned)asset->model.triangle_count, (unsigned)asset->triangles_read, o->board->name,
            asset->is_bare ? ", without a platter" : "", 100 * asset->error);
    }
}

static const char no_meshopt[] = "simplifying takes meshoptimizer: install libmeshoptimizer-dev (Debian), make again";

/* Says why `asset` does not fit, and how many triangles would. */
static int refuse(const struct asset *asset, const struct model *model, const struct asset_options *o)
{
    const unsigned triangles = (unsigned)asset->model.triangle_count;
    if (texture_bytes(asset) >= o->flash_bytes) {
        return refuse_textures(asset, o);
    }
    char need[120];
    if (asset_flash_bytes(asset) > o->flash_bytes) {
        snprintf(need, sizeof need, "take %llu bytes, and the flash has %u for them",
                 (unsigned long long)asset_flash_bytes(asset), (unsigned)o->flash_bytes);
    } else {
        snprintf(need, sizeof need, "need %llu bytes of memory, and %s has %u",
                 (unsigned long long)asset_frame_bytes(asset, o->board), o->board->name,
                 (unsigned)runner_budget(o->board));
    }
    struct asset smaller = {.memory = NULL};
    const int status = o->fit ? COMPLAINED : make_fitting(&smaller, model, o);
    const bool is_small = status == 0 && fits(&smaller, o);
    const unsigned fewer = (unsigned)smaller.model.triangle_count;
    asset_free(&smaller);
    return is_small ? complain("%s: its %u triangles %s; %u fit: --max-triangles fit (make: "
                               "SCENE_TRIANGLES=fit)",
                               o->model, triangles, need, fewer)
                    : complain("%s: its %u triangles %s; %s", o->model, triangles, need,
                               asset_can_simplify ? "it cannot be simplified so far" : no_meshopt);
}

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

static int run_on(const struct model *model, const struct asset_options *o)
{
    struct asset asset = {.memory = NULL};
    int status = o->fit ? make_fitting(&asset, model, o) : make(&asset, model, o, o->triangles, false);
    if (status == 0 && asset.model.triangle_count > o->triangles) {
        status = complain("%s: %u of its triangles remain, not %u; %s", o->model, (unsigned)asset.model.triangle_count,
                          (unsigned)o->triangles, asset_can_simplify ? "it cannot be simplified so far" : no_meshopt);
    }
    if (status == 0 && !fits(&asset, o)) {
        status = refuse(&asset, model, o);
    }
    if (status == 0) {
        tell(&asset, o);
    }
    if (status == 0 && o->out != NULL) {
        status = save(&asset, o->out);
    }
    if (status == 0 && o->report) {
        status = asset_report(stdout, &asset, o->board);
    }
    asset_free(&asset);
    return status;
}

static int run(const struct asset_options *o)
{
    struct model *model;
    int status = model_open(&model, o->model);
    if (status != 0) {
        return status;
    }
    if (model->note != NULL) {
        complain_note("%s: %s", o->model, model->note);
    }
    status = run_on(model, o);
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
        status = run(&options);
    }
    return complain_exit(status);
}
