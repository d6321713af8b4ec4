/* Runs a firmware image on an emulated RP2350 and writes the events on its wires. */
#include "record.h"
#include "rom.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

static const char help[] =
    "rp2350-emulate IMAGE.bin|IMAGE.uf2 --dc PIN [options]\n"
    "Runs an image of an RP2350 board and writes the events on its wires. The options are those of\n"
    "host-sim/emulate/rp2040/emulate.mjs: --frames N, --events FILE, --report FILE, --cores 1|2, --dc PIN,\n"
    "--press FRAME:PINS, --charge US, --send FRAME:TEXT, --fault FRAME, --calls ADDRESSES, --jump FRAME:N, --delays "
    "SEED,\n"
    "--chip NAME=N,.., --free-wire, --free-flash, --limit-ms N. Also --flash "
    "ID[,STATUS2][,locked][,sfdp][,EARLIEST:LATEST]:\n"
    "what the flash answers to 9Fh, its status register 2, whether it refuses to change it, whether it tells "
    "parameters "
    "by 5Ah,\n"
    "when its bits change behind SCK's falling edge, in ps. It is ef4016,2,5000:7500 else.\n"
    "The image's UART goes to stderr. Exit status 1: the emulator objected, or the frames did not come.\n";

struct by_frame {
    int32_t frame;
    const char *text;
};

struct list {
    struct by_frame *entry;
    uint32_t count;
};

static struct {
    const char *image, *events, *report, *calls, *chip;
    uint32_t frames, cores, dc, seed, limit_ms;
    int32_t select, fault;
    struct list press, send, jump;
} options = {
    .events = "-", .chip = "", .frames = 16, .cores = 2, .dc = 64, .select = -1, .fault = -2, .limit_ms = 60000};

static struct chip chip;
static uint32_t uf2_family; /* of the file; 0: it is no UF2 file */
static FILE *report;

/* What a frame is measured by. */
struct moment {
    uint64_t time, bus, resting, idle[CORES];
};

#define ENDS_MOST 16

static struct {
    int32_t frame;
    uint32_t done, objections;
    uint64_t bus, given, out; /* time of words; bytes given to the bus, and on the wire */
    struct moment begun;
    bool has_begun;
    uint64_t ends[ENDS_MOST]; /* `given` at the ends of frames that are not yet out */
    uint32_t end_count, uart_length;
    char uart[512];
} run = {.frame = -1};

static _Noreturn void fail(const char *text)
{
    fprintf(stderr, "emulate: %s\n", text);
    exit(1);
}

static double now_ms(void)
{
    return (double)chip.now / 1e12;
}

static void warned(void *user, const char *text)
{
    (void)user;
    if (run.objections++ < 10) {
        fprintf(stderr, "emulate: at %.3f ms: %s\n", now_ms(), text);
    }
    chip.limit = 0;
}

static void troubled(void *user, const char *text)
{
    (void)user;
    fprintf(stderr, "emulate: at %.3f ms: %s\n", now_ms(), text);
}

static void sent_byte(void *user, uint8_t byte)
{
    (void)user;
    run.uart[run.uart_length++] = (char)byte;
    if (byte == '\n' || run.uart_length == sizeof run.uart) {
        fwrite(run.uart, 1, run.uart_length, stderr);
        run.uart_length = 0;
    }
}

static void measure(void)
{
    struct moment now = {chip.now, run.bus, chip.resting, {0}};
    for (uint32_t i = 0; i < options.cores; i++) {
        now.idle[i] = chip_idle(&chip.core[i]);
    }
    if (run.has_begun && report != NULL) {
        const double us = (double)(now.time - run.begun.time) / 1e9;
        fprintf(report, "%d %.1f %.1f %.1f", run.frame, us, (double)(now.bus - run.begun.bus) / 1e9,
                (double)(now.resting - run.begun.resting) / 1e9);
        for (uint32_t i = 0; i < options.cores; i++) {
            const double load = 100 - (double)(now.idle[i] - run.begun.idle[i]) / us / 1e7;
            fprintf(report, " %.1f", chip.core[i].started ? load : 0);
        }
        putc('\n', report);
        fflush(report);
    }
    run.begun = now;
    run.has_begun = true;
}

static const char *text_of(const struct list *list, int32_t frame)
{
    for (uint32_t i = 0; i < list->count; i++) {
        if (list->entry[i].frame == frame) {
            return list->entry[i].text;
        }
    }
    return NULL;
}

static void set_pins(void)
{
    const char *text = text_of(&options.press, run.frame);
    if (text == NULL) {
        return;
    }
    chip.low = 0;
    for (char *end; *text != '\0'; text = *end == '+' ? end + 1 : end) {
        const unsigned long pin = strtoul(text, &end, 10);
        if (end == text || pin >= PINS) {
            fail("--press: FRAME:PINS, e.g. 3:12+13");
        }
        chip.low |= 1U << pin;
    }
}

static void begin_frame(void)
{
    measure();
    run.frame++;
    set_pins();
    if (chip.seed != 0) {
        chip_set_delays(&chip, (uint32_t)run.frame);
    }
    const char *text = text_of(&options.send, run.frame);
    for (; text != NULL && *text != '\0'; text++) {
        uart_feed(&chip, (uint8_t)*text);
    }
    if (options.fault == run.frame) {
        core_fault(&chip.core[0]);
    }
}

static void end_frames(void)
{
    while (run.end_count > 0 && run.out >= run.ends[0]) {
        memmove(run.ends, run.ends + 1, --run.end_count * sizeof *run.ends);
        record_note("frame");
        run.done++;
    }
}

/* The number of a frame's scene: the last jump says how far it is ahead. */
static uint32_t scene_of(uint32_t number)
{
    int32_t from = -1;
    uint32_t scene = number;
    for (uint32_t i = 0; i < options.jump.count; i++) {
        const struct by_frame *jump = &options.jump.entry[i];
        if (jump->frame > from && jump->frame <= (int32_t)number) {
            from = jump->frame;
            scene = number - (uint32_t)from + (uint32_t)strtoul(jump->text, NULL, 10);
        }
    }
    return scene;
}

/* Notes calls that the option `calls` names: a frame is sent, bus_write, bus_write_rows, and those that make a scene.
 */
static void called(void *user, struct core *core)
{
    (void)user;
    const uint32_t at = core->next;
    if (at == chip.calls[0]) {
        if (run.frame >= 0 && run.end_count < ENDS_MOST) {
            run.ends[run.end_count++] = run.given;
            end_frames();
        }
        begin_frame();
    } else if (at == chip.calls[1]) {
        run.given += core_argument(core, 3);
    } else if (at == chip.calls[2]) {
        run.given += (uint64_t)core_argument(core, 2) * core_argument(core, 4);
    } else {
        core_set_argument(core, 1, scene_of(core_argument(core, 1)));
    }
}

static void sent_word(void *user, const struct spi *spi, uint32_t bits)
{
    (void)user;
    if (options.calls == NULL && spi->word == 0x2c && bits == 8 && (chip.levels >> options.dc & 1) == 0) {
        run.done = run.frame > 0 ? (uint32_t)run.frame : 0;
        begin_frame();
    }
    run.bus += spi->end - spi->start;
    run.out += bits / 8;
    record_word(spi, bits);
    end_frames();
}

static void word_started(void *user)
{
    (void)user;
    record_word_start();
}

static void levels_changed(void *user)
{
    (void)user;
    record_levels();
}

static uint32_t number(const char *name, const char *text)
{
    char *end;
    const unsigned long value = strtoul(text, &end, 10);
    if (end == text || *end != '\0' || value > UINT32_MAX) {
        fprintf(stderr, "rp2350-emulate: %s %s: a whole number\n", name, text);
        exit(2);
    }
    return (uint32_t)value;
}

static void add(struct list *list, const char *name, const char *text)
{
    char *end;
    const long frame = strtol(text, &end, 10);
    struct by_frame *more = realloc(list->entry, (list->count + 1) * sizeof *more);
    if (more == NULL || end == text || *end != ':') {
        fprintf(stderr, "rp2350-emulate: %s %s: FRAME:TEXT\n", name, text);
        exit(2);
    }
    list->entry = more;
    more[list->count++] = (struct by_frame){(int32_t)frame, end + 1};
}

static bool set_number(const char *name, const char *value)
{
    const struct {
        const char *name;
        uint32_t *to;
    } numbers[] = {{"--frames", &options.frames},
                   {"--cores", &options.cores},
                   {"--dc", &options.dc},
                   {"--delays", &options.seed},
                   {"--limit-ms", &options.limit_ms}};
    for (uint32_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
        if (strcmp(name, numbers[i].name) == 0) {
            *numbers[i].to = number(name, value);
            return true;
        }
    }
    return false;
}

static bool set_text(const char *name, const char *value)
{
    if (strcmp(name, "--events") == 0) {
        options.events = value;
    } else if (strcmp(name, "--report") == 0) {
        options.report = value;
    } else if (strcmp(name, "--calls") == 0) {
        options.calls = value;
    } else if (strcmp(name, "--chip") == 0) {
        options.chip = value;
    } else if (strcmp(name, "--select") == 0) {
        options.select = (int32_t)number(name, value);
    } else if (strcmp(name, "--fault") == 0) {
        options.fault = (int32_t)number(name, value);
    } else if (strcmp(name, "--charge") == 0) {
        chip.charge = number(name, value) * FS_PER_US;
    } else if (strcmp(name, "--flash") == 0) {
        if (!flash_is(&chip.flash_chip, value)) {
            fprintf(stderr, "rp2350-emulate: --flash %s: ID[,STATUS2][,locked][,sfdp][,EARLIEST:LATEST]\n", value);
            exit(2);
        }
    } else if (strcmp(name, "--press") == 0) {
        add(&options.press, name, value);
    } else if (strcmp(name, "--send") == 0) {
        add(&options.send, name, value);
    } else if (strcmp(name, "--jump") == 0) {
        add(&options.jump, name, value);
    } else {
        return false;
    }
    return true;
}

/* Reads options: NAME VALUE or NAME=VALUE. */
static void read_options(char **argument)
{
    for (; *argument != NULL; argument++) {
        char *equals = strncmp(*argument, "--", 2) == 0 ? strchr(*argument, '=') : NULL;
        if (strcmp(*argument, "--help") == 0) {
            fputs(help, stdout);
            exit(0);
        } else if (strcmp(*argument, "--free-wire") == 0) {
            chip.free_wire = true;
        } else if (strcmp(*argument, "--free-flash") == 0) {
            chip.free_flash = true;
        } else if (strncmp(*argument, "--", 2) != 0 && options.image == NULL) {
            options.image = *argument;
        } else {
            const char *name = *argument, *value = equals != NULL ? equals + 1 : argument[1] != NULL ? *++argument : "";
            if (equals != NULL) {
                *equals = '\0';
            }
            if (!set_number(name, value) && !set_text(name, value)) {
                fprintf(stderr, "rp2350-emulate: %s: no such option; see --help\n", name);
                exit(2);
            }
        }
    }
    if (options.image == NULL || options.dc >= PINS || options.cores < 1 || options.cores > CORES) {
        fprintf(stderr, "rp2350-emulate: one image and --dc PIN are wanted; see --help\n");
        exit(2);
    }
}

static void check(const char *refused)
{
    if (refused != NULL) {
        fprintf(stderr, "emulate: %s: the boot ROM would not start this image\n", refused);
        exit(1);
    }
}

static uint32_t read_image(uint8_t *image)
{
    static uint8_t file[2 * FLASH_BYTES + 1024];
    FILE *from = fopen(options.image, "rb");
    const size_t bytes = from == NULL ? 0 : fread(file, 1, sizeof file, from);
    if (from == NULL || ferror(from) || bytes < 16) {
        fprintf(stderr, "emulate: %s cannot be read\n", options.image);
        exit(1);
    }
    fclose(from);
    memset(image, 0xff, FLASH_BYTES);
    if (rom_word(file) == 0x0a324655) {
        struct rom_uf2 uf2 = {.bytes = 0};
        check(rom_uf2_refused(file, (uint32_t)bytes, image, &uf2));
        uf2_family = uf2.family;
        return uf2.bytes;
    }
    if (bytes > FLASH_BYTES) {
        fail("the image is larger than 16 MB");
    }
    memcpy(image, file, bytes);
    return (uint32_t)bytes;
}

/* The boot loader starts the CPU of the file's family. The ROM may change to that of the image definition after that,
 * but not where OTP forbids it, so both have to say the same. */
static const char *image_refused(const uint8_t *image, uint32_t bytes)
{
    const char *refused = rom_refuses(&chip, image, bytes);
    return refused == NULL && uf2_family != 0 && uf2_family != (chip.riscv ? 0xe48bff5a : 0xe48bff59)
               ? "the UF2 file's family is not that of the image definition"
               : refused;
}

static void read_calls(const char *text)
{
    for (char *end; *text != '\0' && chip.call_count < CALLS_MOST; text = *end == ',' ? end + 1 : end) {
        chip.calls[chip.call_count++] = (uint32_t)strtoul(text, &end, 16) & ~1U;
        if (end == text) {
            fail("--calls: addresses, separated by commas");
        }
    }
}

static FILE *open_for_writing(const char *path)
{
    FILE *to = strcmp(path, "-") == 0 ? stdout : fopen(path, "w");
    if (to == NULL) {
        fprintf(stderr, "emulate: %s cannot be written\n", path);
        exit(1);
    }
    return to;
}

static bool is_done(void)
{
    return options.calls != NULL ? run.done >= options.frames : run.frame >= (int32_t)options.frames;
}

static void go(void)
{
    const uint64_t limit = options.limit_ms * 1000 * FS_PER_US;
    while (!is_done() && chip.now <= limit && run.objections == 0 && chip_go_on(&chip)) {
    }
}

static int finish(void)
{
    const bool written = record_close();
    for (uint32_t i = 0; i < options.cores; i++) {
        if (chip.core[i].started) {
            fprintf(stderr, "emulate: core %u: lowest stack %x\n", i, chip.core[i].lowest);
        }
    }
    fprintf(stderr, "emulate: M0_TIMING %08x, M0_RFMT %08x, M0_RCMD %08x; %u misses of the cache\n", chip.qmi.timing,
            chip.qmi.rfmt, chip.qmi.rcmd, chip.xip.accesses - chip.xip.hits);
    if (!written) {
        fail("the events cannot be written");
    }
    if (run.objections > 0) {
        fprintf(stderr, "emulate: %u objections of the emulator\n", run.objections);
        return 1;
    }
    if (chip.ended != NULL) {
        fprintf(stderr, "emulate: ended in frame %d: %s\n", run.frame, chip.ended);
    } else if (!is_done()) {
        fprintf(stderr, "emulate: only %u frames in %u ms\n", run.done, options.limit_ms);
        return 1;
    }
    return 0;
}

int main(int count, char **arguments)
{
    static uint8_t image[FLASH_BYTES];
    (void)count;
    (void)flash_is(&chip.flash_chip, "ef4016,2,5000:7500");
    read_options(arguments + 1);
    const uint32_t bytes = read_image(image);
    check(image_refused(image, bytes));
    record_open(open_for_writing(options.events), &chip);
    report = options.report == NULL ? NULL : open_for_writing(options.report);
    if (options.select >= 0) {
        record_name((uint32_t)options.select, "select");
    }
    read_calls(options.calls == NULL ? "" : options.calls);
    chip.hooks =
        (struct chip_hooks){NULL, sent_word, word_started, levels_changed, sent_byte, troubled, warned, called};
    chip.seed = options.seed;
    facts_init(&chip);
    if (!facts_set(&chip, options.chip)) {
        fail("--chip: ring, id, reset or reason = N, separated by commas");
    }
    chip_init(&chip, options.cores, image, bytes);
    set_pins();
    go();
    return finish();
}
