/* asset_options: the command line of pinhole-asset. */
#ifndef ASSET_OPTIONS_H
#define ASSET_OPTIONS_H

#include "asset_fit.h"

struct asset_options {
    struct asset_goal goal;
    struct model_options model_options;
    const char *out, *clip;
    bool report, force, check, help;
};

/* Reads the command line. 0 or PH_ERR_INVAL. */
int asset_options_read(struct asset_options *o, int argc, char *const argv[]);

void asset_options_help(void);

#endif
