/* font: the letters of overlay.h. Private to firmware/core. */
#ifndef PH_FONT_H
#define PH_FONT_H

#include <stdint.h>

#define PH_FONT_FIRST '!'
#define PH_FONT_LAST  '~'

/* Each letter has five columns of eight pixels, bit 0 at the top; bit 6 stands on the line. A narrow one has empty
 * columns on its sides. */
extern const uint8_t ph_font[PH_FONT_LAST - PH_FONT_FIRST + 1][5];

#endif
