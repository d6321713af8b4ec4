/* sim_rows: how the tables of controllers (dbi_table.c, ssd_table.c, page_table.c) write an entry of sim_table.h. */
#ifndef SIM_ROWS_H
#define SIM_ROWS_H

#include "sim_table.h"

/* The parameters of a command: field by field, none, or exactly these bytes. */
#define FIELDS(...)                                                                                                    \
    .fields = (const struct sim_field[]){__VA_ARGS__},                                                                 \
    .field_count = sizeof((const struct sim_field[]){__VA_ARGS__}) / sizeof(struct sim_field)
#define BARE .exact = NULL
#define BYTES(...)                                                                                                     \
    .exact = (const uint8_t[])                                                                                         \
    {                                                                                                                  \
        __VA_ARGS__                                                                                                    \
    }

/* A controller's table. */
#define LIST(list) .commands = (list), .count = sizeof(list) / sizeof((list)[0])

#endif
