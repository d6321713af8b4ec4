/*
 * pinhole-wire: shows what a panel makes of the events on its wires (wire_events.h has their format): a line a frame,
 * pictures, and whatever a real panel would have resented.
 */
#define _XOPEN_SOURCE 700 /* getline */

#include "complain.h"
#include "crc32.h"
#include "frame_out.h"
#include "option_text.h"
#include "wire_events.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

struct request {
    const char *in; /* NULL: stdin */
    const char *out;
    struct board board;
    bool help, select_set, rotate_set;
    struct wire_config wire;
    struct frame_out frames;
    uint16_t width, height;
};

static void print_help(void)
{
    puts(
        "pinhole-wire --board NAME [options] [FILE]\n"
        "Reads the events on a display kit's wires (stdin without FILE; host-sim/wire_events.h has their format), "
        "prints\n"
        "`frame N crc32 XXXXXXXX` for each complete picture that was seen, and exits 1 if a panel would have resented\n"
        "anything: each complaint is a line on stderr.\n"
        "  --board NAME     the kit (pinhole-sim --list)\n"
        "  --rotate DEG     0, 90, 180 or 270: as the picture was drawn; the board's own by default\n"
        "  --out DIR        pictures as DIR/frame-NNNN.ppm (or one FILE.ppm)\n"
        "  --last           only the last picture that was seen: for streams that send only what changed\n"
        "  --idle US        a frame ends when the wires rest for US microseconds, not when all of it was written\n"
        "  --order          also a line `order STEP MS` for reset, init, first frame, display and backlight\n"
        "  --select N       the chip select of this panel; the board's own by default\n"
        "  --panel NAME     another panel on this board\n"
        "  --dc LINE --reset LINE --backlight LINE   other lines than the board's; '-' for not wired");
}

/* ---- what the replay tells ---------------------------------------------------------------------- */

static int show_frame(void *context, uint32_t frame, const uint8_t *rgb)
{
    const struct request *r = context;
    const size_t n = (size_t)r->width * r->height * 3;
    uint8_t *copy = malloc(n);
    if (copy == NULL) {
        return complain(EXIT_FAILED, "not enough memory for a picture");
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
    complain(EXIT_FAILED, "%s", complaint);
}

/* ---- the command line --------------------------------------------------------------------------- */

static bool set_line(struct request *r, const char *option, const char *line)
{
    struct board_pins *pins = &r->board.pins;
    struct board_pin *pin = strcmp(option, "--dc") == 0      ? &pins->dc
                            : strcmp(option, "--reset") == 0 ? &pins->reset
                                                             : &pins->backlight;
    const bool wired = strcmp(line, "-") != 0;
    *pin = (struct board_pin){.wired = wired, .line = wired ? line : NULL};
    return true;
}

static bool set_rotation(struct request *r, const char *text)
{
    static const char *const degrees[] = {"0", "90", "180", "270"};
    const int i = option_text_choice(text, degrees, 4);
    r->rotate_set = i >= 0;
    r->wire.rotation = (unsigned)i;
    return i >= 0;
}

static bool set_panel(struct request *r, const char *name)
{
    r->board.panel = panel_find(name);
    return r->board.panel != NULL;
}

/* An option that has a value, other than --board. */
static bool read_option(struct request *r, const char *option, const char *value)
{
    uint32_t us = 0;
    if (strcmp(option, "--rotate") == 0) {
        return set_rotation(r, value);
    }
    if (strcmp(option, "--out") == 0) {
        r->out = value;
        return *value != '\0';
    }
    if (strcmp(option, "--idle") == 0) {
        const bool read = option_text_u32(value, 1, 1000000000, &us);
        r->wire.idle_ns = 1000ULL * us;
        return read;
    }
    if (strcmp(option, "--select") == 0) {
        r->select_set = true;
        return option_text_u32(value, 0, 255, &r->wire.select);
    }
    if (strcmp(option, "--panel") == 0) {
        return set_panel(r, value);
    }
    const bool line =
        strcmp(option, "--dc") == 0 || strcmp(option, "--reset") == 0 || strcmp(option, "--backlight") == 0;
    return line && *value != '\0' && set_line(r, option, value);
}

/* The board comes first: other options change it. */
static int read_board(struct request *r, int argc, char *argv[])
{
    for (int i = 1; i + 1 < argc; i++) {
        if (strcmp(argv[i], "--board") == 0) {
            const struct board *board = board_find(argv[i + 1]);
            if (board == NULL) {
                return complain(EXIT_USAGE, "--board '%s': no such board; pinhole-sim --list shows them", argv[i + 1]);
            }
            r->board = *board;
        }
    }
    return r->board.panel != NULL ? 0 : complain(EXIT_USAGE, "--board NAME is needed; see --help");
}

static int read_arguments(struct request *r, int argc, char *argv[])
{
    if (argc == 2 && strcmp(argv[1], "--help") == 0) {
        r->help = true;
        return 0;
    }
    const int status = read_board(r, argc, argv);
    if (status != 0) {
        return status;
    }
    for (int i = 1; i < argc; i++) {
        const char *value = i + 1 < argc ? argv[i + 1] : "";
        if (strcmp(argv[i], "--last") == 0) {
            r->wire.last = true;
        } else if (strcmp(argv[i], "--order") == 0) {
            r->wire.order = true;
        } else if (strcmp(argv[i], "--board") == 0 || read_option(r, argv[i], value)) {
            i++;
        } else if (argv[i][0] == '-' || r->in != NULL) {
            return complain(EXIT_USAGE, "%s %s: wrong option or value; see --help", argv[i], value);
        } else {
            r->in = argv[i];
        }
    }
    return 0;
}

/* ---- the run ------------------------------------------------------------------------------------ */

static int replay(struct wire *w, FILE *in, const char *name)
{
    char *line = NULL;
    size_t size = 0;
    int status = 0;
    for (unsigned number = 1; status == 0 && getline(&line, &size, in) > 0; number++) {
        struct wire_event event;
        const char *error = NULL;
        const int parsed = wire_parse(line, &event, &error);
        if (parsed < 0) {
            status = complain(EXIT_FAILED, "%s, line %u: %s", name, number, error);
        } else if (parsed > 0) {
            status = wire_event(w, &event);
        }
    }
    free(line);
    if (status == 0 && ferror(in)) {
        status = complain(EXIT_FAILED, "%s: cannot be read: %s", name, strerror(errno));
    }
    return status != 0 ? status : wire_end(w);
}

static int run_file(struct request *r, FILE *in, const char *name)
{
    struct wire *w = wire_open(&r->wire);
    if (w == NULL) {
        return complain(EXIT_FAILED, "%s: no memory, or no model of its display controller", r->board.name);
    }
    int status = replay(w, in, name);
    const uint32_t complaints = wire_complaints(w);
    if (status == 0 && complaints != 0) {
        status = complain(EXIT_FAILED, "%s: the panel resents %u thing%s", name, (unsigned)complaints,
                          complaints == 1 ? "" : "s");
    } else if (status == 0 && wire_frames(w) == 0) {
        status = complain(EXIT_FAILED, "%s: no complete picture was seen", name);
    }
    wire_close(w);
    return status;
}

static int run(struct request *r)
{
    const struct panel *panel = r->board.panel;
    r->wire.board = &r->board;
    r->wire.rotation = r->rotate_set ? r->wire.rotation : r->board.rotation;
    r->wire.select = r->select_set ? r->wire.select : r->board.spi_select;
    r->width = panel_width(panel, r->wire.rotation);
    r->height = panel_height(panel, r->wire.rotation);
    int status = frame_out_open(&r->frames, r->out, !r->wire.last);
    if (status != 0) {
        return status;
    }
    const char *name = r->in != NULL ? r->in : "stdin";
    FILE *in = r->in != NULL ? fopen(r->in, "r") : stdin;
    if (in == NULL) {
        return complain(EXIT_FAILED, "%s: cannot be opened: %s", name, strerror(errno));
    }
    status = run_file(r, in, name);
    if (r->in != NULL) {
        fclose(in);
    }
    return status;
}

int main(int argc, char *argv[])
{
    struct request request = {
        .in = NULL, .wire = {.frame = show_frame, .step = show_step, .resent = show_complaint, .context = &request}};
    complain_as("pinhole-wire");
    int status = read_arguments(&request, argc, argv);
    if (status != 0) {
        return status;
    }
    if (request.help) {
        print_help();
    } else {
        status = run(&request);
    }
    return complain_stdout() == 0 ? status : EXIT_FAILED;
}
