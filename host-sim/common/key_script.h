/*
 * key_script: a script of button presses for pinhole-sim, so that a walk through a scene can be repeated. A line is
 *
 *   FRAME BUTTON[+BUTTON...] [COUNT]      # a comment
 *
 * The buttons up, down, left, right and select are held for COUNT frames (1 by default) from frame number FRAME on.
 * Lines may stand in any order and add up. Spaces or tabs separate the words.
 */
#ifndef KEY_SCRIPT_H
#define KEY_SCRIPT_H

#include <stddef.h>
#include <stdint.h>

struct key_press;

struct key_script {
    struct key_press *presses;
    size_t count;
};

/* Reads a script; without a path it has no presses. 0; COMPLAINED when the file cannot be read; PH_ERR_INVAL when a
 * line is wrong. Free it in any case. */
int key_script_read(struct key_script *keys, const char *path);

/* Returns the buttons (enum hal_button) that are held during this frame. */
uint32_t key_script_at(const struct key_script *keys, uint32_t frame);

void key_script_free(struct key_script *keys);

#endif
