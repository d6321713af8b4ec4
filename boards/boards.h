/* boards: all kits. Boards of a family share their wiring in families/. boards_all.h has their names: make writes it,
 * from the folders here that have a board.c. */
#ifndef BOARDS_H
#define BOARDS_H

#include "board.h"
#include "budgets.h"
#include "panels.h"

#include "boards_all.h" /* after struct board */

/* Raspberry Pi 5; 4; all before. GPIOn of the header is line n of the chip with this label. */
#define RPI_GPIO_LABELS "pinctrl-rp1 pinctrl-bcm2711 pinctrl-bcm2835"

#endif
