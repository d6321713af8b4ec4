/* model_file_io: what assimp reads through it: files of the model's folder alone, with their places and sizes, and
 * nothing is written. */
#include "assimp/model_file_io.h"
#include "files.h"

#include <assimp/cfileio.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>
#include <sys/stat.h>

#include <cmocka.h>

static struct model_folder folder;
static struct aiFileIO io;
static struct aiFile *file;

static int make_folder(void **state)
{
    if (files_begin(state) != 0 || mkdir(file_path("own"), 0700) != 0) {
        return -1;
    }
    file_text("own/model.obj", "v 0 0 0\n");
    file_text("own/digits", "0123456789");
    file_text("secret", "secret");
    return 0;
}

static int fresh(void **state)
{
    static char model[512];
    (void)state;
    strcpy(model, file_path("own/model.obj"));
    folder = (struct model_folder){.model = model};
    io = model_file_io(&folder);
    file = io.OpenProc(&io, file_path("own/digits"), "rb");
    assert_non_null(file);
    return 0;
}

static int end(void **state)
{
    (void)state;
    io.CloseProc(&io, file);
    return 0;
}

static void reads_are(size_t count, const char *text)
{
    char bytes[32] = "";
    assert_int_equal(file->ReadProc(file, bytes, 1, count), strlen(text));
    assert_memory_equal(bytes, text, strlen(text));
}

static void items_are_read_one_after_the_other(void **state)
{
    char bytes[16] = "";
    (void)state;
    reads_are(3, "012");
    assert_int_equal(file->ReadProc(file, bytes, 3, 2), 2);
    assert_memory_equal(bytes, "345678", 6);
    assert_int_equal(file->ReadProc(file, bytes, 3, 2), 0); /* only one byte is left */
    reads_are(20, "");
}

static void a_place_is_sought_from_all_three_origins(void **state)
{
    (void)state;
    assert_int_equal(file->SeekProc(file, 7, aiOrigin_SET), aiReturn_SUCCESS);
    assert_int_equal(file->TellProc(file), 7);
    reads_are(1, "7");
    assert_int_equal(file->SeekProc(file, 1, aiOrigin_CUR), aiReturn_SUCCESS);
    reads_are(20, "9");
    assert_int_equal(file->SeekProc(file, (size_t)-4, aiOrigin_END), aiReturn_SUCCESS);
    assert_int_equal(file->TellProc(file), 6);
    reads_are(2, "67");
    assert_int_equal(file->SeekProc(file, (size_t)-4, aiOrigin_SET), aiReturn_FAILURE);
    assert_int_equal(file->TellProc(file), 8);
}

static void size_leaves_the_place(void **state)
{
    (void)state;
    reads_are(4, "0123");
    assert_int_equal(file->FileSizeProc(file), 10);
    assert_int_equal(file->TellProc(file), 4);
    reads_are(1, "4");
}

static void nothing_is_written(void **state)
{
    static const char *const modes[] = {"w", "wb", "a", "+"};
    (void)state;
    assert_int_equal(file->WriteProc(file, "x", 1, 1), 0);
    file->FlushProc(file);
    assert_int_equal(file->FileSizeProc(file), 10);
    for (int i = 0; i < 4; i++) {
        assert_null(io.OpenProc(&io, file_path("own/digits"), modes[i]));
    }
    assert_null(io.OpenProc(&io, file_path("own/new"), "wb"));
    struct stat status;
    assert_int_not_equal(stat(file_path("own/new"), &status), 0);
}

static void only_what_the_model_may_name_is_opened(void **state)
{
    (void)state;
    assert_null(io.OpenProc(&io, file_path("own/none"), "rb"));
    assert_null(io.OpenProc(&io, file_path("own/../secret"), "rb"));
    assert_true(folder.outside[0] != '\0');
    folder.allow_outside = true;
    struct aiFile *const secret = io.OpenProc(&io, file_path("own/../secret"), "rt");
    assert_non_null(secret);
    assert_int_equal(secret->FileSizeProc(secret), 6);
    assert_int_equal(file->FileSizeProc(file), 10);
    io.CloseProc(&io, secret);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(items_are_read_one_after_the_other, fresh, end),
        cmocka_unit_test_setup_teardown(a_place_is_sought_from_all_three_origins, fresh, end),
        cmocka_unit_test_setup_teardown(size_leaves_the_place, fresh, end),
        cmocka_unit_test_setup_teardown(nothing_is_written, fresh, end),
        cmocka_unit_test_setup_teardown(only_what_the_model_may_name_is_opened, fresh, end),
    };
    return cmocka_run_group_tests(tests, make_folder, files_end);
}
