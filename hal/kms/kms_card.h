/* kms_card: a card of /dev/dri with one of its displays. libdrm/ and nolibdrm/ are chosen when Pinhole is built. */
#ifndef HAL_KMS_CARD_H
#define HAL_KMS_CARD_H

#include <stdbool.h>
#include <stdint.h>

#define KMS_ERROR_SIZE 384
#define KMS_NAME_SIZE  32

struct kms_card;

/* A buffer of XRGB8888: a 32-bit word a pixel. */
struct kms_buffer {
    uint32_t *pixels;
    uint32_t stride; /* pixels from a line to the next */
};

struct kms_clip {
    uint16_t x0, y0, x1, y1; /* x1, y1: one past the end */
};

/*
 * Opens the card, and finds a connected display on it and its own mode. where: see struct kms. Takes nothing yet.
 * Errors (HAL_E..) leave *out NULL and a line in error.
 */
int kms_card_open(struct kms_card **out, const char *where, char error[KMS_ERROR_SIZE]);

/* The size of the card's mode. */
void kms_card_size(const struct kms_card *card, uint32_t *width, uint32_t *height);

/* Shows an empty buffer. 0, or an error with its line in error. */
int kms_card_take(struct kms_card *card, char error[KMS_ERROR_SIZE]);

/* The buffer that is drawn into next. keeps: it is the one that is shown, so that only changes need be drawn. */
struct kms_buffer kms_card_buffer(const struct kms_card *card, bool *keeps);

/* Shows the buffer; clips are what changed, 0: all of it. */
int kms_card_show(struct kms_card *card, const struct kms_clip *clips, uint32_t count, char error[KMS_ERROR_SIZE]);

/* Gives the display back and frees the card. NULL does nothing. */
void kms_card_close(struct kms_card *card);

/* Calls tell for each display of each card: "card0:HDMI-A-1", its own mode, or 0 x 0 when nothing is connected. */
void kms_card_list(void (*tell)(const char *name, uint32_t width, uint32_t height));

#endif
