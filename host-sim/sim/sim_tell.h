/* sim_tell: what --matrix, --point and --frustum print of the cameras of a frame, and the camera that --parent
 * makes a child of one of its meshes. */
#ifndef SIM_TELL_H
#define SIM_TELL_H

#include "sim_options.h"
#include "sim_player.h"

/* Makes the scene of the first frame, and prints what the options ask for of each of its cameras. 0 or COMPLAINED. */
int sim_tell_cameras(const struct sim_options *o, FILE *file, struct sim_player *p, struct sim_matrix_writing writing);

/* With --parent: makes the scene of the frame, and sets the camera for where the mesh is. The frame is then to be made
 * again. 0 or COMPLAINED. */
int sim_tell_ride(const struct sim_options *o, struct sim_player *p, uint32_t frame);

#endif
