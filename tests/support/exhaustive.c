/* exhaustive: runs checks over all 2^32 inputs. See exhaustive.h. */
#include "exhaustive.h"

#include <mpfr.h>

#include <inttypes.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define CHUNK_BITS 22
#define CHUNKS     ((uint32_t)1 << (32 - CHUNK_BITS))

struct run {
    const struct check *check;
    _Atomic uint32_t next;
    atomic_bool failed;
    _Atomic uint32_t wrong;
};

static void *worker(void *argument)
{
    struct run *run = argument;
    for (uint32_t i; !run->failed && (i = run->next++) < CHUNKS;) {
        const struct range r = {i << CHUNK_BITS, (i << CHUNK_BITS) | (((uint32_t)1 << CHUNK_BITS) - 1)};
        uint32_t wrong = 0;
        if (!run->check->run(r, &wrong)) {
            run->wrong = wrong;
            run->failed = true;
        }
        if (i % 16 == 15 && isatty(2) != 0) {
            fprintf(stderr, "\r%s %3u %%  ", run->check->name, (i + 1) * 100 / CHUNKS);
        }
    }
    mpfr_free_cache();
    return NULL;
}

static bool run_check(const struct check *check, int number)
{
    enum { MOST = 64 };
    pthread_t threads[MOST];
    struct run run = {.check = check};
    const long processors = sysconf(_SC_NPROCESSORS_ONLN);
    int n = 0;
    while (n < MOST && n < (processors > 1 ? processors : 1) && pthread_create(&threads[n], NULL, worker, &run) == 0) {
        n++;
    }
    if (n == 0) {
        worker(&run);
    }
    for (int i = 0; i < n; i++) {
        pthread_join(threads[i], NULL);
    }
    if (isatty(2) != 0) {
        fprintf(stderr, "\r%40s\r", "");
    }
    if (run.failed) {
        printf("not ok %d - %s # wrong at raw input 0x%08" PRIx32 "\n", number, check->name, run.wrong);
    } else {
        printf("ok %d - %s\n", number, check->name);
    }
    fflush(stdout);
    return !run.failed;
}

static bool named(const char *name, int argc, char **argv)
{
    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], name) == 0) {
            return true;
        }
    }
    return argc == 1;
}

static int usage(int status, const struct check *checks, size_t count)
{
    FILE *out = status == 0 ? stdout : stderr;
    fprintf(out, "usage: exhaustive_... [--help] [NAME...]\nnames:");
    for (size_t i = 0; i < count; i++) {
        fprintf(out, " %s", checks[i].name);
    }
    fprintf(out, "\n");
    return status;
}

static bool known(const char *name, const struct check *checks, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        if (strcmp(checks[i].name, name) == 0) {
            return true;
        }
    }
    return false;
}

/* K/N of SHARE; 1/1 without it. Returns false for anything else. */
static bool read_share(unsigned long *part, unsigned long *parts)
{
    const char *share = getenv("SHARE");
    char *end;
    *part = *parts = 1;
    if (share == NULL) {
        return true;
    }
    *part = strtoul(share, &end, 10);
    if (*end != '/') {
        return false;
    }
    *parts = strtoul(end + 1, &end, 10);
    return *end == '\0' && *part >= 1 && *part <= *parts;
}

int exhaustive_main(int argc, char **argv, const struct check *checks, size_t count)
{
    int passed = 0, failed = 0;
    unsigned long part, parts;
    if (!read_share(&part, &parts)) {
        return usage(2, checks, count);
    }
    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--help") == 0) {
            return usage(0, checks, count);
        }
        if (!known(argv[i], checks, count)) {
            return usage(2, checks, count);
        }
    }
    for (size_t i = 0; i < count; i++) {
        if (i % parts == part - 1 && named(checks[i].name, argc, argv)) {
            *(run_check(&checks[i], passed + failed + 1) ? &passed : &failed) += 1;
        }
    }
    printf("1..%d\n", passed + failed);
    printf("exhaustive: %d passed, %d failed, 0 skipped\n", passed, failed);
    return failed != 0;
}
