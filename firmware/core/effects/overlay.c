/* Text over the picture: see overlay.h. */
#include "overlay.h"

#include <stddef.h>

#define FIRST      '!'
#define LAST       'Z'
#define LETTER_MAX 64

/* The glyphs from ! to Z, each five columns of seven pixels, bit 0 at the top. " # $ & ; @ have a box instead. */
static const uint8_t font[LAST - FIRST + 1][5] = {
    {0x00, 0x00, 0x5f, 0x00, 0x00}, {0x7f, 0x41, 0x41, 0x41, 0x7f}, {0x7f, 0x41, 0x41, 0x41, 0x7f}, /* ! " # */
    {0x7f, 0x41, 0x41, 0x41, 0x7f}, {0x63, 0x13, 0x08, 0x64, 0x63}, {0x7f, 0x41, 0x41, 0x41, 0x7f}, /* $ % & */
    {0x00, 0x04, 0x03, 0x00, 0x00}, {0x00, 0x1c, 0x22, 0x41, 0x00}, {0x00, 0x41, 0x22, 0x1c, 0x00}, /* ' ( ) */
    {0x2a, 0x1c, 0x3e, 0x1c, 0x2a}, {0x08, 0x08, 0x3e, 0x08, 0x08}, {0x00, 0x40, 0x30, 0x10, 0x00}, /* star + , */
    {0x08, 0x08, 0x08, 0x08, 0x08}, {0x00, 0x60, 0x60, 0x00, 0x00}, {0x60, 0x10, 0x08, 0x04, 0x03}, /* - . slash */
    {0x3e, 0x51, 0x49, 0x45, 0x3e}, {0x00, 0x42, 0x7f, 0x40, 0x00}, {0x62, 0x51, 0x49, 0x49, 0x46}, /* 0 1 2 */
    {0x41, 0x49, 0x49, 0x49, 0x36}, {0x18, 0x14, 0x12, 0x7f, 0x10}, {0x27, 0x45, 0x45, 0x45, 0x39}, /* 3 4 5 */
    {0x3c, 0x4a, 0x49, 0x49, 0x30}, {0x01, 0x61, 0x19, 0x05, 0x03}, {0x36, 0x49, 0x49, 0x49, 0x36}, /* 6 7 8 */
    {0x06, 0x49, 0x49, 0x29, 0x1e}, {0x00, 0x36, 0x36, 0x00, 0x00}, {0x7f, 0x41, 0x41, 0x41, 0x7f}, /* 9 : ; */
    {0x08, 0x14, 0x22, 0x41, 0x00}, {0x14, 0x14, 0x14, 0x14, 0x14}, {0x00, 0x41, 0x22, 0x14, 0x08}, /* < = > */
    {0x02, 0x01, 0x59, 0x09, 0x06}, {0x7f, 0x41, 0x41, 0x41, 0x7f}, {0x7c, 0x12, 0x11, 0x12, 0x7c}, /* ? @ A */
    {0x7f, 0x49, 0x49, 0x49, 0x36}, {0x3e, 0x41, 0x41, 0x41, 0x41}, {0x7f, 0x41, 0x41, 0x22, 0x1c}, /* B C D */
    {0x7f, 0x49, 0x49, 0x49, 0x41}, {0x7f, 0x09, 0x09, 0x09, 0x01}, {0x3e, 0x41, 0x41, 0x49, 0x79}, /* E F G */
    {0x7f, 0x08, 0x08, 0x08, 0x7f}, {0x00, 0x41, 0x7f, 0x41, 0x00}, {0x20, 0x40, 0x41, 0x3f, 0x01}, /* H I J */
    {0x7f, 0x08, 0x14, 0x22, 0x41}, {0x7f, 0x40, 0x40, 0x40, 0x40}, {0x7f, 0x02, 0x0c, 0x02, 0x7f}, /* K L M */
    {0x7f, 0x06, 0x08, 0x30, 0x7f}, {0x3e, 0x41, 0x41, 0x41, 0x3e}, {0x7f, 0x09, 0x09, 0x09, 0x06}, /* N O P */
    {0x3e, 0x41, 0x51, 0x21, 0x5e}, {0x7f, 0x09, 0x19, 0x29, 0x46}, {0x46, 0x49, 0x49, 0x49, 0x31}, /* Q R S */
    {0x01, 0x01, 0x7f, 0x01, 0x01}, {0x3f, 0x40, 0x40, 0x40, 0x3f}, {0x0f, 0x30, 0x40, 0x30, 0x0f}, /* T U V */
    {0x7f, 0x20, 0x18, 0x20, 0x7f}, {0x63, 0x14, 0x08, 0x14, 0x63}, {0x03, 0x04, 0x78, 0x04, 0x03}, /* W X Y */
    {0x61, 0x51, 0x49, 0x45, 0x43},                                                                 /* Z */
};

static const uint8_t *glyph_of(char letter)
{
    const char c = letter >= 'a' && letter <= 'z' ? (char)(letter - 'a' + 'A') : letter;
    if (c == ' ') {
        return NULL;
    }
    return font[c >= FIRST && c <= LAST ? c - FIRST : '"' - FIRST]; /* a box */
}

/* Fills a square of size x size pixels, clipped to the band. */
static void fill(const struct ph_overlay_band *band, int32_t x, int32_t y, int32_t size, uint16_t colour)
{
    const int32_t x0 = x > 0 ? x : 0, x1 = x + size < band->width ? x + size : band->width;
    const int32_t y0 = y > band->y0 ? y : band->y0;
    const int32_t y1 = y + size < band->y0 + band->lines ? y + size : band->y0 + band->lines;
    for (int32_t row = y0; row < y1; row++) {
        uint16_t *pixels = band->pixels + (row - band->y0) * band->width;
        for (int32_t column = x0; column < x1; column++) {
            pixels[column] = colour;
        }
    }
}

/* Draws one letter: each pixel of the font is a square `scale` wide, made `more` pixels larger on all sides. */
static void draw_letter(const struct ph_overlay_band *band, int32_t x, int32_t y, const uint8_t *glyph, int32_t scale,
                        int32_t more, uint16_t colour)
{
    for (int32_t column = 0; column < 5; column++) {
        for (int32_t row = 0; row < 7; row++) {
            if ((glyph[column] >> row & 1) != 0) {
                fill(band, x + column * scale - more, y + row * scale - more, scale + 2 * more, colour);
            }
        }
    }
}

void ph_overlay_text(const struct ph_overlay_band *band, int32_t x, int32_t y, const char *text,
                     const struct ph_overlay_style *style)
{
    const int32_t scale = style->scale < 1 ? 1 : style->scale > 8 ? 8 : style->scale;
    if (x < -32768 || x > 32767 || y < -32768 || y > 32767 || y - 1 >= band->y0 + band->lines ||
        y + 7 * scale + 1 <= band->y0) {
        return;
    }
    for (int32_t more = 1; more >= 0; more--) { /* all outlines come first, so none covers a letter */
        const uint16_t colour = more > 0 ? style->outline : style->colour;
        for (int32_t i = 0; i < LETTER_MAX && text[i] != '\0'; i++) {
            const uint8_t *glyph = glyph_of(text[i]);
            if (glyph != NULL) {
                draw_letter(band, x + i * PH_FONT_WIDTH * scale, y, glyph, scale, more, colour);
            }
        }
    }
}

int32_t ph_overlay_width(const char *text, uint8_t scale)
{
    int32_t letters = 0;
    while (letters < LETTER_MAX && text[letters] != '\0') {
        letters++;
    }
    return letters * PH_FONT_WIDTH * (scale < 1 ? 1 : scale > 8 ? 8 : scale);
}

/* Writes v in decimal; returns its length. */
static uint32_t append_number(char *text, uint32_t v)
{
    char digits[10];
    uint32_t count = 0, n = 0;
    do {
        digits[count++] = (char)('0' + v % 10);
        v /= 10;
    } while (v > 0);
    while (count > 0) {
        text[n++] = digits[--count];
    }
    return n;
}

static uint32_t append_text(char *text, const char *more)
{
    uint32_t n = 0;
    for (; more[n] != '\0'; n++) {
        text[n] = more[n];
    }
    return n;
}

uint32_t ph_overlay_stats(char text[PH_OVERLAY_STATS_SIZE], uint32_t frame_us, uint32_t triangles)
{
    const uint32_t tenths = frame_us / 100 + (frame_us % 100 >= 50);
    uint32_t n = append_number(text, tenths / 10);
    text[n++] = '.';
    text[n++] = (char)('0' + tenths % 10);
    n += append_text(text + n, " MS ");
    n += append_number(text + n, triangles);
    n += append_text(text + n, " TRI");
    text[n] = '\0';
    return n;
}
