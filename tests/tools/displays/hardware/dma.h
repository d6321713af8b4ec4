/* A stand-in of the pico-sdk's DMA: what is sent to the SPI behind RAMWR fills the window. */
#pragma once
#include "spi.h"

typedef struct {
    uint dreq, size;
} dma_channel_config;
enum { DMA_SIZE_8 };

static inline int dma_claim_unused_channel(bool required)
{
    return required ? 3 : -1;
}

static inline dma_channel_config dma_channel_get_default_config(uint channel)
{
    const dma_channel_config config = {channel == 3 ? 63 : 0, 2};
    return config;
}

static inline void channel_config_set_transfer_data_size(dma_channel_config *config, uint size)
{
    config->size = size;
}

static inline void channel_config_set_dreq(dma_channel_config *config, uint dreq)
{
    config->dreq = dreq;
}

static inline void dma_channel_configure(uint channel, const dma_channel_config *config, volatile void *to,
                                         const volatile void *from, uint32_t count, bool start)
{
    const uint32_t x = stand_in_window[0][0], width = stand_in_window[0][1] - x + 1, y = stand_in_window[1][0],
                   height = stand_in_window[1][1] - y + 1;
    if (channel != 3 || config->dreq != 16 || config->size != DMA_SIZE_8 || to != &spi_get_hw(spi0)->dr || !start ||
        stand_in_command != 0x2c || !stand_in_pins[16] || stand_in_pins[17] || count != width * height * 2) {
        exit(2);
    }
    stand_in_take(x, y, width, height, (const void *)(uintptr_t)from, false);
}

static inline void dma_channel_wait_for_finish_blocking(uint channel)
{
    (void)channel;
}
