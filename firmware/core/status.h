/*
 * status: the version of Pinhole; what a function returns, and functions that say in words what is wrong. 0 is done, a
 * negative value is an error, a positive value is a count.
 *
 * Every layer uses the same numbers, which are Linux's errno values negated. hal.h, which knows nothing of this
 * folder, gives some of them names of its own; firmware/app/runner.c asserts that equal names have equal values.
 */
#ifndef PH_STATUS_H
#define PH_STATUS_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The version, MAJOR.MINOR.PATCH, here and nowhere else. It follows semantic versioning 2.0: MAJOR grows when a program
 * that used a public header no longer compiles or draws other bytes without a reason given, MINOR when something is
 * new, PATCH when something is mended. Below 1.0.0 MINOR may do what MAJOR does. */
#define PH_VERSION "0.9.0"

/* What functions return: 0 or more is success. */
enum ph_status {
    PH_OK = 0,
    PH_ERR_NOMEM = -12,  /* a caller's buffer is too small */
    PH_ERR_INVAL = -22,  /* an argument makes no sense */
    PH_ERR_RANGE = -34,  /* an argument does not fit the number format */
    PH_ERR_STATE = -77,  /* a call out of turn: see the order of a frame in render.h */
    PH_ERR_FORMAT = -95, /* no depth format is named */
};

/*
 * What follows is for the time when a program is written: it is for people, and changes nothing. A program that calls
 * neither function links nothing of them. The small profile does not have them.
 *
 *   const struct ph_finding found = ph_check_mesh(&mesh);
 *   if (found.what != NULL) {
 *       printf("%s: number %u\n", found.what, (unsigned)found.number);
 *   }
 */
struct ph_mesh;
struct ph_renderer;

/* What is wrong, in English, without a full stop; NULL: nothing. */
struct ph_finding {
    const char *what;
    uint32_t number; /* of the triangle, edge, vertex, part or material that `what` begins with; else 0 */
};

/*
 * Names the first thing wrong with a mesh: what ph_draw_mesh() refuses, what it reads without looking (indices,
 * textures), and what it draws as nothing, or as black, though it is allowed: parts without triangles, triangles that
 * all face away, sizes that are integers where Q16.16 is meant, normals of no length, materials that reflect no light.
 *
 * That all triangles face away is seen where they enclose a volume, and where they face against their normals. Of an
 * open mesh without normals it cannot be told, nor is it an error with two_sided. A mesh smaller than 1/64 counts as
 * one whose sizes are integers.
 *
 * In:   what the mesh points to must be as long as its counts say; textures are not read.
 * Cost: it looks at each index, vertex and triangle some times: for a kit, once.
 */
struct ph_finding ph_check_mesh(const struct ph_mesh *mesh);

/*
 * Why nothing was drawn in this frame, from the renderer's state and statistics: a sentence, or NULL if pixels were
 * drawn. (If none of them is to be seen, they have the colour of the background: ph_check_mesh() knows materials that
 * are black.) Call it after ph_show(), or after the last band.
 */
const char *ph_why_empty(const struct ph_renderer *r);

#ifdef __cplusplus
}
#endif

#endif
