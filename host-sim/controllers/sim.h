/*
 * sim: a HAL backend whose wires end in the model of a display controller, on a simulated clock.
 *
 *   struct hal hal;
 *   struct sim *sim = sim_open(board, &hal);          power on; the kit is open
 *   panel_open(&driver, &hal, &config); ...           the driver as on a real kit
 *   sim_pixels(sim, rotation, rgb);                   what a user sees
 *   sim_complaint_count(sim), sim_complaint(sim, i)   what a real controller would have rejected
 *   sim_close(sim);
 *
 * The models decode the bytes as the datasheets say and know nothing of the driver's tables: of the board only the
 * panel's name is read (and for sim_virtual() boards its geometry). They live in sim_dbi.c, sim_ssd.c, sim_page.c
 * and sim_line.c; what may be sent to the first three stands in sim_table.h.
 *
 * Time stands still but for bits and pauses on the wire, and delay_us. The bus has the clock and the pauses of the
 * board's chip (spi_clock.h).
 */
#ifndef SIM_H
#define SIM_H

#include "board.h"
#include "hal.h"
#include "sim_types.h"

struct sim;

extern const struct hal_ops sim_ops;

/* A kit, powered on and open, memory full of noise. NULL: no memory, or no model for the board's panel. */
struct sim *sim_open(const struct board *board, struct hal *hal);
void sim_close(struct sim *sim);

/*
 * What is seen on the glass, as RGB888 rows, turned so that a picture drawn with `rotation` (enum panel_rotation) is
 * upright: panel_width(panel, rotation) x panel_height(panel, rotation) x 3 bytes. Black where the display is off or
 * sleeps, the backlight is off, or a round glass has no glass. 4, 5 and 6 bits become 8 by repeating their highest bits
 * (31 -> 255, v5 << 3 | v5 >> 2); grey level g is 17 g. Where an ST7789 is told to fill red and blue of a 16-bit pixel
 * with another bit than their highest (RAMCTRL, EPF), the six bits that the glass gets become 8.
 */
void sim_pixels(const struct sim *sim, unsigned rotation, uint8_t *rgb);

struct sim_counters sim_counters(const struct sim *sim);

/* Simulated time since power-on. */
uint64_t sim_time_ns(const struct sim *sim);

/* Sets the buttons (enum hal_button) that are held down from now on. */
void sim_buttons_set(struct sim *sim, uint32_t buttons);

/* ---- complaints --------------------------------------------------------------------------------- */

/* How many complaints there were, in all and of one kind. Notes are not counted. */
uint32_t sim_complaint_count(const struct sim *sim);
uint32_t sim_complaint_count_of(const struct sim *sim, enum sim_complaint_kind kind);

/* One line of text; NULL from the SIM_COMPLAINTS_KEPTth on (they are only counted) and past the last. */
const char *sim_complaint(const struct sim *sim, uint32_t i);

/* Text of the note on a clock above the datasheet's limit; NULL if there is none. */
const char *sim_note(const struct sim *sim);

/* ---- faults, to be injected --------------------------------------------------------------------- */

void sim_fault(struct sim *sim, enum sim_fault fault, uint32_t n);

/* ---- boards of any size ------------------------------------------------------------------------- */

/* A board that no shop sells: an ST7789 whose memory is as large as its glass. */
struct sim_virtual {
    struct panel panel;
    struct board board;
    char title[40];
};

/* Makes a board with a panel of any size. width, height: 1 .. 1024, else HAL_EINVAL. The result points into *v. format
 * RGB565, 62.5 MHz, upright. */
int sim_virtual(struct sim_virtual *v, uint16_t width, uint16_t height);

/* ---- lower entries, for tests ------------------------------------------------------------------- */

/* Sends one bit on the wire, with D/C as it stands at that bit; 8 make a byte, highest first. */
void sim_bit(struct sim *sim, enum hal_dc dc, unsigned bit);

#endif
