/* sim_window: size, keys, pointer and pace of a window, on the screen that SDL's dummy driver plays. */
#define _XOPEN_SOURCE 700
#include <SDL2/SDL.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "complain.h"
#include "hal.h"
#include "sim_window.h"
#include "stderr_capture.h"

#include <stdlib.h>
#include <string.h>

static struct sim_window *window;
static struct sim_window_input input;

/* The dummy's screen has 1024 x 768: a picture of 100 x 50 is enlarged 7 times, to 3/4 of its width. */
static int open_window(void **state)
{
    (void)state;
    setenv("SDL_VIDEODRIVER", "dummy", 1);
    return sim_window_open(&window, "A title", 100, 50);
}

static int close_window(void **state)
{
    (void)state;
    sim_window_close(window);
    return 0;
}

static SDL_Window *sdl_window(void)
{
    return SDL_GetWindowFromID(1);
}

static void key(SDL_Scancode code)
{
    SDL_Event e = {.key = {.type = SDL_KEYDOWN, .keysym = {.scancode = code}}};
    SDL_PushEvent(&e);
}

static void pointer(int right, int down, uint32_t buttons)
{
    SDL_Event e = {.motion = {.type = SDL_MOUSEMOTION, .state = buttons, .xrel = right, .yrel = down}};
    SDL_PushEvent(&e);
}

static void wheel(int notches)
{
    SDL_Event e = {.wheel = {.type = SDL_MOUSEWHEEL, .y = notches}};
    SDL_PushEvent(&e);
}

static void a_picture_is_enlarged_by_a_whole_number(void **state)
{
    static const struct {
        uint16_t width, height;
        int scale;
    } cases[] = {{100, 50, 7}, {50, 100, 5}, {240, 240, 2}, {400, 300, 1}, {1024, 1024, 1}};
    SDL_Rect screen = {0, 0, 0, 0};
    (void)state;
    assert_int_equal(SDL_GetDisplayUsableBounds(0, &screen), 0);
    assert_true(screen.w == 1024 && screen.h == 768);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        int width, height;
        sim_window_close(window);
        assert_int_equal(sim_window_open(&window, "A title", cases[i].width, cases[i].height), 0);
        assert_string_equal(SDL_GetWindowTitle(sdl_window()), "A title");
        SDL_GetWindowSize(sdl_window(), &width, &height);
        assert_int_equal(width, cases[i].width * cases[i].scale);
        assert_int_equal(height, cases[i].height * cases[i].scale);
        assert_true(sim_window_input(window, &input));
        assert_true(input.width == cases[i].width && input.height == cases[i].height);
    }
}

static void room_follows_the_windows_size(void **state)
{
    (void)state;
    SDL_SetWindowSize(sdl_window(), 699, 3);
    assert_true(sim_window_input(window, &input));
    assert_true(input.width == 99 && input.height == 1); /* at least one pixel */
    SDL_SetWindowSize(sdl_window(), 7 * 1025, 700);
    assert_true(sim_window_input(window, &input));
    assert_true(input.width == 1024 && input.height == 100);
}

static void each_key_is_a_button_though_it_is_up_again(void **state)
{
    static const struct {
        SDL_Scancode code;
        uint32_t button;
    } keys[] = {{SDL_SCANCODE_UP, HAL_BUTTON_UP},           {SDL_SCANCODE_DOWN, HAL_BUTTON_DOWN},
                {SDL_SCANCODE_LEFT, HAL_BUTTON_LEFT},       {SDL_SCANCODE_RIGHT, HAL_BUTTON_RIGHT},
                {SDL_SCANCODE_RETURN, HAL_BUTTON_SELECT},   {SDL_SCANCODE_SPACE, HAL_BUTTON_SELECT},
                {SDL_SCANCODE_KP_ENTER, HAL_BUTTON_SELECT}, {SDL_SCANCODE_A, 0}};
    (void)state;
    for (size_t i = 0; i < sizeof keys / sizeof keys[0]; i++) {
        key(keys[i].code);
        assert_true(sim_window_input(window, &input));
        assert_int_equal(input.buttons, keys[i].button);
        assert_true(sim_window_input(window, &input));
        assert_int_equal(input.buttons, 0);
    }
    key(SDL_SCANCODE_UP);
    key(SDL_SCANCODE_LEFT);
    sim_window_input(window, &input);
    assert_int_equal(input.buttons, HAL_BUTTON_UP | HAL_BUTTON_LEFT);
}

static void pointer_drags_with_its_left_button_alone(void **state)
{
    (void)state;
    pointer(3, -5, SDL_BUTTON_LMASK);
    pointer(10, 20, 0);
    pointer(30, 40, SDL_BUTTON_RMASK);
    pointer(4, 1, SDL_BUTTON_LMASK | SDL_BUTTON_RMASK);
    wheel(2);
    wheel(-5);
    assert_true(sim_window_input(window, &input));
    assert_true(input.drag == 7 && input.lift == -4 && input.notches == -3);
    assert_true(sim_window_input(window, &input));
    assert_true(input.drag == 0 && input.lift == 0 && input.notches == 0);
}

static void escape_or_closing_ends_it(void **state)
{
    SDL_Event quit = {.type = SDL_QUIT};
    (void)state;
    key(SDL_SCANCODE_ESCAPE);
    key(SDL_SCANCODE_UP);
    assert_false(sim_window_input(window, &input));
    assert_int_equal(input.buttons, HAL_BUTTON_UP);
    assert_true(sim_window_input(window, &input));
    SDL_PushEvent(&quit);
    assert_false(sim_window_input(window, &input));
}

static void keys_pause_step_save_and_fill_the_screen(void **state)
{
    (void)state;
    key(SDL_SCANCODE_P);
    assert_true(sim_window_input(window, &input) && input.pause && !input.step && !input.save);
    key(SDL_SCANCODE_P);
    key(SDL_SCANCODE_P);
    key(SDL_SCANCODE_N);
    key(SDL_SCANCODE_S);
    assert_true(sim_window_input(window, &input) && !input.pause && input.step && !input.save);
    assert_true(sim_window_input(window, &input) && !input.pause && !input.step && input.save); /* the next picture */
    assert_true(sim_window_input(window, &input) && !input.pause && !input.step && !input.save);
    SDL_Event held = {.key = {.type = SDL_KEYDOWN, .repeat = 1, .keysym = {.scancode = SDL_SCANCODE_P}}};
    SDL_PushEvent(&held);
    held.key.keysym.scancode = SDL_SCANCODE_N;
    SDL_PushEvent(&held);
    assert_true(sim_window_input(window, &input) && !input.pause && input.step);
    for (int i = 0; i < 2; i++) {
        assert_int_equal(SDL_GetWindowFlags(sdl_window()) & SDL_WINDOW_FULLSCREEN, i * SDL_WINDOW_FULLSCREEN);
        key(SDL_SCANCODE_F);
        assert_true(sim_window_input(window, &input) && input.buttons == 0);
    }
    assert_int_equal(SDL_GetWindowFlags(sdl_window()) & SDL_WINDOW_FULLSCREEN, 0);
}

/* Reads the picture back from the window. */
static void pictures_are_shown_and_their_size_may_change(void **state)
{
    static uint8_t rgb[3 * 10 * 10], seen[3 * 700 * 350];
    (void)state;
    for (int i = 0; i < 100; i++) {
        rgb[3 * i] = (uint8_t)(2 * i), rgb[3 * i + 1] = 100, rgb[3 * i + 2] = (uint8_t)(255 - i);
    }
    assert_int_equal(sim_window_resize(window, 10, 10), 0);
    sim_window_title(window, "Another");
    assert_string_equal(SDL_GetWindowTitle(sdl_window()), "Another");
    sim_window_show(window, rgb, 0);
    SDL_Renderer *const renderer = SDL_GetRenderer(sdl_window());
    assert_true(SDL_RenderGetIntegerScale(renderer));
    assert_int_equal(SDL_RenderReadPixels(renderer, NULL, SDL_PIXELFORMAT_RGB24, seen, 3 * 700), 0);
    for (int i = 0; i < 100; i++) { /* 35 times as large; what is read begins at the picture */
        const int x = 35 * (i % 10) + 17, y = 35 * (i / 10) + 17;
        assert_memory_equal(seen + 3 * ((size_t)y * 700 + (size_t)x), rgb + 3 * i, 3);
    }
    SDL_SetWindowSize(sdl_window(), 9, 20); /* smaller than the picture */
    sim_window_show(window, rgb, 0);
    assert_false(SDL_RenderGetIntegerScale(renderer));
    SDL_SetWindowSize(sdl_window(), 10, 10);
    sim_window_show(window, rgb, 0);
    assert_true(SDL_RenderGetIntegerScale(renderer));
}

static void a_picture_waits_until_it_is_due(void **state)
{
    static const uint8_t rgb[3 * 100 * 50];
    (void)state;
    sim_window_show(window, rgb, 0);
    uint64_t from = SDL_GetPerformanceCounter();
    for (int i = 0; i < 4; i++) {
        sim_window_show(window, rgb, 10000000);
    }
    assert_true(SDL_GetPerformanceCounter() - from >= 35 * SDL_GetPerformanceFrequency() / 1000);
    SDL_Delay(40);
    sim_window_show(window, rgb, 10000000); /* it is late: what comes next counts from now */
    from = SDL_GetPerformanceCounter();
    sim_window_show(window, rgb, 20000000);
    assert_true(SDL_GetPerformanceCounter() - from >= 15 * SDL_GetPerformanceFrequency() / 1000);
}

static void without_a_screen_a_line_says_so(void **state)
{
    struct stderr_capture said;
    struct sim_window *none = window;
    (void)state;
    setenv("SDL_VIDEODRIVER", "nothing", 1);
    stderr_capture_begin(&said);
    const int status = sim_window_open(&none, "", 100, 50);
    stderr_capture_end(&said);
    assert_int_equal(status, COMPLAINED);
    assert_null(none);
    assert_non_null(strstr(said.text, "--window: no screen ("));
    sim_window_close(none);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_picture_is_enlarged_by_a_whole_number, open_window, close_window),
        cmocka_unit_test_setup_teardown(room_follows_the_windows_size, open_window, close_window),
        cmocka_unit_test_setup_teardown(each_key_is_a_button_though_it_is_up_again, open_window, close_window),
        cmocka_unit_test_setup_teardown(pointer_drags_with_its_left_button_alone, open_window, close_window),
        cmocka_unit_test_setup_teardown(escape_or_closing_ends_it, open_window, close_window),
        cmocka_unit_test_setup_teardown(keys_pause_step_save_and_fill_the_screen, open_window, close_window),
        cmocka_unit_test_setup_teardown(pictures_are_shown_and_their_size_may_change, open_window, close_window),
        cmocka_unit_test_setup_teardown(a_picture_waits_until_it_is_due, open_window, close_window),
        cmocka_unit_test(without_a_screen_a_line_says_so),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
