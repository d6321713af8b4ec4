/*
 * demo: scenes that run on every kit. A demo fills the renderer for one frame; its caller (a firmware image, the
 * simulator, a program on a single-board computer) then draws the bands.
 */
#ifndef DEMO_H
#define DEMO_H

#include "blur.h"
#include "render.h"

/* Memory for a demo's meshes, 8-byte aligned. It is given once; only scratch within one call is given back. */
struct demo_arena {
    uint8_t *base;
    size_t size, used;
};

/* Takes n bytes from an arena, 8-byte aligned; NULL: the arena is full. */
void *demo_alloc(struct demo_arena *arena, size_t n);

/* The parts of a demo's camera that a user may replace; all zeros: none. */
struct demo_camera {
    bool view_set;
    struct ph_xform view;
    bool projection_set;
    struct ph_projection projection;
};

/* A time of clips: whole seconds, 1/65536 of one, and 1/62500 of that, which is what a microsecond leaves. */
struct demo_clock {
    uint32_t seconds;
    uint16_t part, rest;
};

/* The time so many microseconds later. */
struct demo_clock demo_clock_after(struct demo_clock clock, uint32_t us);

/* What is behind a model, and what lights it, as on the turntable: y is up, and z points to the viewer. */
struct demo_studio {
    uint16_t background, has_lamp; /* wire order; 0 or 1: one lamp far away, in place of the two that there are else */
    struct fx_vec3 to_lamp_q30;    /* unit vector towards it, Q2.30 */
};

#define DEMO_CLIPS_BY_CLOCK UINT16_MAX /* in place of frames in a second */

/* What a demo is told and keeps. A caller sets arena, width and height; all else is zero at first. */
struct demo_context {
    struct demo_arena arena;
    void *state; /* the demo's own, from the arena */
    uint16_t width, height;
    struct demo_camera camera;
    const char *view; /* one of the demo's views; NULL: the first */
    uint32_t buttons; /* pressed during this frame, enum hal_button; see demo_input() */
    uint32_t orbit;   /* turn32 by which the camera is turned around the scene, counter-clockwise from above */
    int32_t tilt;     /* turn32 by which it is moved up over the scene, -1/4 .. 1/4 turn; see demo_orbit() */
    fx_t dolly;       /* share of its distance by which the camera is moved away, -DEMO_DOLLY_MAX .. DEMO_DOLLY_MAX */
    void *scratch;    /* demo_scratch_bytes(), 2-byte aligned; NULL: the demo does without it */
    size_t scratch_bytes;
    struct ph_blur blur;
    uint16_t clip_fps;       /* frames in a second of clips, 1 .. 1000; 0: 30; DEMO_CLIPS_BY_CLOCK: they run by clock */
    struct demo_clock clock; /* since the scene began */
    const char *clip;        /* the name of the clip that the select button has taken; NULL: none yet */
    uint32_t frame;          /* for band(), of a demo whose frame() sets it */
    const struct demo_studio *studio; /* of a model, set before its init; NULL: two lamps, DEMO_MODEL_BACKGROUND */
};

/*
 * Memory with which nothing is dropped. arena_bytes: what init takes at most on this machine; arena_bytes_32: the same
 * on a 32-bit target, or 0: what demo_arena_bytes_32() knows of it.
 */
struct demo_level {
    size_t arena_bytes;
    uint32_t arena_bytes_32;
    uint32_t vertex_max, triangle_max; /* of a whole frame: vertices of all meshes, triangles that can be seen */
    uint32_t corner_max;               /* corners that clipping and curves add, and all else in their place: 16 bytes */
    uint16_t enough_px;                /* up to this smaller side of the picture it is taken though a finer one fits */
};

/* A scene that runs on every kit. */
struct demo {
    const char *name;
    const char *summary;      /* one line for --list */
    const char *const *views; /* names of its views, NULL at the end; NULL: it has one view */
    uint32_t loop_frames;     /* the animation repeats after this many frames */
    size_t arena_bytes;       /* these five are a struct demo_level, the finest */
    uint32_t arena_bytes_32;
    uint32_t vertex_max, triangle_max, corner_max;
    const struct demo_level
        *coarser; /* levels for less memory or smaller pictures, or for pictures at most 16:9 wide; the finest first */
    uint32_t coarser_count;
    uint8_t blur_radius; /* px; not 0: the demo wants scratch memory */
    bool by_name_only;   /* the select button passes over it */

    /* Builds the demo's meshes. 0 or PH_ERR_NOMEM. */
    int (*init)(struct demo_context *context);

    /* ph_frame_begin and ph_draw_* for frame number `frame` (any value; the same one may come again, with other
     * buttons). Without blur_radius it may be called while the bands of the frame before are drawn: it changes no
     * material, texture or context that they use. */
    int (*frame)(struct demo_context *context, struct ph_renderer *r, uint32_t frame);

    /* Obeys the select button, for the next frame; false, or NULL: it takes the next demo. */
    bool (*select)(struct demo_context *context);

    /* Draws a band as ph_draw_band does; NULL: ph_draw_band. Call it through demo_draw_band(). */
    uint32_t (*band)(struct demo_context *context, struct ph_renderer *r, uint32_t band, uint16_t *pixels);
};

/* Draws a band with all that the demo does to it. Call it for all bands in order, after ph_frame_bands(). */
uint32_t demo_draw_band(const struct demo *demo, struct demo_context *context, struct ph_renderer *r, uint32_t band,
                        uint16_t *pixels);

/* Scratch memory that the demo wants for a picture of this width in bands of this height; most want 0. */
size_t demo_scratch_bytes(const struct demo *demo, uint16_t width, uint16_t band_height);

/* What a level of the demo (0: the finest) takes in its arena on a 32-bit target: its arena_bytes_32; for 0 what
 * arenas.inc says of a demo in demo_list; else, as on such a target itself, its arena_bytes. */
uint32_t demo_arena_bytes_32(const struct demo *demo, uint32_t level);

/* Whether the demo has a view of this name. */
bool demo_has_view(const struct demo *demo, const char *view);

/*
 * Moves the camera by the buttons (enum hal_button) that are pressed during this frame; call it once a frame, before
 * demo->frame. Left and right orbit, 256 frames a turn; up comes nearer, down goes away. These demos follow: turntable,
 * wireframe, ball, solar and snake (outside), shadow. In the snake's view from its head left and right steer it.
 */
#define DEMO_DOLLY_MAX FX_HALF
void demo_input(struct demo_context *context, uint32_t buttons);

/* The demos, in the order of the select button. */
extern const struct demo *const demo_list[];
extern const uint32_t demo_count;

/* Finds a demo by its name. NULL: there is none. */
const struct demo *demo_find(const char *name);

/* The build of an image defines its first demo: demo_turntable, or the demo_scene that pinhole-asset wrote. */
extern const struct demo *const demo_here;
extern const struct demo demo_scene;

/*
 * The turntable for any meshes, e.g. a loaded model. The meshes have their own materials and one coordinate system (y
 * up). They turn together about the vertical axis through `centre`, once in 256 frames. The camera looks down at 20
 * degrees from where everything just fits into the picture at every angle; it is calculated from all vertices.
 * Coordinates may be some thousandths to some thousands of units; a radius of about 1 is best.
 *
 * init uses the size in context, takes less than DEMO_TURNTABLE_BYTES of its arena, and sets context->state; the meshes
 * are not copied. Budgets: all vertices and DEMO_TURNTABLE_VERTICES; all triangles (5/8 of them for a closed mesh) and
 * DEMO_TURNTABLE_TRIANGLES for the platter below them. In an arena of
 * DEMO_TURNTABLE_BARE_BYTES there is no platter, and it needs no budgets.
 */
#define DEMO_TURNTABLE_BYTES      4096
#define DEMO_TURNTABLE_BARE_BYTES 256
#define DEMO_TURNTABLE_VERTICES   129
#define DEMO_TURNTABLE_TRIANGLES  132
int demo_turntable_init(struct demo_context *context, const struct ph_mesh *meshes, uint32_t mesh_count,
                        struct fx_vec3 centre);

/* demo_turntable_init for meshes that move around the origin, before a camera that has these points in the picture. */
int demo_turntable_around(struct demo_context *context, const struct ph_mesh *meshes, uint32_t mesh_count,
                          const struct fx_vec3 *points, uint32_t point_count);
int demo_turntable_frame(struct demo_context *context, struct ph_renderer *r, uint32_t frame);

/* What is not covered by the model, on the turntable or before an eye of its own, in wire order. */
#define DEMO_MODEL_BACKGROUND ph_rgb565(20, 26, 38)

/*
 * Any meshes, standing still, before an eye of their own, e.g. a model file's camera. The buttons move the eye around
 * the origin. lens is a perspective or an orthographic projection whose scales say what must at least be visible: half
 * its width and half its height (scale_x_q20 0: any width). init takes DEMO_STILL_BYTES at most.
 */
struct demo_eye {
    struct ph_xform view; /* world to view */
    struct ph_projection lens;
};

/* Shows meshes before an eye. demo_still_init: 0 or PH_ERR_NOMEM; demo_still_frame is a demo's frame(). */
#define DEMO_STILL_BYTES 512
int demo_still_init(struct demo_context *context, const struct ph_mesh *meshes, uint32_t mesh_count,
                    const struct demo_eye *eye);
int demo_still_frame(struct demo_context *context, struct ph_renderer *r, uint32_t frame);

#endif
