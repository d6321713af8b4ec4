/* See key_script.h. The lines become a list of presses, which is searched for each frame. */
#define _POSIX_C_SOURCE 200809L /* strtok_r */

#include "key_script.h"

#include "complain.h"
#include "hal.h"
#include "option_text.h"
#include "text_line.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FRAME_LIMIT 1000000000u
#define LINE_LIMIT  4096u
#define PRESS_LIMIT 100000u /* lines; each frame looks at all of them */

struct key_press {
    uint32_t first, count; /* frames */
    uint32_t buttons;      /* enum hal_button */
};

static bool read_buttons(char *text, uint32_t *buttons)
{
    static const char *const names[] = {"up", "down", "left", "right", "select"};
    static const uint32_t bits[] = {HAL_BUTTON_UP, HAL_BUTTON_DOWN, HAL_BUTTON_LEFT, HAL_BUTTON_RIGHT,
                                    HAL_BUTTON_SELECT};
    *buttons = 0;
    for (bool more = true; more;) {
        char *end = text + strcspn(text, "+");
        more = *end == '+';
        *end = '\0';
        const int button = option_text_choice(text, names, 5);
        if (button < 0) {
            return false;
        }
        *buttons |= bits[button];
        text = end + 1;
    }
    return true;
}

/* Returns 1 for a press, 0 for an empty line or a comment, else PH_ERR_INVAL. */
static int read_line(char *line, struct key_press *press)
{
    static const char blanks[] = " \t\r\n";
    char *words[4] = {NULL}, *rest = NULL;
    int count = 0;
    line[strcspn(line, "#")] = '\0';
    for (char *word = strtok_r(line, blanks, &rest); word != NULL && count < 4; word = strtok_r(NULL, blanks, &rest)) {
        words[count++] = word;
    }
    if (count == 0) {
        return 0;
    }
    press->count = 1;
    const bool right = (count == 2 || count == 3) && option_text_u32(words[0], 0, FRAME_LIMIT, &press->first) &&
                       read_buttons(words[1], &press->buttons) &&
                       (count == 2 || option_text_u32(words[2], 1, FRAME_LIMIT, &press->count));
    return right ? 1 : PH_ERR_INVAL;
}

/* Makes room for one more at keys->presses[keys->count]. The room doubles when the count reaches a power of two. */
static bool make_room(struct key_script *keys)
{
    if ((keys->count & (keys->count - 1)) != 0) {
        return true;
    }
    const size_t room = keys->count == 0 ? 1 : 2 * keys->count;
    struct key_press *presses = realloc(keys->presses, room * sizeof *presses);
    if (presses == NULL) {
        return false;
    }
    keys->presses = presses;
    return true;
}

static int add_line(struct key_script *keys, const char *path, unsigned number, char *line, size_t length)
{
    struct key_press press;
    const int found = strlen(line) == length ? read_line(line, &press) : PH_ERR_INVAL;
    if (found < 0) {
        return complain_usage(
            "--keys %s:%u: a line must be FRAME BUTTON[+BUTTON...] [COUNT], buttons up down left right "
            "select",
            path, number);
    }
    if (found > 0) {
        if (keys->count == PRESS_LIMIT || !make_room(keys)) {
            return complain_usage("--keys %s:%u: more than %u presses", path, number, PRESS_LIMIT);
        }
        keys->presses[keys->count++] = press;
    }
    return 0;
}

int key_script_read(struct key_script *keys, const char *path)
{
    *keys = (struct key_script){NULL, 0};
    if (path == NULL) {
        return 0;
    }
    FILE *file = fopen(path, "r");
    if (file == NULL) {
        return complain("--keys %s: %s", path, strerror(errno));
    }
    char *line = NULL;
    size_t size = 0;
    int status = 0;
    for (unsigned number = 1; status == 0; number++) {
        const ssize_t length = text_line_read(&line, &size, LINE_LIMIT, file);
        if (length <= 0) {
            status = length == 0 ? 0 : complain("--keys %s: %s", path, strerror((int)-length));
            break;
        }
        status = add_line(keys, path, number, line, (size_t)length);
    }
    free(line);
    fclose(file);
    return status;
}

uint32_t key_script_at(const struct key_script *keys, uint32_t frame)
{
    uint32_t buttons = 0;
    for (size_t i = 0; i < keys->count; i++) {
        const struct key_press *press = &keys->presses[i];
        buttons |= frame - press->first < press->count ? press->buttons : 0;
    }
    return buttons;
}

void key_script_free(struct key_script *keys)
{
    free(keys->presses);
    *keys = (struct key_script){NULL, 0};
}
