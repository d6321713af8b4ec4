/* sim_options: command lines of pinhole-sim, right ones by what they set and wrong ones by what is said; and the lens
 * that its options make, worked out by hand. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "sim_options.h"
#include "stderr_capture.h"
#include "words.h"

#include <string.h>

static struct sim_options o;
static struct stderr_capture said;

static int read_line(const char *line)
{
    char *words[WORDS_MAX];
    const int count = words_of(line, words);
    stderr_capture_begin(&said);
    const int status = sim_options_read(&o, count, words);
    stderr_capture_end(&said);
    return status;
}

static void take(const char *line)
{
    const int status = read_line(line);
    assert_string_equal(said.text, "");
    assert_int_equal(status, 0);
}

static void what_is_not_given_has_its_default(void **state)
{
    (void)state;
    take("--crc");
    assert_true(o.action == OPTION_RUN && o.crc && o.demo == NULL && o.model == NULL && o.board == NULL &&
                o.view == NULL);
    assert_true(o.frames == 1 && o.start == 0 && o.scale == 0 && o.tolerance == 0 && o.band == 0 && o.width == 0);
    assert_true(!o.stats && !o.json && !o.overlay && !o.antialias && !o.dither && !o.matrix && !o.show_window &&
                !o.rotate_set);
    assert_true(o.near_z == FX_HALF && o.far_z == FX_INT(100) && o.fov_deg == 0 && o.focal == 0);
    assert_true(o.image_height == FX_INT(2) && !o.projection_set && !o.camera.set && o.convention == PH_GL);
    assert_true(!o.goal_set && o.goal.triangles == UINT32_MAX && !o.goal.fit && o.goal.flash_bytes == UINT32_MAX);
    take("--window");
    assert_int_equal(o.frames, UINT32_MAX); /* until it is closed */
    take("--window --frames 3");
    assert_int_equal(o.frames, 3);
}

static void each_option_sets_its_own(void **state)
{
    (void)state;
    take("--demo a --view b --board c --out d --check e --difference f.png --keys g --start 7 --frames 8 --scale 9 "
         "--tolerance 10 --band 11 --rotate 270 --stats --json --overlay --aa --convention reversed");
    assert_string_equal(o.demo, "a");
    assert_string_equal(o.view, "b");
    assert_string_equal(o.board, "c");
    assert_string_equal(o.out, "d");
    assert_string_equal(o.check, "e");
    assert_string_equal(o.difference, "f.png");
    assert_string_equal(o.keys, "g");
    assert_true(o.start == 7 && o.frames == 8 && o.scale == 9 && o.tolerance == 10 && o.band == 11);
    assert_true(o.rotate_set && o.rotate == 3 && o.stats && o.json && o.overlay && o.antialias);
    assert_int_equal(o.convention, PH_REVERSED);
    take(
        "--model a --clip b --up z --texture c --filter file --two-sided --allow-outside --max-triangles 12 --size 3x4 "
        "--cross-fade 10000 --crc --difference f.ppm");
    assert_true(o.goal_set && o.goal.triangles == 12 && !o.goal.fit && o.width == 3 && o.height == 4);
    assert_string_equal(o.clip, "b");
    assert_string_equal(o.model_options.up, "z");
    assert_string_equal(o.model_options.texture, "c");
    assert_string_equal(o.model_options.filter, "file");
    assert_true(o.model_options.two_sided && o.model_options.allow_outside);
    assert_int_equal(o.model_options.cross_fade_ms, 10000);
    take("--model a --board b --max-triangles fit --crc");
    assert_true(o.goal.fit);
    take("--crc --dither");
    assert_true(o.dither && !o.antialias);
    take("--matrix --flatten kaist-4.7 --view-matrix 1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1");
    assert_true(o.view_matrix_set && !o.lens_matrix_set && !o.projection_set);
    take("--crc --convention d3d --projection-matrix 1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1");
    assert_true(o.lens_matrix_set && o.convention == PH_D3D);
    take("--list --json");
    assert_int_equal(o.action, OPTION_LIST);
    take("-h");
    assert_int_equal(o.action, OPTION_HELP);
}

static void the_lens_has_its_options(void **state)
{
    (void)state;
    take("--crc --near 0.25 --far 7 --fov 45");
    assert_true(o.near_z == FX_ONE / 4 && o.far_z == FX_INT(7) && o.fov_deg == FX_INT(45) && o.projection_set);
    take("--crc --convention lmu --near -2 --far -10");
    assert_true(o.near_z == FX_INT(2) && o.far_z == FX_INT(10));
    take("--crc --near -2 --convention lmu"); /* the other keeps its default */
    assert_true(o.near_z == FX_INT(2) && o.far_z == FX_INT(100));
    take("--crc --far -10 --convention lmu");
    assert_true(o.near_z == FX_HALF && o.far_z == FX_INT(10));
    take("--crc --near 2 --far 10 --convention lmu"); /* as distances */
    assert_true(o.near_z == FX_INT(2) && o.far_z == FX_INT(10));
    take("--crc --focal -1.5,3 --camera eye=0,0,5");
    assert_true(o.focal == -98304 && o.image_height == FX_INT(3) && o.projection_set && o.camera.set);
    take("--crc --focal 2");
    assert_true(o.focal == FX_INT(2) && o.image_height == FX_INT(2));
    take("--crc --projection ortho=-1,2,-3,4");
    assert_true(o.projection == OPTION_ORTHO && o.window_set && o.window[0] == -FX_ONE && o.window[3] == FX_INT(4));
    take("--crc --projection frustum");
    assert_true(o.projection == OPTION_FRUSTUM && !o.window_set);
    take("--crc --projection fisheye --fov 240");
    assert_true(o.projection == OPTION_FISHEYE && o.fov_deg == FX_INT(240));
    take("--crc --projection fisheye --fov 10");
    take("--crc --fov 179.99");
    assert_true(!o.factors && o.frustum_z == 0 && !o.parent_set);
    take("--matrix factors --frustum 2.5");
    assert_true(o.matrix && o.factors && o.frustum_z == 163840 && o.frustum_height == 0);
    take("--frustum 2,.5 --matrix --camera eye=0,0,5 --parent 3 --point 1,2,3 --flatten kaist-4.7");
    assert_true(o.matrix && !o.factors && o.frustum_height == FX_HALF && o.parent_set && o.parent == 3);
}

struct wrong_line {
    const char *line, *said;
};

static void expect_wrong(const struct wrong_line *lines, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        assert_int_equal(read_line(lines[i].line), PH_ERR_INVAL);
        if (strstr(said.text, lines[i].said) == NULL) {
            fail_msg("%s: %s", lines[i].line, said.text);
        }
        assert_int_equal(stderr_capture_lines(&said), 1);
    }
}

static void options_that_exclude_each_other_are_told(void **state)
{
    static const struct wrong_line lines[] = {
        {"", "nothing to do: give --out, --check, --crc, --stats, --matrix, --point, --frustum or --window"},
        {"--demo a --model b --crc", "--demo and --model exclude each other"},
        {"--clip a --crc", "--clip: of which model?"},
        {"--cross-fade 9 --crc", "--cross-fade: of which model?"},
        {"--model a --cross-fade 0 --crc", "--cross-fade '0': must be a whole number, 1 .. 10000"},
        {"--max-triangles 9 --crc", "--max-triangles: of which model?"},
        {"--filter nearest --crc", "--filter: of which model?"},
        {"--up y --crc", "--up: of which model?"},
        {"--two-sided --crc", "--two-sided: of which model?"},
        {"--allow-outside --crc", "--allow-outside: of which model?"},
        {"--texture a --crc", "--texture: of which model?"},
        {"--model a --max-triangles fit --crc", "--max-triangles fit: fit what? name a --board"},
        {"--board a --size 3x4 --crc", "--board and --size exclude each other"},
        {"--json --window", "--json: of what?"},
        {"--crc --fov 180", "--fov: must be less than 180 degrees"},
        {"--crc --projection fisheye --fov 9.99", "--fov: must be 10 .. 240 degrees for a fisheye"},
        {"--crc --camera eye=0,0,5 --view-matrix 1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1",
         "--camera and --view-matrix exclude"},
        {"--crc --near 1 --projection-matrix 1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1",
         "--projection-matrix holds all of the lens"},
        {"--crc --focal 1 --fov 60", "--focal is a perspective's, and excludes --fov"},
        {"--crc --focal 1 --projection ortho", "--focal is a perspective's"},
        {"--crc --focal -1", "--focal: below 0 it turns the view"},
        {"--crc --flatten kaist-4.7", "--flatten: is printed with --matrix"},
        {"--crc --parent 2", "--parent: of which camera?"},
        {"--crc --dither --aa", "--dither and --aa exclude each other"},
        {"--crc --show depth --aa", "--show depth excludes --aa"},
        {"--crc --show depth --overlay", "--show depth excludes --aa and --overlay"},
        {"--frustum 2 --projection fisheye", "--frustum: a fisheye has none"},
        {"--matrix --projection fisheye", "--matrix: a fisheye has no matrix"},
    };
    (void)state;
    expect_wrong(lines, sizeof lines / sizeof lines[0]);
}

static void wrong_values_are_told(void **state)
{
    static const struct wrong_line lines[] = {
        {"--crc --size 0x4", "--size"},
        {"--crc --size 1025x4", "--size"},
        {"--crc --fov 0", "--fov"},
        {"--crc --fov 240.01 --projection fisheye", "--fov"},
        {"--crc --near 1x", "--near"},
        {"--frustum 0", "--frustum"},
        {"--frustum 1,", "--frustum"},
        {"--frustum 1,0", "--frustum"},
        {"--frustum 1,2,3", "--frustum"},
        {"--crc --camera eye=0,0,5 --parent -1", "--parent"},
        {"--matrix factor", "--matrix"},
        {"--crc --show colour", "--show"},
        {"--crc --far", "--far"},
        {"--crc --focal 0", "--focal"},
        {"--crc --focal -32768 --camera eye=0,0,5", "--focal"},
        {"--crc --focal 1,0", "--focal"},
        {"--crc --focal 1,2,3", "--focal"},
        {"--crc --projection perspective=1,2,3,4", "--projection"},
        {"--crc --projection fisheye=1,2,3,4", "--projection"},
        {"--crc --projection ortho=1,2,3", "--projection"},
        {"--crc --projection ortho=1,2,3,4,5", "--projection"},
        {"--crc --projection perspectiveperspective", "--projection"},
        {"--crc --convention vulkan", "--convention"},
        {"--crc --difference a.gif", "--difference"},
        {"--crc --rotate 45", "--rotate"},
        {"--crc --frames 0", "--frames"},
        {"--crc --scale 17", "--scale"},
        {"--crc --tolerance 256", "--tolerance"},
        {"--crc --band 1025", "--band"},
        {"--crc --other", "--other"},
    };
    (void)state;
    expect_wrong(lines, sizeof lines / sizeof lines[0]);
    take("--model a --crc --size 1024x1 --focal 1,0.00002 --frames 1000000000 --scale 16 --tolerance 255 --band 1024");
}

static struct ph_projection lens_of(const char *line, uint16_t width, uint16_t height)
{
    struct ph_projection p;
    take(line);
    assert_int_equal(sim_options_projection(&o, width, height, &p), 0);
    return p;
}

/* Scales are Q20: how many half heights or widths of the picture a slope or a length of one is. */
static void expect_scales(const struct ph_projection *p, double x, double y)
{
    assert_in_range(p->scale_x_q20 + 64, (uint64_t)(x * (1 << 20)), (uint64_t)(x * (1 << 20)) + 128);
    assert_in_range(p->scale_y_q20 + 64, (uint64_t)(y * (1 << 20)), (uint64_t)(y * (1 << 20)) + 128);
}

static void the_lens_fits_the_picture(void **state)
{
    (void)state;
    struct ph_projection p = lens_of("--crc --fov 90", 200, 100);
    expect_scales(&p, .5, 1);
    assert_true(p.kind == PH_PERSPECTIVE && p.near_z == FX_HALF && p.far_z == FX_INT(100));
    p = lens_of("--crc", 100, 100);
    expect_scales(&p, 1.7320508, 1.7320508); /* 60 degrees */
    p = lens_of("--crc --projection frustum --fov 90 --near 2", 200, 100);
    expect_scales(&p, .5, 1);
    p = lens_of("--crc --focal 3,4", 200, 100);
    expect_scales(&p, .75, 1.5); /* 2 high and 4 wide at a distance of 3 */
    p = lens_of("--crc --focal -3,4 --camera eye=0,0,5", 200, 100);
    expect_scales(&p, .75, 1.5);
    p = lens_of("--crc --projection ortho --fov 90", 200, 100);
    expect_scales(&p, 1 / 6., 1 / 3.); /* 3 away: 3 up and 6 to the side */
    assert_int_equal(p.kind, PH_ORTHOGRAPHIC);
    p = lens_of("--crc --projection ortho --fov 90 --camera eye=0,0,8", 200, 100);
    expect_scales(&p, 1 / 16., 1 / 8.); /* that of its target */
    p = lens_of("--crc --projection ortho=-2,2,-1,1", 100, 100);
    expect_scales(&p, .5, 1);
    p = lens_of("--crc --projection frustum=-2,2,-1,1 --near 2", 100, 100);
    expect_scales(&p, 1, 2);
    p = lens_of("--crc --fov 90", 160, 90);
    assert_int_equal(p.scale_x_q20, 589824); /* 9/16 of 2^20 */
    p = lens_of("--crc --projection frustum --fov 90", 160, 90);
    assert_int_equal(p.scale_x_q20, 589824);
    p = lens_of("--crc --projection ortho --fov 90 --camera eye=0,0,1", 160, 90);
    assert_int_equal(p.scale_x_q20, 589824);
    p = lens_of("--crc --focal 3,6", 160, 90);
    assert_int_equal(p.scale_x_q20, 589824);
    p = lens_of("--crc --projection fisheye", 100, 100);
    assert_int_equal(p.kind, PH_FISHEYE);
    const struct ph_projection half = lens_of("--crc --projection fisheye --fov 90", 100, 100);
    assert_true(half.scale_y_q20 != p.scale_y_q20);
    const struct ph_projection same = lens_of("--crc --projection fisheye --fov 180", 100, 100);
    assert_true(same.scale_y_q20 == p.scale_y_q20);
}

static void what_no_lens_can_do_is_refused(void **state)
{
    struct ph_projection p;
    (void)state;
    take("--crc --near 5 --far 5");
    assert_int_equal(sim_options_projection(&o, 100, 100, &p), PH_ERR_INVAL);
    take("--crc --near 0");
    assert_int_equal(sim_options_projection(&o, 100, 100, &p), PH_ERR_INVAL);
    take("--crc --projection-matrix 0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0");
    assert_int_equal(sim_options_projection(&o, 100, 100, &p), PH_ERR_INVAL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_not_given_has_its_default),
        cmocka_unit_test(each_option_sets_its_own),
        cmocka_unit_test(the_lens_has_its_options),
        cmocka_unit_test(options_that_exclude_each_other_are_told),
        cmocka_unit_test(wrong_values_are_told),
        cmocka_unit_test(the_lens_fits_the_picture),
        cmocka_unit_test(what_no_lens_can_do_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
