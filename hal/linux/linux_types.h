/* linux_types: what an open kit (linux.h) holds of the bus, the lines and the buttons. Private to hal/linux. */
#ifndef HAL_LINUX_TYPES_H
#define HAL_LINUX_TYPES_H

#include "linux_look.h"

/* The bus; spi.h. */
struct linux_spi {
    char name[LINUX_PATH_SIZE]; /* the path that was opened */
    int descriptor;
    uint32_t clock_hz;
};

/* One line that was taken; gpio_lines.h. */
struct linux_line {
    void *chip, *request, *events; /* libgpiod's; request NULL: not wired */
    unsigned offset;
    bool active_low;
};

/* One button's contacts, debounced; debounce.h. */
struct linux_button {
    struct linux_line line;
    bool raw;         /* level at its last edge */
    bool held;        /* debounced */
    bool was_held;    /* pressed since the last look */
    uint64_t edge_ns; /* time of the last edge */
    uint64_t held_ns; /* time of the last change of held */
};

#endif
