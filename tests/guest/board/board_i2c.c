// SPDX-License-Identifier: Dual MIT/GPL
/* The I2C controller, bus 1 as on a Pi's header: writes every message down. A display answers at 3Ch, nobody else. */
#include "board.h"

#include <linux/i2c.h>
#include <linux/module.h>

#define DISPLAY  0x3c
#define CLOCK_HZ 400000

static struct i2c_adapter adapter;

static int transfer(struct i2c_adapter *unused, struct i2c_msg *messages, int count)
{
    int i;

    for (i = 0; i < count; i++) {
        struct i2c_msg *m = &messages[i];
        u64 start = board_now(), end = start + div_u64(1000000000ULL * (9 * (m->len + 1) + 2), CLOCK_HZ);

        if (m->addr != DISPLAY || (m->flags & I2C_M_RD))
            return -ENXIO;
        board_log_room(2 * m->len);
        board_log_bytes(m->buf, m->len, "%llu i2c %x %u %llu ", start, m->addr, CLOCK_HZ, end);
        while (board_now() < end)
            cpu_relax();
    }
    return count;
}

static u32 functionality(struct i2c_adapter *unused)
{
    return I2C_FUNC_I2C;
}

static const struct i2c_algorithm algorithm = {.master_xfer = transfer, .functionality = functionality};

int board_i2c_init(struct device *parent)
{
    adapter = (struct i2c_adapter){.owner = THIS_MODULE, .name = "virtual board", .algo = &algorithm, .nr = 1};
    adapter.dev.parent = parent;
    return i2c_add_numbered_adapter(&adapter);
}

void board_i2c_exit(void)
{
    if (adapter.algo)
        i2c_del_adapter(&adapter);
    adapter.algo = NULL;
}
