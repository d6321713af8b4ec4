/* See page.h. */
#include "page.h"

#include "boards.h"
#include "complain.h"
#include "crc32.h"
#include "scene_file.h"
#include "sim_choose.h"
#include "sim_focus.h"
#include "sim_list.h"
#include "sim_model.h"
#include "sim_show.h"
#include "sim_tell.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct page {
    struct sim_choice choice;
    struct sim_player player; /* setup.board NULL: none is open */
    uint8_t *scene;           /* the binary scene, or NULL */
    uint32_t scene_bytes;
    struct demo scene_demo;
    char words[PAGE_WORDS]; /* of page_run */
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
    if (board < 0 && sim_virtual(&page.choice.virtual_board, (uint16_t)width, (uint16_t)height) != 0) {
        return HAL_EINVAL;
    }
    const struct board *const kit = board < 0 ? &page.choice.virtual_board.board : board_list[board];
    const struct demo *const scene = demo < 0 ? &page.scene_demo : demo_list[demo];
    const struct sim_player_setup setup = {.board = kit,
                                           .rotation = kit->rotation,
                                           .band_height = kit->band_height,
                                           .depth = {.format = ph_depth_formats[depth]},
                                           .demo = scene,
                                           .state = demo < 0 ? page.scene : NULL,
                                           .cure = demo < 0 ? "take fewer triangles" : NULL,
                                           .view = scene->views != NULL ? scene->views[view] : NULL};
    sim_show_depth(false);
    sim_focus_set(0, -1);
    return sim_player_open(&page.player, &setup);
}

char *page_words(void)
{
    return page.words;
}

#define WORDS_MOST 64

/* Opens the kit for the words. */
static int open_words(uint32_t count, struct sim_options *o)
{
    char name[] = "pinhole-sim", *words[WORDS_MOST + 1] = {name}, *at = page.words;
    struct sim_player_setup setup = {.board = NULL};
    page.words[PAGE_WORDS - 1] = '\0';
    for (uint32_t i = 1; i <= count && i <= WORDS_MOST && at < page.words + PAGE_WORDS; i++) {
        words[i] = at;
        at += strlen(at) + 1;
    }
    int status =
        count > WORDS_MOST ? complain("more than %d options", WORDS_MOST) : sim_options_read(o, (int)count + 1, words);
    if (status != 0 || o->action != OPTION_RUN || o->model != NULL) {
        return status != 0 ? status : complain("there are no files here, no help and no lists");
    }
    page.choice.writing = (struct sim_matrix_writing){.convention = (enum ph_convention)o->convention};
    status = sim_choose_kit(o, &page.choice, &setup);
    status = status == 0 ? sim_choose_demo(o, &setup) : status;
    return status == 0 ? sim_player_open(&page.player, &setup) : status;
}

int page_run(uint32_t count)
{
    struct sim_options o;
    close_kit();
    int status = open_words(count, &o);
    if (status == 0) {
        sim_focus_set(o.focus, o.focus_strength);
    }
    if (status == 0 && (o.matrix || o.point_set || o.frustum_z != 0)) {
        sim_tell_cameras(&o, stdout, &page.player, page.choice.writing);
        fflush(stdout);
    }
    if (status == 0) {
        sim_show_depth(o.show != NULL);
        status = sim_tell_ride(&o, &page.player, o.start);
    }
    return status == 0 ? sim_player_frame(&page.player, o.start) : status;
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
