/* See panel_facts.h. */
#include "panel_facts.h"

#include "complain.h"

#include <stdarg.h>
#include <stdio.h>
#include <sys/utsname.h>

__attribute__((format(printf, 2, 3))) static void put_line(self_test_put *put, const char *format, ...)
{
    char line[256];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    complain_clean(line);
    put(line);
    put("\n");
}

static void put_device(const struct panel_kit *kit, self_test_put *put)
{
    char text[FT232H_VERSION_SIZE];
    if (kit->drm) {
        put_line(put, "device %s, scale %u, libdrm", kit->kms.where != NULL ? kit->kms.where : "the first display",
                 kit->kms.scale);
    } else if (kit->usb) {
        const char *version = ft232h_libusb_version(text);
        put_line(put, "device FT232H on USB, libusb %s", version != NULL ? version : "is missing");
    } else {
        const char *version = linux_gpiod_version();
        put_line(put, "device %s, bufsiz %u, libgpiod %s", kit->linux.spi.name, (unsigned)linux_spi_bufsiz(),
                 version != NULL ? version : "is missing");
    }
}

void panel_facts(const void *context, self_test_put *put)
{
    const struct panel_kit *const kit = context;
    struct utsname system;
    if (uname(&system) == 0) { /* its node name is nobody's business */
        put_line(put, "system %s %s %s", system.sysname, system.release, system.machine);
    }
    put_device(kit, put);
    if (!kit->drm) {
        put_line(put, "bus asked for %u Hz, SPI mode %u%s", (unsigned)kit->board.spi_hz, (unsigned)kit->board.spi_mode,
                 kit->usb ? "" : "; the kernel does not tell what it got");
    }
}
