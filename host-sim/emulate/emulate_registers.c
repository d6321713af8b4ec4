/* See emulate_registers.h. */
#include "emulate_registers.h"

#include "complain.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define TICK_NS   1000000u
#define ACCESS_NS 128u /* before SysTick runs: two clocks of an internal oscillator, which may be 15.6 MHz */

static bool begins(const char *line, const char *word)
{
    return strncmp(line, word, strlen(word)) == 0;
}

/* The number behind a word of the line; 0: the word is not there. */
static uint32_t number_after(const char *line, const char *word, int base)
{
    const char *at = strstr(line, word);
    return at != NULL ? (uint32_t)strtoul(at + strlen(word), NULL, base) : 0;
}

/* SysTick lies in a region of its own within the private peripherals', and its accesses are told of twice. */
static void read_line(struct emulate_access *access, const char *line)
{
    const bool twice = strstr(line, "'systick'") != NULL;
    *access = (struct emulate_access){.tick = begins(line, "nvic_acknowledge_irq"),
                                      .store = !twice && begins(line, "memory_region_ops_write"),
                                      .load = !twice && begins(line, "memory_region_ops_read"),
                                      .address = number_after(line, " addr 0x", 16),
                                      .value = number_after(line, " value 0x", 16),
                                      .bytes = number_after(line, " size ", 10)};
}

int emulate_registers_open(struct emulate_registers *r, const struct register_chip *chip)
{
    *r = (struct emulate_registers){.model = registers_new(chip, 1)};
    return r->model != NULL ? 0 : complain("not enough memory for the chip's registers");
}

void emulate_registers_close(struct emulate_registers *r)
{
    registers_free(r->model);
}

static const char *take(struct emulate_registers *r, const struct emulate_access *a)
{
    const uint32_t held = registers_value(r->model, 0, a->address);
    const bool empty = a->store ? r->empty == a->address : a->value == 0;
    const uint32_t value = a->value | (empty ? held : 0);
    r->empty = a->load && empty ? a->address : 0;
    return a->store ? registers_write(r->model, 0, r->time_ns, a->address, value, a->bytes)
                    : registers_read(r->model, 0, r->time_ns, a->address, value, a->bytes);
}

int emulate_registers_line(struct emulate_registers *r, const char *line, struct emulate_access *access)
{
    read_line(access, line);
    if (access->tick) {
        r->ticks = true;
        r->time_ns += TICK_NS;
        return 0;
    }
    if (!access->store && !access->load) {
        if (r->said[0] == '\0' && !begins(line, "memory_region_ops_")) {
            snprintf(r->said, sizeof r->said, "%.*s", (int)strcspn(line, "\n"), line);
        }
        return 0;
    }
    const char *why = take(r, access);
    r->time_ns += r->ticks ? 0 : ACCESS_NS;
    return why != NULL ? complain("%s", why) : 0;
}

int emulate_registers_said(const struct emulate_registers *r)
{
    return r->said[0] != '\0' ? complain("QEMU says: %s", r->said) : 0;
}
