/* asset_compare: how much of a picture simplification has changed. */
#ifndef ASSET_COMPARE_H
#define ASSET_COMPARE_H

#include "asset.h"

#define ASSET_SIDES    8   /* from which both are drawn, all round the turntable */
#define ASSET_OFF      40  /* of 255: by so much, or less, a channel of a pixel may be off */
#define ASSET_OFF_MOST .10 /* a person accepts no larger share of pixels */

/*
 * Draws the asset and the model that it was made of from ASSET_SIDES sides, each at another moment of a clip, in a
 * picture of that size. *share becomes the share of the pixels showing one of them, 0 .. 1, of which a channel is off
 * by more than ASSET_OFF of 255. 0 or COMPLAINED.
 */
int asset_compare(const struct asset *asset, const struct model *model, uint16_t width, uint16_t height, double *share);

#endif
