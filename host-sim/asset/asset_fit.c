/* See asset_fit.h. The count of triangles is found by trying: an estimate first, then the middle of what is left. */
#include "asset_fit.h"

#include "complain.h"
#include "option_text.h"
#include "progress.h"
#include "runner.h"

#include <string.h>

#define TRIES           12  /* attempts to fit; each comes nearer */
#define TRIANGLES_LEAST 16  /* fewer give no picture */
#define TRIANGLES_FEW   400 /* below this the platter of the turntable costs more triangles than it is worth */

/* Measures the list of triangles on the board, or on boards of every size to find the longest list. */
static int measure(struct asset *asset, const struct board *board)
{
    int status = 0;
    for (uint32_t i = 0; i < board_count && status == 0; i++) {
        progress_show("measuring", i, board_count);
        if (board == NULL ? asset_first_glass(i) == i : board == board_list[i]) {
            status = asset_measure(asset, board_list[i]);
        }
    }
    progress_show("measuring", board_count, board_count);
    return status;
}

static uint64_t texture_bytes(const struct asset *asset)
{
    return asset_sizes(asset).textures;
}

/* Returns the share of the triangles that board and flash have room for: 1 or more if all fit, 0 if none does. */
static double room(const struct asset *asset, const struct asset_goal *goal)
{
    const double flash = (double)(asset_flash_bytes(asset) - texture_bytes(asset));
    double share = ((double)goal->flash_bytes - (double)texture_bytes(asset)) / flash;
    if (goal->board != NULL) {
        const double bands = (double)asset_band_bytes(goal->board);
        const double frame =
            ((double)goal->board->scene_bytes - bands) / ((double)asset_frame_bytes(asset, goal->board, true) - bands);
        share = frame < share ? frame : share;
    }
    return share > 0 ? share : 0;
}

static bool fits(const struct asset *asset, const struct asset_goal *goal)
{
    return asset_flash_bytes(asset) <= goal->flash_bytes &&
           (goal->board == NULL || asset_frame_bytes(asset, goal->board, true) <= goal->board->scene_bytes);
}

/* Tells which texture size fits when the textures alone are too large for the flash. */
static int refuse_textures(const struct asset *asset, const struct asset_goal *goal)
{
    uint8_t log2 = goal->texture_log2;
    while (log2 > 0 && asset_texture_bytes(asset, log2) > goal->flash_bytes / 2) {
        log2--;
    }
    const uint32_t side = 1u << log2;
    return complain("%s: its textures take %llu of the %u bytes that the flash has for it; --texture-size %u "
                    "has room (make: SCENE_TEXTURE=%u)",
                    goal->model, (unsigned long long)texture_bytes(asset), (unsigned)goal->flash_bytes, (unsigned)side,
                    (unsigned)side);
}

/* Makes the asset once, with at most that many triangles. */
static int make(struct asset *asset, const struct model *model, const struct asset_goal *goal, uint32_t triangles,
                bool is_bare)
{
    const struct asset_limits limits = {triangles, goal->texture_log2, goal->turntable, is_bare, goal->model};
    const int status = asset_make(asset, model, &limits);
    return status == 0 ? measure(asset, goal->board) : status;
}

/*
 * Returns the next number to try between `fitting` and `too_many`: the estimate from the asset's need, else the middle.
 */
static uint32_t guess(const struct asset *asset, const struct asset_goal *goal, uint32_t fitting, uint32_t too_many)
{
    const double hope = asset->model.triangle_count * room(asset, goal) * .98;
    return hope > fitting && hope < too_many ? (uint32_t)hope : fitting + (too_many - fitting) / 2;
}

/* Finds the largest number of triangles that fits, to one in 32. */
static int make_less(struct asset *asset, const struct model *model, const struct asset_goal *goal, bool is_bare)
{
    uint32_t fitting = 0, too_many = model->triangle_count;
    int status = make(asset, model, goal, UINT32_MAX, is_bare);
    for (int i = 0; i < TRIES && status == 0; i++) {
        progress_show("fitting", (uint64_t)i, TRIES);
        if ((i == 0 && fits(asset, goal)) || too_many < TRIANGLES_LEAST || too_many - fitting <= too_many / 32) {
            break;
        }
        const uint32_t triangles = guess(asset, goal, fitting, too_many);
        asset_free(asset);
        status = make(asset, model, goal, triangles, is_bare);
        if (status == 0 && fits(asset, goal)) {
            fitting = triangles;
        } else if (asset->model.triangle_count > triangles) {
            break; /* these are as few as it becomes */
        } else {
            too_many = triangles;
        }
    }
    progress_show("fitting", TRIES, TRIES);
    if (status == 0 && !fits(asset, goal) && fitting >= TRIANGLES_LEAST) {
        asset_free(asset);
        status = make(asset, model, goal, fitting, is_bare);
    }
    return status;
}

static int make_fitting(struct asset *asset, const struct model *model, const struct asset_goal *goal)
{
    const int status = make_less(asset, model, goal, false);
    const bool is_full = fits(asset, goal) && !asset->is_simplified;
    if (status != 0 || is_full || asset->model.has_camera || asset->model.triangle_count >= TRIANGLES_FEW) {
        return status;
    }
    asset_free(asset);
    return make_less(asset, model, goal, true);
}

/* Says that the model was simplified. */
static void tell(const struct asset *asset, const struct asset_goal *goal)
{
    if (goal->fit && asset->is_simplified) {
        complain_note(
            "%s: %u of its %u triangles have room on %s%s; it was simplified, its surface moved by about %.2g %% "
            "of its radius",
            goal->model, (unsigned)asset->model.triangle_count, (unsigned)asset->triangles_read, goal->board->name,
            asset->is_bare ? ", without a platter" : "", 100 * asset->error);
    }
}

/* Says why `asset` does not fit, and how many triangles would. */
static int refuse(const struct asset *asset, const struct model *model, const struct asset_goal *goal)
{
    const unsigned triangles = (unsigned)asset->model.triangle_count;
    if (texture_bytes(asset) >= goal->flash_bytes) {
        return refuse_textures(asset, goal);
    }
    char need[120];
    if (asset_flash_bytes(asset) > goal->flash_bytes) {
        snprintf(need, sizeof need, "take %llu bytes, and the flash has %u for them",
                 (unsigned long long)asset_flash_bytes(asset), (unsigned)goal->flash_bytes);
    } else {
        snprintf(need, sizeof need, "need %llu bytes of memory, and %s has %u",
                 (unsigned long long)asset_frame_bytes(asset, goal->board, true), goal->board->name,
                 (unsigned)goal->board->scene_bytes);
    }
    struct asset smaller = {.memory = NULL};
    const int status = goal->fit ? COMPLAINED : make_fitting(&smaller, model, goal);
    const bool is_small = status == 0 && fits(&smaller, goal);
    const unsigned fewer = (unsigned)smaller.model.triangle_count;
    asset_free(&smaller);
    return is_small ? complain("%s: its %u triangles %s; %u fit: --max-triangles fit (make: "
                               "SCENE_TRIANGLES=fit)",
                               goal->model, triangles, need, fewer)
                    : complain("%s: its %u triangles %s; it cannot be simplified so far", goal->model, triangles, need);
}

bool asset_triangles_named(const char *text, struct asset_goal *goal)
{
    goal->fit = strcmp(text, "fit") == 0;
    goal->triangles = UINT32_MAX;
    return goal->fit || strcmp(text, "all") == 0 || option_text_u32(text, 1, MODEL_TRIANGLES_MAX, &goal->triangles);
}

int asset_fit_make(struct asset *asset, const struct model *model, const struct asset_goal *goal)
{
    *asset = (struct asset){.memory = NULL};
    return goal->fit ? make_fitting(asset, model, goal) : make(asset, model, goal, goal->triangles, false);
}

int asset_fit_check(const struct asset *asset, const struct model *model, const struct asset_goal *goal)
{
    if (asset->model.triangle_count > goal->triangles) {
        return complain("%s: %u of its triangles remain, not %u; it cannot be simplified so far", goal->model,
                        (unsigned)asset->model.triangle_count, (unsigned)goal->triangles);
    }
    if (!fits(asset, goal)) {
        return refuse(asset, model, goal);
    }
    tell(asset, goal);
    return 0;
}

int asset_fit(struct asset *asset, const struct model *model, const struct asset_goal *goal)
{
    const int status = asset_fit_make(asset, model, goal);
    return status == 0 ? asset_fit_check(asset, model, goal) : status;
}
