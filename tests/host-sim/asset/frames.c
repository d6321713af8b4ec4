/*
 * Usage: frames BOARD FRAMES STEP [DIR [MODEL TRIANGLES LOG2_OF_TEXTURE turntable|own]]
 * Draws demo_scene, which this is linked with, on a simulated board and prints its frames' checksums as pinhole-sim
 * does; DIR (- for none) gets pictures. With a MODEL it also draws what pinhole-asset makes of it in memory, and exits
 * 1 where a frame differs by a byte. Then it prints by how many pixels the frames differ from those of the model file
 * itself, in how many only one of both shows the background, and how many triangles they have.
 */
#include "asset.h"
#include "complain.h"
#include "crc32.h"
#include "frame_out.h"
#include "sim_player.h"

#include <stdlib.h>
#include <string.h>

static int open_player(struct sim_player *p, const struct board *board, const struct demo *demo, void *state)
{
    const struct sim_player_setup setup = {
        .board = board, .rotation = board->rotation, .band_height = board->band_height, .demo = demo, .state = state};
    return sim_player_open(p, &setup);
}

static size_t picture_bytes(const struct sim_player *p)
{
    return (size_t)p->picture.width * p->picture.height * 3;
}

/* other: NULL, or a player whose frames must be the same. */
static int draw(struct sim_player *p, struct sim_player *other, uint32_t frames, uint32_t step, struct frame_out *out)
{
    for (uint32_t i = 0; i < frames; i++) {
        const uint32_t frame = i * step;
        if (sim_player_frame(p, frame) != 0 || frame_out_put(out, frame, &p->picture) != 0) {
            return COMPLAINED;
        }
        printf("frame %u crc32 %08X\n", (unsigned)frame, (unsigned)crc32_update(0, p->picture.rgb, picture_bytes(p)));
        if (p->runner.renderer.stats.triangles_dropped + p->runner.renderer.stats.vertices_dropped > 0) {
            return complain("frame %u: triangles are left out", (unsigned)frame);
        }
        if (other == NULL) {
            continue;
        }
        if (sim_player_frame(other, frame) != 0 || memcmp(p->picture.rgb, other->picture.rgb, picture_bytes(p)) != 0) {
            return complain("frame %u differs", (unsigned)frame);
        }
    }
    return 0;
}

static bool same_pixel(const uint8_t *a, const uint8_t *b)
{
    return memcmp(a, b, 3) == 0;
}

/* The first pixel of a picture is background. */
static int compare(struct sim_player *p, struct sim_player *file, uint32_t frames, uint32_t step)
{
    unsigned different = 0, outline = 0;
    for (uint32_t i = 0; i < frames; i++) {
        if (sim_player_frame(p, i * step) != 0 || sim_player_frame(file, i * step) != 0) {
            return COMPLAINED;
        }
        const uint8_t *a = p->picture.rgb, *b = file->picture.rgb;
        for (size_t at = 0; at < picture_bytes(p); at += 3) {
            different += !same_pixel(a + at, b + at);
            outline += same_pixel(a + at, a) != same_pixel(b + at, b);
        }
    }
    printf("pixels %u outline %u triangles %u of %u\n", different, outline,
           (unsigned)p->runner.renderer.stats.triangles_in, (unsigned)file->runner.renderer.stats.triangles_in);
    return 0;
}

static int make(struct asset *asset, struct model **model, const struct board *board, char *argv[])
{
    const struct asset_limits limits = {(uint32_t)strtoul(argv[6], NULL, 10), (uint8_t)strtoul(argv[7], NULL, 10),
                                        strcmp(argv[8], "turntable") == 0, false, argv[5]};
    int status = model_open(model, argv[5], NULL);
    if (status == 0) {
        status = asset_make(asset, *model, &limits);
    }
    return status == 0 ? asset_measure(asset, board) : status;
}

int main(int argc, char *argv[])
{
    struct sim_player scene, other, file;
    struct frame_out out = {.kind = FRAME_OUT_NONE};
    struct asset asset;
    struct model *model;
    struct demo demo, file_demo;
    complain_begin("frames", argc, argv);
    const struct board *board = argc >= 4 ? board_find(argv[1]) : NULL;
    if (board == NULL || open_player(&scene, board, &demo_scene, NULL) != 0 ||
        (argc > 4 && strcmp(argv[4], "-") != 0 && frame_out_open(&out, argv[4], true, 0) != 0)) {
        return 2;
    }
    const bool is_compared = argc == 9;
    if (is_compared) {
        if (make(&asset, &model, board, argv) != 0) {
            return 2;
        }
        demo = asset_demo(&asset);
        file_demo = model_demo(model);
        if (open_player(&other, board, &demo, &asset.model) != 0 || open_player(&file, board, &file_demo, model) != 0) {
            return 2;
        }
    }
    const uint32_t frames = (uint32_t)strtoul(argv[2], NULL, 10), step = (uint32_t)strtoul(argv[3], NULL, 10);
    const int status = draw(&scene, is_compared ? &other : NULL, frames, step, &out);
    return complain_exit(status == 0 && is_compared ? compare(&scene, &file, frames, step) : status);
}
