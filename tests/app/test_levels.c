/* Each demo is whole on each kit: nothing of a frame is left out, and the demo has all the memory that it wants. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "boards.h"
#include "runner.h"
#include "sim.h"

#include <stdlib.h>
#include <string.h>

#define PLENTY (1u << 20) /* bytes; a board with more is not short of memory */

static struct runner_config config_of(const struct board *board, const struct demo *demo)
{
    return (struct runner_config){.board = board,
                                  .depth_format = PH_DEPTH_AUTO,
                                  .rotation = board->rotation,
                                  .band_height = board->band_height,
                                  .budget_bytes = board->scene_bytes,
                                  .demo = demo};
}

/* Makes the scene of each frame, without drawing it. */
static void assert_whole(struct runner *runner, const struct board *board, const struct demo *demo)
{
    for (uint32_t frame = 0; frame < demo->loop_frames; frame++) {
        assert_int_equal(runner_scene(runner, frame), PH_OK);
        const struct ph_stats *const s = &runner->renderer.stats;
        if (s->triangles_dropped != 0 || s->vertices_dropped != 0) {
            fail_msg("%s on %s, frame %u: %u triangles and %u vertices are left out", demo->name, board->name,
                     (unsigned)frame, (unsigned)s->triangles_dropped, (unsigned)s->vertices_dropped);
        }
    }
}

static void every_frame_of_every_demo_is_whole_on_every_kit(void **state)
{
    (void)state;
    const uint32_t blurs = board_find("pico-display")->scene_bytes; /* with less, `focus` may be without its blur */
    uint32_t kits = 0;
    for (uint32_t b = 0; b < board_count; b++) {
        const struct board *const board = board_list[b];
        struct hal hal;
        if (board->scene_bytes > PLENTY) {
            continue;
        }
        kits++;
        for (uint32_t d = 0; d < demo_count; d++) {
            struct sim *const sim = sim_open(board, &hal);
            struct runner runner;
            struct runner_config config = config_of(board, demo_list[d]);
            const struct memory_plan plan = memory_plan(&config, demo_list[d]);
            if (!plan.scene.whole || (plan.scene.lacks_scratch && board->scene_bytes >= blurs)) {
                fail_msg("%s on %s: %s", demo_list[d]->name, board->name, plan.scene.whole ? "no blur" : "not whole");
            }
            config.memory_bytes = runner_bytes(&config);
            config.memory = malloc(config.memory_bytes);
            assert_non_null(config.memory);
            assert_int_equal(runner_open(&runner, &hal, &config), PH_OK);
            assert_whole(&runner, board, demo_list[d]);
            assert_int_equal(runner_close(&runner), 0);
            free(config.memory);
            sim_close(sim);
        }
    }
    assert_true(kits >= 7);
}

/* The turntable has fewer triangles where more would cover a few pixels each. */
static void small_pictures_take_coarser_models(void **state)
{
    (void)state;
    static const char *const kits[] = {"waveshare-pico-lcd-1in3", "pico-display", "lm3s6965evb"};
    const struct demo *const demo = demo_find("turntable");
    uint32_t finer = UINT32_MAX;
    for (size_t i = 0; i < sizeof kits / sizeof kits[0]; i++) {
        const struct runner_config config = config_of(board_find(kits[i]), demo);
        const uint32_t triangles = memory_plan(&config, demo).scene.triangle_max;
        assert_true(triangles < finer);
        finer = triangles;
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_frame_of_every_demo_is_whole_on_every_kit),
        cmocka_unit_test(small_pictures_take_coarser_models),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
