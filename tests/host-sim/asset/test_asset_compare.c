/* asset_compare: the sides and moments that both models are drawn at, and what counts as off. The demo, whose pictures
 * are known pixel by pixel, is the test's own. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "asset_compare.h"
#include "complain.h"
#include "made_asset.h"
#include "stderr_capture.h"

#include <string.h>

enum { WIDTH = 10, HEIGHT = 4 };

static const struct model *before; /* the model that was simplified; the other one is the asset's */
static uint16_t of_before, of_after, behind;
static uint32_t only_side, seen[2], fails_at; /* ASSET_SIDES: all sides */
static struct demo_studio studio;

static int init(struct demo_context *context)
{
    assert_int_equal(context->arena.size, 4096 - (DEMO_TURNTABLE_BYTES - DEMO_TURNTABLE_BARE_BYTES));
    assert_false(((const struct model *)context->state)->has_camera);
    return 0;
}

static bool is_before(const struct demo_context *context)
{
    return ((const struct model *)context->state)->meshes == before->meshes;
}

static int frame(struct demo_context *context, struct ph_renderer *r, uint32_t number)
{
    const uint32_t side = seen[is_before(context)]++;
    assert_true(context->width == WIDTH && context->height == HEIGHT && r->config.band_height == HEIGHT);
    assert_int_equal(number, before->motion != NULL ? side * 90 / 8 : 0); /* 90 frames of a clip of 3 s */
    assert_int_equal(context->orbit, (side << 29) + (number << 24));
    return side == fails_at ? PH_ERR_INVAL : 0;
}

/* Half of the picture is background; 5 of the other 20 pixels have the colour that differs. */
static uint32_t draw_band(struct demo_context *context, struct ph_renderer *r, uint32_t band, uint16_t *pixels)
{
    const bool first = is_before(context);
    assert_int_equal(band, 0);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        pixels[i] = i < 20 ? behind : ph_rgb565(200, 200, 200);
    }
    for (int i = 20; i < 25 && (only_side == ASSET_SIDES || only_side == seen[first] - 1); i++) {
        pixels[i] = first ? of_before : of_after;
    }
    (void)r;
    return HEIGHT;
}

struct demo model_demo(const struct model *model)
{
    (void)model;
    return (struct demo){.name = "model",
                         .arena_bytes = 4096,
                         .vertex_max = 100,
                         .triangle_max = 100,
                         .init = init,
                         .frame = frame,
                         .band = draw_band};
}

static int compare_made(bool moves, double *share)
{
    static struct model model;
    static struct ph_mesh other;
    const struct asset *const asset = made_asset(moves);
    model = asset->model;
    model.meshes = &other;
    model.has_camera = true;
    model.studio = studio.background != 0 ? &studio : NULL;
    before = &model;
    seen[0] = seen[1] = 0;
    return asset_compare(asset, &model, WIDTH, HEIGHT, share);
}

/* The share that is off where one colour becomes another one. */
static double share_of(uint16_t from, uint16_t to)
{
    double share;
    of_before = from;
    of_after = to;
    assert_int_equal(compare_made(false, &share), 0);
    assert_true(seen[0] == 8 && seen[1] == 8);
    return share;
}

static int begin(void **state)
{
    (void)state;
    only_side = fails_at = ASSET_SIDES;
    behind = DEMO_MODEL_BACKGROUND;
    studio.background = 0;
    return 0;
}

/* In steps of 255/31 and 255/63: 41 is off, 32 and 40 are not. */
static void a_channel_may_be_40_of_255_off(void **state)
{
    (void)state;
    assert_true(share_of(ph_rgb565(0, 0, 0), ph_rgb565(0, 0, 0)) == 0);
    assert_true(share_of(ph_rgb565(0, 0, 0), ph_rgb565(33, 0, 0)) == 0); /* 4/31: 32 */
    assert_true(share_of(ph_rgb565(0, 0, 0), ph_rgb565(41, 0, 0)) == .25);
    assert_true(share_of(ph_rgb565(0, 41, 0), ph_rgb565(0, 0, 0)) == 0); /* 10/63: 40 */
    assert_true(share_of(ph_rgb565(0, 45, 0), ph_rgb565(0, 0, 0)) == .25);
    assert_true(share_of(ph_rgb565(0, 0, 255), ph_rgb565(0, 0, 222)) == 0);
    assert_true(share_of(ph_rgb565(0, 0, 255), ph_rgb565(0, 0, 214)) == .25);
    assert_true(share_of(ph_rgb565(0, 0, 214), ph_rgb565(0, 0, 255)) == .25);
}

static void all_sides_count_alike(void **state)
{
    (void)state;
    for (only_side = 0; only_side < ASSET_SIDES; only_side++) {
        assert_true(share_of(ph_rgb565(255, 0, 0), ph_rgb565(0, 0, 0)) == .25 / 8);
    }
}

/* The pixels that show the model before or after are the whole. */
static void background_is_no_part_of_the_model(void **state)
{
    (void)state;
    const double gone = share_of(ph_rgb565(255, 0, 0), behind), come = share_of(behind, ph_rgb565(255, 0, 0));
    assert_true(gone == .25 && come == .25);
    assert_true(share_of(behind, behind) == 0);
    behind = studio.background = ph_rgb565(0, 200, 0);
    assert_true(share_of(ph_rgb565(255, 0, 0), behind) == .25);
}

static void what_moves_is_seen_at_other_moments(void **state)
{
    double share;
    (void)state;
    of_before = of_after = 0;
    assert_int_equal(compare_made(true, &share), 0);
    assert_true(share == 0 && seen[0] == 8);
}

static void an_error_is_told(void **state)
{
    struct stderr_capture said;
    double share;
    (void)state;
    fails_at = 3;
    stderr_capture_begin(&said);
    const int status = compare_made(false, &share);
    stderr_capture_end(&said);
    assert_int_equal(status, COMPLAINED);
    assert_non_null(strstr(said.text, "cannot be drawn"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(a_channel_may_be_40_of_255_off, begin),
        cmocka_unit_test_setup(all_sides_count_alike, begin),
        cmocka_unit_test_setup(background_is_no_part_of_the_model, begin),
        cmocka_unit_test_setup(what_moves_is_seen_at_other_moments, begin),
        cmocka_unit_test_setup(an_error_is_told, begin),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
