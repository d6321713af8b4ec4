/* asset_check: looks at files that pinhole-asset has written. */
#ifndef ASSET_CHECK_H
#define ASSET_CHECK_H

/* Looks at a C file, whether each mesh that has bounds keeps within them, or at a binary scene, whether it can be drawn
 * (its bounds are made when it is opened). 0 or COMPLAINED. */
int asset_check(const char *path);

#endif
