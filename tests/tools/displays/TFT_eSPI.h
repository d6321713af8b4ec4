/* A stand-in of TFT_eSPI: without setSwapBytes(true) it sends memory as it is. */
#pragma once
#include "Arduino.h"

class TFT_eSPI
{
  public:
    void init()
    {
    }
    void setRotation(uint8_t)
    {
    }
    void setSwapBytes(bool swap)
    {
        swap_ = swap;
    }
    void pushImage(int32_t x, int32_t y, int32_t width, int32_t height, uint16_t *pixels)
    {
        stand_in_take(uint32_t(x), uint32_t(y), uint32_t(width), uint32_t(height), pixels, swap_);
    }

  private:
    bool swap_ = false;
};
