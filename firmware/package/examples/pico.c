/* pico-sdk: the triangle on an ST7789 on SPI 0 of a Pico (Pico Display Pack 2.0: 320x240), sent by DMA from the pixels
 * of a band. CMakeLists.txt: find_package(Pinhole) and target_link_libraries(.. Pinhole::pinhole hardware_spi
 * hardware_dma). */
#include "triangle.h"

#include <hardware/dma.h>
#include <hardware/gpio.h>
#include <hardware/spi.h>
#include <pico/stdlib.h>

enum { DC = 16, CS = 17, SCK = 18, MOSI = 19, BACKLIGHT = 20, BUS_HZ = 62500000 };

static int channel; /* of the DMA */

static void command(uint8_t code, const uint8_t *parameters, size_t n)
{
    gpio_put(DC, false);
    gpio_put(CS, false);
    spi_write_blocking(spi0, &code, 1);
    gpio_put(DC, true);
    spi_write_blocking(spi0, parameters, n);
}

static void start_display(void)
{
    static const uint8_t format = 0x55, across = 0x70; /* 16 bits a pixel; rows along the long side */
    static const uint8_t pins[] = {DC, CS, BACKLIGHT};
    spi_init(spi0, BUS_HZ);
    gpio_set_function(SCK, GPIO_FUNC_SPI);
    gpio_set_function(MOSI, GPIO_FUNC_SPI);
    for (int i = 0; i < 3; i++) {
        gpio_init(pins[i]);
        gpio_set_dir(pins[i], true);
    }
    command(0x11, NULL, 0); /* sleep out */
    sleep_ms(120);
    command(0x3a, &format, 1);
    command(0x36, &across, 1);
    command(0x21, NULL, 0); /* inversion: this glass shows colours with it */
    command(0x29, NULL, 0);
    gpio_put(BACKLIGHT, true);
    channel = dma_claim_unused_channel(true);
}

static int flush(void *context, uint32_t x, uint32_t y, uint32_t width, uint32_t height, const void *pixels)
{
    const uint32_t right = x + width - 1, bottom = y + height - 1;
    const uint8_t columns[] = {(uint8_t)(x >> 8), (uint8_t)x, (uint8_t)(right >> 8), (uint8_t)right};
    const uint8_t rows[] = {(uint8_t)(y >> 8), (uint8_t)y, (uint8_t)(bottom >> 8), (uint8_t)bottom};
    dma_channel_config dma = dma_channel_get_default_config((uint)channel);
    (void)context;
    channel_config_set_transfer_data_size(&dma, DMA_SIZE_8);
    channel_config_set_dreq(&dma, spi_get_dreq(spi0, true));
    command(0x2a, columns, 4);
    command(0x2b, rows, 4);
    command(0x2c, NULL, 0);
    dma_channel_configure((uint)channel, &dma, &spi_get_hw(spi0)->dr, pixels, width * height * 2, true);
    dma_channel_wait_for_finish_blocking((uint)channel);
    while (spi_is_busy(spi0)) {
    }
    return 0;
}

int main(void)
{
    static struct ph_renderer r;
    start_display();
    int status = triangle_init(&r, PH_PIXELS_WIRE);
    for (uint32_t frame = 0; status == 0; frame++) {
        status = triangle_draw(&r, frame);
        status = status != 0 ? status : ph_show(&r, flush, NULL);
    }
    return status;
}
