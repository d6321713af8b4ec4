/* pinhole-flash: an image into the flash of an RP2040 or RP2350 that is in its USB boot loader. See flash_job.h. */

#include "complain.h"
#include "file_save.h"
#include "flash_file.h"
#include "flash_job.h"
#include "flash_join.h"
#include "flash_pick.h"
#include "flash_scene.h"
#include "option_table.h"
#include "progress.h"
#include "signal_stop.h"

#include <stdio.h>
#include <stdlib.h>

struct request {
    const char *path, *serial, *scene, *out;
    bool list, help, no_verify, no_reboot, at_scene, force;
};

/* ---- the command line --------------------------------------------------------------------------- */

static const struct option_row rows[] = {
    {"serial", "S", "the board, where several are: its serial number, or BUS:ADDRESS as --list shows it",
     "a serial number or BUS:ADDRESS", .at = offsetof(struct request, serial)},
    {"at-scene", NULL, "IMAGE is a binary scene (.phs): it goes to 0x10080000, and the image on the board shows it",
     NULL, .at = offsetof(struct request, at_scene)},
    {"scene", "FILE.phs", "puts a binary scene into IMAGE, a UF2 file that shows one, at 0x10080000", "a binary scene",
     .at = offsetof(struct request, scene)},
    {"out", "FILE.uf2", "writes IMAGE with its --scene as a file for the drive of the boot loader; no board is needed",
     "a file", .at = offsetof(struct request, out)},
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
    if (r->scene != NULL && r->at_scene) {
        return complain_usage("--scene goes into an image, --at-scene behind one; see --help");
    }
    if (r->out != NULL && r->scene == NULL) {
        return complain_usage("--out goes with --scene; see --help");
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
    return complain("%s %u:%u: %s", flash_chip_name(board->chip), board->bus, board->address, flash_pick_why(status));
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

/* ---- image and scene ---------------------------------------------------------------------------- */

static int save(const char *path, const uint8_t *bytes, size_t n)
{
    const int status = file_save_bytes(path, bytes, n);
    if (status == 0) {
        printf("%s: %zu bytes; copy it onto the drive of the boot loader, RPI-RP2 or RP2350\n", path, n);
    }
    return status;
}

/* Joins the scene to the image. With --out the result is saved, else it is the image for the board. */
static int join(const struct request *r, struct flash_image *image, char *error)
{
    size_t n = 0, scene_n = 0, joined_n = 0;
    uint8_t *const uf2 = flash_file_load(r->path, &n, error);
    uint8_t *const scene = uf2 != NULL ? flash_file_load(r->scene, &scene_n, error) : NULL;
    uint8_t *const joined = scene != NULL ? flash_join(uf2, n, scene, scene_n, FLASH_SPAN, &joined_n, error) : NULL;
    int status = PH_ERR_INVAL;
    if (uf2 != NULL && scene == NULL) {
        status = complain("%s: %s", r->scene, error);
    } else if (joined != NULL) {
        status = r->out != NULL ? save(r->out, joined, joined_n) : flash_file_parse(image, joined, joined_n, error);
    }
    free(uf2);
    free(scene);
    free(joined);
    return status;
}

static int read_image(const struct request *r, struct flash_image *image, char *error)
{
    return r->scene != NULL ? join(r, image, error)
           : r->at_scene    ? flash_scene_read(image, r->path, error)
                            : flash_file_read(image, r->path, error);
}

static int run(const struct request *r)
{
    struct flash_board boards[FLASH_BOARDS_MAX];
    struct flash_image image = {.sectors = 0};
    char error[FLASH_ERROR_SIZE];
    const int read = r->path != NULL ? read_image(r, &image, error) : 0;
    if (read != 0 || r->out != NULL) {
        return read == 0 || read == COMPLAINED ? read : complain("%s: %s", r->path, error);
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
