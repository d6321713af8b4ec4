/* A stand-in of LovyanGFX: the type of the pixels says their order. */
#pragma once
#include "Arduino.h"

namespace lgfx
{
struct swap565_t {
    uint8_t bytes[2];
};
} // namespace lgfx

class LGFX
{
  public:
    bool init()
    {
        return true;
    }
    void setRotation(uint8_t)
    {
    }
    void startWrite()
    {
    }
    void endWrite()
    {
    }
    void pushImage(int32_t x, int32_t y, int32_t width, int32_t height, const lgfx::swap565_t *pixels)
    {
        stand_in_take(uint32_t(x), uint32_t(y), uint32_t(width), uint32_t(height), pixels, false);
    }
};
