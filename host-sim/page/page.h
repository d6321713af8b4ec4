/*
 * page: the simulator as a WebAssembly module, which page_core.js calls. It is a sim_player with one kit at a time.
 * Boards, demos, views and depth formats are numbers here, in the order of the lists. What is printed on stdout (lists)
 * and stderr (the cost of a frame, messages) goes to the page.
 */
#ifndef PAGE_H
#define PAGE_H

#include <stdint.h>

#define PAGE_EXPORT __attribute__((visibility("default"))) /* page.mk compiles with all else hidden */

/* Prints what --list --json prints, and behind it an array of the depth formats' names. */
PAGE_EXPORT void page_list(void);

/* Returns 8-byte aligned memory for a binary scene of n bytes (scene_file.h), in place of the one before; no kit is
 * open then. NULL: there is none. */
PAGE_EXPORT uint8_t *page_scene_room(uint32_t n);

/* Takes the scene that was written there. 0, or another number and a message. */
PAGE_EXPORT int page_scene(void);

/* Opens a kit with its power on, or with board -1 a glass of this size, in place of the one before. Demo -1
 * is the binary scene. 0, or another number and a message. */
PAGE_EXPORT int page_open(int board, unsigned width, unsigned height, int demo, unsigned view, unsigned depth);

#define PAGE_WORDS 8192 /* bytes */

/* Returns PAGE_WORDS bytes for the options of pinhole-sim, each with a 0 behind it. */
PAGE_EXPORT char *page_words(void);

/* Does what pinhole-sim does with so many options from there, but for files: opens the kit in place of the one before,
 * prints what --matrix, --point and --frustum ask for on stdout, and draws the first frame, also where nothing can be
 * printed of it. 0, or another number if there is no picture; what is wrong is on stderr. */
PAGE_EXPORT int page_run(uint32_t count);

/* Draws a frame while these buttons (enum hal_button) are held, and sends it to the glass. 0, or another number and a
 * message. */
PAGE_EXPORT int page_frame(uint32_t frame, uint32_t buttons);

/* Prints the cost of the last frame on stderr, as --stats --json does. */
PAGE_EXPORT void page_stats(uint32_t frame);

/* Moves the camera from the next frame on, as sim_player_drag does. */
PAGE_EXPORT void page_drag(int32_t right, int32_t down, int32_t notches);

/* Moves the camera as sim_player_move does, and tells how far it has been moved since the kit was opened. */
PAGE_EXPORT void page_move(uint32_t turn32, int32_t up32, int32_t away);
PAGE_EXPORT int32_t page_turned(void);
PAGE_EXPORT int32_t page_raised(void);
PAGE_EXPORT int32_t page_away(void);

/* Returns the glass's size, and its rows of RGB888 as the last frame left them. */
PAGE_EXPORT uint32_t page_width(void);
PAGE_EXPORT uint32_t page_height(void);
PAGE_EXPORT const uint8_t *page_rgb(void);

/* Returns what --crc prints of the last frame. */
PAGE_EXPORT uint32_t page_crc(void);

/* Returns which demo is shown: the select button takes the next one. */
PAGE_EXPORT uint32_t page_demo(void);

/* Returns 1 where the glass is a disc, else 0. */
PAGE_EXPORT int page_round(void);

#endif
