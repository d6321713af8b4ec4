/* See gpio_lines.h. libgpiod 2: Debian 13 and later. */
#include "linux/gpio_lines.h"

#include <errno.h>
#include <gpiod.h>
#include <stdio.h>

const char *linux_gpio_version(void)
{
    return gpiod_api_version();
}

bool linux_gpio_debounces(void)
{
    return true;
}

void *linux_gpio_chip_open(const char *path)
{
    struct gpiod_chip *chip = gpiod_chip_open(path);
    if (chip == NULL && errno == ENODEV) {
        errno = ENOTTY; /* a device of another kind, as libgpiod 1 says it */
    }
    return chip;
}

void linux_gpio_chip_close(void *chip)
{
    gpiod_chip_close(chip);
}

int linux_gpio_chip_label(void *chip, char *label, size_t size)
{
    struct gpiod_chip_info *info = gpiod_chip_get_info(chip);
    if (info == NULL) {
        return -errno;
    }
    snprintf(label, size, "%s", gpiod_chip_info_get_label(info));
    gpiod_chip_info_free(info);
    return 0;
}

int linux_gpio_chip_lines(void *chip)
{
    struct gpiod_chip_info *info = gpiod_chip_get_info(chip);
    if (info == NULL) {
        return -errno;
    }
    const size_t count = gpiod_chip_info_get_num_lines(info);
    gpiod_chip_info_free(info);
    return (int)count;
}

int linux_gpio_chip_find(void *chip, const char *name)
{
    const int offset = gpiod_chip_get_line_offset_from_name(chip, name);
    return offset < 0 ? -errno : offset;
}

int linux_gpio_chip_look(void *chip, unsigned offset, struct linux_line_look *look)
{
    struct gpiod_line_info *info = gpiod_chip_get_line_info(chip, offset);
    if (info == NULL) {
        return -errno;
    }
    const char *name = gpiod_line_info_get_name(info);
    const char *holder = gpiod_line_info_get_consumer(info);
    look->taken = gpiod_line_info_is_used(info);
    snprintf(look->name, sizeof look->name, "%s", name == NULL ? "" : name);
    snprintf(look->holder, sizeof look->holder, "%s", holder == NULL ? "" : holder);
    gpiod_line_info_free(info);
    return 0;
}

static int settle(struct gpiod_line_settings *settings, const struct linux_gpio_want *want)
{
    const enum gpiod_line_value level = want->level ? GPIOD_LINE_VALUE_ACTIVE : GPIOD_LINE_VALUE_INACTIVE;
    if (want->use == GPIO_OUT) {
        return gpiod_line_settings_set_direction(settings, GPIOD_LINE_DIRECTION_OUTPUT) |
               gpiod_line_settings_set_output_value(settings, level);
    }
    const enum gpiod_line_edge edges = want->use == GPIO_IN_BOTH ? GPIOD_LINE_EDGE_BOTH : GPIOD_LINE_EDGE_RISING;
    gpiod_line_settings_set_debounce_period_us(settings, want->debounce_us);
    int status = gpiod_line_settings_set_direction(settings, GPIOD_LINE_DIRECTION_INPUT) |
                 gpiod_line_settings_set_edge_detection(settings, edges);
    if (want->pull_up || want->pull_down) {
        status |=
            gpiod_line_settings_set_bias(settings, want->pull_up ? GPIOD_LINE_BIAS_PULL_UP : GPIOD_LINE_BIAS_PULL_DOWN);
    }
    return status;
}

/* Requests a line with these settings; NULL and errno if that fails. */
static struct gpiod_line_request *take(void *chip, unsigned offset, struct gpiod_line_settings *settings,
                                       const struct linux_gpio_want *want)
{
    struct gpiod_line_request *request = NULL;
    struct gpiod_line_config *lines = gpiod_line_config_new();
    struct gpiod_request_config *config = gpiod_request_config_new();
    int error = ENOMEM;
    if (lines != NULL && config != NULL) {
        gpiod_request_config_set_consumer(config, GPIO_CONSUMER);
        if (settle(settings, want) == 0 && gpiod_line_config_add_line_settings(lines, &offset, 1, settings) == 0) {
            request = gpiod_chip_request_lines(chip, config, lines);
        }
        error = errno;
    }
    gpiod_request_config_free(config);
    gpiod_line_config_free(lines);
    errno = error;
    return request;
}

int linux_gpio_request(struct linux_line *line, void *chip, unsigned offset, const struct linux_gpio_want *want)
{
    struct gpiod_line_settings *settings = gpiod_line_settings_new();
    struct gpiod_edge_event_buffer *events = gpiod_edge_event_buffer_new(1);
    struct gpiod_line_request *request = NULL;
    int error = ENOMEM;
    if (settings != NULL && events != NULL) {
        request = take(chip, offset, settings, want);
        error = errno;
    }
    gpiod_line_settings_free(settings);
    if (request == NULL) {
        gpiod_edge_event_buffer_free(events);
        return -error;
    }
    line->chip = chip;
    line->request = request;
    line->events = events;
    line->offset = offset;
    return 0;
}

void linux_gpio_release(struct linux_line *line)
{
    if (line->request != NULL) {
        gpiod_line_request_release(line->request);
        gpiod_edge_event_buffer_free(line->events);
        gpiod_chip_close(line->chip);
        *line = (struct linux_line){0};
    }
}

int linux_gpio_set(struct linux_line *line, bool level)
{
    const enum gpiod_line_value value = level ? GPIOD_LINE_VALUE_ACTIVE : GPIOD_LINE_VALUE_INACTIVE;
    return gpiod_line_request_set_value(line->request, line->offset, value) == 0 ? 0 : -errno;
}

int linux_gpio_get(struct linux_line *line)
{
    const enum gpiod_line_value value = gpiod_line_request_get_value(line->request, line->offset);
    return value == GPIOD_LINE_VALUE_ERROR ? -errno : value == GPIOD_LINE_VALUE_ACTIVE;
}

int linux_gpio_descriptor(struct linux_line *line)
{
    return gpiod_line_request_get_fd(line->request);
}

int linux_gpio_edge(struct linux_line *line, uint64_t *time_ns)
{
    if (gpiod_line_request_read_edge_events(line->request, line->events, 1) != 1) {
        return -errno;
    }
    struct gpiod_edge_event *event = gpiod_edge_event_buffer_get_event(line->events, 0);
    *time_ns = gpiod_edge_event_get_timestamp_ns(event);
    return gpiod_edge_event_get_event_type(event) == GPIOD_EDGE_EVENT_RISING_EDGE;
}
