/* flash_usb: which devices are boards in their boot loader, how one is opened, and what becomes of each transfer;
 * libusb is played by the test. */
#include <libusb-1.0/libusb.h> /* tests/run.sh skips this program where the library is not installed */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "flash_usb.h"
#include "hal.h"

#include <stdlib.h>
#include <string.h>

/* ---- libusb ----------------------------------------------------------------------------------------------------- */

struct libusb_device {
    uint16_t vendor, product;
    uint8_t bus, address;
    int open_error;
    const char *serial;
};

struct libusb_context {
    int opened;
};

struct libusb_device_handle {
    int opened;
};

static struct libusb_context context;
static struct libusb_device_handle handle;
static struct libusb_device devices[40];
static int device_count, init_error, claim_error, claimed;
static struct libusb_interface_descriptor interfaces[3];
static struct libusb_endpoint_descriptor endpoints[2];

/* Of transfers: what comes back, and what was asked last. */
static int bulk_error, bulk_done, control_result, gone_after;
static uint8_t halted, asked_endpoint, asked_type, asked_request, cleared[2];
static uint16_t asked_value, asked_index;
static int asked_length, clears;
static uint8_t sent[64];

int libusb_init(libusb_context **to)
{
    *to = &context;
    context.opened += init_error == 0;
    return init_error;
}

void libusb_exit(libusb_context *from)
{
    from->opened--;
}

ssize_t libusb_get_device_list(libusb_context *from, libusb_device ***list)
{
    static libusb_device *all[40];
    assert_ptr_equal(from, &context);
    for (int i = 0; i < device_count; i++) {
        all[i] = &devices[i];
    }
    *list = all;
    return device_count;
}

void libusb_free_device_list(libusb_device **list, int unref)
{
    assert_true(list != NULL && unref == 1);
}

int libusb_get_device_descriptor(libusb_device *device, struct libusb_device_descriptor *d)
{
    *d =
        (struct libusb_device_descriptor){.idVendor = device->vendor, .idProduct = device->product, .iSerialNumber = 3};
    return 0;
}

uint8_t libusb_get_bus_number(libusb_device *device)
{
    return device->bus;
}

uint8_t libusb_get_device_address(libusb_device *device)
{
    return device->address;
}

static libusb_device *opened;

int libusb_open(libusb_device *device, libusb_device_handle **to)
{
    if (device->open_error == 0) {
        *to = &handle;
        handle.opened++;
        opened = device;
    }
    return device->open_error;
}

void libusb_close(libusb_device_handle *h)
{
    h->opened--;
}

int libusb_get_string_descriptor_ascii(libusb_device_handle *h, uint8_t index, unsigned char *data, int length)
{
    assert_true(h == &handle && index == 3);
    if (opened->serial == NULL) {
        return LIBUSB_ERROR_IO;
    }
    strncpy((char *)data, opened->serial, (size_t)length);
    return (int)strlen(opened->serial) < length ? (int)strlen(opened->serial) : length;
}

int libusb_get_active_config_descriptor(libusb_device *device, struct libusb_config_descriptor **config)
{
    static struct libusb_interface list[3];
    static struct libusb_config_descriptor one;
    assert_ptr_equal(device, opened);
    for (int i = 0; i < 3; i++) {
        list[i] = (struct libusb_interface){&interfaces[i], 1};
    }
    one = (struct libusb_config_descriptor){.bNumInterfaces = 3, .interface = list};
    *config = &one;
    return 0;
}

void libusb_free_config_descriptor(struct libusb_config_descriptor *config)
{
    assert_non_null(config);
}

int libusb_claim_interface(libusb_device_handle *h, int number)
{
    assert_ptr_equal(h, &handle);
    claimed = number;
    return claim_error;
}

int libusb_bulk_transfer(libusb_device_handle *h, unsigned char endpoint, unsigned char *data, int length, int *done,
                         unsigned int timeout)
{
    assert_true(h == &handle && timeout > 0);
    asked_endpoint = endpoint;
    asked_length = length;
    if ((endpoint & 0x80) == 0) {
        memcpy(sent, data, (size_t)length < sizeof sent ? (size_t)length : sizeof sent);
    }
    *done = bulk_done;
    return bulk_error;
}

int libusb_control_transfer(libusb_device_handle *h, uint8_t type, uint8_t request, uint16_t value, uint16_t index,
                            unsigned char *data, uint16_t length, unsigned int timeout)
{
    assert_true(h == &handle && timeout > 0);
    if (type == (LIBUSB_ENDPOINT_IN | LIBUSB_RECIPIENT_ENDPOINT) && request == LIBUSB_REQUEST_GET_STATUS) {
        assert_int_equal(length, 2);
        if (gone_after > 0 && --gone_after == 0) {
            return LIBUSB_ERROR_NO_DEVICE;
        }
        data[0] = halted;
        return 2;
    }
    asked_type = type, asked_request = request, asked_value = value, asked_index = index, asked_length = length;
    return control_result;
}

int libusb_clear_halt(libusb_device_handle *h, unsigned char endpoint)
{
    assert_ptr_equal(h, &handle);
    cleared[clears++ % 2] = endpoint;
    return 0;
}

/* ---- tests ------------------------------------------------------------------------------------------------------ */

static struct flash_usb *usb;

/* Device 1 is an RP2040, 2 an RP2350. The boot loader's interface is the one of the vendor's class: 5, in 84h, out 03h.
 */
static int fresh(void **state)
{
    (void)state;
    memset(devices, 0, sizeof devices);
    devices[0] = (struct libusb_device){.vendor = 0x2E8A, .product = 0x000A, .bus = 1, .address = 9};
    devices[1] =
        (struct libusb_device){.vendor = 0x2E8A, .product = 0x0003, .bus = 1, .address = 7, .serial = "E0C9\n1"};
    devices[2] = (struct libusb_device){.vendor = 0x2E8A, .product = 0x000F, .bus = 2, .address = 7, .serial = "5A"};
    devices[3] = (struct libusb_device){.vendor = 0x2E8B, .product = 0x0003, .bus = 2, .address = 1};
    device_count = 4;
    init_error = claim_error = bulk_error = bulk_done = control_result = gone_after = clears = 0;
    halted = 0;
    endpoints[0] = (struct libusb_endpoint_descriptor){.bEndpointAddress = 0x84};
    endpoints[1] = (struct libusb_endpoint_descriptor){.bEndpointAddress = 0x03};
    interfaces[0] =
        (struct libusb_interface_descriptor){.bInterfaceNumber = 0, .bInterfaceClass = LIBUSB_CLASS_MASS_STORAGE};
    interfaces[1] =
        (struct libusb_interface_descriptor){.bInterfaceNumber = 1, .bInterfaceClass = 0xFF, .bInterfaceSubClass = 1};
    interfaces[2] = (struct libusb_interface_descriptor){
        .bInterfaceNumber = 5, .bInterfaceClass = 0xFF, .bNumEndpoints = 2, .endpoint = endpoints};
    return 0;
}

static void boards_are_known_by_their_numbers(void **state)
{
    static struct flash_board boards[FLASH_BOARDS_MAX];
    (void)state;
    assert_int_equal(flash_usb_list(boards), 2);
    assert_true(boards[0].bus == 1 && boards[0].address == 7 && boards[0].chip == FLASH_RP2040 &&
                boards[0].status == 0);
    assert_null(strchr(boards[0].serial, '\n'));
    assert_int_equal(strncmp(boards[0].serial, "E0C9", 4), 0);
    assert_true(boards[1].bus == 2 && boards[1].chip == FLASH_RP2350);
    assert_string_equal(boards[1].serial, "5A");
    assert_true(context.opened == 0 && handle.opened == 0);
    devices[1].open_error = LIBUSB_ERROR_ACCESS;
    devices[2].serial = NULL;
    assert_int_equal(flash_usb_list(boards), 2);
    assert_true(boards[0].status == HAL_EACCES && boards[1].status == 0 && boards[1].serial[0] == '\0');
    for (int i = 0; i < 40; i++) {
        devices[i] = devices[2];
    }
    device_count = 40;
    assert_int_equal(flash_usb_list(boards), FLASH_BOARDS_MAX);
    device_count = -1;
    assert_int_equal(flash_usb_list(boards), HAL_EIO);
    init_error = LIBUSB_ERROR_OTHER;
    assert_int_equal(flash_usb_list(boards), HAL_EIO);
    assert_int_equal(context.opened, 0);
}

static int open_at(uint8_t bus, uint8_t address)
{
    return flash_usb_open(&usb, &(struct flash_board){.bus = bus, .address = address});
}

static void a_board_is_opened_by_its_vendors_interface(void **state)
{
    (void)state;
    assert_int_equal(open_at(2, 7), 0);
    assert_true(opened == &devices[2] && claimed == 5);
    bulk_done = 4;
    assert_int_equal(flash_usb_ops.out(usb, "abcd", 4), 4);
    assert_true(asked_endpoint == 0x03 && asked_length == 4 && memcmp(sent, "abcd", 4) == 0);
    flash_usb_close(usb);
    assert_true(context.opened == 0 && handle.opened == 0);
    flash_usb_close(NULL);
    assert_int_equal(open_at(2, 8), HAL_ENODEV);
    assert_null(usb);
    claim_error = LIBUSB_ERROR_BUSY;
    assert_int_equal(open_at(1, 7), HAL_EBUSY);
    claim_error = 0;
    devices[1].open_error = LIBUSB_ERROR_ACCESS;
    assert_int_equal(open_at(1, 7), HAL_EACCES);
    interfaces[2].bInterfaceProtocol = 1;
    assert_int_equal(open_at(2, 7), HAL_EIO);
    interfaces[2].bInterfaceProtocol = 0, endpoints[1].bEndpointAddress = 0x85; /* none leads out */
    assert_int_equal(open_at(2, 7), HAL_EIO);
    assert_true(context.opened == 0 && handle.opened == 0);
}

static int opened_board(void **state)
{
    fresh(state);
    return open_at(2, 7);
}

static int closed(void **state)
{
    (void)state;
    flash_usb_close(usb);
    return 0;
}

static void a_transfer_that_is_cut_off_is_an_error(void **state)
{
    uint8_t bytes[64];
    (void)state;
    bulk_done = 7;
    assert_int_equal(flash_usb_ops.in(usb, bytes, 7), 7);
    assert_true(asked_endpoint == 0x84 && asked_length == 7);
    assert_int_equal(flash_usb_ops.in(usb, bytes, 8), HAL_EIO);
    assert_int_equal(flash_usb_ops.out(usb, bytes, 8), HAL_EIO);
    assert_int_equal(flash_usb_ops.in(usb, NULL, 0), HAL_EIO); /* an empty packet has nothing in it */
    bulk_done = 0;
    assert_int_equal(flash_usb_ops.in(usb, NULL, 0), 0);
    assert_int_equal(flash_usb_ops.out(usb, "", 0), 0);
}

static void errors_are_those_of_the_bus(void **state)
{
    static const struct {
        int error, status;
    } cases[] = {{LIBUSB_ERROR_PIPE, FLASH_STALL},     {LIBUSB_ERROR_NO_DEVICE, HAL_ENODEV},
                 {LIBUSB_ERROR_NOT_FOUND, HAL_ENODEV}, {LIBUSB_ERROR_TIMEOUT, HAL_ETIMEDOUT},
                 {LIBUSB_ERROR_ACCESS, HAL_EACCES},    {LIBUSB_ERROR_BUSY, HAL_EBUSY},
                 {LIBUSB_ERROR_OVERFLOW, HAL_EIO}};
    uint8_t answer[16];
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        bulk_error = control_result = cases[i].error;
        assert_int_equal(flash_usb_ops.out(usb, "a", 1), cases[i].status);
        assert_int_equal(flash_usb_ops.status(usb, answer), cases[i].status);
        assert_int_equal(flash_usb_ops.reset(usb), cases[i].status);
    }
    bulk_error = LIBUSB_ERROR_IO, gone_after = 3; /* the board was unplugged, and the kernel notices late */
    assert_int_equal(flash_usb_ops.out(usb, "a", 1), HAL_ENODEV);
    bulk_error = LIBUSB_ERROR_OTHER, gone_after = 1;
    assert_int_equal(flash_usb_ops.out(usb, "a", 1), HAL_ENODEV);
    gone_after = 0;
    assert_int_equal(flash_usb_ops.out(usb, "a", 1), HAL_EIO);
}

/* RP2040 datasheet 2.8.5.5 and 2.8.5.6: INTERFACE_RESET is 41h 41h, GET_COMMAND_STATUS C1h 42h, of 16 bytes. */
static void control_requests_are_those_of_the_boot_loader(void **state)
{
    uint8_t answer[16];
    (void)state;
    control_result = 16;
    assert_int_equal(flash_usb_ops.status(usb, answer), 0);
    assert_true(asked_type == 0xC1 && asked_request == 0x42 && asked_value == 0 && asked_index == 5 &&
                asked_length == 16);
    control_result = 0;
    assert_int_equal(flash_usb_ops.reset(usb), 0);
    assert_true(asked_type == 0x41 && asked_request == 0x41 && asked_value == 0 && asked_index == 5 &&
                asked_length == 0);
    assert_int_equal(clears, 0);
    halted = 1;
    assert_int_equal(flash_usb_ops.reset(usb), 0);
    assert_true(clears == 2 && cleared[0] == 0x84 && cleared[1] == 0x03);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(boards_are_known_by_their_numbers, fresh),
        cmocka_unit_test_setup(a_board_is_opened_by_its_vendors_interface, fresh),
        cmocka_unit_test_setup_teardown(a_transfer_that_is_cut_off_is_an_error, opened_board, closed),
        cmocka_unit_test_setup_teardown(errors_are_those_of_the_bus, opened_board, closed),
        cmocka_unit_test_setup_teardown(control_requests_are_those_of_the_boot_loader, opened_board, closed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
