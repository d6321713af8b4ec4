/*
 * sim_options: the command line of pinhole-sim. Every number is read strictly. Fixed-point numbers are read by
 * fx_from_text(), so that a camera means the same bits on every machine.
 */
#ifndef SIM_OPTIONS_H
#define SIM_OPTIONS_H

#include "asset_fit.h"
#include "camera.h"
#include "option_camera.h"
#include "option_text.h"
#include "sim_matrix.h"

#include <stdbool.h>
#include <stdint.h>

enum option_action { OPTION_RUN, OPTION_LIST, OPTION_HELP };
enum option_projection { OPTION_PERSPECTIVE, OPTION_FRUSTUM, OPTION_ORTHO, OPTION_FISHEYE };

struct sim_options {
    enum option_action action;
    const char *demo;  /* NULL: none asked for */
    const char *view;  /* of the demo, or NULL */
    const char *model; /* path of a model file, or NULL */
    const char *clip;  /* of the model; NULL: its first */
    uint32_t clip_fps; /* 0: not given */
    struct model_options model_options;
    struct asset_goal goal; /* how far it is simplified */
    bool goal_set;          /* else the board's memory is the goal */
    const char *board;      /* NULL: none asked for */
    uint16_t width, height; /* --size, 0: not given */
    uint32_t start, frames; /* frames: UINT32_MAX for a window that only its user closes */
    const char *keys;       /* path of a script of presses, or NULL */
    const char *out;        /* directory, FILE.ppm, .png or .gif, "-", or NULL */
    uint32_t scale;         /* 0: not given */
    const char *check;      /* see frame_check.h, or NULL */
    const char *difference; /* FILE.png, or NULL */
    uint32_t tolerance;     /* 0 .. 255 */
    bool rotate_set;        /* else as the board is usually held */
    uint8_t rotate;         /* quarter turns, 0 .. 3 */
    uint32_t band;          /* lines, 0: the board's own */
    struct option_depth depth;
    uint8_t convention; /* enum ph_convention */
    const char *show;   /* "depth", or NULL: the picture */
    bool crc, stats, json, overlay, antialias, dither, matrix, show_window;
    bool factors; /* --matrix factors */
    bool anyway;  /* draws matrices that are no camera */
    bool point_set, object_set;
    struct fx_vec3 point;   /* --point, in the object's coordinates */
    struct ph_xform object; /* --object: where it stands */
    fx_t frustum_z;         /* --frustum: a distance; 0: not given */
    fx_t frustum_height;    /* 0: not given */
    fx_t focus;             /* --focus: a distance; 0: not given */
    fx_t focus_strength;    /* below 0: not given */
    bool parent_set;
    uint32_t parent; /* number of a mesh of the frame */

    struct option_camera camera;
    bool view_matrix_set, lens_matrix_set;
    struct sim_matrix view_matrix, lens_matrix; /* in the convention */
    const char *flatten;                        /* --flatten; NULL: not given */
    struct ph_mat4 flat;

    bool projection_set; /* any of the following was given */
    enum option_projection projection;
    bool window_set;
    fx_t window[4];              /* left, right, bottom, top: at the near plane (frustum), of the volume (ortho) */
    fx_t fov_deg, near_z, far_z; /* fov_deg 0: not given; the planes are distances in every convention */
    bool near_set, far_set;      /* was given */
    fx_t focal, image_height;    /* of a pinhole camera; focal 0: not given, below 0: the image is behind the hole */
};

/* Reads the command line into *o. 0 or PH_ERR_INVAL. */
int sim_options_read(struct sim_options *o, int argc, char *const argv[]);

/* Prints what --help prints. */
void sim_options_help(void);

/*
 * The projection that was asked for, on a picture of width x height pixels. The volume of an orthographic one without
 * a window is as high as the field of view is at the camera's target (3 units away without --camera).
 * 0, or PH_ERR_INVAL for an impossible one.
 */
int sim_options_projection(const struct sim_options *o, uint16_t width, uint16_t height, struct ph_projection *p);

#endif
