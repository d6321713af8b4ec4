/* See flash_boot.h. */
#include "flash_boot.h"

#include "flash_image.h"

#include <string.h>

#define MAGIC     0x431FD10Bu
#define REBOOT_MS 100 /* for the answer to arrive */

enum { COMMAND_BYTES = 32, STATUS_BYTES = 16, TRIES = 2 };
enum command { EXCLUSIVE_ACCESS = 1, REBOOT = 2, FLASH_ERASE = 3, WRITE = 5, EXIT_XIP = 6, REBOOT2 = 10, READ = 0x84 };

struct request {
    enum command id;
    uint8_t argument_bytes;
    uint32_t arguments[4];
    const uint8_t *out; /* data to the board, */
    uint8_t *in;        /* or from it, or neither */
    uint32_t n;
};

static void put_u32(uint8_t *to, uint32_t value)
{
    for (int i = 0; i < 4; i++) {
        to[i] = (uint8_t)(value >> (8 * i));
    }
}

static void make_command(uint8_t command[COMMAND_BYTES], const struct request *r, uint32_t token)
{
    memset(command, 0, COMMAND_BYTES);
    put_u32(command, MAGIC);
    put_u32(command + 4, token);
    command[8] = (uint8_t)r->id;
    command[9] = r->argument_bytes;
    put_u32(command + 12, r->n);
    for (int i = 0; i < 4; i++) {
        put_u32(command + 16 + 4 * i, r->arguments[i]);
    }
}

/* Sends the command and its data, then an empty packet against the direction of the data. */
static int attempt(struct flash_boot *boot, const struct request *r)
{
    uint8_t command[COMMAND_BYTES], nothing = 0;
    make_command(command, r, ++boot->token);
    int status = boot->ops->out(boot->context, command, sizeof command);
    if (status >= 0 && r->in != NULL) {
        status = boot->ops->in(boot->context, r->in, r->n);
        return status < 0 ? status : boot->ops->out(boot->context, &nothing, 0);
    }
    if (status >= 0 && r->out != NULL) {
        status = boot->ops->out(boot->context, r->out, r->n);
    }
    if (status < 0) {
        return status;
    }
    status = boot->ops->in(boot->context, &nothing, 0);
    const bool left = (r->id == REBOOT || r->id == REBOOT2) && (status == HAL_ENODEV || status == HAL_EIO);
    return left ? 0 : status;
}

static const struct request exclusive = {.id = EXCLUSIVE_ACCESS, .argument_bytes = 1, .arguments = {1}};

/* Reads why a command was refused and makes the board ready for the next one. The reset gives the board back to its
 * drive, so it is taken again. */
static int recover(struct flash_boot *boot)
{
    uint8_t answer[STATUS_BYTES] = {0};
    int status = boot->ops->status(boot->context, answer);
    boot->refusal = answer[4];
    if (status >= 0) {
        status = boot->ops->reset(boot->context);
    }
    return status < 0 ? status : attempt(boot, &exclusive);
}

static int perform(struct flash_boot *boot, const struct request *r)
{
    int status = attempt(boot, r);
    for (int i = 1; i < TRIES && status == FLASH_STALL; i++) {
        const int recovered = recover(boot);
        status = recovered < 0 ? recovered : attempt(boot, r);
    }
    if (status == FLASH_STALL) {
        const int recovered = recover(boot);
        return recovered < 0 && recovered != FLASH_STALL ? recovered : FLASH_STALL;
    }
    return status < 0 ? status : 0;
}

int flash_boot_begin(struct flash_boot *boot)
{
    const struct request exit_xip = {.id = EXIT_XIP};
    int status = boot->ops->reset(boot->context);
    if (status >= 0) {
        status = perform(boot, &exclusive);
    }
    return status < 0 ? status : perform(boot, &exit_xip);
}

int flash_boot_erase(struct flash_boot *boot, uint32_t address)
{
    const struct request r = {.id = FLASH_ERASE, .argument_bytes = 8, .arguments = {address, FLASH_SECTOR}};
    return perform(boot, &r);
}

int flash_boot_write(struct flash_boot *boot, uint32_t address, const uint8_t *bytes, uint32_t n)
{
    const struct request r = {.id = WRITE, .argument_bytes = 8, .arguments = {address, n}, .out = bytes, .n = n};
    return perform(boot, &r);
}

int flash_boot_read(struct flash_boot *boot, uint32_t address, uint8_t *bytes, uint32_t n)
{
    struct request r = {.id = READ, .argument_bytes = 8, .arguments = {address, n}, .n = n};
    r.in = bytes;
    return perform(boot, &r);
}

int flash_boot_reboot(struct flash_boot *boot)
{
    const struct request r = {.id = REBOOT, .argument_bytes = 12, .arguments = {0, 0, REBOOT_MS}};
    const struct request r2 = {.id = REBOOT2, .argument_bytes = 16, .arguments = {0, REBOOT_MS}};
    return perform(boot, boot->is_rp2350 ? &r2 : &r);
}

void flash_boot_end(struct flash_boot *boot)
{
    boot->ops->reset(boot->context);
}

const char *flash_boot_refusal(const struct flash_boot *boot)
{
    static const char *const names[] = {"no reason given",          "unknown command", "wrong length of the command",
                                        "wrong length of the data", "bad address",     "bad alignment",
                                        "interleaved write",        "rebooting",       "unknown error"};
    const size_t count = sizeof names / sizeof names[0];
    return names[boot->refusal < count ? boot->refusal : count - 1];
}
