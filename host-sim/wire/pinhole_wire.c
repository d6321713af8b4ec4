/*
 * pinhole-wire: feeds the events on wires (wire_events.h) to the model of a panel. It prints a line for each frame,
 * writes pictures, and complains about what a real panel would not accept.
 */
#define _XOPEN_SOURCE 700 /* ssize_t */

#include "complain.h"
#include "crc32.h"
#include "frame_out.h"
#include "option_table.h"
#include "option_text.h"
#include "text_line.h"
#include "wire_events.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#define LINE_LIMIT (16u << 20) /* a transfer of 8 MB */

struct request {
    const char *in;               /* NULL: stdin */
    const char *out;              /* NULL: no pictures */
    const struct board *named;    /* NULL: none */
    const struct panel *panel;    /* NULL: as the board has it, like all that follows */
    const char *dc, *reset, *lit; /* lines */
    bool help, select_set, rotate_set;
    uint8_t rotate;
    struct board board; /* with what the command line changes */
    struct wire_config wire;
    struct frame_out frames;
    uint16_t width, height;
};

/* ---- what the replay tells ---------------------------------------------------------------------- */

static int show_frame(void *context, uint32_t frame, const uint8_t *rgb)
{
    struct request *r = context;
    const size_t n = (size_t)r->width * r->height * 3;
    uint8_t *copy = malloc(n);
    if (copy == NULL) {
        return complain("not enough memory for a picture");
    }
    memcpy(copy, rgb, n);
    const struct ppm picture = {r->width, r->height, copy};
    const int status = frame_out_put(&r->frames, frame, &picture);
    free(copy);
    printf("frame %u crc32 %08X\n", (unsigned)frame, (unsigned)crc32_update(0, rgb, n));
    return status;
}

static void show_step(void *context, uint64_t time_ns, const char *what)
{
    (void)context;
    printf("order %s %llu.%03llu ms\n", what, (unsigned long long)(time_ns / 1000000),
           (unsigned long long)(time_ns / 1000 % 1000));
}

static void show_complaint(void *context, const char *complaint)
{
    (void)context;
    complain("%s", complaint);
}

/* ---- the command line --------------------------------------------------------------------------- */

static bool set_board(void *to, const char *name)
{
    struct request *r = to;
    r->named = board_find(name);
    return r->named != NULL;
}

static bool set_panel(void *to, const char *name)
{
    struct request *r = to;
    r->panel = panel_find(name);
    return r->panel != NULL;
}

static bool set_rotate(void *to, const char *text)
{
    struct request *r = to;
    r->rotate_set = true;
    return option_text_turns(text, &r->rotate);
}

static bool set_idle(void *to, const char *text)
{
    struct request *r = to;
    uint32_t us = 0;
    const bool right = option_text_u32(text, 1, 1000000000, &us);
    r->wire.idle_ns = 1000ULL * us;
    return right;
}

static bool set_select(void *to, const char *text)
{
    struct request *r = to;
    r->select_set = true;
    return option_text_u32(text, 0, 255, &r->wire.select);
}

#define LINE_ALLOWED "a line as the board names it, or - for not wired"

static const struct option_row rows[] = {
    {"board", "NAME", "the kit", "a name that pinhole-sim --list shows", .set = set_board, .names = nearest_board},
    {"rotate", "0|90|180|270", "the rotation of the picture; the board's own by default", "0, 90, 180 or 270 degrees",
     .set = set_rotate},
    {"out", "DIR|FILE.png|FILE.gif|FILE.ppm",
     "pictures as DIR/frame-NNNN.ppm; FILE-NNNN.png or .ppm (with --last FILE.png); all frames as a GIF",
     FRAME_OUT_TAKES, .at = offsetof(struct request, out)},
    {"scale", "N", "makes every pixel of --out N x N pixels", "a whole number, 1 .. 16",
     .at = offsetof(struct request, frames.scale), .least = 1, .most = FRAME_OUT_SCALE_MAX},
    {"last", NULL, "only the last picture that was seen: for streams that send only what changed", NULL,
     .at = offsetof(struct request, wire.last)},
    {"notes", NULL, "a frame ends at each note `frame`, also if not all of it was written", NULL,
     .at = offsetof(struct request, wire.notes)},
    {"idle", "US", "a frame ends when the wires rest for US microseconds, not when all of it was written",
     "a whole number, 1 .. 1000000000", .set = set_idle},
    {"order", NULL, "also a line `order STEP MS` for reset, init, first frame, display and backlight", NULL,
     .at = offsetof(struct request, wire.order)},
    {"select", "N", "the chip select of this panel; the board's own by default", "a whole number, 0 .. 255",
     .set = set_select},
    {"panel", "NAME", "another panel on this board", "a name that `pinhole-panel list` shows", .set = set_panel},
    {"dc", "LINE", "another D/C line than the board's", LINE_ALLOWED, .at = offsetof(struct request, dc)},
    {"reset", "LINE", "another reset line", LINE_ALLOWED, .at = offsetof(struct request, reset)},
    {"backlight", "LINE", "another backlight", LINE_ALLOWED, .at = offsetof(struct request, lit)},
    {"help", NULL, "prints this, as does -h", NULL, .at = offsetof(struct request, help)},
};

static const struct option_table table = {rows, sizeof rows / sizeof rows[0]};

static void print_help(void)
{
    puts("pinhole-wire --board NAME [options] [FILE]\n"
         "Reads the events on a display kit's wires (stdin without FILE; host-sim/wire/wire_events.h has their "
         "format),\n"
         "prints `frame N crc32 XXXXXXXX` for each complete picture that was seen, and exits 1 if a real panel\n"
         "would not accept something: each complaint is a line on stderr.\n");
    option_table_help(&table);
    puts("\nExit status: 0 done; 1 failed, or a panel would not accept something; 2 wrong usage.");
}

static void change_line(struct board_pin *pin, const char *line)
{
    if (line != NULL) {
        const bool wired = strcmp(line, "-") != 0;
        *pin = (struct board_pin){.wired = wired, .line = wired ? line : NULL};
    }
}

/* Applies the other options to the board. */
static void change_board(struct request *r)
{
    r->board = *r->named;
    r->board.panel = r->panel != NULL ? r->panel : r->board.panel;
    r->wire.rotation = r->rotate_set ? r->rotate : r->board.rotation;
    r->wire.select = r->select_set ? r->wire.select : r->board.spi_select;
    change_line(&r->board.pins.dc, r->dc);
    change_line(&r->board.pins.reset, r->reset);
    change_line(&r->board.pins.backlight, r->lit);
}

static int read_arguments(struct request *r, int argc, char *argv[])
{
    const int count = option_table_words(&table, r, argc, argv, &r->in, 1);
    if (count < 0) {
        return count;
    }
    if (r->help) {
        return 0;
    }
    if (r->named == NULL) {
        return complain_usage("--board NAME is needed; see --help");
    }
    change_board(r);
    return 0;
}

/* ---- the run ------------------------------------------------------------------------------------ */

static int replay_line(struct wire *w, char *line, size_t length, const char *name, unsigned number)
{
    struct wire_event event;
    const char *error = "a byte of zero";
    const int parsed = strlen(line) == length ? wire_parse(line, &event, &error) : HAL_EINVAL;
    if (parsed < 0) {
        return complain("%s, line %u: %s", name, number, error);
    }
    return parsed > 0 ? wire_replay_event(w, &event) : 0;
}

static int replay(struct wire *w, FILE *in, const char *name)
{
    char *line = NULL;
    size_t size = 0;
    int status = 0;
    for (unsigned number = 1; status == 0; number++) {
        const ssize_t length = text_line_read(&line, &size, LINE_LIMIT, in);
        if (length <= 0) {
            status = length == 0 ? 0 : complain("%s: cannot be read: %s", name, strerror((int)-length));
            break;
        }
        status = replay_line(w, line, (size_t)length, name, number);
    }
    free(line);
    return status != 0 ? status : wire_replay_end(w);
}

static int run_file(struct request *r, FILE *in, const char *name)
{
    struct wire *w = wire_replay_open(&r->wire);
    if (w == NULL) {
        return complain("%s: no memory, or no model of its display controller", r->board.name);
    }
    int status = replay(w, in, name);
    const uint32_t complaints = wire_replay_complaints(w);
    if (status == 0 && complaints != 0) {
        status =
            complain("%s: a panel would not accept %u thing%s", name, (unsigned)complaints, complaints == 1 ? "" : "s");
    } else if (status == 0 && wire_replay_frames(w) == 0) {
        status = complain("%s: no complete picture was seen", name);
    }
    wire_replay_close(w);
    return status;
}

static int run(struct request *r)
{
    const struct panel *panel = r->board.panel;
    r->wire.board = &r->board;
    r->width = panel_width(panel, r->wire.rotation);
    r->height = panel_height(panel, r->wire.rotation);
    int status = frame_out_open(&r->frames, r->out, !r->wire.last, 0);
    if (status != 0) {
        return status;
    }
    const char *name = r->in != NULL ? r->in : "stdin";
    FILE *in = r->in != NULL ? fopen(r->in, "r") : stdin;
    if (in == NULL) {
        return complain("%s: cannot be opened: %s", name, strerror(errno));
    }
    status = run_file(r, in, name);
    if (r->in != NULL) {
        fclose(in);
    }
    return frame_out_close(&r->frames, status);
}

int main(int argc, char *argv[])
{
    struct request request = {
        .in = NULL, .wire = {.frame = show_frame, .step = show_step, .reject = show_complaint, .context = &request}};
    complain_begin("pinhole-wire", argc, argv);
    int status = read_arguments(&request, argc, argv);
    if (status == 0 && request.help) {
        print_help();
    } else if (status == 0) {
        status = run(&request);
    }
    return complain_exit(status);
}
