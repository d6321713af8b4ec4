/* boards_more: the kits of make's BOARD_DIR=, for boards.c. Without it there are none; with it make writes such a file.
 */
#ifndef BOARDS_MORE_H
#define BOARDS_MORE_H

#define BOARDS_MORE

#endif
