/* panel_identify: modules that are not what their name says, with a user who knows a right picture when he sees it. */
#define _POSIX_C_SOURCE 200809L /* fmemopen */

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "complain.h"
#include "panel_identify.h"
#include "panel_kit.h"
#include "panel_picture.h"
#include "panel_show.h"
#include "panels.h"
#include "sim_model.h"
#include "stderr_capture.h"

#include <string.h>

/* A module: the glass that its name does not tell, and how its user holds it. */
struct module {
    const char *panel;
    bool complement, bgr;
    uint16_t left, top;
    uint8_t held;
    const char *printed;
};

static const struct module modules[] = {
    {"st7735s-80x160", false, true, 24, 0, PANEL_R90,
     "options  --invert off --offset 24,0 --rotate 90\nboard.c  .rotation = PANEL_R90,\n"
     "panel    .x0 = 24, .y0 = 0, .rotation_base = 0x08, and in .init 0x20, 0,\n"},
    {"ili9341-240x320", true, false, 0, 0, PANEL_R270,
     "options  --invert on --bgr --rotate 270\nboard.c  .rotation = PANEL_R270,\n"
     "panel    .x0 = 0, .y0 = 0, .rotation_base = 0x40, and in .init 0x21, 0,\n"},
    {"st7789-240x240", true, false, 0, 40, PANEL_R0,
     "options  --offset 0,40 --rotate 0\nboard.c  .rotation = PANEL_R0,\n"
     "panel    .x0 = 0, .y0 = 40, .rotation_base = 0x00, and in .init 0x21, 0,\n"},
    {"ssd1306-128x64", false, false, 0, 0, PANEL_R180,
     "options  --rotate 180\nboard.c  .rotation = PANEL_R180,\n"
     "panel    .x0 = 0, .y0 = 0, .rotation_base = 0x09, and in .init 0xA6, 0,\n"},
};

static struct panel_kit kit;
static struct stderr_capture said;

/* What the user sees and says; `give_up`: after so many cards nothing more is typed. */
struct user {
    const struct module *module;
    int question, shown, right, give_up;
};

static int choose(void *context, const struct panel_wiring *w, struct board *board)
{
    (void)context;
    const int status = panel_kit_choose(&kit, w);
    *board = kit.board;
    return status;
}

static uint16_t picture[PICTURE_PIXELS];
static uint8_t seen[3 * PICTURE_PIXELS], expected[3 * PICTURE_PIXELS], other[3 * PICTURE_PIXELS];

/* Draws one of three pictures by a wiring, for the module as it is: all red (one colour: white), white above black, or
 * one that differs everywhere. */
static void draw(const struct module *m, const struct panel_wiring *w, int question)
{
    static uint8_t scratch[512];
    struct board board;
    struct hal hal;
    assert_int_equal(choose(NULL, w, &board), 0);
    struct sim *const sim = sim_open(&board, &hal);
    assert_non_null(sim);
    sim->glass.complement = m->complement;
    sim->glass.bgr = m->bgr;
    sim->glass.left = m->left;
    sim->glass.top = m->top;
    const struct panel_config config = {board.panel, board.rotation, board.format, 1000000, scratch, sizeof scratch};
    struct panel_driver d;
    assert_int_equal(panel_open(&d, &hal, &config), 0);
    const bool one_colour = board.panel->controller->rotation_bit_bgr == 0;
    const uint8_t all[2] = {one_colour ? 0xFF : 0xF8, one_colour ? 0xFF : 0x00};
    picture_fill(picture, d.width, d.height, 1);
    for (uint32_t i = 0; question == PANEL_COLOURS && i < (uint32_t)d.width * d.height; i++) {
        memcpy(&picture[i], all, 2);
    }
    if (question == PANEL_TURN) {
        memset(picture, 0xFF, (size_t)d.width * d.height);
        memset(picture + d.width * d.height / 2, 0x00, (size_t)d.width * d.height);
    }
    assert_int_equal(picture_draw(&d, picture, 16), 0);
    sim_pixels(sim, m->held, seen);
    picture_expect(picture, d.width, d.height, board.format, false, expected);
    sim_close(sim);
}

/* What is seen of the upright picture at these parts of its width and height, in eighths. */
static const uint8_t *at(const struct module *m, uint32_t x, uint32_t y)
{
    const struct panel *const p = panel_find(m->panel);
    const uint32_t width = panel_width(p, m->held), height = panel_height(p, m->held);
    return seen + 3 * (y * height / 8 * width + x * width / 8);
}

static bool is_right(const struct module *m, int question)
{
    const struct panel *const p = panel_find(m->panel);
    const bool one_colour = p->controller->rotation_bit_bgr == 0;
    switch (question) {
    case PANEL_COLOURS:
        return at(m, 4, 4)[0] == 255 && at(m, 4, 4)[1] == (one_colour ? 255 : 0) &&
               at(m, 4, 4)[2] == (one_colour ? 255 : 0);
    case PANEL_TURN:
        return at(m, 2, 2)[1] == 255 && at(m, 6, 2)[1] == 255 && at(m, 2, 6)[1] == 0 && at(m, 6, 6)[1] == 0;
    default:
        return memcmp(seen, expected, 3 * (size_t)p->width * p->height) == 0;
    }
}

static int show(void *context, const struct panel_wiring *w, const char *number)
{
    struct user *const u = context;
    draw(u->module, w, u->question);
    u->right = is_right(u->module, u->question) ? number[0] - '0' : 0;
    u->shown++;
    return 0;
}

static int typed(void *context)
{
    struct user *const u = context;
    if (u->shown == (u->give_up != 0 ? u->give_up : 20)) {
        return -1;
    }
    u->question += u->right != 0;
    return u->right != 0 ? u->right : u->shown == 1 ? 9 : 0; /* there is no ninth card */
}

static int run(struct user *u, struct panel_wiring *w)
{
    const struct panel_identify_user user = {choose, show, typed, u};
    stderr_capture_begin(&said);
    const int status = panel_identify(w, &user);
    stderr_capture_end(&said);
    return status;
}

static void a_module_is_right_when_its_cards_are_named(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof modules / sizeof modules[0]; i++) {
        const struct module *const m = &modules[i];
        struct user u = {.module = m};
        struct panel_wiring w = {.panel = m->panel};
        char printed[256] = "";
        assert_int_equal(run(&u, &w), 0);
        draw(m, &w, PANEL_PLACE);
        assert_true(is_right(m, PANEL_PLACE));
        assert_in_range(u.question, 2, 3);
        assert_int_equal(stderr_capture_lines(&said), 2 * u.question);
        FILE *const out = fmemopen(printed, sizeof printed, "w");
        panel_identify_print(out, &w, &kit.board);
        fclose(out);
        assert_string_equal(printed, m->printed);
    }
}

static void a_module_that_is_what_its_name_says_has_the_first_cards(void **state)
{
    (void)state;
    const struct module m = {"st7789-135x240", true, false, 52, 40, PANEL_R0, NULL};
    struct user u = {.module = &m};
    struct panel_wiring w = {.panel = m.panel};
    assert_int_equal(run(&u, &w), 0);
    assert_int_equal(u.shown, 3);
    assert_false(w.invert_set || w.bgr || w.rotate_set || w.offset_set);
}

/* What is given stands, and is the first card. */
static void variants_begin_with_what_is_given(void **state)
{
    (void)state;
    const struct panel_wiring given = {.panel = "st7735s-80x160",
                                       .invert_set = true,
                                       .invert = false,
                                       .bgr = true,
                                       .rotate_set = true,
                                       .rotate = PANEL_R180,
                                       .offset_set = true,
                                       .offset = {24, 0}};
    static const uint32_t counts[] = {4, 4, 5};
    struct panel_wiring variants[PANEL_VARIANTS_MAX];
    struct board board;
    assert_int_equal(choose(NULL, &given, &board), 0);
    for (int question = 0; question < PANEL_QUESTIONS; question++) {
        const uint32_t n = panel_identify_variants((enum panel_question)question, &given, &board, variants);
        assert_in_range(n, counts[question] - 1, counts[question]);
        assert_memory_equal(&variants[0], &given, sizeof given);
        for (uint32_t i = 1; i < n; i++) {
            for (uint32_t k = 0; k < i; k++) {
                assert_memory_not_equal(&variants[i], &variants[k], sizeof given);
            }
            assert_int_equal(choose(NULL, &variants[i], &board), 0); /* no variant lies beside the memory */
            assert_int_equal(choose(NULL, &given, &board), 0);
        }
    }
}

static void who_names_no_card_is_told(void **state)
{
    (void)state;
    struct user u = {.module = &modules[0], .give_up = 2};
    struct panel_wiring w = {.panel = modules[0].panel};
    assert_int_equal(run(&u, &w), COMPLAINED);
    assert_int_equal(u.shown, 2);
    assert_non_null(strstr(said.text, "no card was named"));
    assert_false(w.invert_set || w.bgr || w.rotate_set || w.offset_set);
}

/* ---- the card ----------------------------------------------------------------------------------- */

struct look {
    struct sim *sim;
    uint8_t *rgb;
    volatile sig_atomic_t stop;
};

static int look(void *context, struct panel_display *d, uint32_t frame)
{
    struct look *const l = context;
    if (frame == 0) {
        return 0;
    }
    assert_int_equal(runner_finish(&d->runner), 0);
    sim_pixels(l->sim, d->board->rotation, l->rgb);
    return PANEL_SHOW_OVER;
}

static void card(const struct demo *demo, const char *number, uint8_t *rgb)
{
    static struct panel_display d;
    struct look l = {.rgb = rgb};
    const struct panel_scene scene = {
        .demo = demo, .view = number, .stop = &l.stop, .before = look, .before_context = &l};
    memset(&d, 0, sizeof d);
    d.board = board_find("rpi-waveshare-1in3");
    l.sim = sim_open(d.board, &d.hal);
    assert_int_equal(panel_show_run(&d, 1, &scene), 0);
    sim_close(l.sim);
}

/* The test card but for its number, which is below the bars. */
static void each_card_has_its_number(void **state)
{
    (void)state;
    const struct demo numbered = panel_identify_card();
    card(demo_find("testcard"), NULL, expected);
    for (char number = '1'; number <= '5'; number++) {
        const char text[2] = {number, 0};
        uint32_t lit = 0;
        card(&numbered, text, seen);
        for (uint32_t i = 0; i < 240 * 240; i++) {
            const uint32_t x = i % 240, y = i / 240;
            const bool differs = memcmp(seen + 3 * i, expected + 3 * i, 3) != 0;
            assert_true(!differs || (y > 196 && y < 239 && x > 100 && x < 140));
            lit += differs;
        }
        assert_in_range(lit, 60, 300);
        assert_true(number == '1' || memcmp(seen, other, sizeof seen) != 0);
        memcpy(other, seen, sizeof seen);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_module_is_right_when_its_cards_are_named),
        cmocka_unit_test(a_module_that_is_what_its_name_says_has_the_first_cards),
        cmocka_unit_test(variants_begin_with_what_is_given),
        cmocka_unit_test(who_names_no_card_is_told),
        cmocka_unit_test(each_card_has_its_number),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
