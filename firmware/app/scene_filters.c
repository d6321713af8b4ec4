/* The filters that scenes may name: all. A program that shows fewer links a list of its own in place of this file. See
 * scene_file.h. */
#include "scene_file.h"

#define LACKS(name) "needs the filter " name ", which this program does not have"

const struct scene_file_filter scene_file_filters[SCENE_FILE_FILTERS] = {
    [SCENE_FILE_NEAREST] = {true, PH_FILTER_NEAREST, LACKS("nearest")},
    [SCENE_FILE_BILINEAR] = {true, PH_FILTER_BILINEAR, LACKS("bilinear")},
    [SCENE_FILE_MIPMAP] = {true, PH_FILTER_MIPMAP, LACKS("mipmap")},
};
