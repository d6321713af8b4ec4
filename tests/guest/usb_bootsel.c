/* An RP2040 or RP2350 in its USB boot loader: the PICOBOOT interface of the RP2040 datasheet, section 2.8.5, and of the
 * RP2350 datasheet, section 5.6, which has REBOOT2 in place of REBOOT. */
#define _GNU_SOURCE
#include "usb.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define MAGIC      0x431fd10bu
#define FLASH_BASE 0x10000000u
#define RAM_BASE   0x20000000u
#define RAM_BYTES  0x42000u
#define ROM_BYTES  0x4000u
#define SECTORS    4096u /* of 16 MB */

enum { EXCLUSIVE = 1, REBOOT = 2, ERASE = 3, WRITE = 5, EXIT_XIP = 6, ENTER_XIP = 7, REBOOT2 = 10, READ = 0x84 };
enum { OK = 0, UNKNOWN_COMMAND = 1, BAD_ARGUMENTS = 2, BAD_LENGTH = 3, BAD_ADDRESS = 4, BAD_ALIGNMENT = 5 };
enum { INTERFACE_RESET = 0x41, COMMAND_STATUS = 0x42 };

/* A disk (that nobody uses here) and PICOBOOT. */
static const uint8_t config_descriptor[] = {
    9, 2, 55, 0, 2, 1,    0, 0x80, 250,                                                   /* two interfaces */
    9, 4, 0,  0, 2, 8,    6, 0x50, 0,   7, 5, 0x81, 2, 64, 0, 0, 7, 5, 0x02, 2, 64, 0, 0, /* mass storage */
    9, 4, 1,  0, 2, 0xFF, 0, 0,    0,   7, 5, 0x03, 2, 64, 0, 0, 7, 5, 0x84, 2, 64, 0, 0, /* PICOBOOT */
};

enum phase { COMMAND, DATA_IN, DATA_OUT, ACK_IN, ACK_OUT };

struct bootsel {
    struct bootsel_options options;
    struct usb_device device;
    uint8_t descriptor[18];
    uint8_t *flash;
    int file;
    uint8_t ram[RAM_BYTES];
    uint8_t rom[ROM_BYTES];

    enum phase phase;
    bool halted_in, halted_out;
    uint8_t command;
    uint32_t token, status;
    uint32_t address, left;
    bool rebooting;
    bool stalled[8][SECTORS]; /* by command and sector */
};

static uint32_t u32(const uint8_t *p)
{
    return p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24;
}

static void put_u32(uint8_t *p, uint32_t v)
{
    for (int i = 0; i < 4; i++) {
        p[i] = (uint8_t)(v >> (8 * i));
    }
}

/* n bytes at an address of the chip; NULL: there is no such memory. */
static uint8_t *memory(struct bootsel *b, uint32_t address, uint32_t n)
{
    const struct {
        uint32_t base, size;
        uint8_t *bytes;
    } areas[] = {{FLASH_BASE, b->options.flash_bytes, b->flash}, {RAM_BASE, RAM_BYTES, b->ram}, {0, ROM_BYTES, b->rom}};
    for (size_t i = 0; i < 3; i++) {
        const uint32_t offset = address - areas[i].base;
        if (address >= areas[i].base && offset < areas[i].size && n <= areas[i].size - offset) {
            return areas[i].bytes + offset;
        }
    }
    return NULL;
}

static bool in_flash(const struct bootsel *b, uint32_t address)
{
    return address >= FLASH_BASE && address - FLASH_BASE < b->options.flash_bytes;
}

/* Flash that has changed goes to its file at once. */
static int store(const struct bootsel *b, uint32_t address, uint32_t n)
{
    const uint32_t at = address - FLASH_BASE;
    if (pwrite(b->file, b->flash + at, n, at) == (ssize_t)n) {
        return 0;
    }
    fprintf(stderr, "usb: %s: %s\n", b->options.flash, strerror(errno));
    return -1;
}

/* Both endpoints refuse until the host has looked at the status and reset the interface. */
static int refuse(struct bootsel *b, uint32_t status)
{
    b->status = status;
    b->halted_in = b->halted_out = true;
    b->phase = COMMAND;
    return -EPIPE;
}

static uint32_t check_area(struct bootsel *b, uint32_t address, uint32_t n, uint32_t flash_unit, bool writes)
{
    if (memory(b, address, n) == NULL || (writes && address < FLASH_BASE)) {
        return BAD_ADDRESS;
    }
    const bool aligned = address % flash_unit == 0 && n % flash_unit == 0;
    return in_flash(b, address) && !aligned ? BAD_ALIGNMENT : OK;
}

static uint32_t erase(struct bootsel *b, uint32_t address, uint32_t n)
{
    if (!in_flash(b, address)) {
        return BAD_ADDRESS;
    }
    const uint32_t status = check_area(b, address, n, 4096, true);
    if (status == OK) {
        memset(memory(b, address, n), 0xFF, n);
        store(b, address, n);
    }
    return status;
}

/* Arguments are at command + 16. */
static uint32_t start(struct bootsel *b, const uint8_t *command)
{
    static const struct {
        uint8_t id, arguments;
    } known[] = {{EXCLUSIVE, 1}, {ERASE, 8},     {READ, 8},    {WRITE, 8},
                 {EXIT_XIP, 0},  {ENTER_XIP, 0}, {REBOOT, 12}, {REBOOT2, 16}};
    const uint8_t other = b->options.product == 3 ? REBOOT2 : REBOOT;
    const uint32_t length = u32(command + 12), address = u32(command + 16), size = u32(command + 20);
    size_t i = 0;
    while (i < sizeof known / sizeof known[0] && known[i].id != b->command) {
        i++;
    }
    if (i == sizeof known / sizeof known[0] || b->command == other) {
        return UNKNOWN_COMMAND;
    }
    if (command[9] != known[i].arguments) {
        return BAD_ARGUMENTS;
    }
    const bool moves = b->command == READ || b->command == WRITE;
    if (length != (moves ? size : 0)) {
        return BAD_LENGTH;
    }
    b->address = address;
    b->left = length;
    b->rebooting = b->command == REBOOT || b->command == REBOOT2;
    if (b->command == ERASE) {
        return erase(b, address, size);
    }
    return moves ? check_area(b, address, size, b->command == WRITE ? 256 : 1, b->command == WRITE) : OK;
}

/* Is it the first time that this command comes to this sector? */
static bool is_new(struct bootsel *b, const uint8_t *command)
{
    const bool has_address = command[8] == ERASE || command[8] == READ || command[8] == WRITE;
    bool *stalled = &b->stalled[command[8] & 7][has_address ? u32(command + 16) / 4096 % SECTORS : 0];
    const bool first = !*stalled;
    *stalled = true;
    return first;
}

static int take_command(struct bootsel *b, const uint8_t *data, int n)
{
    if (n != 32 || u32(data) != MAGIC) {
        return refuse(b, UNKNOWN_COMMAND);
    }
    b->token = u32(data + 4);
    b->command = data[8];
    if (b->options.stall_once && is_new(b, data)) {
        refuse(b, UNKNOWN_COMMAND);
        return n;
    }
    const uint32_t status = start(b, data);
    if (status != OK) {
        refuse(b, status);
        return n; /* the command itself was taken */
    }
    b->status = OK;
    b->phase = b->command == READ ? DATA_IN : b->left > 0 ? DATA_OUT : ACK_IN;
    return n;
}

/* A flash chip can only clear bits. */
static int take_data(struct bootsel *b, const uint8_t *data, int n)
{
    if ((uint32_t)n > b->left) {
        return refuse(b, BAD_LENGTH);
    }
    uint8_t *to = memory(b, b->address, (uint32_t)n);
    for (int i = 0; i < n; i++) {
        to[i] = in_flash(b, b->address) ? to[i] & data[i] : data[i];
    }
    if (in_flash(b, b->address)) {
        store(b, b->address, (uint32_t)n);
    }
    b->address += (uint32_t)n;
    b->left -= (uint32_t)n;
    b->phase = b->left == 0 ? ACK_IN : DATA_OUT;
    return n;
}

static int take_out(void *context, unsigned endpoint, const uint8_t *data, int n)
{
    struct bootsel *b = context;
    if (endpoint != 3 || b->halted_out) {
        return -EPIPE;
    }
    switch (b->phase) {
    case COMMAND:
        return take_command(b, data, n);
    case DATA_OUT:
        return take_data(b, data, n);
    case ACK_OUT:
        b->phase = COMMAND;
        return n <= 1 ? n : take_command(b, data, n); /* the next command is an acknowledgement, too */
    default:
        return refuse(b, BAD_LENGTH);
    }
}

static int give_data(struct bootsel *b, uint8_t *data, int room)
{
    const uint32_t n = (uint32_t)room < b->left ? (uint32_t)room : b->left;
    memcpy(data, memory(b, b->address, n), n);
    b->address += n;
    b->left -= n;
    b->phase = b->left == 0 ? ACK_OUT : DATA_IN;
    return (int)n;
}

static int give_in(void *context, unsigned endpoint, uint8_t *data, int room, unsigned waited_ms)
{
    struct bootsel *b = context;
    (void)waited_ms;
    if (endpoint != 4 || b->halted_in) {
        return -EPIPE;
    }
    if (b->phase == DATA_IN && b->left > 0) {
        return give_data(b, data, room);
    }
    if (b->phase == ACK_IN) {
        b->phase = COMMAND;
        b->device.leaves = b->rebooting;
        return 0;
    }
    return USB_WAIT;
}

static int vendor(void *context, const uint8_t setup[8], uint8_t *data, int n)
{
    struct bootsel *b = context;
    (void)n;
    if (setup[0] == 0x41 && setup[1] == INTERFACE_RESET) {
        b->phase = COMMAND;
        b->status = OK;
        b->left = 0;
        b->halted_in = b->halted_out = false;
        return 0;
    }
    if (setup[0] == 0xC1 && setup[1] == COMMAND_STATUS) {
        memset(data, 0, 16);
        put_u32(data, b->token);
        put_u32(data + 4, b->status);
        data[8] = b->command;
        data[9] = b->phase == DATA_IN || b->phase == DATA_OUT;
        return 16;
    }
    return -EPIPE;
}

static void unhalt(void *context, unsigned endpoint)
{
    struct bootsel *b = context;
    b->halted_in = b->halted_in && endpoint != 0x84;
    b->halted_out = b->halted_out && endpoint != 0x03;
}

/* The flash is its file: it stays when the board is unplugged. */
static int open_flash(struct bootsel *b)
{
    const uint32_t size = b->options.flash_bytes;
    b->file = open(b->options.flash, O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    b->flash = malloc(size);
    if (b->file < 0 || b->flash == NULL) {
        fprintf(stderr, "usb: %s: %s\n", b->options.flash, strerror(errno));
        return -1;
    }
    memset(b->flash, 0xFF, size);
    const ssize_t had = pread(b->file, b->flash, size, 0);
    return had == (ssize_t)size ? 0 : store(b, FLASH_BASE, size);
}

struct usb_device *bootsel_new(const struct bootsel_options *options)
{
    static const uint8_t descriptor[18] = {18, 1, 0x10, 0x01, 0, 0, 0, 64, 0x8A, 0x2E, 0, 0, 0x00, 0x01, 1, 2, 3, 1};
    struct bootsel *b = calloc(1, sizeof *b);
    if (b == NULL) {
        return NULL;
    }
    b->options = *options;
    if (open_flash(b) != 0) {
        free(b);
        return NULL;
    }
    memcpy(b->rom + 0x10, "Mu\x01\x03", 4); /* section 2.8.2: magic and version */
    memcpy(b->descriptor, descriptor, sizeof descriptor);
    b->descriptor[10] = (uint8_t)options->product;
    b->descriptor[11] = (uint8_t)(options->product >> 8);
    b->device = (struct usb_device){.speed = 2,
                                    .device = b->descriptor,
                                    .config = config_descriptor,
                                    .strings = {NULL, "Raspberry Pi", "RP2 Boot", options->serial},
                                    .context = b,
                                    .control = vendor,
                                    .out = take_out,
                                    .in = give_in,
                                    .unhalt = unhalt};
    return &b->device;
}
