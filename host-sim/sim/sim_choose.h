/*
 * sim_choose: the kit, the camera and the scene that the options ask for. Model files are chosen by pinhole_sim.c. Each
 * function returns 0, or PH_ERR_INVAL after a message about what is wrong with the options.
 */
#ifndef SIM_CHOOSE_H
#define SIM_CHOOSE_H

#include "sim_options.h"
#include "sim_player.h"

#define SIM_ANTIALIAS_MAX 512u /* pixels a side: see struct ph_config */

/* A setup points into this, so that it lives as long as the player. */
struct sim_choice {
    struct sim_virtual virtual_board;
    struct sim_matrix_writing writing; /* set its convention first; how the camera's matrices are written */
};

/* Chooses the board, all of the setup that belongs to it, and the camera. */
int sim_choose_kit(const struct sim_options *o, struct sim_choice *choice, struct sim_player_setup *setup);

/* Chooses the camera for the setup's board, whose size may have changed. */
int sim_choose_camera(const struct sim_options *o, const struct sim_player_setup *setup, struct demo_camera *camera,
                      struct sim_matrix_writing *writing);

/* Chooses the demo, and its view. */
int sim_choose_demo(const struct sim_options *o, struct sim_player_setup *setup);

/* Chooses one of the views of the setup's demo. */
int sim_choose_view(const struct sim_options *o, struct sim_player_setup *setup);

#endif
