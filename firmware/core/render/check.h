/*
 * check: arguments are checked before anything is read or written through them. Private to firmware/core.
 *
 * A library that is built with -DPH_CHECKED looks at every index of a mesh, too, which takes about as long as to
 * transform it. Programs for a PC and all tests are built so, images for kits are not.
 */
#ifndef PH_CHECK_H
#define PH_CHECK_H

#include "render.h"

#ifndef PH_CHECKED
#define PH_CHECKED 0
#endif

/* Whether all corners lie within the bounds of their mesh and part; true without bounds. */
bool ph_bounds_hold(const struct ph_mesh *mesh);

/* Whether a mesh has all that its numbers say. */
bool ph_mesh_is_whole(const struct ph_mesh *mesh);

#endif
