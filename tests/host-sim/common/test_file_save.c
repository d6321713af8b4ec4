/* file_save: a file is there whole or as it was before, no temporary file stays, and signals wait. */
#define _XOPEN_SOURCE 700 /* mkfifo, symlink, SIGXCPU */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "complain.h"
#include "file_save.h"
#include "files.h"
#include "hal.h"
#include "stderr_capture.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static volatile sig_atomic_t signals;

static void count_signal(int number)
{
    (void)number;
    signals++;
}

static unsigned files(void)
{
    DIR *const folder = opendir(".");
    unsigned n = 0;
    assert_non_null(folder);
    while (readdir(folder) != NULL) {
        n++;
    }
    closedir(folder);
    return n - 2; /* . and .. */
}

static void expect_file(const char *path, const char *text)
{
    char found[100];
    FILE *const file = fopen(path, "rb");
    assert_non_null(file);
    const size_t n = fread(found, 1, sizeof found - 1, file);
    fclose(file);
    found[n] = '\0';
    assert_string_equal(found, text);
}

/* The old file is still there, and the temporary one beside it. */
static int write_while_old_stays(FILE *file, const void *context)
{
    const char *const old = context;
    expect_file("a", old);
    assert_int_equal(files(), 2);
    fputs("new\n", file);
    return 0;
}

static int write_and_fail(FILE *file, const void *context)
{
    fputs("half", file);
    return *(const int *)context;
}

static void a_file_is_replaced_when_it_is_whole(void **state)
{
    (void)state;
    assert_int_equal(file_save_bytes("a", "old\0er", 3), 0);
    expect_file("a", "old");
    assert_int_equal(file_save("a", write_while_old_stays, "old"), 0);
    expect_file("a", "new\n");
    assert_int_equal(files(), 1);
    assert_int_equal(unlink("a"), 0);
}

static void an_error_leaves_the_old_file_alone(void **state)
{
    (void)state;
    const int error = -4711;
    assert_int_equal(file_save_bytes("a", "old", 3), 0);
    assert_int_equal(file_save("a", write_and_fail, &error), -4711);
    expect_file("a", "old");
    assert_int_equal(file_save("b", write_and_fail, &error), -4711);
    assert_int_equal(files(), 1);
    assert_int_equal(unlink("a"), 0);
}

/* A folder takes the name meanwhile. */
static int write_and_make_folder(FILE *file, const void *context)
{
    fputs("x", file);
    return mkdir(context, 0777);
}

static void a_file_that_cannot_be_renamed_goes_away(void **state)
{
    (void)state;
    assert_int_equal(file_save("b", write_and_make_folder, "b"), -EISDIR);
    assert_int_equal(files(), 1);
    assert_int_equal(rmdir("b"), 0);
}

static void a_path_that_cannot_be_is_told(void **state)
{
    (void)state;
    struct stderr_capture capture;
    char name[PATH_MAX + 10];
    const int done = 0;
    assert_int_equal(file_save("none/a", write_and_fail, &done), -ENOENT);
    for (size_t i = 0; i < PATH_MAX - 3; i += 2) { /* a name that is long enough for the file, not for ".part" */
        memcpy(name + i, "./", 2);
    }
    memcpy(name + PATH_MAX - 4, "a", 2);
    assert_int_equal(file_save(name, write_and_fail, &done), -ENAMETOOLONG);
    stderr_capture_begin(&capture);
    const int status = file_save_bytes("none/a", "x", 1);
    stderr_capture_end(&capture);
    assert_int_equal(status, COMPLAINED);
    assert_string_equal(capture.text, "pinhole: none/a: cannot be written: No such file or directory\n");
    assert_int_equal(mkdir("folder", 0777), 0);
    assert_int_equal(file_save("folder", write_and_fail, &done), -EISDIR);
    assert_int_equal(rmdir("folder"), 0);
    assert_int_equal(files(), 0);
}

/* A device that is full: fclose() is the first to know. The test names it by a link in its own folder, so that code
 * which renames over what it is given replaces the link, and never the device. */
static void a_full_disk_is_told(void **state)
{
    (void)state;
    const int done = 0, error = -4711;
    const char large[100000] = "";
    struct stderr_capture capture;
    struct stat status;
    assert_int_equal(symlink("/dev/full", "full"), 0);
    assert_int_equal(file_save("full", write_and_fail, &done), -ENOSPC);
    assert_int_equal(file_save("full", write_and_fail, &error), -4711);
    stderr_capture_begin(&capture);
    const int saved = file_save_bytes("full", large, sizeof large);
    stderr_capture_end(&capture);
    assert_int_equal(saved, COMPLAINED);
    assert_non_null(strstr(capture.text, "No space left on device"));
    assert_true(lstat("full", &status) == 0 && S_ISLNK(status.st_mode));
    assert_int_equal(unlink("full"), 0);
}

static void a_pipe_stays_a_pipe(void **state)
{
    (void)state;
    struct stat status;
    char text[8] = "";
    assert_int_equal(mkfifo("pipe", 0600), 0);
    const int end = open("pipe", O_RDONLY | O_NONBLOCK);
    assert_true(end >= 0);
    assert_int_equal(file_save_bytes("pipe", "word", 4), 0);
    assert_int_equal(read(end, text, sizeof text), 4);
    assert_string_equal(text, "word");
    close(end);
    assert_true(stat("pipe", &status) == 0 && S_ISFIFO(status.st_mode));
    assert_int_equal(unlink("pipe"), 0);
}

static int raise_signal(FILE *file, const void *context)
{
    fputs("x", file);
    raise(*(const int *)context);
    return signals == 0 ? 0 : -1;
}

static void signals_that_end_a_program_wait(void **state)
{
    (void)state;
    static const int numbers[] = {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGALRM, SIGXCPU};
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        struct sigaction action = {.sa_handler = count_signal};
        sigemptyset(&action.sa_mask);
        signals = 0;
        assert_int_equal(sigaction(numbers[i], &action, NULL), 0);
        assert_int_equal(file_save("a", raise_signal, &numbers[i]), 0);
        assert_int_equal(signals, 1);
        raise(numbers[i]); /* no longer blocked */
        assert_int_equal(signals, 2);
    }
    assert_int_equal(unlink("a"), 0);
}

static void an_error_without_a_number_is_eio(void **state)
{
    (void)state;
    errno = ENOSPC;
    assert_int_equal(file_save_status(), -ENOSPC);
    errno = EPERM; /* 1 */
    assert_int_equal(file_save_status(), -EPERM);
    errno = 0;
    assert_int_equal(file_save_status(), HAL_EIO);
}

int main(void)
{
    if (files_begin_inside() != 0) {
        return 1;
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_file_is_replaced_when_it_is_whole),
        cmocka_unit_test(an_error_leaves_the_old_file_alone),
        cmocka_unit_test(a_file_that_cannot_be_renamed_goes_away),
        cmocka_unit_test(a_path_that_cannot_be_is_told),
        cmocka_unit_test(a_full_disk_is_told),
        cmocka_unit_test(a_pipe_stays_a_pipe),
        cmocka_unit_test(signals_that_end_a_program_wait),
        cmocka_unit_test(an_error_without_a_number_is_eio),
    };
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    return files_end_empty() != 0 ? 1 : failed;
}
