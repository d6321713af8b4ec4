/* wire_replay: what is seen, told and rejected of a stream of events, which are made here one by one: a glass of 4 x 2
 * pixels, whose D/C line has the name of its role, whose reset is GPIO7, and whose light is a name of the board. */
#include "panels.h"
#include "wire_replay.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

enum { DC = 3, RESET = 7, SELECT = 20, LIGHT = 40, RED = 0xF800, GREEN = 0x07E0, BLUE = 0x001F };

static struct panel panel;
static struct board board;
static struct wire_config config;
static struct wire *wire;
static uint64_t now_ns, levels;
static char told[1024]; /* frames, steps and complaints */
static int answer;      /* of the next frames */

static void tell(const char *format, ...) __attribute__((format(printf, 1, 2)));

static void tell(const char *format, ...)
{
    const size_t n = strlen(told);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(told + n, sizeof told - n, format, arguments);
    va_end(arguments);
}

/* Tells a picture by its first and its last pixel. */
static int on_frame(void *context, uint32_t frame, const uint8_t *rgb)
{
    assert_ptr_equal(context, told);
    tell("%u=%02X%02X%02X,%02X%02X%02X ", frame, rgb[0], rgb[1], rgb[2], rgb[21], rgb[22], rgb[23]);
    return answer;
}

static void on_step(void *context, uint64_t time_ns, const char *what)
{
    assert_ptr_equal(context, told);
    tell("%s at %u us; ", what, (unsigned)(time_ns / 1000));
}

static void on_reject(void *context, const char *complaint)
{
    assert_ptr_equal(context, told);
    tell("! %s\n", complaint);
}

static void expect(const char *text)
{
    assert_string_equal(told, text);
    told[0] = '\0';
}

static int fresh(void **state)
{
    (void)state;
    panel = (struct panel){.name = "virtual",
                           .controller = panel_st7789_240x240.controller,
                           .width = 4,
                           .height = 2,
                           .ram_width = 4,
                           .ram_height = 2};
    board = (struct board){.name = "kit",
                           .panel = &panel,
                           .spi_hz = 1000000,
                           .pins = {.dc = BOARD_PIN(50),
                                    .reset = BOARD_LINE("GPIO7"),
                                    .backlight = BOARD_LINE("the light"),
                                    .select = BOARD_PIN_LOW(SELECT)}};
    config = (struct wire_config){
        .board = &board, .select = 2, .context = told, .frame = on_frame, .step = on_step, .reject = on_reject};
    told[0] = '\0';
    answer = 0, now_ns = 0, levels = 0;
    return 0;
}

static int closed(void **state)
{
    (void)state;
    wire_replay_close(wire);
    wire = NULL;
    return 0;
}

static void name(unsigned line, char *text)
{
    assert_int_equal(wire_replay_event(wire, &(struct wire_event){.kind = WIRE_NAME, .number = line, .text = text}), 0);
}

static void open_wire(void)
{
    wire = wire_replay_open(&config);
    assert_non_null(wire);
    name(DC, (char[]){"dc"});
    name(LIGHT, (char[]){"the light"});
}

static void set(unsigned line, bool level)
{
    levels = (levels & ~(1ULL << line)) | (uint64_t)level << line;
    wire_replay_event(wire, &(struct wire_event){.kind = WIRE_LEVEL, .time_ns = now_ns, .levels = levels});
}

static void wait_us(uint32_t us)
{
    now_ns += (uint64_t)us * 1000;
}

/* A transfer at 1 MHz. */
static struct wire_event transfer(bool is_data, const void *bytes, size_t n)
{
    levels = (levels & ~(1ULL << DC)) | (uint64_t)is_data << DC;
    return (struct wire_event){.kind = WIRE_SPI,
                               .time_ns = now_ns,
                               .end_ns = now_ns + 8000 * n,
                               .levels = levels,
                               .levels_at_end = levels,
                               .select = 2,
                               .asked_hz = 1000000,
                               .got_hz = 1000000,
                               .word_bits = 8,
                               .bytes = bytes,
                               .count = n};
}

static int send_event(const struct wire_event *event)
{
    const int status = wire_replay_event(wire, event);
    now_ns = event->end_ns;
    return status;
}

static void send(bool is_data, const void *bytes, size_t n)
{
    const struct wire_event event = transfer(is_data, bytes, n);
    send_event(&event);
}

#define COMMAND(code) send(false, (const uint8_t[]){code}, 1)
#define DATA(...)     send(true, (const uint8_t[]){__VA_ARGS__}, sizeof((const uint8_t[]){__VA_ARGS__}))
#define PIXELS_IN_ALL 8

static void draw(uint16_t colour, unsigned pixels)
{
    COMMAND(0x2C);
    for (unsigned i = 0; i < pixels; i++) {
        DATA((uint8_t)(colour >> 8), (uint8_t)colour);
    }
}

/* Reset, sleep-out, 16 bits a pixel that are shown as they are, and the window. */
static void wake(void)
{
    set(RESET, true);
    wait_us(1000);
    set(RESET, false);
    wait_us(1000);
    set(RESET, true);
    wait_us(121000);
    COMMAND(0x11);
    wait_us(121000);
    COMMAND(0x3A);
    DATA(0x55);
    COMMAND(0xB0);
    DATA(0x00, 0xE0);
    COMMAND(0x21); /* the virtual glass shows complements */
    COMMAND(0x2A);
    DATA(0, 0, 0, 3);
    COMMAND(0x2B);
    DATA(0, 0, 0, 1);
}

static void light_up(void)
{
    wake();
    draw(0, PIXELS_IN_ALL);
    COMMAND(0x29);
    set(LIGHT, true);
    expect("0=000000,000000 ");
}

static void end(const char *text, uint32_t frames)
{
    assert_int_equal(wire_replay_end(wire), 0);
    expect(text);
    assert_int_equal(wire_replay_frames(wire), frames);
}

static void steps_are_told_in_their_order_with_their_times(void **state)
{
    (void)state;
    config.order = true;
    open_wire();
    wake();
    draw(RED, PIXELS_IN_ALL);
    COMMAND(0x29);
    wait_us(500);
    set(LIGHT, true);
    wait_us(100);
    set(LIGHT, false);
    COMMAND(0x28);
    set(RESET, false);
    /* 8 us a byte: 15 bytes of commands, 17 of pixels with theirs, and display on; a step has its transfer's beginning
     */
    expect(
        "reset begins at 1000 us; reset ends at 2000 us; init at 123000 us; first frame at 244256 us; display on at "
        "244272 us; backlight on at 244780 us; 0=FF0000,FF0000 backlight off at 244880 us; display off at 244880 us; "
        "reset begins at 244888 us; ");
    end("", 1);
    assert_int_equal(wire_replay_complaints(wire), 0);
    wake(); /* a second time */
    draw(BLUE, PIXELS_IN_ALL);
    assert_non_null(strstr(told, "init at "));
    assert_non_null(strstr(told, "first frame at "));
}

/* 120 ms are to pass behind sleep-out: here they do while its byte is on the wire. */
static void the_time_that_a_transfer_takes_counts(void **state)
{
    (void)state;
    for (int is_slow = 0; is_slow < 2; is_slow++) {
        fresh(NULL);
        open_wire();
        set(RESET, true);
        set(RESET, false);
        wait_us(1000);
        set(RESET, true);
        wait_us(121000);
        struct wire_event event = transfer(false, "\x11", 1);
        event.end_ns += is_slow == 1 ? 121000000 : 0;
        send_event(&event);
        COMMAND(0x10);
        assert_int_equal(wire_replay_complaints(wire) == 0, is_slow == 1);
        closed(NULL);
    }
}

/* A write that was begun anew and then a whole one: pixels before the command do not count. */
static void each_memory_write_begins_a_frame(void **state)
{
    (void)state;
    open_wire();
    light_up();
    for (int i = 0; i < 3; i++) {
        draw(RED, PIXELS_IN_ALL - 1);
    }
    expect("");
    draw(RED, PIXELS_IN_ALL);
    draw(RED, 1);
    expect("1=FF0000,FF0000 ");
}

static void a_frame_is_told_with_its_last_pixel(void **state)
{
    (void)state;
    open_wire();
    light_up();
    draw(RED, PIXELS_IN_ALL - 1);
    expect("");
    DATA(RED >> 8, RED & 255);
    expect("1=FF0000,FF0000 ");
    draw(GREEN, 3);
    draw(BLUE, PIXELS_IN_ALL);
    expect("2=0000FF,0000FF ");
    draw(GREEN, PIXELS_IN_ALL);
    draw(GREEN, PIXELS_IN_ALL);
    expect("3=00FF00,00FF00 4=00FF00,00FF00 ");
    end("", 5);
}

static void a_frame_that_stays_dark_is_told_before_the_next_one(void **state)
{
    (void)state;
    open_wire();
    wake();
    draw(RED, PIXELS_IN_ALL);
    draw(BLUE, 1);
    expect("0=000000,000000 "); /* the glass is off */
    draw(GREEN, PIXELS_IN_ALL);
    COMMAND(0x29);
    set(LIGHT, true);
    expect("1=00FF00,00FF00 ");
    end("", 2);
}

static void the_last_picture_is_that_before_the_dark(void **state)
{
    (void)state;
    config.last = true;
    open_wire();
    wake();
    draw(RED, PIXELS_IN_ALL);
    COMMAND(0x29);
    set(LIGHT, true);
    draw(BLUE, 1);
    set(LIGHT, false);
    draw(GREEN, PIXELS_IN_ALL);
    end("0=0000FF,FF0000 ", 1);
    closed(NULL);
    fresh(NULL);
    config.last = true;
    open_wire();
    end("", 0); /* nothing was ever seen */
}

static void a_rest_of_the_bus_ends_a_frame(void **state)
{
    (void)state;
    config.idle_ns = 1000000;
    open_wire();
    wake();
    draw(BLUE, PIXELS_IN_ALL);
    COMMAND(0x29);
    set(LIGHT, true);
    wait_us(1000);
    set(LIGHT, true);
    expect("0=0000FF,0000FF ");
    draw(RED, 1);
    wait_us(999);
    COMMAND(0x00);
    expect("");
    wait_us(1000);
    COMMAND(0x00);
    expect("1=FF0000,0000FF ");
    wait_us(2000);
    COMMAND(0x00);
    expect(""); /* nothing new */
    draw(GREEN, 1);
    end("2=00FF00,0000FF ", 3);
    draw(RED, 1);
    COMMAND(0x28);
    expect("3=FF0000,0000FF "); /* before it goes dark */
}

static void notes_end_frames_when_asked(void **state)
{
    (void)state;
    for (int asked = 0; asked < 2; asked++) {
        fresh(NULL);
        config.notes = asked == 1;
        open_wire();
        wake();
        draw(RED, PIXELS_IN_ALL);
        COMMAND(0x29);
        set(LIGHT, true);
        expect(asked == 1 ? "" : "0=FF0000,FF0000 ");
        wire_replay_event(wire, &(struct wire_event){.kind = WIRE_NOTE, .text = (char[]){"frames"}});
        expect("");
        wire_replay_event(wire, &(struct wire_event){.kind = WIRE_NOTE, .text = (char[]){"frame"}});
        expect(asked == 1 ? "0=FF0000,FF0000 " : "");
        end("", 1);
        closed(NULL);
    }
}

static void only_transfers_to_this_panel_count(void **state)
{
    (void)state;
    open_wire();
    light_up();
    COMMAND(0x2C);
    for (int i = 0; i < 24; i++) {
        struct wire_event event = transfer(true, "\xF8", 1);
        if (i % 3 == 0) { /* another's select, or the line of this one's is high */
            event.select = 1;
        } else if (i % 3 == 1) {
            event.select = WIRE_NO_SELECT;
            event.levels |= 1ULL << SELECT;
            event.levels_at_end = event.levels;
        } else {
            event.select = i > 6 ? WIRE_NO_SELECT : 2;
        }
        send_event(&event);
        struct wire_event read = event; /* of which no byte counts */
        read.kind = WIRE_READ;
        read.time_ns = read.end_ns = now_ns;
        send_event(&read);
    }
    expect("");
    for (int i = 0; i < 8; i++) {
        DATA(0xF8);
    }
    assert_int_equal(strncmp(told, "1=", 2), 0);
    assert_int_equal(wire_replay_complaints(wire), 0);
}

static void what_a_panel_does_not_take_is_rejected(void **state)
{
    static const struct {
        uint32_t mode, word_bits, select;
        uint64_t moves;
        const char *told;
    } cases[] = {
        {0, 8, 2, 0, ""},
        {3, 8, 2, 0, ""},
        {1, 8, 2, 0, "! 300.008 ms: SPI mode 1h: panels want 0 or 3, highest bit first\n"},
        {2, 8, 2, 0, "! 300.008 ms: SPI mode 2h: panels want 0 or 3, highest bit first\n"},
        {8, 8, 2, 0, "! 300.008 ms: SPI mode 8h: panels want 0 or 3, highest bit first\n"},
        {0x43, 8, WIRE_NO_SELECT, 0, ""},
        {0x40, 8, 2, 0, "! 300.008 ms: the panel is not selected (mode 40h)\n"},
        {0, 9, 2, 0, "! 300.008 ms: 9 bits a word instead of 8\n"},
        {0, 8, 2, 1ULL << DC, "! 300.008 ms: D/C moved during a transfer of 2 bytes\n"},
        {0, 8, 2, 1ULL << SELECT, "! 300.008 ms: chip select moved during a transfer of 2 bytes\n"},
        {0, 8, 2, 1ULL << LIGHT, ""},
        {0, 8, 2, 1ULL << 60, ""},
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        fresh(NULL);
        open_wire();
        light_up();
        now_ns = 300000000;
        COMMAND(0x2C);
        struct wire_event event = transfer(true, "\0\0", 2);
        event.mode = cases[i].mode, event.word_bits = cases[i].word_bits, event.select = cases[i].select;
        event.levels_at_end ^= cases[i].moves;
        send_event(&event);
        expect(cases[i].told);
        closed(NULL);
    }
}

static void time_and_lost_events_are_looked_at(void **state)
{
    (void)state;
    open_wire();
    now_ns = 1234567000;
    set(LIGHT, false);
    wire_replay_event(wire, &(struct wire_event){.kind = WIRE_LOST, .time_ns = now_ns, .number = 7});
    expect("! 1234.567 ms: 7 events were lost\n");
    now_ns -= 1;
    set(LIGHT, false);
    expect("! 1234.567 ms: time goes back\n");
    assert_int_equal(wire_replay_complaints(wire), 2);
}

static void the_order_of_power_on_is_looked_at(void **state)
{
    (void)state;
    open_wire();
    set(RESET, true);
    set(LIGHT, true);
    assert_int_equal(strncmp(told, "! 0.000 ms: backlight on while the display is off\n", 50), 0);
    closed(NULL);
    fresh(NULL);
    open_wire();
    set(RESET, true);
    COMMAND(0x00);
    assert_non_null(strstr(told, "the first byte comes without a reset before it"));
}

static void lines_are_found_by_role_then_name_then_number(void **state)
{
    static const struct {
        struct board_pin reset;
        const char *name; /* of line 7 */
        const char *told;
    } cases[] = {
        {BOARD_LINE("GPIO7"), "", ""},
        {BOARD_LINE("chip:7"), "", ""},
        {BOARD_LINE("7"), "", ""},
        {BOARD_PIN(7), "", ""},
        {BOARD_PIN(7), "reset", ""},
        {BOARD_PIN(9), "reset", ""},
        {BOARD_LINE("any name"), "any name", ""},
        {BOARD_LINE("GPIO7"), "another", "! 0.000 ms: the stream has no line for reset (GPIO7)\n"},
        {BOARD_LINE("any name"), "", "! 0.000 ms: the stream has no line for reset (any name)\n"},
        {BOARD_LINE("GPIO64"), "", "! 0.000 ms: the stream has no line for reset (GPIO64)\n"},
        {BOARD_PIN(64), "", "! 0.000 ms: the stream has no line for reset (see its names)\n"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char line_name[16];
        fresh(NULL);
        board.pins.reset = cases[i].reset;
        config.order = true;
        open_wire();
        snprintf(line_name, sizeof line_name, "%s", cases[i].name);
        name(RESET, line_name);
        set(RESET, true);
        set(RESET, false);
        expect(cases[i].told[0] != '\0' ? cases[i].told : "reset begins at 0 us; ");
        closed(NULL);
    }
}

static void a_frame_that_fails_ends_the_replay(void **state)
{
    (void)state;
    open_wire();
    light_up();
    answer = -5;
    draw(RED, PIXELS_IN_ALL);
    draw(BLUE, PIXELS_IN_ALL);
    expect("1=FF0000,FF0000 ");
    const struct wire_event event = transfer(true, "\0", 1);
    assert_int_equal(send_event(&event), -5);
    assert_int_equal(wire_replay_end(wire), -5);
}

static void the_first_32_complaints_are_told_and_all_are_counted(void **state)
{
    unsigned lines = 0;
    (void)state;
    open_wire();
    for (int i = 0; i < 40; i++) {
        wire_replay_event(wire, &(struct wire_event){.kind = WIRE_LOST, .number = 1});
        for (char *at = told; (at = strchr(at, '\n')) != NULL; at++) {
            lines++;
        }
        told[0] = '\0';
    }
    assert_int_equal(lines, 32);
    assert_int_equal(wire_replay_complaints(wire), 40);
}

/* Pages of an SSD1306 whose last column is lit; AFh shows the frame that is complete by then. */
static void a_frame_comes_over_i2c_page_by_page(void **state)
{
    (void)state;
    static const uint8_t pump[] = {0x00, 0x8D, 0x14, 0xA1, 0xC8}, on[] = {0x00, 0xAF}, off[] = {0x00, 0xAE};
    panel = panel_ssd1306_128x64;
    board = (struct board){.name = "kit", .panel = &panel, .spi_hz = 400000, .i2c_address = 0x3C};
    config.order = true;
    wire = wire_replay_open(&config);
    assert_non_null(wire);
    struct wire_event event = {.kind = WIRE_I2C, .number = 0x3C, .got_hz = 400000, .time_ns = 1000000};
    uint8_t page[130] = {0x40};
    page[128] = 0xFF;
#define TELL(message, n)                                                                                               \
    (event.bytes = (message), event.count = (n), event.end_ns = event.time_ns + 1000,                                  \
     assert_int_equal(wire_replay_event(wire, &event), 0), event.time_ns += 1000)
    TELL(pump, sizeof pump);
    for (unsigned i = 0; i < 8; i++) {
        const uint8_t address[] = {0x00, (uint8_t)(0xB0 | i), 0x00, 0x10};
        TELL(address, sizeof address);
        TELL(page, 129);
    }
    expect("init at 1000 us; first frame at 1016 us; ");
    TELL(on, sizeof on);
    expect("display on at 1017 us; 0=000000,000000 ");
    event.number = 0x3D;
    TELL(off, sizeof off); /* somebody else's */
    expect("");
    event.number = 0x3C;
    TELL(off, sizeof off);
    expect("display off at 1019 us; ");
    assert_int_equal(wire_replay_end(wire), 0);
    assert_int_equal(wire_replay_complaints(wire), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(steps_are_told_in_their_order_with_their_times, fresh, closed),
        cmocka_unit_test_setup_teardown(the_time_that_a_transfer_takes_counts, fresh, closed),
        cmocka_unit_test_setup_teardown(each_memory_write_begins_a_frame, fresh, closed),
        cmocka_unit_test_setup_teardown(a_frame_is_told_with_its_last_pixel, fresh, closed),
        cmocka_unit_test_setup_teardown(a_frame_that_stays_dark_is_told_before_the_next_one, fresh, closed),
        cmocka_unit_test_setup_teardown(the_last_picture_is_that_before_the_dark, fresh, closed),
        cmocka_unit_test_setup_teardown(a_rest_of_the_bus_ends_a_frame, fresh, closed),
        cmocka_unit_test_setup_teardown(notes_end_frames_when_asked, fresh, closed),
        cmocka_unit_test_setup_teardown(only_transfers_to_this_panel_count, fresh, closed),
        cmocka_unit_test_setup_teardown(what_a_panel_does_not_take_is_rejected, fresh, closed),
        cmocka_unit_test_setup_teardown(time_and_lost_events_are_looked_at, fresh, closed),
        cmocka_unit_test_setup_teardown(the_order_of_power_on_is_looked_at, fresh, closed),
        cmocka_unit_test_setup_teardown(lines_are_found_by_role_then_name_then_number, fresh, closed),
        cmocka_unit_test_setup_teardown(a_frame_that_fails_ends_the_replay, fresh, closed),
        cmocka_unit_test_setup_teardown(the_first_32_complaints_are_told_and_all_are_counted, fresh, closed),
        cmocka_unit_test_setup_teardown(a_frame_comes_over_i2c_page_by_page, fresh, closed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
