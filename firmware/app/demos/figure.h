/*
 * figure: a figure that is made and moved by code: rig, clips, meshes and texture. It consists of three tubes of
 * elliptic rings: the body, an arm and a leg; both arms are the same mesh that follows other joints, and so are the
 * legs. The demo character draws it, and so does the walker of tests/bench. Functions that take memory of an arena
 * return false, or PH_ERR_NOMEM, when there is too little.
 */
#ifndef FIGURE_H
#define FIGURE_H

#include "demo.h"
#include "motion.h"

#define FIGURE_MM(v)      ((v) * (PH_MOTION_ONE / 1000)) /* thousandths, to Q8.24 */
#define FIGURE_FRAC       15                             /* of the positions */
#define FIGURE_JOINTS     5                              /* of a tube, most */
#define FIGURE_TUBES      3
#define FIGURE_BODY_RINGS 19
#define FIGURE_ARM_RINGS  17
#define FIGURE_LEG_RINGS  17

/* The nodes of a figure's rig. */
enum {
    FIGURE_HIPS,
    FIGURE_SPINE,
    FIGURE_CHEST,
    FIGURE_NECK,
    FIGURE_HEAD,
    FIGURE_ARM,                    /* upper arm, forearm, hand; left, then right */
    FIGURE_LEG = FIGURE_ARM + 6,   /* thigh, shin, foot, toes; left, then right */
    FIGURE_NODES = FIGURE_LEG + 8, /* 19 */
};

extern const struct ph_rig figure_rig;

/* An ellipse, in thousandths: its height, its half axes, and how far in front its middle is. */
struct figure_ring {
    int16_t y, half_x, half_z, z;
};

/* A tube from its lowest ring to its highest; joint k bends it around joint_y[k], `soft` up and down. */
struct figure_tube {
    const struct figure_ring *rings;
    uint32_t count;
    int16_t joints, joint_y[FIGURE_JOINTS], soft;
    bool is_upwards, has_toes; /* the way in which joints follow each other; the last one is in front */
    uint8_t rows_from, rows;   /* of the texture, of 128, from the top */
    uint8_t places, nodes[2];  /* first joint of each place that it is drawn at */
    const struct ph_xform *inverse_bind;
};

extern const struct figure_tube figure_tubes[FIGURE_TUBES];

/* ---- clips ------------------------------------------------------------------------------------------------------- */

#define FIGURE_MOMENTS 8
#define FIGURE_KEYS    (FIGURE_MOMENTS + FIGURE_MOMENTS / 2 + 1) /* the right side begins half a cycle later */
#define FIGURE_SWINGS  9
#define FIGURE_TRACKS  (2 * 6 + 3 + 1)

/* A clip of a cycle of two steps, which begins when the left heel touches the ground. All clips have one length, so
 * that a cross-fade between them keeps step. */
struct figure_gait {
    struct ph_clip clip;
    struct ph_track tracks[FIGURE_TRACKS];
    int16_t keys[FIGURE_SWINGS][FIGURE_KEYS][3][4];
};

/* which: 0 walks, 1 runs. The clip points into *gait. */
void figure_make_gait(struct figure_gait *gait, uint32_t which);

/* ---- meshes ------------------------------------------------------------------------------------------------------ */

/* How fine a tube is: its sides, and each ring or each second. */
struct figure_detail {
    uint8_t sides, every;
};

#define FIGURE_SIDES_MOST 31

#define FIGURE_RINGS_OF(count, every) (((count)-1) / (every) + 1)
#define FIGURE_RINGS_MOST(every)      FIGURE_RINGS_OF(FIGURE_BODY_RINGS, every)
#define FIGURE_RINGS(every)                                                                                            \
    (FIGURE_RINGS_MOST(every) + FIGURE_RINGS_OF(FIGURE_ARM_RINGS, every) + FIGURE_RINGS_OF(FIGURE_LEG_RINGS, every))
#define FIGURE_RINGS_DRAWN(every) (2 * FIGURE_RINGS(every) - FIGURE_RINGS_MOST(every))
#define FIGURE_GRID(sides, every) (2 * (sides) * (FIGURE_RINGS_MOST(every) - 1)) /* triangles */

/* Triangles between rings of sides + 1 vertices, from the lowest on. All tubes take as many of them as they have. */
bool figure_make_grid(struct demo_arena *arena, uint16_t (**grid)[3], struct figure_detail detail);

/* Makes the texture coordinates of a tube: u goes from the back over the left, v from the highest ring down. */
bool figure_make_uvs(struct demo_arena *arena, fx_t (**uvs)[2], const struct figure_tube *tube,
                     struct figure_detail detail);

/* A ring in the bind pose. */
struct figure_loop {
    int16_t positions[FIGURE_SIDES_MOST + 1][3], normals[FIGURE_SIDES_MOST + 1][3];
    struct ph_influence influences[FIGURE_SIDES_MOST + 1];
};

void figure_make_loop(struct figure_loop *loop, const struct figure_tube *tube, uint32_t ring,
                      struct figure_detail detail);

/* The tube's vertices as its joints are now; normals may be NULL. */
void figure_skin_tube(const struct figure_tube *tube, struct figure_detail detail, const struct ph_xform *joints,
                      struct fx_vec3 *positions, int16_t (*normals)[3]);

/* Makes the texture of a figure, of 32 x 128 texels >> down: rows 0 .. 71 of the body, 72 .. 99 of an arm, 100 .. 127
 * of a leg. */
int figure_make_texture(struct demo_arena *arena, struct ph_texture *texture, uint32_t down);

#endif
