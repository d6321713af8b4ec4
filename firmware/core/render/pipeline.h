/*
 * pipeline: what the stages of the renderer hand to each other. Private to firmware/core.
 *
 *   frame.c   the camera of a frame as a lens, the bands' lists
 *   mesh.c    vertices: transform, project, clip codes; triangles: reject, cull, light, hand on
 *   light.c   intensity of a vertex
 *   clip.c    the few that meet a clip plane
 *   fisheye.c what curves under a fisheye, divided
 *   setup.c   edges and planes of a triangle, into the list
 *   raster.c  bands: clears, their triangles in order, rows of these
 *   texture.c rows of textured triangles, in tiles
 *
 * Around them: depth.h (depth codes), edge.h (edges of a triangle), span.h (pixels of a row), and kernels.h, the loops
 * in which the time goes: those are in files of their own, of which a CPU may have another form.
 */
#ifndef PH_PIPELINE_H
#define PH_PIPELINE_H

#include "depth.h"
#include "render.h"

/* Clip codes. LEFT .. FAR: outside that plane (all three: reject). GUARD: outside the guard band. */
enum {
    PH_LEFT = 1,
    PH_RIGHT = 2,
    PH_TOP = 4,
    PH_BOTTOM = 8,
    PH_NEAR = 16,
    PH_FAR = 32,
    PH_GUARD = 64,
    PH_LIT = 128, /* light is there */
    PH_REJECT = PH_LEFT | PH_RIGHT | PH_TOP | PH_BOTTOM | PH_NEAR | PH_FAR,
    PH_CLIP = PH_NEAR | PH_FAR | PH_GUARD,
};

/* 16 bytes: the index of one is a shift. */
struct ph_vertex {
    int32_t x, y; /* 1/256 px; not set where code has NEAR or GUARD */
    uint32_t q;   /* depth: struct ph_quotient */
    int8_t s;
    uint8_t code;
    uint16_t light; /* 0 .. 65535, entry of the ramp times 512 */
};

static inline void ph_vertex_depth(struct ph_vertex *v, struct ph_quotient depth)
{
    v->q = depth.q;
    v->s = depth.s;
}

/* Before the divide: screen x = centre + 2^focal_log2 x / w. */
struct ph_clip_vertex {
    int32_t x, y, w, z; /* Q16.16; z: distance along the view; w = z, or 1 if orthographic; fisheye: see fisheye.h */
    int32_t light;      /* 0 .. 65535 */
    fx_t uv[2];
};

/* Object to clip coordinates; elements Q4.28, translation Q20.44 with half an LSB of Q16.16; row 2 is the distance. */
struct ph_clip_matrix {
    int32_t m[3][3];
    int64_t t[3];
};

/* A corner that is no vertex of the mesh, on its way to set-up. */
struct ph_corner {
    struct ph_vertex at;
    fx_t uv[2];
};

/* An edge walked down: x is the 16.16 column at its first row, with .5 px taken off and rounded up: column = x >> 16.
 */
struct ph_edge {
    int32_t x, dx;
};

/* Value at the centre of pixel (0, 0), modulo 2^32, and its steps per pixel to the right and down. */
struct ph_plane {
    uint32_t base, gx, gy;
};

/*
 * A small Gouraud triangle: none of its spans leaves the picture or has more than PH_SMALL_COLUMNS pixels. All hangs at
 * column 0 of its first row. After the upper rows the lower edge takes the place of the left or the right one; a
 * triangle whose top is flat has its rows in upper_rows, too.
 */
struct ph_small_triangle {
    uint32_t left_dx, right_dx, d_dy, light_dy; /* per row */
    uint32_t gd, glight;                        /* per column */
    const uint16_t *ramp;
    uint32_t left, right, d, light; /* edges as in ph_edge */
    struct ph_edge lower;
    uint16_t upper_rows, lower_rows; /* above 0; 0 or more */
    uint32_t lower_is_right;         /* 0, 1 */
};

enum ph_kind { PH_KIND_FLAT, PH_KIND_GOURAUD, PH_KIND_TEXTURE, PH_KIND_SMALL };

struct ph_triangle {
    uint32_t next;                  /* in its band's list, PH_NONE at the end */
    int16_t y_top, y_mid, y_bottom; /* rows y_top .. y_bottom - 1; the short edges meet at y_mid */
    uint8_t kind;                   /* enum ph_kind */
    uint8_t long_left;              /* the long edge is the left one */
    uint8_t block; /* floats: block exponent of depth where it must be split; PH_BLOCK_LINEAR; else PH_BLOCK_NONE */
    uint8_t range_log2; /* texture: |u|, |v| below 2^this */
    uint16_t colour;    /* flat: wire order; texture: light 0 .. 32 */
    const struct ph_material *material;
    union {
        struct {
            struct ph_edge long_edge, upper, lower;
            struct ph_plane depth;
            union {
                struct ph_plane attribute[3]; /* Gouraud: light; texture: u/w, v/w, 1/w */
                struct {
                    struct ph_plane first_two[2];
                    struct ph_linear linear; /* PH_BLOCK_LINEAR: in place of 1/w, which `depth` is then */
                };
            };
        };
        struct ph_small_triangle small; /* PH_KIND_SMALL */
    };
};

#define PH_NONE          UINT32_MAX
#define PH_SMALL_COLUMNS 32
#define PH_BLOCK_NONE    127
#define PH_BLOCK_LINEAR  126

static inline struct ph_triangle *ph_triangles(const struct ph_renderer *r)
{
    return (struct ph_triangle *)r->config.triangles;
}

/* Object to clip coordinates of the lens. */
struct ph_clip_matrix ph_clip_matrix(const struct ph_lens *lens, const struct ph_xform *object_to_view);

/* A row of the matrix times a point. Elements below 2 in Q4.28 times 2^31: all together stays below 2^62. */
static inline int32_t ph_matrix_row_mul(const struct ph_clip_matrix *m, int row, const struct fx_vec3 *p)
{
    const int64_t sum =
        m->t[row] + fx_mul_wide(m->m[row][0], p->x) + fx_mul_wide(m->m[row][1], p->y) + fx_mul_wide(m->m[row][2], p->z);
    return fx_sat64(sum >> 28);
}

static inline struct fx_vec3 ph_matrix_mul(const struct ph_clip_matrix *m, const struct fx_vec3 *p)
{
    return (struct fx_vec3){ph_matrix_row_mul(m, 0, p), ph_matrix_row_mul(m, 1, p), ph_matrix_row_mul(m, 2, p)};
}

/* A point before the divide, without light and texture; and projected, with clip codes. */
struct ph_clip_vertex ph_clip_place(const struct ph_lens *lens, const struct ph_clip_matrix *m,
                                    const struct fx_vec3 *p);
void ph_transform(const struct ph_renderer *r, const struct ph_clip_matrix *m, const struct fx_vec3 *p,
                  struct ph_vertex *v);

/* Projects a vertex inside near plane and guard band: its x, y, q and s. */
void ph_project(const struct ph_lens *lens, int32_t x, int32_t y, int32_t w, int32_t z, struct ph_vertex *v);

/* Of a triangle a, b, c, 1/256 px: two sides, and twice its area, positive where they run counter-clockwise. */
struct ph_sides {
    int32_t dx1, dy1, dx2, dy2; /* a to b, a to c */
    int32_t area;               /* small: in 1/65536 px^2, below 2^29; else its sign */
    bool is_short;              /* all four below PH_SIDE_SHORT: products of two fit 30 bits */
};

#define PH_SIDE_SHORT ((uint32_t)1 << 14) /* 64 px */
#define PH_SMALL      ((uint32_t)1 << 13) /* 32 px: PH_SMALL_COLUMNS columns */

static inline int64_t ph_wide_area(const struct ph_sides *s)
{
    return fx_mul_wide(s->dx2, s->dy1) - fx_mul_wide(s->dx1, s->dy2);
}

/* Sign of ph_wide_area. */
int32_t ph_wide_area_sign(int32_t dx1, int32_t dy1, int32_t dx2, int32_t dy2);

/* Whether -PH_SIDE_SHORT <= d < PH_SIDE_SHORT of all four; without constants, which would take registers. */
static inline bool ph_sides_are_short(int32_t dx1, int32_t dy1, int32_t dx2, int32_t dy2)
{
    return ((uint32_t)((dx1 >> 14) + 1) | (uint32_t)((dy1 >> 14) + 1) | (uint32_t)((dx2 >> 14) + 1) |
            (uint32_t)((dy2 >> 14) + 1)) <= 1;
}

static inline struct ph_sides ph_sides(const struct ph_vertex *a, const struct ph_vertex *b, const struct ph_vertex *c)
{
    const int32_t dx1 = b->x - a->x, dx2 = c->x - a->x, dy1 = b->y - a->y, dy2 = c->y - a->y;
    const bool small = ph_sides_are_short(dx1, dy1, dx2, dy2);
    const int32_t area = small ? dx2 * dy1 - dx1 * dy2 : ph_wide_area_sign(dx1, dy1, dx2, dy2);
    return (struct ph_sides){dx1, dy1, dx2, dy2, area, small};
}

/* a + (b - a) t, t in Q2.30, of all that a vertex carries before the divide; each rounded once. */
struct ph_clip_vertex ph_clip_between(const struct ph_clip_vertex *a, const struct ph_clip_vertex *b, int32_t t_q30);

/* Clips a polygon of n = 2 (a line) or 3 corners; out has room for PH_CLIP_MAX. Returns the number of corners left. */
#define PH_CLIP_MAX 9
int ph_clip(const struct ph_lens *lens, const struct ph_clip_vertex *in, int n, struct ph_clip_vertex *out);

/*
 * Sets up and lists a triangle; false if it faces away (and is not two-sided) or covers no pixel centre. uv: of each
 * corner; NULL where the material has no texture.
 */
bool ph_setup_triangle(struct ph_renderer *r, const struct ph_material *material, const struct ph_vertex *const v[3],
                       const fx_t *const uv[3]);

/* Before the triangles of a part: what those that are small have in common. Others may come in between. */
void ph_setup_part(struct ph_renderer *r, const struct ph_material *material);

/* ph_setup_triangle of one that faces the viewer, with its sides. */
bool ph_setup_front(struct ph_renderer *r, const struct ph_material *material, const struct ph_vertex *const v[3],
                    const fx_t *const uv[3], const struct ph_sides *sides);

/* ph_setup_triangle of corners that are no vertices of the mesh. */
bool ph_setup_corners(struct ph_renderer *r, const struct ph_material *material, const struct ph_corner *a,
                      const struct ph_corner *b, const struct ph_corner *c);

/* Clips a triangle, or divides one that is curved, and sets up and lists what is left; counts it. */
void ph_draw_clipped(struct ph_renderer *r, const struct ph_material *material, const struct ph_clip_vertex in[3]);

/* A line one pixel wide. */
void ph_setup_line(struct ph_renderer *r, const struct ph_material *material, const struct ph_corner *a,
                   const struct ph_corner *b);

/* The light of one mesh, in its own coordinates: see light.c. */
struct ph_local_light {
    bool point;
    int16_t to_light[3], half[3]; /* directional: unit vectors, Q1.14 */
    struct fx_vec3 position;      /* point */
    fx_t reach;
    int32_t diffuse, specular; /* times the material's, Q2.14 */
};

struct ph_local_lights {
    int32_t ambient; /* Q2.14 */
    int32_t scale;   /* light units per 1.0 */
    int32_t limit;   /* 1 + specular of the material, Q2.14 */
    uint32_t count, shininess_log2;
    bool simple; /* one directional light, nothing specular */
    int16_t to_viewer[3];
    struct ph_local_light light[PH_LIGHTS_MAX];
};

#define PH_LIGHT_ZERO 2304  /* the middle of entry 4 of the ramp */
#define PH_LIGHT_SPAN 60928 /* to the middle of entry 123 */

void ph_light_prepare(struct ph_local_lights *local, const struct ph_renderer *r, const struct ph_xform *to_world,
                      const struct ph_material *material);
uint16_t ph_light_vertex(const struct ph_local_lights *local, const int16_t normal[3], const struct fx_vec3 *position);

/* Rows y0 .. y1 - 1 of the picture, and the memory that they are drawn into. */
struct ph_band {
    uint16_t *pixels; /* of row y0 */
    void *depth;      /* the same; uint32_t where wide, else uint16_t */
    bool wide;
    int32_t y0, y1, width;
};

/* Draws the rows of a textured triangle that are in the band: see texture.c. Returns the number of its pixels. */
uint32_t ph_draw_textured(const struct ph_triangle *t, const struct ph_band *band);

#endif
