/* See lines.h. */
#include "lines.h"

#include "fail.h"
#include "hal.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { CHIPS_MAX = 64, OFFSET_DIGITS = 5 };

/* The line that is wanted: a name on any chip, or an offset on the chip of a path or of a label. */
struct wanted {
    const char *name;
    const char *path;
    const char *label;
    unsigned offset;
};

/* The line that was found, and the first chip that could not be opened before it. */
struct found {
    void *chip; /* open; NULL: none */
    unsigned offset;
    char path[LINUX_PATH_SIZE];
    unsigned chips_seen;
    int refusal; /* errno of the first chip that exists but cannot be opened */
    char refused[LINUX_PATH_SIZE];
};

static bool all_digits(const char *text, size_t most)
{
    const size_t n = strspn(text, "0123456789");
    return n > 0 && n <= most && text[n] == 0;
}

bool linux_line_place(const char *text, char chip[LINUX_PATH_SIZE], unsigned *offset)
{
    const char *colon = strrchr(text, ':');
    if (colon == NULL || colon == text || !all_digits(colon + 1, OFFSET_DIGITS)) {
        return false;
    }
    const size_t n = (size_t)(colon - text);
    if (n >= LINUX_PATH_SIZE) {
        return false;
    }
    memcpy(chip, text, n);
    chip[n] = 0;
    *offset = (unsigned)strtoul(colon + 1, NULL, 10);
    return true;
}

int linux_line_gpio_number(const char *name)
{
    return strncmp(name, "GPIO", 4) == 0 && all_digits(name + 4, 3) ? (int)strtol(name + 4, NULL, 10) : -1;
}

/* The offset of the wanted line on this chip, or < 0. */
static int match(void *chip, const struct wanted *wanted)
{
    char label[32] = "";
    if (wanted->name != NULL) {
        return linux_gpio_chip_find(chip, wanted->name);
    }
    if (wanted->label != NULL &&
        (linux_gpio_chip_label(chip, label, sizeof label) < 0 || strcmp(label, wanted->label) != 0)) {
        return -ENOENT;
    }
    return (int)wanted->offset < linux_gpio_chip_lines(chip) ? (int)wanted->offset : -ENOENT;
}

/* Leaves the chip open in found if it has the line that is wanted. */
static bool look_at_chip(struct found *found, const struct wanted *wanted)
{
    void *chip = linux_gpio_chip_open(found->path);
    if (chip == NULL) {
        if (errno != ENOENT && errno != ENODEV && found->refusal == 0) {
            found->refusal = errno;
            memcpy(found->refused, found->path, sizeof found->refused);
        }
        return false;
    }
    found->chips_seen++;
    const int offset = match(chip, wanted);
    if (offset < 0) {
        linux_gpio_chip_close(chip);
        return false;
    }
    found->chip = chip;
    found->offset = (unsigned)offset;
    return true;
}

/* Opens chip after chip by path, in the order of their numbers: libgpiod's own search reports "no permission" as "not
 * found". */
static bool look_for(struct found *found, const struct wanted *wanted)
{
    if (wanted->path != NULL) {
        snprintf(found->path, sizeof found->path, "%s%s", wanted->path[0] == '/' ? "" : "/dev/", wanted->path);
        return look_at_chip(found, wanted);
    }
    for (unsigned i = 0; i < CHIPS_MAX; i++) {
        snprintf(found->path, sizeof found->path, "/dev/gpiochip%u", i);
        if (look_at_chip(found, wanted)) {
            return true;
        }
    }
    return false;
}

/* Finds "GPIOn" on kernels that name no lines. labels: separated by spaces. */
static bool look_for_number(struct found *found, const char *name, const char *labels)
{
    const int number = linux_line_gpio_number(name);
    char label[32];
    while (number >= 0 && labels != NULL && *labels != 0) {
        const size_t n = strcspn(labels, " ");
        snprintf(label, sizeof label, "%.*s", (int)n, labels);
        const struct wanted wanted = {.label = label, .offset = (unsigned)number};
        if (look_for(found, &wanted)) {
            return true;
        }
        labels += n + strspn(labels + n, " ");
    }
    return false;
}

static bool find(struct found *found, const struct board *board, const char *text)
{
    char chip[LINUX_PATH_SIZE];
    unsigned offset = 0;
    if (linux_line_place(text, chip, &offset)) {
        const bool is_path = chip[0] == '/' || (strncmp(chip, "gpiochip", 8) == 0 && all_digits(chip + 8, 4));
        const struct wanted wanted = {.path = is_path ? chip : NULL, .label = is_path ? NULL : chip, .offset = offset};
        return look_for(found, &wanted);
    }
    const struct wanted wanted = {.name = text};
    return look_for(found, &wanted) || look_for_number(found, text, board->gpio_labels);
}

static int not_found(const struct found *found, const char *text, char error[LINUX_ERROR_SIZE])
{
    if (found->refusal == ENOSYS) {
        return linux_fail(error, HAL_ENOSYS, "line %s: built without libgpiod; install libgpiod-dev and make again",
                          text);
    }
    if (found->refusal == EACCES || found->refusal == EPERM) {
        return linux_fail(error, HAL_EACCES,
                          "%s: no permission (looking for line %s); add yourself to the group gpio (usermod -aG gpio "
                          "NAME, then log in again) or install boards/udev/60-pinhole.rules",
                          found->refused, text);
    }
    if (found->refusal == ENOTTY) {
        return linux_fail(error, HAL_ENODEV, "%s is no GPIO chip (looking for line %s); gpiodetect lists them",
                          found->refused, text);
    }
    if (found->refusal != 0) {
        return linux_fail(error, linux_status(found->refusal), "%s cannot be opened (looking for line %s): %s",
                          found->refused, text, strerror(found->refusal));
    }
    if (found->chips_seen == 0) {
        return linux_fail(error, HAL_ENODEV, "line %s: there is no such /dev/gpiochip; gpiodetect lists them", text);
    }
    return linux_fail(error, HAL_ENODEV,
                      "line %s: no chip has it; name it as gpioinfo lists it, or as chip:offset (gpiochip0:25)", text);
}

static int not_taken(const struct found *found, const char *text, int number, char error[LINUX_ERROR_SIZE])
{
    struct linux_line_look look = {.holder = ""};
    if (number != EBUSY) {
        return linux_fail(error, linux_status(number), "line %s (%s:%u) cannot be used: %s; take another line", text,
                          found->path, found->offset, strerror(number));
    }
    linux_gpio_chip_look(found->chip, found->offset, &look);
    return linux_fail(error, HAL_EBUSY,
                      "line %s (%s:%u) is taken by \"%s\"; end that program, or remove the overlay that claims it",
                      text, found->path, found->offset, look.holder[0] != 0 ? look.holder : "?");
}

/* Finds a wired pin, which must have a name. */
static int find_pin(struct found *found, const struct board *board, const struct board_pin *pin,
                    char error[LINUX_ERROR_SIZE])
{
    if (pin->line == NULL || pin->line[0] == 0) {
        return linux_fail(error, HAL_EINVAL, "board %s: pin %u has no line name; it is not a kit for Linux",
                          board->name, pin->number);
    }
    return find(found, board, pin->line) ? HAL_OK : not_found(found, pin->line, error);
}

int linux_line_open(struct linux_line *line, const struct board *board, const struct board_pin *pin,
                    const struct linux_gpio_want *want, char error[LINUX_ERROR_SIZE])
{
    struct found found = {0};
    if (!pin->wired) {
        return HAL_OK;
    }
    int status = find_pin(&found, board, pin, error);
    if (status < 0) {
        return status;
    }
    line->active_low = pin->active_low;
    status = linux_gpio_request(line, found.chip, found.offset, want);
    if (status < 0) {
        status = not_taken(&found, pin->line, -status, error);
        linux_gpio_chip_close(found.chip);
    }
    return status;
}

int linux_line_look(const struct board *board, const struct board_pin *pin, struct linux_line_look *look,
                    char error[LINUX_ERROR_SIZE])
{
    struct found found = {0};
    error[0] = 0;
    int status = find_pin(&found, board, pin, error);
    if (status < 0) {
        return status;
    }
    memcpy(look->chip, found.path, sizeof look->chip);
    look->offset = found.offset;
    linux_gpio_chip_label(found.chip, look->label, sizeof look->label);
    status = linux_gpio_chip_look(found.chip, found.offset, look);
    linux_gpio_chip_close(found.chip);
    return status == 0 ? HAL_OK
                       : linux_fail(error, linux_status(-status), "%s:%u cannot be looked at: %s", found.path,
                                    found.offset, strerror(-status));
}

const char *linux_gpiod_version(void)
{
    return linux_gpio_version();
}
