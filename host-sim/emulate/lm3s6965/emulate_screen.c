/* QEMU's lm3s6965evb: the picture is its screen, four by four pixels for each of the panel's. See emulate.h. */
#define _XOPEN_SOURCE 700

#include "emulate.h"

#include "complain.h"
#include "emulate_qemu.h"
#include "emulate_registers.h"
#include "hal.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define SCALE             4
#define SCREEN_PIXELS_MAX (1u << 26)

static const struct {
    uint32_t button;
    const char *key; /* QEMU's name of it */
} wiring[] = {{HAL_BUTTON_UP, "up"},
              {HAL_BUTTON_DOWN, "down"},
              {HAL_BUTTON_LEFT, "left"},
              {HAL_BUTTON_RIGHT, "right"},
              {HAL_BUTTON_SELECT, "ctrl"}};
#define BUTTONS (sizeof wiring / sizeof wiring[0])

/* Brings the buttons from `was` to `is`. */
static int press(struct qemu *q, uint32_t was, uint32_t is)
{
    int status = 0;
    for (size_t i = 0; i < BUTTONS && status == 0; i++) {
        if (((was ^ is) & wiring[i].button) != 0) {
            status =
                emulate_qemu_command(q, "input-send-event",
                                     "\"events\": [{\"type\": \"key\", \"data\": {\"down\": %s, \"key\": {\"type\": "
                                     "\"qcode\", \"data\": \"%s\"}}}]",
                                     is & wiring[i].button ? "true" : "false", wiring[i].key);
        }
    }
    return status;
}

/* Copies one pixel of the panel. False: its block on the screen is not of one colour. */
static bool shrink_pixel(const struct ppm *screen, struct ppm *picture, uint32_t x, uint32_t y)
{
    const uint8_t *first = screen->rgb + 3 * ((size_t)SCALE * y * screen->width + (size_t)SCALE * x);
    memcpy(picture->rgb + 3 * ((size_t)y * picture->width + x), first, 3);
    for (uint32_t i = 0; i < SCALE * SCALE; i++) {
        if (memcmp(first + 3 * ((size_t)(i / SCALE) * screen->width + i % SCALE), first, 3) != 0) {
            return false;
        }
    }
    return true;
}

static int shrink(const struct ppm *screen, struct ppm *picture)
{
    if (screen->width != SCALE * picture->width || screen->height != SCALE * picture->height) {
        return complain("QEMU's screen is %ux%u, not four times the panel", (unsigned)screen->width,
                        (unsigned)screen->height);
    }
    for (uint32_t y = 0; y < picture->height; y++) {
        for (uint32_t x = 0; x < picture->width; x++) {
            if (!shrink_pixel(screen, picture, x, y)) {
                return complain("QEMU's screen is not made of blocks at pixel %u,%u", (unsigned)x, (unsigned)y);
            }
        }
    }
    return 0;
}

static int look(struct qemu *q, struct ppm *picture)
{
    char path[] = "/tmp/pinhole-screen-XXXXXX";
    struct ppm screen = {.rgb = NULL};
    const int fd = mkstemp(path);
    if (fd < 0) {
        return complain("%s: cannot be made", path);
    }
    close(fd);
    int status = emulate_qemu_command(q, "screendump", "\"filename\": \"%s\"", path);
    if (status == 0 && ppm_load(path, SCREEN_PIXELS_MAX, &screen) != 0) {
        status = complain("%s: QEMU's screen cannot be read", path);
    }
    unlink(path);
    if (status == 0) {
        status = shrink(&screen, picture);
    }
    free(screen.rgb);
    return status;
}

/* Waits for the line about frame number `frame`. */
static int await_frame(struct qemu *q, uint32_t frame)
{
    char text[32];
    int status;
    snprintf(text, sizeof text, "frame %u,", (unsigned)frame);
    do {
        status = emulate_qemu_line(q);
    } while (status == 0 && strncmp(q->line, text, strlen(text)) != 0);
    return status;
}

static int run(const struct emulation *e, struct qemu *q, struct ppm *picture)
{
    const uint32_t all = HAL_BUTTON_UP | HAL_BUTTON_DOWN | HAL_BUTTON_LEFT | HAL_BUTTON_RIGHT | HAL_BUTTON_SELECT;
    uint32_t held = 0;
    int status = 0;
    for (uint32_t frame = 0; frame < e->frames && status == 0; frame++) {
        const uint32_t now = frame > 0 ? key_script_at(e->keys, frame) : 0;
        status = press(q, held, now);
        held = now;
        if (status == 0) {
            status = emulate_qemu_send(q, "H");
        }
        if (status == 0 && frame == 0) { /* the answer says that the UART has it */
            status =
                emulate_qemu_command(q, "query-status", NULL) != 0 ? COMPLAINED : emulate_qemu_command(q, "cont", NULL);
        }
        if (status == 0) {
            status = await_frame(q, frame);
        }
        if (status == 0) {
            status = look(q, picture);
        }
        if (status == 0) {
            status = e->frame(e->context, frame, picture);
        }
        if (status == 0 && frame == 0) { /* QEMU's buttons are down until they were pressed once, and the port ignores
                                            them until it sees them up */
            status = press(q, 0, all) != 0 ? COMPLAINED : press(q, all, 0);
        }
    }
    return status;
}

static int take_line(void *context, const char *line)
{
    struct emulate_access access;
    return emulate_registers_line(context, line, &access);
}

int emulate_screen(const struct emulation *e)
{
    struct qemu q;
    struct emulate_registers registers;
    const uint16_t width = panel_width(e->board->panel, e->board->rotation);
    const uint16_t height = panel_height(e->board->panel, e->board->rotation);
    struct ppm picture = {width, height, malloc((size_t)width * height * 3)};
    if (emulate_registers_open(&registers, &lm3s6965_registers) != 0 || picture.rgb == NULL) {
        emulate_registers_close(&registers);
        free(picture.rgb);
        return complain("not enough memory for a picture");
    }
    int status = emulate_qemu_start(&q, "lm3s6965evb", e->image, 0, true);
    q.log = e->log;
    q.take = take_line;
    q.context = &registers;
    if (status == 0) {
        status = run(e, &q, &picture);
    }
    const int stopped = emulate_qemu_stop(&q) != 0 ? COMPLAINED : emulate_registers_said(&registers);
    emulate_registers_close(&registers);
    free(picture.rgb);
    return status != 0 ? status : stopped;
}
