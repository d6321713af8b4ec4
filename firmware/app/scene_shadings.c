/* The shadings that scenes may name: all. A program that shows fewer links a list of its own in place of this file. See
 * scene_file.h. */
#include "scene_file.h"

#define LACKS(name) "needs the shading " name ", which this program does not have"

const struct scene_file_shading scene_file_shadings[SCENE_FILE_SHADINGS] = {
    [SCENE_FILE_UNLIT] = {true, PH_SHADE_UNLIT, LACKS("unlit")},
    [SCENE_FILE_FLAT] = {true, PH_SHADE_FLAT, LACKS("flat")},
    [SCENE_FILE_GOURAUD] = {true, PH_SHADE_GOURAUD, LACKS("gouraud")},
    [SCENE_FILE_TEXTURE] = {true, PH_SHADE_TEXTURE, LACKS("texture")},
    [SCENE_FILE_TEXTURE_LIT] = {true, PH_SHADE_TEXTURE_LIT, LACKS("texture-lit")},
    [SCENE_FILE_TEXTURE_GOURAUD] = {true, PH_SHADE_TEXTURE_GOURAUD, LACKS("texture-gouraud")},
};
