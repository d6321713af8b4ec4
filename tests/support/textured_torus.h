/* textured_torus: the benchmark's torus with texture coordinates, of the scenes S6 to S8. */
#ifndef TEXTURED_TORUS_H
#define TEXTURED_TORUS_H

#include "ref.h"

/* The texture repeats 4 x 2 times around it: the vertices are doubled at the seams. Its id is that of the cube. */
void textured_torus_build(struct ref_scene *scene);

#endif
