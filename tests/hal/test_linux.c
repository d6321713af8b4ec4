/*
 * hal/linux without hardware: how writes are divided, which line a name means, which error a missing part gives, and
 * which edges of a contact are presses. The chips below take the place of libgpiod. long_guest_backends.sh tests the
 * rest, with the real kernel.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "boards.h"
#include "boards_all.h"
#include "linux/debounce.h"
#include "linux/lines.h"
#include "linux/sender.h"
#include "linux/spi.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- a machine's chips, in place of libgpiod (hal/linux/gpiod1) ------------------------------------- */

enum { CHIPS = 3, LINES = 54 };

struct chip {
    const char *label;
    int refusal;       /* errno of opening it */
    bool names;        /* line n is called "GPIOn" */
    bool taken[LINES]; /* "spi0 CS0" has the line */
    int opened;        /* how often it is open now */
};

static struct chip chips[CHIPS];

const char *linux_gpio_version(void)
{
    return "played";
}

bool linux_gpio_debounces(void)
{
    return false;
}

void *linux_gpio_chip_open(const char *path)
{
    unsigned i = CHIPS;
    if (sscanf(path, "/dev/gpiochip%u", &i) != 1 || i >= CHIPS || chips[i].label == NULL) { /* NOLINT(cert-err34-c) */
        errno = ENOENT;
        return NULL;
    }
    if (chips[i].refusal != 0) {
        errno = chips[i].refusal;
        return NULL;
    }
    chips[i].opened++;
    return &chips[i];
}

void linux_gpio_chip_close(void *chip)
{
    ((struct chip *)chip)->opened--;
}

int linux_gpio_chip_label(void *chip, char *label, size_t size)
{
    snprintf(label, size, "%s", ((struct chip *)chip)->label);
    return 0;
}

int linux_gpio_chip_lines(void *chip)
{
    (void)chip;
    return LINES;
}

int linux_gpio_chip_find(void *chip, const char *name)
{
    const int number = linux_line_gpio_number(name);
    return ((struct chip *)chip)->names && number >= 0 && number < LINES ? number : -ENOENT;
}

int linux_gpio_chip_look(void *chip, unsigned offset, struct linux_line_look *look)
{
    look->taken = ((struct chip *)chip)->taken[offset];
    snprintf(look->name, sizeof look->name, "%s", "");
    snprintf(look->holder, sizeof look->holder, "%s", look->taken ? "spi0 CS0" : "");
    return 0;
}

int linux_gpio_request(struct linux_line *line, void *chip, unsigned offset, const struct linux_gpio_want *want)
{
    (void)want;
    if (((struct chip *)chip)->taken[offset]) {
        return -EBUSY;
    }
    line->chip = chip;
    line->request = chip;
    line->offset = offset;
    return 0;
}

void linux_gpio_release(struct linux_line *line)
{
    if (line->request != NULL) {
        linux_gpio_chip_close(line->chip);
        line->request = NULL;
    }
}

int linux_gpio_set(struct linux_line *line, bool level)
{
    (void)line;
    (void)level;
    return 0;
}

int linux_gpio_get(struct linux_line *line)
{
    (void)line;
    return 0;
}

int linux_gpio_descriptor(struct linux_line *line)
{
    (void)line;
    return -1;
}

int linux_gpio_edge(struct linux_line *line, uint64_t *time_ns)
{
    (void)line;
    *time_ns = 0;
    return -EIO;
}

static int plug_chips_in(void **state)
{
    (void)state;
    memset(chips, 0, sizeof chips);
    return 0;
}

/* ---- dividing writes ----------------------------------------------------------------------------- */

/* The kernel's rule: the length, rounded up to a multiple of the alignment, is at most bufsiz. */
static void a_piece_is_the_longest_that_spidev_takes(void **state)
{
    (void)state;
    static const size_t bufsizes[] = {8, 64, 128, 1000, 4096, 65536, 100000};
    for (size_t i = 0; i < sizeof bufsizes / sizeof bufsizes[0]; i++) {
        const size_t bufsiz = bufsizes[i];
        const size_t alignment = bufsiz < 128 ? 8 : 128;
        const size_t piece = linux_spi_piece(1 << 20, bufsiz);
        assert_true((piece + alignment - 1) / alignment * alignment <= bufsiz);
        assert_true((piece + alignment) / alignment * alignment > bufsiz);
        assert_int_equal(linux_spi_piece(1, bufsiz), 1);
        assert_int_equal(linux_spi_piece(piece - 1, bufsiz), piece - 1);
    }
}

static unsigned messages(size_t bytes, size_t bufsiz)
{
    unsigned count = 0;
    for (; bytes > 0; count++) {
        bytes -= linux_spi_piece(bytes, bufsiz);
    }
    return count;
}

static void a_frame_of_115200_bytes_is_29_messages_at_4096(void **state)
{
    (void)state;
    assert_int_equal(messages(115200, 4096), 29);
    assert_int_equal(messages(115200, 65536), 2);
    assert_int_equal(messages(115200, 64), 1800);
}

static void what_a_write_costs_is_told_by_the_last_ones(void **state)
{
    (void)state;
    uint32_t mean = linux_write_mean(0, 50000);
    assert_int_equal(mean, 50000);
    assert_in_range(linux_write_mean(mean, 850000), 50000, 100000); /* one late write counts a sixteenth */
    for (int i = 0; i < 80; i++) {
        mean = linux_write_mean(mean, 1000000 + 500000 * (i % 3)); /* a mean of 1.5 ms, never 50 us again */
    }
    assert_in_range(mean, 1300000, 1700000);
    for (int i = 0; i < 160; i++) {
        mean = linux_write_mean(mean, 60000);
    }
    assert_in_range(mean, 60000, 65000);
}

static void a_device_that_is_not_there_is_told_with_its_cure(void **state)
{
    (void)state;
    char error[LINUX_ERROR_SIZE] = "";
    struct linux_spi_look look;
    assert_int_equal(linux_spi_look(&board_rpi_waveshare_1in3, "/dev/spidev99.0", &look, error), HAL_ENODEV);
    assert_non_null(strstr(error, "/dev/spidev99.0 is not there"));
    assert_non_null(strstr(error, "dtparam=spi=on"));
    assert_int_equal(linux_spi_look(&board_rpi_waveshare_1in3, "/dev/null", &look, error), HAL_ENODEV);
    assert_non_null(strstr(error, "/dev/null is no SPI device"));
}

/* ---- finding lines ------------------------------------------------------------------------------- */

static void places_and_names_are_told_apart(void **state)
{
    (void)state;
    char chip[LINUX_PATH_SIZE];
    unsigned offset = 0;
    assert_true(linux_line_place("gpiochip0:25", chip, &offset));
    assert_string_equal(chip, "gpiochip0");
    assert_int_equal(offset, 25);
    assert_true(linux_line_place("1f000d0000.gpio:a:7", chip, &offset));
    assert_string_equal(chip, "1f000d0000.gpio:a");
    assert_int_equal(offset, 7);
    static const char *const names[] = {"GPIO25", "", ":25", "chip:", "chip:2x", "chip:123456", "PIN_7", "a:-1"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        assert_false(linux_line_place(names[i], chip, &offset));
    }
    assert_int_equal(linux_line_gpio_number("GPIO7"), 7);
    assert_int_equal(linux_line_gpio_number("GPIO"), -1);
    assert_int_equal(linux_line_gpio_number("GPIO7A"), -1);
    assert_int_equal(linux_line_gpio_number("AD3"), -1);
}

/* The chip and line that a name means on the machine of `chips`; -1 and a line in error if there is none. */
static int look_up(const char *name, unsigned *offset, char *error)
{
    struct linux_line line = {0};
    const struct board_pin pin = {.wired = true, .line = name};
    const struct linux_gpio_want want = {.use = GPIO_OUT};
    const int status = linux_line_open(&line, &board_rpi_waveshare_1in3, &pin, &want, error);
    const int chip = status < 0 ? -1 : (int)((struct chip *)line.chip - chips);
    *offset = line.offset;
    linux_gpio_release(&line);
    for (int i = 0; i < CHIPS; i++) {
        assert_int_equal(chips[i].opened, 0);
    }
    return chip;
}

static void a_line_is_found_by_its_name_on_any_chip(void **state)
{
    (void)state;
    char error[LINUX_ERROR_SIZE] = "";
    unsigned offset = 0;
    chips[0] = (struct chip){.label = "pinctrl-rp1"}; /* this label fits, but names come first */
    chips[2] = (struct chip){.label = "some expander", .names = true};
    assert_int_equal(look_up("GPIO25", &offset, error), 2);
    assert_int_equal(offset, 25);
}

static void without_names_a_line_is_found_by_the_label_of_its_chip(void **state)
{
    (void)state;
    char error[LINUX_ERROR_SIZE] = "";
    unsigned offset = 0;
    chips[0] = (struct chip){.label = "gpio-brcmstb"};
    chips[1] = (struct chip){.label = "pinctrl-bcm2711"};
    assert_int_equal(look_up("GPIO25", &offset, error), 1);
    assert_int_equal(offset, 25);
    chips[1].label = "pinctrl-rp1";
    assert_int_equal(look_up("GPIO9", &offset, error), 1);
    chips[1].label = "pinctrl-rp1-other";
    assert_int_equal(look_up("GPIO9", &offset, error), -1);
    assert_non_null(strstr(error, "line GPIO9: no chip has it"));
}

static void chip_and_offset_may_be_given(void **state)
{
    (void)state;
    char error[LINUX_ERROR_SIZE] = "";
    unsigned offset = 0;
    chips[1] = (struct chip){.label = "1f000d0000.gpio"};
    assert_int_equal(look_up("gpiochip1:3", &offset, error), 1);
    assert_int_equal(look_up("/dev/gpiochip1:3", &offset, error), 1);
    assert_int_equal(look_up("1f000d0000.gpio:3", &offset, error), 1);
    assert_int_equal(offset, 3);
    assert_int_equal(look_up("gpiochip1:0", &offset, error), 1);
    assert_int_equal(offset, 0);
    assert_int_equal(look_up("gpiochip1:54", &offset, error), -1);
    assert_int_equal(look_up("gpiochip0:3", &offset, error), -1);
    assert_non_null(strstr(error, "gpiochip0:3"));
}

static void no_permission_is_not_taken_for_not_there(void **state)
{
    (void)state;
    char error[LINUX_ERROR_SIZE] = "";
    unsigned offset = 0;
    chips[0] = (struct chip){.label = "pinctrl-rp1", .refusal = EACCES};
    chips[1] = (struct chip){.label = "another"};
    assert_int_equal(look_up("GPIO25", &offset, error), -1);
    assert_non_null(strstr(error, "/dev/gpiochip0: no permission"));
    assert_non_null(strstr(error, "group gpio"));
    assert_non_null(strstr(error, "60-pinhole.rules"));
    assert_int_equal(look_up("pinctrl-rp1:25", &offset, error), -1);
    assert_non_null(strstr(error, "/dev/gpiochip0: no permission"));
}

static void who_holds_a_busy_line_is_named(void **state)
{
    (void)state;
    char error[LINUX_ERROR_SIZE] = "";
    unsigned offset = 0;
    chips[0] = (struct chip){.label = "pinctrl-rp1", .names = true};
    chips[0].taken[8] = true;
    assert_int_equal(look_up("GPIO8", &offset, error), -1);
    assert_non_null(strstr(error, "line GPIO8 (/dev/gpiochip0:8) is taken by \"spi0 CS0\""));
}

static void a_pin_without_a_name_is_refused(void **state)
{
    (void)state;
    char error[LINUX_ERROR_SIZE] = "";
    struct linux_line line = {0};
    const struct linux_gpio_want want = {.use = GPIO_OUT};
    const struct board *pico = &board_pico_display;
    assert_int_equal(linux_line_open(&line, pico, &pico->pins.dc, &want, error), HAL_EINVAL);
    assert_non_null(strstr(error, "pico-display"));
}

/* ---- buttons ------------------------------------------------------------------------------------- */

#define MS     1000000ULL
#define SETTLE (8 * MS)

static void bounces_are_one_press(void **state)
{
    (void)state;
    struct linux_button button;
    linux_debounce_start(&button, false, 0);
    assert_false(linux_debounce_look(&button, 99 * MS, SETTLE));
    const uint64_t press = 100 * MS;
    for (int i = 0; i <= 6; i++) { /* down, up, down, .. down */
        linux_debounce_edge(&button, i % 2 == 0, press + (uint64_t)i * MS, SETTLE);
        assert_true(linux_debounce_look(&button, press + (uint64_t)i * MS, SETTLE));
    }
    assert_true(linux_debounce_look(&button, 150 * MS, SETTLE));
    for (int i = 0; i <= 6; i++) {
        linux_debounce_edge(&button, i % 2 != 0, 200 * MS + (uint64_t)i * MS, SETTLE);
        assert_false(linux_debounce_look(&button, 200 * MS + (uint64_t)i * MS, SETTLE));
    }
    assert_false(linux_debounce_look(&button, 250 * MS, SETTLE));
}

static void a_press_between_two_looks_is_seen_once(void **state)
{
    (void)state;
    struct linux_button button;
    linux_debounce_start(&button, false, 0);
    linux_debounce_edge(&button, true, 100 * MS, SETTLE);
    linux_debounce_edge(&button, false, 120 * MS, SETTLE);
    assert_true(linux_debounce_look(&button, 133 * MS, SETTLE));
    assert_false(linux_debounce_look(&button, 166 * MS, SETTLE));
}

/* The release comes within the settling time of the press, and no edge comes after it. */
static void a_short_press_ends(void **state)
{
    (void)state;
    struct linux_button button;
    linux_debounce_start(&button, false, 0);
    linux_debounce_edge(&button, true, 100 * MS, SETTLE);
    linux_debounce_edge(&button, false, 103 * MS, SETTLE);
    assert_true(linux_debounce_look(&button, 104 * MS, SETTLE));
    assert_false(linux_debounce_look(&button, 112 * MS, SETTLE));
}

static void a_button_held_at_the_start_is_held(void **state)
{
    (void)state;
    struct linux_button button;
    linux_debounce_start(&button, true, 0);
    assert_true(linux_debounce_look(&button, 1 * MS, SETTLE));
    linux_debounce_edge(&button, false, 50 * MS, 0); /* edges that the kernel debounced */
    assert_false(linux_debounce_look(&button, 50 * MS, 0));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_piece_is_the_longest_that_spidev_takes),
        cmocka_unit_test(a_frame_of_115200_bytes_is_29_messages_at_4096),
        cmocka_unit_test(what_a_write_costs_is_told_by_the_last_ones),
        cmocka_unit_test(a_device_that_is_not_there_is_told_with_its_cure),
        cmocka_unit_test(places_and_names_are_told_apart),
        cmocka_unit_test_setup(a_line_is_found_by_its_name_on_any_chip, plug_chips_in),
        cmocka_unit_test_setup(without_names_a_line_is_found_by_the_label_of_its_chip, plug_chips_in),
        cmocka_unit_test_setup(chip_and_offset_may_be_given, plug_chips_in),
        cmocka_unit_test_setup(no_permission_is_not_taken_for_not_there, plug_chips_in),
        cmocka_unit_test_setup(who_holds_a_busy_line_is_named, plug_chips_in),
        cmocka_unit_test_setup(a_pin_without_a_name_is_refused, plug_chips_in),
        cmocka_unit_test(bounces_are_one_press),
        cmocka_unit_test(a_press_between_two_looks_is_seen_once),
        cmocka_unit_test(a_short_press_ends),
        cmocka_unit_test(a_button_held_at_the_start_is_held),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
