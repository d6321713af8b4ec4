/* kms_keys: keys of evdev as a kit's buttons. While they are open a terminal on stdin does not echo what is typed. */
#ifndef HAL_KMS_KEYS_H
#define HAL_KMS_KEYS_H

#include <stdbool.h>
#include <stdint.h>
#include <termios.h>

#define KMS_KEYS_MAX 16 /* input devices */

/* Private, but for denied. */
struct kms_keys {
    int device[KMS_KEYS_MAX];
    uint32_t count;
    bool denied; /* there are input devices, and none may be read */
    bool quiet;  /* the terminal was changed */
    struct termios terminal;
};

void kms_keys_open(struct kms_keys *keys);

/* The buttons (enum hal_button) that are held, or were pressed since the last call. */
uint32_t kms_keys_read(const struct kms_keys *keys);

/* Forgets what was typed into the terminal meanwhile. */
void kms_keys_close(struct kms_keys *keys);

#endif
