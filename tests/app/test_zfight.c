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

#define PAIRS 6

/* Columns of pairs on a side: those that give the largest cells, one more row being left for the label. */
static int columns_on(int width, int height)
{
    int best = 1;
    double most = 0;
    for (int columns = 1; columns <= 3; columns++) {
        const double across = (double)width / columns, down = (double)height / (PAIRS / columns + 1);
        const double cell = across < down ? across : down;
        best = cell > most ? columns : best;
        most = cell > most ? cell : most;
    }
    return best;
}

/* Counts blue and yellow pixels of a pair on a side that begins at column x0. */
static void count(const struct demo_stage *s, int x0, int pair, uint32_t *blue, uint32_t *yellow)
{
    const uint16_t colours[2] = {ph_rgb565(40, 80, 230), ph_rgb565(250, 205, 60)};
    const int w = s->rig.width / 2, h = s->rig.height, columns = columns_on(w + 1, h), rows = PAIRS / columns + 1;
    const int column = pair % columns, row = pair / columns + 1;
    for (int y = row * h / rows; y < (row + 1) * h / rows; y++) {
        for (int x = x0 + column * w / columns; x < x0 + (column + 1) * w / columns; x++) {
            *blue += pixel(s, x, y) == colours[0];
            *yellow += pixel(s, x, y) == colours[1];
        }
    }
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
        const int middle = size[0] - size[0] / 2;
        for (int pair = 0; pair < PAIRS; pair++) {
            uint32_t fights = 0, whole = 0, calm = 0, also = 0;
            for (uint32_t frame = 0; frame < 256; frame += 32) {
                demo_stage_frame(&s, frame);
                count(&s, i % 2 ? middle : 0, pair, &fights, &whole);
                count(&s, i % 2 ? 0 : middle, pair, &calm, &also);
            }
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
            if (y > 20) { /* below the labels */
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
