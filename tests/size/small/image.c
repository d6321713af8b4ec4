/*
 * The image for 32 KB of flash and 4 KB of RAM, a Cortex-M0: it draws the torus on a panel (oled.c, or with HEIGHT 128
 * st7735s.c), and tells the CRC of each frame, the stack that was used, and the instructions of a frame by semihosting.
 */
#include "torus.h"

#include "small_panel.h"
#include "torus_crc.h"

#define REG32(address) (*(volatile uint32_t *)(address))
#define SYST_CSR       REG32(0xE000E010)
#define SYST_RVR       REG32(0xE000E014)
#define SYST_CVR       REG32(0xE000E018)

/* Vertices and a part share a room, which is counted in vertices. */
enum { PAINT = 0x57AC57AC, ROOM = VERTICES + (PH_PART_BYTES + PH_VERTEX_BYTES_32 - 1) / PH_VERTEX_BYTES_32 };

extern uint32_t bss_start[], bss_end[], stack_top[];

int main(void);
void start(void);

static _Alignas(8) uint16_t room[ROOM * PH_VERTEX_BYTES_32 / 2];
static uint16_t pixels[WIDTH * BAND], depth[WIDTH * BAND];
static struct ph_renderer r;

void semihost(int what, const void *argument)
{
    register int r0 __asm__("r0") = what;
    register const void *r1 __asm__("r1") = argument;
    __asm__ volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
}

void say_hex(uint32_t value, int digits)
{
    char text[9];
    for (int i = 0; i < digits; i++) {
        text[i] = "0123456789abcdef"[value >> (4 * (digits - 1 - i)) & 15];
    }
    text[digits] = '\0';
    semihost(SAY, text);
}

static void say(const char *name, uint32_t value)
{
    semihost(SAY, name);
    say_hex(value, 8);
    semihost(SAY, "\n");
}

static uint32_t stack_used(void)
{
    const uint32_t *at = bss_end;
    while (*at == PAINT) {
        at++;
    }
    return (uint32_t)((uintptr_t)stack_top - (uintptr_t)at);
}

int main(void)
{
    static const struct ph_config config = {.width = WIDTH,
                                            .height = HEIGHT,
                                            .band_height = BAND,
                                            .depth_format = PH_DEPTH_FIXED16,
                                            .vertices = room,
                                            .vertex_max = ROOM,
                                            .triangles = room,
                                            .depth = depth};
    int status = ph_renderer_init(&r, &config);
    panel_open();
    for (uint32_t frame = 0; frame < FRAMES && status == PH_OK; frame++) {
        uint32_t crc = UINT32_MAX, ticks = 0;
        SYST_RVR = 0xffffff;
        SYST_CVR = 0;
        SYST_CSR = 5;
        status = torus_draw(&r, frame);
        ticks += 0xffffff - SYST_CVR;
        const uint32_t bands = ph_frame_bands(&r);
        panel_frame();
        for (uint32_t band = 0; band < bands; band++) {
            SYST_CVR = 0;
            const uint32_t lines = ph_draw_band(&r, band, pixels);
            ticks += 0xffffff - SYST_CVR;
            crc = torus_crc(crc, (const uint8_t *)pixels, lines * WIDTH * 2);
            panel_put(pixels, lines * WIDTH);
        }
        panel_end();
        say("frame ", crc);
        say("ticks ", ticks);
    }
    say("stack ", stack_used());
    semihost(SAY, status == PH_OK ? "done\n" : "failed\n");
    for (;;) {
    }
}

void start(void) /* called as vector */
{
    uint32_t *at = bss_start;
    while (at < bss_end) {
        *at++ = 0;
    }
    while (at < (uint32_t *)__builtin_frame_address(0) - 8) {
        *at++ = PAINT;
    }
    main();
}

static void fault(void) /* called as vector */
{
    semihost(SAY, "fault\n");
    for (;;) {
    }
}

__attribute__((section(".vectors"), used)) static const struct {
    uint32_t *stack;
    void (*handlers[15])(void);
} vectors = {stack_top, {start, fault, fault}};
