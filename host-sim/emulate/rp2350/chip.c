/* The emulated RP2350 as a whole: time goes on, the cores run in turns, resets. */
#include "chip.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define TURN (64 * 6666667ULL) /* that a core may be ahead of the other */

void chip_warn(struct chip *chip, const char *format, ...)
{
    char text[400];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    chip->hooks.warn(chip->hooks.user, text);
}

void chip_end(struct chip *chip, const char *why)
{
    chip->ended = why;
}

void chip_event_at(struct chip *chip, uint64_t time)
{
    chip->limit = time < chip->limit ? time : chip->limit;
}

uint64_t chip_interrupts(const struct chip *chip)
{
    return (uint64_t)((chip->timer_interrupts & chip->timer_enabled) != 0) << IRQ_TIMER0_0 |
           (uint64_t)((chip->dma_interrupts & chip->dma_enabled[0]) != 0) << IRQ_DMA_0 |
           (uint64_t)((chip->dma_interrupts & chip->dma_enabled[1]) != 0) << IRQ_DMA_1;
}

/* Resets everything but memory and the watchdog's own registers. */
void chip_reset(struct chip *chip)
{
    registers_restart(chip->registers);
    clocks_reset(chip);
    pins_reset(chip);
    memset(chip->spi, 0, sizeof chip->spi);
    memset(chip->channel, 0, sizeof chip->channel);
    memset(chip->dma_enabled, 0, sizeof chip->dma_enabled);
    chip->dma_interrupts = chip->timer_interrupts = chip->timer_enabled = 0;
    chip->alarm_time = NEVER;
    chip->core1_words = chip->locks = chip->mtime_control = 0;
    chip->mtime = 0;
    chip->uart_control = 0;
    qmi_reset(chip);
    xip_reset(chip);
    for (uint32_t i = 0; i < CORES; i++) {
        core_reset(&chip->core[i], 0, RAM_BASE + RAM_BYTES, 0);
        chip->core[i].started = i == 0;
    }
    rom_start(chip);
}

void chip_init(struct chip *chip, uint32_t cores, const uint8_t *image, uint32_t bytes)
{
    chip->flash = malloc(FLASH_BYTES);
    chip->registers = registers_new(&rp2350_registers, CORES);
    if (chip->flash == NULL || chip->registers == NULL) {
        abort();
    }
    memset(chip->flash, 0xff, FLASH_BYTES);
    memcpy(chip->flash, image, bytes);
    chip->flash_bytes = bytes;
    chip->cores = cores;
    chip->watchdog_time = NEVER;
    for (uint32_t i = 0; i < CORES; i++) {
        chip->core[i].chip = chip;
        chip->core[i].index = i;
        chip->core[i].lowest = UINT32_MAX;
    }
    chip_reset(chip);
}

/* The time at which the hardware does something next. */
static uint64_t next_event(const struct chip *chip)
{
    uint64_t next = chip->alarm_time < chip->watchdog_time ? chip->alarm_time : chip->watchdog_time;
    for (uint32_t i = 0; i < 2; i++) {
        if (chip->spi[i].busy && chip->spi[i].end < next) {
            next = chip->spi[i].end;
        }
    }
    for (uint32_t i = 0; i < chip->cores; i++) {
        const struct core *core = &chip->core[i];
        if (core->asleep && core_next_tick(core) < next) {
            next = core_next_tick(core);
        }
    }
    return next;
}

static void happen(struct chip *chip, uint64_t time)
{
    chip->now = time;
    for (uint32_t i = 0; i < 2; i++) {
        if (chip->spi[i].busy && chip->spi[i].end <= time) {
            spi_event(chip, i);
        }
    }
    timer_event(chip);
    for (uint32_t i = 0; i < chip->cores; i++) {
        if (chip->core[i].asleep) {
            core_wake(&chip->core[i]);
        }
    }
}

static struct core *behind(struct chip *chip)
{
    struct core *least = NULL;
    for (uint32_t i = 0; i < chip->cores; i++) {
        struct core *core = &chip->core[i];
        if (core->started && !core->asleep && !core->locked && (least == NULL || core->time < least->time)) {
            least = core;
        }
    }
    return least;
}

static uint32_t below(struct chip *chip, uint32_t n)
{
    chip->chance = chip->chance * 1664525 + 1013904223;
    return (chip->chance >> 8) % n;
}

void chip_set_delays(struct chip *chip, uint32_t frame)
{
    chip->chance = (chip->seed + frame) * 2654435761U;
}

/* Makes a core wait for a random time, up to 30 us, after a random number of turns, if delays are asked for. */
static void delay(struct chip *chip, struct core *core)
{
    static const uint32_t most[4] = {1, 3, 30, 300};
    if (chip->delay_left[core->index]-- == 0) {
        chip->delay_left[core->index] = below(chip, most[below(chip, 4)] + 1);
        core->time += below(chip, 30000) * (FS_PER_US / 1000);
    }
}

uint64_t chip_idle(const struct core *core)
{
    const uint64_t now = core->chip->now;
    return core->idle + (core->asleep && now > core->time ? now - core->time : 0);
}

bool chip_go_on(struct chip *chip)
{
    struct core *core = behind(chip);
    const uint64_t event = next_event(chip);
    if (core == NULL || event <= core->time) {
        if (event == NEVER) {
            chip_end(chip, "every core sleeps for ever");
        } else {
            chip->resting += core == NULL && event > chip->now ? event - chip->now : 0;
            happen(chip, event);
        }
        return chip->ended == NULL;
    }
    uint64_t until = event;
    for (uint32_t i = 0; i < chip->cores; i++) {
        const struct core *other = &chip->core[i];
        if (other != core && other->started && !other->asleep && !other->locked && other->time + TURN < until) {
            until = other->time + TURN;
        }
    }
    core_run(core, until);
    if (core->asleep) {
        core_wake(core);
    }
    if (chip->seed != 0) {
        delay(chip, core);
    }
    return chip->ended == NULL;
}
