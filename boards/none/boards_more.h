/* boards_more: the kits of make's BOARD_DIR=, for boards.c. Without BOARD_DIR there are none; with it make writes one.
 */
#ifndef BOARDS_MORE_H
#define BOARDS_MORE_H

#define BOARDS_MORE

#endif
