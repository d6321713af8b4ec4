/* model_open: files that are refused before they are read, and what a reader in a child process may do to its parent:
 * nothing. The test plays the reader. */
#define _DEFAULT_SOURCE /* MAP_ANONYMOUS, truncate */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "complain.h"
#include "files.h"
#include "model_read.h"
#include "model_shared.h"
#include "stderr_capture.h"

#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

/* What a reader finds around it. */
struct found {
    rlim_t seconds, core, data;
    unsigned alarm_s;
    bool allows_outside;
};

/* In place of model_read.c: the file's first word says what to do. */
bool model_read(struct model_shared *shared, const char *path)
{
    char word[32] = "";
    struct rlimit seconds, core, data;
    struct found *found = demo_alloc(&shared->arena, sizeof *found);
    FILE *file = fopen(path, "r");
    if (file == NULL || fscanf(file, "%31s", word) != 1) {
        return false;
    }
    printf("a line of the reader\n");
    fprintf(stderr, "and another\n");
    fflush(stdout);
    getrlimit(RLIMIT_CPU, &seconds), getrlimit(RLIMIT_CORE, &core), getrlimit(RLIMIT_DATA, &data);
    model_shared_note(shared, strcmp(word, "noted") == 0 ? "a note" : "");
    *found = (struct found){seconds.rlim_cur, core.rlim_cur, data.rlim_cur, alarm(0), shared->options.allow_outside};
    shared->model.meshes = (void *)found;
    if (strcmp(word, "crash") == 0) {
        raise(SIGSEGV);
    }
    if (strcmp(word, "leave") == 0) {
        _exit(3);
    }
    if (strcmp(word, "greedy") == 0) {
        const size_t much = (size_t)900 << 20;
        return mmap(NULL, much, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0) != MAP_FAILED ||
               model_shared_failed(shared, "no memory");
    }
    return strcmp(word, "fail") != 0 || model_shared_failed(shared, "is odd (%s)", shared->options.up);
}

static struct stderr_capture said;
static struct model *model;

static int open_quietly(const char *path, const struct model_options *options)
{
    model = (struct model *)(void *)&said;
    stderr_capture_begin(&said);
    const int status = model_open(&model, path, options);
    stderr_capture_end(&said);
    return status;
}

static const struct found *found_by_reader(void)
{
    return (const void *)model->meshes;
}

static void refused(const char *path, const char *why)
{
    assert_int_equal(open_quietly(path, NULL), COMPLAINED);
    assert_null(model);
    assert_int_equal(stderr_capture_lines(&said), 1);
    assert_non_null(strstr(said.text, why));
}

static void what_is_no_model_file_is_told(void **state)
{
    (void)state;
    refused(file_path("none"), "none: No such file or directory");
    refused(file_path("."), "/.: is a directory; name a model file in it");
    refused("/dev/null", "model /dev/null: is no regular file");
    refused(file_text("empty", ""), "empty: is empty");
    file_text("large", "good");
    assert_int_equal(truncate(file_path("large"), (off_t)MODEL_FILE_MAX + 1), 0);
    refused(file_path("large"), "large: has more than 1073741824 bytes, the limit");
    assert_int_equal(truncate(file_path("large"), MODEL_FILE_MAX), 0);
    assert_int_equal(open_quietly(file_path("large"), NULL), 0);
    /* 10 s of processor time, and 4 for each of 1024 MiB; three times as much by the clock */
    const struct found of_large = *found_by_reader();
    assert_true(of_large.seconds == 10 + 4 * 1024 && of_large.alarm_s == 3 * (10 + 4 * 1024));
    model_close(model);
    assert_int_equal(open_quietly(file_text("large", "good"), NULL), 0);
    const rlim_t more = of_large.data - found_by_reader()->data; /* 16 bytes for each of the file */
    assert_in_range(more >> 20, (16 << 10) - 16, (16 << 10) + 16);
    model_close(model);
    refused(file_text("a.phs", "no scene"), "a.phs: ");
    assert_null(strstr(said.text, "is odd"));
    if (geteuid() != 0) { /* root reads all */
        chmod(file_text("secret", "good"), 0);
        refused(file_path("secret"), "secret: cannot be read: Permission denied");
    }
}

static void a_model_comes_back_with_its_note(void **state)
{
    (void)state;
    const int before = dup(STDOUT_FILENO);
    fflush(stdout);
    stderr_capture_begin(&said);
    dup2(STDERR_FILENO, STDOUT_FILENO); /* where lines of both are heard */
    const int status = model_open(&model, file_text("a", "good"), NULL);
    dup2(before, STDOUT_FILENO);
    stderr_capture_end(&said);
    close(before);
    assert_int_equal(status, 0);
    assert_int_equal(said.text[0], 0); /* the reader's lines are not */
    assert_true(found_by_reader()->seconds == 10 && found_by_reader()->alarm_s == 30);
    assert_true(found_by_reader()->core == 0 && !found_by_reader()->allows_outside);
    assert_null(model->note);
    const size_t behind = (size_t)((char *)model->meshes - (char *)model);
    assert_true(behind >= sizeof(struct model_shared) && behind < sizeof(struct model_shared) + 16 && behind % 16 == 0);
    model_close(model);
    assert_int_equal(open_quietly(file_text("a", "noted"), NULL), 0);
    assert_string_equal(model->note, "a note");
    void *const memory = model;
    model_close(model);
    assert_true(msync(memory, 1, MS_ASYNC) == -1 && errno == ENOMEM); /* it is not mapped */
    model_close(NULL);
}

static void count_signals(int number)
{
    (void)number;
}

static void a_reader_that_fails_costs_a_line(void **state)
{
    static const struct model_options options = {.up = "z"};
    (void)state;
    assert_int_equal(open_quietly(file_text("a", "fail"), &options), COMPLAINED);
    assert_null(model);
    assert_non_null(strstr(said.text, "a: is odd (z)\n"));
    assert_int_equal(stderr_capture_lines(&said), 1);
    refused(file_text("a", "leave"), "a: is broken, or too large for this machine: the reader crashed or hung on it");
    signal(SIGSEGV, count_signals); /* the parent's handler would go on */
    refused(file_text("a", "crash"), "the reader crashed or hung on it");
    signal(SIGSEGV, SIG_DFL);
    refused(file_text("a", "greedy"), "a: no memory");
    assert_int_equal(waitpid(-1, NULL, WNOHANG), -1); /* no child is left */
    assert_int_equal(errno, ECHILD);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_no_model_file_is_told),
        cmocka_unit_test(a_model_comes_back_with_its_note),
        cmocka_unit_test(a_reader_that_fails_costs_a_line),
    };
    const struct rlimit core = {4096, 4096}; /* where the system allows it, so that a reader can take it away */
    setrlimit(RLIMIT_CORE, &core);
    return cmocka_run_group_tests(tests, files_begin, files_end);
}
