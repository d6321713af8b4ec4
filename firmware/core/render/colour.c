/* Colours: see render.h and colour.h. */
#include "render.h"

#include "colour.h"

static uint32_t quantise(uint32_t v, uint32_t top)
{
    return (v * top + 127) / 255;
}

uint16_t ph_rgb565(uint8_t red, uint8_t green, uint8_t blue)
{
    return ph_wire16((uint16_t)(quantise(red, 31) << 11 | quantise(green, 63) << 5 | quantise(blue, 31)));
}

void ph_material_ramp(uint16_t ramp[PH_RAMP_SIZE], uint8_t red, uint8_t green, uint8_t blue, fx_t specular)
{
    const uint32_t full = FX_ONE + (uint32_t)(specular < 0 ? 0 : specular > FX_ONE ? FX_ONE : specular);
    const uint32_t whole = (uint32_t)fx_quotient_u64(full, 119), part = full - 119 * whole;
    uint32_t intensity = 0, rest = 59; /* (full * step + 59) / 119, step = 0 .. 119, and what remains */
    for (uint32_t i = 0; i < PH_RAMP_SIZE; i++) {
        if (i > 4 && i <= 123) {
            rest += part;
            intensity += whole + (rest >= 119);
            rest -= rest >= 119 ? 119 : 0;
        }
        ramp[i] = ph_wire16((uint16_t)(ph_ramp_channel(red, intensity, 31, PH_RAMP_NEAREST) << 11 |
                                       ph_ramp_channel(green, intensity, 63, PH_RAMP_NEAREST) << 5 |
                                       ph_ramp_channel(blue, intensity, 31, PH_RAMP_NEAREST)));
    }
}
