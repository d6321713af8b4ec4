/* See nearest.h. Suggests a demo or a board; apart from nearest.c, because few programs know these lists. */
#include "board.h"
#include "demo.h"
#include "nearest.h"

const char *nearest_demo(const void *from, size_t i)
{
    (void)from;
    return i < demo_count ? demo_list[i]->name : NULL;
}

const char *nearest_board(const void *from, size_t i)
{
    (void)from;
    return i < board_count ? board_list[i]->name : NULL;
}
