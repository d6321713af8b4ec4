// SPDX-License-Identifier: Dual MIT/GPL
/* The SPI controller: writes every byte down, divides its clock as a BCM2835 does, and fails when told. */
#include "board.h"

#include <linux/completion.h>
#include <linux/delay.h>
#include <linux/device.h>
#include <linux/module.h>
#include <linux/spi/spi.h>

static unsigned int core_hz = 250000000;
module_param(core_hz, uint, 0444);

#define CHUNK 2048 /* bytes an event */

static struct {
    struct spi_controller *controller;
    struct spi_device *device[2];
    unsigned int error_after, error_number, error_count;
    unsigned int setup_after, setup_number;
    unsigned int stall_after, stall_ms;
    struct completion go;
    unsigned int unplug_after;
    bool wire_time;
    u8 reply[64];
    unsigned int reply_bytes, replied;
} spi;

/* BCM2835 ARM Peripherals, 10.5, CLK: the divider is even, 0 means 65536, and 2 is the least. */
static u32 clock_got(u32 asked)
{
    u32 divider;

    if (asked >= core_hz / 2)
        return core_hz / 2;
    divider = asked ? DIV_ROUND_UP(core_hz, asked) : 65536;
    divider += divider & 1;
    return core_hz / min(divider, 65536U);
}

static const u8 *answer(struct spi_transfer *transfer)
{
    u8 *rx = transfer->rx_buf;
    unsigned int i;

    for (i = 0; rx && i < transfer->len; i++)
        rx[i] = spi.replied < spi.reply_bytes ? spi.reply[spi.replied++] : 0;
    return rx;
}

static void tell(struct spi_device *device, struct spi_transfer *transfer, u64 start, u64 levels, u64 end, u64 at_end)
{
    const u8 *bytes = transfer->tx_buf ? transfer->tx_buf : transfer->rx_buf;
    unsigned int i, n;
    u64 from = start, to;

    for (i = 0; i < transfer->len; i += n, from = to) {
        n = min_t(unsigned int, transfer->len - i, CHUNK);
        to = start + div_u64((end - start) * (i + n), transfer->len);
        board_log_room(2 * n);
        board_log_bytes(bytes + i, n, "%llu %s %u %u %u %x %u %llx %llx %llu ", from, transfer->tx_buf ? "spi" : "read",
                        (unsigned int)spi_get_chipselect(device, 0), transfer->speed_hz, transfer->effective_speed_hz,
                        (unsigned int)device->mode & 0xff, (unsigned int)transfer->bits_per_word, levels,
                        i + n == transfer->len ? at_end : levels, to);
    }
}

static int fault(void)
{
    if (spi.unplug_after && !--spi.unplug_after)
        board_unplug_soon();
    if (!spi.error_count || (spi.error_after && --spi.error_after))
        return 0;
    spi.error_count--;
    return -(int)spi.error_number;
}

/* Called for each change of mode, bits a word and speed. */
static int board_setup(struct spi_device *device)
{
    return spi.setup_after && !--spi.setup_after ? -(int)spi.setup_number : 0;
}

static int board_transfer(struct spi_controller *controller, struct spi_device *device, struct spi_transfer *transfer)
{
    u64 start, levels, at_end, end;
    int status = fault();

    if (status) {
        board_log("%llu note spi error %d", board_now(), status);
        return status;
    }
    transfer->effective_speed_hz = clock_got(transfer->speed_hz);
    start = board_now();
    levels = board_gpio_hold();
    if (spi.stall_after && !--spi.stall_after) {
        board_log("%llu note spi stall", board_now());
        wait_for_completion_timeout(&spi.go, msecs_to_jiffies(spi.stall_ms));
    }
    if (spi.wire_time) { /* by a precise timer: jiffies lag on a busy machine, so a sleep by them may end early */
        unsigned long us = div_u64(8000000ULL * transfer->len, transfer->effective_speed_hz) + 1;

        usleep_range(us, us + us / 8);
    }
    answer(transfer);
    end = board_now();
    at_end = board_gpio_release(levels);
    tell(device, transfer, start, levels, end, at_end);
    if (at_end != levels)
        board_log("%llu level %llx", end, board_gpio_levels());
    return 0;
}

/* ---- commands ---- */

static int set_reply(char *rest)
{
    unsigned int n = rest ? strlen(rest) / 2 : 0;

    if (n > sizeof(spi.reply) || (n && hex2bin(spi.reply, rest, n)))
        return -EINVAL;
    spi.reply_bytes = n;
    spi.replied = 0;
    return 0;
}

int board_spi_command(const char *verb, char *rest)
{
    unsigned int a = 0, b = 0, c = UINT_MAX;
    int words = rest ? sscanf(rest, "%u %u %u", &a, &b, &c) : 0;

    if (!strcmp(verb, "reply"))
        return set_reply(rest);
    if (!strcmp(verb, "spi-go")) {
        complete_all(&spi.go);
    } else if (!strcmp(verb, "wire-time") && words == 1) {
        spi.wire_time = a;
    } else if (!strcmp(verb, "spi-error") && words >= 2) {
        spi.error_number = b;
        spi.error_after = a;
        spi.error_count = c;
    } else if (!strcmp(verb, "spi-setup-error") && words == 2) {
        spi.setup_number = b;
        spi.setup_after = a;
    } else if (!strcmp(verb, "spi-stall") && words == 2) {
        reinit_completion(&spi.go);
        spi.stall_ms = b;
        spi.stall_after = a;
    } else if (!strcmp(verb, "spi-unplug") && words == 1) {
        spi.unplug_after = a;
    } else {
        return -EINVAL;
    }
    return 0;
}

/* ---- start and end ---- */

static int add_device(int select)
{
    /* spidev refuses the name "spidev" */
    struct spi_board_info info = {.modalias = "dh2228fv", .max_speed_hz = 125000000, .chip_select = select};

    spi.device[select] = spi_new_device(spi.controller, &info);
    return spi.device[select] ? 0 : -ENODEV;
}

int board_spi_init(struct device *parent)
{
    int status;

    init_completion(&spi.go);
    spi.controller = spi_alloc_host(parent, 0);
    if (!spi.controller)
        return -ENOMEM;
    spi.controller->bus_num = 0;
    spi.controller->num_chipselect = ARRAY_SIZE(spi.device);
    spi.controller->mode_bits = SPI_CPOL | SPI_CPHA | SPI_CS_HIGH | SPI_NO_CS;
    spi.controller->bits_per_word_mask = SPI_BPW_MASK(8);
    spi.controller->setup = board_setup;
    spi.controller->transfer_one = board_transfer;
    status = spi_register_controller(spi.controller);
    if (status) {
        spi_controller_put(spi.controller);
        spi.controller = NULL;
        return status;
    }
    status = add_device(0);
    return status ? status : add_device(1);
}

void board_spi_exit(void)
{
    if (spi.controller)
        spi_unregister_controller(spi.controller); /* with its devices */
    spi.controller = NULL;
}
