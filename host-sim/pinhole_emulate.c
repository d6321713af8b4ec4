/* pinhole-emulate: runs a firmware image in QEMU and shows what its panel shows. See emulate_qemu.h. */
#define _XOPEN_SOURCE 700

#include "complain.h"
#include "crc32.h"
#include "emulate_qemu.h"
#include "frame_out.h"
#include "keys.h"
#include "option_text.h"

#include <string.h>

#define FRAMES_MAX 1000000

struct request {
    const char *machine, *board, *keys, *image, *out;
    uint32_t frames;
    bool help, log;
    struct frame_out frames_out;
};

static void print_help(void)
{
    puts("pinhole-emulate --machine lm3s6965evb|netduinoplus2 --board NAME [options] IMAGE.elf [DIR [FRAMES]]\n"
         "Runs an image of all demos (make firmware) in QEMU and prints `frame N crc32 XXXXXXXX` for each frame that "
         "its\n"
         "panel shows, as pinhole-sim --crc does. DIR gets pictures, FRAMES is 4 by default. Exits 1 when the image "
         "stops\n"
         "or QEMU or the panel resents anything.\n"
         "  --keys FILE   a script of button presses, as pinhole-sim's (not before frame 2)\n"
         "  --log         what the image writes to its UART, on stderr");
}

static bool read_option(struct request *r, const char *option, const char *value)
{
    const char **const text = strcmp(option, "--machine") == 0 ? &r->machine
                              : strcmp(option, "--board") == 0 ? &r->board
                              : strcmp(option, "--keys") == 0  ? &r->keys
                                                               : NULL;
    if (text == NULL || value == NULL) {
        return false;
    }
    *text = value;
    return true;
}

static bool read_word(struct request *r, const char *word, int n)
{
    if (n == 0) {
        r->image = word;
    } else if (n == 1) {
        r->out = word;
    }
    return n < 2 || (n == 2 && option_text_u32(word, 1, FRAMES_MAX, &r->frames));
}

static int read_arguments(struct request *r, int argc, char *argv[])
{
    int words = 0;
    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--help") == 0) {
            r->help = true;
            return 0;
        }
        if (strcmp(argv[i], "--log") == 0) {
            r->log = true;
        } else if (argv[i][0] == '-' && read_option(r, argv[i], argv[i + 1])) {
            i++;
        } else if (argv[i][0] == '-' || !read_word(r, argv[i], words++)) {
            return complain(EXIT_USAGE, "'%s': wrong option or value; see --help", argv[i]);
        }
    }
    return r->machine != NULL && r->board != NULL && r->image != NULL
               ? 0
               : complain(EXIT_USAGE, "--machine, --board and an image are needed; see --help");
}

static int show(void *context, uint32_t frame, const struct ppm *picture)
{
    const struct request *r = context;
    printf("frame %u crc32 %08X\n", (unsigned)frame,
           (unsigned)crc32_update(0, picture->rgb, (size_t)picture->width * picture->height * 3));
    fflush(stdout);
    return frame_out_put(&r->frames_out, frame, picture);
}

static int run(struct request *r)
{
    static const char *const machines[] = {"lm3s6965evb", "netduinoplus2"};
    const int machine = option_text_choice(r->machine, machines, 2);
    struct keys keys = {.count = 0};
    struct emulation e = {.board = board_find(r->board),
                          .image = r->image,
                          .frames = r->frames,
                          .keys = &keys,
                          .log = r->log ? stderr : NULL,
                          .context = r,
                          .frame = show};
    if (machine < 0 || e.board == NULL) {
        return complain(EXIT_USAGE, "--machine '%s', --board '%s': no such machine or board", r->machine, r->board);
    }
    int status = keys_read(&keys, r->keys);
    if (status == 0) {
        status = frame_out_open(&r->frames_out, r->out, true);
    }
    if (status == 0) {
        status = machine == 0 ? emulate_screen(&e) : emulate_trace(&e);
    }
    keys_free(&keys);
    return status;
}

int main(int argc, char *argv[])
{
    struct request request = {.frames = 4};
    complain_as("pinhole-emulate");
    int status = read_arguments(&request, argc, argv);
    if (status != 0) {
        return status;
    }
    if (request.help) {
        print_help();
    } else {
        status = run(&request);
    }
    return status == 0 ? complain_stdout() : status;
}
