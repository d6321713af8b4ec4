/*
 * Coverage, clipping and depth of the rasterizer are checked in pictures of 16 x 12 pixels (see ref_drawing.h for
 * coordinates). The expected pictures follow from the top-left rule in exact arithmetic: corners are multiples of
 * 1/256.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "ref_drawing.h"

#include <string.h>

/* Pixels that are not black in an expected picture. */
static int drawn_in(const char *const rows[HEIGHT])
{
    int drawn = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        drawn += rows[i / WIDTH][i % WIDTH] != '.';
    }
    return drawn;
}

/* ---- coverage --------------------------------------------------------------------------------------------- */

/* Corners on pixel centres: the left column and the top row belong to the square, the others do not. */
static void left_and_top_edges_are_drawn_right_and_bottom_not(void **state)
{
    static const struct shape shapes[] = {{'a', {{2.5, 2.5}, {2.5, 6.5}, {7.5, 6.5}}},
                                          {'b', {{2.5, 2.5}, {7.5, 6.5}, {7.5, 2.5}}}};
    static const char *const rows[HEIGHT] = {
        "................", "................", "..bbbbb.........", "..aabbb.........",
        "..aaabb.........", "..aaaab.........", "................", "................",
        "................", "................", "................", "................",
    };
    (void)state;
    expect_shapes(shapes, COUNT(shapes), rows);
}

/* Both diagonals run through pixel centres; each centre goes to the triangle whose left edge it meets. */
static void shared_edge_is_drawn_once(void **state)
{
    static const struct shape shapes[] = {{'a', {{1.5, 1.5}, {1.5, 6.5}, {6.5, 6.5}}},
                                          {'b', {{1.5, 1.5}, {6.5, 6.5}, {6.5, 1.5}}},
                                          {'c', {{9.5, 1.5}, {9.5, 6.5}, {14.5, 1.5}}},
                                          {'d', {{9.5, 6.5}, {14.5, 6.5}, {14.5, 1.5}}}};
    static const char *const rows[HEIGHT] = {
        "................", ".bbbbb...ccccc..", ".abbbb...ccccd..", ".aabbb...cccdd..",
        ".aaabb...ccddd..", ".aaaab...cdddd..", "................", "................",
        "................", "................", "................", "................",
    };
    struct drawing d;
    (void)state;
    drawing_open(&d);
    draw_shapes(&d, shapes, COUNT(shapes));
    expect(&d, rows);
    assert_int_equal(d.rig.r.stats.fragments, drawn_in(rows));
    drawing_close(&d);
}

static void fan_round_a_pixel_centre_has_no_hole(void **state)
{
    static const struct shape shapes[] = {
        {'a', {{8.5, 5.5}, {8.5, 1.5}, {3.5, 3.5}}},   {'b', {{8.5, 5.5}, {3.5, 3.5}, {2.5, 8.5}}},
        {'c', {{8.5, 5.5}, {2.5, 8.5}, {6.5, 10.5}}},  {'d', {{8.5, 5.5}, {6.5, 10.5}, {12.5, 9.5}}},
        {'e', {{8.5, 5.5}, {12.5, 9.5}, {14.5, 4.5}}}, {'f', {{8.5, 5.5}, {14.5, 4.5}, {8.5, 1.5}}}};
    static const char *const rows[HEIGHT] = {
        "................", "................", "......aaff......", "...aaaaaffff....",
        "...bbbaaffffff..", "...bbbbbeeeeee..", "...bbbccdeeeee..", "...bccccddeee...",
        "..cccccddddee...", "....cccddddd....", "................", "................",
    };
    struct drawing d;
    (void)state;
    drawing_open(&d);
    draw_shapes(&d, shapes, COUNT(shapes));
    expect(&d, rows);
    assert_int_equal(d.rig.r.stats.fragments, drawn_in(rows));
    drawing_close(&d);
}

static void slivers_meet_only_the_centres_inside(void **state)
{
    static const struct shape shapes[] = {{'a', {{1, 3.25}, {15, 3.75}, {15, 3.25}}},
                                          {'b', {{2.25, 5}, {2.5, 11}, {2.75, 5}}},
                                          {'c', {{4, 5}, {14, 11}, {14, 10.9375}}}};
    static const char *const rows[HEIGHT] = {
        "................", "................", "................", "........aaaaaaa.",
        "................", "..b.............", "..b...c.........", "..b.............",
        "..b.............", "..b........c....", "..b.............", "................",
    };
    (void)state;
    expect_shapes(shapes, COUNT(shapes), rows);
}

/* a holds a centre; b, c, d miss or only touch theirs; e is 1/256 large with its corner on the centre. */
static void smallest_triangles_draw_one_pixel_or_none(void **state)
{
    static const struct shape shapes[] = {{'a', {{2.25, 2.25}, {2.5, 2.75}, {2.75, 2.25}}},
                                          {'b', {{5, 2.125}, {5.25, 2.375}, {5.375, 2.125}}},
                                          {'c', {{8.5, 2.5}, {8.5, 3}, {9, 3}}},
                                          {'d', {{11, 2}, {11, 2.5}, {11.5, 2.5}}},
                                          {'e', {{2.5, 6.5}, {2.5, 6.5 + 1 / 256.}, {2.5 + 1 / 256., 6.5}}}};
    static const char *const rows[HEIGHT] = {
        "................", "................", "..a.............", "................",
        "................", "................", "..e.............", "................",
        "................", "................", "................", "................",
    };
    (void)state;
    expect_shapes(shapes, COUNT(shapes), rows);
}

/* A centre on a corner is drawn where the corner is a left one, or the left end of a top edge. */
static void corners_on_centres_follow_both_their_edges(void **state)
{
    static const struct shape shapes[] = {{'a', {{2.5, 1.5}, {1, 4.5}, {4, 4.5}}},
                                          {'b', {{7, 1.5}, {8.5, 4.5}, {10, 1.5}}},
                                          {'c', {{12.5, 3.5}, {14.5, 5}, {14.5, 2}}},
                                          {'d', {{2, 7}, {2, 10}, {4.5, 8.5}}}};
    static const char *const rows[HEIGHT] = {
        "................", ".......bbb......", "..a....bb.......", ".aa.....b...cc..",
        "................", "................", "................", "..d.............",
        "..dd............", "..d.............", "................", "................",
    };
    (void)state;
    expect_shapes(shapes, COUNT(shapes), rows);
}

static void triangles_without_area_draw_nothing(void **state)
{
    static const struct shape shapes[] = {{'a', {{2, 2}, {8, 5}, {14, 8}}},
                                          {'b', {{3.5, 3.5}, {3.5, 3.5}, {9, 9}}},
                                          {'c', {{5.5, 5.5}, {5.5, 5.5}, {5.5, 5.5}}},
                                          {'d', {{1, 4.5}, {9, 4.5}, {4, 4.5}}},
                                          {'e', {{4.5, 1}, {4.5, 9}, {4.5, 4}}}};
    struct drawing d;
    (void)state;
    drawing_open(&d);
    draw_shapes(&d, shapes, COUNT(shapes));
    expect(&d, nothing);
    assert_int_equal(d.rig.r.stats.triangles_culled, COUNT(shapes));
    assert_int_equal(d.rig.r.stats.fragments, 0);
    drawing_close(&d);
}

/* ---- clipping --------------------------------------------------------------------------------------------- */

static void triangles_are_cut_at_each_border(void **state)
{
    static const struct shape shapes[] = {{'l', {{-20, 6}, {4, 9}, {4, 3}}},
                                          {'r', {{12, 3}, {12, 9}, {40, 6}}},
                                          {'t', {{8, -30}, {5, 4}, {11, 4}}},
                                          {'b', {{5, 8}, {8, 50}, {11, 8}}}};
    static const char *const rows[HEIGHT] = {
        ".....tttttt.....", ".....tttttt.....", ".....tttttt.....", "llll.tttttt.rrrr",
        "llll........rrrr", "llll........rrrr", "llll........rrrr", "llll........rrrr",
        "llll.bbbbbb.rrrr", ".....bbbbbb.....", ".....bbbbbb.....", ".....bbbbbb.....",
    };
    (void)state;
    expect_shapes(shapes, COUNT(shapes), rows);
}

/* The diagonal runs through the corner of the picture: (8, 14) .. (-3, 4) extended, and the same 1000 times larger. */
static void far_corners_do_not_move_an_edge(void **state)
{
    static const char *const rows[HEIGHT] = {
        "................", "................", "x...............", "xx..............",
        "xxx.............", "xxxx............", "xxxxx...........", "xxxxxx..........",
        "xxxxxxx.........", "xxxxxxxx........", "xxxxxxxxx.......", "xxxxxxxxxx......",
    };
    (void)state;
    for (int power = 4; power <= 14; power += 2) {
        const double size = 1 << power;
        /* The edge is y = x + 1.75: centres with y >= x + 2 lie below it. */
        const struct shape shape = {'x', {{-size, 1.75 - size}, {-size, 1.75 + size}, {size, 1.75 + size}}};
        expect_shapes(&shape, 1, rows);
    }
}

static void triangles_outside_a_border_draw_nothing(void **state)
{
    static const struct shape shapes[] = {
        {'l', {{-20, 6}, {0, 9}, {0, 3}}},           {'r', {{16, 3}, {16, 9}, {40, 6}}},
        {'t', {{8, -30}, {5, 0}, {11, 0}}},          {'b', {{5, 12}, {8, 50}, {11, 12}}},
        {'n', {{2, 2, -2}, {2, 9, -2}, {9, 9, -2}}}, {'f', {{2, 2, 2}, {2, 9, 2}, {9, 9, 2}}}};
    struct drawing d;
    (void)state;
    drawing_open(&d);
    draw_shapes(&d, shapes, COUNT(shapes));
    expect(&d, nothing);
    assert_int_equal(d.rig.r.stats.fragments, 0);
    drawing_close(&d);
}

/* Planes that lean through the near and the far plane; they meet them at x = 4 and x = 12. */
static void near_and_far_planes_cut(void **state)
{
    static const struct shape shapes[] = {{'a', {{0, 1, -2}, {0, 4, -2}, {16, 4, 2}}},
                                          {'a', {{0, 1, -2}, {16, 4, 2}, {16, 1, 2}}}};
    static const char *const rows[HEIGHT] = {
        "................", "....aaaaaaaa....", "....aaaaaaaa....", "....aaaaaaaa....",
        "................", "................", "................", "................",
        "................", "................", "................", "................",
    };
    struct drawing d;
    (void)state;
    drawing_open(&d);
    draw_shapes(&d, shapes, COUNT(shapes));
    expect(&d, rows);
    assert_int_equal(d.rig.r.stats.triangles_clipped, 2);
    assert_int_equal(d.rig.r.stats.fragments, drawn_in(rows));
    drawing_close(&d);
}

/* ---- facing and depth ------------------------------------------------------------------------------------- */

static const char *const one_square[HEIGHT] = {
    "................", ".aaaa...........", ".aaaa...........", ".aaaa...........",
    "................", "................", "................", "................",
    "................", "................", "................", "................",
};

static void back_faces_are_culled_unless_two_sided(void **state)
{
    static const struct shape back[] = {{'a', {{1, 1}, {5, 4}, {1, 4}}}, {'a', {{1, 1}, {5, 1}, {5, 4}}}};
    struct drawing d;
    (void)state;
    drawing_open(&d);
    draw_shapes(&d, back, 2);
    expect(&d, nothing);
    assert_int_equal(d.rig.r.stats.triangles_culled, 2);
    drawing_begin(&d, NULL);
    for (int i = 0; i < 2; i++) {
        struct rig_one *one = shape_mesh(&d, &back[i]);
        one->material.two_sided = 1;
        draw_mesh(&d, one);
    }
    expect(&d, one_square);
    assert_int_equal(d.rig.r.stats.fragments, 12);
    drawing_close(&d);
}

/* Two leaning planes that cross between columns 7 and 8, in both orders. */
static void nearer_surface_wins_in_either_order(void **state)
{
    static const struct shape shapes[] = {{'a', {{0, 0, -.9}, {0, 24, -.9}, {32, 0, 2.7}}},
                                          {'b', {{16, 0, -.9}, {-16, 0, 2.7}, {16, 24, -.9}}}};
    static const char *const rows[HEIGHT] = {
        "aaaaaaaabbbbbbbb", "aaaaaaaabbbbbbbb", "aaaaaaaabbbbbbbb", "aaaaaaaabbbbbbbb",
        "aaaaaaaabbbbbbbb", "aaaaaaaabbbbbbbb", "aaaaaaaabbbbbbbb", "aaaaaaaabbbbbbbb",
        "aaaaaaaabbbbbbbb", "aaaaaaaabbbbbbbb", "aaaaaaaabbbbbbbb", "aaaaaaaabbbbbbbb",
    };
    (void)state;
    for (int f = 0; f < PH_DEPTH_FORMATS; f++) {
        const struct ph_depth_format *const format = ph_depth_formats[f];
        for (int first = 0; first < 2; first++) {
            struct drawing d;
            drawing_open_formats(&d, HEIGHT, 64, format);
            drawing_begin(&d, NULL);
            draw_shapes(&d, &shapes[first], 1);
            draw_shapes(&d, &shapes[1 - first], 1);
            expect(&d, rows);
            drawing_close(&d);
        }
    }
}

static void of_two_equal_depths_the_first_stays(void **state)
{
    static const struct shape shapes[] = {{'a', {{1, 1}, {1, 4}, {5, 4}}},
                                          {'a', {{1, 1}, {5, 4}, {5, 1}}},
                                          {'b', {{1, 1}, {1, 4}, {5, 4}}},
                                          {'b', {{1, 1}, {5, 4}, {5, 1}}}};
    (void)state;
    for (int f = 0; f < PH_DEPTH_FORMATS; f++) {
        const struct ph_depth_format *const format = ph_depth_formats[f];
        struct drawing d;
        drawing_open_formats(&d, HEIGHT, 64, format);
        drawing_begin(&d, NULL);
        draw_shapes(&d, shapes, COUNT(shapes));
        expect(&d, one_square);
        drawing_close(&d);
    }
}

/* ---- bands ------------------------------------------------------------------------------------------------ */

static void bands_of_any_height_give_the_same_bytes(void **state)
{
    static const struct shape shapes[] = {{'a', {{8.5, 5.5, .1}, {8.5, -1.5, .5}, {-3.5, 3.5, .2}}},
                                          {'b', {{8.5, 5.5}, {3.5, 3.5}, {2.5, 18.5, -.5}}},
                                          {'c', {{1, 1, .5}, {9.3, 11.2, -.5}, {15, 2.7}}},
                                          {'d', {{-9, 3, -2}, {3, 40, 1}, {30, 5, .7}}},
                                          {'e', {{0, 11.25}, {8, 11.75}, {16, 11.25}}},
                                          {'f', {{0, 0}, {0, 1}, {16, 1}}}};
    uint16_t pixels[HEIGHT * WIDTH];
    uint32_t depth[HEIGHT * WIDTH];
    uint32_t fragments = 0;
    (void)state;
    for (int f = 0; f < PH_DEPTH_FORMATS; f++) {
        const struct ph_depth_format *const format = ph_depth_formats[f];
        for (int band = HEIGHT; band >= 1; band--) {
            struct drawing d;
            drawing_open_formats(&d, band, 64, format);
            drawing_begin(&d, NULL);
            draw_shapes(&d, shapes, COUNT(shapes));
            memset(d.rig.pixels, 0x5a, sizeof(pixels));
            assert_true(rig_finish(&d.rig));
            if (band == HEIGHT) {
                memcpy(pixels, d.rig.pixels, sizeof(pixels));
                memcpy(depth, d.rig.depth, sizeof(depth));
                fragments = d.rig.r.stats.fragments;
                assert_true(fragments > 150);
            }
            assert_memory_equal(pixels, d.rig.pixels, sizeof(pixels));
            assert_memory_equal(depth, d.rig.depth, sizeof(depth));
            assert_int_equal(fragments, d.rig.r.stats.fragments);
            drawing_close(&d);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(left_and_top_edges_are_drawn_right_and_bottom_not),
        cmocka_unit_test(shared_edge_is_drawn_once),
        cmocka_unit_test(fan_round_a_pixel_centre_has_no_hole),
        cmocka_unit_test(slivers_meet_only_the_centres_inside),
        cmocka_unit_test(smallest_triangles_draw_one_pixel_or_none),
        cmocka_unit_test(corners_on_centres_follow_both_their_edges),
        cmocka_unit_test(triangles_without_area_draw_nothing),
        cmocka_unit_test(triangles_are_cut_at_each_border),
        cmocka_unit_test(far_corners_do_not_move_an_edge),
        cmocka_unit_test(triangles_outside_a_border_draw_nothing),
        cmocka_unit_test(near_and_far_planes_cut),
        cmocka_unit_test(back_faces_are_culled_unless_two_sided),
        cmocka_unit_test(nearer_surface_wins_in_either_order),
        cmocka_unit_test(of_two_equal_depths_the_first_stays),
        cmocka_unit_test(bands_of_any_height_give_the_same_bytes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
