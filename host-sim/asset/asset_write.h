/* asset_write: parts of the C file that asset_write() writes. */
#ifndef ASSET_WRITE_H
#define ASSET_WRITE_H

#include "asset.h"

void asset_put_vec3(FILE *file, struct fx_vec3 v);

/* The const struct animation `animation`, and its data. */
void asset_write_motion(FILE *file, const struct model *model);

#endif
