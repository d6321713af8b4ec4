/*
 * The replay of a kit's wires (wire_events.h). A backend writes down what the driver does as a stream, in pieces of any
 * length; the pictures that come out again are compared with what went in, and every way to break the stream must be
 * told.
 */
#define _XOPEN_SOURCE 700 /* open_memstream */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "panel_picture.h"
#include "wire_events.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Lines of the recorded kit, by number. */
enum { DC_LINE = 3, RESET_LINE = 7, LIGHT_LINE = 40 };

struct recorder {
    FILE *text;
    char *stream;
    size_t stream_bytes;
    uint64_t time_ns, levels;
    uint32_t hz;
    size_t piece;    /* longest transfer */
    bool takes_time; /* transfers last as long as their bits */
    /* Faults. */
    bool moves_dc, hurries, early_light;
    uint32_t mode, word_bits, select;
};

static uint16_t picture[PICTURE_PIXELS];
static uint8_t expected[3 * PICTURE_PIXELS];

/* ---- the backend -------------------------------------------------------------------------------- */

static void put_levels(const struct recorder *r)
{
    fprintf(r->text, "%llu level %llx\n", (unsigned long long)r->time_ns, (unsigned long long)r->levels);
}

static void set_line(struct recorder *r, unsigned line, bool level)
{
    r->levels = (r->levels & ~(1ULL << line)) | (uint64_t)level << line;
    put_levels(r);
}

static void put_piece(struct recorder *r, const uint8_t *bytes, size_t n)
{
    const uint64_t end = r->time_ns + (r->takes_time ? 8000000000ULL * n / r->hz : 0);
    const uint64_t after = r->moves_dc && n > 4 ? r->levels ^ 1ULL << DC_LINE : r->levels;
    fprintf(r->text, "%llu spi %u %u %u %x %u %llx %llx %llu ", (unsigned long long)r->time_ns, (unsigned)r->select,
            (unsigned)r->hz, (unsigned)r->hz, (unsigned)r->mode, (unsigned)r->word_bits, (unsigned long long)r->levels,
            (unsigned long long)after, (unsigned long long)end);
    for (size_t i = 0; i < n; i++) {
        fprintf(r->text, "%02x", bytes[i]);
    }
    fputc('\n', r->text);
    r->time_ns = end;
}

static int rec_open(void *context, const struct board *board)
{
    (void)context;
    (void)board;
    return 0;
}

static int32_t rec_clock(void *context, uint32_t hz)
{
    struct recorder *r = context;
    r->hz = hz;
    return (int32_t)hz;
}

static int rec_write(void *context, enum hal_dc dc, const uint8_t *bytes, size_t n)
{
    struct recorder *r = context;
    set_line(r, DC_LINE, dc == HAL_DATA);
    for (size_t i = 0; i < n; i += r->piece) {
        put_piece(r, bytes + i, n - i < r->piece ? n - i : r->piece);
    }
    return 0;
}

static int rec_wait(void *context)
{
    (void)context;
    return 0;
}

static int rec_pin(void *context, enum hal_pin pin, bool level)
{
    set_line(context, pin == HAL_PIN_RESET ? RESET_LINE : LIGHT_LINE, level);
    return 0;
}

static uint32_t rec_time(void *context)
{
    const struct recorder *r = context;
    return (uint32_t)(r->time_ns / 1000);
}

static void rec_delay(void *context, uint32_t us)
{
    struct recorder *r = context;
    r->time_ns += r->hurries ? 1000 : 1000ULL * us;
}

static uint32_t rec_buttons(void *context)
{
    (void)context;
    return 0;
}

static void rec_close(void *context)
{
    (void)context;
}

static const struct hal_ops recorder_ops = {.name = "recorder",
                                            .open = rec_open,
                                            .bus_clock = rec_clock,
                                            .bus_write = rec_write,
                                            .bus_wait = rec_wait,
                                            .pin_set = rec_pin,
                                            .time_us = rec_time,
                                            .delay_us = rec_delay,
                                            .buttons = rec_buttons,
                                            .close = rec_close};

static struct recorder normal(void)
{
    return (struct recorder){.piece = 4096, .word_bits = 8, .hz = 1000000};
}

/* A board's panel with two lines by name and one by number. */
static struct board wired(const struct board *board)
{
    struct board b = *board;
    b.pins.dc = (struct board_pin)BOARD_LINE("a line's name");
    b.pins.reset = (struct board_pin)BOARD_LINE("chip:7");
    b.pins.backlight = (struct board_pin)BOARD_PIN(LIGHT_LINE);
    b.pins.select = (struct board_pin)BOARD_PIN_LOW(20);
    b.spi_select = 0;
    return b;
}

/* The panel's life: power on, `frames` pictures (seeds 1, 2, ...), power off. */
static void record(struct recorder *r, const struct board *board, unsigned rotation, uint32_t frames, bool off)
{
    static uint8_t scratch[PANEL_SCRATCH_MIN];
    struct panel_driver d;
    const struct hal hal = {&recorder_ops, r};
    const struct panel_config config = {board->panel,  (uint8_t)rotation, board->format,
                                        board->spi_hz, scratch,           sizeof scratch};
    r->text = open_memstream(&r->stream, &r->stream_bytes);
    assert_non_null(r->text);
    fprintf(r->text, "# a comment\n\n0 name %d a line's name\n0 note power on\n", DC_LINE);
    set_line(r, RESET_LINE, true);
    set_line(r, LIGHT_LINE, r->early_light);
    r->time_ns += 1000000000;
    assert_int_equal(panel_open(&d, &hal, &config), 0);
    for (uint32_t i = 0; i < frames; i++) {
        r->time_ns += 10000000;
        picture_fill(picture, d.width, d.height, i + 1);
        assert_int_equal(picture_draw(&d, picture, 7), 0);
    }
    if (off) {
        r->time_ns += 120000000;
        assert_int_equal(panel_close(&d), 0);
    }
    fclose(r->text);
}

/* ---- the replay --------------------------------------------------------------------------------- */

struct heard {
    struct wire_config config;
    uint16_t width, height;
    uint32_t first_seed; /* of the pictures that should come */
    uint32_t frames;
    char complaint[200]; /* the first */
    char steps[400];
};

static int hear_frame(void *context, uint32_t frame, const uint8_t *rgb)
{
    struct heard *h = context;
    const struct panel *panel = h->config.board->panel;
    picture_fill(picture, h->width, h->height, h->first_seed + frame);
    picture_expect(picture, h->width, h->height, h->config.board->format, panel->round, expected);
    if (h->first_seed != 0) {
        picture_compare(rgb, expected, h->width, h->height, h->config.board->name);
    }
    assert_int_equal(frame, h->frames++);
    return 0;
}

static void hear_step(void *context, uint64_t time_ns, const char *what)
{
    struct heard *h = context;
    (void)time_ns;
    strncat(h->steps, what, sizeof h->steps - strlen(h->steps) - 1);
    strncat(h->steps, "; ", sizeof h->steps - strlen(h->steps) - 1);
}

static void hear_complaint(void *context, const char *complaint)
{
    struct heard *h = context;
    if (h->complaint[0] == '\0') {
        snprintf(h->complaint, sizeof h->complaint, "%s", complaint);
    }
}

static struct heard listener(const struct board *board, unsigned rotation)
{
    struct heard h = {.config = {.board = board, .rotation = rotation, .order = true},
                      .width = panel_width(board->panel, rotation),
                      .height = panel_height(board->panel, rotation),
                      .first_seed = 1};
    return h;
}

static void replay(struct heard *h, struct recorder *r)
{
    h->config.frame = hear_frame;
    h->config.step = hear_step;
    h->config.reject = hear_complaint;
    h->config.context = h;
    struct wire *w = wire_replay_open(&h->config);
    assert_non_null(w);
    char *rest = NULL;
    for (char *line = strtok_r(r->stream, "\n", &rest); line != NULL; line = strtok_r(NULL, "\n", &rest)) {
        struct wire_event event;
        const char *error = NULL;
        const int n = wire_parse(line, &event, &error);
        assert_true(n >= 0);
        assert_true(n == 0 || wire_replay_event(w, &event) == 0);
    }
    assert_int_equal(wire_replay_end(w), 0);
    assert_int_equal(wire_replay_frames(w), h->frames);
    wire_replay_close(w);
    free(r->stream);
}

static void no_complaint(const struct heard *h)
{
    if (h->complaint[0] != '\0') {
        fail_msg("%s: %s", h->config.board->name, h->complaint);
    }
}

static void complains(struct recorder r, const char *about)
{
    const struct board board = wired(board_find("rpi-waveshare-1in3"));
    struct heard h = listener(&board, PANEL_R0);
    h.first_seed = 0; /* whatever */
    record(&r, &board, PANEL_R0, 2, true);
    replay(&h, &r);
    if (strstr(h.complaint, about) == NULL) {
        fail_msg("no complaint about '%s' but '%s'", about, h.complaint);
    }
}

/* ---- tests -------------------------------------------------------------------------------------- */

static void every_board_shows_its_pictures_again_however_transfers_are_split(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < board_count; i++) {
        const struct board board = wired(board_list[i]);
        for (unsigned rotation = 0; rotation < 4; rotation++) {
            if (!panel_can_turn(board.panel, rotation)) {
                continue;
            }
            struct recorder r = normal();
            struct heard h = listener(&board, rotation);
            r.piece = (size_t[]){1, 7, 64, 4096}[(i + rotation) % 4];
            r.takes_time = rotation % 2 == 0;
            record(&r, &board, rotation, 2, rotation != 3);
            replay(&h, &r);
            no_complaint(&h);
            assert_int_equal(h.frames, 2);
        }
    }
}

static void steps_of_power_on_and_off_are_told_in_their_order(void **state)
{
    (void)state;
    const struct board board = wired(board_find("rpi-waveshare-1in3"));
    struct recorder r = normal();
    struct heard h = listener(&board, PANEL_R90);
    record(&r, &board, PANEL_R90, 3, true);
    replay(&h, &r);
    no_complaint(&h);
    assert_string_equal(h.steps, "reset begins; reset ends; init; first frame; display on; backlight on; "
                                 "backlight off; display off; ");
}

static void last_is_what_was_seen_before_the_panel_went_dark(void **state)
{
    (void)state;
    const struct board board = wired(board_find("rpi-waveshare-1in3"));
    for (int off = 0; off < 2; off++) {
        struct recorder r = normal();
        struct heard h = listener(&board, PANEL_R0);
        h.config.last = true;
        h.first_seed = 3;
        record(&r, &board, PANEL_R0, 3, off != 0);
        replay(&h, &r);
        no_complaint(&h);
        assert_int_equal(h.frames, 1);
    }
}

static void a_rest_of_the_wires_ends_a_frame_when_asked(void **state)
{
    (void)state;
    const struct board board = wired(board_find("rpi-waveshare-1in3"));
    for (int off = 0; off < 2; off++) {
        struct recorder r = normal();
        struct heard h = listener(&board, PANEL_R0);
        h.config.idle_ns = 5000000;
        record(&r, &board, PANEL_R0, 3, off != 0);
        replay(&h, &r);
        no_complaint(&h);
        assert_int_equal(h.frames, 3);
    }
}

static void transfers_to_another_chip_select_are_not_ours(void **state)
{
    (void)state;
    const struct board board = wired(board_find("rpi-waveshare-1in3"));
    struct recorder r = normal();
    struct heard h = listener(&board, PANEL_R0);
    r.select = 1;
    record(&r, &board, PANEL_R0, 2, true);
    replay(&h, &r);
    assert_int_equal(h.frames, 0);
}

static void each_way_to_break_the_stream_is_rejected(void **state)
{
    (void)state;
    struct recorder moves_dc = normal(), hurries = normal(), early_light = normal(), mode = normal(), bits = normal(),
                    unselected = normal();
    moves_dc.moves_dc = true;
    complains(moves_dc, "D/C moved during a transfer");
    hurries.hurries = true;
    complains(hurries, "reset");
    early_light.early_light = true;
    complains(early_light, "backlight on");
    mode.mode = WIRE_CPHA;
    complains(mode, "SPI mode 1h");
    bits.word_bits = 16;
    complains(bits, "16 bits a word");
    unselected.mode = WIRE_NO_CS;
    complains(unselected, "not selected");
}

/* A line, or what is said about it. */
static const char *parsed(const char *text, struct wire_event *event)
{
    static char line[200];
    const char *error = NULL;
    snprintf(line, sizeof line, "%s", text);
    const int n = wire_parse(line, event, &error);
    return n < 0 ? error : n == 0 ? "nothing" : "event";
}

static void lines_are_read_strictly(void **state)
{
    (void)state;
    struct wire_event e;
    assert_string_equal(parsed("12 spi 1 40000000 31250000 43 8 ff 0 900 2C00ff\r\n", &e), "event");
    assert_int_equal(e.time_ns, 12);
    assert_int_equal(e.select, 1);
    assert_int_equal(e.asked_hz, 40000000);
    assert_int_equal(e.got_hz, 31250000);
    assert_int_equal(e.mode, 0x43);
    assert_int_equal(e.word_bits, 8);
    assert_int_equal(e.levels, 0xff);
    assert_int_equal(e.end_ns, 900);
    assert_int_equal(e.count, 3);
    assert_memory_equal(e.bytes, "\x2c\x00\xff", 3);
    assert_string_equal(parsed("1 spi - 1 1 0 8 0 0 1 ", &e), "event");
    assert_int_equal(e.select, WIRE_NO_SELECT);
    assert_int_equal(e.count, 0);
    assert_string_equal(parsed("", &e), "nothing");
    assert_string_equal(parsed("# 1 level 0", &e), "nothing");
    assert_string_equal(parsed("7 name 63 two words", &e), "event");
    assert_string_equal(e.text, "two words");
    static const char *const wrong[] = {"x level 0",
                                        "1",
                                        "1 leve 0",
                                        "1 level",
                                        "1 level 10000000000000000",
                                        "1 name 64 x",
                                        "1 name 3",
                                        "1 name 3 ",
                                        "-1 level 0",
                                        "1  level 0",
                                        "1 lost",
                                        "1 spi 0 1 1 0 8 0 0 1 2",
                                        "1 spi 0 1 1 0 8 0 0 1 2g",
                                        "1 spi 0 1 1 0 8 0 0 0 22",
                                        "1 spi 0 1 0 0 8 0 0 1 22",
                                        "1 spi 0 1 1 0 8 0 0",
                                        "1 spi x 1 1 0 8 0 0 1 22",
                                        "18446744073709551616 level 0"};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        const char *said = parsed(wrong[i], &e);
        if (strcmp(said, "event") == 0 || strcmp(said, "nothing") == 0) {
            fail_msg("'%s' is taken as %s", wrong[i], said);
        }
    }
}

static void lost_events_and_time_going_back_are_rejected(void **state)
{
    (void)state;
    static const char *const lines[] = {"5 lost 3", "4 level 0"};
    const struct board board = wired(board_find("rpi-waveshare-1in3"));
    struct heard h = listener(&board, PANEL_R0);
    h.config.reject = hear_complaint;
    h.config.context = &h;
    h.config.order = false;
    struct wire *w = wire_replay_open(&h.config);
    struct wire_event e;
    assert_string_equal(parsed("0 name 3 a line's name", &e), "event");
    wire_replay_event(w, &e);
    for (int i = 0; i < 2; i++) {
        assert_string_equal(parsed(lines[i], &e), "event");
        h.complaint[0] = '\0';
        wire_replay_event(w, &e);
        assert_non_null(strstr(h.complaint, i == 0 ? "3 events were lost" : "time goes back"));
    }
    assert_int_equal(wire_replay_complaints(w), 2);
    wire_replay_close(w);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_board_shows_its_pictures_again_however_transfers_are_split),
        cmocka_unit_test(steps_of_power_on_and_off_are_told_in_their_order),
        cmocka_unit_test(last_is_what_was_seen_before_the_panel_went_dark),
        cmocka_unit_test(a_rest_of_the_wires_ends_a_frame_when_asked),
        cmocka_unit_test(transfers_to_another_chip_select_are_not_ours),
        cmocka_unit_test(each_way_to_break_the_stream_is_rejected),
        cmocka_unit_test(lines_are_read_strictly),
        cmocka_unit_test(lost_events_and_time_going_back_are_rejected),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
