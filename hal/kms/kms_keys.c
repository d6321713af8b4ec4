/* See kms_keys.h. */
#define _POSIX_C_SOURCE 200809L

#include "kms_keys.h"

#include "hal.h"

#include <errno.h>
#include <fcntl.h>
#include <linux/input.h>
#include <stdio.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

#define DEVICES 64 /* /dev/input/event0 .. */

static const struct {
    uint16_t key;
    uint8_t button;
} map[] = {
    {KEY_UP, HAL_BUTTON_UP},         {KEY_DOWN, HAL_BUTTON_DOWN},    {KEY_LEFT, HAL_BUTTON_LEFT},
    {KEY_RIGHT, HAL_BUTTON_RIGHT},   {KEY_ENTER, HAL_BUTTON_SELECT}, {KEY_SPACE, HAL_BUTTON_SELECT},
    {KEY_SELECT, HAL_BUTTON_SELECT}, {KEY_OK, HAL_BUTTON_SELECT},    {BTN_SOUTH, HAL_BUTTON_SELECT},
};
#define KEYS (sizeof map / sizeof map[0])

/* The buttons whose keys are in a bit field of the kernel. */
static uint32_t buttons_of(const uint8_t bits[KEY_CNT / 8])
{
    uint32_t buttons = 0;
    for (size_t i = 0; i < KEYS; i++) {
        buttons |= (bits[map[i].key / 8] >> (map[i].key % 8) & 1) != 0 ? map[i].button : 0U;
    }
    return buttons;
}

/* Opens an input device. Returns a descriptor, or a negative errno; ENODEV: it has none of our keys. */
static int open_device(unsigned number)
{
    char path[40];
    uint8_t bits[KEY_CNT / 8] = {0};
    snprintf(path, sizeof path, "/dev/input/event%u", number);
    const int device = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (device < 0) {
        return -errno;
    }
    if (ioctl(device, EVIOCGBIT(EV_KEY, sizeof bits), bits) < 0 || buttons_of(bits) == 0) {
        close(device);
        return -ENODEV;
    }
    return device;
}

/* Stops the echo of the terminal. One that is not ours (a job in the background) stays as it is. */
static void quiet_terminal(struct kms_keys *keys)
{
    if (tcgetpgrp(STDIN_FILENO) != getpgrp() || tcgetattr(STDIN_FILENO, &keys->terminal) != 0) {
        return;
    }
    struct termios quiet = keys->terminal;
    quiet.c_lflag &= ~(tcflag_t)(ECHO | ICANON);
    keys->quiet = tcsetattr(STDIN_FILENO, TCSANOW, &quiet) == 0;
}

void kms_keys_open(struct kms_keys *keys)
{
    memset(keys, 0, sizeof *keys);
    bool read = false;
    for (unsigned i = 0; i < DEVICES && keys->count < KMS_KEYS_MAX; i++) {
        const int device = open_device(i);
        if (device >= 0) {
            keys->device[keys->count++] = device;
        }
        read = read || device >= 0 || device == -ENODEV;
        keys->denied = keys->denied || device == -EACCES;
    }
    keys->denied = keys->denied && !read;
    quiet_terminal(keys);
}

uint32_t kms_keys_read(const struct kms_keys *keys)
{
    uint32_t buttons = 0;
    for (uint32_t i = 0; i < keys->count; i++) {
        struct input_event event;
        uint8_t bits[KEY_CNT / 8] = {0};
        while (read(keys->device[i], &event, sizeof event) == (ssize_t)sizeof event) {
            if (event.type == EV_KEY && event.value == 1 && event.code < KEY_CNT) {
                bits[event.code / 8] |= (uint8_t)(1U << event.code % 8);
            }
        }
        buttons |= buttons_of(bits);
        memset(bits, 0, sizeof bits);
        if (ioctl(keys->device[i], EVIOCGKEY(sizeof bits), bits) >= 0) {
            buttons |= buttons_of(bits);
        }
    }
    return buttons;
}

void kms_keys_close(struct kms_keys *keys)
{
    for (uint32_t i = 0; i < keys->count; i++) {
        close(keys->device[i]);
    }
    if (keys->quiet) {
        tcsetattr(STDIN_FILENO, TCSAFLUSH, &keys->terminal);
    }
    keys->count = 0;
    keys->quiet = false;
}
