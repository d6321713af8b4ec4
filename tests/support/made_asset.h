/* made_asset: an asset whose numbers are made by hand and all differ, for tests of what is written and counted. */
#ifndef MADE_ASSET_H
#define MADE_ASSET_H

#include "asset.h"

/*
 * Four meshes; 0 and 1 have equal ramps.
 *   0   3 vertices, 1 triangle    GOURAUD; if it moves, by a skin of three joints
 *   1   4 vertices, 2 triangles   TEXTURE_LIT, repeated, with levels; blended by alphas
 *   2   5 vertices, 3 triangles   TEXTURE, the texture of mesh 1; added, without alphas; moves by two morph targets
 *   3   3 vertices, 1 triangle    UNLIT, colours, two-sided, the blend of mesh 1; moves by the skin of mesh 0, a copy,
 *                                 and by a morph target without normals
 * The rig has three nodes and three weights, and there are two clips, of which the second plays.
 */
enum { MADE_MESHES = 4, MADE_MOVING = 3, MADE_NODES = 3, MADE_WEIGHTS = 3, MADE_CLIPS = 2 };

/* Makes it anew; the last one is gone. */
struct asset *made_asset(bool moves);

/* Parts of it that a test may change. */
struct ph_material *made_material(uint32_t mesh);
struct ph_blend *made_blend(uint32_t mesh);
struct animation_mesh *made_moving(uint32_t i);

#endif
