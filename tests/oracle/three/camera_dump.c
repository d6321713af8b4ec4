/*
 * camera_dump: what firmware/core makes of cameras, for an oracle outside (tests/oracle/three/oracle.mjs).
 *
 * One case a line on standard input, a word and integers: Q16.16, angles in 2^-32 turn. One line of raw Q16.16 out for
 * each, matrices by rows; "error STATUS" where the core refuses. Exits 1 on a line that is not understood.
 *
 *   perspective fov aspect near far             its GL matrix
 *   frustum left right bottom top near far      likewise
 *   ortho left right bottom top near far        likewise
 *   camera eye target up                        view matrix (9 integers)
 *   object place target up                      matrix of the placement
 *   quaternion axis turn                        matrix of the rotation
 *   product axis turn axis turn                 matrix of the second rotation, then the first
 *   nodes count (axis turn scale place)...      each node in the one before it: world matrix of the last
 *   rider count (...)...                        likewise: view matrix of a camera in the last node
 *   riderat count (...)... target up            likewise: view matrix, the camera turned to the target
 */
#include "camera.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define NODE_MAX 64

static int32_t next(void)
{
    char word[24], *end = word;
    const int got = scanf("%23s", word);
    const long long v = got == 1 ? strtoll(word, &end, 10) : 0;
    if (end == word || *end != '\0') {
        fprintf(stderr, "camera_dump: standard input: an integer is missing; see the top of camera_dump.c\n");
        exit(1);
    }
    return (int32_t)(uint32_t)v;
}

static struct fx_vec3 next_vec(void)
{
    const fx_t x = next(), y = next(), z = next();
    return (struct fx_vec3){x, y, z};
}

static struct fx_quat next_quat(void)
{
    const struct fx_vec3 axis = next_vec();
    return fx_quat_axis(axis, (uint32_t)next());
}

static void print_matrix(struct ph_mat4 m)
{
    for (int e = 0; e < 16; e++) {
        printf("%" PRId32 "%c", m.m[e / 4][e % 4], e == 15 ? '\n' : ' ');
    }
}

static void print_xform(struct ph_xform m)
{
    print_matrix(ph_mat4_xform(&m));
}

static void projection(char kind)
{
    fx_t v[6];
    struct ph_projection p;
    struct ph_mat4 m;
    for (int i = 0; i < (kind == 'p' ? 4 : 6); i++) {
        v[i] = next();
    }
    int status = kind == 'p'   ? ph_projection_perspective(&p, v[0], v[1], v[2], v[3])
                 : kind == 'f' ? ph_projection_frustum(&p, v[0], v[1], v[2], v[3], v[4], v[5])
                               : ph_projection_ortho(&p, v[0], v[1], v[2], v[3], v[4], v[5]);
    if (status == PH_OK) {
        status = ph_matrix_projection(&m, &p, PH_GL);
    }
    if (status != PH_OK) {
        printf("error %d\n", status);
        return;
    }
    print_matrix(m);
}

/* World transform of the last of a chain of nodes. */
static struct ph_xform chain(void)
{
    static struct ph_node nodes[NODE_MAX];
    static struct ph_xform world[NODE_MAX];
    const int count = next();
    for (int i = 0; i < count && i < NODE_MAX; i++) {
        const struct fx_quat turn = next_quat();
        const struct ph_xform scale = ph_xform_scale(next()), placed = ph_xform_quat(turn, next_vec());
        nodes[i] = (struct ph_node){i - 1, ph_xform_mul(&placed, &scale)};
    }
    if (count < 1 || count > NODE_MAX || ph_nodes_world(nodes, (uint32_t)count, world) != PH_OK) {
        fprintf(stderr, "camera_dump: standard input: %d nodes; 1 .. %d are possible\n", count, NODE_MAX);
        exit(1);
    }
    return world[count - 1];
}

static void look_at(bool object)
{
    const struct fx_vec3 place = next_vec(), target = next_vec(), up = next_vec();
    print_xform(object ? ph_object_look_at(place, target, up) : ph_view_look_at(place, target, up));
}

static void product(void)
{
    const struct fx_quat a = next_quat(), b = next_quat();
    print_xform(ph_xform_quat(fx_quat_mul(a, b), (struct fx_vec3){0, 0, 0}));
}

static void rider(bool turned)
{
    const struct ph_xform world = chain();
    if (turned) {
        const struct fx_vec3 target = next_vec(), up = next_vec();
        print_xform(ph_view_look_at(world.t, target, up));
        return;
    }
    print_xform(ph_view_of_node(&world));
}

int main(void)
{
    char word[16];
    while (scanf("%15s", word) == 1) {
        if (strcmp(word, "perspective") == 0 || strcmp(word, "frustum") == 0 || strcmp(word, "ortho") == 0) {
            projection(word[0]);
        } else if (strcmp(word, "camera") == 0 || strcmp(word, "object") == 0) {
            look_at(word[0] == 'o');
        } else if (strcmp(word, "quaternion") == 0) {
            print_xform(ph_xform_quat(next_quat(), (struct fx_vec3){0, 0, 0}));
        } else if (strcmp(word, "product") == 0) {
            product();
        } else if (strcmp(word, "nodes") == 0) {
            print_xform(chain());
        } else if (strcmp(word, "rider") == 0 || strcmp(word, "riderat") == 0) {
            rider(word[5] == 'a');
        } else {
            fprintf(stderr, "camera_dump: standard input: no case is called %s; see the top of camera_dump.c\n", word);
            return 1;
        }
    }
    return 0;
}
