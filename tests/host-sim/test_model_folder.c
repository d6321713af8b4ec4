/* A model reads what lies in its own folder and below, however it spells a name, unless it is allowed to go outside. */
#define _GNU_SOURCE /* symlink, unshare, chroot */

#include "complain.h"
#include "model_files.h"
#include "stderr_capture.h"

#include <png.h>

#include <sched.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <setjmp.h>
#include <cmocka.h>

/* The model's folder is `cow`; a file with the same data lies beside it, and one inside. */
static int make_folders(void **state)
{
    static const int places[4] = {3, 7, 11, 14};
    static const uint8_t red[3] = {255, 0, 0};
    png_image image = {.version = PNG_IMAGE_VERSION, .width = 1, .height = 1, .format = PNG_FORMAT_RGB};
    if (files_begin(state) != 0 || mkdir(file_path("cow"), 0700) != 0 || mkdir(file_path("cow/sub"), 0700) != 0 ||
        mkdir(file_path("cows"), 0700) != 0) {
        return -1;
    }
    file_ones("secret.bin", places, 4, 60);
    file_ones("cows/secret.bin", places, 4, 60);
    file_ones("cow/sub/own.bin", places, 4, 60);
    file_text("secret.mtl", "newmtl t\nKd 1 0 0\n");
    const char *const link = file_path("cow/link.bin"), *const kept = file_path("cow/kept.bin");
    return png_image_write_to_file(&image, file_path("secret.png"), 0, red, 0, NULL) &&
                   symlink("../secret.bin", link) == 0 && symlink("sub/own.bin", kept) == 0 &&
                   symlink("..", file_path("cow/up")) == 0 && symlink("../secret.mtl", file_path("cow/link.mtl")) == 0
               ? 0
               : -1;
}

/* The name of a file in the folder of the tests, behind `before`. */
static const char *absolute(const char *before, const char *name)
{
    static char text[512];
    snprintf(text, sizeof text, "%s%s", before, file_path(name));
    return text;
}

/* A triangle whose buffer and, if it is not NULL, picture have these names. */
static const char *gltf(const char *buffer, const char *picture)
{
    char text[4096], images[512] = "";
    if (picture != NULL) {
        snprintf(images, sizeof images,
                 "\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}}],"
                 "\"textures\":[{\"source\":0}],\"images\":[{\"uri\":\"%s\"}],",
                 picture);
    }
    snprintf(text, sizeof text,
             "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],\"meshes\":[{"
             "\"primitives\":[{\"attributes\":{\"POSITION\":0,\"TEXCOORD_0\":1}%s}]}],%s\"accessors\":[{\"bufferView\":"
             "0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"},{\"bufferView\":1,\"componentType\":5126,"
             "\"count\":3,\"type\":\"VEC2\"}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":60},{\"buffer\":0,"
             "\"byteOffset\":36,\"byteLength\":24}],\"buffers\":[{\"byteLength\":60,\"uri\":\"%s\"}]}",
             picture != NULL ? ",\"material\":0" : "", images, buffer);
    return file_text("cow/cow.gltf", text);
}

static const char *obj(const char *library, const char *picture)
{
    char text[1024];
    snprintf(text, sizeof text, "newmtl t\nKd 0 1 0\nmap_Kd %s\n", picture);
    file_text("cow/own.mtl", text);
    snprintf(text, sizeof text,
             "mtllib %s\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 1\nvt 1 1\nvt 0 0\nusemtl t\nf 1/1 2/2 3/3\n", library);
    return file_text("cow/cow.obj", text);
}

/* The model is refused by one line with the name and the option; with the option it is read. */
static void is_refused(const char *path, const char *name)
{
    static const struct model_options allowed = {.allow_outside = true};
    struct model *model;
    char said[1024];
    assert_int_equal(open_caught(&model, path, said), COMPLAINED);
    if (strstr(said, name) == NULL || strstr(said, path) == NULL || strstr(said, "outside of its folder") == NULL ||
        strstr(said, "--allow-outside") == NULL || strchr(said, '\n') != said + strlen(said) - 1) {
        fail_msg("%s: says '%s'", name, said);
    }
    assert_null(model);
    assert_int_equal(model_open(&model, path, &allowed), 0);
    assert_null(model->note);
    model_close(model);
}

static void a_buffer_outside_of_the_folder_is_refused(void **state)
{
    static const char *const names[] = {
        "../secret.bin",      "..//secret.bin",
        "./../secret.bin",    "sub/../../secret.bin",
        "../cows/secret.bin", "%2e%2e%2fsecret.bin",
        "..%2Fsecret.bin",    "%2E./secret.bin",
        "..\\\\secret.bin",   "sub\\\\..\\\\../secret.bin",
        "..%5csecret.bin",    "link.bin",
        "sub/../link.bin",    "up/secret.bin",
        "up/cows/secret.bin", "file:../secret.bin",
    };
    (void)state;
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        is_refused(gltf(names[i], NULL), strstr(names[i], "link") != NULL ? "link.bin" : "secret.bin");
    }
    is_refused(gltf(absolute("", "secret.bin"), NULL), "secret.bin");
    is_refused(gltf(absolute("file://", "secret.bin"), NULL), "secret.bin");
    is_refused(gltf(absolute("FILE://localhost", "secret.bin"), NULL), "secret.bin");
}

static void what_lies_in_the_folder_or_below_is_read(void **state)
{
    static const char *const names[] = {"sub/own.bin", "./sub/own.bin",   "sub%2fown.bin",      "sub\\\\own.bin",
                                        "kept.bin",    "up/cow/kept.bin", "../cow/sub/own.bin", "sub/../kept.bin"};
    (void)state;
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        model_close(open_good(gltf(names[i], NULL)));
    }
    model_close(open_good(gltf(absolute("", "cow/sub/own.bin"), NULL)));
    model_close(open_good(gltf(absolute("file://", "cow/sub/own.bin"), NULL)));
}

static void a_picture_outside_of_the_folder_is_refused(void **state)
{
    (void)state;
    is_refused(gltf("kept.bin", "../secret.png"), "../secret.png");
    is_refused(gltf("kept.bin", absolute("", "secret.png")), "secret.png");
    is_refused(obj("own.mtl", "../secret.png"), "../secret.png");
    is_refused(obj("own.mtl", "..\\secret.png"), "secret.png");
    is_refused(obj("own.mtl", absolute("", "secret.png")), "secret.png");
}

static void a_material_file_outside_of_the_folder_is_refused(void **state)
{
    (void)state;
    is_refused(obj("../secret.mtl", ""), "../secret.mtl");
    is_refused(obj("sub/../../secret.mtl", ""), "secret.mtl");
    is_refused(obj("link.mtl", ""), "link.mtl");
}

static void what_is_nowhere_is_missing_and_not_outside(void **state)
{
    struct model *model;
    char said[1024];
    (void)state;
    assert_int_equal(open_caught(&model, gltf("../nowhere.bin", NULL), said), COMPLAINED);
    assert_non_null(strstr(said, "../nowhere.bin cannot be opened"));
    model = open_good(obj("own.mtl", "/nowhere/a.png"));
    assert_non_null(strstr(model->note, "/nowhere/a.png is left out: it cannot be opened"));
    model_close(model);
    model = open_good(obj("../nowhere.mtl", ""));
    assert_non_null(strstr(model->note, "../nowhere.mtl cannot be opened"));
    model_close(model);
}

static void a_model_that_is_a_link_itself_is_read(void **state)
{
    (void)state;
    gltf("kept.bin", NULL);
    assert_int_equal(symlink("../cow/cow.obj", file_path("cows/linked.obj")), 0);
    obj("own.mtl", "none.png");
    struct model *model = open_good(file_path("cows/linked.obj"));
    assert_non_null(strstr(model->note, "own.mtl cannot be opened")); /* its folder is that of the link */
    model_close(model);
}

static void a_model_is_named_from_its_own_folder(void **state)
{
    char here[1024];
    struct model *model;
    char said[1024];
    (void)state;
    gltf("sub/own.bin", NULL);
    assert_non_null(getcwd(here, sizeof here));
    assert_int_equal(chdir(file_path("cow")), 0);
    model_close(open_good("cow.gltf"));
    gltf("../secret.bin", NULL);
    assert_int_equal(open_caught(&model, "cow.gltf", said), COMPLAINED);
    assert_non_null(strstr(said, "--allow-outside"));
    assert_int_equal(chdir(here), 0);
}

/* Whoever opens a pipe without a writer waits for ever, so that the alarm ends this test. */
static void what_is_no_regular_file_is_not_opened(void **state)
{
    struct model *model;
    char said[1024];
    (void)state;
    assert_int_equal(mkfifo(file_path("cow/pipe.bin"), 0600) | mkfifo(file_path("cow/pipe.mtl"), 0600) |
                         mkfifo(file_path("cow/pipe.png"), 0600) | mkdir(file_path("cow/folder.bin"), 0700),
                     0);
    alarm(20);
    assert_int_equal(open_caught(&model, gltf("pipe.bin", NULL), said), COMPLAINED);
    assert_non_null(strstr(said, "pipe.bin cannot be opened"));
    assert_int_equal(open_caught(&model, gltf("folder.bin", NULL), said), COMPLAINED);
    assert_non_null(strstr(said, "folder.bin cannot be opened"));
    model = open_good(obj("pipe.mtl", ""));
    assert_string_equal(model->note, "materials pipe.mtl cannot be opened");
    model_close(model);
    model = open_good(obj("own.mtl", "pipe.png"));
    assert_string_equal(model->note, "texture pipe.png is left out: it cannot be opened");
    model_close(model);
    model = open_good(gltf("kept.bin", "pipe.png"));
    assert_string_equal(model->note, "texture pipe.png is left out: it cannot be opened");
    model_close(model);
    alarm(0);
}

/* Reads a model in a process whose root is its folder. 77: this machine does not let it. */
static int read_below_root(void)
{
    struct model *model;
    if ((geteuid() != 0 && unshare(CLONE_NEWUSER) != 0) || chroot(file_path("cow")) != 0 || chdir("/") != 0) {
        return 77;
    }
    return model_open(&model, "/cow.gltf", NULL) == 0 && model_open(&model, "cow.gltf", NULL) == 0 ? 0 : 1;
}

static void a_model_in_the_root_is_read(void **state)
{
    static const char *const names[] = {"sub/own.bin", "/sub/own.bin", "../sub/own.bin"};
    (void)state;
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        int status = 0;
        gltf(names[i], NULL);
        const pid_t pid = fork();
        if (pid == 0) {
            _exit(read_below_root());
        }
        assert_int_equal(waitpid(pid, &status, 0), pid);
        if (WIFEXITED(status) && WEXITSTATUS(status) == 77) {
            skip();
        }
        assert_true(WIFEXITED(status));
        assert_int_equal(WEXITSTATUS(status), 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_buffer_outside_of_the_folder_is_refused),
        cmocka_unit_test(what_lies_in_the_folder_or_below_is_read),
        cmocka_unit_test(a_picture_outside_of_the_folder_is_refused),
        cmocka_unit_test(a_material_file_outside_of_the_folder_is_refused),
        cmocka_unit_test(what_is_nowhere_is_missing_and_not_outside),
        cmocka_unit_test(a_model_that_is_a_link_itself_is_read),
        cmocka_unit_test(a_model_is_named_from_its_own_folder),
        cmocka_unit_test(what_is_no_regular_file_is_not_opened),
        cmocka_unit_test(a_model_in_the_root_is_read),
    };
    return cmocka_run_group_tests(tests, make_folders, files_end);
}
