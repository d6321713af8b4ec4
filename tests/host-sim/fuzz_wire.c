/*
 * Changed and random logs of a kit's wires into pinhole-wire's reader and the model of the controller behind it: no
 * crash and no error of the sanitizers, whatever the lines say.
 *
 *   fuzz_wire [quick | long | INPUTS [SEED]]
 */
#include "fuzz.h"
#include "sim.h"
#include "wire_events.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

enum { ROOM = 4096, LINES_MOST = 24 };

static const struct board *board;
static uint32_t frames;

static int take_frame(void *context, uint32_t frame, const uint8_t *rgb)
{
    (void)context;
    const struct panel *const panel = board->panel;
    volatile unsigned sum = rgb[0] + rgb[3u * panel->width * panel->height - 1];
    (void)sum;
    frames++;
    return frame > 40 ? 9 : 0;
}

static void take_step(void *context, uint64_t time_ns, const char *what)
{
    (void)context;
    (void)time_ns;
    (void)what;
}

static void take_complaint(void *context, const char *complaint)
{
    (void)context;
    if (complaint[0] == '\0' || strchr(complaint, '\n') != NULL) {
        fuzz_fail("a complaint is not one line");
    }
}

/* ---- a log ------------------------------------------------------------------------------------------------------ */

struct text {
    char at[ROOM];
    size_t n;
    uint64_t time_ns;
};

/* D/C is line 0, reset 1, backlight 2, chip select 3: levels that let the panel work, most of the time. */
static uint32_t levels(bool is_data)
{
    return fuzz_below(20) == 0 ? fuzz_number() : (is_data ? 7u : 6u);
}

static void put_transfer(struct text *t)
{
    static const uint8_t commands[] = {0x01, 0x10, 0x11, 0x13, 0x20, 0x21, 0x28, 0x29, 0x2a, 0x2b, 0x2c,
                                       0x35, 0x36, 0x3a, 0x3c, 0xae, 0xaf, 0x15, 0x75, 0x5c, 0xfd, 0xa0};
    const bool is_data = fuzz_below(2) != 0;
    const uint32_t at = levels(is_data), end = fuzz_below(20) == 0 ? levels(!is_data) : at;
    const uint32_t n = is_data ? fuzz_below(20) : 1, hz = fuzz_below(20) == 0 ? fuzz_number() : 10000000;
    t->n += (size_t)snprintf(t->at + t->n, ROOM - t->n, "%" PRIu64 " %s %s %u %u %x %u %x %x %" PRIu64 " ", t->time_ns,
                             fuzz_below(10) == 0 ? "read" : "spi", fuzz_below(2) != 0 ? "-" : "0", (unsigned)hz,
                             (unsigned)hz, fuzz_below(20) == 0 ? fuzz_below(256) : 0, fuzz_below(20) == 0 ? 9 : 8, at,
                             end, t->time_ns + fuzz_below(2000));
    for (uint32_t i = 0; i < n && t->n + 3 < ROOM; i++) {
        const unsigned byte =
            is_data || fuzz_below(4) == 0 ? fuzz_below(256) : (unsigned)commands[fuzz_below(sizeof commands)];
        t->n += (size_t)snprintf(t->at + t->n, ROOM - t->n, "%02x", byte);
    }
}

static void put_line(struct text *t)
{
    static const char *const names[] = {"dc", "reset", "backlight", "select", "GPIO25", "x"};
    if (t->n + 400 > ROOM) {
        return;
    }
    switch (fuzz_below(10)) {
    case 0:
        t->n += (size_t)snprintf(t->at + t->n, ROOM - t->n, "%" PRIu64 " name %u %s", t->time_ns, fuzz_below(66),
                                 names[fuzz_below(6)]);
        break;
    case 1:
        t->n += (size_t)snprintf(t->at + t->n, ROOM - t->n, "%" PRIu64 " level %x", t->time_ns, levels(true));
        break;
    case 2:
        t->n += (size_t)snprintf(t->at + t->n, ROOM - t->n, "%" PRIu64 " note frame", t->time_ns);
        break;
    case 3:
        t->n += (size_t)snprintf(t->at + t->n, ROOM - t->n, "%" PRIu64 " lost %u", t->time_ns, fuzz_number());
        break;
    default:
        put_transfer(t);
        break;
    }
    t->at[t->n++] = '\n';
    t->time_ns += fuzz_below(8) == 0 ? (uint64_t)fuzz_number() * fuzz_number() : 200000000u >> fuzz_below(28);
}

static void make_log(struct text *t)
{
    *t = (struct text){.n = 0};
    t->n = (size_t)snprintf(t->at, ROOM,
                            "0 name 0 dc\n0 name 1 reset\n0 name 2 backlight\n0 name 3 select\n"
                            "0 level 4\n20000 level 6\n");
    t->time_ns = 300000000;
    for (uint32_t i = fuzz_below(LINES_MOST); i > 0; i--) {
        put_line(t);
    }
    if (fuzz_below(2) != 0) {
        t->n = fuzz_change_text(t->at, t->n, ROOM - 1);
    }
}

/* ---- the reader ------------------------------------------------------------------------------------------------- */

static struct wire *open_wire(void)
{
    static const char *const small[] = {"lm3s6965evb", "sim-ssd1351", "waveshare-pico-lcd-0in96"};
    static struct sim_virtual tiny; /* A model first fills its memory, so most logs are for a glass that has little. */
    if (fuzz_below(5) != 0) {
        sim_virtual(&tiny, 24, 16);
        board = &tiny.board;
    } else {
        board = fuzz_below(16) != 0 ? board_find(small[fuzz_below(3)]) : board_list[fuzz_below(board_count)];
    }
    return wire_replay_open(&(struct wire_config){.board = board,
                                                  .select = board->spi_select,
                                                  .rotation = fuzz_below(4),
                                                  .idle_ns = fuzz_below(3) == 0 ? 1000 : 0,
                                                  .notes = fuzz_below(3) == 0,
                                                  .order = fuzz_below(2) != 0,
                                                  .last = fuzz_below(3) == 0,
                                                  .frame = take_frame,
                                                  .step = take_step,
                                                  .reject = take_complaint});
}

static bool one(void)
{
    static struct text t;
    struct wire *const w = open_wire();
    if (w == NULL) {
        fuzz_fail("no model of the board's controller");
    }
    make_log(&t);
    bool is_right = true;
    int status = 0;
    frames = 0;
    for (char *line = t.at, *const end = t.at + t.n; line < end && is_right && status == 0;) {
        char *const stop = memchr(line, '\n', (size_t)(end - line)), *const next = stop != NULL ? stop + 1 : end;
        char copy[ROOM];
        struct wire_event event;
        const char *error = NULL;
        memcpy(copy, line, (size_t)(next - line));
        copy[next - line] = '\0';
        const int parsed = wire_parse(copy, &event, &error);
        is_right = parsed >= 0;
        if (is_right != (error == NULL)) {
            fuzz_fail("refused without a reason");
        }
        status = parsed > 0 ? wire_replay_event(w, &event) : 0;
        line = next;
    }
    if (is_right && status == 0) {
        wire_replay_end(w);
    }
    wire_replay_close(w);
    return is_right;
}

int main(int argc, char **argv)
{
    return fuzz_main(&(struct fuzz){"fuzz_wire", 4000, 400000, one}, argc, argv);
}
