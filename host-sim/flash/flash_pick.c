/* See flash_pick.h. */
#include "flash_pick.h"

#include "flash_image.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#define NAMES_SIZE 120

static const char *name(const struct flash_board *board, char text[100])
{
    const char *serial = board->status < 0 ? "cannot be opened" : board->serial;
    snprintf(text, 100, "%u:%u (%s)", board->bus, board->address, serial[0] != '\0' ? serial : "no serial number");
    return text;
}

static bool is_of(const struct flash_board *board, enum flash_chip chip)
{
    return chip == FLASH_ANY || board->chip == chip;
}

static bool matches(const struct flash_board *board, enum flash_chip chip, const char *serial)
{
    char place[16];
    snprintf(place, sizeof place, "%u:%u", board->bus, board->address);
    return is_of(board, chip) &&
           (serial == NULL || strcmp(serial, place) == 0 || (board->status == 0 && strcmp(serial, board->serial) == 0));
}

/* Counts the boards of this chip and names them for people. */
static int survey(const struct flash_board *boards, int count, enum flash_chip chip, char names[NAMES_SIZE])
{
    int found = 0;
    size_t n = 0;
    names[0] = '\0';
    for (int i = 0; i < count; i++) {
        char text[100];
        if (is_of(&boards[i], chip)) {
            const char *comma = found++ == 0 ? "" : ", ";
            n += (size_t)snprintf(names + n, NAMES_SIZE - n, "%s%s", comma, name(&boards[i], text));
            n = n < NAMES_SIZE ? n : NAMES_SIZE - 1;
        }
    }
    return found;
}

static int none(enum flash_chip chip, int others, char *error)
{
    static const char *const products[] = {"2e8a:0003 or 2e8a:000f", "2e8a:0003", "2e8a:000f"};
    char other[64] = "";
    if (others > 0) {
        snprintf(other, sizeof other, " (an %s is, which needs another image)",
                 flash_chip_name(chip == FLASH_RP2040 ? FLASH_RP2350 : FLASH_RP2040));
    }
    return flash_image_wrong(error,
                             "no %s in its boot loader (%s) on USB%s; plug it in with BOOTSEL held, "
                             "or send B to the UART of a running image",
                             flash_chip_name(chip), products[chip], other);
}

/* No board has that serial number, but it may be that of a board that cannot be opened. */
static int unknown(const struct flash_board *boards, int count, enum flash_chip chip, const char *serial,
                   const char *names, char *error)
{
    for (int i = 0; i < count; i++) {
        if (is_of(&boards[i], chip) && boards[i].status < 0 && strchr(serial, ':') == NULL) {
            return i;
        }
    }
    return flash_image_wrong(error, "no %s in its boot loader is '%.64s'; on USB: %s", flash_chip_name(chip), serial,
                             names);
}

/* Have all boards the same serial number? The boot loader of every RP2040 has. */
static bool are_alike(const struct flash_board *boards, int count, enum flash_chip chip)
{
    const struct flash_board *first = NULL;
    for (int i = 0; i < count; i++) {
        if (!is_of(&boards[i], chip)) {
            continue;
        }
        if (first != NULL && (boards[i].status < 0 || strcmp(first->serial, boards[i].serial) != 0)) {
            return false;
        }
        first = &boards[i];
    }
    return true;
}

int flash_pick(const struct flash_board *boards, int count, enum flash_chip chip, const char *serial, char *error)
{
    char names[NAMES_SIZE];
    int picked = -1, matching = 0;
    if (survey(boards, count, chip, names) == 0) {
        return none(chip, count, error);
    }
    for (int i = 0; i < count; i++) {
        if (matches(&boards[i], chip, serial)) {
            picked = matching++ == 0 ? i : picked;
        }
    }
    if (matching > 1) {
        return flash_image_wrong(error, "%d %ss match: %s; choose one with --serial %s", matching,
                                 chip == FLASH_ANY ? "board" : flash_chip_name(chip), names,
                                 are_alike(boards, count, chip) ? "BUS:ADDRESS (their serial numbers are alike)"
                                                                : "NUMBER or BUS:ADDRESS");
    }
    return matching == 1 ? picked : unknown(boards, count, chip, serial, names, error);
}

const char *flash_pick_why(int status)
{
    switch (status) {
    case HAL_EACCES:
        return "no permission; copy boards/udev/60-pinhole.rules to /etc/udev/rules.d, run udevadm control --reload, "
               "and plug it in again";
    case HAL_EBUSY:
        return "in use by another program; end that one";
    case HAL_ENODEV:
        return "unplugged; plug it in again with BOOTSEL held";
    default:
        return "cannot be opened; plug it in again with BOOTSEL held";
    }
}
