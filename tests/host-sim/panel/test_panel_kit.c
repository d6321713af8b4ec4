/* panel_kit: boards of the list with what a command line changes. The kernel's display is the test's own. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "complain.h"
#include "panel_kit.h"
#include "panel_picture.h"
#include "panels.h"
#include "stderr_capture.h"

#include <string.h>

/* ---- the kernel's display --------------------------------------------------------------------------------------- */

static int find_status, closed;
const struct hal_ops kms_ops;

int kms_find(struct kms *kms)
{
    kms->width = 400;
    kms->height = 300;
    return find_status;
}

const char *kms_error(const struct kms *kms)
{
    (void)kms;
    return "no display";
}

struct panel_sender kms_sender(struct kms *kms)
{
    return (struct panel_sender){.context = kms};
}

void kms_card_close(struct kms_card *card)
{
    closed += card != NULL;
}

/* ---- the tests -------------------------------------------------------------------------------------------------- */

static struct panel_kit kit;
static struct stderr_capture said;

static int choose(struct panel_wiring w)
{
    memset(&kit, 0x55, sizeof kit);
    stderr_capture_begin(&said);
    const int status = panel_kit_choose(&kit, &w);
    stderr_capture_end(&said);
    return status;
}

static void take(struct panel_wiring w)
{
    const int status = choose(w);
    assert_string_equal(said.text, "");
    assert_int_equal(status, 0);
}

static void a_board_is_taken_as_it_is(void **state)
{
    (void)state;
    take((struct panel_wiring){.board = "rpi-pirate-audio", .rotate = 2, .mode = 3}); /* which are not set */
    assert_memory_equal(&kit.board, board_find("rpi-pirate-audio"), sizeof kit.board);
    assert_false(kit.usb || kit.drm);
    assert_ptr_equal(kit.hal.ops, &linux_ops);
    assert_ptr_equal(kit.hal.context, &kit.linux);
    assert_null(kit.linux.spi_path);
    take((struct panel_wiring){.board = "ft232h-ili9341", .serial = "77"});
    assert_true(kit.usb);
    assert_ptr_equal(kit.hal.ops, &ft232h_ops);
    assert_ptr_equal(kit.hal.context, &kit.ft232h);
    assert_string_equal(kit.ft232h.serial, "77");
}

static void a_panel_alone_borrows_wires(void **state)
{
    (void)state;
    take((struct panel_wiring){.panel = "st7735s-128x160"});
    assert_string_equal(kit.board.name, "st7735s-128x160");
    assert_memory_equal(&kit.board.pins, &board_find("sbc-generic")->pins, sizeof kit.board.pins);
    take((struct panel_wiring){.panel = "st7735s-128x160", .usb = true});
    assert_true(kit.usb);
    assert_memory_equal(&kit.board.pins, &board_find("ft232h-st7789")->pins, sizeof kit.board.pins);
    take((struct panel_wiring){.usb = true});
    assert_string_equal(kit.board.name, "ft232h-st7789");
    take((struct panel_wiring){.panel = "st7735s-128x160", .board = "rpi-pitft-2in8"}); /* which is turned */
    assert_string_equal(kit.board.name, "rpi-pitft-2in8");
    assert_int_equal(board_find("rpi-pitft-2in8")->rotation, PANEL_R270);
    assert_int_equal(kit.board.rotation, PANEL_R0);
}

/* The first format of the panel, no rotation, and the slower clock of board and datasheet. */
static void another_glass_changes_what_hangs_on_it(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < panel_count; i++) {
        const struct panel *const panel = panel_list[i];
        const struct board *const plain = board_find("ft232h-ili9341");
        const uint32_t limit = panel->controller->write_hz;
        take((struct panel_wiring){.board = "ft232h-ili9341", .panel = panel->name});
        assert_ptr_equal(kit.board.panel, panel);
        assert_int_equal(kit.board.rotation, PANEL_R0);
        assert_false(kit.board.over_limit);
        assert_int_equal(kit.board.spi_hz, plain->spi_hz < limit ? plain->spi_hz : limit);
        assert_true((panel->formats & PANEL_FORMAT_BIT(kit.board.format)) != 0);
        for (uint8_t format = PANEL_RGB565; format < kit.board.format; format++) {
            assert_true((panel->formats & PANEL_FORMAT_BIT(format)) == 0);
        }
    }
}

static void the_command_line_changes_wires_and_clock(void **state)
{
    (void)state;
    take((struct panel_wiring){.board = "rpi-pirate-audio",
                               .spi = "/dev/spidev9.9",
                               .lines = {"GPIO1", "GPIO2", "-", "GPIO4"},
                               .mode_set = true,
                               .mode = 3,
                               .rotate_set = true,
                               .rotate = 3,
                               .speed_hz = 123});
    const struct board_pins *const pins = &kit.board.pins;
    assert_string_equal(kit.linux.spi_path, "/dev/spidev9.9");
    assert_true(pins->dc.wired && pins->reset.wired && !pins->backlight.wired && pins->tearing.wired);
    assert_string_equal(pins->dc.line, "GPIO1");
    assert_string_equal(pins->reset.line, "GPIO2");
    assert_string_equal(pins->tearing.line, "GPIO4");
    assert_int_equal(kit.board.spi_mode, 3);
    assert_int_equal(kit.board.rotation, 3);
    assert_int_equal(kit.board.spi_hz, 123);
    take((struct panel_wiring){.board = "ft232h-ili9341", .lines = {"AC0", "AD7", "AC7", "-"}});
    assert_string_equal(kit.board.pins.dc.line, "AC0");
    assert_string_equal(kit.board.pins.backlight.line, "AC7");
}

static void only_boards_with_named_lines_can_be_driven(void **state)
{
    (void)state;
    struct board board = *board_find("rpi-pirate-audio");
    assert_true(panel_kit_has(&board));
    board.pins.dc.wired = false;
    assert_false(panel_kit_has(&board));
    board.pins.dc = (struct board_pin){.wired = true};
    assert_false(panel_kit_has(&board));
}

static void what_cannot_be_is_said(void **state)
{
    static const struct {
        struct panel_wiring wiring;
        const char *part;
    } wrong[] = {
        {{.board = "rpi"}, "--board 'rpi': no such board; "},
        {{.board = "pico-display"}, "--board 'pico-display': no kit for this machine's SPI bus or USB"},
        {{.board = "rpi-pirate-audio", .usb = true}, "--usb: 'rpi-pirate-audio' is no kit for an FT232H"},
        {{.panel = "crt"}, "--panel 'crt': no such panel"},
        {{.usb = true, .lines = {"GPIO1"}}, "--dc 'GPIO1': a pin of the FT232H is AD0 .. AD7 or AC0 .. AC7"},
        {{.usb = true, .lines = {NULL, "AB1"}}, "--reset 'AB1': a pin"},
        {{.usb = true, .lines = {NULL, "BC1"}}, "--reset 'BC1': a pin"},
        {{.usb = true, .lines = {NULL, NULL, "AC8"}}, "--backlight 'AC8': a pin"},
        {{.usb = true, .lines = {NULL, NULL, "AC/"}}, "--backlight 'AC/': a pin"},
        {{.usb = true, .lines = {NULL, NULL, "AD10"}}, "--backlight 'AD10': a pin"},
        {{.usb = true, .lines = {NULL, NULL, NULL, "AC1"}}, "--te: an FT232H has no line that waits for an edge"},
        {{.usb = true, .spi = "/dev/s"}, "--spi /dev/s: 'ft232h-st7789' is on USB"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        assert_int_equal(choose(wrong[i].wiring), PH_ERR_INVAL);
        if (strstr(said.text, wrong[i].part) == NULL) {
            fail_msg("not \"%s\": %s", wrong[i].part, said.text);
        }
    }
}

static void the_kernels_display_is_a_board_of_its_size(void **state)
{
    (void)state;
    find_status = 0;
    take((struct panel_wiring){.drm = true, .card = "card7", .rotate = 1});
    assert_true(kit.drm && !kit.usb);
    assert_string_equal(kit.kms.where, "card7");
    assert_string_equal(kit.board.name, "card7");
    assert_string_equal(kit.board.title, "a display of 400x300");
    assert_ptr_equal(kit.board.panel, &kit.glass);
    assert_string_equal(kit.glass.name, "kms");
    assert_true(kit.glass.width == 400 && kit.glass.ram_width == 400);
    assert_true(kit.glass.height == 300 && kit.glass.ram_height == 300);
    assert_int_equal(kit.board.rotation, 1);
    assert_int_equal(kit.board.scene_bytes, UINT32_MAX);
    assert_int_equal(kit.board.band_height, 16);
    assert_ptr_equal(kit.hal.ops, &kms_ops);
    assert_ptr_equal(kit.hal.context, &kit.kms);
    assert_ptr_equal(kit.sender.context, &kit.kms);
    assert_string_equal(panel_kit_error(&kit), "no display");
    take((struct panel_wiring){.drm = true});
    assert_string_equal(kit.board.name, "the kernel's display");
    find_status = -1;
    assert_int_equal(choose((struct panel_wiring){.drm = true}), COMPLAINED);
    assert_string_equal(said.text, "pinhole: no display\n");
    find_status = 0;
}

static void what_was_taken_is_given_back_and_missing_buttons_are_told(void **state)
{
    (void)state;
    static char card;
    for (int denied = 0; denied < 2; denied++) {
        take((struct panel_wiring){.drm = true});
        kit.kms.card = (struct kms_card *)(void *)&card;
        kit.kms.keys.denied = denied != 0;
        closed = 0;
        stderr_capture_begin(&said);
        panel_kit_release(&kit);
        stderr_capture_end(&said);
        assert_int_equal(closed, 1);
        assert_null(kit.kms.card);
        assert_int_equal(strstr(said.text, "/dev/input: no permission") != NULL, denied);
    }
}

/* What the glass of a kit shows of a picture when it is driven so, black where it was not written. */
static void show(struct panel_wiring w, uint8_t *seen)
{
    static uint16_t picture[PICTURE_PIXELS];
    static uint8_t scratch[512];
    take(w);
    struct hal hal;
    struct sim *sim = sim_open(&kit.board, &hal);
    assert_non_null(sim);
    const struct panel_config config = {kit.board.panel, kit.board.rotation, kit.board.format, 1000000,
                                        scratch,         sizeof scratch};
    struct panel_driver d;
    assert_int_equal(panel_open(&d, &hal, &config), 0);
    picture_fill(picture, d.width, d.height, 1);
    assert_int_equal(picture_draw(&d, picture, 16), 0);
    sim_pixels(sim, kit.board.rotation, seen);
    sim_close(sim);
}

static uint8_t right[3 * PICTURE_PIXELS], other[3 * PICTURE_PIXELS];

static void a_glass_may_be_another_than_its_name_says(void **state)
{
    (void)state;
    static const char *const colours[] = {"st7789-240x240", "ili9341-240x320", "ssd1351-128x128"};
    for (size_t i = 0; i < sizeof colours / sizeof colours[0]; i++) {
        const struct panel *const panel = panel_find(colours[i]);
        const bool inverted = i == 0; /* IPS */
        show((struct panel_wiring){.panel = colours[i]}, right);
        show((struct panel_wiring){.panel = colours[i], .bgr = true, .invert_set = true, .invert = inverted}, other);
        for (int p = 0; p < 3 * panel->width * panel->height; p += 3) {
            assert_true(right[p] == other[p + 2] && right[p + 1] == other[p + 1] && right[p + 2] == other[p]);
        }
    }
    static const char *const names[] = {"st7789-240x240", "ili9341-240x320", "ssd1351-128x128", "ssd0323-128x64",
                                        "sh1106-128x64"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        const struct panel *const panel = panel_find(names[i]);
        show((struct panel_wiring){.panel = names[i]}, right);
        show((struct panel_wiring){.panel = names[i], .invert_set = true, .invert = i != 0}, other);
        for (int p = 0; p < 3 * panel->width * panel->height; p++) {
            assert_int_equal(right[p], 255 - other[p]);
        }
    }
}

/* A glass whose first row is row 0 shows row 20 of the memory as its row 20. */
static void the_offset_is_where_the_picture_begins(void **state)
{
    (void)state;
    show((struct panel_wiring){.panel = "st7789-240x240"}, right);
    show((struct panel_wiring){.panel = "st7789-240x240", .offset_set = true, .offset = {0, 20}}, other);
    assert_memory_equal(other + 3 * 240 * 20, right, 3 * 240 * 220);
    show((struct panel_wiring){.panel = "st7735s-80x160"}, right);
    show((struct panel_wiring){.panel = "st7735s-80x160", .offset_set = true, .offset = {24, 1}}, other);
    for (int y = 0; y < 160; y++) {
        assert_memory_equal(other + 240 * y, right + 240 * y + 6, 234);
    }
    assert_int_equal(choose((struct panel_wiring){.panel = "st7735s-80x160", .offset_set = true, .offset = {53, 0}}),
                     PH_ERR_INVAL);
    assert_non_null(strstr(said.text, "the ST7735S has 132x162 pixels, the glass 80x160"));
    assert_int_equal(choose((struct panel_wiring){.panel = "st7735s-80x160", .offset_set = true, .offset = {0, 3}}),
                     PH_ERR_INVAL);
    assert_int_equal(choose((struct panel_wiring){.panel = "ssd1306-72x40", .bgr = true}), PH_ERR_INVAL);
    assert_non_null(strstr(said.text, "--bgr: the SSD1306 has one colour"));
    for (uint32_t i = 0; i < panel_count; i++) {
        assert_true(panel_list[i]->init_bytes <= sizeof kit.init);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_board_is_taken_as_it_is),
        cmocka_unit_test(a_panel_alone_borrows_wires),
        cmocka_unit_test(another_glass_changes_what_hangs_on_it),
        cmocka_unit_test(the_command_line_changes_wires_and_clock),
        cmocka_unit_test(only_boards_with_named_lines_can_be_driven),
        cmocka_unit_test(what_cannot_be_is_said),
        cmocka_unit_test(a_glass_may_be_another_than_its_name_says),
        cmocka_unit_test(the_offset_is_where_the_picture_begins),
        cmocka_unit_test(the_kernels_display_is_a_board_of_its_size),
        cmocka_unit_test(what_was_taken_is_given_back_and_missing_buttons_are_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
