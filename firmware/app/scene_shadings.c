/* The shadings that scenes may name: all. A program that shows fewer links a list of its own in place of this file. See
 * scene_file.h. */
#include "scene_file.h"

#define SHADING(name, number, word, is_textured)                                                                       \
    [number] = {true, PH_SHADE_##name, "needs the shading " word ", which this program does not have"},

const struct scene_file_shading scene_file_shadings[SCENE_FILE_SHADINGS] = {SCENE_FILE_SHADING_EACH(SHADING)};
