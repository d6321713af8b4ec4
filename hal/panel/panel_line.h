/*
 * panel_line: the part of the driver for Sharp's memory LCDs, whose memory consists of lines. A controller's table
 * names it (panel.h, `lines`), so that only their images have it.
 *
 *   message    mode, lines, trailer             while SCS is high
 *   mode       M0 M1 M2 0 0 0 0 0               M0: lines follow; M1: polarity of VCOM; M2: all pixels become white
 *   line       address, width / 8 bytes, 00h    the address counts from 1, its lowest bit comes first
 *   trailer    00h
 *
 * M0, the lowest bit of an address and the left pixel come first. So on this bus, whose bytes begin with bit 7, M0 and
 * the left pixel are bit 7, and an address is turned over.
 *
 * There is no D/C line, and SCS is not a usual chip select: it is high while the panel listens, and its fall ends a
 * message. D/C does exactly that, if data are what the panel is to hear: so SCS is wired to D/C (board.h, `dc`), no
 * chip select is wired, and the byte behind a message, with D/C low, lets SCS fall.
 *
 *   tsSCS  from the rise of SCS to the first edge of the clock. D/C may rise right before a byte, whose first edge is
 *          half a period later. So the first byte of a message has the slow clock: init_hz <= 1 / (2 tsSCS)
 *   thSCS  from the last edge to the fall of SCS: the driver waits for it
 *
 * Each message toggles VCOM (M1; EXTMODE is low). panel_hold() sends one without lines.
 */
#ifndef PANEL_LINE_H
#define PANEL_LINE_H

#include "panel.h"

extern const struct panel_line_ops panel_line_ops;

#endif
