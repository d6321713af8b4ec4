/* See hal_conformance.h: hal/ft232h over the real libusb, on the device that tests/guest/usb_main.c plays. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "boards.h"
#include "boards_all.h"
#include "ft232h/ft232h.h"
#include "hal_conformance.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static struct ft232h backend;

/* Opens, tries and closes; the first error. For runs in which the device fails somewhere. */
static int send_frames(const char *serial)
{
    static uint8_t bytes[115200];
    memset(&backend, 0, sizeof backend);
    backend.serial = serial;
    int status = ft232h_ops.open(&backend, &board_ft232h_st7789);
    if (status == 0) {
        const int32_t clock = ft232h_ops.bus_clock(&backend, 30000000);
        status = clock < 0 ? clock : 0;
    }
    for (int i = 0; i < 3 && status == 0; i++) {
        status = ft232h_ops.bus_write(&backend, HAL_COMMAND, bytes, 1);
        status = status != 0 ? status : ft232h_ops.bus_write(&backend, HAL_DATA, bytes, sizeof bytes);
    }
    status = status != 0 ? status : ft232h_ops.bus_wait(&backend);
    if (status != 0) {
        puts(ft232h_error(&backend));
    }
    ft232h_ops.close(&backend);
    ft232h_ops.close(&backend);
    return status;
}

static void the_backend_keeps_the_contract(void **state)
{
    (void)state;
    static const struct board *const boards[] = {&board_ft232h_st7789, &board_ft232h_ili9341};
    for (size_t i = 0; i < sizeof boards / sizeof boards[0]; i++) {
        const struct hal hal = {&ft232h_ops, &backend};
        memset(&backend, 0, sizeof backend);
        hal_conforms(&hal, boards[i], "ft232h", true);
    }
}

static void the_device_is_listed(void **state)
{
    (void)state;
    struct ft232h_look look;
    char version[FT232H_VERSION_SIZE];
    assert_int_equal(ft232h_list(&look, 1), 1);
    assert_int_equal(look.status, 0);
    assert_true(strlen(look.serial) > 0);
    assert_non_null(ft232h_libusb_version(version));
    memset(&backend, 0, sizeof backend);
    backend.serial = "no such number";
    assert_int_equal(ft232h_ops.open(&backend, &board_ft232h_st7789), HAL_ENODEV);
    assert_non_null(strstr(ft232h_error(&backend), "no FT232H has the serial number no such number; on USB: "));
    assert_non_null(strstr(ft232h_error(&backend), look.serial));
}

int ft232h_guest_tests(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_backend_keeps_the_contract),
        cmocka_unit_test(the_device_is_listed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

int ft232h_guest_send(const char *serial)
{
    return -send_frames(serial);
}
