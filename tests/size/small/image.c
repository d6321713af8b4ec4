/*
 * The image for 32 KB of flash and 4 KB of RAM, a Cortex-M0: it draws the torus on the 128x64 OLED (SSD0323) of a
 * Stellaris kit, and tells the CRC of each frame, the stack that was used, and the instructions of a frame by
 * semihosting. With HEIGHT 128 it draws for an ST7735S, and tells CRCs only.
 */
#include "torus.h"

#include "torus_crc.h"

#define REG32(address) (*(volatile uint32_t *)(address))
#define SSI_CR0        REG32(0x40008000)
#define SSI_CR1        REG32(0x40008004)
#define SSI_DR         REG32(0x40008008)
#define SSI_SR         REG32(0x4000800C)
#define SSI_CPSR       REG32(0x40008010)
#define RCGC1          REG32(0x400FE104)
#define RCGC2          REG32(0x400FE108)
#define SYST_CSR       REG32(0xE000E010)
#define SYST_RVR       REG32(0xE000E014)
#define SYST_CVR       REG32(0xE000E018)

enum { PAINT = 0x57AC57AC, PARTS_BYTES = 96 }; /* a whole number of PH_TRIANGLE_BYTES_32, PH_PART_BYTES or more */

extern uint32_t bss_start[], bss_end[], stack_top[];

int main(void);
void start(void);

static uint64_t vertices[(VERTICES * PH_VERTEX_BYTES_32 + 7) / 8], parts[PARTS_BYTES / 8];
static uint16_t pixels[WIDTH * BAND], depth[WIDTH * BAND];
static struct ph_renderer r;

static void call(int what, const void *argument)
{
    register int r0 __asm__("r0") = what;
    register const void *r1 __asm__("r1") = argument;
    __asm__ volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
}

static void say(const char *name, uint32_t value)
{
    char text[10];
    for (int i = 0; i < 8; i++) {
        text[i] = "0123456789abcdef"[value >> (28 - 4 * i) & 15];
    }
    text[8] = '\n';
    text[9] = '\0';
    call(4, name);
    call(4, text);
}

/* QEMU's SSI stops when what came in is not read. */
static void send(uint32_t is_data, const uint8_t *bytes, uint32_t n)
{
    while ((SSI_SR & 16) != 0) {
    }
    REG32(0x40006000 + (0x80 << 2)) = is_data ? 0x80 : 0; /* D/C: PC7 */
    for (uint32_t i = 0; i < n; i++) {
        SSI_DR = bytes[i];
        while ((SSI_SR & 4) == 0) {
        }
        (void)SSI_DR;
    }
}

static void open_panel(void)
{
    static const uint8_t set_up[] = {0x15, 0, 63, 0x75, 0, 63, 0xa0, 0x52, 0xaf};
    RCGC1 |= 0x10;
    RCGC2 |= 0x0d;
    REG32(0x40007400) |= 1; /* PD0: the card on the same bus is off */
    REG32(0x40007000 + (1 << 2)) = 1;
    REG32(0x40006400) |= 0x80;
    SSI_CPSR = 14;
    SSI_CR0 = 7;
    SSI_CR1 = 2;
    send(0, set_up, sizeof set_up);
}

/* Sends a band to the panel, two pixels a byte. */
static void show(uint32_t lines)
{
    for (uint32_t i = 0; i < lines * WIDTH; i += 2) {
        const uint8_t both = (uint8_t)(torus_grey(pixels[i]) << 4 | torus_grey(pixels[i + 1]));
        send(1, &both, 1);
    }
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
                                            .vertices = vertices,
                                            .vertex_max = VERTICES,
                                            .triangles = parts,
                                            .triangle_max = PARTS_BYTES / PH_TRIANGLE_BYTES_32,
                                            .depth = depth};
    int status = ph_renderer_init(&r, &config);
    if (HEIGHT == 64) {
        open_panel();
    }
    for (uint32_t frame = 0; frame < FRAMES && status == PH_OK; frame++) {
        uint32_t crc = UINT32_MAX, ticks = 0;
        SYST_RVR = 0xffffff;
        SYST_CVR = 0;
        SYST_CSR = 5;
        status = torus_draw(&r, frame);
        ticks += 0xffffff - SYST_CVR;
        const uint32_t bands = ph_frame_bands(&r);
        for (uint32_t band = 0; band < bands; band++) {
            SYST_CVR = 0;
            const uint32_t lines = ph_draw_band(&r, band, pixels);
            ticks += 0xffffff - SYST_CVR;
            crc = torus_crc(crc, (const uint8_t *)pixels, lines * WIDTH * 2);
            if (HEIGHT == 64) {
                show(lines);
            }
        }
        say("frame ", crc);
        say("ticks ", ticks);
    }
    say("stack ", stack_used());
    call(4, status == PH_OK ? "done\n" : "failed\n");
    for (;;) {
    }
}

void start(void)
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

static void fault(void)
{
    call(4, "fault\n");
    for (;;) {
    }
}

__attribute__((section(".vectors"), used)) static const struct {
    uint32_t *stack;
    void (*handlers[15])(void);
} vectors = {stack_top, {start, fault, fault}};
