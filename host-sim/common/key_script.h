/*
 * key_script: a script of button presses for pinhole-sim, so that a walk through a scene can be repeated. A line is
 *
 *   FRAME BUTTON[+BUTTON...] [COUNT]      # and whatever follows a number sign is a comment
 *
 * The buttons up, down, left, right and select are held from frame number FRAME on, COUNT frames long (1 by default);
 * lines add up, in any order. Spaces or tabs stand between the words.
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

/* Reads a script; path NULL: one without presses. 0; COMPLAINED: the file cannot be read; PH_ERR_INVAL: a line is
 * wrong; one line has said why. Free it in any case. */
int key_script_read(struct key_script *keys, const char *path);

/* enum hal_button that are held during this frame. */
uint32_t key_script_at(const struct key_script *keys, uint32_t frame);

void key_script_free(struct key_script *keys);

#endif
