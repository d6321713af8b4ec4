/* model_mtl: what each line of an MTL file says of a surface, and where its pictures are looked for. The surfaces and
 * the pictures are played by the test, so that it needs no library and sees what they are asked. */
#include "files.h"
#include "model_mtl.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include <cmocka.h>

static struct model_shared shared;
static struct model_scene scene;
static struct model_mtls mtls;
static struct model_surface got[8];
static uint32_t got_count, room, masked;
static char opened[256];

/* In place of model_surface.c. */
uint8_t model_surface_channel(float value)
{
    return (uint8_t)lround(255 * (double)value);
}

void model_surface_mask(struct model_surface *surface)
{
    assert_non_null(surface->mask.picture.rgb);
    masked++;
}

bool model_surface_make(struct model_shared *to, struct model_surface *from, struct model_material *material)
{
    assert_ptr_equal(to, &shared);
    assert_non_null(material);
    if (got_count == room) {
        return false;
    }
    got[got_count++] = *from;
    return true;
}

/* In place of picture_in.c: pictures with alpha, but the broken one; `opened` has where they lie below the folder. */
const char *picture_in_file(struct picture_in *in, const char *path)
{
    static uint8_t rgb[3];
    const size_t n = strlen(opened);
    assert_int_equal(in->most, 1024);
    snprintf(opened + n, sizeof opened - n, "%s ", path + strlen(shared.folder.model) - strlen("a.obj"));
    in->picture = (struct ppm){1, 1, rgb};
    in->alpha = malloc(1);
    return strstr(path, "bad.png") != NULL ? "is broken" : NULL;
}

static int fresh(void **state)
{
    static char model[4096];
    (void)state;
    mkdir(file_path("sub"), 0700);
    snprintf(model, sizeof model, "%s", file_text("a.obj", ""));
    shared = (struct model_shared){.folder = {.model = model}};
    scene = (struct model_scene){.material_count = 0};
    mtls = (struct model_mtls){.count = 0};
    got_count = masked = 0;
    room = 8;
    opened[0] = '\0';
    return 0;
}

static struct model_word word(const char *text)
{
    return (struct model_word){text, strlen(text)};
}

static bool read_library(const char *name)
{
    const struct model_word spelled = word(name);
    return model_mtl_read(&shared, &scene, &mtls, &spelled);
}

static void read_text(const char *text)
{
    file_text("a.mtl", text);
    assert_true(read_library("a.mtl"));
    assert_int_equal(scene.material_count, got_count);
    assert_int_equal(mtls.count, got_count);
}

static void expect_colour(const uint8_t colour[3], int r, int g, int b)
{
    assert_true(colour[0] == r && colour[1] == g && colour[2] == b);
}

static void a_material_has_the_colours_and_the_opacity_of_its_lines(void **state)
{
    (void)state;
    read_text("Kd 1 1 1\nd .1\nnewmtl one two \nKd 0 .2 .4\nKe .6 .8 1\nd .25\nnewmtl b\nKd .8 .2\nKe .4\nTr .75\n"
              "newmtl c\nkd x\nd -halo 1\nnewmtl d\nd 0\nnewmtl e\nTr 1\nnewmtl f\nd 1\nnewmtl g\nTr 0");
    assert_int_equal(got_count, 7);
    assert_true(mtls.list[0].name.n == 7 && memcmp(mtls.list[0].name.text, "one two", 7) == 0);
    assert_true(mtls.list[6].name.n == 1 && mtls.list[6].name.text[0] == 'g');
    expect_colour(got[0].colour, 0, 51, 102);
    expect_colour(got[0].glow, 153, 204, 255);
    expect_colour(got[1].colour, 204, 204, 204);
    expect_colour(got[1].glow, 102, 102, 102);
    expect_colour(got[2].colour, 153, 153, 153);
    expect_colour(got[2].glow, 0, 0, 0);
    for (uint32_t i = 0; i < 7; i++) {
        assert_true(got[i].alpha == (i < 2 ? .25 : 1));
        assert_int_equal(got[i].mode, i < 2 ? MODEL_BLEND : MODEL_OPAQUE);
        assert_true(mtls.list[i].scale[0] == 1 && mtls.list[i].scale[1] == 1);
        assert_true(mtls.list[i].offset[0] == 0 && mtls.list[i].offset[1] == 0);
        assert_false(got[i].two_sided);
    }
    assert_string_equal(shared.note, "");
}

static void options_of_a_map_stand_before_its_name(void **state)
{
    static const struct {
        const char *map, *name;
        double numbers[4]; /* scale, offset */
        int wrap;
    } cases[] = {
        {"a b.png", "a b.png", {1, 1, 0, 0}, PH_WRAP_REPEAT},
        {"-o .5 .25 9 -s 2 4 a.png", "a.png", {2, 4, .5, .25}, PH_WRAP_REPEAT},
        {"-s 3 a.png", "a.png", {3, 1, 0, 0}, PH_WRAP_REPEAT},
        {"-t 7 8 9 -mm 5 6 a.png", "a.png", {1, 1, 0, 0}, PH_WRAP_REPEAT},
        {"-clamp on a.png", "a.png", {1, 1, 0, 0}, PH_WRAP_CLAMP},
        {"-clamp off a.png", "a.png", {1, 1, 0, 0}, PH_WRAP_REPEAT},
        {"-blendu on -clamp on -bm 2 a.png", "a.png", {1, 1, 0, 0}, PH_WRAP_CLAMP},
        {"-cc on a.png", "a.png", {1, 1, 0, 0}, PH_WRAP_REPEAT},
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char text[128];
        fresh(NULL);
        file_text("a b.png", "");
        file_text("a.png", "");
        snprintf(text, sizeof text, "newmtl m\nmap_Kd %s\n", cases[i].map);
        read_text(text);
        assert_string_equal(got[0].name, cases[i].name);
        assert_int_equal(got[0].wrap, cases[i].wrap);
        assert_memory_equal(mtls.list[0].scale, cases[i].numbers, 16);
        assert_memory_equal(mtls.list[0].offset, cases[i].numbers + 2, 16);
        assert_non_null(got[0].picture.picture.rgb);
        assert_null(got[0].picture.alpha);
        assert_string_equal(shared.note, "");
    }
}

static void pictures_lie_beside_the_library_or_beside_the_model(void **state)
{
    static const struct {
        const char *library, *map, *opened;
    } cases[] = {{"sub/b.mtl", "own.png", "sub/own.png "}, {"sub\\b.mtl", "own.png", "sub/own.png "},
                 {"sub/b.mtl", "top.png", "top.png "},     {"sub/b.mtl", "/own.png", ""},
                 {"c.mtl", "own.png", "own.png "},         {"c.mtl", "sub/own.png", "sub/own.png "}};
    (void)state;
    file_text("sub/own.png", "");
    file_text("own.png", "");
    file_text("top.png", "");
    file_text("cown.png", "");
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char text[64];
        fresh(NULL);
        snprintf(text, sizeof text, "newmtl m\nmap_Kd %s\n", cases[i].map);
        file_text("sub/b.mtl", text);
        file_text("c.mtl", text);
        assert_true(read_library(cases[i].library));
        assert_string_equal(opened, cases[i].opened);
    }
}

static void a_picture_that_fails_leaves_the_colour_and_a_note(void **state)
{
    (void)state;
    file_text("bad.png", "");
    read_text("newmtl m\nmap_Kd bad.png\nmap_d none.png\n");
    assert_string_equal(shared.note, "texture bad.png is left out: it is broken; "
                                     "transparency none.png is left out: it cannot be opened");
    assert_int_equal(masked, 0);
    assert_true(read_library("none.mtl"));
    assert_non_null(strstr(shared.note, "; materials none.mtl cannot be opened"));
    assert_int_equal(got_count, 1);
}

static void map_d_is_a_mask_that_moves_with_the_texture(void **state)
{
    (void)state;
    file_text("a.png", "");
    read_text("newmtl m\nmap_d -s 2 3 -o 4 5 a.png\n");
    assert_int_equal(masked, 1);
    assert_non_null(got[0].mask.alpha);
    assert_null(got[0].picture.picture.rgb);
    assert_true(mtls.list[0].scale[0] == 2 && mtls.list[0].scale[1] == 3);
    assert_true(mtls.list[0].offset[0] == 4 && mtls.list[0].offset[1] == 5);
    for (int i = 0; i < 5; i++) {
        static const char *const options[5] = {"-s 2 3 -o 4 5", "-s 9 3 -o 4 5", "-s 2 9 -o 4 5", "-s 2 3 -o 9 5",
                                               "-s 2 3 -o 4 9"};
        char text[128];
        fresh(NULL);
        snprintf(text, sizeof text, "newmtl m\nmap_d %s a.png\nmap_Kd -s 2 3 -o 4 5 a.png\n", options[i]);
        read_text(text);
        assert_string_equal(shared.note, i == 0 ? "" : "-o and -s of map_d are ignored: map_Kd has others");
        assert_true(mtls.list[0].scale[0] == 2 && mtls.list[0].scale[1] == 3);
        assert_true(mtls.list[0].offset[0] == 4 && mtls.list[0].offset[1] == 5);
    }
}

static void what_has_no_material_gets_one(void **state)
{
    const struct model_word name = word("gone"), none = word(""), picture = word("a.png");
    (void)state;
    file_text("a.png", "");
    assert_true(model_mtl_add_plain(&shared, &scene, &mtls, &name));
    assert_true(model_mtl_add_plain(&shared, &scene, &mtls, &none));
    assert_true(mtls.count == 2 && mtls.list[0].name.n == 4 && mtls.list[1].name.n == 0);
    assert_true(mtls.list[0].scale[0] == 1 && mtls.list[0].scale[1] == 1 && mtls.list[0].offset[0] == 0);
    expect_colour(got[0].colour, 153, 153, 153);
    expect_colour(got[1].colour, 219, 204, 179);
    assert_true(model_mtl_plain(&shared, &scene));
    expect_colour(got[2].colour, 219, 204, 179);
    assert_true(model_mtl_white(&shared, &scene, &picture));
    assert_true(model_mtl_white(&shared, &scene, &none));
    expect_colour(got[3].colour, 255, 255, 255);
    assert_true(got[3].two_sided && got[4].two_sided && !got[2].two_sided);
    assert_true(got[3].picture.picture.rgb != NULL && got[4].picture.picture.rgb == NULL);
    assert_int_equal(got[3].wrap, PH_WRAP_REPEAT);
    assert_int_equal(scene.material_count, 5);
    assert_int_equal(mtls.count, 2);
    for (uint32_t i = 0; i < 5; i++) {
        assert_true(got[i].alpha == 1);
    }
}

static void without_memory_nothing_is_added(void **state)
{
    const struct model_word none = word("");
    (void)state;
    room = 1;
    file_text("a.mtl", "newmtl a\nnewmtl b\nnewmtl c\n");
    assert_false(read_library("a.mtl"));
    assert_string_equal(shared.error, "needs too much memory");
    assert_true(scene.material_count == 1 && mtls.count == 1);
    assert_false(model_mtl_plain(&shared, &scene));
    assert_false(model_mtl_white(&shared, &scene, &none));
    assert_false(model_mtl_add_plain(&shared, &scene, &mtls, &none));
    assert_true(scene.material_count == 1 && mtls.count == 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(a_material_has_the_colours_and_the_opacity_of_its_lines, fresh),
        cmocka_unit_test_setup(options_of_a_map_stand_before_its_name, fresh),
        cmocka_unit_test_setup(pictures_lie_beside_the_library_or_beside_the_model, fresh),
        cmocka_unit_test_setup(a_picture_that_fails_leaves_the_colour_and_a_note, fresh),
        cmocka_unit_test_setup(map_d_is_a_mask_that_moves_with_the_texture, fresh),
        cmocka_unit_test_setup(what_has_no_material_gets_one, fresh),
        cmocka_unit_test_setup(without_memory_nothing_is_added, fresh),
    };
    return cmocka_run_group_tests(tests, files_begin, files_end);
}
