/* A 128x128 ST7735S, as the Waveshare 1.44inch LCD HAT has it. The machine has no such panel: what goes over its wires
 * is told by semihosting, as events for pinhole-wire. */
#include "small_panel.h"

enum { DC = 2, RESET = 8, BACKLIGHT = 1, LINES_FROM = 24 }; /* GPIO25, GPIO27, GPIO24 */

static uint16_t time_ms;
static uint8_t levels; /* of the lines from GPIO24 on */

/* Says the time, in ns. */
static void say_time(void)
{
    char text[12] = "     000000";
    uint32_t left = time_ms;
    for (int i = 4; i >= 0; i--) {
        text[i] = (char)('0' + left % 10);
        left /= 10;
    }
    semihost(SAY, text);
}

static void set_lines(uint8_t to)
{
    levels = to;
    say_time();
    semihost(SAY, " level ");
    say_hex((uint32_t)levels << LINES_FROM, 8);
    semihost(SAY, "\n");
}

static void send(uint32_t is_data, const uint8_t *bytes, uint32_t n)
{
    if (n == 0) {
        return;
    }
    set_lines((uint8_t)(is_data ? levels | DC : levels & ~DC));
    say_time();
    semihost(SAY, " spi 0 8000000 8000000 0 8 ");
    say_hex((uint32_t)levels << LINES_FROM, 8);
    semihost(SAY, " ");
    say_hex((uint32_t)levels << LINES_FROM, 8);
    semihost(SAY, " ");
    time_ms = (uint16_t)(time_ms + n / 1000 + 1); /* 8 bits at 8 MHz, and a rest */
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
    time_ms = (uint16_t)(time_ms + then_ms);
}

void panel_open(void)
{
    static const uint8_t rgb565 = 0x05, bgr = 0x08;
    set_lines(0);
    time_ms = 1;
    set_lines(RESET);
    time_ms = 121;
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
        set_lines((uint8_t)(levels | BACKLIGHT));
    }
}

void panel_put(const uint16_t *pixels, uint32_t n)
{
    send(1, (const uint8_t *)pixels, 2 * n);
}
