// SPDX-License-Identifier: Dual MIT/GPL
/* See board.h. */
#include "board.h"

#include <linux/miscdevice.h>
#include <linux/module.h>
#include <linux/platform_device.h>
#include <linux/string.h>
#include <linux/workqueue.h>

static unsigned int log_kb = 65536;
module_param(log_kb, uint, 0444);

static struct platform_device *platform;
static int plugged;

static struct miscdevice misc = {
    .minor = MISC_DYNAMIC_MINOR,
    .name = "virtual-board",
    .mode = 0666,
    .fops = &board_log_fops,
};

static void unplug(void)
{
    if (!xchg(&plugged, 0))
        return;
    board_log("%llu note unplug", board_now());
    board_i2c_exit();
    board_spi_exit();
    board_gpio_exit();
}

static void unplug_work(struct work_struct *work)
{
    unplug();
}

static DECLARE_WORK(unplug_later, unplug_work);

void board_unplug_soon(void)
{
    schedule_work(&unplug_later);
}

int board_command(char *line)
{
    char *rest = line, *verb = strsep(&rest, " ");

    if (!strcmp(verb, "follow") || !strcmp(verb, "end"))
        board_log_follow(*verb == 'f');
    else if (!strcmp(verb, "mark"))
        board_log("%llu note %s", board_now(), rest ? rest : "");
    else if (!strcmp(verb, "unplug"))
        unplug();
    else if (!strcmp(verb, "reply") || !strncmp(verb, "spi-", 4) || !strcmp(verb, "wire-time"))
        return board_spi_command(verb, rest);
    else
        return board_gpio_command(verb, rest);
    return 0;
}

static int __init board_init(void)
{
    int status = board_log_init(1024UL * log_kb);

    if (status)
        return status;
    platform = platform_device_register_simple("virtual-board", -1, NULL, 0);
    if (IS_ERR(platform)) {
        board_log_exit();
        return PTR_ERR(platform);
    }
    plugged = 1;
    status = board_gpio_init(&platform->dev);
    status = status ? status : board_spi_init(&platform->dev);
    status = status ? status : board_i2c_init(&platform->dev);
    status = status ? status : misc_register(&misc);
    if (status) {
        unplug();
        platform_device_unregister(platform);
        board_log_exit();
    }
    return status;
}

static void __exit board_exit(void)
{
    misc_deregister(&misc);
    cancel_work_sync(&unplug_later);
    unplug();
    platform_device_unregister(platform);
    board_log_exit();
}

module_init(board_init);
module_exit(board_exit);
MODULE_LICENSE("Dual MIT/GPL");
MODULE_DESCRIPTION("A display kit's header without the hardware, for tests");
