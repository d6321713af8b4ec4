/*
 * asset: a model as const data for the flash of a microcontroller kit (pinhole-asset).
 *
 *   asset_make(&asset, model, &limits)     simplifies, orders, shrinks textures
 *   asset_measure(&asset, board)           how long the renderer's list of triangles becomes on that board
 *   asset_demo(&asset)                     the demo that the written file defines
 *   asset_write(file, &asset)              that file, in C
 *   asset_scene(&asset, bytes)             the same as a binary scene
 */
#ifndef ASSET_H
#define ASSET_H

#include "board.h"
#include "model.h"

#include <stdio.h>

#define ASSET_NAME_BYTES 40

struct asset_limits {
    uint32_t triangles;    /* UINT32_MAX: all */
    uint8_t texture_log2;  /* longest side of a texture */
    bool is_on_turntable;  /* also where the file has a camera */
    bool is_bare;          /* without the platter below it */
    const char *file_name; /* of the model, for its name */
};

struct asset {
    struct model model;            /* what is written */
    struct ph_material *materials; /* one a mesh */
    uint32_t *first_ramps;         /* for each mesh the first one that has the same ramp */
    void *memory;
    char name[ASSET_NAME_BYTES]; /* of the file: letters, digits, - and _ */
    bool is_bare;
    uint32_t triangles_read, vertices_read;
    bool is_simplified;
    double error; /* by how much simplification moved the surface, at most and about, in radii of the model */
    double off;   /* the share of its pixels that look different, of asset_compare(); 0: not looked at */
    double fetched_read, fetched; /* vertices per triangle that are not among the 16 used last, before and after */
    uint32_t listed;              /* triangles of a frame at most, of what asset_measure() looked at */
};

/* Makes an asset of a model. 0 or COMPLAINED. More triangles than asked for remain where a model cannot be simplified
 * that far. */
int asset_make(struct asset *asset, const struct model *model, const struct asset_limits *limits);
void asset_free(struct asset *asset);

/* Draws the scene from many sides, and from as near and as far as the buttons lead. asset->listed becomes the length of
 * the longest list of triangles, plus a sixteenth. 0 or COMPLAINED. */
int asset_measure(struct asset *asset, const struct board *board);

/* Returns the first board whose glass has the size of board number `board`: the list is as long there. */
uint32_t asset_first_glass(uint32_t board);

/* The asset as a demo, whose context->state must be &asset->model. */
struct demo asset_demo(const struct asset *asset);

/* The memory that the board needs to draw the whole scene, as C or as a binary scene, whose tables lie in RAM; and for
 * its bands alone; see runner_whole_bytes(). */
uint64_t asset_frame_bytes(const struct asset *asset, const struct board *board, bool is_binary);
uint64_t asset_band_bytes(const struct board *board);

/* Memory that a binary scene takes beside that of asset_demo(), here or on a 32-bit target. */
size_t asset_table_bytes(const struct asset *asset, bool on_32);

/* Bytes of flash on a 32-bit target. */
struct asset_sizes {
    uint64_t positions, normals, uvs, colours, triangles, tables; /* tables: meshes, materials, ramps, the demo */
    uint64_t textures;                                            /* and alphas */
    uint64_t motion;                                              /* clips, skins and morph targets */
};

struct asset_sizes asset_sizes(const struct asset *asset);
uint64_t asset_flash_bytes(const struct asset *asset);

/* Bytes of the asset's textures if no side were longer than 2^log2_max. */
uint64_t asset_texture_bytes(const struct asset *asset, uint8_t log2_max);

/* Returns the first mesh that has the same texture or blend. */
uint32_t asset_first_texture(const struct model *model, uint32_t mesh);
uint32_t asset_first_blend(const struct model *model, uint32_t mesh);

/* Returns the first mesh that moves with the same skin as number i of them. */
uint32_t asset_first_skin(const struct animation *animation, uint32_t i);

/* Returns the first track of a clip that shares its times with number i of them. */
uint32_t asset_first_times(const struct ph_clip *clip, uint32_t i);

/* How many numbers a track's keys have. */
size_t asset_key_numbers(const struct ph_track *track);

/* Bytes of flash of what moves, beside the positions and normals of its meshes. */
uint64_t asset_motion_bytes(const struct model *model);

/* Writes the C file; the same asset gives the same bytes. Errors stay in the stream. */
void asset_write(FILE *file, const struct asset *asset);

/* Writes the binary scene (scene_file.h), of at most SCENE_FILE_MESHES meshes, into bytes; NULL: only counts. Returns
 * how many bytes it has. */
size_t asset_scene(const struct asset *asset, uint8_t *bytes);

/* Prints the need of flash, and of memory on one board or (NULL) on all. 0 or COMPLAINED. */
int asset_report(FILE *file, const struct asset *asset, const struct board *board);

#endif
