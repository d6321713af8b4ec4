/* See page.h. */
#include "page.h"

#include "boards.h"
#include "complain.h"
#include "crc32.h"
#include "scene_file.h"
#include "sim_list.h"
#include "sim_model.h"
#include "sim_player.h"

#include <stdio.h>
#include <stdlib.h>

struct page {
    struct sim_virtual virtual_board;
    struct sim_player player; /* setup.board NULL: none is open */
    uint8_t *scene;           /* the binary scene, or NULL */
    uint32_t scene_bytes;
    struct demo scene_demo;
};

static struct page page;

void page_list(void)
{
    sim_list_print_json();
    for (int i = 0; i < PH_DEPTH_FORMATS; i++) {
        printf("%s\"%s\"", i == 0 ? "[" : ", ", ph_depth_formats[i]->name);
    }
    puts("]");
    fflush(stdout);
}

static void close_kit(void)
{
    if (page.player.setup.board != NULL) {
        sim_player_close(&page.player);
        page.player.setup.board = NULL;
    }
}

uint8_t *page_scene_room(uint32_t n)
{
    close_kit();
    free(page.scene);
    page.scene = malloc(n);
    page.scene_bytes = n;
    return page.scene;
}

int page_scene(void)
{
    const char *const why = scene_file_wrong(page.scene, page.scene_bytes);
    if (why != NULL) {
        return complain("the scene %s", why);
    }
    page.scene_demo = scene_file_demo(page.scene);
    return 0;
}

int page_open(int board, unsigned width, unsigned height, int demo, unsigned view, unsigned depth)
{
    close_kit();
    if (board < 0 && sim_virtual(&page.virtual_board, (uint16_t)width, (uint16_t)height) != 0) {
        return HAL_EINVAL;
    }
    const struct board *const kit = board < 0 ? &page.virtual_board.board : board_list[board];
    const struct demo *const scene = demo < 0 ? &page.scene_demo : demo_list[demo];
    const struct sim_player_setup setup = {.board = kit,
                                           .rotation = kit->rotation,
                                           .band_height = kit->band_height,
                                           .depth = {.format = ph_depth_formats[depth]},
                                           .demo = scene,
                                           .state = demo < 0 ? page.scene : NULL,
                                           .cure = demo < 0 ? "take fewer triangles" : NULL,
                                           .view = scene->views != NULL ? scene->views[view] : NULL};
    return sim_player_open(&page.player, &setup);
}

int page_frame(uint32_t frame, uint32_t buttons)
{
    sim_buttons_set(page.player.sim, buttons);
    return sim_player_frame(&page.player, frame);
}

void page_stats(uint32_t frame)
{
    sim_player_print_json(&page.player, frame);
}

void page_drag(int32_t right, int32_t down, int32_t notches)
{
    sim_player_drag(&page.player, right, down, notches);
}

void page_move(uint32_t turn32, int32_t up32, int32_t away)
{
    sim_player_move(&page.player, turn32, up32, away);
}

int32_t page_turned(void)
{
    return (int32_t)page.player.runner.context.orbit;
}

int32_t page_raised(void)
{
    return page.player.runner.context.tilt;
}

int32_t page_away(void)
{
    return page.player.runner.context.dolly;
}

uint32_t page_width(void)
{
    return page.player.picture.width;
}

uint32_t page_height(void)
{
    return page.player.picture.height;
}

const uint8_t *page_rgb(void)
{
    return page.player.picture.rgb;
}

uint32_t page_crc(void)
{
    const struct ppm *const picture = &page.player.picture;
    return crc32_update(0, picture->rgb, (size_t)picture->width * picture->height * 3);
}

uint32_t page_demo(void)
{
    uint32_t i = 0;
    while (i + 1 < demo_count && demo_list[i] != page.player.runner.demo) {
        i++;
    }
    return i;
}

int page_round(void)
{
    struct sim_glass made;
    const struct sim_glass *const glass = sim_glass_find(page.player.setup.board->panel, &made);
    return glass != NULL && glass->round;
}
