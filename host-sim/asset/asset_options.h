/* asset_options: the command line of pinhole-asset. */
#ifndef ASSET_OPTIONS_H
#define ASSET_OPTIONS_H

#include "board.h"

struct asset_options {
    const char *model, *out;
    const struct board *board; /* NULL: none named */
    uint32_t triangles;        /* UINT32_MAX: all */
    bool fit;                  /* as many as the board has room for */
    uint8_t texture_log2;
    uint8_t filter;       /* enum ph_filter */
    uint32_t flash_bytes; /* for the data; UINT32_MAX: whatever it takes */
    bool report, turntable, help;
};

/* 0 or PH_ERR_INVAL. */
int asset_options_read(struct asset_options *o, int argc, char *const argv[]);

void asset_options_help(void);

#endif
