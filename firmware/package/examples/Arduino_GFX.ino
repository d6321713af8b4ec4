// Arduino: the triangle on a display of Arduino_GFX, by ph_show. The pins are those of a "Cheap Yellow Display".
#include <Arduino_GFX_Library.h>
#include <Pinhole.h>
#include "triangle.h"

static Arduino_DataBus *bus = new Arduino_ESP32SPI(2 /* DC */, 15 /* CS */, 14 /* SCK */, 13 /* MOSI */, 12 /* MISO */);
static Arduino_GFX *display = new Arduino_ILI9341(bus, GFX_NOT_DEFINED /* RST */, 1 /* rotation */);
static struct ph_renderer renderer;
static int status; // 0, or what went wrong: status.h of the library

static int flush(void *, uint32_t x, uint32_t y, uint32_t width, uint32_t height, const void *pixels)
{
    display->draw16bitBeRGBBitmap(x, y, (uint16_t *)pixels, width, height); // in the order of the wire
    return 0;
}

void setup()
{
    Serial.begin(115200);
    status = display->begin() ? triangle_init(&renderer, PH_PIXELS_WIRE) : PH_ERR_STATE;
    pinMode(21, OUTPUT);
    digitalWrite(21, HIGH); // the backlight
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
