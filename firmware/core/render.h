/*
 * render: meshes in, bands of RGB565 pixels out.
 *
 *   ph_renderer_init(r, config)                            once: size of the picture, memory
 *   ph_frame_begin(r, view, projection, light, background) camera, lights and background of this frame
 *   ph_draw_mesh(r, mesh, to_world) ...                    transforms, lights, culls, clips, lists triangles
 *   ph_frame_bands(r)                                      sorts the list into bands
 *   ph_draw_band(r, 0, pixels), ph_draw_band(r, 1, ..) ..  clears the bands from top to bottom, sets up their triangles
 *                                                          and rasterizes them
 *
 * A band is band_height lines of the picture; the last one may be shorter. The caller owns its colour and depth buffer
 * and all other memory (struct ph_config). The picture does not depend on the band height.
 *
 * Pixels: the centre of pixel (i, j) is at (i + .5, j + .5), and row 0 is at the top. Coverage follows the top-left
 * rule: a pixel is drawn when its centre is inside the triangle, on a left edge or on a top edge. So two triangles that
 * share an edge draw each of its pixels exactly once. Screen positions have 8 sub-pixel bits.
 *
 * Colour: RGB565 in wire order: on every machine the byte with red is the first in memory.
 * Light: each vertex has one white intensity (ambient, Lambert, Blinn; viewer at infinity). It indexes the material's
 * ramp, a table of 128 colours from dark to light.
 * Depth: larger is nearer, 0 is empty, see depth.h. Of two equal depths the one drawn first stays.
 *
 * Triangles that do not fit into the caller's budgets are left out and counted in ph_stats.
 *
 * After the opaque triangles of a band come cut-outs, then fog, then what is blended: see struct ph_blend.
 */
#ifndef PH_RENDER_H
#define PH_RENDER_H

#include "scene.h"
#include "status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- the renderer --------------------------------------------------------------------------------------- */

/* How a distance becomes the code that a pixel of the depth buffer holds. depth.h has the formulas. */
enum ph_depth_coding {
    PH_DEPTH_IS_FIXED,  /* N/w - N/f */
    PH_DEPTH_IS_FLOAT,  /* N/w - N/f as an unsigned floating-point number: 3 .. 6 bits of exponent, the rest mantissa */
    PH_DEPTH_IS_LINEAR, /* the distance itself; slow: a reciprocal per pixel. Orthographic: as FIXED */
};

struct ph_depth_ways;

/* A depth format: these names are addresses, and a program links what its own format needs, and nothing of the others.
 * PH_DEPTH_AUTO, which names two, takes for each frame what ph_depth_choose() says of its camera. */
struct ph_depth_format {
    const char *name;              /* that people write */
    uint8_t coding, bits, octaves; /* see PH_DEPTH_EACH; those of AUTO are what all formats have that it may take */
    bool is_small;
    const struct ph_depth_format *(*choose)(const struct ph_projection *projection); /* AUTO; NULL: the format itself */
    const struct ph_depth_ways *ways;                                                /* private to the renderer */
};

/* Names of formats; AUTO: the renderer chooses one by the camera of each frame. */
extern const struct ph_depth_format ph_depth_auto;
#define PH_DEPTH_AUTO     (&ph_depth_auto)
#define PH_DEPTH_FIXED16  (&ph_depth_fixed16)
#define PH_DEPTH_FLOAT16  (&ph_depth_float16)
#define PH_DEPTH_FIXED24  (&ph_depth_fixed24)
#define PH_DEPTH_FLOAT24  (&ph_depth_float24)
#define PH_DEPTH_LINEAR_W (&ph_depth_linear_w)

/*
 * The depth formats with all that tells them apart. Programs, tests and tables take them from here; a new format is a
 * row at the end, and a name above. depth.h says what each resolves.
 *   id       the end of the name of its struct
 *   coding   the end of a name of enum ph_depth_coding
 *   bits     of the code: 16 in a uint16_t, or 24 in the low bits of a uint32_t
 *   octaves  of a float that a plane of 32 bits may cross: with more, its far end would have too few bits
 *   small    whether small triangles are stepped in 32 bits at once (triangle.h); if not, all are drawn as large ones
 */
/* clang-format off */
#define PH_DEPTH_EACH(ROW) \
    /*  id          name        coding  bits octaves small */ \
    ROW(fixed16,    "fixed16",  FIXED,  16,  0,      true) \
    ROW(float16,    "float16",  FLOAT,  16,  4,      true) \
    ROW(fixed24,    "fixed24",  FIXED,  24,  0,      false) \
    ROW(float24,    "float24",  FLOAT,  24,  2,      false) \
    ROW(linear_w,   "linear-w", LINEAR, 16,  0,      false)
/* clang-format on */

/* Declares each of them. */
#define PH_DEPTH_DECLARED(id, name, coding, bits, octaves, small) extern const struct ph_depth_format ph_depth_##id;
PH_DEPTH_EACH(PH_DEPTH_DECLARED)

/* AUTO and all formats, for programs that take one by its name: whoever names this table links them all. */
#define PH_DEPTH_NUMBERED(id, name, coding, bits, octaves, small) PH_DEPTH_NUMBER_##id,
enum { PH_DEPTH_NUMBER_AUTO, PH_DEPTH_EACH(PH_DEPTH_NUMBERED) PH_DEPTH_FORMATS };
extern const struct ph_depth_format *const ph_depth_formats[PH_DEPTH_FORMATS];

/* Bytes of the depth buffer per pixel: 4 with codes of 24 bits, else 2. */
size_t ph_depth_bytes(const struct ph_depth_format *format);

/*
 * AUTO takes FIXED16 for an orthographic projection and where far <= PH_DEPTH_FIXED16_RATIO near, else FLOAT16. Up to a
 * ratio of 66.4 FIXED16 resolves 1/1000 of the distance everywhere, and it costs a little less.
 */
#define PH_DEPTH_FIXED16_RATIO 64
const struct ph_depth_format *ph_depth_choose(const struct ph_projection *projection);

/*
 * Bits of exponent with which a float resolves most where it resolves least: 3 for an orthographic projection and where
 * far <= PH_DEPTH_EXPONENT3_RATIO near, 4 where far <= PH_DEPTH_EXPONENT4_RATIO near, else 5. Every Q16.16 lens does
 * with 5. See depth.h.
 */
#define PH_DEPTH_EXPONENT3_RATIO 64
#define PH_DEPTH_EXPONENT4_RATIO 16384
unsigned ph_depth_choose_exponent(const struct ph_projection *projection);

/* Counts of a frame. */
struct ph_stats {
    uint32_t vertices;          /* transformed */
    uint32_t triangles_in;      /* of all meshes drawn */
    uint32_t triangles_culled;  /* of these: back faces, wholly outside, without area or without a pixel centre */
    uint32_t meshes_culled;     /* calls that looked at no vertex, because the bounds of the mesh are off the picture */
    uint32_t parts_culled;      /* parts of other meshes of which the same is true; triangles_culled counts theirs */
    uint32_t triangles_clipped; /* of these: crossed a clip plane */
    uint32_t triangles_drawn;   /* listed; a clipped or curved one may give several, a line counts as one */
    uint32_t triangles_dropped; /* left out: did not fit the budgets */
    uint32_t vertices_dropped;  /* of meshes left out: did not fit the budgets */
    uint32_t points_drawn;      /* listed */
    uint32_t fragments;         /* pixels depth-tested */
    const struct ph_depth_format *depth_format; /* of this frame, never AUTO */
    uint8_t depth_exponent; /* of this frame: bits of exponent of FLOAT16 and FLOAT24, 3 .. 6; 0 for the others */
};

/* How ph_show hands out pixels. */
enum ph_pixel_order {
    PH_PIXELS_WIRE,   /* RGB565, the high byte first: as SPI displays take them */
    PH_PIXELS_NATIVE, /* RGB565 as uint16_t of this machine: as LVGL and most drawing libraries have them */
    PH_PIXELS_RGB888, /* 3 bytes: red, green, blue; 31 of 5 bits and 63 of 6 bits become 255 */
};

/* Bytes of a pixel: 2, or 3 for PH_PIXELS_RGB888. */
size_t ph_pixel_bytes(unsigned order);

/* How two cores share the work: an address, for struct ph_config. */
struct ph_cores;
extern const struct ph_cores ph_two_cores;
#define PH_TWO_CORES (&ph_two_cores)

/* How an antialiased picture is made: an address, for struct ph_config. */
struct ph_antialiasing;
extern const struct ph_antialiasing ph_antialias_2x2;
#define PH_ANTIALIAS_2X2 (&ph_antialias_2x2)

/* How triangles that are hidden are passed over: an address, for struct ph_config. */
struct ph_occlusion;
extern const struct ph_occlusion ph_coarse_depth;
#define PH_COARSE_DEPTH (&ph_coarse_depth)

/* How meshes with colours for their vertices, and coloured light, are drawn: an address, for struct ph_config. */
struct ph_colouring;
extern const struct ph_colouring ph_colouring;
#define PH_COLOURS (&ph_colouring)

struct ph_vertex;   /* a transformed vertex, see vertex.h */
struct ph_triangle; /* a triangle set up for the rasterizer, see triangle.h */

/* Sizes for budgets: ph_vertex_bytes for each vertex, ph_triangle_bytes for each triangle. */
extern const size_t ph_vertex_bytes;
extern const size_t ph_triangle_bytes;
/* ph_vertex_bytes and ph_triangle_bytes where pointers have 32 bits, for budgets that are equal on every machine. */
#ifdef PH_PROFILE_SMALL
#define PH_VERTEX_BYTES_32 10
#define PH_PART_BYTES      88  /* of the triangle budget, for each part of a mesh: see render/small/small.h */
#define PH_CLIP_BYTES      520 /* ... and once a frame that has a mesh of which something may be clipped */
#else
#define PH_VERTEX_BYTES_32 16
#endif
#define PH_TRIANGLE_BYTES_32 24
/* What the triangle budget becomes: references of triangles that can be seen, vertices of further meshes and
 * corners that clipping makes, and slots for triangles that go on from band to band. Without slots a triangle is set up
 * again in each band. */
#define PH_REFERENCE_BYTES 8
#define PH_SLOT_BYTES_32   144
#define PH_OWN_BYTES       960 /* of the renderer's own, for scenes of few triangles */

/* What ph_renderer_init() is told: size of the picture, memory, options. */
struct ph_config {
    uint16_t width, height; /* 1 .. 1024 */
    uint16_t band_height;   /* 1 .. height */
    uint8_t pixel_order;    /* for ph_show: enum ph_pixel_order */
    uint8_t depth_exponent; /* FLOAT16 and FLOAT24: bits of exponent, 3 .. 6; 0: as ph_depth_choose_exponent() says */
    const struct ph_depth_format *depth_format; /* PH_DEPTH_...; without one ph_renderer_init() refuses */

    void *vertices; /* vertex budget: ph_vertex_bytes each; the largest mesh must fit. What all meshes of a frame need
                       beside it comes from the triangle budget; 4-byte aligned, 8 on 64 bits */
    uint32_t vertex_max;
    void *triangles; /* triangle budget: ph_triangle_bytes each; aligned as above. It may be `vertices`: then both share
                        that memory, ph_vertex_bytes for each of vertex_max, as they need it */
    uint32_t triangle_max;
    uint32_t *bins; /* heads of the bands' lists of triangles: (height + band_height - 1) / band_height of them */
    uint32_t bin_max;
    void *depth; /* width * band_height * ph_depth_bytes(depth_format), with `samples` 4 times as much; aligned to the
                    bytes of a pixel, with `samples` to 4 */

    /* Optional, all three or none: a second core, which takes half of the vertices, of the triangles to cull, light and
     * set up, and of the rows. other_core starts run on it and returns false if it is busy; other_core_join returns
     * when run has returned. The picture is the same, whichever core is faster. */
    bool (*other_core)(void (*run)(void *argument), void *argument);
    void (*other_core_join)(void);
    const struct ph_cores *cores; /* PH_TWO_CORES: a program links what shares work if it names this */

    /* Optional: PH_COARSE_DEPTH passes over large triangles (8 rows of a band and more) that lie behind others, without
     * a look at pixels. Draw the nearest first. The picture is the same. A program links it if it names it. */
    const struct ph_occlusion *occlusion;

    /* Optional: PH_COLOURS draws colours of vertices and coloured light. A program links them if it names it. */
    const struct ph_colouring *colouring;

    /* Optional, for ph_show. */
    void *pixels;    /* width * band_height * ph_pixel_bytes(pixel_order); aligned to 2 bytes */
    uint16_t *shown; /* width * height: what was shown last; with it only what changed is sent. Or NULL */

    /* Antialiasing, optional, both or none: room for 4 * width * band_height pixels, 4-byte aligned. Then a pixel is
     * the mean of 2 x 2 samples, depth has 4 times the room as well, and width and height are at most 512. Lower bands
     * make up for the memory. A band without anything in it leaves the samples as they were. */
    uint16_t *samples;
    const struct ph_antialiasing *antialiasing; /* PH_ANTIALIAS_2X2: a program links it if it names it */
};

#ifndef PH_PROFILE_SMALL
/*
 * Memory of a renderer as a constant, in words of 64 bits, for an array that ph_config_memory() shares out:
 *   static uint64_t memory[PH_MEMORY(320, 16, 64, 128)];
 * 320 pixels wide, bands of 16 lines, vertex_max 64, triangle_max 128; depth of 16 bits and pixels of RGB565, and bins
 * for a picture of any height. Depth of 24 bits takes width * lines / 4 words more, PH_PIXELS_RGB888 half as many.
 */
#define PH_MEMORY(width, lines, vertices, triangles)                                                                   \
    (((size_t)(vertices)*PH_VERTEX_BYTES_32 + (size_t)(triangles)*PH_TRIANGLE_BYTES_32 +                               \
      (1023 + (size_t)(lines)) / (size_t)(lines) * sizeof(uint32_t) +                                                  \
      (size_t)(width) * (size_t)(lines)*2 * sizeof(uint16_t) + sizeof(uint64_t) - 1) /                                 \
     sizeof(uint64_t))

/*
 * Gives a config its vertices, triangles, bins, depth and pixels from one piece of memory, which must stay as long as
 * the renderer is used. width, height, band_height, depth_format, pixel_order, vertex_max and triangle_max say how
 * much. Errors: PH_ERR_INVAL: config or memory is NULL, band_height is 0, or antialiasing is asked for. PH_ERR_FORMAT:
 * no depth format is named. PH_ERR_NOMEM: it takes more than `bytes`. The config stays as it was.
 */
int ph_config_memory(struct ph_config *config, uint64_t *memory, size_t bytes);
#endif

/* Fog: from `start` on all colours turn towards the fog's, and from `end` on they have become it. Distances are along
 * the view (fisheye: from the eye), Q16.16, start < end. The background is not fogged: give it the same colour. */
struct ph_fog {
    uint16_t colour; /* wire order */
    fx_t start, end;
};

/* How linear-w turns 1/w into a code, see depth.h. The unit of w puts the far plane just below 2^31. */
struct ph_linear {
    uint32_t far;   /* w at the far plane */
    uint32_t scale; /* 1 / (far - near), normalised, less the head room */
    uint8_t up;     /* leading zeros of far - near */
    uint8_t bias;   /* codes */
    int8_t down;    /* right shift of the reciprocal of 1/w to the unit of w, before the reciprocal's own shift */
};

/*
 * The camera of a frame in the form that vertices need: screen x = centre_x + 2^focal_log2 x' / w, where x' is row 0 of
 * the clip matrix. Private to the renderer.
 */
struct ph_lens {
    uint8_t kind;               /* enum ph_projection_kind */
    int8_t focal_log2;          /* 0 .. 18 */
    uint8_t guard_up;           /* the guard band is |x'| 2^guard_up <= 8 w */
    int8_t near_shift;          /* depth_scale is N 2^this; orthographic: leading zeros of far - near */
    int32_t focal_x, focal_y;   /* focal length in pixels / 2^focal_log2, Q2.30 */
    int32_t centre_x, centre_y; /* principal point, 1/256 px */
    fx_t near_z, far_z;
    uint32_t depth_scale; /* perspective: N of depth.h, normalised; orthographic: 1 / (far - near), normalised */
    uint32_t far_q;       /* depth quotient at the far plane, see depth.h */
    int8_t far_s;         /* negative in the fixed formats only; floats read the next byte with it */
    uint8_t float_down;   /* bits of exponent of FLOAT16 and FLOAT24, less 1; 3 for the other formats */
    struct ph_linear linear;
#ifndef PH_PROFILE_SMALL
    int32_t radian_px;             /* fisheye: pixels per radian, 16.16 */
    uint32_t chord_min2;           /* fisheye: (1/256 px)^2; shorter edges are not divided */
    int32_t chord_max;             /* fisheye: 1/256 px; longer edges are always divided */
    uint32_t near_over, far_over;  /* fisheye: 1 / near_z, 1 / far_z, normalised */
    int16_t near_zeros, far_zeros; /* their leading zeros */
#endif
};

/* Where the list of a frame stands, see list.h. Private to the renderer. */
struct ph_ref;
#define PH_LIST_COPIES 4 /* materials that draws by turns share: an equal one is looked for among so many */

/* The display list of a frame. */
struct ph_list {
    struct ph_ref *top, *to, *end;   /* references go down from top; the last one is at `to`; there is room until end */
    uint32_t used[3];                /* bytes taken from own, vertices, triangles */
    uint32_t first, last, lens;      /* places of the first and the last draw, and of the camera in use */
    uint32_t copies[PH_LIST_COPIES]; /* places of the last copies of materials, the newest first, then PH_NONE */
    uint32_t band_scale;             /* 2^20 / band_height, rounded up */
    uint16_t stage; /* 0: closed, because no frame has begun, or its bands are made; 1: open; 2: full */
    uint16_t band;  /* the band that is drawn next */
};

struct ph_lines;
struct ph_pointing;
struct ph_fogging;

#ifdef PH_PROFILE_SMALL
/* The state of one picture in the small profile: see render/small/small.h. Callers read stats; all else is private.
 * Some members have the names that they have below, because files of render/ are shared. */
struct ph_curved_lens;
struct ph_renderer {
    struct {
        uint16_t width, height, band_height;
        union {
            void *depth;
            bool (*other_core)(void (*run)(void *argument), void *argument); /* never called, and so is the next */
            void (*other_core_join)(void);
        };
    } config;
    struct ph_stats stats;
    struct ph_lens lens;
    struct {
        const struct ph_curved_lens *curved; /* NULL */
    } projection;
    union {
        __extension__ struct {
            struct ph_xform view;
            struct ph_scene_light light;
        };                      /* while meshes are drawn */
        uintptr_t triangle[36]; /* while bands are drawn: the struct ph_triangle that is set up */
    };
    uint8_t *vertices, *vertices_end; /* where the next vertices go; NULL: they end where parts begin */
    uint8_t *parts;                   /* down to where parts have been taken */
    struct ph_small_part *first, *last;
    void *clip; /* room to clip in, or NULL */
    uint32_t vertex_max;
    void *room[2];       /* as in struct ph_config: vertices and triangles */
    uint32_t room_bytes; /* of the triangles */
    uint16_t background, band, band_count;
    uint8_t state;
};
#else
/* The state of one picture. Callers read stats; all other fields are private. Between ph_frame_bands and the last band
 * it must not be moved. */
struct ph_renderer {
    struct ph_list list;
    struct ph_config config;   /* with samples its sizes count samples: width, height and band_height are doubled */
    uint32_t inner_x, inner_y; /* 1/256 px: a small triangle whose first corner is within lies inside the picture */
    struct ph_triangle *carried, *slots; /* triangles that continue in the next band; slots that are unused again */
    struct ph_triangle *ahead;           /* triangles of the next band that two cores have set up already, or NULL */
    uint32_t slots_used[2];              /* bytes behind list.used of vertices and triangles that are slots */
    struct ph_stats stats;
    struct ph_lens lens;
    uint32_t band_count;
    uint16_t background;
    uint8_t samples_log2;             /* 1 with samples, else 0: log2 of samples a pixel each way */
    bool is_shown;                    /* config.shown holds what the display shows */
    const struct ph_blending *after;  /* draws what comes after the opaque; or NULL */
    uint32_t rows_place, rows;        /* rows of pixels that blended triangles are drawn into */
    const struct ph_fogging *fog;     /* fogs bands; or NULL */
    const struct ph_lines *lines;     /* sets up lines, if there are any: see line.h */
    const struct ph_pointing *points; /* draws points, or NULL: see points.h */
    uint32_t clouds, last_cloud;      /* places of the first and the last struct ph_cloud */
    struct ph_projection projection;  /* as given; lens is made from it */
    struct ph_xform view;             /* world to view */
    uint32_t view_norm;               /* for bounds.c: by how much view can make a vector longer; 0: not known yet */
    struct ph_scene_light light;
    struct ph_fog fog_of;
    uint32_t fog_codes[32];         /* the depth code at which fog gets its share 1/32, 2/32 .. of the colour */
    uint64_t own[PH_OWN_BYTES / 8]; /* last, so that the other members are near the address of the struct */
};
#endif

/*
 * Initialises r with a copy of config.
 * Errors: PH_ERR_INVAL: a size, a pointer or its alignment is wrong, other_core lacks its other_core_join or cores, or
 *         samples lacks antialiasing. PH_ERR_FORMAT: no depth format is named. PH_ERR_NOMEM: bin_max is below the
 * number of bands. After an error r refuses all calls but this one.
 */
int ph_renderer_init(struct ph_renderer *r, const struct ph_config *config);

/*
 * Starts a frame: clears the list of triangles and the statistics, and chooses the depth format if it is AUTO.
 * In:     view is world to view and must be rigid. light may be NULL: full ambient light. background is in wire order.
 *         It may be called at any time, and begins anew, however far the frame before has come.
 * Errors: PH_ERR_INVAL: near_z <= 0 (perspective, fisheye) or far_z <= near_z; view or projection is NULL.
 *         PH_ERR_RANGE: the principal point is more than the picture's width or height off the centre (|shift| > 2), or
 *         the focal length is 2^18 pixels or more.
 *         PH_ERR_STATE: r is not initialised. After an error no frame has begun: nothing is drawn, and functions that
 *         draw or show return PH_ERR_STATE.
 */
int ph_frame_begin(struct ph_renderer *r, const struct ph_xform *view, const struct ph_projection *projection,
                   const struct ph_scene_light *light, uint16_t background);

/*
 * Sets another camera for all that is drawn from now on in the same frame, for several views in one picture. The views
 * share the depth buffer and its format, so they should not draw on the same pixels. Errors are those of
 * ph_frame_begin; the camera then stays as it was. PH_ERR_STATE: no frame has begun, or its bands are made.
 */
int ph_frame_camera(struct ph_renderer *r, const struct ph_xform *view, const struct ph_projection *projection);

/*
 * Sets the fog of this frame, in steps of 1/32 of the way between two colours. Call it after ph_frame_begin; it takes
 * the camera of that moment. It costs a pass over all pixels of a band: on a Cortex-M0+ 5 instructions for an empty one
 * and 16 for another (tests/bench/blends.sh).
 * Errors: PH_ERR_INVAL: fog is NULL, or start >= end. PH_ERR_STATE: no frame has begun, or its bands are made.
 */
int ph_frame_fog(struct ph_renderer *r, const struct ph_fog *fog);

/*
 * Draws a mesh. to_world places it: a rigid transform with a uniform scale below 2.
 * Errors: PH_ERR_INVAL: to_world is NULL, or so is something that a count of the mesh says is there; or the mesh has
 *         colours, and the config no PH_COLOURS. Built with
 *         -DPH_CHECKED also: a triangle or an edge names a vertex, or a part triangles or a material, that are not
 *         there, a texture has no texels or a side beyond 2^PH_TEXTURE_LOG2_MAX, or a corner lies outside of the
 *         bounds. Nothing is drawn. ph_check_mesh() of status.h says which of these it is.
 *         PH_ERR_NOMEM: the mesh has more vertices than the vertex budget; it is left out and counted. (If other meshes
 *         have taken the room, it is counted, too, but that is no error. A mesh whose bounds are off the picture needs
 *         none.) PH_ERR_STATE: no frame has begun, or its bands are made; nothing is drawn.
 */
int ph_draw_mesh(struct ph_renderer *r, const struct ph_mesh *mesh, const struct ph_xform *to_world);

/*
 * A sprite in the world: draws a rectangle that faces the camera, with its middle at a world point, with the
 * material's texture or colour; with material->blend it may have any outline. Sizes are Q16.16 in world units: with one
 * of 0 nothing is drawn, and a negative one mirrors it, so that it is seen from behind. Errors as ph_draw_mesh: it
 * takes 4 vertices.
 */
int ph_draw_billboard(struct ph_renderer *r, struct fx_vec3 centre, fx_t width, fx_t height,
                      const struct ph_material *material);

/*
 * Draws a line one pixel wide between two world points in the material's colour. It counts as one triangle.
 *
 * Its longer axis on the screen is x or y, x if both are as long. It has one pixel in each column (or row) whose centre
 * lies between its ends, the left (upper) end included, the other not: the pixel that it runs through there. Where it
 * runs along the border of two pixels, it takes the upper (left) one. So lines that share an end draw no column twice.
 *
 * Errors: PH_ERR_STATE: no frame has begun, or its bands are made. PH_ERR_INVAL: material is NULL. Nothing is drawn.
 */
int ph_draw_line(struct ph_renderer *r, struct fx_vec3 a, struct fx_vec3 b, const struct ph_material *material);

/*
 * Draws points in the material's colour, or in their own. Only colour, blend and depth_bias of the material count.
 *
 * A square has the pixels whose centres lie inside it, on its left side or on its upper side; a disc has those whose
 * centres lie inside its circle. On the picture a point is never smaller than 1 px, so that none is lost between
 * centres, nor larger than 255 px; a disc of less than 1.5 px is a square. Positions are rounded to 1/256 px, sizes of
 * squares to 1/128 px, and those of discs to 1/8 px. All of a point has the depth of its middle. It is left out if that
 * lies before the near plane or behind the far plane, or outside the guard band, which is farther off than any point
 * is large.
 *
 * Opaque points come after the triangles and lines of the frame, in the order of the calls. Of equal depths what was
 * there first stays. With a blend they are drawn where their call comes among the other draws with a blend. KEY and
 * MASK look at texels, which a point has not: it is opaque then.
 *
 * Cost: a vertex of memory for each point, and one for each 8 rows of the picture; nothing if no point can be seen. A
 * point of 1 px takes some 300 instructions on a Cortex-M0+ and 145 on an M3, of which 220 and 82 are its vertex; a
 * blended one 460 and 250; a disc of 2 px 810 and 500 (tests/bench/growth.sh). Errors: PH_ERR_INVAL:
 * points, to_world or material is NULL, or so are the positions of one or more points; or there are more than
 * PH_POINTS_MAX. PH_ERR_NOMEM: there are more points than the vertex budget; they are left out and counted as vertices.
 * (If other draws have taken the room, they are counted, too, but that is no error.) PH_ERR_STATE: no frame has begun,
 * or its bands are made; nothing is drawn.
 */
int ph_draw_points(struct ph_renderer *r, const struct ph_points *points, const struct ph_xform *to_world,
                   const struct ph_material *material);

/* A rectangle of the picture: its upper left pixel and its size. */
struct ph_rectangle {
    uint16_t x, y, width, height;
};

/*
 * The smallest rectangle that holds the corners of all that the frame has listed so far; with points the whole picture.
 * All outside of it will have the background's colour, so a display need be sent no more than this rectangle and that
 * of the frame before. Call it before ph_frame_bands. Cost: it looks at each listed triangle's corners.
 * Returns false, and a box of size 0, if nothing was listed, or no frame has begun, or its bands are made.
 */
bool ph_frame_box(const struct ph_renderer *r, struct ph_rectangle *box);

/* Sorts the triangles into bands, after which no more can be drawn. Returns the number of bands; 0 if no frame has
 * begun, or its bands are made already. */
uint32_t ph_frame_bands(struct ph_renderer *r);

/*
 * Clears and draws band number `band`. Call it for all bands in order from 0, the top, each once. pixels has room for
 * width * band_height pixels in wire order. Returns the number of lines; 0, with nothing written, for a band out of
 * turn, or pixels that are NULL or at an odd address.
 */
uint32_t ph_draw_band(struct ph_renderer *r, uint32_t band, uint16_t *pixels);

/* Takes a rectangle of the picture. Its pixels lie row behind row, in config.pixel_order, and may change after the
 * return. Returns 0, or any other number to stop the frame. */
typedef int ph_flush(void *context, uint32_t x, uint32_t y, uint32_t width, uint32_t height, const void *pixels);

/*
 * Shows the frame: sorts, draws every band and gives it to flush. This is ph_frame_bands and ph_draw_band in one call.
 * With config.shown only the smallest rectangle that holds a band's changes is given, and nothing of a band that is as
 * it was; the first frame, and the one after a frame that was stopped, are given whole.
 * Errors: PH_ERR_INVAL: flush is NULL, or config.pixels or config.pixel_order is wrong. PH_ERR_STATE: no frame has
 * begun, or it was shown already, perhaps in part: flush is not called. Else what flush returned.
 */
int ph_show(struct ph_renderer *r, ph_flush *flush, void *context);

/* Draws over a band before it is handed out: text and pictures of overlay.h, or anything else. It is called for each
 * band from the top, with the same context as the flush. */
struct ph_overlay_band;
typedef void ph_paint(void *context, const struct ph_overlay_band *band);

/* Shows the frame as ph_show() does, with what paint draws over it; NULL: nothing. Not in the small profile. */
int ph_show_painted(struct ph_renderer *r, ph_flush *flush, void *context, ph_paint *paint);

/* ---- colours ---------------------------------------------------------------------------------------------- */

/* RGB 0 .. 255 to RGB565 in wire order. */
uint16_t ph_rgb565(uint8_t red, uint8_t green, uint8_t blue);

/*
 * Fills the ramp of a material. An intensity of 0 .. 1 scales the colour (red, green, blue); from 1 to 1 + specular the
 * colour fades to white. Each colour is rounded to nearest.
 */
void ph_material_ramp(uint16_t ramp[PH_RAMP_SIZE], uint8_t red, uint8_t green, uint8_t blue, fx_t specular);

/* ---- light without bands ------------------------------------------------------------------------------------ */

/*
 * RGB565 has 32 steps of red and of blue. Where light changes slowly, each step is a band that the eye sees: slow
 * gradients are 1.2 to 1.7 off (RMS, CIE76 after a blur of 1 pixel), and in places over 2.3, which is called
 * noticeable. In dithered light neighbouring pixels round the same colour differently, so that their mean is right: it
 * is .3 to .5 off, and nowhere 2.3 (tests/core/test_dither.c).
 *
 * What is dithered: PH_SHADE_GOURAUD with a ramp that ph_material_ramp() has made, in depth of 16 bits but linear-w.
 * All else is as without: FLAT, textures, colours of vertices, coloured light, other ramps, depth of 24 bits. An
 * antialiased picture cannot be dithered, and the small profile has no dither.
 *
 * How: pixel (x, y) has step k = (3 x + 7 y) mod 8 of an ordered dither, whose thresholds lie on a lattice that is tied
 * to the screen. So a frame that stands still has pixels that stand still, and neither bands nor cores change a byte. A
 * ramp becomes 8, one behind the other, each of which rounds at the threshold of its step. The plane of light has k in
 * its top 3 bits, above the entry of the ramp. k is linear in x and y modulo 8 as planes are modulo 2^32, so a pixel
 * takes no instruction more.
 *
 *   static struct ph_dithered_ramp ramps[3];
 *   static struct ph_dither dither = {.ramps = ramps, .ramp_max = 3};
 *   ph_renderer_init(&r, &config);
 *   ph_dither(&r, &dither);
 */
#define PH_DITHER_STEPS 8

/* The ramps of all steps; those of step 0 are the material's own colours. Private. */
struct ph_dithered_ramp {
    const uint16_t *ramp; /* the material's; NULL: none yet */
    uint32_t frame;       /* the last one that had it */
    uint16_t colours[PH_DITHER_STEPS * PH_RAMP_SIZE];
};

/* The caller sets ramps and ramp_max; all else begins as zeros. */
struct ph_dither {
    uintptr_t calls[5];             /* private */
    struct ph_dithered_ramp *ramps; /* room for dithered ramps, which begins as zeros */
    uint32_t ramp_max;              /* so many: one for each ramp that a frame has in GOURAUD */
    uint32_t left_out;              /* materials of the last frame that are not dithered: there was no room */
    uint32_t frame;                 /* private */
};

/*
 * Dithers the frames that r draws from now on. Call it between two frames.
 * In:     dither and its ramps must stay as long as r uses them. NULL: dithers no more.
 * Cost:   2,056 bytes a ramp. On a Cortex-M0+ some 35 instructions a triangle (20 on an M3), 1,500 a ramp and frame,
 *         and some 300,000 at the first sight of a ramp or of new colours in it: 1 to 3 % of a frame
 *         (tests/bench/long_dither.sh). A program without it links nothing of it.
 * Errors: PH_ERR_INVAL: r is NULL or antialiases, or dither has no ramps. r stays as it was.
 */
int ph_dither(struct ph_renderer *r, struct ph_dither *dither);

#ifdef __cplusplus
}
#endif

#endif
