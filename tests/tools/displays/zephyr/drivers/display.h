/* A stand-in of Zephyr's display API (4.3): a display of RGB565 in the wire's order, or with -DNATIVE in the machine's.
 */
#pragma once
#include <zephyr/device.h>

enum { PIXEL_FORMAT_RGB_565 = 1 << 4, PIXEL_FORMAT_RGB_565X = 1 << 5 };

#ifdef NATIVE
#define STAND_IN_FORMAT PIXEL_FORMAT_RGB_565
#else
#define STAND_IN_FORMAT PIXEL_FORMAT_RGB_565X
#endif

struct display_buffer_descriptor {
    uint32_t buf_size;
    uint16_t width, height, pitch;
    bool frame_incomplete;
};

struct display_capabilities {
    uint16_t x_resolution, y_resolution;
    uint32_t supported_pixel_formats, screen_info;
    uint32_t current_pixel_format;
};

static inline void display_get_capabilities(const struct device *device, struct display_capabilities *can)
{
    (void)device;
    can->x_resolution = 320;
    can->y_resolution = 240;
    can->current_pixel_format = STAND_IN_FORMAT;
}

static inline int display_blanking_off(const struct device *device)
{
    (void)device;
    return 0;
}

static inline int display_write(const struct device *device, uint16_t x, uint16_t y,
                                const struct display_buffer_descriptor *buffer, const void *pixels)
{
    return device_is_ready(device) && buffer->pitch == buffer->width &&
                   buffer->buf_size == 2u * buffer->width * buffer->height
               ? stand_in_take(x, y, buffer->width, buffer->height, pixels, STAND_IN_FORMAT == PIXEL_FORMAT_RGB_565)
               : -22;
}
