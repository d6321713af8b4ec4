/*
 * The least main() of an image: it draws the build's first demo (demo_here) for ever, on the board that BOARD= names.
 * Copy it to a file of your own, and build that with `make firmware BOARD=x APP=FILE.c`.
 */
#include "image.h"
#include "port.h"
#include "runner.h"

int main(void)
{
    static struct runner runner;
    const struct hal hal = port_hal();
    const struct runner_config config = {.board = board_here,
                                         .rotation = board_here->rotation,
                                         .depth_format = PH_DEPTH_AUTO,
                                         .band_height = board_here->band_height,
                                         .budget_bytes = board_here->scene_bytes,
                                         .demo = demo_here,
                                         .memory = image_memory,
                                         .memory_bytes = image_memory_bytes};
    int status = hal.ops->open(hal.context, board_here);
    status = status == 0 ? runner_open(&runner, &hal, &config) : status;
    for (uint32_t frame = 0; status == 0; frame++) {
        status = runner_frame(&runner, frame);
    }
    port_log("stopped\r\n");
    return 1;
}
