/* boards: what the kits here are made of. Boards of a family share their wiring in families/. Their names are in
 * boards_all.h, which make writes from the folders here that have a board.c. */
#ifndef BOARDS_H
#define BOARDS_H

#include "board.h"
#include "budgets.h"
#include "panels.h"

/* Raspberry Pi 5; 4; all before. GPIOn of the header is line n of the chip with this label. */
#define RPI_GPIO_LABELS "pinctrl-rp1 pinctrl-bcm2711 pinctrl-bcm2835"

#endif
