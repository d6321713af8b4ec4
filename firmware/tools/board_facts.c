/*
 * Usage: board-facts scene_bytes | image_ram 1 | image_ram 2 | pins
 * Prints scene_bytes of the board whose symbol BOARD_HERE is, or image_ram for so many cores, or C macros with its name
 * and its wired pins. firmware.mk compiles it with that board's board.c on the computer that builds the image.
 */
#include <stdio.h>
#include <string.h>

#include "board.h"

#ifdef BOARD_HERE /* make lint reads this file without a board */

extern const struct board BOARD_HERE;

static void put_pin(const struct board_pin *pin, const char *name)
{
    if (pin->wired) {
        printf(" PIN(%u, \"%s\")", (unsigned)pin->number, name);
    }
}

static void put_buttons(void)
{
    static const char *const names[] = {"button up", "button down", "button left", "button right", "button select"};
    for (uint32_t i = 0; i < BOARD_HERE.button_count; i++) {
        const struct board_button *button = &BOARD_HERE.buttons[i];
        uint32_t bit = 0;
        while (bit + 1 < sizeof names / sizeof *names && (button->button >> bit & 1) == 0) {
            bit++;
        }
        put_pin(&button->pin, names[bit]);
    }
}

static void put_pins(void)
{
    const struct board_pins *pins = &BOARD_HERE.pins;
    printf("#define BOARD_NAME \"%s\"\n", BOARD_HERE.name);
    printf("#define BOARD_CLOCK_PIN %u\n#define BOARD_DATA_PIN %u\n", (unsigned)pins->clock.number,
           (unsigned)pins->data.number);
    printf("#define BOARD_BUS %s\n", BOARD_HERE.i2c_address != 0 ? "FUNCTION_I2C" : "FUNCTION_SPI");
    printf("#define BOARD_PINS");
    put_pin(&pins->clock, "clock");
    put_pin(&pins->data, "data");
    put_pin(&pins->data_in, "data in");
    put_pin(&pins->select, "chip select");
    put_pin(&pins->dc, "D/C");
    put_pin(&pins->reset, "reset");
    put_pin(&pins->backlight, "backlight");
    put_pin(&pins->tearing, "tearing effect");
    put_buttons();
    printf("\n");
}

int main(int argc, char *argv[])
{
    if (argc == 2 && strcmp(argv[1], "pins") == 0) {
        put_pins();
    } else if (argc == 2 && strcmp(argv[1], "scene_bytes") == 0) {
        printf("%lu\n", (unsigned long)BOARD_HERE.scene_bytes);
    } else if (argc == 3 && strcmp(argv[1], "image_ram") == 0) {
        printf("%lu\n", (unsigned long)BOARD_HERE.image_ram[strcmp(argv[2], "2") == 0 ? 1 : 0]);
    } else {
        fprintf(stderr, "usage: board-facts scene_bytes | image_ram 1 | image_ram 2 | pins\n");
        return 2;
    }
    return fflush(stdout) == 0 ? 0 : 1;
}

#endif
