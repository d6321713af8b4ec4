/* Text over the picture: see overlay.h. */
#include "overlay.h"

#include "font.h"
#include "tier.h"

#include <stdbool.h>
#include <stddef.h>

#define LETTER_MAX 64
#define SPACE      3 /* px, of the proportional font */

/* The overlay has a box in place of a letter that it has not. */
static const uint8_t box[5] = {0x7f, 0x41, 0x41, 0x41, 0x7f};

static const uint8_t *glyph_of(char letter)
{
    const char c = letter >= 'a' && letter <= 'z' ? (char)(letter - 'a' + 'A') : letter;
    if (c == ' ') {
        return NULL;
    }
    const bool known =
        c >= PH_FONT_FIRST && c <= 'Z' && c != '"' && c != '#' && c != '$' && c != '&' && c != ';' && c != '@';
    return known ? ph_font[c - PH_FONT_FIRST] : box;
}

/* Draws pixels below each other where bits are set (one is), from bit 0 on: in `colour` where inner ones are, else in
 * `outline`. Apart, so that the loop keeps to registers. */
PH_TIER(scenery)
static __attribute__((noinline)) void draw_bits(uint16_t *to, int32_t width, uint32_t bits, uint32_t inner,
                                                uint32_t colour, uint32_t outline)
{
    do { /* at most 32 times */
        if ((bits & 1) != 0) {
            *to = (uint16_t)((inner & 1) != 0 ? colour : outline);
        }
        to += width;
        inner >>= 1;
        bits >>= 1;
    } while (bits != 0);
}

/* Draws a rectangle, as far as it lies in the band. */
static void draw_rectangle(const struct ph_overlay_band *band, int32_t x, int32_t y, int32_t width, int32_t height,
                           uint16_t colour)
{
    const int32_t pitch = band->width, x0 = x < 0 ? 0 : x, x1 = x + width < pitch ? x + width : pitch;
    const int32_t y0 = y < band->y0 ? 0 : y - band->y0;
    const int32_t y1 = y + height - band->y0 < band->lines ? y + height - band->y0 : band->lines;
    for (int32_t line = y0; line < y1; line++) {
        uint16_t *const row = band->pixels + line * pitch;
        for (int32_t i = x0; i < x1; i++) {
            row[i] = colour;
        }
    }
}

/* Draws a letter of which each pixel is a square, by runs of pixels below each other. */
static __attribute__((noinline)) void draw_squares(const struct ph_overlay_band *band, int32_t x, int32_t y,
                                                   const uint8_t *glyph, int32_t scale, int32_t more, uint16_t colour)
{
    for (int32_t column = 0; column < 5; column++, x += scale) {
        for (int32_t row = 0, end; glyph[column] >> row != 0; row = end) {
            for (end = row + 1; (glyph[column] >> row & glyph[column] >> end & 1) != 0; end++) {
            }
            if ((glyph[column] >> row & 1) != 0) {
                draw_rectangle(band, x - more, y + row * scale - more, scale + 2 * more, (end - row) * scale + 2 * more,
                               colour);
            }
        }
    }
}

/* A letter's style; outlined: around its pixels those of the outline are drawn. */
struct ink {
    uint16_t colour, outline;
    bool outlined;
};

/* Draws a letter pixel by pixel, and its outline, by columns. */
PH_TIER(scenery)
static void draw_pixels(const struct ph_overlay_band *band, int32_t x, int32_t y, const uint8_t *glyph,
                        const struct ink *ink)
{
    const int32_t above = band->y0 - y + 1, hidden = above > 0 ? above : 0, below = band->lines + above;
    if (hidden > 9 || below <= 0) {
        return;
    }
    const uint32_t shown = below < 10 ? ((uint32_t)1 << below) - 1 : 1023;
    const int32_t width = band->width; /* pixels might alias it */
    uint16_t *to = band->pixels + (hidden - above) * width + x - 1;
    uint32_t before = 0, here = 0, after;
    for (int32_t column = -1; column < 6; column++, to++, before = here, here = after) {
        after = column < 4 ? glyph[column + 1] : 0;
        const uint32_t near = ink->outlined ? before | here | after : here << 1;
        const uint32_t bits = ((ink->outlined ? near | near << 1 | near << 2 : near) & shown) >> hidden;
        if (bits != 0 && (uint32_t)(x + column) < (uint32_t)width) {
            draw_bits(to, width, bits, here << 1 >> hidden, ink->colour, ink->outline);
        }
    }
}

/* Draws one letter: each pixel of the font is a square `scale` wide. The outline, and all of `more` 1, makes it one
 * pixel larger on all sides. With a scale of 1 both are drawn at a time: outlines only meet between letters. */
PH_TIER(scenery)
static void draw_letter(const struct ph_overlay_band *band, int32_t x, int32_t y, const uint8_t *glyph, int32_t scale,
                        int32_t more, const struct ink *ink)
{
    if (scale > 1) {
        draw_squares(band, x, y, glyph, scale, more, more > 0 ? ink->outline : ink->colour);
    } else {
        draw_pixels(band, x, y, glyph, ink);
    }
}

/* Whether a text at y, with its outline, may reach the band. */
static bool reaches(const struct ph_overlay_band *band, int32_t y, int32_t scale)
{
    return y - 1 < band->y0 + band->lines && y + 8 * scale + 1 > band->y0;
}

PH_TIER(scenery)
void ph_overlay_text(const struct ph_overlay_band *band, int32_t x, int32_t y, const char *text,
                     const struct ph_overlay_style *style)
{
    const int32_t scale = style->scale < 1 ? 1 : style->scale > 8 ? 8 : style->scale;
    if (x < -32768 || x > 32767 || y < -32768 || y > 32767 || !reaches(band, y, scale)) {
        return;
    }
    const struct ink ink = {style->colour, style->outline, true};
    for (int32_t more = scale > 1; more >= 0; more--) { /* all outlines come first, so none covers a letter */
        for (int32_t i = 0; i < LETTER_MAX && text[i] != '\0'; i++) {
            const uint8_t *glyph = glyph_of(text[i]);
            if (glyph != NULL) {
                draw_letter(band, x + i * PH_FONT_WIDTH * scale, y, glyph, scale, more, &ink);
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

/* ---- proportional text ------------------------------------------------------------------------------------------ */

/* The columns of a letter that are not empty. A digit keeps all five, so that numbers keep their places. A letter that
 * is not in the font is a box. */
struct letter {
    const uint8_t *columns;
    int32_t first, width; /* width 0: nothing is drawn */
};

PH_TIER(scenery) static struct letter letter_of(char c)
{
    if (c == ' ') {
        return (struct letter){box, 0, 0};
    }
    struct letter l = {c >= PH_FONT_FIRST && c <= PH_FONT_LAST ? ph_font[c - PH_FONT_FIRST] : box, 0, 5};
    if (c >= '0' && c <= '9') {
        return l;
    }
    while (l.columns[l.first] == 0) {
        l.first++;
    }
    while (l.columns[l.width - 1] == 0) {
        l.width--;
    }
    l.width -= l.first;
    return l;
}

/* How far the next letter is, in pixels of the font. */
static int32_t step_of(const struct letter *l)
{
    return l->width > 0 ? l->width + 1 : SPACE;
}

static int32_t scale_of(uint8_t scale)
{
    return scale < 1 ? 1 : scale > 8 ? 8 : scale;
}

int32_t ph_text_width(const char *text, uint8_t scale)
{
    int32_t width = 0;
    for (int i = 0; i < LETTER_MAX && text[i] != '\0'; i++) {
        const struct letter l = letter_of(text[i]);
        width += step_of(&l);
    }
    return width > 0 ? (width - 1) * scale_of(scale) : 0;
}

void ph_text(const struct ph_overlay_band *band, int32_t x, int32_t y, const char *text,
             const struct ph_overlay_style *style)
{
    const int32_t scale = scale_of(style->scale);
    if (x < -32768 || x > 32767 || y < -32768 || y > 32767 || !reaches(band, y, scale)) {
        return;
    }
    const struct ink ink = {style->colour, style->outline, style->outline != style->colour};
    for (int32_t more = ink.outlined && scale > 1; more >= 0; more--) { /* all outlines first, then all letters */
        int32_t at = x;
        for (int i = 0; i < LETTER_MAX && text[i] != '\0'; i++) {
            const struct letter l = letter_of(text[i]);
            if (l.width > 0) {
                draw_letter(band, at - l.first * scale, y, l.columns, scale, more, &ink);
            }
            at += step_of(&l) * scale;
        }
    }
}

/* ---- numbers ---------------------------------------------------------------------------------------------------- */

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

uint32_t ph_text_number(char text[PH_TEXT_NUMBER_SIZE], int32_t value)
{
    uint32_t n = 0;
    if (value < 0) {
        text[n++] = '-';
    }
    n += append_number(text + n, value < 0 ? 0u - (uint32_t)value : (uint32_t)value);
    text[n] = '\0';
    return n;
}
