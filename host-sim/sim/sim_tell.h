/* sim_tell: what --matrix and --point print of the cameras of a frame. */
#ifndef SIM_TELL_H
#define SIM_TELL_H

#include "sim_options.h"
#include "sim_player.h"

/* Makes the scene of the first frame, and prints what the options ask for of each of its cameras. 0 or COMPLAINED. */
int sim_tell_cameras(const struct sim_options *o, FILE *file, struct sim_player *p, struct sim_matrix_writing writing);

#endif
