// SPDX-License-Identifier: Dual MIT/GPL
/* The GPIO chip: levels, edges, and who may have which line. */
#include "board.h"

#include <linux/device.h>
#include <linux/gpio/consumer.h>
#include <linux/gpio/driver.h>
#include <linux/gpio/machine.h>
#include <linux/hrtimer.h>
#include <linux/interrupt.h>
#include <linux/irq.h>
#include <linux/module.h>
#include <linux/spinlock.h>

static char *label = "pinctrl-bcm2835";
module_param(label, charp, 0444);
static char *names = "pi";
module_param(names, charp, 0444);
static bool persist = true;
module_param(persist, bool, 0444);

static struct {
    struct gpio_chip chip;
    bool there;
    u64 output, value;   /* lines that are outputs, and what they put out */
    u64 outside, driven; /* what is put on inputs from outside, and where */
    u64 pull;            /* what the others show */
    u64 shown;           /* levels at the last event */
    u64 moved;           /* lines that moved while events are kept back */
    bool held;
    u64 irq_on, irq_rising, irq_falling;
    int dir_error[BOARD_LINES];
    struct gpio_desc *busy[BOARD_LINES];
    char names[BOARD_LINES][12];
    const char *name_list[BOARD_LINES];
    spinlock_t lock;
    struct hrtimer te_timer;
    int te_line;
    u64 te_ns;
    bool te_high;
} gpio;

static u64 levels_now(void)
{
    return (gpio.output & gpio.value) | (~gpio.output & ((gpio.driven & gpio.outside) | (~gpio.driven & gpio.pull)));
}

/* Tells what has changed; gpio.lock is held. The lines whose edge interrupts are due. */
static u64 settle(void)
{
    u64 now = levels_now(), rising = now & ~gpio.shown, falling = gpio.shown & ~now;

    if (now == gpio.shown)
        return 0;
    gpio.shown = now;
    if (gpio.held)
        gpio.moved |= rising | falling;
    else
        board_log("%llu level %llx", board_now(), now);
    return gpio.irq_on & ((rising & gpio.irq_rising) | (falling & gpio.irq_falling));
}

/* With interrupts off, as a handler expects it, and without the lock: it may ask for the level. */
static void raise_irqs(u64 lines)
{
    int line;

    for (line = 0; line < BOARD_LINES; line++)
        if (lines >> line & 1)
            generic_handle_domain_irq(gpio.chip.irq.domain, line);
}

static void change(u64 *word, int line, bool on)
{
    *word = (*word & ~BIT_ULL(line)) | (u64)on << line;
}

u64 board_gpio_levels(void)
{
    unsigned long flags;
    u64 levels;

    spin_lock_irqsave(&gpio.lock, flags);
    levels = levels_now();
    spin_unlock_irqrestore(&gpio.lock, flags);
    return levels;
}

u64 board_gpio_hold(void)
{
    unsigned long flags;
    u64 levels;

    spin_lock_irqsave(&gpio.lock, flags);
    gpio.held = true;
    gpio.moved = 0;
    levels = gpio.shown;
    spin_unlock_irqrestore(&gpio.lock, flags);
    return levels;
}

u64 board_gpio_release(u64 levels)
{
    unsigned long flags;
    u64 at_end;

    spin_lock_irqsave(&gpio.lock, flags);
    gpio.held = false;
    at_end = levels ^ gpio.moved;
    spin_unlock_irqrestore(&gpio.lock, flags);
    return at_end;
}

/* ---- what the kernel asks of a chip ---- */

static int board_request(struct gpio_chip *chip, unsigned int line)
{
    board_log("%llu note request %u", board_now(), line);
    return 0;
}

static int board_input(struct gpio_chip *chip, unsigned int line)
{
    unsigned long flags;
    u64 edges;

    local_irq_save(flags);
    spin_lock(&gpio.lock);
    change(&gpio.output, line, false);
    edges = settle();
    spin_unlock(&gpio.lock);
    raise_irqs(edges);
    local_irq_restore(flags);
    return 0;
}

static void board_free(struct gpio_chip *chip, unsigned int line)
{
    board_log("%llu note release %u", board_now(), line);
    if (!persist)
        board_input(chip, line);
}

static int board_output(struct gpio_chip *chip, unsigned int line, int value)
{
    unsigned long flags;

    if (gpio.dir_error[line])
        return -gpio.dir_error[line];
    spin_lock_irqsave(&gpio.lock, flags);
    change(&gpio.output, line, true);
    change(&gpio.value, line, value);
    settle();
    spin_unlock_irqrestore(&gpio.lock, flags);
    return 0;
}

static int board_direction(struct gpio_chip *chip, unsigned int line)
{
    return gpio.output >> line & 1 ? GPIO_LINE_DIRECTION_OUT : GPIO_LINE_DIRECTION_IN;
}

static int board_get(struct gpio_chip *chip, unsigned int line)
{
    return board_gpio_levels() >> line & 1;
}

static void board_set(struct gpio_chip *chip, unsigned int line, int value)
{
    unsigned long flags;

    spin_lock_irqsave(&gpio.lock, flags);
    change(&gpio.value, line, value);
    settle();
    spin_unlock_irqrestore(&gpio.lock, flags);
}

static int board_config(struct gpio_chip *chip, unsigned int line, unsigned long config)
{
    unsigned long flags;
    enum pin_config_param what = pinconf_to_config_param(config);

    if (what != PIN_CONFIG_BIAS_PULL_UP && what != PIN_CONFIG_BIAS_PULL_DOWN && what != PIN_CONFIG_BIAS_DISABLE)
        return -ENOTSUPP;
    spin_lock_irqsave(&gpio.lock, flags);
    change(&gpio.pull, line, what == PIN_CONFIG_BIAS_PULL_UP);
    settle();
    spin_unlock_irqrestore(&gpio.lock, flags);
    return 0;
}

/* ---- edges ---- */

static void board_irq_mask(struct irq_data *data)
{
    change(&gpio.irq_on, irqd_to_hwirq(data), false);
    gpiochip_disable_irq(&gpio.chip, irqd_to_hwirq(data));
}

static void board_irq_unmask(struct irq_data *data)
{
    gpiochip_enable_irq(&gpio.chip, irqd_to_hwirq(data));
    change(&gpio.irq_on, irqd_to_hwirq(data), true);
}

static int board_irq_type(struct irq_data *data, unsigned int type)
{
    if (type & ~IRQ_TYPE_EDGE_BOTH)
        return -EINVAL;
    change(&gpio.irq_rising, irqd_to_hwirq(data), type & IRQ_TYPE_EDGE_RISING);
    change(&gpio.irq_falling, irqd_to_hwirq(data), type & IRQ_TYPE_EDGE_FALLING);
    return 0;
}

static const struct irq_chip irq_chip = {
    .name = "virtual-board",
    .irq_mask = board_irq_mask,
    .irq_unmask = board_irq_unmask,
    .irq_set_type = board_irq_type,
    .flags = IRQCHIP_IMMUTABLE,
    GPIOCHIP_IRQ_RESOURCE_HELPERS,
};

static void drive(int line, bool high)
{
    unsigned long flags;
    u64 edges;

    local_irq_save(flags);
    spin_lock(&gpio.lock);
    change(&gpio.outside, line, high);
    change(&gpio.driven, line, true);
    edges = settle();
    spin_unlock(&gpio.lock);
    raise_irqs(edges);
    local_irq_restore(flags);
}

static enum hrtimer_restart te_tick(struct hrtimer *timer)
{
    gpio.te_high = !gpio.te_high;
    drive(gpio.te_line, gpio.te_high);
    hrtimer_forward_now(timer, ns_to_ktime(gpio.te_high ? 100000 : gpio.te_ns - 100000));
    return HRTIMER_RESTART;
}

static void te(int line, unsigned int hz)
{
    hrtimer_cancel(&gpio.te_timer);
    gpio.te_line = line;
    drive(line, false);
    gpio.te_high = false;
    if (hz) {
        gpio.te_ns = 1000000000 / hz;
        hrtimer_start(&gpio.te_timer, ns_to_ktime(gpio.te_ns), HRTIMER_MODE_REL_HARD);
    }
}

/* ---- commands ---- */

static int hold_line(int line, const char *who, enum gpiod_flags how)
{
    struct gpio_desc *desc;

    if (gpio.busy[line])
        return -EBUSY;
    desc = gpiochip_request_own_desc(&gpio.chip, line, who, GPIO_LOOKUP_FLAGS_DEFAULT, how);
    if (IS_ERR(desc))
        return PTR_ERR(desc);
    gpio.busy[line] = desc;
    return 0;
}

static void let_line_go(int line)
{
    if (gpio.busy[line])
        gpiochip_free_own_desc(gpio.busy[line]);
    gpio.busy[line] = NULL;
}

int board_gpio_command(const char *verb, char *rest)
{
    unsigned int line = 0, number = 0;
    int words = rest ? sscanf(rest, "%u %u", &line, &number) : 0;

    if (words < 1 || line >= BOARD_LINES || !gpio.there)
        return -EINVAL;
    if (!strcmp(verb, "busy"))
        return hold_line(line, "somebody", GPIOD_ASIS);
    if (!strcmp(verb, "free"))
        let_line_go(line);
    else if (words < 2)
        return -EINVAL;
    else if (!strcmp(verb, "set"))
        drive(line, number);
    else if (!strcmp(verb, "te") && number <= 5000)
        te(line, number);
    else if (!strcmp(verb, "dir-error"))
        gpio.dir_error[line] = number;
    else
        return -EINVAL;
    return 0;
}

/* ---- start and end ---- */

/* Names lines as on the header; the stream always has these, whatever the chip calls its lines. */
static void name_lines(void)
{
    static const char *const old[] = {"ID_SDA", "ID_SCL",    "SDA1",      "SCL1",     "GPIO_GCLK", "GPIO5",
                                      "GPIO6",  "SPI_CE1_N", "SPI_CE0_N", "SPI_MISO", "SPI_MOSI",  "SPI_SCLK"};
    int line;

    for (line = 0; line < BOARD_LINES; line++) {
        snprintf(gpio.names[line], sizeof(gpio.names[line]), "GPIO%d", line);
        board_log("0 name %d %s", line, gpio.names[line]);
        gpio.name_list[line] = gpio.names[line];
        if (!strcmp(names, "old") && line < ARRAY_SIZE(old))
            gpio.name_list[line] = old[line];
        else if (line < 2)
            gpio.name_list[line] = old[line];
    }
}

int board_gpio_init(struct device *parent)
{
    struct gpio_chip *chip = &gpio.chip;
    int status;

    spin_lock_init(&gpio.lock);
    hrtimer_init(&gpio.te_timer, CLOCK_MONOTONIC, HRTIMER_MODE_REL_HARD);
    gpio.te_timer.function = te_tick;
    name_lines();
    gpio.pull = gpio.shown = 0x1ff; /* as the chip's reset leaves them */
    *chip = (struct gpio_chip){
        .label = label,
        .parent = parent,
        .owner = THIS_MODULE,
        .request = board_request,
        .free = board_free,
        .get_direction = board_direction,
        .direction_input = board_input,
        .direction_output = board_output,
        .get = board_get,
        .set = board_set,
        .set_config = board_config,
        .base = -1,
        .ngpio = BOARD_LINES,
        .names = strcmp(names, "none") ? gpio.name_list : NULL,
    };
    gpio_irq_chip_set_chip(&chip->irq, &irq_chip);
    chip->irq.handler = handle_simple_irq;
    chip->irq.default_type = IRQ_TYPE_NONE;
    board_log("0 level %llx", gpio.shown);
    status = gpiochip_add_data(chip, NULL);
    if (status)
        return status;
    gpio.there = true;
    /* The SPI driver's chip selects; their levels are told with the transfers. */
    status = hold_line(8, "spi0 CS0", GPIOD_OUT_HIGH);
    return status ? status : hold_line(7, "spi0 CS1", GPIOD_OUT_HIGH);
}

void board_gpio_exit(void)
{
    int line;

    if (!gpio.there)
        return;
    hrtimer_cancel(&gpio.te_timer);
    gpio.there = false;
    for (line = 0; line < BOARD_LINES; line++)
        let_line_go(line);
    gpiochip_remove(&gpio.chip);
}
