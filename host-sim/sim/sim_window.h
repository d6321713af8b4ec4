/*
 * sim_window: the panel in a window of the desktop, the keyboard as the board's buttons. sdl/ does it with SDL2, nosdl/
 * says what to install; the Makefile picks.
 */
#ifndef SIM_WINDOW_H
#define SIM_WINDOW_H

#include <stdbool.h>
#include <stdint.h>

struct sim_window;

/* A window for pictures of width x height, scaled up by the largest whole number at which it takes up to 3/4 of the
 * screen. 0, or COMPLAINED when one line has said why. */
int sim_window_open(struct sim_window **window, const char *title, uint16_t width, uint16_t height);

/* What was pressed since the last call or is held now, enum hal_button: the arrows, Enter or space as select.
 * False: the user has closed the window or pressed Esc. */
bool sim_window_buttons(const struct sim_window *window, uint32_t *buttons);

/* Shows a picture (RGB888 rows), frame_ns after the one before: a slower machine shows it at once. */
void sim_window_show(struct sim_window *window, const uint8_t *rgb, uint64_t frame_ns);

/* NULL does nothing. */
void sim_window_close(struct sim_window *window);

#endif
