/*
 * page_flash: pinhole-flash in the page's module, which page_flash.mjs calls: an image and a scene become one UF2 file,
 * and a job writes it into a board, over transfers that the page makes (page_usb.mjs).
 *
 * A transfer in a browser ends later, and C cannot wait for it. So flash_job runs anew from its start for each
 * transfer: the answers to all transfers before are kept, and the first transfer without an answer ends the run. The
 * job depends on nothing but these answers, so each run makes the same transfers in the same order. An image of s
 * sectors takes 8 s transfers, and so 32 s * s answers are read again: below a second for 512 KB.
 */
#ifndef PAGE_FLASH_H
#define PAGE_FLASH_H

#include "page.h"

/* Returns 8-byte aligned memory for n bytes of an image's UF2 file, or of a binary scene. NULL: there is none. */
PAGE_EXPORT uint8_t *page_flash_room(int is_scene, uint32_t n);

/* Joins both as flash_join does; without a scene (n was 0) takes the image alone. 0 or a message. */
PAGE_EXPORT int page_flash_join(uint32_t flash_bytes);

/* Returns the UF2 file that was made, and its bytes. */
PAGE_EXPORT const uint8_t *page_flash_uf2(void);
PAGE_EXPORT uint32_t page_flash_uf2_bytes(void);

/* Prints why a board of this chip (enum flash_chip) is not there or cannot be opened: a status as in flash_boot.h, 0
 * for "none was chosen". */
PAGE_EXPORT void page_flash_why(int chip, int status);

/* Begins a job, which writes that file, reads it back and starts it. */
PAGE_EXPORT void page_flash_begin(void);

enum page_flash_want {
    PAGE_FLASH_DONE,
    PAGE_FLASH_OUT,    /* send the bytes (of size 0, too) to the bulk endpoint */
    PAGE_FLASH_IN,     /* receive so many from it */
    PAGE_FLASH_STATUS, /* GET_COMMAND_STATUS, 16 bytes */
    PAGE_FLASH_RESET,  /* INTERFACE_RESET, and no endpoint is halted any more */
};

/* Goes on up to the next transfer, which is to be made and answered before the next call. PAGE_FLASH_DONE: it is over,
 * and a message (stderr) or a line (stdout) tells how. */
PAGE_EXPORT int page_flash_run(void);

/* Returns the bytes of the transfer: to be sent, or memory for what is received; and their number. */
PAGE_EXPORT uint8_t *page_flash_bytes(void);
PAGE_EXPORT uint32_t page_flash_size(void);

/* Answers it: 0 or more, or a status as in flash_boot.h. */
PAGE_EXPORT void page_flash_answer(int status);

/* Ends the job before its next command, as Ctrl-C ends pinhole-flash. */
PAGE_EXPORT void page_flash_stop(void);

/* Prints on stdout how far it is, as an object of JSON: what, done, all. */
PAGE_EXPORT void page_flash_progress(void);

#endif
