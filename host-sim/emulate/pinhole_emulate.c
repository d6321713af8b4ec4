/* pinhole-emulate: runs a firmware image in QEMU and shows what its panel shows. See emulate.h. */

#include "complain.h"
#include "crc32.h"
#include "emulate.h"
#include "frame_out.h"
#include "option_table.h"
#include "option_text.h"

#include <stdio.h>

#define FRAMES_MAX 1000000

static const char *const machines[] = {"lm3s6965evb", "netduinoplus2"};

struct request {
    int machine; /* of machines; -1: none named */
    const struct board *board;
    const char *keys, *image, *out;
    uint32_t frames;
    bool help, log;
    struct frame_out frames_out;
};

static bool set_machine(void *to, const char *name)
{
    struct request *r = to;
    r->machine = option_text_choice(name, machines, 2);
    return r->machine >= 0;
}

static bool set_board(void *to, const char *name)
{
    struct request *r = to;
    r->board = board_find(name);
    return r->board != NULL;
}

static const struct option_row rows[] = {
    {"machine", "lm3s6965evb|netduinoplus2", "the machine of QEMU", "lm3s6965evb or netduinoplus2", .set = set_machine},
    {"board", "NAME", "the image's kit", "a name that pinhole-sim --list shows", .set = set_board,
     .names = nearest_board},
    {"keys", "FILE", "a script of button presses, as for pinhole-sim (not before frame 2)", "a file",
     .at = offsetof(struct request, keys)},
    {"log", NULL, "shows on stderr what the image writes to its UART", NULL, .at = offsetof(struct request, log)},
    {"help", NULL, "prints this, as does -h", NULL, .at = offsetof(struct request, help)},
};

static const struct option_table table = {rows, sizeof rows / sizeof rows[0]};

static void print_help(void)
{
    puts("pinhole-emulate --machine MACHINE --board NAME [options] IMAGE.elf [DIR [FRAMES]]\n"
         "Runs an image of all demos (make firmware) in QEMU and prints `frame N crc32 XXXXXXXX` for each frame that\n"
         "its panel shows, as pinhole-sim --crc does. DIR gets pictures, FRAMES is 4 by default.\n");
    option_table_help(&table);
    puts("\nExit status: 0 done; 1 failed, the image stopped, or QEMU or the panel complained; 2 wrong usage.");
}

static int read_arguments(struct request *r, int argc, char *argv[])
{
    const char *words[3] = {NULL, NULL, NULL};
    const int count = option_table_words(&table, r, argc, argv, words, 3);
    r->image = words[0];
    r->out = words[1];
    if (count < 0) {
        return count;
    }
    if (count == 3 && !option_text_u32(words[2], 1, FRAMES_MAX, &r->frames)) {
        return complain_usage("'%s': FRAMES must be a whole number, 1 .. %d", words[2], FRAMES_MAX);
    }
    return r->help || (r->machine >= 0 && r->board != NULL && r->image != NULL)
               ? 0
               : complain_usage("--machine, --board and an image are needed; see --help");
}

static int show(void *context, uint32_t frame, const struct ppm *picture)
{
    struct request *r = context;
    printf("frame %u crc32 %08X\n", (unsigned)frame,
           (unsigned)crc32_update(0, picture->rgb, (size_t)picture->width * picture->height * 3));
    fflush(stdout);
    return frame_out_put(&r->frames_out, frame, picture);
}

static int run(struct request *r)
{
    struct key_script keys = {.count = 0};
    struct emulation e = {.board = r->board,
                          .image = r->image,
                          .frames = r->frames,
                          .keys = &keys,
                          .log = r->log ? stderr : NULL,
                          .context = r,
                          .frame = show};
    int status = emulate_image_check(r->image, r->machine == 0 ? 0 : 0x08000000);
    if (status == 0) {
        status = key_script_read(&keys, r->keys);
    }
    if (status == 0) {
        status = frame_out_open(&r->frames_out, r->out, true, r->frames);
    }
    if (status == 0) {
        status = r->machine == 0 ? emulate_screen(&e) : emulate_trace(&e);
    }
    key_script_free(&keys);
    return frame_out_close(&r->frames_out, status);
}

int main(int argc, char *argv[])
{
    struct request request = {.machine = -1, .frames = 4};
    complain_begin("pinhole-emulate", argc, argv);
    int status = read_arguments(&request, argc, argv);
    if (status == 0 && request.help) {
        print_help();
    } else if (status == 0) {
        status = run(&request);
    }
    return complain_exit(status);
}
