/* small_panel: the panel of the image for 32 KB of flash and 4 KB of RAM, and semihosting. */
#ifndef SMALL_PANEL_H
#define SMALL_PANEL_H

#include <stddef.h>
#include <stdint.h>

void panel_open(void);
void panel_frame(void);                             /* a frame begins, from the top */
void panel_end(void);                               /* ... and ends */
void panel_put(const uint16_t *pixels, uint32_t n); /* the next n pixels, RGB565 in wire order */

#define SAY 4 /* a text, which ends with a 0 */
void semihost(int what, const void *argument);
void say_hex(uint32_t value, int digits);

#endif
