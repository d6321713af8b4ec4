/* gpio: what hal/linux/gpiod1 asks of version 1 of libgpiod, which the test plays, and what it makes of the answers.
 * (Version 2 is used with the kernel's own lines: long_guest_backends.sh on Debian 13.) */
#include <gpiod.h> /* tests/run.sh skips this program where the library is not installed */

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#ifndef GPIOD_LINE_BULK_MAX_LINES

int main(void)
{
    return 77; /* it is version 2 */
}

#else

#include "linux/gpio_lines.h"

#include <errno.h>
#include <string.h>

/* ---- libgpiod --------------------------------------------------------------------------------------------------- */

struct gpiod_chip {
    int opened;
};

struct gpiod_line {
    const char *name, *consumer;
    bool used;
    int level, released;
};

static struct gpiod_chip the_chip;
static struct gpiod_line the_line;
static int fails; /* with this errno; 0: it does not */
static int asked_flags, asked_default;
static char asked; /* o output, r rising, b both edges */
static struct gpiod_line_event event;

struct gpiod_chip *gpiod_chip_open(const char *path)
{
    assert_string_equal(path, "/dev/gpiochip3");
    errno = fails;
    the_chip.opened++;
    return fails ? NULL : &the_chip;
}

void gpiod_chip_close(struct gpiod_chip *chip)
{
    chip->opened--;
}

const char *gpiod_chip_label(struct gpiod_chip *chip)
{
    assert_ptr_equal(chip, &the_chip);
    return "pinctrl-label";
}

unsigned int gpiod_chip_num_lines(struct gpiod_chip *chip)
{
    assert_ptr_equal(chip, &the_chip);
    return 54;
}

struct gpiod_line *gpiod_chip_find_line(struct gpiod_chip *chip, const char *name)
{
    assert_ptr_equal(chip, &the_chip);
    return strcmp(name, "GPIO25") == 0 ? &the_line : NULL;
}

struct gpiod_line *gpiod_chip_get_line(struct gpiod_chip *chip, unsigned int offset)
{
    assert_ptr_equal(chip, &the_chip);
    errno = EINVAL;
    return offset == 25 ? &the_line : NULL;
}

unsigned int gpiod_line_offset(struct gpiod_line *line)
{
    assert_ptr_equal(line, &the_line);
    return 25;
}

const char *gpiod_line_name(struct gpiod_line *line)
{
    return line->name;
}

const char *gpiod_line_consumer(struct gpiod_line *line)
{
    return line->consumer;
}

bool gpiod_line_is_used(struct gpiod_line *line)
{
    return line->used;
}

static int take(struct gpiod_line *line, const char *consumer, char how, int flags)
{
    assert_ptr_equal(line, &the_line);
    assert_string_equal(consumer, "pinhole");
    asked = how;
    asked_flags = flags;
    errno = fails;
    return fails ? -1 : 0;
}

int gpiod_line_request_output(struct gpiod_line *line, const char *consumer, int level)
{
    asked_default = level;
    return take(line, consumer, 'o', 0);
}

int gpiod_line_request_rising_edge_events_flags(struct gpiod_line *line, const char *consumer, int flags)
{
    return take(line, consumer, 'r', flags);
}

int gpiod_line_request_both_edges_events_flags(struct gpiod_line *line, const char *consumer, int flags)
{
    return take(line, consumer, 'b', flags);
}

void gpiod_line_release(struct gpiod_line *line)
{
    line->released++;
}

int gpiod_line_set_value(struct gpiod_line *line, int level)
{
    errno = fails;
    line->level = level;
    return fails ? -1 : 0;
}

int gpiod_line_get_value(struct gpiod_line *line)
{
    errno = fails;
    return fails ? -1 : line->level;
}

int gpiod_line_event_get_fd(struct gpiod_line *line)
{
    assert_ptr_equal(line, &the_line);
    return 88;
}

int gpiod_line_event_read(struct gpiod_line *line, struct gpiod_line_event *to)
{
    assert_ptr_equal(line, &the_line);
    errno = fails;
    *to = event;
    return fails ? -1 : 0;
}

/* ---- tests ------------------------------------------------------------------------------------------------------ */

static int fresh(void **state)
{
    (void)state;
    the_chip = (struct gpiod_chip){0};
    the_line = (struct gpiod_line){.name = "GPIO25", .consumer = "spi"};
    fails = 0;
    return 0;
}

static void a_chip_is_opened_and_looked_at(void **state)
{
    char label[8];
    (void)state;
    void *const chip = linux_gpio_chip_open("/dev/gpiochip3");
    assert_ptr_equal(chip, &the_chip);
    assert_int_equal(linux_gpio_chip_label(chip, label, sizeof label), 0);
    assert_string_equal(label, "pinctrl"); /* cut to what fits */
    assert_int_equal(linux_gpio_chip_lines(chip), 54);
    assert_int_equal(linux_gpio_chip_find(chip, "GPIO25"), 25);
    assert_int_equal(linux_gpio_chip_find(chip, "GPIO2"), -ENOENT);
    linux_gpio_chip_close(chip);
    assert_int_equal(the_chip.opened, 0);
    fails = EACCES;
    assert_null(linux_gpio_chip_open("/dev/gpiochip3"));
    assert_int_equal(errno, EACCES);
    assert_false(linux_gpio_debounces());
}

static void a_line_has_a_name_and_may_be_taken(void **state)
{
    struct linux_line_look look;
    (void)state;
    for (int used = 0; used < 2; used++) {
        the_line.used = used == 1;
        assert_int_equal(linux_gpio_chip_look(&the_chip, 25, &look), 0);
        assert_string_equal(look.name, "GPIO25");
        assert_string_equal(look.holder, "spi");
        assert_int_equal(look.taken, used);
    }
    the_line.name = the_line.consumer = NULL;
    assert_int_equal(linux_gpio_chip_look(&the_chip, 25, &look), 0);
    assert_true(look.name[0] == '\0' && look.holder[0] == '\0');
    assert_int_equal(linux_gpio_chip_look(&the_chip, 26, &look), -EINVAL);
}

static void a_line_is_taken_as_it_is_wanted(void **state)
{
    static const struct {
        struct linux_gpio_want want;
        char asked;
        int flags, level;
    } cases[] = {
        {{.use = GPIO_OUT, .level = true}, 'o', 0, 1},
        {{.use = GPIO_OUT}, 'o', 0, 0},
        {{.use = GPIO_IN_RISING}, 'r', 0, 0},
        {{.use = GPIO_IN_RISING, .pull_down = true}, 'r', GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_DOWN, 0},
        {{.use = GPIO_IN_BOTH, .pull_up = true}, 'b', GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_UP, 0},
        {{.use = GPIO_IN_BOTH}, 'b', 0, 0},
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct linux_line line = {.request = NULL};
        asked_default = 0;
        assert_int_equal(linux_gpio_request(&line, &the_chip, 25, &cases[i].want), 0);
        assert_true(asked == cases[i].asked && asked_flags == cases[i].flags && asked_default == cases[i].level);
        assert_true(line.chip == &the_chip && line.request == &the_line);
        fails = EBUSY;
        line = (struct linux_line){.request = NULL};
        assert_int_equal(linux_gpio_request(&line, &the_chip, 25, &cases[i].want), -EBUSY);
        assert_null(line.request);
        fails = 0;
    }
    struct linux_line line = {.request = NULL};
    assert_int_equal(linux_gpio_request(&line, &the_chip, 9, &cases[0].want), -EINVAL);
}

static void a_line_gives_its_chip_back(void **state)
{
    struct linux_line line = {.chip = &the_chip, .request = &the_line};
    (void)state;
    linux_gpio_release(&line);
    assert_true(the_line.released == 1 && the_chip.opened == -1 && line.request == NULL && line.chip == NULL);
    linux_gpio_release(&line); /* it is not wired now */
    assert_true(the_line.released == 1 && the_chip.opened == -1);
}

static void levels_and_edges_come_and_go(void **state)
{
    struct linux_line line = {.chip = &the_chip, .request = &the_line};
    uint64_t time_ns;
    (void)state;
    for (int level = 0; level < 2; level++) {
        assert_int_equal(linux_gpio_set(&line, level == 1), 0);
        assert_int_equal(the_line.level, level);
        assert_int_equal(linux_gpio_get(&line), level);
        event.event_type = level == 1 ? GPIOD_LINE_EVENT_RISING_EDGE : GPIOD_LINE_EVENT_FALLING_EDGE;
        event.ts = (struct timespec){5000000000, 123456789};
        assert_int_equal(linux_gpio_edge(&line, &time_ns), level);
        assert_true(time_ns == 5000000000123456789u);
    }
    assert_int_equal(linux_gpio_descriptor(&line), 88);
    fails = ENODEV;
    assert_int_equal(linux_gpio_set(&line, true), -ENODEV);
    assert_int_equal(linux_gpio_get(&line), -ENODEV);
    assert_int_equal(linux_gpio_edge(&line, &time_ns), -ENODEV);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(a_chip_is_opened_and_looked_at, fresh),
        cmocka_unit_test_setup(a_line_has_a_name_and_may_be_taken, fresh),
        cmocka_unit_test_setup(a_line_is_taken_as_it_is_wanted, fresh),
        cmocka_unit_test_setup(a_line_gives_its_chip_back, fresh),
        cmocka_unit_test_setup(levels_and_edges_come_and_go, fresh),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

#endif
