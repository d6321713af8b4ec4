// Pinhole on a display of TFT_eSPI (or any library with pushImage), by ph_show.
#include <Pinhole.h>
#include <TFT_eSPI.h>
#include "triangle.h"

TFT_eSPI tft;
struct ph_renderer renderer;
int status; // 0, or what went wrong: status.h of the library

static int flush(void *, uint32_t x, uint32_t y, uint32_t width, uint32_t height, const void *pixels)
{
    tft.pushImage(x, y, width, height, (uint16_t *)pixels);
    return 0;
}

void setup()
{
    Serial.begin(115200);
    tft.init();
    tft.setRotation(1);
    tft.setSwapBytes(false); // the pixels come in the order of the wire
    status = triangle_init(&renderer, PH_PIXELS_WIRE);
}

void loop()
{
    static uint32_t frame;
    if (status != 0) {
        Serial.println(status);
        delay(1000);
        return;
    }
    status = triangle_draw(&renderer, frame++);
    if (status == 0) {
        status = ph_show(&renderer, flush, NULL);
    }
}
