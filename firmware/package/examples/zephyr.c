/* Zephyr (4.3 and later): the triangle on the display that the devicetree chose (zephyr,display), by display_write. It
 * takes RGB565: in the wire's order as PIXEL_FORMAT_RGB_565X, in that of the machine as PIXEL_FORMAT_RGB_565. */
#include "triangle.h"

#include <zephyr/device.h>
#include <zephyr/drivers/display.h>

static int flush(void *context, uint32_t x, uint32_t y, uint32_t width, uint32_t height, const void *pixels)
{
    const struct display_buffer_descriptor buffer = {
        .buf_size = width * height * 2, .width = (uint16_t)width, .height = (uint16_t)height, .pitch = (uint16_t)width};
    return display_write(context, (uint16_t)x, (uint16_t)y, &buffer, pixels);
}

int main(void)
{
    static struct ph_renderer r;
    const struct device *const display = DEVICE_DT_GET(DT_CHOSEN(zephyr_display));
    struct display_capabilities can;
    if (!device_is_ready(display)) {
        return -1;
    }
    display_get_capabilities(display, &can);
    const bool native = can.current_pixel_format == PIXEL_FORMAT_RGB_565;
    int status = can.x_resolution < WIDTH || can.y_resolution < HEIGHT ? PH_ERR_RANGE : 0;
    status = status != 0 ? status : triangle_init(&r, native ? PH_PIXELS_NATIVE : PH_PIXELS_WIRE);
    status = status != 0 ? status : display_blanking_off(display);
    for (uint32_t frame = 0; status == 0; frame++) {
        status = triangle_draw(&r, frame);
        status = status != 0 ? status : ph_show(&r, flush, (void *)display);
    }
    return status;
}
