/* pinhole-flash: an image into the flash of an RP2040 or RP2350 that is in its USB boot loader. See flash_job.h. */

#include "complain.h"
#include "flash_file.h"
#include "flash_job.h"
#include "flash_pick.h"
#include "flash_scene.h"
#include "option_table.h"
#include "progress.h"
#include "signal_stop.h"

#include <stdio.h>
#include <string.h>

struct request {
    const char *path, *serial;
    bool list, help, no_verify, no_reboot, at_scene, force;
};

/* ---- the command line --------------------------------------------------------------------------- */

static const struct option_row rows[] = {
    {"serial", "S", "the board, where several are: its serial number, or BUS:ADDRESS as --list shows it",
     "a serial number or BUS:ADDRESS", .at = offsetof(struct request, serial)},
    {"at-scene", NULL, "IMAGE is a binary scene (.phs): it goes to 0x10080000, and the image on the board shows it",
     NULL, .at = offsetof(struct request, at_scene)},
    {"force", NULL, "writes a scene also where the board has no image that would show it", NULL,
     .at = offsetof(struct request, force)},
    {"list", NULL, "the boards that are in their boot loader: BUS:ADDRESS, serial number, chip", NULL,
     .at = offsetof(struct request, list)},
    {"no-verify", NULL, "does not read back and compare what was written", NULL,
     .at = offsetof(struct request, no_verify)},
    {"no-reboot", NULL, "leaves the board in its boot loader", NULL, .at = offsetof(struct request, no_reboot)},
    {"help", NULL, "prints this, as does -h", NULL, .at = offsetof(struct request, help)},
};
static const struct option_table table = {rows, sizeof rows / sizeof rows[0]};

static void print_help(void)
{
    puts("pinhole-flash IMAGE [options]\n"
         "Writes IMAGE, a UF2 or BIN file, into the flash of an RP2040 or RP2350 that is in its boot loader (plugged "
         "in\n"
         "with BOOTSEL held; or a running Pinhole image was sent B over its UART, or started with a button held), "
         "reads it back,\n"
         "compares, and starts it.\n");
    option_table_help(&table);
    puts("\nExit status: 0 done; 1 failed; 2 wrong usage; 130, 143, 129 stopped by Ctrl-C, SIGTERM, SIGHUP.");
}

static int read_arguments(struct request *r, int argc, char *argv[])
{
    const int count = option_table_words(&table, r, argc, argv, &r->path, 1);
    if (count < 0) {
        return count;
    }
    if (r->force && !r->at_scene) {
        return complain_usage("--force goes with --at-scene; see --help");
    }
    if (r->help || r->list) {
        return r->list && r->path != NULL ? complain_usage("--list takes no image; see --help") : 0;
    }
    return r->path != NULL ? 0 : complain_usage("an image is missing: a UF2 or BIN file; see --help");
}

/* ---- boards ------------------------------------------------------------------------------------- */

static int complain_usb(int status)
{
    if (status == HAL_ENOSYS) {
        return complain("built without libusb; install libusb-1.0-0-dev and run make again");
    }
    return complain("USB devices cannot be listed");
}

static int complain_board(const struct flash_board *board, int status)
{
    const char *why = "cannot be opened; plug it in again with BOOTSEL held";
    if (status == HAL_EACCES) {
        why =
            "no permission; copy boards/udev/60-pinhole.rules to /etc/udev/rules.d, run udevadm control --reload, and "
            "plug it in again";
    } else if (status == HAL_EBUSY) {
        why = "in use by another program; end that one";
    } else if (status == HAL_ENODEV) {
        why = "unplugged; plug it in again with BOOTSEL held";
    }
    return complain("%s %u:%u: %s", flash_chip_name(board->chip), board->bus, board->address, why);
}

static int list(const struct flash_board *boards, int count)
{
    for (int i = 0; i < count; i++) {
        const struct flash_board *b = &boards[i];
        printf("%u:%u %s %s\n", b->bus, b->address, b->status < 0 ? "(cannot be opened)" : b->serial,
               flash_chip_name(b->chip));
        if (b->status < 0) {
            complain_board(b, b->status);
        }
    }
    char error[FLASH_ERROR_SIZE];
    return count == 0 && flash_pick(boards, count, FLASH_ANY, NULL, error) < 0 ? complain("%s", error) : 0;
}

/* ---- the job ------------------------------------------------------------------------------------ */

static void show_progress(const char *what, uint32_t done, uint32_t all)
{
    progress_show(what, done, all);
}

static int write_image(const struct request *r, const struct flash_image *image, const struct flash_board *board)
{
    struct flash_usb *usb = NULL;
    int status = flash_usb_open(&usb, board);
    if (status < 0) {
        return complain_board(board, status);
    }
    struct flash_boot boot = {.ops = &flash_usb_ops, .context = usb, .is_rp2350 = board->chip == FLASH_RP2350};
    struct flash_job job = {.boot = &boot,
                            .image = image,
                            .verify = !r->no_verify,
                            .reboot = !r->no_reboot,
                            .is_scene = r->at_scene && !r->force,
                            .stop = &signal_stop,
                            .progress = show_progress};
    status = flash_job_run(&job);
    flash_usb_close(usb);
    if (status < 0) {
        complain("%s %u:%u: %s", flash_chip_name(board->chip), board->bus, board->address, job.error);
        return status == FLASH_STOPPED ? status : COMPLAINED;
    }
    printf("%s %u:%u: %u bytes written%s%s\n", flash_chip_name(board->chip), board->bus, board->address,
           (unsigned)image->size, r->no_verify ? "" : ", read back and equal", r->no_reboot ? "" : ", started");
    return 0;
}

static int run(const struct request *r)
{
    struct flash_board boards[FLASH_BOARDS_MAX];
    struct flash_image image = {.sectors = 0};
    char error[FLASH_ERROR_SIZE];
    if (r->path != NULL && (r->at_scene ? flash_scene_read : flash_file_read)(&image, r->path, error) != 0) {
        return complain("%s: %s", r->path, error);
    }
    const int count = flash_usb_list(boards);
    const int picked = count < 0 || r->list ? -1 : flash_pick(boards, count, image.chip, r->serial, error);
    int status;
    if (count < 0) {
        status = complain_usb(count);
    } else if (r->list) {
        status = list(boards, count);
    } else if (picked < 0) {
        status = complain("%s", error);
    } else {
        status = write_image(r, &image, &boards[picked]);
    }
    flash_image_free(&image);
    return status;
}

int main(int argc, char *argv[])
{
    struct request request = {.path = NULL};
    complain_begin("pinhole-flash", argc, argv);
    int status = read_arguments(&request, argc, argv);
    signal_stop_catch(); /* a command that is cut off would leave a board that takes no other before it is unplugged */
    if (status == 0 && request.help) {
        print_help();
    } else if (status == 0) {
        status = run(&request);
    }
    return status == FLASH_STOPPED ? 128 + (int)signal_stop : complain_exit(status);
}
