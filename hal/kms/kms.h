/*
 * kms: a display that the kernel drives already (HDMI, DSI, panel-mipi-dbi, ..), through kernel mode setting (KMS) and
 * libdrm. Its buttons are the arrow keys and Enter or Space of every input device (evdev): gpio-keys or a keyboard.
 *
 *   static struct kms context = {.where = "card0:HDMI-A-1"};    NULL: the first display that is connected
 *   kms_find(&context);                                         chooses connector and mode: width and height are known
 *   struct hal hal = {&kms_ops, &context};                      no bus: what is written to it goes nowhere
 *   runner's sender = kms_sender(&context)                      draws, and shows a frame with its last line
 *
 * The mode is the display's own (its preferred one). A picture has at most 1024 x 1024 pixels: on a larger display each
 * becomes a square of scale x scale, and the rest stays black around it. RGB565 becomes XRGB8888 by repeating the
 * highest bits of each channel, as in the simulator.
 *
 * Where the driver has DIRTYFB (it sends or copies the picture itself), only what changed is written and given to it, a
 * rectangle a band. Otherwise frames go to two buffers in turn, and a page flip shows the one that is ready.
 *
 * close gives the display back to who had it before, and the terminal its echo; the kernel does the former even when
 * the program is killed. One display at a time is in a context, which must not move while it is open.
 *
 * Without libdrm (its folder is chosen when Pinhole is built) kms_find returns HAL_ENOSYS.
 */
#ifndef HAL_KMS_H
#define HAL_KMS_H

#include "board.h"
#include "kms_card.h"
#include "kms_keys.h"
#include "panel.h"

#define KMS_SIDE_MAX  1024 /* pixels of a picture */
#define KMS_CLIPS_MAX 64

/* Read-only for the caller, but for where: width, height, scale, keys.denied. */
struct kms {
    const char *where; /* "CARD[:CONNECTOR]", as /dev/dri and `pinhole-panel list` name them; NULL */

    uint16_t width, height; /* of an upright picture */
    uint8_t scale;          /* display pixels along each side of a pixel */

    /* Private from here on. */
    struct kms_card *card;
    struct kms_keys keys;
    struct kms_buffer buffer; /* what is drawn into */
    struct kms_clip clips[KMS_CLIPS_MAX];
    uint32_t clip_count;
    uint32_t left, top; /* of the picture on the display */
    uint16_t *shown;    /* the last picture, where the card keeps its buffer */
    uint32_t row;
    bool whole; /* the next frame is drawn whole */
    char error[KMS_ERROR_SIZE];
};

/* Finds the display that k->where names. 0, or HAL_ENODEV (no such card or display), HAL_EACCES, HAL_ENOSYS. */
int kms_find(struct kms *k);

extern const struct hal_ops kms_ops;

struct panel_sender kms_sender(struct kms *k);

/* One line on the last error: what happened, where, what to do. "" if there was none. */
const char *kms_error(const struct kms *k);

#endif
