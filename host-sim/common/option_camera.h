/* option_camera: the value of --camera, in the ways in which the textbooks state a view (camera.h). */
#ifndef OPTION_CAMERA_H
#define OPTION_CAMERA_H

#include "geom.h"

#include <stdbool.h>

struct option_camera {
    bool set;
    struct ph_xform view;
    fx_t distance; /* from the eye to its target; 3 where there is none */
};

/*
 * Keys with their numbers, in any order, each at most once:
 *   eye, target (the origin), up (the y axis)              look-at
 *   vrp, vpn, vup (the y axis)                             PHIGS
 *   ypr=YAW,PITCH,ROLL in degrees, eye (the origin)
 *   quat=W,X,Y,Z of any length but 0, eye (the origin)
 * False, and *out stays as it was, if the text is something else.
 */
bool option_camera_read(const char *text, struct option_camera *out);

#define OPTION_CAMERA_FORMS                                                                                            \
    "eye=X,Y,Z[,target=..][,up=..]|vrp=..,vpn=..[,vup=..]|ypr=Y,P,R[,eye=..]|quat=W,X,Y,Z[,eye=..]"
#define OPTION_CAMERA_TELLS                                                                                            \
    "the eye looks at the target, the origin by default, and up is the y axis by default. Or PHIGS: view reference\n"  \
    "        point, view plane normal (towards the viewer), view up vector. Or yaw, pitch and roll in degrees, or a\n" \
    "        quaternion, at the eye, the origin by default"
#define OPTION_CAMERA_VALUES                                                                                           \
    "eye=X,Y,Z with target=X,Y,Z and up=X,Y,Z, vrp= with vpn= and vup=, ypr= with eye=, or quat= with eye=, commas "   \
    "between them; numbers -32768 .. 32767.99"

#endif
