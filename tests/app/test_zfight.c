/*
 * zfight: where blue shows through yellow. From the definition of the formats: a fixed16 code at the distance z is
 * worth z^2 / (65536 near); the plates are 1/64 apart. So with near at .25 it cannot confuse them up to 10 (.0061, two
 * codes and a half), and must from 20 on (.0244). A float16 with a mantissa of 12 bits is worth at most z / 4096: never
 * 1/64.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "demo_stage.h"

#include <string.h>

#define PAIRS 6

#define BLUE   ph_rgb565(40, 80, 230)
#define YELLOW ph_rgb565(250, 205, 60)

/* The runs of columns, or of rows, of a picture in which a side has plates in some frame: first and end of each. */
struct runs {
    int count, from[PAIRS], to[PAIRS];
};

static struct runs runs_of(const bool *has, int n)
{
    struct runs runs = {0};
    for (int i = 0; i < n; i++) {
        if (has[i] && (i == 0 || !has[i - 1])) {
            assert_true(runs.count < PAIRS);
            runs.from[runs.count++] = i;
        }
        if (has[i]) {
            runs.to[runs.count - 1] = i + 1;
        }
    }
    return runs;
}

/* Pixels of both colours on both sides, of each pair, in some frames. */
struct counts {
    uint32_t blue[2][PAIRS], yellow[2][PAIRS];
};

/* Adds those of a side, where its plates stand in rows and columns. */
static void add(const struct demo_stage *s, int side, const struct runs *columns, const struct runs *rows,
                struct counts *counts)
{
    for (int i = 0; i < PAIRS; i++) {
        const int column = i % columns->count, row = i / columns->count;
        for (int y = rows->from[row]; y < rows->to[row]; y++) {
            for (int x = columns->from[column]; x < columns->to[column]; x++) {
                counts->blue[side][i] += pixel(s, x, y) == BLUE;
                counts->yellow[side][i] += pixel(s, x, y) == YELLOW;
            }
        }
    }
}

static struct counts count(struct demo_stage *s)
{
    static bool across[2][480], down[480];
    struct counts counts = {0};
    const int w = s->rig.width, h = s->rig.height, middle = w - w / 2;
    memset(across, 0, sizeof across);
    memset(down, 0, sizeof down);
    for (uint32_t frame = 0; frame < 256; frame += 32) {
        demo_stage_frame(s, frame);
        for (int i = 0; i < w * h; i++) {
            const bool plate = s->rig.pixels[i] == BLUE || s->rig.pixels[i] == YELLOW;
            across[i % w >= middle][i % w] |= plate;
            down[i / w] |= plate;
        }
    }
    for (int side = 0; side < 2; side++) {
        const struct runs columns = runs_of(across[side], w), rows = runs_of(down, h);
        assert_int_equal(columns.count * rows.count, PAIRS);
        for (uint32_t frame = 0; frame < 256; frame += 32) {
            demo_stage_frame(s, frame);
            add(s, side, &columns, &rows, &counts);
        }
    }
    return counts;
}

static void fixed16_fights_beside_float16_on_every_panel(void **state)
{
    (void)state;
    static const uint16_t sizes[][2] = {{240, 240}, {135, 240}, {80, 160},  {160, 80},  {128, 64},
                                        {320, 240}, {128, 128}, {320, 480}, {240, 135}, {121, 99}};
    static const struct ph_depth_format *const formats[2] = {PH_DEPTH_FIXED16, PH_DEPTH_FLOAT16};
    for (size_t i = 0; i < 2 * sizeof sizes / sizeof sizes[0]; i++) {
        const uint16_t *const size = sizes[i / 2];
        struct demo_stage s = demo_stage_open(demo_find("zfight"), size[0], size[1]);
        s.rig.r.config.depth_format = formats[i % 2];
        const struct counts counts = count(&s);
        const int at = i % 2; /* fixed16's side */
        for (int pair = 0; pair < PAIRS; pair++) {
            const uint32_t fights = counts.blue[at][pair], whole = counts.yellow[at][pair];
            const uint32_t calm = counts.blue[!at][pair], also = counts.yellow[!at][pair];
            if (calm != 0 || (pair < 3 ? fights != 0 : fights * 20 < fights + whole) || whole + fights < also / 2) {
                fail_msg("pair %d at %ux%u: %u blue beside %u yellow in fixed16, %u in float16", pair, size[0], size[1],
                         fights, whole, calm);
            }
        }
        demo_stage_close(&s);
    }
}

/* Both sides show the same plates where they do not fight, in pictures of even width, and in every other format. */
static void the_sides_differ_by_the_fight_alone(void **state)
{
    (void)state;
    const struct demo *const demo = demo_find("zfight");
    for (int f = 1; f < PH_DEPTH_FORMATS; f++) {
        const struct ph_depth_format *const format = ph_depth_formats[f];
        struct demo_stage s = demo_stage_open(demo, 240, 160);
        rig_close(&s.rig);
        rig_open(&s.rig, 240, 160, 7, format, (int)demo->vertex_max, (int)demo->triangle_max);
        demo_stage_frame(&s, 77);
        const uint16_t dark = s.rig.r.background;
        for (int i = 0; i < 120 * 160; i++) {
            const int x = i % 120, y = i / 120;
            if (pixel(&s, x, y) != 0 && pixel(&s, x + 120, y) != 0 && pixel(&s, x, y) != 0xFFFF &&
                pixel(&s, x + 120, y) != 0xFFFF) { /* no label */
                assert_true((pixel(&s, x, y) == dark) == (pixel(&s, x + 120, y) == dark));
            }
        }
        demo_stage_close(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fixed16_fights_beside_float16_on_every_panel),
        cmocka_unit_test(the_sides_differ_by_the_fight_alone),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
