/*
 * list: what a frame keeps of its meshes until its bands are drawn. Private to firmware/core.
 *
 * Transformed vertices stay where they are, 16 bytes each. A triangle that can be seen is a reference of 8 bytes to its
 * three corners. Neighbouring references share a draw record: first vertex, camera, and a copy of their material, which
 * the next draws share in turn (PH_LIST_COPIES). A band sets up the triangles that begin in it (bands.c).
 *
 * Memory: the caller's `vertices` and `triangles`, and a little of the renderer's own for scenes of few triangles.
 * References grow down from the end of `triangles`. All else is taken from the three pieces upwards, and is named by
 * its place, so that the renderer holds no pointer into itself until its bands are drawn. What is left becomes slots
 * for set-up triangles.
 */
#ifndef PH_LIST_H
#define PH_LIST_H

#include "shading.h"
#include "sides.h"
#include "triangle.h"

/* A triangle. Its corners run counter-clockwise on the screen. */
struct ph_ref {
    uint16_t corner[3]; /* from the draw's base on; of a line: its two ends, and which of two lines of samples */
    uint16_t link;      /* the band where it begins; after ph_frame_bands: how much further the next one of the band's
                           list stands, 0 at the end, or PH_LINK_FAR */
};

#define PH_LINK_FAR   UINT16_MAX /* the next one of the list is that far away or further */
#define PH_LINK_AFTER 0x8000     /* or more: it is in no band's list, but drawn after the opaque triangles */

enum ph_draw_kind {
    PH_DRAW_SMALL = 1,     /* small triangles are drawn as such */
    PH_DRAW_UVS = 2,       /* the corners are struct ph_corner, else struct ph_vertex */
    PH_DRAW_LINES = 4,     /* the references are lines */
    PH_DRAW_COLOURS = 8,   /* the light of a corner is its lit colour, RGB565 as a number */
    PH_DRAW_ONE_SIDE = 16, /* the two sides of its two-sided material are drawn one after the other */
    PH_DRAW_POINTS = 32,   /* its only reference is none: the base is the place of a struct ph_cloud */
};

/* What references have in common. */
struct ph_draw {
    const struct ph_material *material; /* in the list: the list's own copy, from ph_list_end on */
    const fx_t (*uvs)[2];               /* of the vertices of a mesh, or NULL */
    uint32_t first;                     /* number of the first reference */
    uint32_t next;                      /* place of the next draw, PH_NONE at the end */
    uint32_t base;                      /* place of corner 0 */
    uint32_t lens;                      /* place of the camera's lens */
    uint32_t kind;                      /* enum ph_draw_kind, combined by OR */
    /* The first: place of the copy of the material, plus 1 if it was made for this draw and not for one before. The
     * others are unused: a draw has 40 bytes on every machine, so that the same fits. */
    uint32_t copy[sizeof(void *) == 4 ? 3 : 1];
};

/* Converts a place (piece in the top 2 bits, byte offset below) to a pointer. */
void *ph_at(const struct ph_renderer *r, uint32_t place);

static inline uint32_t ph_ref_count(const struct ph_renderer *r)
{
    return (uint32_t)(r->list.top - r->list.to);
}

static inline struct ph_ref *ph_ref_at(const struct ph_renderer *r, uint32_t n)
{
    return r->list.top - 1 - n;
}

/* Empties the list. */
void ph_list_begin(struct ph_renderer *r);

/* Room for the vertices of a mesh: their place; PH_NONE if there is none. */
uint32_t ph_list_vertices(struct ph_renderer *r, uint32_t n);

/* The state of the list: ph_list_mark takes it before something is drawn, and ph_list_rewind after it gives back all
 * memory that was taken in between if nothing was listed. */
struct ph_mark {
    uint32_t used[3], last, count, rows;
    struct ph_draw draw; /* the last one, if there is any: without references it gives its room to the next one */
};

struct ph_mark ph_list_mark(struct ph_renderer *r);
void ph_list_rewind(struct ph_renderer *r, const struct ph_mark *mark);

/* Pixels of one of the rows that something with a blend is drawn into: even, because depth of 24 bits stands at a word.
 */
static inline uint32_t ph_row_pixels(const struct ph_renderer *r)
{
    return (r->config.width + 1u) & ~1u;
}

/* Bytes of a row that something with a blend is drawn into: two colour buffers and one depth buffer. */
static inline uint32_t ph_row_bytes(const struct ph_renderer *r)
{
    return ph_row_pixels(r) * (4 + (uint32_t)ph_depth_bytes(r->config.depth_format));
}

/* Values of struct ph_list.stage. A renderer of zeros is closed. */
enum { PH_LIST_CLOSED, PH_LIST_OPEN, PH_LIST_FULL };

#define PH_NO_BAND UINT16_MAX /* struct ph_list.band: no band may be drawn */

/* Ends the listing of a frame, until ph_list_begin: whatever is drawn finds no room, and no memory is written. */
void ph_list_close(struct ph_renderer *r);

/* Counts a mesh for whose vertices there is no room; `lines`: its edges, too, where it has some. PH_ERR_STATE if the
 * list is closed, PH_ERR_NOMEM if there never is room, else PH_OK. */
int ph_list_leave_out(struct ph_renderer *r, const struct ph_mesh *mesh, bool lines);

struct ph_part_context;

/* What lists and draws with a blend. Only a blend names it, so the linker leaves it out of a program without blends. */
struct ph_blending {
    /* Prepares for something with a blend. False: there is no room for the rows that it is drawn into, or the blend
     * does not say what draws it. */
    bool (*begin_blend)(struct ph_renderer *r, const struct ph_material *material);
    /* Marks the references from number `first` on as cut out or blended: they are drawn after all others. since: the
     * place of the last draw when the first of them was listed; PH_NONE if there was none. */
    void (*put_after)(struct ph_renderer *r, uint32_t since, uint32_t first);
    /* mesh_sides.c: draws the triangles of a part that shows both of its sides one behind the other. Returns how many
     * can be seen. */
    uint32_t (*draw_sides)(struct ph_part_context *c, const uint16_t (*index)[3], const uint16_t (*end)[3]);
    /* feed.c: puts references into the lists of their bands, but those that were put after the others. */
    void (*sort_opaque)(uint32_t *bins, struct ph_ref *ref, uint32_t n);
    /* Draws into a band what was put after the others. */
    void (*draw_after)(struct ph_renderer *r, const struct ph_band *band);
    /* The shading that draws alphas over a material without a texture; NULL: such a triangle is left out. */
    const struct ph_shading *of_alphas;
};

/* The shading that draws the texels which decide in a blend: see struct ph_blend. NULL: there is none. */
static inline const struct ph_shading *ph_texels_of_blend(const struct ph_material *material)
{
    return ph_takes_texture(material) ? material->shading->texels : material->blend->draw->of_alphas;
}

/* Prepares for a material with a blend. False: it is left out, because there is no room for it, or because the blend
 * does not say what draws it. */
static inline bool ph_list_blend(struct ph_renderer *r, const struct ph_material *material)
{
    return material->blend->draw != NULL && material->blend->draw->begin_blend(r, material);
}

/* blended.c and feed.c: see struct ph_blending. */
bool ph_begin_blend(struct ph_renderer *r, const struct ph_material *material);
void ph_put_after(struct ph_renderer *r, uint32_t since, uint32_t first);
uint32_t ph_draw_sides(struct ph_part_context *c, const uint16_t (*index)[3], const uint16_t (*end)[3]);
void ph_sort_opaque(uint32_t *bins, struct ph_ref *ref, uint32_t n);

/* Estimated cost of the triangles with a blend in every two rows of the picture, in pixels. */
uint16_t *ph_list_work(const struct ph_renderer *r);

/* Whether a triangle with a blend may reach rows 8 first to 8 last + 7. Its link holds its first row in bits 0 .. 6 and
 * its last row from bit 8 on, divided by 8 (a picture has 1024 rows at most), so that a band skips most at a glance. */
static inline bool ph_ref_may_reach(const struct ph_ref *ref, uint32_t first, uint32_t last)
{
    const uint32_t link = ref->link;
    return (link & 127) <= last && (link >> 8 & 127) >= first;
}

/* Columns x0 .. x1 - 1 and rows y0 .. y1 - 1. */
struct ph_box {
    int32_t x0, x1, y0, y1;
};

/* The box around the corners of a reference, also outside the picture; a line is as wide as it can be. */
struct ph_box ph_box_of(const struct ph_renderer *r, const struct ph_draw *draw, const struct ph_ref *ref);

/* The number of the first reference after those of a draw. */
static inline uint32_t ph_end_of_draw(const struct ph_renderer *r, const struct ph_draw *draw)
{
    return draw->next == PH_NONE ? ph_ref_count(r) : ((const struct ph_draw *)ph_at(r, draw->next))->first;
}

/* Makes the lens at a place that of the renderer. */
void ph_change_lens(struct ph_renderer *r, uint32_t place);

/* Makes the lens of a draw that of the renderer, for the triangles that are set up next. */
static inline void ph_take_lens(struct ph_renderer *r, const struct ph_draw *draw)
{
    if (draw->lens != r->list.lens) {
        ph_change_lens(r, draw->lens);
    }
}

/* Place of corner 0 of the current draw. */
uint32_t ph_list_base(const struct ph_renderer *r);

/* Makes a draw the current one: from now on references are listed for it; first, next, lens and copy are set here, and
 * its material is copied, unless one of the last copies is equal. False: there is no room. */
bool ph_list_draw(struct ph_renderer *r, const struct ph_draw *draw);

/* The list's copy of the current draw's material. */
const struct ph_material *ph_list_material(const struct ph_renderer *r);

/* Ends the listing of a frame whose bands are to be drawn: from here on the renderer has pointers into itself. */
void ph_list_end(struct ph_renderer *r);

/* Goes on with a draw after others. Without room for that no more is listed in this frame: it would have others'
 * corners. */
void ph_list_again(struct ph_renderer *r, const struct ph_draw *draw);

/* The first row of a triangle in the picture; -1 if it covers no centre of a pixel of the picture. */
int32_t ph_first_row_of(const struct ph_renderer *r, const struct ph_vertex *const v[3]);

/* Lists a triangle of the current draw. False if it faces away (and is not two-sided) or covers no pixel centre; true
 * also if there is no room: then it is counted. v: its corners. */
bool ph_list_triangle(struct ph_renderer *r, const uint16_t corner[3], const struct ph_vertex *const v[3],
                      bool two_sided);

/* Takes the next reference if there is room; else the triangle is counted. */
static inline struct ph_ref *ph_list_next(struct ph_renderer *r)
{
    if (r->list.to == r->list.end) {
        r->stats.triangles_dropped++;
        return NULL;
    }
    return --r->list.to;
}

/* The band of a row. */
static inline uint16_t ph_band_of(const struct ph_renderer *r, int32_t row)
{
    return (uint16_t)((uint32_t)row * r->list.band_scale >> 20);
}

/* Keeps n corners that are no vertices of the mesh, for references of this material, and makes it the current draw.
 * Returns the number of the first; -1: there is no room. */
int32_t ph_list_corners(struct ph_renderer *r, const struct ph_material *material, uint32_t kind,
                        const struct ph_corner *corners, uint32_t n);

/* Lists a convex polygon of n >= 3 corners. False if none of it can be seen. */
bool ph_list_fan(struct ph_renderer *r, const struct ph_material *material, uint32_t kind,
                 const struct ph_corner *corners, uint32_t n);

/*
 * Two cores list triangles of one draw at a time: this one goes on in the upper half of the room, the other one has a
 * renderer of its own, which stands at the end of the lower half and lists there. Corners have no texture coordinates,
 * so they take numbers behind the draw's base, and no draw is added.
 */
struct ph_lent {
    struct ph_renderer renderer;
    struct ph_draw last;   /* of its list: a copy, because both cores put it back as it was */
    struct ph_stats stats; /* the rest is how r was */
    struct ph_ref *to;
    uint32_t used[3], base;
    uint32_t from, half; /* bytes: where the lower half begins, how long it is */
};

/* Lends half of the room. Returns a struct of that many bytes, which begins with struct ph_lent; NULL: there is too
 * little room. */
void *ph_list_lend(struct ph_renderer *r, const struct ph_draw *draw, size_t bytes);

/* Takes back what was lent, and what the other core has listed behind what this one has: of n triangles, the last one
 * first; counts[k]: the number of references when k were listed. False: one of both had too little room. Then nothing
 * is listed, and the triangles must be listed again. */
bool ph_list_take_back(struct ph_renderer *r, const struct ph_lent *lent, const uint32_t counts[], uint32_t n);

/* Whether a material needs u and v of the corners. */
static inline bool ph_has_uvs(const struct ph_material *material)
{
    return ph_is_textured(material) || (material->blend != NULL && material->blend->alphas != NULL);
}

#endif
