/* See page_flash.h. */
#include "page_flash.h"

#include "complain.h"
#include "flash_file.h"
#include "flash_job.h"
#include "flash_join.h"
#include "flash_pick.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { IMAGE, SCENE, FILES };

struct answer {
    int status;
    uint8_t *bytes; /* that were received, or sent */
};

static struct page_flash {
    uint8_t *files[FILES];
    uint32_t sizes[FILES];
    struct flash_image image; /* of the first one, which both become */
    struct answer *answers;   /* the last one is the transfer that is wanted, if one is */
    uint32_t count, room, next;
    enum page_flash_want want;
    uint32_t size;
    volatile sig_atomic_t stop;
    uint32_t stop_at; /* so many answers, after which the user has stopped it */
    const char *what;
    uint32_t done, all;
} page;

uint8_t *page_flash_room(int is_scene, uint32_t n)
{
    const int i = is_scene != 0 ? SCENE : IMAGE;
    free(page.files[i]);
    page.files[i] = malloc(n + (size_t)1); /* also where n is 0 */
    page.sizes[i] = n;
    return page.files[i];
}

int page_flash_join(uint32_t flash_bytes)
{
    char error[FLASH_ERROR_SIZE];
    if (page.sizes[SCENE] > 0) {
        size_t n = 0;
        uint8_t *const joined = flash_join(page.files[IMAGE], page.sizes[IMAGE], page.files[SCENE], page.sizes[SCENE],
                                           flash_bytes, &n, error);
        if (joined == NULL) {
            return complain("%s", error);
        }
        free(page.files[IMAGE]);
        page.files[IMAGE] = joined;
        page.sizes[IMAGE] = (uint32_t)n;
    }
    flash_image_free(&page.image);
    const int status = flash_file_parse(&page.image, page.files[IMAGE], page.sizes[IMAGE], error);
    return status == 0 ? 0 : complain("%s", error);
}

const uint8_t *page_flash_uf2(void)
{
    return page.files[IMAGE];
}

uint32_t page_flash_uf2_bytes(void)
{
    return page.sizes[IMAGE];
}

void page_flash_why(int chip, int status)
{
    char error[FLASH_ERROR_SIZE];
    if (status == 0) {
        flash_pick(NULL, 0, (enum flash_chip)chip, NULL, error);
        complain("%s", error);
    } else {
        complain("%s: %s", flash_chip_name((enum flash_chip)chip), flash_pick_why(status));
    }
}

/* ---- transfers ---------------------------------------------------------------------------------- */

/* Makes the transfer's answer ready to be given. */
static bool want(enum page_flash_want kind, const void *out, size_t n)
{
    if (page.count == page.room) {
        const uint32_t room = page.room * 2 + 256;
        struct answer *const more = realloc(page.answers, room * sizeof *more);
        if (more == NULL) {
            return false;
        }
        page.answers = more;
        page.room = room;
    }
    uint8_t *const bytes = malloc(n + 1);
    if (bytes == NULL) {
        return false;
    }
    if (out != NULL) {
        memcpy(bytes, out, n);
    }
    page.answers[page.count++] = (struct answer){.bytes = bytes};
    page.want = kind;
    page.size = (uint32_t)n;
    return true;
}

/* HAL_ENODEV ends a run soonest: the job makes no transfer after it. */
static int transfer(enum page_flash_want kind, const void *out, void *in, size_t n)
{
    if (page.next == page.count) {
        return want(kind, out, n) ? HAL_ENODEV : HAL_EIO;
    }
    const struct answer *const answer = &page.answers[page.next++];
    page.stop = page.next >= page.stop_at;
    if (in != NULL && answer->status >= 0) {
        memcpy(in, answer->bytes, n);
    }
    return answer->status;
}

static int out(void *context, const void *bytes, size_t n)
{
    (void)context;
    return transfer(PAGE_FLASH_OUT, bytes, NULL, n);
}

static int in(void *context, void *bytes, size_t n)
{
    (void)context;
    return transfer(PAGE_FLASH_IN, NULL, bytes, n);
}

static int command_status(void *context, uint8_t answer[16])
{
    (void)context;
    return transfer(PAGE_FLASH_STATUS, NULL, answer, 16);
}

static int reset(void *context)
{
    (void)context;
    return transfer(PAGE_FLASH_RESET, NULL, NULL, 0);
}

/* ---- the job ------------------------------------------------------------------------------------ */

/* What a job shows after it has failed is not so: it goes on. */
static void show(const char *what, uint32_t done, uint32_t all)
{
    if (page.want == PAGE_FLASH_DONE) {
        page.what = what;
        page.done = done;
        page.all = all;
    }
}

void page_flash_begin(void)
{
    for (uint32_t i = 0; i < page.count; i++) {
        free(page.answers[i].bytes);
    }
    page.count = 0;
    page.stop_at = UINT32_MAX;
    page.want = PAGE_FLASH_DONE;
    show("preparing", 0, 1);
}

int page_flash_run(void)
{
    static const struct flash_link_ops ops = {.out = out, .in = in, .status = command_status, .reset = reset};
    struct flash_boot boot = {.ops = &ops, .is_rp2350 = page.image.chip == FLASH_RP2350};
    struct flash_job job = {
        .boot = &boot, .image = &page.image, .verify = true, .reboot = true, .stop = &page.stop, .progress = show};
    page.next = 0;
    page.stop = 0;
    page.want = PAGE_FLASH_DONE;
    const int status = flash_job_run(&job);
    if (page.want == PAGE_FLASH_DONE && status < 0) {
        complain("%s: %s", flash_chip_name(page.image.chip), job.error);
    } else if (page.want == PAGE_FLASH_DONE) {
        printf("%s: %u bytes written, read back and equal, started\n", flash_chip_name(page.image.chip),
               (unsigned)page.image.size);
        fflush(stdout);
    }
    return page.want;
}

uint8_t *page_flash_bytes(void)
{
    return page.answers[page.count - 1].bytes;
}

uint32_t page_flash_size(void)
{
    return page.size;
}

void page_flash_answer(int status)
{
    page.answers[page.count - 1].status = status;
}

void page_flash_stop(void)
{
    page.stop_at = page.count;
}

void page_flash_progress(void)
{
    printf("{\"what\": \"%s\", \"done\": %u, \"all\": %u}", page.what, (unsigned)page.done, (unsigned)page.all);
    fflush(stdout);
}
