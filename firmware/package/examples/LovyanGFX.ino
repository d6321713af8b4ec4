// Arduino: the triangle on a display of LovyanGFX, by ph_show. LGFX_AUTODETECT.hpp finds the display of a known board.
#include <LovyanGFX.hpp>
#include <LGFX_AUTODETECT.hpp>
#include <Pinhole.h>
#include "triangle.h"

static LGFX display;
static struct ph_renderer renderer;
static int status; // 0, or what went wrong: status.h of the library

static int flush(void *, uint32_t x, uint32_t y, uint32_t width, uint32_t height, const void *pixels)
{
    display.pushImage(x, y, width, height, (const lgfx::swap565_t *)pixels); // in the order of the wire
    return 0;
}

void setup()
{
    Serial.begin(115200);
    display.init();
    display.setRotation(1);
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
    display.startWrite();
    status = triangle_draw(&renderer, frame++);
    if (status == 0) {
        status = ph_show(&renderer, flush, NULL);
    }
    display.endWrite();
}
