/*
 * overlay: text and pictures over the picture.
 *
 * The built-in font has 5 x 7 pixels in cells of 6 x 8. It has the space, digits, capitals (small letters are drawn as
 * capitals) and
 *     ! % ' ( ) * + , - . / : < = > ?
 * All other characters are drawn as an empty box. An outline one pixel wide makes the letters legible on any
 * background. A line has 20 letters on 240 x 240 at scale 2, and 21 on 128 x 64 at scale 1.
 *
 * Text is drawn into a band after the band is rasterized. Call ph_overlay_text with the same text for every band: each
 * call draws the lines of its band. The picture does not depend on the band height.
 */
#ifndef PH_OVERLAY_H
#define PH_OVERLAY_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define PH_FONT_WIDTH  6 /* px, a cell: 5 pixels and a gap */
#define PH_FONT_HEIGHT 8 /* px, 7 pixels and a gap */

/* A band: lines y0 .. y0 + lines - 1 of a picture `width` pixels wide; y0 and lines are 0 .. 65535. */
struct ph_overlay_band {
    uint16_t *pixels; /* width * lines, wire order */
    uint16_t width;
    int32_t y0, lines;
};

/* How text looks. */
struct ph_overlay_style {
    uint16_t colour, outline; /* wire order */
    uint8_t scale;            /* px for each pixel of the font, 1 .. 8 */
};

/*
 * Draws one line of text. The first cell has its top left corner at (x, y) of the picture; the outline reaches one
 * pixel further. Text is clipped to the picture. At most 64 letters are drawn.
 */
void ph_overlay_text(const struct ph_overlay_band *band, int32_t x, int32_t y, const char *text,
                     const struct ph_overlay_style *style);

/* Width of a text in pixels. */
int32_t ph_overlay_width(const char *text, uint8_t scale);

#define PH_OVERLAY_STATS_SIZE 32 /* bytes, with the NUL */

/* Writes "16.7 MS 1152 TRI": milliseconds, rounded to a tenth, and triangles. Returns the length. */
uint32_t ph_overlay_stats(char text[PH_OVERLAY_STATS_SIZE], uint32_t frame_us, uint32_t triangles);

/*
 * Draws a text in a proportional font: letters are as wide as they are drawn, capital and small, with one pixel between
 * them, and digits are all as wide. It has all of ASCII; small letters reach one pixel below the line. With an outline
 * of the letters' own colour there is none. ph_text_width: from the first pixel to the last.
 */
void ph_text(const struct ph_overlay_band *band, int32_t x, int32_t y, const char *text,
             const struct ph_overlay_style *style);
int32_t ph_text_width(const char *text, uint8_t scale);

#define PH_TEXT_NUMBER_SIZE 12 /* bytes, with the NUL */

/* Writes a number in decimal. Returns the length. */
uint32_t ph_text_number(char text[PH_TEXT_NUMBER_SIZE], int32_t value);

/* A picture of any size. */
struct ph_sprite {
    const uint16_t *pixels; /* wire order, rows from the top */
    uint16_t width, height;
    uint8_t alpha;         /* of the whole picture, 0 .. 32: 32 covers what is behind */
    bool has_key;          /* pixels of the colour `key` are left out */
    uint16_t key;          /* wire order */
    const uint8_t *alphas; /* of each pixel, 0 .. 32, times alpha; or NULL. (Those of ph_blend are texels) */
};

/* Lays a picture over the band, its top left corner at (x, y), clipped to the band. For one that stands in the scene,
 * and is hidden by what is before it, see ph_draw_billboard in render.h. A pixel takes 3 instructions on a Cortex-M0+
 * where the picture covers, 15 with a key, 60 with alpha (tests/bench/growth.sh; a row more). */
void ph_overlay_sprite(const struct ph_overlay_band *band, int32_t x, int32_t y, const struct ph_sprite *sprite);

#ifdef __cplusplus
}
#endif

#endif
