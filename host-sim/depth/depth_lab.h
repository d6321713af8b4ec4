/*
 * depth_lab: what the commands of pinhole-depth share. A command writes CSV to lab->rows; its first line is the names
 * of the columns. The program shows it as a table, or passes it on (--csv). Lines that start with '#' are remarks: they
 * stand below the table, with '#!' above it, and are no part of the CSV.
 */
#ifndef DEPTH_LAB_H
#define DEPTH_LAB_H

#include "camera.h"
#include "lab.h"
#include "option_camera.h"

#include <stdio.h>

#define DEPTH_AT_MAX   512
#define DEPTH_NEAR_MAX 4

struct depth_lab {
    fx_t near_z, far_z;     /* --near, --far: 0 < near_z < far_z */
    uint32_t formats;       /* --depth: bit i is row i of lab_formats */
    bool format_set;        /* --depth was given */
    uint32_t host_formats;  /* --depth: bit i is row i of depth_ieee_formats (pairs alone) */
    fx_t fov_deg;           /* --fov, vertical */
    uint16_t width, height; /* --size */
    const char *csv;        /* --csv: a file, "-", or NULL: a table for people */
    const char *json;       /* --json: a file, "-", or NULL */
    uint32_t count;         /* --count */
    uint8_t spacing;        /* --spacing, enum lab_spacing */
    fx_t at[DEPTH_AT_MAX];  /* --at */
    uint32_t at_count;      /* 0: not given */
    fx_t separation;        /* --separation, 0: not given */
    fx_t separate;          /* --separate, 0: not given */
    fx_t tilt_deg;          /* --tilt, -89 .. 89 */
    bool tilt_set;          /* --tilt was given */
    fx_t azimuth_deg;       /* --azimuth, -360 .. 360 */
    uint8_t shading;        /* --shading: a number in depth_shadings */
    bool far_set;           /* --far was given */
    bool near_set;          /* --near was given */
    uint8_t exponent;       /* bits of exponent of the float that is measured; 0: as many as the renderer takes */
    uint32_t bits;          /* --bits, 0: not given */
    const char *out;        /* --out: a file or directory, or NULL */
    const char *kind;       /* plot's KIND or compare's FILE, or NULL */
    const char *demo, *view, *model; /* advise: a scene; NULL: not given */
    bool allow_outside;              /* the model may name files outside of its folder */
    struct option_camera camera;
    bool fov_set; /* --fov was given */
    uint32_t start, frames;
    /* plot: all the near planes that --near names; near_z is the first */
    fx_t nears[DEPTH_NEAR_MAX];
    uint32_t near_count;
    FILE *rows; /* where the command writes; it is thrown away after an error */
};

/* The commands return 0, COMPLAINED or PH_ERR_INVAL. */
int depth_pairs(const struct depth_lab *lab);
int depth_resolve(const struct depth_lab *lab);
int depth_monotone(const struct depth_lab *lab);
int depth_advise(const struct depth_lab *lab);
int depth_anchors(const struct depth_lab *lab);
int depth_budget(const struct depth_lab *lab);
int depth_planes(const struct depth_lab *lab);
int depth_slopes(const struct depth_lab *lab);
int depth_scenes(const struct depth_lab *lab);
int depth_compare(const struct depth_lab *lab);
int depth_plot(const struct depth_lab *lab);
int depth_report(const struct depth_lab *lab); /* `all` */

/* The shadings that the lab draws in, by number, and their names: unlit, flat .. */
enum { DEPTH_SHADINGS = 5 };
extern const struct ph_shading *const depth_shadings[DEPTH_SHADINGS];
extern const char *const depth_shading_names[DEPTH_SHADINGS];

/* Gets the perspective of the lab's camera. 0, or PH_ERR_INVAL for an impossible one (the options are checked for
 * that). */
int depth_lab_projection(const struct depth_lab *lab, struct ph_projection *projection);

/* The lab for a row of lab_formats. */
struct depth_lab depth_lab_of(const struct depth_lab *lab, uint32_t row);

/* Shows that the formats before row i are done, of those that have a bit in `formats`. */
void depth_lab_progress(const char *what, uint32_t formats, uint32_t i);

/* Runs a command with its rows into memory and returns its status. *csv is a string to free(), also after an error. */
int depth_lab_capture(const struct depth_lab *lab, int (*run)(const struct depth_lab *), char **csv);

#endif
