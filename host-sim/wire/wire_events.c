/* See wire_events.h. */
#include "wire_events.h"

#include <stdlib.h>
#include <string.h>

/* Cuts the next word off; NULL: there is none. */
static char *next_word(char **rest)
{
    char *word = *rest;
    if (word == NULL || *word == '\0') {
        return NULL;
    }
    char *end = strchr(word, ' ');
    *rest = end == NULL ? word + strlen(word) : end + 1;
    if (end != NULL) {
        *end = '\0';
    }
    return word;
}

static int digit(char c)
{
    if (c >= '0' && c <= '9') {
        return c - '0';
    }
    return c >= 'a' && c <= 'f' ? c - 'a' + 10 : c >= 'A' && c <= 'F' ? c - 'A' + 10 : 16;
}

/* The next word as a number, at most `most`. */
static bool next_number(char **rest, unsigned base, uint64_t most, uint64_t *number)
{
    const char *word = next_word(rest);
    uint64_t value = 0;
    if (word == NULL || *word == '\0') {
        return false;
    }
    for (; *word != '\0'; word++) {
        const unsigned d = (unsigned)digit(*word);
        if (d >= base || value > (most - d) / base) {
            return false;
        }
        value = value * base + d;
    }
    *number = value;
    return true;
}

static bool next_u32(char **rest, unsigned base, uint32_t *number)
{
    uint64_t value = 0;
    const bool read = next_number(rest, base, UINT32_MAX, &value);
    *number = (uint32_t)value;
    return read;
}

/* Reads bytes: hexadecimal digits become bytes in the same place. */
static bool read_bytes(char *text, struct wire_event *event)
{
    uint8_t *bytes = (uint8_t *)text;
    const size_t n = strlen(text);
    for (size_t i = 0; i < n / 2; i++) {
        const int high = digit(text[2 * i]), low = digit(text[2 * i + 1]);
        if (high > 15 || low > 15) {
            return false;
        }
        bytes[i] = (uint8_t)(high << 4 | low);
    }
    event->bytes = bytes;
    event->count = n / 2;
    return n % 2 == 0;
}

static const char *read_transfer(char *rest, struct wire_event *event)
{
    if (strncmp(rest, "- ", 2) == 0) {
        event->select = WIRE_NO_SELECT;
        rest += 2;
    } else if (!next_u32(&rest, 10, &event->select)) {
        return "SELECT is no number and not '-'";
    }
    if (!next_u32(&rest, 10, &event->asked_hz) || !next_u32(&rest, 10, &event->got_hz) || event->got_hz == 0) {
        return "ASKED and GOT are no clocks in Hz";
    }
    if (!next_u32(&rest, 16, &event->mode) || !next_u32(&rest, 10, &event->word_bits)) {
        return "MODE and BITS are no numbers";
    }
    if (!next_number(&rest, 16, UINT64_MAX, &event->levels) ||
        !next_number(&rest, 16, UINT64_MAX, &event->levels_at_end)) {
        return "LEVELS are not hexadecimal";
    }
    if (!next_number(&rest, 10, UINT64_MAX, &event->end_ns) || event->end_ns < event->time_ns) {
        return "END_TIME is no time, or before TIME";
    }
    return read_bytes(rest, event) ? NULL : "BYTES are not pairs of hexadecimal digits";
}

static const char *read_message(char *rest, struct wire_event *event)
{
    if (!next_u32(&rest, 16, &event->number) || event->number > 0x7F) {
        return "ADDRESS is no hexadecimal number of 7 bits";
    }
    if (!next_u32(&rest, 10, &event->got_hz) || event->got_hz == 0) {
        return "HZ is no clock";
    }
    if (!next_number(&rest, 10, UINT64_MAX, &event->end_ns) || event->end_ns < event->time_ns) {
        return "END_TIME is no time, or before TIME";
    }
    return read_bytes(rest, event) ? NULL : "BYTES are not pairs of hexadecimal digits";
}

static const char *read_event(char *rest, struct wire_event *event)
{
    static const char *const kinds[] = {"name", "level", "spi", "read", "i2c", "lost", "note"};
    if (!next_number(&rest, 10, UINT64_MAX, &event->time_ns)) {
        return "TIME is no number of ns";
    }
    const char *kind = next_word(&rest);
    uint32_t i = 0;
    while (i < sizeof kinds / sizeof kinds[0] && (kind == NULL || strcmp(kind, kinds[i]) != 0)) {
        i++;
    }
    event->kind = (enum wire_kind)i;
    event->end_ns = event->time_ns;
    switch (event->kind) {
    case WIRE_NAME:
        event->text = next_u32(&rest, 10, &event->number) ? rest : NULL;
        return event->text != NULL && event->number < 64 && *rest != '\0' ? NULL
                                                                          : "a name needs BIT (0 .. 63) and TEXT";
    case WIRE_LEVEL:
        return next_number(&rest, 16, UINT64_MAX, &event->levels) ? NULL : "LEVELS are not hexadecimal";
    case WIRE_SPI:
    case WIRE_READ:
        return read_transfer(rest, event);
    case WIRE_I2C:
        return read_message(rest, event);
    case WIRE_LOST:
        return next_u32(&rest, 10, &event->number) ? NULL : "COUNT is no number";
    case WIRE_NOTE:
        event->text = rest;
        return NULL;
    }
    return "no such kind of event";
}

int wire_parse(char *line, struct wire_event *event, const char **error)
{
    line[strcspn(line, "\r\n")] = '\0';
    *event = (struct wire_event){.kind = WIRE_NOTE};
    if (*line == '\0' || *line == '#') {
        return 0;
    }
    *error = read_event(line, event);
    return *error == NULL ? 1 : HAL_EINVAL;
}
