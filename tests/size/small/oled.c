/* The 128x64 OLED (SSD0323) of a Stellaris kit: 16 greys, two pixels a byte. */
#include "small_panel.h"

#include "torus.h"

#define REG32(address) (*(volatile uint32_t *)(address))
#define SSI_CR0        REG32(0x40008000)
#define SSI_CR1        REG32(0x40008004)
#define SSI_DR         REG32(0x40008008)
#define SSI_SR         REG32(0x4000800C)
#define SSI_CPSR       REG32(0x40008010)
#define RCGC1          REG32(0x400FE104)
#define RCGC2          REG32(0x400FE108)

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

void panel_open(void)
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

void panel_frame(void)
{
}

void panel_end(void)
{
}

void panel_put(const uint16_t *pixels, uint32_t n)
{
    for (uint32_t i = 0; i < n; i += 2) {
        const uint8_t both = (uint8_t)(torus_grey(pixels[i]) << 4 | torus_grey(pixels[i + 1]));
        send(1, &both, 1);
    }
}
