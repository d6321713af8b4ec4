/*
 * sim_window: the panel in a window of the desktop, with the keyboard as the board's buttons. sdl/ uses SDL2; nosdl/
 * says what to install.
 */
#ifndef SIM_WINDOW_H
#define SIM_WINDOW_H

#include <stdbool.h>
#include <stdint.h>

struct sim_window;

/* Opens a window for pictures of width x height, scaled up by the largest whole number at which it takes at most 3/4 of
 * the screen. 0 or COMPLAINED. */
int sim_window_open(struct sim_window **window, const char *title, uint16_t width, uint16_t height);

/* Gets the buttons (enum hal_button) that were pressed since the last call or are held now: the arrows, and Enter or
 * space as select. False: the user has closed the window or pressed Esc. */
bool sim_window_buttons(const struct sim_window *window, uint32_t *buttons);

/* Shows a picture (RGB888 rows) frame_ns after the previous one, or at once if that time is over. */
void sim_window_show(struct sim_window *window, const uint8_t *rgb, uint64_t frame_ns);

/* NULL does nothing. */
void sim_window_close(struct sim_window *window);

#endif
