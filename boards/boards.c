/* See boards.h and board.h. */
#include "boards.h"

#include "boards_all.h"

#include <string.h>

const struct board *const board_list[] = {BOARDS_ALL};

const uint32_t board_count = sizeof board_list / sizeof board_list[0];

const struct board *board_find(const char *name)
{
    for (uint32_t i = 0; i < board_count; i++) {
        if (strcmp(board_list[i]->name, name) == 0) {
            return board_list[i];
        }
    }
    return NULL;
}
