/* See kms_card.h. The legacy calls of KMS: every driver has them, and they need no properties. */
#define _POSIX_C_SOURCE 200809L

#include "../kms_card.h"
#include "../kms_fail.h"

#include "hal.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>
#include <xf86drm.h>
#include <xf86drmMode.h>

#define CARDS        16
#define FLIP_WAIT_MS 1000 /* a display has 24 frames a second or more */

struct surface {
    uint32_t handle, id; /* of the dumb buffer; of its frame buffer, 0: none */
    uint32_t stride;     /* pixels */
    size_t bytes;
    void *pixels;
};

struct kms_card {
    int file;
    char path[24], name[KMS_NAME_SIZE + 24]; /* "card0:HDMI-A-1" */
    uint32_t connector, crtc;
    drmModeModeInfo mode;
    drmModeCrtc *before; /* who had the display, and what was shown */
    struct surface surface[2];
    unsigned back;   /* the one that is drawn into */
    bool dirty, set; /* the driver has DIRTYFB; the display is ours */
};

/* ---- which display ------------------------------------------------------------------------------ */

static void name_connector(char name[KMS_NAME_SIZE], const drmModeConnector *c)
{
    const char *type = drmModeGetConnectorTypeName(c->connector_type);
    snprintf(name, KMS_NAME_SIZE, "%s-%u", type != NULL ? type : "Unknown", c->connector_type_id);
}

/* The preferred mode, or the first; NULL: nothing is connected. */
static const drmModeModeInfo *own_mode(const drmModeConnector *c)
{
    for (int i = 0; i < c->count_modes; i++) {
        if ((c->modes[i].type & DRM_MODE_TYPE_PREFERRED) != 0) {
            return &c->modes[i];
        }
    }
    return c->connection != DRM_MODE_DISCONNECTED && c->count_modes > 0 ? &c->modes[0] : NULL;
}

/* The CRTC that drives the connector now, or one that can; 0: none. */
static uint32_t find_crtc(int file, const drmModeRes *all, const drmModeConnector *c)
{
    uint32_t found = 0;
    for (int i = -1; i < c->count_encoders && found == 0; i++) {
        drmModeEncoder *encoder = drmModeGetEncoder(file, i < 0 ? c->encoder_id : c->encoders[i]);
        if (encoder == NULL) {
            continue;
        }
        found = i < 0 ? encoder->crtc_id : 0;
        for (int k = 0; k < all->count_crtcs && found == 0; k++) {
            found = (encoder->possible_crtcs >> k & 1) != 0 ? all->crtcs[k] : 0;
        }
        drmModeFreeEncoder(encoder);
    }
    return found;
}

/* Takes the connector with this name, or the first that has a display. */
static bool choose_connector(struct kms_card *card, const drmModeRes *all, const char *wanted)
{
    for (int i = 0; i < all->count_connectors && card->crtc == 0; i++) {
        drmModeConnector *c = drmModeGetConnector(card->file, all->connectors[i]);
        if (c == NULL) {
            continue;
        }
        char name[KMS_NAME_SIZE];
        name_connector(name, c);
        const drmModeModeInfo *mode = own_mode(c);
        if (mode != NULL && (wanted == NULL || strcmp(wanted, name) == 0)) {
            card->connector = c->connector_id;
            card->crtc = find_crtc(card->file, all, c);
            card->mode = *mode;
            snprintf(card->name, sizeof card->name, "%s:%s", card->path, name);
        }
        drmModeFreeConnector(c);
    }
    return card->crtc != 0;
}

static int open_path(const char *path)
{
    return open(path, O_RDWR | O_CLOEXEC);
}

/* Tries a card. 0, or an errno; ENODEV: no display is connected to it, or not this one. */
static int try_card(struct kms_card *card, const char *connector)
{
    uint64_t dumb = 0;
    card->file = open_path(card->path);
    if (card->file < 0) {
        return errno;
    }
    drmModeRes *all = drmModeGetResources(card->file);
    const bool found = all != NULL && drmGetCap(card->file, DRM_CAP_DUMB_BUFFER, &dumb) == 0 && dumb != 0 &&
                       choose_connector(card, all, connector);
    drmModeFreeResources(all);
    if (!found) {
        close(card->file);
        card->file = -1;
    }
    return found ? 0 : ENODEV;
}

/* Tries the card that is named, or all. */
static int find(struct kms_card *card, const char *where, char *error)
{
    const char *colon = where != NULL ? strchr(where, ':') : NULL;
    const int length = where == NULL ? 0 : (int)(colon != NULL ? (size_t)(colon - where) : strlen(where));
    const char *connector = colon != NULL ? colon + 1 : NULL;
    if (length > 0) {
        const int n =
            snprintf(card->path, sizeof card->path, "%s%.*s", where[0] == '/' ? "" : "/dev/dri/", length, where);
        const int number = n < (int)sizeof card->path ? try_card(card, connector) : ENOENT;
        return number == 0 ? 0
               : number == ENODEV
                   ? kms_fail(error, 0,
                              "--drm %s: no such display is connected; `pinhole-panel list` shows what is there", where)
                   : kms_fail(error, number, "%s", card->path);
    }
    int denied = 0;
    for (int i = 0; i < CARDS; i++) {
        snprintf(card->path, sizeof card->path, "/dev/dri/card%d", i);
        const int number = try_card(card, connector);
        if (number == 0) {
            return 0;
        }
        denied = number == EACCES ? number : denied;
    }
    return denied != 0
               ? kms_fail(error, denied, "/dev/dri")
               : kms_fail(error, 0, "--drm: no card in /dev/dri has a display%s%s; the kernel needs a driver for it",
                          connector != NULL ? " " : "", connector != NULL ? connector : "");
}

int kms_card_open(struct kms_card **out, const char *where, char error[KMS_ERROR_SIZE])
{
    struct kms_card *card = calloc(1, sizeof *card);
    *out = NULL;
    if (card == NULL) {
        return kms_fail(error, ENOMEM, "--drm");
    }
    card->file = -1;
    const int status = find(card, where, error);
    if (status < 0) {
        free(card);
        return status;
    }
    *out = card;
    return HAL_OK;
}

void kms_card_size(const struct kms_card *card, uint32_t *width, uint32_t *height)
{
    *width = card->mode.hdisplay;
    *height = card->mode.vdisplay;
}

static void list_connector(int file, uint32_t id, int number, void (*tell)(const char *, uint32_t, uint32_t))
{
    char name[KMS_NAME_SIZE], whole[KMS_NAME_SIZE + 16];
    drmModeConnector *c = drmModeGetConnector(file, id);
    if (c == NULL) {
        return;
    }
    const drmModeModeInfo *mode = own_mode(c);
    name_connector(name, c);
    snprintf(whole, sizeof whole, "card%d:%s", number, name);
    tell(whole, mode != NULL ? mode->hdisplay : 0, mode != NULL ? mode->vdisplay : 0);
    drmModeFreeConnector(c);
}

void kms_card_list(void (*tell)(const char *name, uint32_t width, uint32_t height))
{
    char path[24];
    for (int i = 0; i < CARDS; i++) {
        snprintf(path, sizeof path, "/dev/dri/card%d", i);
        const int file = open_path(path);
        drmModeRes *all = file >= 0 ? drmModeGetResources(file) : NULL;
        for (int k = 0; all != NULL && k < all->count_connectors; k++) {
            list_connector(file, all->connectors[k], i, tell);
        }
        drmModeFreeResources(all);
        if (file >= 0) {
            close(file);
        }
    }
}

/* ---- buffers ------------------------------------------------------------------------------------ */

static int make_surface(const struct kms_card *card, struct surface *s)
{
    struct drm_mode_create_dumb create = {.width = card->mode.hdisplay, .height = card->mode.vdisplay, .bpp = 32};
    if (drmIoctl(card->file, DRM_IOCTL_MODE_CREATE_DUMB, &create) != 0) {
        return -1;
    }
    s->handle = create.handle;
    s->stride = create.pitch / 4;
    s->bytes = (size_t)create.size;
    struct drm_mode_map_dumb map = {.handle = s->handle};
    if (drmIoctl(card->file, DRM_IOCTL_MODE_MAP_DUMB, &map) != 0) {
        return -1;
    }
    void *pixels = mmap(NULL, s->bytes, PROT_READ | PROT_WRITE, MAP_SHARED, card->file, (off_t)map.offset);
    if (pixels == MAP_FAILED) {
        return -1;
    }
    s->pixels = pixels;
    memset(s->pixels, 0, s->bytes);
    return drmModeAddFB(card->file, create.width, create.height, 24, 32, create.pitch, s->handle, &s->id);
}

static void drop_surface(const struct kms_card *card, struct surface *s)
{
    if (s->id != 0) {
        drmModeRmFB(card->file, s->id);
    }
    if (s->pixels != NULL) {
        munmap(s->pixels, s->bytes);
    }
    if (s->handle != 0) {
        struct drm_mode_destroy_dumb destroy = {.handle = s->handle};
        drmIoctl(card->file, DRM_IOCTL_MODE_DESTROY_DUMB, &destroy);
    }
    *s = (struct surface){0};
}

/* ---- showing ------------------------------------------------------------------------------------ */

static int set_mode(struct kms_card *card, const struct surface *s)
{
    return drmModeSetCrtc(card->file, card->crtc, s->id, 0, 0, &card->connector, 1, &card->mode);
}

int kms_card_take(struct kms_card *card, char error[KMS_ERROR_SIZE])
{
    card->before = drmModeGetCrtc(card->file, card->crtc);
    if (make_surface(card, &card->surface[0]) != 0) {
        return kms_fail(error, errno, "%s: no frame buffer of %ux%u", card->name, card->mode.hdisplay,
                        card->mode.vdisplay);
    }
    if (set_mode(card, &card->surface[0]) != 0) {
        return kms_fail(error, errno, "%s: mode %ux%u", card->name, card->mode.hdisplay, card->mode.vdisplay);
    }
    card->set = true;
    card->dirty = drmModeDirtyFB(card->file, card->surface[0].id, NULL, 0) == 0;
    card->back = card->dirty ? 0 : 1;
    if (!card->dirty && make_surface(card, &card->surface[1]) != 0) {
        return kms_fail(error, errno, "%s: no second frame buffer", card->name);
    }
    return HAL_OK;
}

struct kms_buffer kms_card_buffer(const struct kms_card *card, bool *keeps)
{
    const struct surface *s = &card->surface[card->back];
    *keeps = card->dirty;
    return (struct kms_buffer){s->pixels, s->stride};
}

static void flipped(int file, unsigned frame, unsigned seconds, unsigned microseconds, void *done)
{
    (void)file, (void)frame, (void)seconds, (void)microseconds;
    *(bool *)done = true;
}

/* Waits until the flip is over. A signal does not end the wait. Returns false after FLIP_WAIT_MS. */
static bool wait_flip(const struct kms_card *card, const bool *done)
{
    drmEventContext events = {.version = 2, .page_flip_handler = flipped};
    struct pollfd poll_file = {.fd = card->file, .events = POLLIN};
    while (!*done) {
        const int ready = poll(&poll_file, 1, FLIP_WAIT_MS);
        if (ready == 0 || (ready < 0 && errno != EINTR) || (ready > 0 && drmHandleEvent(card->file, &events) != 0)) {
            return false;
        }
    }
    return true;
}

/* Shows the next buffer by a flip. A driver that cannot flip sets the mode once more: that shows the buffer, too. */
static int flip(struct kms_card *card, char *error)
{
    const struct surface *s = &card->surface[card->back];
    bool done = false;
    if (drmModePageFlip(card->file, card->crtc, s->id, DRM_MODE_PAGE_FLIP_EVENT, &done) == 0) {
        if (!wait_flip(card, &done)) {
            return kms_fail(error, ETIMEDOUT, "%s: the page flip does not end", card->name);
        }
    } else if (set_mode(card, s) != 0) {
        return kms_fail(error, errno, "%s: page flip", card->name);
    }
    card->back = 1 - card->back;
    return HAL_OK;
}

int kms_card_show(struct kms_card *card, const struct kms_clip *clips, uint32_t count, char error[KMS_ERROR_SIZE])
{
    _Static_assert(sizeof *clips == sizeof(drmModeClip), "the kernel's rectangles");
    drmModeClip copy[DRM_MODE_FB_DIRTY_MAX_CLIPS];
    if (!card->dirty) {
        return flip(card, error);
    }
    const uint32_t n = count <= DRM_MODE_FB_DIRTY_MAX_CLIPS ? count : 0;
    memcpy(copy, clips, n * sizeof *copy);
    return drmModeDirtyFB(card->file, card->surface[0].id, n > 0 ? copy : NULL, n) == 0
               ? HAL_OK
               : kms_fail(error, errno, "%s: DIRTYFB", card->name);
}

/* Closes the card. What was shown before is shown again; if that is gone (a console's buffer), the kernel restores its
 * console. */
void kms_card_close(struct kms_card *card)
{
    if (card == NULL) {
        return;
    }
    drmModeCrtc *b = card->before;
    if (card->set && b != NULL && b->mode_valid) {
        drmModeSetCrtc(card->file, card->crtc, b->buffer_id, b->x, b->y, &card->connector, 1, &b->mode);
    } else if (card->set) {
        drmModeSetCrtc(card->file, card->crtc, 0, 0, 0, NULL, 0, NULL);
    }
    drmModeFreeCrtc(b);
    drop_surface(card, &card->surface[0]);
    drop_surface(card, &card->surface[1]);
    close(card->file);
    free(card);
}
