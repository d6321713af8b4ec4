/*
 * memory_plan: who gets how many bytes of the memory that the runner (runner.h) is given.
 *
 *   picture   depth and bins of one band, the panel driver's scratch memory, and the band buffers
 *   scene     the list of a frame (vertices and references to triangles), the demo's arena, and scratch memory for a
 *             blur
 *
 * A scene that fits whole gets more slots for triangles that go on from band to band, as far as there is room; they
 * change the speed, not the picture.
 *
 * The plan is made in the sizes of a 32-bit target on every machine. So a board's simulator leaves out what the board
 * itself has to leave out, and the pictures are the same bytes. If a scene does not fit, its coarser levels (demo.h)
 * are tried; if the coarsest does not fit either, its list is cut, and the renderer counts the triangles that are lost.
 * Only a scene that fits whole gets memory for a blur.
 *
 * Where the backend keeps a queue (bus_queue) a demo gets as many band buffers as fit beside it, so that the next scene
 * is made while they are sent. A demo that hardly fits gets two.
 */
#ifndef MEMORY_PLAN_H
#define MEMORY_PLAN_H

#include "runner_config.h"

#define RUNNER_BANDS_MAX 16 /* band buffers */

/* Memory that this machine needs, whichever demo is selected; the fields for memory are not read. On a 32-bit machine
 * it is at most budget_bytes. */
size_t runner_bytes(const struct runner_config *config);

/* Memory that a 32-bit target needs to draw config->demo whole; with a budget_bytes below it parts are left out. */
uint64_t runner_whole_bytes(const struct runner_config *config);

/* ---- for runner.c ------------------------------------------------------------------------------- */

/* A picture's memory, in the order in which it is taken: depth, bins, wire, samples, buffers. Every machine needs the
 * same. */
struct picture_memory {
    uint16_t width, height, lines; /* of the picture; of a band */
    uint32_t bands, buffers;
    uint32_t depth_bytes, bin_bytes, wire_bytes, sample_bytes, band_bytes; /* multiples of 8 */
};

/* A scene's memory, which lies behind that of the picture: list of the frame, arena, scratch. Offsets and bytes are
 * this machine's. */
struct scene_memory {
    bool whole;            /* no triangle need be left out */
    bool lacks_scratch;    /* the demo wants scratch memory, and there is no room */
    uint32_t triangle_max; /* 0: not even the meshes fit */
    size_t list_bytes, arena_bytes, scratch_bytes;
    size_t arena_at, scratch_at; /* bytes from the start of the scene, where the list is */
    uint64_t bytes_32;           /* all of it on a 32-bit target */
};

struct memory_plan {
    struct picture_memory picture;
    struct scene_memory scene;
};

/* The picture in bands of `lines`, with two buffers. bands is 0 if there is no such picture. */
struct picture_memory memory_plan_picture(const struct runner_config *config, uint16_t lines);
uint64_t memory_plan_picture_bytes(const struct picture_memory *p);

struct memory_plan memory_plan(const struct runner_config *config, const struct demo *demo);
uint64_t memory_plan_bytes(const struct memory_plan *plan);

/* Whether the queue is of use: pixels go out straight from the band buffers, and the board wants more than two. */
bool memory_plan_has_queue(const struct runner_config *config);

#endif
