/*
 * Usage: ram-bytes
 * Prints ram_bytes of the board whose symbol BOARD_HERE is. firmware.mk compiles it with that board's board.c on the
 * computer that builds the image.
 */
#include <stdio.h>

#include "board.h"

#ifdef BOARD_HERE /* make lint reads this file without a board */

extern const struct board BOARD_HERE;

int main(void)
{
    return printf("%lu\n", (unsigned long)BOARD_HERE.ram_bytes) > 0 ? 0 : 1;
}

#endif
