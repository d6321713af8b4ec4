/*
 * overlay: text over the picture, for statistics.
 *
 * A built-in font of 5 x 7 pixels in cells of 6 x 8: space, digits, capitals (small letters are drawn as capitals) and
 *     ! % ' ( ) * + , - . / : < = > ?
 * Anything else is drawn as an empty box. Around the letters runs a dark outline one pixel wide, so that they can be
 * read on any background. On 240 x 240 scale 2 gives lines of 20 letters, on 128 x 64 scale 1 gives 21.
 *
 * Text is drawn into the bands after they are rasterized: call ph_overlay_text for every band with the same text; each
 * call draws the lines of its band. The picture does not depend on the band height.
 */
#ifndef PH_OVERLAY_H
#define PH_OVERLAY_H

#include <stdint.h>

#define PH_FONT_WIDTH  6 /* of a cell: 5 pixels and a gap */
#define PH_FONT_HEIGHT 8 /* 7 pixels and a gap */

/* Lines y0 .. y0 + lines - 1 of a picture `width` pixels wide. */
struct ph_overlay_band {
    uint16_t *pixels; /* width * lines, wire order */
    uint16_t width;
    int32_t y0, lines;
};

struct ph_overlay_style {
    uint16_t colour, outline; /* wire order */
    uint8_t scale;            /* pixels a pixel of the font, 1 .. 8 */
};

/*
 * Draws one line of text whose first cell has its top left corner at (x, y) of the picture (scale 1: the outline
 * reaches one pixel further). What lies outside the picture is cut off. At most 64 letters are drawn.
 */
void ph_overlay_text(const struct ph_overlay_band *band, int32_t x, int32_t y, const char *text,
                     const struct ph_overlay_style *style);

/* Width of a text in pixels. */
int32_t ph_overlay_width(const char *text, uint8_t scale);

#define PH_OVERLAY_STATS_SIZE 32

/* "16.7 MS 1152 TRI": milliseconds rounded to a tenth, triangles. Returns the length. */
uint32_t ph_overlay_stats(char text[PH_OVERLAY_STATS_SIZE], uint32_t frame_us, uint32_t triangles);

#endif
