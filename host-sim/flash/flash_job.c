/* See flash_job.h. */
#include "flash_job.h"

#include "flash_program.h"
#include "flash_scene.h"

#include <stdio.h>
#include <string.h>

#define AGAIN    "plug it in with BOOTSEL held and run this again"
#define SMALLEST (256u << 10) /* flash of a board */
#define SAMPLES  8            /* sectors that tell whether flash repeats itself */

/* Writes the line about a failure at an offset from FLASH_BASE. */
static int fail(struct flash_job *job, int status, const char *what, uint32_t offset)
{
    char *line = job->error;
    const unsigned address = FLASH_BASE + offset;
    switch (status) {
    case HAL_ENODEV:
        snprintf(line, FLASH_ERROR_SIZE, "unplugged while %s 0x%08x; " AGAIN, what, address);
        break;
    case HAL_ETIMEDOUT:
        snprintf(line, FLASH_ERROR_SIZE, "no answer for %d s while %s 0x%08x; pull it out, " AGAIN,
                 FLASH_WAIT_MS / 1000, what, address);
        break;
    case FLASH_STALL:
        snprintf(line, FLASH_ERROR_SIZE, "the board refuses %s 0x%08x (%s); pull it out, " AGAIN, what, address,
                 flash_boot_refusal(job->boot));
        break;
    case FLASH_STOPPED:
        snprintf(line, FLASH_ERROR_SIZE, "stopped before %s 0x%08x; the board stays in its boot loader: run this again",
                 what, address);
        break;
    default:
        snprintf(line, FLASH_ERROR_SIZE, "USB error while %s 0x%08x; pull it out, " AGAIN, what, address);
        break;
    }
    return status;
}

static int told(struct flash_job *job, int status, const char *what, uint32_t offset)
{
    return status < 0 ? fail(job, status, what, offset) : 0;
}

static bool is_stopped(const struct flash_job *job)
{
    return job->stop != NULL && *job->stop != 0;
}

/* ---- does it fit? ------------------------------------------------------------------------------- */

/* Flash chips ignore the address bits that they do not have, so that a small flash repeats itself. Returns 1 if the
 * `size` bytes from `size` on are the first ones again, 0 if not, or if all are erased and cannot tell. */
static int repeats(struct flash_job *job, uint32_t size)
{
    uint8_t near[FLASH_SECTOR], far[FLASH_SECTOR];
    int erased = 1;
    for (uint32_t i = 0; i < SAMPLES; i++) {
        const uint32_t offset = size / SAMPLES * i;
        int status = flash_boot_read(job->boot, FLASH_BASE + offset, near, sizeof near);
        if (status == 0) {
            status = flash_boot_read(job->boot, FLASH_BASE + size + offset, far, sizeof far);
        }
        if (status == FLASH_STALL && job->boot->refusal == FLASH_REFUSED_ADDRESS) {
            return 1; /* there is no such flash at all */
        }
        if (status < 0) {
            return fail(job, status, "reading", size + offset);
        }
        if (memcmp(near, far, sizeof near) != 0) {
            return 0;
        }
        for (uint32_t j = 0; j < sizeof near; j++) {
            erased &= near[j] == 0xFF;
        }
    }
    return !erased;
}

/* Checks the size of the flash. That of an erased flash shows only when the image is read back. */
static int check_size(struct flash_job *job)
{
    const uint32_t end = job->image->sectors * FLASH_SECTOR;
    for (uint32_t size = SMALLEST; size < end; size *= 2) {
        const int found = repeats(job, size);
        if (found < 0) {
            return found;
        }
        if (found) {
            snprintf(job->error, sizeof job->error,
                     "the image ends at 0x%08x, the board's flash of %u bytes at 0x%08x; nothing was changed",
                     FLASH_BASE + end - 1, size, FLASH_BASE + size - 1);
            return FLASH_DIFFERS;
        }
    }
    return 0;
}

/* Checks that the program on the board will show the scene that is written behind it. */
static int check_shows(struct flash_job *job, const struct flash_program *program)
{
    char what[FLASH_PROGRAM_NAME + 64] = "the flash is erased";
    if (program->takes_scene) {
        return 0;
    }
    if (program->name[0] != '\0') {
        snprintf(what, sizeof what, "the board has '%s', which takes no scene at 0x%08x", program->name,
                 FLASH_BASE + FLASH_SCENE);
    } else if (!program->is_erased) {
        snprintf(what, sizeof what, "the board has a program without a name");
    }
    snprintf(job->error, sizeof job->error,
             "nothing would show the scene: %s; write an image first (make flash BOARD=x), or add --force; nothing was "
             "changed",
             what);
    return FLASH_DIFFERS;
}

/* Checks that data behind a program, a scene, do not overwrite the program, and that it will show them. */
static int check_program(struct flash_job *job)
{
    struct flash_program program;
    uint32_t first = 0;
    if (job->image->used[0]) {
        return 0;
    }
    const int status = told(job, flash_program_read(job->boot, &program), "reading", 0);
    while (first < job->image->sectors && !job->image->used[first]) {
        first++;
    }
    const uint32_t start = FLASH_BASE + first * FLASH_SECTOR;
    if (status == 0 && program.end > start) {
        snprintf(
            job->error, sizeof job->error,
            "the program on the board ends at 0x%08x and would be overwritten from 0x%08x on; make the scene a part "
            "of the image (make firmware SCENE=); nothing was changed",
            program.end - 1, start);
        return FLASH_DIFFERS;
    }
    return status == 0 && job->is_scene ? check_shows(job, &program) : status;
}

/* ---- writing and reading back ------------------------------------------------------------------- */

static int erase_sector(struct flash_job *job, uint32_t sector)
{
    const uint32_t offset = sector * FLASH_SECTOR;
    const int status = is_stopped(job) ? FLASH_STOPPED : flash_boot_erase(job->boot, FLASH_BASE + offset);
    return told(job, status, "erasing", offset);
}

static int write_sector(struct flash_job *job, uint32_t sector)
{
    const uint32_t offset = sector * FLASH_SECTOR;
    const uint8_t *bytes = job->image->bytes + offset;
    const int status =
        is_stopped(job) ? FLASH_STOPPED : flash_boot_write(job->boot, FLASH_BASE + offset, bytes, FLASH_SECTOR);
    return told(job, status, "writing", offset);
}

static int compare_sector(struct flash_job *job, uint32_t sector)
{
    uint8_t read[FLASH_SECTOR];
    const uint32_t offset = sector * FLASH_SECTOR;
    const uint8_t *wanted = job->image->bytes + offset;
    const int status =
        is_stopped(job) ? FLASH_STOPPED : flash_boot_read(job->boot, FLASH_BASE + offset, read, sizeof read);
    if (status < 0) {
        return fail(job, status, "reading back", offset);
    }
    for (uint32_t i = 0; i < sizeof read; i++) {
        if (read[i] != wanted[i]) {
            snprintf(job->error, sizeof job->error,
                     "0x%02x was read back at 0x%08x instead of 0x%02x; run this again (if it stays so, the flash is "
                     "worn out or smaller than the image)",
                     read[i], FLASH_BASE + offset + i, wanted[i]);
            return FLASH_DIFFERS;
        }
    }
    return 0;
}

/* Sectors that the image uses. */
static uint32_t count_used(const struct flash_image *image)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < image->sectors; i++) {
        count += image->used[i];
    }
    return count;
}

static void show(const struct flash_job *job, const char *what, uint32_t done, uint32_t all)
{
    if (job->progress != NULL) {
        job->progress(what, done, all);
    }
}

static int write_all(struct flash_job *job, uint32_t all)
{
    const struct flash_image *image = job->image;
    uint32_t done = 0;
    int status = image->used[0] ? erase_sector(job, 0) : 0;
    for (uint32_t i = 1; i < image->sectors && status == 0; i++) {
        if (!image->used[i]) {
            continue;
        }
        show(job, "writing", done++, all);
        status = erase_sector(job, i);
        status = status < 0 ? status : write_sector(job, i);
    }
    if (status == 0 && image->used[0]) {
        show(job, "writing", done, all);
        status = write_sector(job, 0);
    }
    show(job, "writing", all, all);
    return status;
}

static int compare_all(struct flash_job *job, uint32_t all)
{
    int status = 0;
    uint32_t done = 0;
    for (uint32_t i = 0; i < job->image->sectors && status == 0; i++) {
        if (job->image->used[i]) {
            show(job, "reading back", done++, all);
            status = compare_sector(job, i);
        }
    }
    show(job, "reading back", all, all);
    return status;
}

static int run(struct flash_job *job)
{
    const uint32_t all = count_used(job->image);
    int status = told(job, flash_boot_begin(job->boot), "preparing", 0);
    if (status == 0) {
        status = check_size(job);
    }
    if (status == 0) {
        status = check_program(job);
    }
    if (status == 0) {
        status = write_all(job, all);
    }
    if (status == 0 && job->verify) {
        status = compare_all(job, all);
    }
    return status;
}

int flash_job_run(struct flash_job *job)
{
    job->error[0] = '\0';
    const int status = run(job);
    if (status == 0 && job->reboot) {
        return told(job, flash_boot_reboot(job->boot), "rebooting from", 0);
    }
    if (status != HAL_ENODEV && status != HAL_ETIMEDOUT) {
        flash_boot_end(job->boot);
    }
    return status;
}
