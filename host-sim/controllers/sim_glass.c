/*
 * See sim_model.h. The glasses as the data sheets of their modules describe them. This table must not be made from
 * hal/panel/panels*.c: an error there would pass unseen.
 */
#include "panels.h"
#include "sim.h"
#include "sim_model.h"

#include <stdio.h>
#include <string.h>

/* Columns: panel, controller, glass, memory, first column and row; mirrored, bgr, complement, round, backlit; in order.
 * The pin DISP of a memory LCD counts as a backlight: while it is low nothing is seen. */
static const struct sim_glass glasses[] = {
    {"st7789-240x240", &sim_model_st7789, 240, 240, 240, 320, 0, 0, false, false, true, false, true, false},
    {"st7789-135x240", &sim_model_st7789, 135, 240, 240, 320, 52, 40, false, false, true, false, true, false},
    {"st7789-240x320", &sim_model_st7789, 240, 320, 240, 320, 0, 0, false, false, true, false, true, false},
    {"st7789-170x320", &sim_model_st7789, 170, 320, 240, 320, 35, 0, false, false, true, false, true, false},
    {"st7789-172x320", &sim_model_st7789, 172, 320, 240, 320, 34, 0, false, false, true, false, true, false},
    {"st7789-240x280", &sim_model_st7789, 240, 280, 240, 320, 0, 20, false, false, true, false, true, false},
    {"gc9a01-240x240", &sim_model_gc9a01, 240, 240, 240, 240, 0, 0, true, true, true, true, true, false},
    {"ili9341-240x320", &sim_model_ili9341, 240, 320, 240, 320, 0, 0, true, true, false, false, true, false},
    {"ili9488-320x480", &sim_model_ili9488, 320, 480, 320, 480, 0, 0, true, true, false, false, true, false},
    {"st7796s-320x480", &sim_model_st7796, 320, 480, 320, 480, 0, 0, true, true, false, false, true, false},
    {"hx8357d-320x480", &sim_model_hx8357d, 320, 480, 320, 480, 0, 0, true, true, false, false, true, false},
    {"ili9486-320x480", &sim_model_ili9486, 320, 480, 320, 480, 0, 0, true, true, false, false, true, false},
    {"st7735s-128x128", &sim_model_st7735s, 128, 128, 132, 132, 2, 1, false, true, false, false, true, false},
    {"st7735s-128x160", &sim_model_st7735s, 128, 160, 132, 162, 2, 1, false, true, false, false, true, false},
    {"st7735s-80x160", &sim_model_st7735s, 80, 160, 132, 162, 26, 1, false, true, true, false, true, false},
    {"ssd1351-128x128", &sim_model_ssd1351, 128, 128, 128, 128, 0, 0, false, false, false, false, false, false},
    {"ssd0323-128x64", &sim_model_ssd0323, 128, 64, 128, 80, 0, 0, false, false, false, false, false, false},
    {"ssd1306-128x64", &sim_model_ssd1306, 128, 64, 128, 64, 0, 0, true, false, false, false, false, false},
    {"ssd1306-128x32", &sim_model_ssd1306, 128, 32, 128, 64, 0, 0, true, false, false, false, false, true},
    {"ssd1306-72x40", &sim_model_ssd1306, 72, 40, 128, 64, 28, 0, true, false, false, false, false, false},
    {"ssd1309-128x64", &sim_model_ssd1309, 128, 64, 128, 64, 0, 0, true, false, false, false, false, false},
    {"sh1106-128x64", &sim_model_sh1106, 128, 64, 132, 64, 2, 0, true, false, false, false, false, false},
    {"sh1107-64x128", &sim_model_sh1107, 64, 128, 128, 128, 32, 0, false, false, false, false, false, false},
    {"sh1107-128x128", &sim_model_sh1107, 128, 128, 128, 128, 0, 0, false, false, false, false, false, false},
    {"ls013b7dh03-128x128", &sim_model_ls013b7dh03, 128, 128, 128, 128, 0, 0, false, false, false, false, true, false},
    {"ls027b7dh01-400x240", &sim_model_ls027b7dh01, 400, 240, 400, 240, 0, 0, false, false, false, false, true, false},
#ifdef GLASSES_MORE
#include "glasses_more.inc" /* those of make's PANEL_DIR */
#endif
};

static const char virtual_name[] = "virtual";

const struct sim_glass *sim_glass_find(const struct panel *panel, struct sim_glass *made)
{
    for (size_t i = 0; i < sizeof glasses / sizeof glasses[0]; i++) {
        if (strcmp(glasses[i].panel, panel->name) == 0) {
            return &glasses[i];
        }
    }
    if (strcmp(panel->name, virtual_name) != 0) {
        return NULL;
    }
    *made = (struct sim_glass){.panel = virtual_name,
                               .model = &sim_model_st7789,
                               .width = panel->width,
                               .height = panel->height,
                               .ram_width = panel->width,
                               .ram_height = panel->height,
                               .complement = true,
                               .backlit = true};
    return made;
}

int sim_virtual(struct sim_virtual *v, uint16_t width, uint16_t height)
{
    if (width < 1 || width > 1024 || height < 1 || height > 1024) {
        return HAL_EINVAL;
    }
    memset(v, 0, sizeof *v);
    snprintf(v->title, sizeof v->title, "no kit: a glass of %ux%u", width, height);
    v->panel = panel_st7789_240x320;
    v->panel.name = virtual_name;
    v->panel.width = v->panel.ram_width = width;
    v->panel.height = v->panel.ram_height = height;
    v->board = (struct board){
        .name = virtual_name,
        .title = v->title,
        .pinout = "none",
        .panel = &v->panel,
        .format = PANEL_RGB565,
        .spi_hz = 62500000,
        .pins = {.reset = BOARD_PIN(0), .backlight = BOARD_PIN(1)},
        .band_height = height < 16 ? height : 16,
        .scene_bytes = UINT32_MAX, /* that of the computer */
    };
    return HAL_OK;
}
