/* sim_bus: a panel on the simulator, fed by hand: bytes as the datasheets describe them. For tests of the models. */
#ifndef SIM_BUS_H
#define SIM_BUS_H

#include "panels.h"
#include "sim.h"

struct sim_bus {
    struct board board;
    struct hal hal;
    struct sim *sim;
};

/* A kit with both pins wired, within every clock limit. Must not move from plug() on. */
struct sim_bus sim_bus_with(const struct panel *panel);
void plug(struct sim_bus *k);

void command(struct sim_bus *k, uint8_t code);
void data(struct sim_bus *k, const char *bytes, size_t n); /* at most 64 */

/* A string literal with its zeros, without its last one. */
#define DATA(k, text) data((k), (text), sizeof(text) - 1)

void wait_ms(struct sim_bus *k, uint32_t ms);
void pin(struct sim_bus *k, enum hal_pin p, bool level);

/* Reset, sleep-out, 16 bits a pixel; ST7789: RAMCTRL with EPF 10, which shows the 16 bits as they are. */
void wake_dbi(struct sim_bus *k);

/* Unlocks everything; offset 0. */
void wake_ssd1351(struct sim_bus *k);

/* CASET and RASET with four bytes each. */
void window(struct sim_bus *k, const char *columns, const char *rows);

/* RAMWR and a colour (RGB565) that many times; then display and backlight on. */
void fill_dbi(struct sim_bus *k, uint32_t pixels, uint16_t colour);
void show_dbi(struct sim_bus *k, uint32_t pixels, uint16_t colour);

/* 0xRRGGBB of a place of the upright glass, `width` wide. */
uint32_t seen_at(struct sim_bus *k, uint32_t width, uint32_t x, uint32_t y);

/* The test fails unless there are n complaints, all of this kind; unless there are none. */
void only(struct sim_bus *k, enum sim_complaint_kind kind, uint32_t n);
void none(struct sim_bus *k);

#endif
