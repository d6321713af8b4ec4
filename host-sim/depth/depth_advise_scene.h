/* depth_advise_scene: advise for the frames of a demo or a model file: which surfaces would fight for pixels. */
#ifndef DEPTH_ADVISE_SCENE_H
#define DEPTH_ADVISE_SCENE_H

#include "depth_lab.h"

/*
 * Two surfaces fight at a pixel if they are less far apart there, along the ray, than the format can tell: its depth
 * step, a quarter of it for set-up, and what the sub-pixel grid moves them, sqrt(2)/512 of the change of each one's
 * distance from pixel to pixel. Then it is a matter of luck which one shows. A surface that is lit or textured fights
 * with itself, too. "wrong" are the pixels that did show another surface than the nearest.
 */
int depth_advise_scene(const struct depth_lab *lab);

#endif
