/* model: opens a model file (model.h). A child process with limits of time and memory reads it, for a file may be
 * hostile. */
#define _DEFAULT_SOURCE /* MAP_ANONYMOUS, fork, setrlimit */

#include "model_read.h"

#include "complain.h"
#include "model_phs.h"
#include "option_text.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

/* This is address space, not memory: a page takes memory when it is written. */
#define SHARED_BYTES (sizeof(void *) > 4 ? (size_t)2 << 30 : (size_t)1 << 29)
/* A reader that takes longer hangs: seconds of processor time, plus some for each MiB. */
#define CPU_SECONDS         10
#define CPU_SECONDS_PER_MIB 4

static int check_file(const char *path)
{
    struct stat status;
    if (stat(path, &status) != 0) {
        return complain("model %s: %s", path, strerror(errno));
    }
    if (S_ISDIR(status.st_mode)) {
        return complain("model %s: is a directory; name a model file in it", path);
    }
    if (!S_ISREG(status.st_mode)) {
        return complain("model %s: is no regular file", path);
    }
    if (status.st_size == 0) {
        return complain("model %s: is empty", path);
    }
    if (status.st_size > (off_t)MODEL_FILE_MAX) {
        return complain("model %s: has more than %u bytes, the limit", path, MODEL_FILE_MAX);
    }
    if (access(path, R_OK) != 0) {
        return complain("model %s: cannot be read: %s", path, strerror(errno));
    }
    return 0;
}

/* What the reader may take beside the shared memory: a small file that asks for much is refused. */
#define DATA_BYTES          ((rlim_t)768 << 20)
#define DATA_BYTES_PER_BYTE 16 /* of the file */

/* Limits memory above what the process has already: instruments such as sanitizers map much of their own. */
static void limit_memory(rlim_t file_bytes)
{
    unsigned long pages = 0;
    FILE *from = fopen("/proc/self/statm", "r");
    /* NOLINTNEXTLINE(cert-err34-c): the kernel's own count fits */
    if (from != NULL && fscanf(from, "%*u %*u %*u %*u %*u %lu", &pages) == 1) {
        const rlim_t most =
            (rlim_t)pages * (rlim_t)sysconf(_SC_PAGESIZE) + DATA_BYTES + DATA_BYTES_PER_BYTE * file_bytes;
        const struct rlimit data = {most, most};
        setrlimit(RLIMIT_DATA, &data);
    }
    if (from != NULL) {
        fclose(from);
    }
}

/* Readers print lines of their own; what matters is in shared->error. */
static void silence(void)
{
    const int nowhere = open("/dev/null", O_RDWR);
    if (nowhere >= 0) {
        dup2(nowhere, STDOUT_FILENO);
        dup2(nowhere, STDERR_FILENO);
    }
}

static const int crashes[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};

static void child(struct model_shared *shared, const char *path)
{
    struct stat status = {.st_size = 0};
    stat(path, &status);
    const rlim_t most = CPU_SECONDS + (rlim_t)(status.st_size >> 20) * CPU_SECONDS_PER_MIB;
    const struct rlimit seconds = {most, most}, no_core = {0, 0};
    setrlimit(RLIMIT_CPU, &seconds);
    signal(SIGALRM, SIG_DFL);
    alarm((unsigned)(3 * most));      /* it may also wait, which costs no CPU */
    prctl(PR_SET_PDEATHSIG, SIGKILL); /* a child without its parent is of no use */
    setrlimit(RLIMIT_CORE, &no_core);
    limit_memory((rlim_t)status.st_size);
    silence();
    for (size_t i = 0; i < sizeof crashes / sizeof crashes[0]; i++) {
        signal(crashes[i], SIG_DFL); /* the caller's handlers are not for this process */
    }
    _exit(model_read(shared, path) ? EXIT_SUCCESS : EXIT_FAILURE);
}

static int read_in_child(struct model_shared *shared, const char *path)
{
    const pid_t pid = fork();
    if (pid < 0) {
        return complain("model %s: no process to read it in: %s", path, strerror(errno));
    }
    if (pid == 0) {
        child(shared, path);
    }
    int status = 0;
    while (waitpid(pid, &status, 0) < 0 && errno == EINTR) {
    }
    if (WIFEXITED(status) && WEXITSTATUS(status) == EXIT_SUCCESS) {
        return 0;
    }
    if (WIFEXITED(status) && shared->error[0] != '\0') {
        return complain("model %s: %s", path, shared->error);
    }
    return complain("model %s: is broken, or too large for this machine: the reader crashed or hung on it", path);
}

int model_open(struct model **model, const char *path, const struct model_options *options)
{
    *model = NULL;
    int status = check_file(path);
    if (status != 0) {
        return status;
    }
    if (option_text_ends(path, ".phs")) {
        return model_phs_open(model, path);
    }
    void *memory = mmap(NULL, SHARED_BYTES, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (memory == MAP_FAILED) {
        return complain("model %s: not enough memory", path);
    }
    struct model_shared *shared = memory;
    const size_t head = (sizeof *shared + 15) & ~(size_t)15;
    shared->arena = (struct demo_arena){.base = (uint8_t *)memory + head, .size = SHARED_BYTES - head};
    shared->options = options != NULL ? *options : (struct model_options){.up = NULL};
    status = read_in_child(shared, path);
    if (status != 0) {
        munmap(memory, SHARED_BYTES);
        return status;
    }
    shared->model.note = shared->note[0] != '\0' ? shared->note : NULL;
    *model = &shared->model;
    return 0;
}

void model_close(struct model *model)
{
    if (model != NULL && model->scene != NULL) {
        free(model);
    } else if (model != NULL) {
        munmap(model, SHARED_BYTES);
    }
}
