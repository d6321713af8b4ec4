/* asset_fit: a model made as small as a board has room for. */
#ifndef ASSET_FIT_H
#define ASSET_FIT_H

#include "asset.h"

struct asset_goal {
    const char *model;         /* path of the file, for its name and for messages */
    const struct board *board; /* NULL: none */
    uint32_t triangles;        /* at most; UINT32_MAX: all */
    bool fit;                  /* as many as the board has room for */
    bool turntable;            /* also where the file has a camera */
    uint8_t texture_log2;
    uint32_t flash_bytes; /* for the data; UINT32_MAX: whatever it takes */
};

#define ASSET_TEXTURE_LOG2 8 /* the longest side of textures, where nothing else is said */

/* Reads N, all or fit. */
bool asset_triangles_named(const char *text, struct asset_goal *goal);

/* Makes the asset, and says so on stderr if `fit` simplified it. 0, or COMPLAINED: also where board or flash have not
 * the room. asset_free() it in any case. */
int asset_fit(struct asset *asset, const struct model *model, const struct asset_goal *goal);

/* The two steps of asset_fit: the first makes the asset, whether it fits or not; the second says so, or refuses it. */
int asset_fit_make(struct asset *asset, const struct model *model, const struct asset_goal *goal);
int asset_fit_check(const struct asset *asset, const struct model *model, const struct asset_goal *goal);

#endif
