/* sim_kit: a panel on the simulator, fed by hand: bytes as the datasheets describe them. For tests of the models. */
#ifndef SIM_KIT_H
#define SIM_KIT_H

#include "panels.h"
#include "sim.h"

struct kit {
    struct board board;
    struct hal hal;
    struct sim *sim;
};

/* A kit with both pins wired, within every clock limit. Must not move from plug() on. */
struct kit kit_with(const struct panel *panel);
void plug(struct kit *k);

void command(struct kit *k, uint8_t code);
void data(struct kit *k, const char *bytes, size_t n); /* at most 64 */

/* A string literal with its zeros, without its last one. */
#define DATA(k, text) data((k), (text), sizeof(text) - 1)

void wait_ms(struct kit *k, uint32_t ms);
void pin(struct kit *k, enum hal_pin p, bool level);

/* Reset, sleep-out, 16 bits a pixel. */
void wake_dbi(struct kit *k);

/* CASET and RASET with four bytes each. */
void window(struct kit *k, const char *columns, const char *rows);

/* RAMWR and a colour (RGB565) that many times; then display and backlight on. */
void fill_dbi(struct kit *k, uint32_t pixels, uint16_t colour);
void show_dbi(struct kit *k, uint32_t pixels, uint16_t colour);

/* 0xRRGGBB of a place of the upright glass, `width` wide. */
uint32_t seen_at(struct kit *k, uint32_t width, uint32_t x, uint32_t y);

/* The test fails unless there are n complaints, all of this kind; unless there are none. */
void only(struct kit *k, enum sim_complaint_kind kind, uint32_t n);
void none(struct kit *k);

#endif
