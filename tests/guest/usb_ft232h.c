/*
 * An FT232H: the chip's vendor requests, and its MPSSE as FTDI's AN_108 lists the commands. What its pins do is told as
 * events (host-sim/wire/wire_events.h; lines AD0 .. AD7 are 0 .. 7, AC0 .. AC7 are 8 .. 15); what it reads comes from a
 * flash chip at AD3, if there is one.
 */
#define _GNU_SOURCE
#include "usb.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define FIFO_BYTES  65536 /* of answers */
#define CHUNK_BYTES 4096  /* an event */

enum {
    RESET = 0,
    MODEM = 1,
    FLOW = 2,
    BAUD = 3,
    DATA = 4,
    POLL_MODEM = 5,
    EVENT_CHAR = 6,
    ERROR_CHAR = 7,
    SET_LATENCY = 9,
    GET_LATENCY = 10,
    BIT_MODE = 11,
    READ_PINS = 12,
    READ_EEPROM = 0x90
};

static const uint8_t device_descriptor[18] = {18,   1,    0x00, 0x02, 0,    0, 0, 64, 0x03,
                                              0x04, 0x14, 0x60, 0x00, 0x09, 1, 2, 3,  1};

static const uint8_t config_descriptor[] = {
    9, 2, 32,   0, 1,    1,    0,    0xA0, 45, /* one interface, bus-powered, 90 mA */
    9, 4, 0,    0, 2,    0xFF, 0xFF, 0xFF, 2,  /* vendor's own */
    7, 5, 0x81, 2, 0x00, 0x02, 0,              /* bulk in, 512 bytes */
    7, 5, 0x02, 2, 0x00, 0x02, 0,              /* bulk out */
};

/* W25X10: 128 KB. */
struct flash {
    uint8_t *bytes;
    bool selected;
    uint8_t code;
    uint32_t count, address;
};

#define FLASH_BYTES 131072u

struct ft232h {
    struct ft232h_options options;
    struct usb_device device;
    struct flash flash;
    uint64_t start_ns, wire_ns; /* wire_ns: when the last bit is out */

    uint8_t latency_ms;
    bool mpsse, divide_by_5, loopback;
    uint16_t divisor;
    uint8_t value[2], direction[2]; /* AD, AC */

    uint8_t command[3]; /* and its parameters */
    unsigned command_bytes;
    uint32_t left; /* bytes of data that belong to it */
    uint8_t chunk[CHUNK_BYTES];
    uint32_t chunk_bytes;

    uint8_t answers[FIFO_BYTES];
    uint32_t answer_head, answer_count;
    bool flush;
};

/* ---- pins and events ---------------------------------------------------------------------------- */

/* Inputs have pull-ups. */
static unsigned levels(const struct ft232h *f)
{
    const unsigned low = (f->value[0] & f->direction[0]) | (~f->direction[0] & 0xFFu);
    const unsigned high = (f->value[1] & f->direction[1]) | (~f->direction[1] & 0xFFu);
    return low | high << 8;
}

static uint64_t now(struct ft232h *f)
{
    const uint64_t ns = usb_now_ns() - f->start_ns;
    if (f->wire_ns < ns) {
        f->wire_ns = ns;
    }
    return f->wire_ns;
}

static void tell_levels(struct ft232h *f)
{
    if (f->options.events != NULL) {
        fprintf(f->options.events, "%llu level %x\n", (unsigned long long)now(f), levels(f));
    }
}

static void tell_names(const struct ft232h *f)
{
    for (int i = 0; i < 16 && f->options.events != NULL; i++) {
        fprintf(f->options.events, "0 name %d A%c%d\n", i, i < 8 ? 'D' : 'C', i % 8);
    }
}

static uint32_t clock_hz(const struct ft232h *f)
{
    return (f->divide_by_5 ? 6000000u : 30000000u) / (1u + f->divisor);
}

static void tell_bytes(struct ft232h *f, const char *kind, const uint8_t *bytes, uint32_t n, unsigned bits)
{
    /* Bit 0: the chip's bits change with the falling edge; bit 2: it samples there. */
    const unsigned polarity = levels(f) & 1, lsb = f->command[0] >> 3 & 1;
    const unsigned falling = (f->command[0] & 0x10) != 0 ? !(f->command[0] & 1) : f->command[0] >> 2 & 1;
    const unsigned mode = polarity << 1 | (falling != polarity) | lsb << 3; /* falling: bits are taken there */
    const uint64_t start = now(f);
    if (f->options.wire_time) {
        f->wire_ns += 1000000000ull * n * bits / clock_hz(f);
    }
    if (f->options.events == NULL || n == 0) {
        return;
    }
    fprintf(f->options.events, "%llu %s - %u %u %x %u %x %x %llu ", (unsigned long long)start, kind, clock_hz(f),
            clock_hz(f), mode, bits, levels(f), levels(f), (unsigned long long)f->wire_ns);
    for (uint32_t i = 0; i < n; i++) {
        fprintf(f->options.events, "%02x", bytes[i]);
    }
    fputc('\n', f->options.events);
}

/* ---- the flash chip ----------------------------------------------------------------------------- */

static void flash_select(struct flash *flash, bool selected)
{
    if (selected != flash->selected) {
        flash->selected = selected;
        flash->count = 0;
    }
}

/* One byte in, one out, as its datasheet says: 9Fh JEDEC id, 03h read, 05h status. */
static uint8_t flash_byte(struct flash *flash, uint8_t in)
{
    static const uint8_t id[] = {0xEF, 0x30, 0x11};
    const uint32_t i = flash->count++;
    if (flash->bytes == NULL || !flash->selected) {
        return 0xFF;
    }
    if (i == 0) {
        flash->code = in;
        flash->address = 0;
        return 0xFF;
    }
    if (flash->code == 0x9F) {
        return i <= 3 ? id[i - 1] : 0;
    }
    if (flash->code == 0x05) {
        return 0;
    }
    if (flash->code == 0x03 && i <= 3) {
        flash->address = flash->address << 8 | in;
        return 0xFF;
    }
    return flash->code == 0x03 ? flash->bytes[flash->address++ % FLASH_BYTES] : 0xFF;
}

static int flash_load(struct flash *flash, const char *path)
{
    FILE *file = fopen(path, "rb");
    flash->bytes = malloc(FLASH_BYTES);
    const bool read = file != NULL && flash->bytes != NULL && fread(flash->bytes, FLASH_BYTES, 1, file) == 1;
    if (file != NULL) {
        fclose(file);
    }
    if (!read) {
        fprintf(stderr, "usb: %s: not a flash picture of %u bytes\n", path, FLASH_BYTES);
    }
    return read ? 0 : -1;
}

/* ---- MPSSE -------------------------------------------------------------------------------------- */

static void put_answer(struct ft232h *f, uint8_t byte)
{
    if (f->answer_count < FIFO_BYTES) {
        f->answers[(f->answer_head + f->answer_count++) % FIFO_BYTES] = byte;
    }
}

static void end_chunk(struct ft232h *f)
{
    tell_bytes(f, "spi", f->chunk, f->chunk_bytes, 8);
    f->chunk_bytes = 0;
}

static void shift_byte(struct ft232h *f, uint8_t byte)
{
    const uint8_t back = flash_byte(&f->flash, byte);
    if ((f->command[0] & 0x20) != 0) {
        put_answer(f, f->loopback ? byte : back);
    }
    f->chunk[f->chunk_bytes++] = byte;
    if (f->chunk_bytes == CHUNK_BYTES) {
        end_chunk(f);
    }
}

static void read_bytes(struct ft232h *f, uint32_t n)
{
    static uint8_t got[65536];
    for (uint32_t i = 0; i < n; i++) {
        got[i] = flash_byte(&f->flash, 0);
        put_answer(f, got[i]);
    }
    for (uint32_t i = 0; i < n; i += CHUNK_BYTES) {
        tell_bytes(f, "read", got + i, n - i < CHUNK_BYTES ? n - i : CHUNK_BYTES, 8);
    }
}

/* Single bits: told as a transfer of one short word. */
static void shift_bits(struct ft232h *f)
{
    const unsigned bits = (f->command[1] & 7u) + 1;
    if ((f->command[0] & 0x20) != 0) {
        put_answer(f, 0xFF);
    }
    tell_bytes(f, (f->command[0] & 0x10) != 0 ? "spi" : "read", f->command + 2, 1, bits);
}

static void set_pins(struct ft232h *f, unsigned port)
{
    f->value[port] = f->command[1];
    f->direction[port] = f->command[2];
    flash_select(&f->flash, (levels(f) & 8) == 0);
    tell_levels(f);
}

static void bad_command(struct ft232h *f)
{
    put_answer(f, 0xFA);
    put_answer(f, f->command[0]);
    if (f->options.events != NULL) {
        fprintf(f->options.events, "%llu note bad command %02x\n", (unsigned long long)now(f), f->command[0]);
    }
}

static bool is_shift(uint8_t code)
{
    return (code & 0xC0) == 0 && (code & 0x30) != 0;
}

/* Parameters of a command; -1: there is no such command. */
static int parameters_of(uint8_t code)
{
    if (is_shift(code)) {
        return (code & 2) == 0 ? 2 : (code & 0x10) != 0 ? 2 : 1;
    }
    switch (code) {
    case 0x80:
    case 0x82:
    case 0x86:
    case 0x8F:
    case 0x9E:
        return 2;
    case 0x8E:
        return 1;
    case 0x81:
    case 0x83:
    case 0x84:
    case 0x85:
    case 0x87:
    case 0x88:
    case 0x89:
    case 0x8A:
    case 0x8B:
    case 0x8C:
    case 0x8D:
    case 0x94:
    case 0x95:
    case 0x96:
    case 0x97:
        return 0;
    default:
        return -1;
    }
}

static void shift(struct ft232h *f)
{
    const uint32_t n = (f->command[1] | (uint32_t)f->command[2] << 8) + 1;
    if ((f->command[0] & 2) != 0) {
        shift_bits(f);
    } else if ((f->command[0] & 0x10) != 0) {
        f->left = n; /* its data follows */
    } else {
        read_bytes(f, n);
    }
}

static void execute(struct ft232h *f)
{
    const uint8_t code = f->command[0];
    if (is_shift(code)) {
        shift(f);
        return;
    }
    switch (code) {
    case 0x80:
    case 0x82:
        set_pins(f, code == 0x82);
        break;
    case 0x81:
    case 0x83:
        put_answer(f, (uint8_t)(levels(f) >> (code == 0x83 ? 8 : 0)));
        break;
    case 0x84:
    case 0x85:
        f->loopback = code == 0x84;
        break;
    case 0x86:
        f->divisor = (uint16_t)(f->command[1] | f->command[2] << 8);
        break;
    case 0x87:
        f->flush = true;
        break;
    case 0x8A:
    case 0x8B:
        f->divide_by_5 = code == 0x8B;
        break;
    default:
        break; /* without effect on SPI */
    }
}

static void take_command_byte(struct ft232h *f, uint8_t byte)
{
    f->command[f->command_bytes++] = byte;
    const int parameters = parameters_of(f->command[0]);
    if (parameters < 0) {
        bad_command(f);
        f->command_bytes = 0;
    } else if ((int)f->command_bytes == 1 + parameters) {
        f->command_bytes = 0;
        execute(f);
    }
}

static void take_byte(struct ft232h *f, uint8_t byte)
{
    if (f->left == 0) {
        take_command_byte(f, byte);
        return;
    }
    shift_byte(f, byte);
    if (--f->left == 0) {
        end_chunk(f);
    }
}

/* ---- USB ---------------------------------------------------------------------------------------- */

static int take_out(void *context, unsigned endpoint, const uint8_t *data, int n)
{
    struct ft232h *f = context;
    if (endpoint != 2) {
        return -EPIPE;
    }
    for (int i = 0; i < n && f->mpsse; i++) {
        take_byte(f, data[i]);
    }
    if (!f->mpsse && n > 0 && f->options.events != NULL) {
        fprintf(f->options.events, "%llu note %d bytes outside of MPSSE\n", (unsigned long long)now(f), n);
    }
    if (f->options.events != NULL) {
        fflush(f->options.events);
    }
    const uint64_t ns = usb_now_ns() - f->start_ns;
    if (f->options.wire_time && f->wire_ns > ns) {
        usleep((useconds_t)((f->wire_ns - ns) / 1000));
    }
    return n;
}

/* Packets of 512 bytes, each with two status bytes first; nothing but those when the latency timer ends. */
static int give_in(void *context, unsigned endpoint, uint8_t *data, int room, unsigned waited_ms)
{
    struct ft232h *f = context;
    int n = 0;
    if (endpoint != 1) {
        return -EPIPE;
    }
    if (f->answer_count < 510 && !f->flush && waited_ms < f->latency_ms) {
        return USB_WAIT;
    }
    do {
        const int end = n + 512 < room ? n + 512 : room;
        if (end - n < 2) {
            break;
        }
        data[n++] = 0x32; /* CTS, DSR, as an idle chip says */
        data[n++] = 0x60; /* transmitter empty */
        for (; n < end && f->answer_count > 0; f->answer_count--) {
            data[n++] = f->answers[f->answer_head++ % FIFO_BYTES];
        }
    } while (n % 512 == 0 && n < room && f->answer_count > 0);
    f->flush = f->flush && f->answer_count > 0;
    return n;
}

static int vendor(void *context, const uint8_t setup[8], uint8_t *data, int n)
{
    struct ft232h *f = context;
    (void)n;
    switch (setup[1]) {
    case RESET:
        if (setup[2] == 0 || setup[2] == 1) {
            f->answer_count = 0;
        }
        return 0;
    case MODEM:
    case FLOW:
    case BAUD:
    case DATA:
    case EVENT_CHAR:
    case ERROR_CHAR:
        return 0;
    case POLL_MODEM:
        data[0] = 0x32;
        data[1] = 0x60;
        return 2;
    case SET_LATENCY:
        f->latency_ms = setup[2];
        return 0;
    case GET_LATENCY:
        data[0] = f->latency_ms;
        return 1;
    case BIT_MODE:
        f->mpsse = setup[3] == 2;
        f->command_bytes = 0;
        f->left = 0;
        if (!f->mpsse) { /* the pins are a serial port again */
            f->direction[0] = f->direction[1] = 0;
            tell_levels(f);
        }
        return 0;
    case READ_PINS:
        data[0] = (uint8_t)levels(f);
        return 1;
    case READ_EEPROM: /* none fitted */
        data[0] = data[1] = 0xFF;
        return 2;
    default:
        return -EPIPE;
    }
}

struct usb_device *ft232h_new(const struct ft232h_options *options)
{
    struct ft232h *f = calloc(1, sizeof *f);
    if (f == NULL || (options->flash != NULL && flash_load(&f->flash, options->flash) != 0)) {
        free(f);
        return NULL;
    }
    f->options = *options;
    f->latency_ms = 16;
    f->divide_by_5 = true;
    f->start_ns = usb_now_ns();
    f->device = (struct usb_device){.speed = 3,
                                    .device = device_descriptor,
                                    .config = config_descriptor,
                                    .strings = {NULL, "FTDI", "Single RS232-HS", options->serial},
                                    .context = f,
                                    .control = vendor,
                                    .out = take_out,
                                    .in = give_in};
    tell_names(f);
    tell_levels(f);
    return &f->device;
}
