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
    const uint32_t colour[3] = {red, green, blue};
    for (struct ph_ramp_walk at = ph_ramp_begin(specular); at.entry < PH_RAMP_SIZE; ph_ramp_next(&at)) {
        ramp[at.entry] = ph_ramp_colour(colour, at.intensity, PH_RAMP_NEAREST);
    }
}
