/* A stand-in of Arduino_GFX. */
#pragma once
#include "Arduino.h"

enum { GFX_NOT_DEFINED = -1 };

class Arduino_DataBus
{
};

class Arduino_ESP32SPI : public Arduino_DataBus
{
  public:
    Arduino_ESP32SPI(int8_t, int8_t, int8_t, int8_t, int8_t)
    {
    }
};

class Arduino_GFX
{
  public:
    bool begin()
    {
        return true;
    }
    void draw16bitBeRGBBitmap(int16_t x, int16_t y, uint16_t *pixels, int16_t width, int16_t height)
    {
        stand_in_take(uint32_t(x), uint32_t(y), uint32_t(width), uint32_t(height), pixels, false);
    }
};

class Arduino_ILI9341 : public Arduino_GFX
{
  public:
    Arduino_ILI9341(Arduino_DataBus *, int8_t, uint8_t)
    {
    }
};
