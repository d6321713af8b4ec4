/* panel_facts: the lines about a computer and three kinds of kit. Libraries and the spidev are the test's own. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "panel_facts.h"

#include <stdio.h>
#include <string.h>
#include <sys/utsname.h>

static char text[1000];
static const char *version;

static void put(const char *part)
{
    strcat(text, part);
}

const char *ft232h_libusb_version(char to[FT232H_VERSION_SIZE])
{
    (void)to;
    return version;
}

const char *linux_gpiod_version(void)
{
    return version;
}

size_t linux_spi_bufsiz(void)
{
    return 4096;
}

/* The lines behind that of the system, which is without the name that the machine has. */
static void expect(const struct panel_kit *kit, const char *lines)
{
    struct utsname system;
    char expected[600];
    assert_int_equal(uname(&system), 0);
    snprintf(expected, sizeof expected, "system %s %s %s\n%s", system.sysname, system.release, system.machine, lines);
    text[0] = '\0';
    panel_facts(kit, put);
    assert_string_equal(text, expected);
}

static void each_kind_of_kit_has_its_lines(void **state)
{
    (void)state;
    struct panel_kit kit = {.board = {.spi_hz = 40000000, .spi_mode = 3}};
    version = "1.6.3";
    strcpy(kit.linux.spi.name, "/dev/spidev\x1b.1"); /* control characters do not get through */
    expect(&kit,
           "device /dev/spidev?.1, bufsiz 4096, libgpiod 1.6.3\nbus asked for 40000000 Hz, SPI mode 3; the kernel "
           "does not tell what it got\n");
    kit.usb = true;
    expect(&kit, "device FT232H on USB, libusb 1.6.3\nbus asked for 40000000 Hz, SPI mode 3\n");
    kit.usb = false;
    kit.drm = true;
    kit.kms.scale = 4;
    expect(&kit, "device the first display, scale 4, libdrm\n");
    kit.kms.where = "card1:DSI-1";
    expect(&kit, "device card1:DSI-1, scale 4, libdrm\n");
}

static void a_library_that_is_missing_is_told(void **state)
{
    (void)state;
    struct panel_kit kit = {.board = {.spi_hz = 5}};
    version = NULL;
    strcpy(kit.linux.spi.name, "x");
    expect(&kit, "device x, bufsiz 4096, libgpiod is missing\nbus asked for 5 Hz, SPI mode 0; the kernel does not tell "
                 "what it got\n");
    kit.usb = true;
    expect(&kit, "device FT232H on USB, libusb is missing\nbus asked for 5 Hz, SPI mode 0\n");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_kind_of_kit_has_its_lines),
        cmocka_unit_test(a_library_that_is_missing_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
