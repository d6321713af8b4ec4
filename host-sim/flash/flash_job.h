/*
 * flash_job: writes an image into the flash of a board. The first sector is erased first and written last: without
 * boot2 a board that was left halfway starts in its boot loader again, without a button held, and a second run
 * completes.
 */
#ifndef FLASH_JOB_H
#define FLASH_JOB_H

#include "flash_boot.h"
#include "flash_image.h"

#include <signal.h>
#include <stdbool.h>

struct flash_job {
    struct flash_boot *boot;
    const struct flash_image *image;
    bool verify, reboot;
    bool is_scene;                                                   /* is refused where no program would show it */
    const volatile sig_atomic_t *stop;                               /* not 0: stop after this command */
    void (*progress)(const char *what, uint32_t done, uint32_t all); /* sectors; all of them: it is over */
    char error[FLASH_ERROR_SIZE];
};

/* Runs a job. 0, or a status as in flash_boot.h with a line in error: what, where, what to do. */
int flash_job_run(struct flash_job *job);

#endif
