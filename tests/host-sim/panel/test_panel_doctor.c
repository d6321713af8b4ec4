/* panel_doctor: what is told of a machine that the test plays: its devices, groups, lines and libraries, each as it
 * should be and in each way wrong. */
#define _XOPEN_SOURCE 700
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "complain.h"
#include "panel_doctor.h"
#include "panels.h"

#include <glob.h>
#include <grp.h>
#include <pwd.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* ---- the machine ------------------------------------------------------------------------------------------------ */

static struct machine {
    size_t bufsiz;
    int spi_status, line_status, choose_status, chips, usb_count;
    const char *taken; /* a line by its name, or NULL */
    const char *holder;
    const char *gpiod, *libusb;
    bool may_chips, has_groups, is_root, is_member, owns;
    struct ft232h_look usb[3];
    bool kit_is_usb;
    const char *kit_serial;
} here;

size_t linux_spi_bufsiz(void)
{
    return here.bufsiz;
}

int linux_spi_look(const struct board *board, const char *path, struct linux_spi_look *look,
                   char error[LINUX_ERROR_SIZE])
{
    assert_string_equal(path, "/dev/spi");
    assert_int_equal(board->spi_mode, 3);
    *look = (struct linux_spi_look){.path = "/dev/spi", .asked_hz = 123};
    snprintf(error, LINUX_ERROR_SIZE, "no SPI here");
    return here.spi_status;
}

int linux_line_look(const struct board *board, const struct board_pin *pin, struct linux_line_look *look,
                    char error[LINUX_ERROR_SIZE])
{
    assert_non_null(board);
    *look = (struct linux_line_look){.chip = "/dev/gpiochip9", .label = "label", .offset = 7};
    look->taken = here.taken != NULL && strcmp(pin->line, here.taken) == 0;
    snprintf(look->holder, sizeof look->holder, "%s", here.holder);
    snprintf(error, LINUX_ERROR_SIZE, "no line %s", pin->line);
    return here.line_status;
}

const char *linux_gpiod_version(void)
{
    return here.gpiod;
}

const char *ft232h_libusb_version(char text[FT232H_VERSION_SIZE])
{
    text[0] = '\0';
    return here.libusb;
}

int ft232h_list(struct ft232h_look *looks, int max)
{
    assert_int_equal(max, 16);
    memcpy(looks, here.usb, sizeof here.usb);
    return here.usb_count;
}

int panel_kit_choose(struct panel_kit *kit, const struct panel_wiring *wiring)
{
    memset(kit, 0, sizeof *kit);
    assert_true(wiring->board == NULL || strcmp(wiring->board, "a board") == 0);
    kit->board = (struct board){.panel = &panel_st7789_240x240,
                                .spi_mode = 3,
                                .button_count = 2,
                                .buttons = {{4, BOARD_LINE("L4")}, {16, BOARD_LINE("L16")}},
                                .pins = {.dc = BOARD_LINE("DC"), .reset = BOARD_LINE("RST")}};
    kit->linux.spi_path = "/dev/spi";
    kit->usb = here.kit_is_usb;
    kit->ft232h.serial = here.kit_serial;
    return here.choose_status;
}

/* In place of the C library's: a user of the group 7. */
struct group *getgrnam(const char *name)
{
    static struct group group;
    group.gr_gid = strcmp(name, "spi") == 0 ? 100 : 200;
    return here.has_groups ? &group : NULL;
}

struct passwd *getpwuid(uid_t uid)
{
    static char name[] = "somebody";
    static struct passwd user = {.pw_name = name};
    assert_int_equal(uid, here.is_root ? 0 : 5);
    return &user;
}

uid_t geteuid(void)
{
    return here.is_root ? 0 : 5;
}

gid_t getegid(void)
{
    return here.owns ? 100 : 7;
}

int getgroups(int size, gid_t list[])
{
    assert_int_equal(size, 256);
    list[0] = 1;
    list[1] = here.is_member ? 200 : 2;
    return 2;
}

int access(const char *path, int mode)
{
    assert_int_equal(mode, R_OK | W_OK);
    return here.may_chips || strcmp(path, "/dev/gpiochip1") != 0 ? 0 : -1;
}

int glob(const char *pattern, int flags, int (*failed)(const char *, int), glob_t *to)
{
    static char names[2][16] = {"/dev/gpiochip0", "/dev/gpiochip1"};
    static char *list[2] = {names[0], names[1]};
    (void)flags, (void)failed;
    assert_string_equal(pattern, "/dev/gpiochip*");
    to->gl_pathc = (size_t)here.chips;
    to->gl_pathv = list;
    return here.chips > 0 ? 0 : GLOB_NOMATCH;
}

void globfree(glob_t *list)
{
    list->gl_pathc = 0;
}

/* ---- tests ------------------------------------------------------------------------------------------------------ */

static struct panel_options options;
static char *told;

static int fresh(void **state)
{
    (void)state;
    here = (struct machine){.bufsiz = 65536,
                            .chips = 2,
                            .holder = "x",
                            .gpiod = "2.1",
                            .libusb = "1.0.26",
                            .may_chips = true,
                            .has_groups = true,
                            .is_member = true,
                            .owns = true,
                            .usb_count = 1,
                            .usb = {{.bus = 1, .address = 2, .serial = "AB"}, {.bus = 3, .address = 4}}};
    options = (struct panel_options){.kit_count = 1, .kits = {{.board = "a board"}}};
    return 0;
}

static int doctor(void)
{
    static struct panel_kit kit;
    size_t n;
    FILE *const before = stdout;
    free(told);
    stdout = open_memstream(&told, &n);
    const int status = panel_doctor(&kit, &options);
    fclose(stdout);
    stdout = before;
    return status;
}

static unsigned failures(void)
{
    unsigned n = 0;
    for (const char *at = told; (at = strstr(at, "FAIL  ")) != NULL; at++) {
        n++;
    }
    return n;
}

static void tells(const char *line)
{
    if (strstr(told, line) == NULL) {
        fail_msg("'%s' is not in:\n%s", line, told);
    }
}

/* A machine with one thing wrong: one line says so. */
static void fails(const char *line)
{
    assert_int_equal(doctor(), COMPLAINED);
    tells(line);
    assert_int_equal(failures(), 1);
    fresh(NULL);
}

static void what_is_right_is_told_line_by_line(void **state)
{
    (void)state;
    assert_int_equal(doctor(), 0);
    assert_string_equal(
        told, "ok    spidev: 65536 bytes a message\n"
              "ok    /dev/spi: opens; mode 3\n"
              "ok    clock: asks for 123 Hz; the SPI controller may make less of it, which `speedtest` measures; "
              "the ST7789's datasheet allows 62500000 Hz\n"
              "ok    group spi: user somebody may use it\n"
              "ok    group gpio: user somebody may use it\n"
              "ok    libgpiod: version 2.1\n"
              "ok    /dev/gpiochip0: may be used\n"
              "ok    /dev/gpiochip1: may be used\n"
              "ok    D/C: line DC is free (/dev/gpiochip9, label, offset 7)\n"
              "ok    reset: line RST is free (/dev/gpiochip9, label, offset 7)\n"
              "ok    button left: line L4 is free (/dev/gpiochip9, label, offset 7)\n"
              "ok    button select: line L16 is free (/dev/gpiochip9, label, offset 7)\n");
}

static void each_thing_that_is_wrong_is_told(void **state)
{
    (void)state;
    here.bufsiz = 0;
    fails("FAIL  spidev: the kernel has it not loaded");
    here.spi_status = -1;
    fails("FAIL  no SPI here\n");
    here.owns = false;
    fails("FAIL  group spi: user somebody is not in it: sudo usermod -aG spi somebody, then log in again\n");
    here.is_member = false;
    fails("FAIL  group gpio: user somebody is not in it: sudo usermod -aG gpio somebody");
    here.gpiod = NULL;
    fails("FAIL  libgpiod: Pinhole was built without");
    here.chips = 0;
    fails("FAIL  /dev/gpiochip*: none is there");
    here.may_chips = false;
    fails("FAIL  /dev/gpiochip1: no permission");
    here.taken = "RST";
    fails("FAIL  reset: line RST (/dev/gpiochip9, offset 7) is taken by 'x'");
    here.taken = "L16", here.holder = "";
    fails("FAIL  button select: line L16 (/dev/gpiochip9, offset 7) is taken by 'unknown'");
    here.line_status = -1;
    assert_int_equal(doctor(), COMPLAINED);
    tells("FAIL  D/C: no line DC\n");
    assert_int_equal(failures(), 4);
}

static void what_is_not_as_good_as_it_could_be_does_not_fail(void **state)
{
    (void)state;
    here.bufsiz = 65535;
    assert_int_equal(doctor(), 0);
    tells("ok    spidev: 65535 bytes a message; spidev.bufsiz=65536");
    fresh(NULL);
    here.owns = here.is_member = false, here.is_root = true;
    assert_int_equal(doctor(), 0);
    tells("ok    group gpio: user somebody may use it (root)\n");
    fresh(NULL);
    here.has_groups = false;
    assert_int_equal(doctor(), 0);
    assert_null(strstr(told, "group"));
}

static void an_ft232h_is_needed_when_it_was_asked_for(void **state)
{
    (void)state;
    fresh(NULL);
    here.kit_is_usb = true;
    assert_int_equal(doctor(), 0);
    assert_string_equal(told, "ok    libusb: version 1.0.26\nok    FT232H at bus 1 device 2: may be used (AB)\n");
    static const struct {
        const char *libusb, *serial;
        int count, status;
        const char *line;
    } cases[] = {{NULL, NULL, 1, 0, "FAIL  libusb: Pinhole was built without"},
                 {"1", NULL, 0, 0, "FAIL  FT232H: none is plugged in: plug it in"},
                 {"1", NULL, -1, 0, "FAIL  FT232H: none is plugged in: plug it in"},
                 {"1", NULL, 1, HAL_EACCES, "FAIL  FT232H at bus 1 device 2: no permission"},
                 {"1", NULL, 1, HAL_EIO, "FAIL  FT232H at bus 1 device 2: cannot be opened"},
                 {"1", "CD", 2, 0, "FAIL  FT232H: none has the serial number 'CD'"},
                 {"1", NULL, 2, 0, "FAIL  FT232H: there are 2: say which with --usb SERIAL"}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        here.kit_is_usb = true;
        here.libusb = cases[i].libusb, here.kit_serial = cases[i].serial;
        here.usb_count = cases[i].count, here.usb[0].status = cases[i].status;
        fails(cases[i].line);
    }
    here.kit_is_usb = true, here.usb_count = 2, here.kit_serial = "AB";
    assert_int_equal(doctor(), 0);
    tells("ok    FT232H at bus 3 device 4: may be used (no serial number)\n");
}

static void without_a_kit_all_that_any_needs_is_looked_at(void **state)
{
    (void)state;
    options.kit_count = 0;
    options.kits[0].board = NULL;
    here.libusb = NULL;
    assert_int_equal(doctor(), 0);
    tells("ok    libgpiod");
    tells("ok    libusb: Pinhole was built without"); /* nothing needs it */
    assert_null(strstr(told, "line DC"));
    here.libusb = "1", here.usb_count = 0;
    assert_int_equal(doctor(), 0);
    tells("ok    FT232H: none is plugged in\n");
    here.usb_count = 2;
    assert_int_equal(doctor(), 0);
    options.kit_count = 2, options.kits[0].board = options.kits[1].board = "a board";
    assert_int_equal(doctor(), 0);
    assert_non_null(strstr(strstr(told, "spidev") + 1, "spidev: 65536")); /* both of them */
    here.choose_status = PH_ERR_INVAL;
    assert_int_equal(doctor(), PH_ERR_INVAL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(what_is_right_is_told_line_by_line, fresh),
        cmocka_unit_test_setup(each_thing_that_is_wrong_is_told, fresh),
        cmocka_unit_test_setup(what_is_not_as_good_as_it_could_be_does_not_fail, fresh),
        cmocka_unit_test_setup(an_ft232h_is_needed_when_it_was_asked_for, fresh),
        cmocka_unit_test_setup(without_a_kit_all_that_any_needs_is_looked_at, fresh),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
