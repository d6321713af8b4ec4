/* Clocks of the emulated RP2350: resets (datasheet 7.5), oscillator, PLLs, clocks and ticks (8), the power-on state
 * machine (7.4) and the watchdog (12.9). */
#include "chip.h"

#include <string.h>

#define CRYSTAL_HZ   12e6
#define SYS_LIMIT_HZ 150e6
#define ALL_BLOCKS   0x1fffffff
#define WATCHDOG_ON  (1U << 30)
enum { PSM_ALL_BUT_OSCILLATORS = 0x1ffffff & ~(3 << 2), PSM_PROC1 = 1 << 24 };

/* Block of 4 KB and offset in it. */
enum {
    SYSINFO = 0x40000000,
    CLOCKS = 0x40010000,
    PSM = 0x40018000,
    RESETS = 0x40020000,
    XOSC = 0x40048000,
    PLL_SYS = 0x40050000,
    PLL_USB = 0x40058000,
    WATCHDOG = 0x400d8000,
    POWMAN = 0x40100000,
    TICKS = 0x40108000
};

static bool crystal_runs(const struct chip *chip)
{
    return chip->xosc_control >> 12 == 0xfab;
}

/* PLL (8.6): reference x feedback / two dividers. */
static double pll_hz(struct chip *chip, uint32_t number)
{
    const struct pll *pll = &chip->pll[number];
    const uint32_t divider = pll->cs & 63, post1 = pll->post >> 16 & 7, post2 = pll->post >> 12 & 7;
    if (!crystal_runs(chip) || divider == 0 || post1 == 0 || post2 == 0 || (pll->power & 0x29) != 0) {
        return 0;
    }
    return CRYSTAL_HZ / divider * pll->feedback / (post1 * post2);
}

static double sys_source(struct chip *chip)
{
    static const double none = 0;
    const uint32_t aux = chip->sys_control >> 5 & 7;
    if ((chip->sys_control & 1) == 0) {
        return chip->ref_hz;
    }
    return aux < 2                          ? pll_hz(chip, aux)
           : aux == 2                       ? chip->facts.ring_hz
           : aux == 3 && crystal_runs(chip) ? CRYSTAL_HZ
                                            : none;
}

static double peri_source(struct chip *chip)
{
    const uint32_t aux = chip->peri_control >> 5 & 7;
    if ((chip->peri_control & 1 << 11) == 0) {
        return 0;
    }
    return aux == 0 ? chip->sys_hz : aux < 3 ? pll_hz(chip, aux - 1) : aux == 3 ? chip->facts.ring_hz : CRYSTAL_HZ;
}

static uint64_t ticks_now(const struct chip *chip, uint32_t number)
{
    const struct tick *tick = &chip->tick[number];
    return tick->counted + (tick->period == 0 ? 0 : (chip->now - tick->from) / tick->period);
}

static void tick_update(struct chip *chip, uint32_t number)
{
    struct tick *tick = &chip->tick[number];
    tick->counted = ticks_now(chip, number);
    tick->from = chip->now;
    tick->period =
        (tick->control & 1) != 0 && tick->cycles != 0 ? (uint64_t)(tick->cycles * 1e15 / chip->ref_hz + 0.5) : 0;
    if (tick->period != 0 && (tick->period < 990000000 || tick->period > 1010000000)) {
        chip_warn(chip, "%s counts in steps of %.3f us", number == 0 ? "timer 0" : "the watchdog",
                  (double)tick->period / 1e9);
    }
}

/* After anything that a clock depends on has changed. */
static void update(struct chip *chip)
{
    const uint32_t source = chip->ref_control & 3;
    const double ref = chip->ref_hz;
    chip->ref_hz = source == 2 && crystal_runs(chip) ? CRYSTAL_HZ : source == 0 ? chip->facts.ring_hz : 0;
    const double sys = sys_source(chip) / (chip->sys_divider / 65536.0);
    if (sys <= 0 || chip->ref_hz <= 0) {
        chip_warn(chip, "the cores' clock stops");
        return;
    }
    if (sys > SYS_LIMIT_HZ * 1.0001) {
        chip_warn(chip, "the cores' clock is %.1f MHz, over the chip's 150", sys / 1e6);
    }
    chip->sys_hz = sys;
    chip->sys_cycle = (uint64_t)(1e15 / sys + 0.5);
    chip->peri_hz = peri_source(chip) / (chip->peri_divider >> 16 & 3 ? chip->peri_divider >> 16 & 3 : 1);
    for (uint32_t i = 0; i < 2 && ref != chip->ref_hz; i++) {
        tick_update(chip, i);
    }
    if (chip->peri_hz > SYS_LIMIT_HZ * 1.0001) {
        chip_warn(chip, "clk_peri is %.1f MHz, over the chip's 150", chip->peri_hz / 1e6);
    }
}

void clocks_reset(struct chip *chip)
{
    chip->resets = ALL_BLOCKS;
    chip->xosc_control = chip->ref_control = chip->peri_control = 0;
    chip->sys_control = 0x41;
    chip->sys_divider = chip->peri_divider = 1 << 16;
    chip->pll[0] = chip->pll[1] = (struct pll){.cs = 1, .power = 0x2d, .post = 0x77000};
    memset(chip->tick, 0, sizeof chip->tick);
    chip->psm_off = 0;
    facts_reset(chip);
    update(chip);
}

static uint32_t pll_read(struct chip *chip, struct pll *pll, uint32_t offset)
{
    const bool on = (pll->power & 0x21) == 0 && pll->feedback != 0 && crystal_runs(chip);
    switch (offset) {
    case 0:
        return pll->cs | (on && chip->now >= pll->locked_from ? 1U << 31 : 0);
    case 4:
        return pll->power;
    case 8:
        return pll->feedback;
    default:
        return pll->post;
    }
}

static void pll_write(struct chip *chip, struct pll *pll, uint32_t offset, uint32_t value)
{
    uint32_t *const words[4] = {&pll->cs, &pll->power, &pll->feedback, &pll->post};
    *words[offset >> 2 & 3] = offset == 0 ? value & 63 : value;
    pll->locked_from = chip->now + 10 * FS_PER_US;
    update(chip);
}

static uint64_t watchdog_left(const struct chip *chip)
{
    return chip->watchdog_time == NEVER ? chip->watchdog_load : (chip->watchdog_time - chip->now) / FS_PER_US;
}

static uint32_t watchdog_read(struct chip *chip, uint32_t offset)
{
    if (offset == 0) {
        return chip->watchdog_control | (uint32_t)(watchdog_left(chip) & 0xffffff);
    }
    if (offset >= 0xc && offset < 0x2c) {
        return chip->watchdog_scratch[(offset - 0xc) / 4];
    }
    return offset == 8 ? chip->watchdog_reason : 0;
}

/* The load counts down once a microsecond while the watchdog is on and has its tick. */
static void watchdog_write(struct chip *chip, uint32_t offset, uint32_t value)
{
    if (offset >= 0xc && offset < 0x2c) {
        chip->watchdog_scratch[(offset - 0xc) / 4] = value;
        return;
    }
    if (offset == 4) {
        chip->watchdog_load = value & 0xffffff;
    } else if (offset == 0) {
        chip->watchdog_control = value & WATCHDOG_ON;
    }
    chip->watchdog_time =
        (chip->watchdog_control & WATCHDOG_ON) != 0 ? chip->now + chip->watchdog_load * FS_PER_US : NEVER;
    chip_event_at(chip, chip->watchdog_time);
}

static void watchdog_bites(struct chip *chip)
{
    chip->watchdog_time = NEVER;
    chip->watchdog_control = 0;
    chip->watchdog_reason = 1;
    chip->hooks.trouble(chip->hooks.user, "the watchdog resets the chip");
    if (chip->psm_watchdog != PSM_ALL_BUT_OSCILLATORS) {
        chip_warn(chip, "the watchdog does not reset all of the chip");
    }
    chip_reset(chip);
}

static bool is_counter(uint32_t offset)
{
    return offset >= 0x8c && offset < 0xac;
}

static uint32_t clock_register(struct chip *chip, uint32_t offset)
{
    if (is_counter(offset)) {
        return counter_read(chip, (offset - 0x8c) / 4);
    }
    switch (offset) {
    case 0x30:
        return chip->ref_control;
    case 0x38:
        return 1U << (chip->ref_control & 3);
    case 0x3c:
        return chip->sys_control;
    case 0x40:
        return chip->sys_divider;
    case 0x44:
        return 1U << (chip->sys_control & 1);
    case 0x48:
        return chip->peri_control;
    case 0x4c:
        return chip->peri_divider;
    default:
        chip_warn(chip, "register %x of the clocks is not modelled", offset);
        return 0;
    }
}

static void set_clock(struct chip *chip, uint32_t offset, uint32_t value)
{
    if (is_counter(offset)) {
        counter_write(chip, (offset - 0x8c) / 4, value);
        return;
    }
    switch (offset) {
    case 0x30:
        chip->ref_control = value;
        break;
    case 0x3c:
        chip->sys_control = value;
        break;
    case 0x40:
        chip->sys_divider = value;
        break;
    case 0x48:
        chip->peri_control = value;
        break;
    case 0x4c:
        chip->peri_divider = value;
        break;
    default:
        chip_warn(chip, "register %x of the clocks is not modelled", offset);
        break;
    }
    update(chip);
}

static uint32_t *tick_register(struct chip *chip, uint32_t offset)
{
    struct tick *tick = &chip->tick[offset >= 0x30];
    if ((offset & ~4U) != 0x18 && (offset & ~4U) != 0x30) {
        chip_warn(chip, "register %x of the ticks is not modelled", offset);
    }
    return (offset & 7) == 0 ? &tick->control : &tick->cycles;
}

uint32_t clocks_read(struct chip *chip, uint32_t address)
{
    const uint32_t offset = address & 0xfff;
    switch (address & ~0xfffU) {
    case CLOCKS:
        return clock_register(chip, offset);
    case PSM:
        return offset == 4 ? chip->psm_off : chip->psm_watchdog;
    case RESETS:
        return offset == 8 ? ~chip->resets & ALL_BLOCKS : chip->resets;
    case XOSC:
        return offset == 4 ? (crystal_runs(chip) && chip->now >= chip->xosc_stable ? 1U << 31 : 0) : chip->xosc_control;
    case PLL_SYS:
        return pll_read(chip, &chip->pll[0], offset);
    case PLL_USB:
        return pll_read(chip, &chip->pll[1], offset);
    case WATCHDOG:
        return watchdog_read(chip, offset);
    case TICKS:
        return *tick_register(chip, offset);
    default:
        break;
    }
    if ((address & ~0xfffU) == SYSINFO && offset == 0) {
        return chip->facts.id;
    }
    if ((address & ~0xfffU) == POWMAN && offset == 0x2c) {
        return chip->facts.reset;
    }
    chip_warn(chip, "the model has no register %08x", address);
    return 0;
}

/* Puts core 1 into the ROM, or lets it out of reset. */
static void psm_write(struct chip *chip, uint32_t offset, uint32_t value)
{
    if (offset == 8) {
        chip->psm_watchdog = value;
    } else if (offset == 4) {
        chip->psm_off = value;
        if (value & PSM_PROC1) {
            core_reset(&chip->core[1], 0, RAM_BASE + RAM_BYTES, 0);
            chip->core[1].started = false;
            chip->core1_words = 0;
        }
    }
}

static void xosc_write(struct chip *chip, uint32_t offset, uint32_t value)
{
    if (offset == 0) {
        chip->xosc_stable = crystal_runs(chip) ? chip->xosc_stable
                                               : chip->now + (uint64_t)(chip->xosc_startup * 256 * 1e15 / CRYSTAL_HZ);
        chip->xosc_control = value;
    } else if (offset == 0xc) {
        chip->xosc_startup = value & 0x3fff;
    }
}

void clocks_write(struct chip *chip, uint32_t address, uint32_t value)
{
    const uint32_t offset = address & 0xfff;
    switch (address & ~0xfffU) {
    case CLOCKS:
        set_clock(chip, offset, value);
        break;
    case PSM:
        psm_write(chip, offset, value);
        break;
    case RESETS:
        chip->resets = offset == 0 ? value & ALL_BLOCKS : chip->resets;
        break;
    case XOSC:
        xosc_write(chip, offset, value);
        break;
    case PLL_SYS:
        pll_write(chip, &chip->pll[0], offset, value);
        break;
    case PLL_USB:
        pll_write(chip, &chip->pll[1], offset, value);
        break;
    case WATCHDOG:
        watchdog_write(chip, offset, value);
        break;
    case TICKS:
        *tick_register(chip, offset) = value;
        tick_update(chip, offset >= 0x30);
        break;
    default:
        chip_warn(chip, "the model has no register %08x", address);
        break;
    }
}

static void set_alarm(struct chip *chip, uint32_t value)
{
    const uint32_t ahead = value - (uint32_t)ticks_now(chip, 0);
    chip->alarm = value;
    chip->alarm_time = chip->tick[0].period == 0 ? NEVER : chip->now + ahead * chip->tick[0].period;
    chip_event_at(chip, chip->alarm_time);
}

uint32_t timer_read(struct chip *chip, uint32_t offset)
{
    switch (offset) {
    case 0x10:
        return chip->alarm;
    case 0x24:
        return (uint32_t)(ticks_now(chip, 0) >> 32);
    case 0x28:
        return (uint32_t)ticks_now(chip, 0);
    case 0x3c:
        return chip->timer_interrupts;
    case 0x40:
        return chip->timer_enabled;
    default:
        chip_warn(chip, "register %x of the timer is not modelled", offset);
        return 0;
    }
}

void timer_write(struct chip *chip, uint32_t offset, uint32_t value)
{
    switch (offset) {
    case 0x10:
        set_alarm(chip, value);
        break;
    case 0x3c:
        chip->timer_interrupts &= ~value;
        break;
    case 0x40:
        chip->timer_enabled = value & 15;
        break;
    default:
        chip_warn(chip, "register %x of the timer is not modelled", offset);
        break;
    }
}

/* The alarm and the watchdog. */
void timer_event(struct chip *chip)
{
    if (chip->alarm_time <= chip->now) {
        chip->alarm_time = NEVER;
        chip->timer_interrupts |= 1;
    }
    if (chip->watchdog_time <= chip->now) {
        watchdog_bites(chip);
    }
}
