/* See sim_window.h. Stands in where SDL2 is not installed: no window can be opened, so the other functions are never
 * called. */
#include "sim_window.h"

#include "complain.h"

#include <stddef.h>

int sim_window_open(struct sim_window **window, const char *title, uint16_t width, uint16_t height)
{
    (void)title;
    (void)width;
    (void)height;
    *window = NULL;
    return complain("--window: built without SDL2; install libsdl2-dev, then run make again");
}

bool sim_window_input(const struct sim_window *window, struct sim_window_input *input)
{
    (void)window;
    *input = (struct sim_window_input){.buttons = 0};
    return true;
}

void sim_window_title(struct sim_window *window, const char *title)
{
    (void)window, (void)title;
}

int sim_window_resize(struct sim_window *window, uint16_t width, uint16_t height)
{
    (void)window, (void)width, (void)height;
    return 0;
}

void sim_window_show(struct sim_window *window, const uint8_t *rgb, uint64_t frame_ns)
{
    (void)window;
    (void)rgb;
    (void)frame_ns;
}

void sim_window_close(struct sim_window *window)
{
    (void)window;
}
