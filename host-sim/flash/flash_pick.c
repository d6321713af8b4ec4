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

static bool matches(const struct flash_board *board, const char *serial)
{
    char place[16];
    snprintf(place, sizeof place, "%u:%u", board->bus, board->address);
    return !board->rp2350 &&
           (serial == NULL || strcmp(serial, place) == 0 || (board->status == 0 && strcmp(serial, board->serial) == 0));
}

/* Counts the RP2040s and names them for people. */
static int survey(const struct flash_board *boards, int count, char names[NAMES_SIZE])
{
    int found = 0;
    size_t n = 0;
    names[0] = '\0';
    for (int i = 0; i < count; i++) {
        char text[100];
        if (!boards[i].rp2350) {
            const char *comma = found++ == 0 ? "" : ", ";
            n += (size_t)snprintf(names + n, NAMES_SIZE - n, "%s%s", comma, name(&boards[i], text));
            n = n < NAMES_SIZE ? n : NAMES_SIZE - 1;
        }
    }
    return found;
}

static int none(int count, char *error)
{
    return flash_image_wrong(error,
                             "no RP2040 in its boot loader (2e8a:0003) on USB%s; plug it in with BOOTSEL held, "
                             "or send B to the UART of a running image",
                             count > 0 ? " (an RP2350 is, which needs another image)" : "");
}

/* No board has that serial number, but it may be that of a board that cannot be opened. */
static int unknown(const struct flash_board *boards, int count, const char *serial, const char *names, char *error)
{
    for (int i = 0; i < count; i++) {
        if (!boards[i].rp2350 && boards[i].status < 0 && strchr(serial, ':') == NULL) {
            return i;
        }
    }
    return flash_image_wrong(error, "no RP2040 in its boot loader is '%.64s'; on USB: %s", serial, names);
}

/* Have all boards the same serial number? The boot loader of every RP2040 has. */
static bool are_alike(const struct flash_board *boards, int count)
{
    const struct flash_board *first = NULL;
    for (int i = 0; i < count; i++) {
        if (boards[i].rp2350) {
            continue;
        }
        if (first != NULL && (boards[i].status < 0 || strcmp(first->serial, boards[i].serial) != 0)) {
            return false;
        }
        first = &boards[i];
    }
    return true;
}

int flash_pick(const struct flash_board *boards, int count, const char *serial, char *error)
{
    char names[NAMES_SIZE];
    int picked = -1, matching = 0;
    if (survey(boards, count, names) == 0) {
        return none(count, error);
    }
    for (int i = 0; i < count; i++) {
        if (matches(&boards[i], serial)) {
            picked = matching++ == 0 ? i : picked;
        }
    }
    if (matching > 1) {
        return flash_image_wrong(error, "%d RP2040s match: %s; choose one with --serial %s", matching, names,
                                 are_alike(boards, count) ? "BUS:ADDRESS (their serial numbers are alike)"
                                                          : "NUMBER or BUS:ADDRESS");
    }
    return matching == 1 ? picked : unknown(boards, count, serial, names, error);
}
