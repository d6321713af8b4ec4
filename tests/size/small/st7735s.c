/* A 128x128 ST7735S, as the Waveshare 1.44inch LCD HAT has it. The machine has no such panel: what goes over its wires
 * is told by semihosting, as events for pinhole-wire. */
#include "small_panel.h"

enum { DC = 1 << 25, RESET = 1 << 27, BACKLIGHT = 1 << 24 };

static uint32_t time_us, levels;

/* Says the time, in ns. */
static void say_time(void)
{
    char text[14] = "          000";
    uint32_t left = time_us;
    for (int i = 9; i >= 0; i--) {
        text[i] = (char)('0' + left % 10);
        left /= 10;
    }
    semihost(SAY, text);
}

static void set_lines(uint32_t to)
{
    levels = to;
    say_time();
    semihost(SAY, " level ");
    say_hex(levels, 8);
    semihost(SAY, "\n");
}

static void send(uint32_t is_data, const uint8_t *bytes, uint32_t n)
{
    if (n == 0) {
        return;
    }
    set_lines(is_data ? levels | DC : levels & ~(uint32_t)DC);
    say_time();
    semihost(SAY, " spi 0 8000000 8000000 0 8 ");
    say_hex(levels, 8);
    semihost(SAY, " ");
    say_hex(levels, 8);
    semihost(SAY, " ");
    time_us += n; /* 8 bits at 8 MHz */
    say_time();
    semihost(SAY, " ");
    for (uint32_t i = 0; i < n; i++) {
        say_hex(bytes[i], 2);
    }
    semihost(SAY, "\n");
}

static void command(uint8_t code, const uint8_t *values, uint32_t n, uint32_t then_ms)
{
    send(0, &code, 1);
    send(1, values, n);
    time_us += then_ms * 1000;
}

void panel_open(void)
{
    static const uint8_t rgb565 = 0x05, bgr = 0x08;
    set_lines(0);
    time_us += 100;
    set_lines(RESET);
    time_us += 120000;
    command(0x11, NULL, 0, 120); /* SLPOUT */
    command(0x3a, &rgb565, 1, 0);
    command(0x36, &bgr, 1, 0);
}

void panel_frame(void)
{
    static const uint8_t columns[] = {0, 2, 0, 129}, rows[] = {0, 1, 0, 128}; /* of its memory, 132x132 */
    command(0x2a, columns, sizeof columns, 0);
    command(0x2b, rows, sizeof rows, 0);
    command(0x2c, NULL, 0, 0);
}

/* What was in its memory before the first frame is never seen. */
void panel_end(void)
{
    if ((levels & BACKLIGHT) == 0) {
        command(0x29, NULL, 0, 0); /* DISPON */
        set_lines(levels | BACKLIGHT);
    }
}

void panel_put(const uint16_t *pixels, uint32_t n)
{
    send(1, (const uint8_t *)pixels, 2 * n);
}
