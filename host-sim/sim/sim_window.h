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

/* What the user did since the last call. */
struct sim_window_input {
    uint32_t buttons;       /* enum hal_button, pressed or held: the arrows, and Enter or space as select */
    int32_t drag;           /* pixels of the picture that the mouse moved to the right while its left button was held */
    int32_t lift;           /* and downwards, as if it pulled the scene: the camera rises */
    int32_t notches;        /* that the wheel was turned away from the user */
    bool pause, step;       /* P was pressed; N was: the next frame, and no more */
    bool save;              /* S was pressed: the picture is wanted as a file */
    uint16_t width, height; /* for a picture of this size the window has room, 1 .. 1024 each */
};

/* Reads keyboard and mouse; F fills the screen, and again leaves it. False: the user has closed the window or pressed
 * Esc. */
bool sim_window_input(const struct sim_window *window, struct sim_window_input *input);

void sim_window_title(struct sim_window *window, const char *title);

/* Pictures have this size from now on. 0 or COMPLAINED. */
int sim_window_resize(struct sim_window *window, uint16_t width, uint16_t height);

/* Shows a picture (RGB888 rows) frame_ns after the previous one, or at once if that time is over. */
void sim_window_show(struct sim_window *window, const uint8_t *rgb, uint64_t frame_ns);

/* Closes the window; NULL does nothing. */
void sim_window_close(struct sim_window *window);

#endif
