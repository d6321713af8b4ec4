/* panel_line: messages to a memory LCD as its data sheet draws them, bit by bit; when SCS moves; windows and errors. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "panel_line.h"
#include "panels.h"

#include <stdio.h>
#include <string.h>

/* ---- a bus that keeps what is sent --------------------------------------------------------------- */

#define SENT_MAX 16384

static struct {
    uint8_t bytes[SENT_MAX];
    bool listens[SENT_MAX]; /* D/C, which is SCS */
    uint32_t clock_hz[SENT_MAX];
    uint32_t delay_us[SENT_MAX]; /* before the byte */
    uint32_t count, hz, waited_us;
    int fails_after;
    const uint8_t *held; /* may still be on the wire */
} bus;

static int bus_write(void *context, enum hal_dc dc, const uint8_t *from, size_t n)
{
    (void)context;
    if (bus.fails_after-- == 0) {
        return HAL_EIO;
    }
    assert_true(n <= HAL_COPIED || from != bus.held);
    bus.held = from;
    for (size_t i = 0; i < n; i++) {
        assert_true(bus.count < SENT_MAX);
        bus.bytes[bus.count] = from[i];
        bus.listens[bus.count] = dc == HAL_DATA;
        bus.clock_hz[bus.count] = bus.hz;
        bus.delay_us[bus.count++] = bus.waited_us;
        bus.waited_us = 0;
    }
    return HAL_OK;
}

static int bus_wait(void *context)
{
    (void)context;
    bus.held = NULL;
    return HAL_OK;
}

static int32_t bus_clock(void *context, uint32_t hz)
{
    (void)context;
    assert_null(bus.held); /* not while bytes are on their way */
    bus.hz = hz;
    return (int32_t)hz;
}

static void delay_us(void *context, uint32_t us)
{
    (void)context;
    assert_null(bus.held);
    bus.waited_us += us;
}

static int pin_set(void *context, enum hal_pin pin, bool level)
{
    (void)context;
    (void)pin;
    (void)level;
    return HAL_OK;
}

static const struct hal_ops ops = {
    .bus_write = bus_write, .bus_wait = bus_wait, .bus_clock = bus_clock, .delay_us = delay_us, .pin_set = pin_set};
static struct panel_driver d;
static uint8_t scratch[256];
static uint16_t picture[400 * 240];

static int open_panel(const struct panel *panel, unsigned rotation, size_t scratch_bytes)
{
    const struct hal hal = {&ops, NULL};
    const struct panel_config config = {panel,   (uint8_t)rotation, PANEL_MONO_THRESHOLD,
                                        1000000, scratch,           scratch_bytes};
    memset(&bus, 0, sizeof bus);
    bus.fails_after = -1;
    memset(scratch, 0xA5, sizeof scratch);
    memset(picture, 0, sizeof picture);
    return panel_open(&d, &hal, &config);
}

static void forget(void)
{
    bus.count = 0;
}

/* The bits from byte `at` on, in the order of the wire, as text. */
static const char *bits(uint32_t at, uint32_t n)
{
    static char text[65];
    for (uint32_t i = 0; i < 8 * n; i++) {
        text[i] = bus.bytes[at + i / 8] >> (7 - i % 8) & 1 ? '1' : '0';
    }
    text[8 * n] = '\0';
    return text;
}

static int frame(void)
{
    int status = panel_frame_begin(&d);
    status = status < 0 ? status : panel_rows(&d, picture, d.height);
    return status < 0 ? status : panel_frame_end(&d);
}

/* ---- tests --------------------------------------------------------------------------------------- */

/* M0 M1 M2 first; SCS falls with the first byte, which is not for the panel. */
static void it_begins_with_a_clear_glass(void **state)
{
    (void)state;
    assert_int_equal(open_panel(&panel_ls013b7dh03_128x128, PANEL_R0, 256), 0);
    assert_int_equal(bus.count, 4);
    assert_string_equal(bits(0, 4), "00000000"
                                    "01100000"
                                    "00000000"
                                    "00000000");
    assert_true(!bus.listens[0] && bus.listens[1] && bus.listens[2] && !bus.listens[3]);
    forget();
    assert_int_equal(panel_close(&d), 0); /* and ends with one */
    assert_int_equal(bus.count, 3 + 4);
    assert_string_equal(bits(4, 1), "01100000");
}

/* Address AG0 .. AG7, D1 .. D128, 8 clocks; behind the last line 16. */
static void a_frame_is_one_message(void **state)
{
    (void)state;
    assert_int_equal(open_panel(&panel_ls013b7dh03_128x128, PANEL_R0, 256), 0);
    picture[0] = picture[1] = picture[15] = 0xFFFF;
    picture[127 * 128 + 127] = 0xFFFF;
    forget();
    assert_int_equal(frame(), 0);
    assert_int_equal(bus.count, 1 + 128 * 18 + 2);
    assert_string_equal(bits(0, 4), "10000000"
                                    "10000000"
                                    "11000000"
                                    "00000001"); /* M1 is 1 in the message before */
    for (uint32_t line = 1; line <= 128; line++) {
        const uint32_t at = 1 + 18 * (line - 1);
        for (uint32_t bit = 0; bit < 8; bit++) {
            assert_int_equal(bits(at, 1)[bit] - '0', line >> bit & 1);
        }
        assert_string_equal(bits(at + 17, 1), "00000000");
    }
    assert_string_equal(bits(1 + 127 * 18, 1), "00000001"); /* 128 */
    assert_string_equal(bits(127 * 18 + 16, 4), "00000000"
                                                "00000001"
                                                "00000000"
                                                "00000000");
    for (uint32_t i = 0; i < bus.count; i++) {
        assert_int_equal(bus.listens[i], i + 1 < bus.count);
    }
    assert_int_equal(d.frame_bytes, bus.count);
}

/* tsSCS is 6 us: half a period of the first byte's clock. thSCS is 2 us: the time before the byte behind the message.
 */
static void scs_has_its_time(void **state)
{
    (void)state;
    assert_int_equal(open_panel(&panel_ls013b7dh03_128x128, PANEL_R0, 256), 0);
    assert_int_equal(frame(), 0);
    assert_int_equal(panel_hold(&d), 0);
    uint32_t messages = 0;
    for (uint32_t i = 1; i < bus.count; i++) {
        if (bus.listens[i] && !bus.listens[i - 1]) {
            assert_true(2ull * 6 * bus.clock_hz[i] <= 1000000);
            messages++;
        } else if (!bus.listens[i]) {
            assert_true(bus.delay_us[i] >= 2);
        } else if (messages > 1) { /* after panel_open */
            assert_int_equal(bus.clock_hz[i], 1000000);
        }
    }
    assert_int_equal(messages, 3);
    assert_true(!bus.listens[0] && !bus.listens[bus.count - 1]);
    assert_int_equal(bus.hz, 1000000);
}

static void each_message_toggles_vcom(void **state)
{
    (void)state;
    assert_int_equal(open_panel(&panel_ls013b7dh03_128x128, PANEL_R0, 256), 0);
    uint32_t m1 = bus.bytes[1] & 0x40;
    for (uint32_t i = 0; i < 6; i++) {
        forget();
        assert_int_equal(i % 2 == 0 ? panel_hold(&d) : frame(), 0);
        assert_int_equal(bus.bytes[0] & 0x40, m1 ^ 0x40);
        m1 ^= 0x40;
        if (i % 2 == 0) {
            assert_int_equal(bus.count, 3);
            assert_int_equal(bus.bytes[0] & ~0x40, 0);
            assert_int_equal(bus.bytes[1] | bus.bytes[2], 0);
        }
    }
}

/* A frame that begins while the last one's message has no end yet ends it. */
static void frames_that_follow_are_messages_of_their_own(void **state)
{
    (void)state;
    assert_int_equal(open_panel(&panel_ls013b7dh03_128x128, PANEL_R0, 256), 0);
    forget();
    for (uint32_t i = 0; i < 2; i++) {
        assert_int_equal(panel_frame_begin(&d), 0);
        assert_int_equal(panel_rows(&d, picture, 128), 0);
    }
    assert_int_equal(panel_wait(&d), 0);
    assert_int_equal(bus.count, 2 * (1 + 128 * 18 + 2));
    assert_true((bus.bytes[0] ^ bus.bytes[1 + 128 * 18 + 2]) == 0x40);
    assert_true(!bus.listens[1 + 128 * 18 + 1] && bus.listens[1 + 128 * 18]);
}

static void upside_down_lines_and_pixels_are_turned(void **state)
{
    (void)state;
    assert_int_equal(open_panel(&panel_ls027b7dh01_400x240, PANEL_R180, 256), 0);
    picture[0] = picture[399] = 0xFFFF;
    picture[1] = 0xFFFF;
    forget();
    assert_int_equal(frame(), 0);
    assert_int_equal(bus.count, 1 + 240 * 52 + 2);
    assert_string_equal(bits(1, 2), "00001111"
                                    "10000000"); /* line 240 */
    assert_string_equal(bits(1 + 50, 2), "00000011"
                                         "00000000");
}

/* Only whole lines are sent, each with its address. */
static void windows_are_whole_lines(void **state)
{
    (void)state;
    assert_int_equal(open_panel(&panel_ls013b7dh03_128x128, PANEL_R0, 256), 0);
    forget();
    panel_windows_begin(&d);
    assert_int_equal(panel_window(&d, 0, 5, 127, 1), HAL_EINVAL);
    assert_int_equal(panel_window(&d, 8, 5, 120, 1), HAL_EINVAL);
    assert_int_equal(panel_window(&d, 0, 5, 128, 2), 0);
    assert_int_equal(panel_window_rows(&d, picture, 128, 2), 0);
    assert_int_equal(panel_window(&d, 0, 99, 128, 1), 0);
    assert_int_equal(panel_window_rows(&d, picture, 128, 1), 0);
    assert_int_equal(panel_wait(&d), 0);
    assert_int_equal(bus.count, 1 + 3 * 18 + 2);
    assert_string_equal(bits(1, 1), "01100000");
    assert_string_equal(bits(1 + 18, 1), "11100000");
    assert_string_equal(bits(1 + 36, 1), "00100110");
    assert_int_equal(d.frame_bytes, bus.count);
}

static void what_it_cannot_do_is_refused(void **state)
{
    (void)state;
    assert_int_equal(open_panel(&panel_ls013b7dh03_128x128, PANEL_R90, 256), HAL_EINVAL);
    assert_int_equal(open_panel(&panel_ls013b7dh03_128x128, PANEL_R270, 256), HAL_EINVAL);
    assert_int_equal(open_panel(&panel_ls013b7dh03_128x128, PANEL_R0, 255), HAL_EINVAL);
    struct panel panel = panel_ls027b7dh01_400x240;
    panel.width = 1016; /* two lines of 129 bytes */
    assert_int_equal(open_panel(&panel, PANEL_R0, 256), HAL_EINVAL);
    panel.width = 996;
    assert_int_equal(open_panel(&panel, PANEL_R0, 256), HAL_EINVAL); /* 996 / 8 is no whole number */
    panel.width = 992;
    assert_int_equal(open_panel(&panel, PANEL_R0, 256), 0);
    panel.height = 256; /* an address has 8 bits */
    assert_int_equal(open_panel(&panel, PANEL_R0, 256), HAL_EINVAL);
}

/* Whichever write fails, the error is told, and the next frame is whole. */
static void errors_of_the_bus_come_back(void **state)
{
    (void)state;
    assert_int_equal(open_panel(&panel_ls013b7dh03_128x128, PANEL_R0, 256), 0);
    for (int i = 0; i < 22; i++) { /* mode, 19 halves of 7 lines, trailer, the byte behind */
        bus.fails_after = i;
        assert_int_equal(frame(), HAL_EIO);
        bus.fails_after = -1;
        panel_wait(&d);
        forget();
        assert_int_equal(frame(), 0);
        assert_int_equal(bus.count, 1 + 128 * 18 + 2);
        assert_int_equal(bus.hz, 1000000);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_begins_with_a_clear_glass),
        cmocka_unit_test(a_frame_is_one_message),
        cmocka_unit_test(scs_has_its_time),
        cmocka_unit_test(each_message_toggles_vcom),
        cmocka_unit_test(frames_that_follow_are_messages_of_their_own),
        cmocka_unit_test(upside_down_lines_and_pixels_are_turned),
        cmocka_unit_test(windows_are_whole_lines),
        cmocka_unit_test(what_it_cannot_do_is_refused),
        cmocka_unit_test(errors_of_the_bus_come_back),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
