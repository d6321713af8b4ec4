/*
 * The image of all demos (firmware/app/images/demos.c) on a port that is made up: characters that wait on its log, a
 * clock that the test sets, and what the image writes.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

int image_main(void);
#define main image_main
#include "../../firmware/app/images/demos.c" /* NOLINT(bugprone-suspicious-include) */
#undef main

#include "boards.h"
#include "boards_all.h"
#include "demo_scene.h"
#include "sim_player.h"

#include <stdio.h>
#include <string.h>

#define MINUTE_US 60000000ULL

/* ---- the port ---------------------------------------------------------------------------------------------------- */

static struct {
    uint64_t now_us, step_us; /* the clock, and how far it goes on whenever somebody reads from the log */
    uint32_t nothing;         /* so often nothing waits; */
    const char *typed;        /* then these characters do */
    char said[20000];
    uint32_t pressed, charged_us; /* buttons, until that time */
    uint32_t boot_loader;         /* calls */
    struct hal kit;
    struct sim *fails; /* with it the bus fails once nothing more is typed */
} port;

const char *const image_build = "test";
uint64_t image_memory[1 << 16];
uint32_t image_tiles[1];
const size_t image_memory_bytes = sizeof image_memory, image_tiles_bytes = sizeof image_tiles, image_ahead_bytes = 0;
void *const image_ahead = NULL;
const uint16_t image_clip_fps = DEMO_CLIPS_BY_CLOCK;
struct ph_dither *const image_dither = NULL;
int (*const image_set_dither)(struct ph_renderer *r, struct ph_dither *dither) = NULL;
static uint32_t flash[64];
const void *const image_scene = flash;
const size_t image_scene_bytes = sizeof flash;
const struct board *const board_here = &board_pico_display;
const struct demo *const demo_here = &demo_turntable;

static uint32_t test_time_us(void *context)
{
    (void)context;
    return (uint32_t)port.now_us;
}

static uint32_t test_buttons(void *context)
{
    (void)context;
    port.now_us += 100;
    return port.now_us <= port.charged_us ? port.pressed : 0;
}

static const struct hal_ops test_ops = {.name = "test", .time_us = test_time_us, .buttons = test_buttons};
static const struct hal test_hal = {&test_ops, NULL};

struct hal port_hal(void)
{
    return port.kit;
}

void port_log(const char *text)
{
    strncat(port.said, text, sizeof port.said - strlen(port.said) - 1);
}

int port_log_read(void)
{
    port.now_us += port.step_us;
    if (port.nothing > 0) {
        port.nothing--;
        return -1;
    }
    if (*port.typed == '\0' && port.fails != NULL) {
        sim_fault(port.fails, SIM_FAULT_WRITE, 1);
        return 'H';
    }
    return *port.typed != '\0' ? (uint8_t)*port.typed++ : -1;
}

void port_boot_loader(void)
{
    port.boot_loader++;
}

uint32_t port_stack_used(void)
{
    return 4032;
}

void port_facts(port_put put)
{
    put("fact ", 0x1F, PORT_HEX);
}

bool port_core_run(void (*function)(void *argument), void *argument)
{
    (void)function, (void)argument;
    return false;
}

void port_core_join(void)
{
}

/* ---- the tests --------------------------------------------------------------------------------------------------- */

static struct runner drawn;

static int fresh(void **state)
{
    (void)state;
    memset(&port, 0, sizeof port);
    memset(&drawn, 0, sizeof drawn);
    port.typed = "";
    drawn.hal = test_hal;
    return 0;
}

static void expect_said(const char *text)
{
    assert_string_equal(port.said, text);
    port.said[0] = '\0';
}

static void a_line_a_second_tells_the_frames_of_that_second(void **state)
{
    (void)state;
    struct console console = {.counted_us = 0};
    drawn.renderer.stats.triangles_dropped = 3;
    drawn.renderer.stats.vertices_dropped = 5;
    for (uint32_t frame = 0; frame < 50; frame++) {
        port.now_us += 40000;
        report(&drawn, &console, frame);
        if (frame % 25 == 24) {
            char line[100];
            snprintf(line, sizeof line, "frame %u, 25 frames/s, left out 3 triangles 5 vertices, stack 4032\r\n",
                     (unsigned)frame);
            expect_said(line);
        } else {
            expect_said("");
        }
    }
}

/* 2^32 us are 71 minutes and 35 seconds. */
static void the_rate_after_a_hold_is_right_however_long_it_was(void **state)
{
    (void)state;
    static const struct {
        uint64_t hold_us;
        const char *line;
    } holds[] = {{250000, "frame 7, 4 frames/s, left out 0 triangles 0 vertices, stack 4032\r\n"},
                 {(1ULL << 32) + 100000, "frame 7, 0 frames/s, left out 0 triangles 0 vertices, stack 4032\r\n"},
                 {142 * MINUTE_US, "frame 7, 0 frames/s, left out 0 triangles 0 vertices, stack 4032\r\n"},
                 {(1ULL << 32) * 1001, "frame 7, 0 frames/s, left out 0 triangles 0 vertices, stack 4032\r\n"}};
    for (size_t i = 0; i < sizeof holds / sizeof holds[0]; i++) {
        struct console console = {.holding = true, .line_frame = 7};
        fresh(state);
        port.nothing = 2000;
        port.step_us = holds[i].hold_us / 2000;
        port.typed = "H";
        listen(&console, &test_hal);
        port.step_us = 0;
        port.now_us = holds[i].hold_us;
        report(&drawn, &console, 7);
        expect_said(holds[i].line);
    }
}

static void while_it_holds_each_frame_has_a_line(void **state)
{
    (void)state;
    struct console console = {.holding = true};
    port.now_us = 999;
    report(&drawn, &console, 0); /* less than a millisecond has no rate */
    expect_said("frame 0, 0 frames/s, left out 0 triangles 0 vertices, stack 4032\r\n");
    port.now_us = 10999;
    report(&drawn, &console, 1);
    expect_said("frame 1, 100 frames/s, left out 0 triangles 0 vertices, stack 4032\r\n");
}

static void a_letter_presses_its_button_for_one_frame(void **state)
{
    (void)state;
    static const struct {
        const char *typed;
        uint32_t buttons;
    } keys[] = {{"u", HAL_BUTTON_UP},
                {"d", HAL_BUTTON_DOWN},
                {"l", HAL_BUTTON_LEFT},
                {"r", HAL_BUTTON_RIGHT},
                {"s", HAL_BUTTON_SELECT},
                {"us", HAL_BUTTON_UP | HAL_BUTTON_SELECT},
                {"xU \n", 0}};
    struct console console = {.holding = false};
    for (size_t i = 0; i < sizeof keys / sizeof keys[0]; i++) {
        port.typed = keys[i].typed;
        listen(&console, &test_hal);
        assert_int_equal(console.buttons, keys[i].buttons);
        listen(&console, &test_hal);
        assert_int_equal(console.buttons, 0);
    }
}

static void h_holds_and_g_goes_on(void **state)
{
    (void)state;
    struct console console = {.holding = false};
    port.typed = "HuG";
    listen(&console, &test_hal);
    assert_true(console.holding);
    assert_string_equal(port.typed, "uG"); /* they wait for the next frame */
    listen(&console, &test_hal);
    assert_false(console.holding);
    assert_int_equal(console.buttons, HAL_BUTTON_UP);
    assert_false(console.reporting);
}

static void a_report_is_asked_for_once(void **state)
{
    (void)state;
    struct console console = {.holding = true};
    port.typed = "RH";
    listen(&console, &test_hal);
    assert_true(console.reporting && console.holding);
    listen(&console, &test_hal);
    assert_false(console.reporting);
}

static void b_reboots_into_the_boot_loader(void **state)
{
    (void)state;
    struct console console = {.holding = false};
    port.typed = "b";
    listen(&console, &test_hal);
    assert_int_equal(port.boot_loader, 0);
    port.typed = "B";
    listen(&console, &test_hal);
    assert_int_equal(port.boot_loader, 1);
}

/* A line reads pressed until its pull-up has charged it, which takes up to 20 ms. */
static void a_line_that_is_still_charged_is_no_press(void **state)
{
    (void)state;
    port.pressed = HAL_BUTTON_LEFT;
    port.charged_us = 19900;
    assert_false(button_held(&test_hal));
    fresh(state);
    port.pressed = HAL_BUTTON_LEFT;
    port.charged_us = 1000000;
    assert_true(button_held(&test_hal));
    assert_in_range(port.now_us, 20000, 20300); /* it waits no longer than it must */
}

static void an_erased_flash_is_no_broken_scene(void **state)
{
    (void)state;
    memset(flash, 0xFF, sizeof flash);
    assert_false(has_scene());
    expect_said("");
    memset(flash, 0x5A, sizeof flash);
    assert_false(has_scene());
    assert_int_equal(strncmp(port.said, "the scene in flash is ", 22), 0);
    assert_string_equal(port.said + strlen(port.said) - 2, "\r\n");
}

/* Runs the image until what is typed is done, and compares the glass with a frame of a demo. */
static void run_image(const char *typed, const struct demo *demo, uint32_t frame)
{
    static uint8_t seen[3 * 240 * 135];
    struct sim *const sim = sim_open(board_here, &port.kit);
    struct sim_player player;
    const struct sim_player_setup setup = {
        .board = board_here, .rotation = board_here->rotation, .band_height = board_here->band_height, .demo = demo};
    assert_non_null(sim);
    port.typed = typed;
    port.fails = sim;
    assert_int_equal(image_main(), 1);
    sim_pixels(sim, board_here->rotation, seen);
    assert_int_equal(sim_player_open(&player, &setup), 0);
    assert_int_equal(sim_player_frame(&player, frame), 0);
    assert_int_equal(player.picture.width * player.picture.height, 240 * 135);
    assert_memory_equal(seen, player.picture.rgb, sizeof seen);
    assert_int_equal(sim_player_close(&player), 0);
    sim_close(sim);
}

static bool says(const char *text)
{
    return strstr(port.said, text) != NULL;
}

/* The 'G' of a frame that goes on is the third; the fourth is begun, and its bus fails. */
static void the_frames_are_the_simulators_until_the_bus_fails(void **state)
{
    (void)state;
    run_image("HHG", &demo_turntable, 2);
    assert_int_equal(strncmp(port.said, "\r\nPinhole on ", 13), 0);
    assert_true(says("\r\ndemo turntable\r\nframe 0, "));
    assert_true(says("\nframe 1, ") && !says("\nframe 2, "));
    char last[40];
    snprintf(last, sizeof last, "stopped: error %d\r\n", -HAL_EIO);
    assert_true(says(last));
}

static void the_select_button_takes_the_next_demo_and_says_so(void **state)
{
    (void)state;
    const struct demo *const next = demo_list[1];
    assert_ptr_equal(demo_list[0], &demo_turntable);
    run_image("HsH", next, 1);
    char line[60];
    snprintf(line, sizeof line, "demo %s\r\nframe 1, ", next->name);
    assert_true(says(line));
}

static void a_report_takes_no_frames_number_and_leaves_the_test_card(void **state)
{
    (void)state;
    run_image("HRH", &demo_testcard, 1);
    assert_true(says("test"));                                                       /* how it was built */
    assert_true(says("\nframe 1, ") && says("\nframe 2, ") && !says("\nframe 3, ")); /* 2 has failed */
}

static void tiles_are_sent_if_their_signatures_have_room(void **state)
{
    (void)state;
    struct panel_tiles tiles;
    assert_ptr_equal(sender(&tiles).ops, panel_sender_whole.ops); /* there are 4 bytes */
}

static void facts_are_written_in_their_form(void **state)
{
    (void)state;
    log_facts(NULL, log_text);
    log_fact("and ", 31, PORT_DECIMAL);
    log_fact("\n", 7, PORT_TEXT);
    assert_non_null(strstr(port.said, "fact "));
    assert_non_null(strstr(port.said, "1F") != NULL ? strstr(port.said, "1F") : strstr(port.said, "1f"));
    assert_non_null(strstr(port.said, "and 31\r\n"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(a_line_a_second_tells_the_frames_of_that_second, fresh),
        cmocka_unit_test_setup(the_rate_after_a_hold_is_right_however_long_it_was, fresh),
        cmocka_unit_test_setup(while_it_holds_each_frame_has_a_line, fresh),
        cmocka_unit_test_setup(a_letter_presses_its_button_for_one_frame, fresh),
        cmocka_unit_test_setup(h_holds_and_g_goes_on, fresh),
        cmocka_unit_test_setup(a_report_is_asked_for_once, fresh),
        cmocka_unit_test_setup(b_reboots_into_the_boot_loader, fresh),
        cmocka_unit_test_setup(a_line_that_is_still_charged_is_no_press, fresh),
        cmocka_unit_test_setup(an_erased_flash_is_no_broken_scene, fresh),
        cmocka_unit_test_setup(the_frames_are_the_simulators_until_the_bus_fails, fresh),
        cmocka_unit_test_setup(the_select_button_takes_the_next_demo_and_says_so, fresh),
        cmocka_unit_test_setup(a_report_takes_no_frames_number_and_leaves_the_test_card, fresh),
        cmocka_unit_test_setup(tiles_are_sent_if_their_signatures_have_room, fresh),
        cmocka_unit_test_setup(facts_are_written_in_their_form, fresh),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
