/* See panel_doctor.h. Looks at devices, groups, lines and libraries one by one, without changing any. */
#define _XOPEN_SOURCE 700 /* getgroups, glob */

#include "panel_doctor.h"

#include "complain.h"

#include <glob.h>
#include <grp.h>
#include <pwd.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#define USB_MAX 16

/* A line on a check; counts the failures. */
struct doctor {
    int failures;
};

__attribute__((format(printf, 3, 4))) static void tell(struct doctor *doctor, bool ok, const char *format, ...)
{
    char line[1024];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    complain_clean(line);
    printf("%-5s %s\n", ok ? "ok" : "FAIL", line);
    doctor->failures += !ok;
}

/* ---- SPI and lines ------------------------------------------------------------------------------ */

static void check_bufsiz(struct doctor *doctor)
{
    const size_t bufsiz = linux_spi_bufsiz();
    if (bufsiz == 0) {
        tell(doctor, false,
             "spidev: the kernel has it not loaded: turn SPI on (Raspberry Pi: dtparam=spi=on in "
             "config.txt, or raspi-config), then restart");
    } else if (bufsiz < 65536) {
        tell(doctor, true, "spidev: %u bytes a message; spidev.bufsiz=65536 on the kernel's command line makes fewer",
             (unsigned)bufsiz);
    } else {
        tell(doctor, true, "spidev: %u bytes a message", (unsigned)bufsiz);
    }
}

static void check_device(struct doctor *doctor, const struct panel_kit *kit)
{
    char error[LINUX_ERROR_SIZE] = "";
    struct linux_spi_look look;
    if (linux_spi_look(&kit->board, kit->linux.spi_path, &look, error) < 0) {
        tell(doctor, false, "%s", error);
        return;
    }
    if (kit->board.i2c_address != 0) {
        tell(doctor, true,
             "%s: opens; address %02Xh; %u Hz are as fast as the display allows (Raspberry Pi: "
             "dtparam=i2c_arm_baudrate=%u)",
             look.path, kit->board.i2c_address, look.got_hz, look.got_hz);
        return;
    }
    tell(doctor, true, "%s: opens; mode %u", look.path, (unsigned)kit->board.spi_mode);
    const uint32_t limit = kit->board.panel->controller->write_hz;
    tell(doctor, true,
         "clock: asks for %u Hz; the SPI controller may make less of it, which `speedtest` measures; the %s's "
         "datasheet allows %u Hz",
         look.asked_hz, kit->board.panel->controller->name, limit);
}

/* A group that owns devices, if this machine has it. */
static void check_group(struct doctor *doctor, const char *name)
{
    const struct group *group = getgrnam(name);
    const struct passwd *user = getpwuid(geteuid());
    if (group == NULL || user == NULL) {
        return;
    }
    const gid_t id = group->gr_gid;
    gid_t groups[256];
    int count = getgroups(256, groups);
    bool in = geteuid() == 0 || getegid() == id;
    for (int i = 0; i < count; i++) {
        in |= groups[i] == id;
    }
    if (in) {
        tell(doctor, true, "group %s: user %s may use it%s", name, user->pw_name, geteuid() == 0 ? " (root)" : "");
    } else {
        tell(doctor, false, "group %s: user %s is not in it: sudo usermod -aG %s %s, then log in again", name,
             user->pw_name, name, user->pw_name);
    }
}

static void check_line(struct doctor *doctor, const struct board *board, const char *what, const struct board_pin *pin)
{
    char error[LINUX_ERROR_SIZE] = "";
    struct linux_line_look look;
    if (!pin->wired) {
        return;
    }
    if (linux_line_look(board, pin, &look, error) < 0) {
        tell(doctor, false, "%s: %s", what, error);
    } else if (look.taken) {
        tell(doctor, false,
             "%s: line %s (%s, offset %u) is taken by '%s': end that program, or the overlay that holds it", what,
             pin->line, look.chip, look.offset, look.holder[0] != '\0' ? look.holder : "unknown");
    } else {
        tell(doctor, true, "%s: line %s is free (%s, %s, offset %u)", what, pin->line, look.chip, look.label,
             look.offset);
    }
}

static void check_lines(struct doctor *doctor, const struct board *board)
{
    static const char *const names[] = {"up", "down", "left", "right", "select"};
    const struct board_pins *pins = &board->pins;
    check_line(doctor, board, "D/C", &pins->dc);
    check_line(doctor, board, "reset", &pins->reset);
    check_line(doctor, board, "backlight", &pins->backlight);
    check_line(doctor, board, "TE", &pins->tearing);
    for (int i = 0; i < board->button_count; i++) {
        char what[24] = "button";
        for (int k = 0; k < 5; k++) {
            if (board->buttons[i].button == 1U << k) {
                snprintf(what, sizeof what, "button %s", names[k]);
            }
        }
        check_line(doctor, board, what, &board->buttons[i].pin);
    }
}

static void check_gpiod(struct doctor *doctor)
{
    const char *version = linux_gpiod_version();
    if (version == NULL) {
        tell(doctor, false, "libgpiod: Pinhole was built without: install libgpiod-dev and make it again");
    } else {
        tell(doctor, true, "libgpiod: version %s", version);
    }
    glob_t chips;
    if (glob("/dev/gpiochip*", 0, NULL, &chips) != 0) {
        tell(doctor, false, "/dev/gpiochip*: none is there: the kernel needs its GPIO character device");
        return;
    }
    for (size_t i = 0; i < chips.gl_pathc; i++) {
        if (access(chips.gl_pathv[i], R_OK | W_OK) == 0) {
            tell(doctor, true, "%s: may be used", chips.gl_pathv[i]);
        } else {
            tell(doctor, false, "%s: no permission: join group gpio, or install boards/udev/60-pinhole.rules",
                 chips.gl_pathv[i]);
        }
    }
    globfree(&chips);
}

static void check_linux(struct doctor *doctor, const struct panel_kit *kit, bool lines)
{
    check_bufsiz(doctor);
    check_device(doctor, kit);
    check_group(doctor, "spi");
    check_group(doctor, "gpio");
    check_gpiod(doctor);
    if (lines) {
        check_lines(doctor, &kit->board);
    }
}

/* ---- USB ---------------------------------------------------------------------------------------- */

static void check_one_usb(struct doctor *doctor, const struct ft232h_look *look)
{
    const char *serial = look->serial[0] != '\0' ? look->serial : "no serial number";
    if (look->status == HAL_EACCES) {
        tell(doctor, false,
             "FT232H at bus %u device %u: no permission: install boards/udev/60-pinhole.rules in "
             "/etc/udev/rules.d and plug it in again",
             look->bus, look->address);
    } else if (look->status < 0) {
        tell(doctor, false, "FT232H at bus %u device %u: cannot be opened (%d): unplug it and plug it in again",
             look->bus, look->address, look->status);
    } else {
        tell(doctor, true, "FT232H at bus %u device %u: may be used (%s)", look->bus, look->address, serial);
    }
}

static void check_usb(struct doctor *doctor, const char *serial, bool needed)
{
    struct ft232h_look looks[USB_MAX];
    char text[FT232H_VERSION_SIZE];
    const char *version = ft232h_libusb_version(text);
    bool found = serial == NULL;
    if (version == NULL) {
        tell(doctor, !needed, "libusb: Pinhole was built without: install libusb-1.0-0-dev and make it again");
        return;
    }
    tell(doctor, true, "libusb: version %s", version);
    const int count = ft232h_list(looks, USB_MAX);
    if (count <= 0) {
        tell(doctor, !needed, "FT232H: none is plugged in%s",
             needed ? ": plug it in; lsusb must show 0403:6014, and the cable must carry data" : "");
        return;
    }
    for (int i = 0; i < count && i < USB_MAX; i++) {
        check_one_usb(doctor, &looks[i]);
        found |= serial != NULL && strcmp(serial, looks[i].serial) == 0;
    }
    if (!found) {
        tell(doctor, false, "FT232H: none has the serial number '%s': give --usb one of those above", serial);
    }
    if (needed && serial == NULL && count > 1) {
        tell(doctor, false, "FT232H: there are %d: say which with --usb SERIAL", count);
    }
}

int panel_doctor(struct panel_kit *kit, const struct panel_options *o)
{
    struct doctor doctor = {0};
    const bool any = o->kit_count == 0;
    for (int i = 0; i < (any ? 1 : o->kit_count); i++) {
        if (panel_kit_choose(kit, &o->kits[i]) != 0) {
            return PH_ERR_INVAL;
        }
        if (kit->usb) {
            check_usb(&doctor, kit->ft232h.serial, true);
        } else {
            check_linux(&doctor, kit, !any);
        }
    }
    if (any) {
        check_usb(&doctor, NULL, false);
    }
    return doctor.failures == 0 ? 0 : COMPLAINED;
}
