/*
 * The demos: their list, budgets, loops and cameras, on pictures of many shapes. (That the five benchmark scenes show
 * what they should, test_quality.c proves.)
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "demo.h"
#include "models.h"
#include "demo_stage.h"

#include <stdlib.h>
#include <string.h>

static const uint16_t sizes[][2] = {{240, 240}, {135, 240}, {240, 135}, {128, 64},
                                    {320, 240}, {80, 160},  {320, 480}, {1024, 1024}};
#define SIZES (sizeof(sizes) / sizeof(sizes[0]))

/* ---- the list -------------------------------------------------------------------------------------------------- */

static void demos_are_found_by_name(void **state)
{
    (void)state;
    assert_string_equal(demo_list[0]->name, "turntable"); /* what an image starts with */
    for (uint32_t i = 0; i < demo_count; i++) {
        assert_ptr_equal(demo_find(demo_list[i]->name), demo_list[i]);
        assert_true(strlen(demo_list[i]->summary) > 10 && strlen(demo_list[i]->summary) < 100);
        assert_null(strchr(demo_list[i]->summary, '\n'));
        assert_true(demo_list[i]->loop_frames > 0);
    }
    assert_null(demo_find("tor"));
    assert_null(demo_find("torus "));
}

/* ---- budgets --------------------------------------------------------------------------------------------------- */

/* Draws the loop of a view at one size and notes the largest numbers. */
static void measure(const struct demo *demo, const char *view, const uint16_t size[2], uint32_t step,
                    uint32_t *vertices, uint32_t *triangles)
{
    struct demo_stage s = demo_stage_open(demo, size[0], size[1]);
    s.context.view = view;
    for (uint32_t frame = 0; frame < demo->loop_frames; frame += step) {
        assert_int_equal(demo->frame(&s.context, &s.rig.r, frame), PH_OK);
        const struct ph_stats *const stats = &s.rig.r.stats;
        if (stats->triangles_dropped || stats->vertices_dropped) {
            fail_msg("%s %s drops at %ux%u, frame %u", demo->name, view ? view : "", size[0], size[1], frame);
        }
        *triangles = stats->triangles_drawn > *triangles ? stats->triangles_drawn : *triangles;
        *vertices = stats->vertices > *vertices ? stats->vertices : *vertices;
    }
    demo_stage_close(&s);
}

static void nothing_is_dropped_on_any_picture_and_budgets_are_not_wasteful(void **state)
{
    (void)state;
    static const uint16_t widest[2] = {1024, 64};
    static const char *const only[] = {NULL, NULL};
    for (uint32_t d = 0; d < demo_count; d++) {
        const char *const *const views = demo_list[d]->views ? demo_list[d]->views : only;
        uint32_t vertices = 0;
        uint32_t triangles = 0;
        for (size_t v = 0; v == 0 || views[v]; v++) {
            for (size_t i = 0; i <= SIZES; i++) {
                const bool closely = i == 0 || i == SIZES;
                measure(demo_list[d], views[v], i < SIZES ? sizes[i] : widest, closely ? 2 : 7, &vertices, &triangles);
            }
        }
        if (demo_list[d]->triangle_max > triangles * 3 / 2) {
            fail_msg("%s draws %u triangles", demo_list[d]->name, triangles);
        }
        assert_true(demo_list[d]->vertex_max <= vertices);
    }
}

static void the_arena_is_never_exceeded(void **state)
{
    (void)state;
    for (uint32_t d = 0; d < demo_count; d++) {
        for (size_t size = 0; size <= demo_list[d]->arena_bytes; size += demo_list[d]->arena_bytes / 64 / 8 * 8 + 8) {
            struct demo_context context = {.width = 240, .height = 135};
            uint8_t *const memory = malloc(size + 256);
            assert_non_null(memory);
            memset(memory, 0xA5, size + 256);
            context.arena = (struct demo_arena){memory, size, 0};
            const int status = demo_list[d]->init(&context);
            assert_true(status == PH_OK || status == PH_ERR_NOMEM);
            assert_true(context.arena.used <= size);
            for (size_t i = 0; i < 256; i++) {
                assert_int_equal(memory[size + i], 0xA5);
            }
            free(memory);
        }
    }
}

/* With two thirds of the arena a demo does not start, or it shows a coarser model. */
static void the_stated_arena_is_not_wasteful(void **state)
{
    (void)state;
    for (uint32_t d = 0; d < demo_count; d++) {
        struct demo_stage s = demo_stage_open(demo_list[d], 240, 240);
        demo_stage_frame(&s, 0);
        const uint32_t vertices = s.rig.r.stats.vertices;
        s.context.arena.used = 0;
        s.context.arena.size = s.demo->arena_bytes * 2 / 3;
        if (s.demo->init(&s.context) == PH_OK) {
            demo_stage_frame(&s, 0);
            assert_true(s.rig.r.stats.vertices < vertices);
        }
        demo_stage_close(&s);
    }
}

/* Draws the whole loop with a level's memory. Returns the vertices of a frame. */
static uint32_t vertices_at(const struct demo *demo, const struct demo_level *level, uint16_t width, uint16_t height)
{
    struct demo_context context = {.width = width, .height = height};
    struct rig rig;
    context.arena = (struct demo_arena){malloc(level->arena_bytes), level->arena_bytes, 0};
    rig_open(&rig, width, height, height, PH_DEPTH_FIXED16, (int)level->vertex_max, (int)level->triangle_max);
    assert_int_equal(demo->init(&context), PH_OK);
    for (uint32_t frame = 0; frame < demo->loop_frames; frame += 5) {
        assert_int_equal(demo->frame(&context, &rig.r, frame), PH_OK);
        assert_int_equal(rig.r.stats.triangles_dropped, 0);
    }
    const uint32_t vertices = rig.r.stats.vertices;
    free(context.arena.base);
    rig_close(&rig);
    return vertices;
}

static void each_level_of_a_demo_is_coarser_and_fits_its_lists(void **state)
{
    (void)state;
    static const uint16_t kits[][2] = {{240, 135}, {240, 240}, {320, 240}, {128, 128}, {128, 64}};
    uint32_t levels = 0;
    for (uint32_t d = 0; d < demo_count; d++) {
        const struct demo *const demo = demo_list[d];
        const struct demo_level finest = {.arena_bytes = demo->arena_bytes,
                                          .vertex_max = demo->vertex_max,
                                          .triangle_max = demo->triangle_max,
                                          .corner_max = demo->corner_max};
        const struct demo_level *finer = &finest;
        for (uint32_t i = 0; i < demo->coarser_count; finer = &demo->coarser[i++], levels++) {
            const struct demo_level *const level = &demo->coarser[i];
            const uint32_t bytes = demo_arena_bytes_32(demo, i + 1);
            assert_true(bytes > 0 && bytes <= level->arena_bytes);
            assert_true(level->triangle_max < finer->triangle_max && level->arena_bytes <= finer->arena_bytes);
            for (uint32_t size = 0; size < sizeof kits / sizeof kits[0]; size++) {
                const bool least = i + 1 == demo->coarser_count && strcmp(demo->name, "fisheye") == 0;
                if (least && size != 4) { /* its triangles become more with the size: it is for a small picture */
                    continue;
                }
                const uint32_t vertices = vertices_at(demo, level, kits[size][0], kits[size][1]);
                const uint32_t before = vertices_at(demo, finer, kits[size][0], kits[size][1]);
                assert_true(level->arena_bytes < finer->arena_bytes ? vertices < before : vertices == before);
            }
        }
        assert_true(demo_arena_bytes_32(demo, 0) > 0 && demo_arena_bytes_32(demo, 0) <= demo->arena_bytes);
    }
    assert_true(levels >= 30); /* sixteen of them for a kit with little memory or a small picture */
}

/* ---- animation ------------------------------------------------------------------------------------------------- */

static void a_loop_ends_where_it_began(void **state)
{
    (void)state;
    for (uint32_t d = 0; d < demo_count; d++) {
        struct demo_stage s = demo_stage_open(demo_list[d], 120, 100);
        const uint32_t first = demo_stage_frame(&s, 0);
        const uint32_t middle = demo_stage_frame(&s, s.demo->loop_frames / 2);
        const uint32_t last = demo_stage_frame(&s, s.demo->loop_frames - 1);
        assert_true((first != middle && first != last) || s.demo->loop_frames == 1);
        assert_int_equal(demo_stage_frame(&s, s.demo->loop_frames), first);
        assert_int_equal(demo_stage_frame(&s, 2 * s.demo->loop_frames - 1), last);
        assert_int_equal(demo_stage_frame(&s, 0u - s.demo->loop_frames), first);
        assert_int_equal(demo_stage_frame(&s, 0), first); /* whatever was drawn before */
        demo_stage_close(&s);
    }
}

/* Green of a pixel in wire order, 0 .. 63. */
static int green(uint16_t wire)
{
    uint8_t bytes[2];
    memcpy(bytes, &wire, 2);
    return (bytes[0] & 7) << 3 | bytes[1] >> 5;
}

/* The change of the green of all pixels from one frame to the next, summed up. */
static uint32_t change(struct demo_stage *s, uint32_t from)
{
    const size_t pixels = (size_t)s->rig.width * (size_t)s->rig.height;
    uint16_t *const before = malloc(2 * pixels);
    assert_non_null(before);
    demo_stage_frame(s, from);
    memcpy(before, s->rig.pixels, 2 * pixels);
    demo_stage_frame(s, from + 1);
    uint32_t changed = 0;
    for (size_t i = 0; i < pixels; i++) {
        changed += (uint32_t)abs(green(before[i]) - green(s->rig.pixels[i]));
    }
    free(before);
    return changed;
}

static void a_loop_has_no_jump(void **state)
{
    (void)state;
    for (uint32_t d = 0; d < demo_count; d++) {
        struct demo_stage s = demo_stage_open(demo_list[d], 120, 100);
        const uint32_t loop = s.demo->loop_frames;
        uint32_t usual = 0;
        for (uint32_t frame = 0; frame + 1 < loop; frame += 8) {
            const uint32_t now = change(&s, frame);
            usual = now > usual ? now : usual;
        }
        assert_true(change(&s, loop - 1) <= usual * 5 / 4);
        assert_true(change(&s, loop / 2 - (loop > 1)) <= usual * 5 / 4);
        demo_stage_close(&s);
    }
}

/* ---- cameras ----------------------------------------------------------------------------------------------------- */

static void a_given_camera_replaces_the_demo_s_own(void **state)
{
    (void)state;
    const struct fx_vec3 eye = {FX_INT(3), FX_INT(4), FX_INT(5)};
    const struct fx_vec3 target = {0, 0, -FX_ONE};
    for (uint32_t d = 0; d < demo_count; d++) {
        struct demo_stage s = demo_stage_open(demo_list[d], 160, 120);
        const uint32_t own = demo_stage_frame(&s, 3);
        s.context.camera.view = ph_view_look_at(eye, target, (struct fx_vec3){0, FX_ONE, 0});
        assert_int_equal(
            ph_projection_perspective(&s.context.camera.projection, FX_INT(35), 4 * FX_ONE / 3, FX_ONE / 8, FX_INT(50)),
            PH_OK);
        assert_int_equal(demo_stage_frame(&s, 3), own);
        s.context.camera.view_set = true;
        const uint32_t moved = demo_stage_frame(&s, 3);
        s.context.camera.view_set = false;
        s.context.camera.projection_set = true;
        const uint32_t zoomed = demo_stage_frame(&s, 3);
        assert_true(moved != own);
        assert_true(strcmp(s.demo->name, "fill") == 0 || zoomed != own); /* it fills a smaller view as well */
        demo_stage_close(&s);
    }
}

/* The outermost pixels show the background; those below only if asked for. */
static void assert_inside(const struct demo_stage *s, bool below_too)
{
    const int w = s->rig.width;
    const int h = s->rig.height;
    const uint16_t background = s->rig.r.background;
    for (int x = 0; x < w; x++) {
        assert_int_equal(pixel(s, x, 0), background);
        assert_true(!below_too || pixel(s, x, h - 1) == background);
    }
    for (int y = 0; y < h * 3 / 4; y++) {
        assert_int_equal(pixel(s, 0, y), background);
        assert_int_equal(pixel(s, w - 1, y), background);
    }
}

static void the_subject_fits_into_upright_and_square_pictures(void **state)
{
    (void)state;
    static const char *const names[] = {"turntable", "torus", "icosphere", "wireframe"};
    static const uint16_t upright[][2] = {{240, 240}, {135, 240}, {80, 160}, {170, 320}};
    for (size_t i = 0; i < 16; i++) {
        struct demo_stage s = demo_stage_open(demo_find(names[i / 4]), upright[i % 4][0], upright[i % 4][1]);
        for (uint32_t frame = 0; frame < s.demo->loop_frames; frame += 16) {
            demo_stage_frame(&s, frame);
            assert_inside(&s, true);
        }
        demo_stage_close(&s);
    }
}

static void the_teapot_stays_whole_in_wide_pictures(void **state)
{
    (void)state;
    static const uint16_t wide[][2] = {{128, 64}, {240, 135}, {320, 240}, {320, 170}};
    for (size_t i = 0; i < 8; i++) {
        struct demo_stage s =
            demo_stage_open(demo_find(i < 4 ? "turntable" : "wireframe"), wide[i % 4][0], wide[i % 4][1]);
        for (uint32_t frame = 0; frame < 256; frame += 8) {
            demo_stage_frame(&s, frame);
            assert_inside(&s, i >= 4); /* the platter may be cut below */
        }
        demo_stage_close(&s);
    }
}

/* The turntable with a box of the given half sizes, `shift` away from the origin. */
static void assert_box_fits(uint16_t width, uint16_t height, fx_t x, fx_t y, fx_t z, fx_t shift)
{
    uint8_t memory[MODEL_CUBE_BYTES + DEMO_TURNTABLE_BYTES + 64];
    struct fx_vec3 corners[24];
    struct demo_stage s = {.context = {.width = width, .height = height, .arena = {memory, sizeof(memory), 0}}};
    const struct demo box = {.frame = demo_turntable_frame};
    const struct ph_material material = {.shading = PH_SHADE_UNLIT, .colour = 0xFFFF};
    struct ph_mesh mesh;
    s.demo = &box;
    assert_int_equal(model_cube(&s.context.arena, &mesh), PH_OK);
    assert_int_equal(model_material(&s.context.arena, &mesh, &material), PH_OK);
    for (uint32_t i = 0; i < 24; i++) {
        corners[i].x = (mesh.positions[i].x > 0 ? x : -x) + shift;
        corners[i].y = (mesh.positions[i].y > 0 ? y : -y) + shift;
        corners[i].z = (mesh.positions[i].z > 0 ? z : -z) + shift;
    }
    mesh.positions = corners;
    const struct fx_vec3 centre = {shift, shift, shift};
    assert_int_equal(demo_turntable_init(&s.context, &mesh, 1, centre), PH_OK);
    rig_open(&s.rig, width, height, height, PH_DEPTH_FIXED16, DEMO_TURNTABLE_VERTICES, 12 + DEMO_TURNTABLE_TRIANGLES);
    int widest = 0, highest = 0;
    for (uint32_t frame = 0; frame < 256; frame += 8) {
        int h;
        demo_stage_frame(&s, frame);
        assert_inside(&s, false);
        for (int column = 0; column < width; column++) { /* the platter may be cut here, the box not */
            assert_true(pixel(&s, column, height - 1) != material.colour);
        }
        assert_int_equal(s.rig.r.stats.triangles_clipped, 0);
        assert_int_equal(s.rig.r.stats.triangles_dropped, 0);
        const int w = drawn_width(&s, &h);
        widest = w > widest ? w : widest;
        highest = h > highest ? h : highest;
    }
    if (widest < width * 2 / 3 && highest < height * 2 / 3) {
        fail_msg("box %d %d %d fills only %dx%d of %ux%u", x, y, z, widest, highest, width, height);
    }
    rig_close(&s.rig);
}

static void any_model_fills_the_turntable_s_picture_and_fits(void **state)
{
    (void)state;
    for (size_t i = 0; i < SIZES; i++) {
        const uint16_t w = sizes[i][0];
        const uint16_t h = sizes[i][1];
        assert_box_fits(w, h, FX_ONE, FX_ONE, FX_ONE, 0);
        assert_box_fits(w, h, FX_ONE / 10, FX_INT(3), FX_ONE / 10, FX_INT(7));    /* a pole */
        assert_box_fits(w, h, FX_INT(2), FX_ONE / 20, FX_INT(3), -FX_INT(2));     /* a plate */
        assert_box_fits(w, h, FX_INT(1500), FX_INT(900), FX_INT(1500), FX_ONE);   /* huge */
        assert_box_fits(w, h, FX_ONE / 50, FX_ONE / 70, FX_ONE / 40, FX_ONE / 4); /* tiny */
    }
}

/* Empty rows above and below in the middle column over a whole turn. */
static void margins(struct demo_stage *s, int *above, int *below)
{
    *above = *below = s->rig.height;
    for (uint32_t frame = 0; frame < 256; frame += 8) {
        int y = 0;
        demo_stage_frame(s, frame);
        while (y < *above && pixel(s, s->rig.width / 2, y) == s->rig.r.background) {
            y++;
        }
        *above = y;
        y = 0;
        while (y < *below && pixel(s, s->rig.width / 2, s->rig.height - 1 - y) == s->rig.r.background) {
            y++;
        }
        *below = y;
    }
}

static void pot_and_platter_stand_in_the_middle_of_a_tall_picture(void **state)
{
    (void)state;
    static const uint16_t tall[][2] = {{240, 240}, {135, 240}, {128, 160}};
    for (size_t i = 0; i < 3; i++) {
        int above, below;
        struct demo_stage s = demo_stage_open(demo_find("turntable"), tall[i][0], tall[i][1]);
        margins(&s, &above, &below);
        if (abs(above - below) > tall[i][1] / 12) {
            fail_msg("%d rows above, %d below at %ux%u", above, below, tall[i][0], tall[i][1]);
        }
        demo_stage_close(&s);
    }
}

/* ---- the test card
 * --------------------------------------------------------------------------------------------------- */

#define WHITE ph_rgb565(255, 255, 255)

static void the_frame_line_covers_exactly_the_outermost_pixels(void **state)
{
    (void)state;
    for (size_t i = 0; i < SIZES; i++) {
        struct demo_stage s = demo_stage_open(demo_find("testcard"), sizes[i][0], sizes[i][1]);
        demo_stage_frame(&s, 0);
        const int w = s.rig.width;
        const int h = s.rig.height;
        for (int x = 0; x < w; x++) {
            assert_true(pixel(&s, x, 0) == WHITE && pixel(&s, x, h - 1) == WHITE);
            assert_true(x == 0 || x == w - 1 || (pixel(&s, x, 1) == 0 && pixel(&s, x, h - 2) == 0));
        }
        for (int y = 1; y < h - 1; y++) {
            assert_true(pixel(&s, 0, y) == WHITE && pixel(&s, w - 1, y) == WHITE);
            assert_true(pixel(&s, 1, y) == 0 && pixel(&s, w - 2, y) == 0);
        }
        demo_stage_close(&s);
    }
}

/* White runs along row y from x0 to x1. */
static int runs(const struct demo_stage *s, int y, int x0, int x1)
{
    int count = 0;
    for (int x = x0; x < x1; x++) {
        count += pixel(s, x, y) == WHITE && pixel(s, x - 1, y) != WHITE;
    }
    return count;
}

/* Dots towards a corner: the most runs of any row in the outer seventh. Above, the ring begins in the middle third. */
static int dots(const struct demo_stage *s, bool right, bool low)
{
    const int w = s->rig.width;
    const int h = s->rig.height;
    const int from = low ? h - 2 - h / 7 : 2;
    const int across = low ? w / 2 : w / 3;
    int most = 0;
    for (int y = from; y < from + h / 7; y++) {
        const int n = right ? runs(s, y, w - across, w - 1) : runs(s, y, 2, across);
        most = n > most ? n : most;
    }
    return most;
}

static void the_corners_count_clockwise_from_the_top_left(void **state)
{
    (void)state;
    for (size_t i = 0; i < SIZES; i++) {
        struct demo_stage s = demo_stage_open(demo_find("testcard"), sizes[i][0], sizes[i][1]);
        demo_stage_frame(&s, 0);
        assert_int_equal(dots(&s, false, false), 1);
        assert_int_equal(dots(&s, true, false), 2);
        assert_int_equal(dots(&s, true, true), 3);
        assert_int_equal(dots(&s, false, true), 4);
        demo_stage_close(&s);
    }
}

static void the_bars_are_red_green_blue_white_grey_from_the_left(void **state)
{
    (void)state;
    const uint16_t want[7] = {
        0, ph_rgb565(255, 0, 0), ph_rgb565(0, 255, 0), ph_rgb565(0, 0, 255), WHITE, ph_rgb565(128, 128, 128), 0};
    for (size_t i = 0; i < SIZES; i++) {
        struct demo_stage s = demo_stage_open(demo_find("testcard"), sizes[i][0], sizes[i][1]);
        demo_stage_frame(&s, 0);
        const int y = s.rig.height * 75 / 100;
        int bar = 0;
        for (int x = 1; x < s.rig.width - 1; x++) {
            bar += pixel(&s, x, y) != want[bar];
            assert_true(bar < 7);
            assert_int_equal(pixel(&s, x, y), want[bar]);
        }
        assert_int_equal(bar, 6);
        demo_stage_close(&s);
    }
}

static void a_round_glass_hides_no_dot_and_no_bar(void **state)
{
    (void)state;
    struct demo_stage s = demo_stage_open(demo_find("testcard"), 240, 240);
    demo_stage_frame(&s, 0);
    for (int i = 0; i < 240 * 240; i++) {
        const int x = 2 * (i % 240) - 239;
        const int y = 2 * (i / 240) - 239;
        const bool framed = abs(x) < 239 && abs(y) < 239;
        assert_true(!framed || s.rig.pixels[i] == 0 || x * x + y * y < 240 * 240);
    }
    demo_stage_close(&s);
}

/* The length from the first to the last white one of n pixels to the right or down; *middle is half way. */
static int white_extent(const struct demo_stage *s, int x, int y, bool across, int n, int *middle)
{
    int first = -1, last = -1;
    for (int i = 0; i < n; i++) {
        if (pixel(s, across ? x + i : x, across ? y : y + i) == WHITE) {
            first = first < 0 ? i : first;
            last = i;
        }
    }
    *middle = (across ? x : y) + (first + last) / 2;
    return last - first + 1;
}

static void the_ring_is_round_and_the_arrow_points_up(void **state)
{
    (void)state;
    static const uint16_t big[][2] = {{240, 240}, {320, 240}, {135, 240}, {320, 480}};
    for (size_t i = 0; i < 4; i++) {
        struct demo_stage s = demo_stage_open(demo_find("testcard"), big[i][0], big[i][1]);
        int x, y;
        demo_stage_frame(&s, 0);
        const int centre = s.rig.height * 36 / 100;
        const int across = white_extent(&s, 2, centre, true, s.rig.width - 4, &x);
        const int down = white_extent(&s, s.rig.width / 2, 2, false, s.rig.height * 65 / 100 - 2, &y);
        const int radius = across / 2;
        assert_true(abs(across - down) <= 1 && abs(x - s.rig.width / 2) <= 1 && abs(y - centre) <= 1);
        /* The head is wide just above the middle, the shaft narrow below it. */
        assert_int_equal(pixel(&s, s.rig.width / 2 - radius / 3, centre - 3), WHITE);
        assert_int_equal(pixel(&s, s.rig.width / 2 - radius / 3, centre + 3), 0);
        assert_int_equal(pixel(&s, s.rig.width / 2, centre + radius / 3), WHITE);
        demo_stage_close(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(demos_are_found_by_name),
        cmocka_unit_test(nothing_is_dropped_on_any_picture_and_budgets_are_not_wasteful),
        cmocka_unit_test(the_arena_is_never_exceeded),
        cmocka_unit_test(the_stated_arena_is_not_wasteful),
        cmocka_unit_test(each_level_of_a_demo_is_coarser_and_fits_its_lists),
        cmocka_unit_test(a_loop_ends_where_it_began),
        cmocka_unit_test(a_loop_has_no_jump),
        cmocka_unit_test(a_given_camera_replaces_the_demo_s_own),
        cmocka_unit_test(the_subject_fits_into_upright_and_square_pictures),
        cmocka_unit_test(the_teapot_stays_whole_in_wide_pictures),
        cmocka_unit_test(any_model_fills_the_turntable_s_picture_and_fits),
        cmocka_unit_test(pot_and_platter_stand_in_the_middle_of_a_tall_picture),
        cmocka_unit_test(the_frame_line_covers_exactly_the_outermost_pixels),
        cmocka_unit_test(the_corners_count_clockwise_from_the_top_left),
        cmocka_unit_test(the_bars_are_red_green_blue_white_grey_from_the_left),
        cmocka_unit_test(a_round_glass_hides_no_dot_and_no_bar),
        cmocka_unit_test(the_ring_is_round_and_the_arrow_points_up),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
