/* See panel_picture.h. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "panel_picture.h"

#include "blue_noise.h"

#include <math.h>
#include <string.h>

static uint16_t wire_order(uint16_t value)
{
    uint8_t bytes[2] = {(uint8_t)(value >> 8), (uint8_t)value};
    uint16_t stored;
    memcpy(&stored, bytes, sizeof stored);
    return stored;
}

static unsigned from_wire(uint16_t stored)
{
    uint8_t bytes[2];
    memcpy(bytes, &stored, sizeof bytes);
    return bytes[0] * 256U + bytes[1];
}

void picture_fill(uint16_t *pixels, uint32_t width, uint32_t height, uint32_t seed)
{
    static const uint16_t marks[] = {0x0000, 0xFFFF, 0xF800, 0x07E0, 0x001F};
    uint32_t state = seed * 2654435761U + 1;
    for (uint32_t i = 0; i < width * height; i++) {
        state = state * 1664525U + 1013904223U;
        pixels[i] = wire_order(i < 5 ? marks[i] : (uint16_t)(state >> 16));
    }
}

/* The greatest integer not above `value` of `steps` steps stretched to 0 .. 255 by the bits' repetition. */
static uint8_t stretch(unsigned value, unsigned bits)
{
    switch (bits) {
    case 4:
        return (uint8_t)(value * 17);
    case 5:
        return (uint8_t)floor(value * 8.25);
    default:
        return (uint8_t)floor(value * 4.0625);
    }
}

/* Bayer's matrix by its definition: the bits of x ^ y and y, interleaved, lowest first. */
static double threshold(uint32_t x, uint32_t y)
{
    unsigned rank = ((x ^ y) & 1) * 8 + (y & 1) * 4 + ((x ^ y) >> 1 & 1) * 2 + (y >> 1 & 1);
    return (rank + 0.5) / 16;
}

static void expect_pixel(unsigned value, unsigned format, uint32_t x, uint32_t y, uint8_t rgb[3])
{
    unsigned r = value / 2048;
    unsigned g = value / 32 % 64;
    unsigned b = value % 32;
    if (format == PANEL_RGB444) {
        rgb[0] = stretch(r / 2, 4);
        rgb[1] = stretch(g / 4, 4);
        rgb[2] = stretch(b / 2, 4);
    } else if (format == PANEL_RGB666) {
        rgb[0] = stretch((unsigned)floor(r * 33 / 16.0), 6);
        rgb[1] = stretch(g, 6);
        rgb[2] = stretch((unsigned)floor(b * 33 / 16.0), 6);
    } else {
        rgb[0] = stretch(r, 5);
        rgb[1] = stretch(g, 6);
        rgb[2] = stretch(b, 5);
    }
    const double luma = floor((77.0 * rgb[0] + 150.0 * rgb[1] + 29.0 * rgb[2]) / 256);
    if (format == PANEL_MONO_DITHER || format == PANEL_MONO_THRESHOLD) {
        const double share = format == PANEL_MONO_DITHER ? pow(luma / 255, 2) : luma / 255;
        const double least = format == PANEL_MONO_DITHER ? (blue_noise_rank(x, y) + 0.5) / 64 : 0.5;
        memset(rgb, share > least ? 255 : 0, 3);
    }
    if (format == PANEL_GREY4) {
        double level = luma * 15 / 255;
        double up = level - floor(level) > threshold(x, y) ? 1 : 0;
        rgb[0] = rgb[1] = rgb[2] = (uint8_t)((floor(level) + up) * 17);
    }
}

void picture_expect(const uint16_t *pixels, uint32_t width, uint32_t height, unsigned format, bool round, uint8_t *rgb)
{
    for (uint32_t y = 0; y < height; y++) {
        for (uint32_t x = 0; x < width; x++) {
            uint8_t *p = rgb + 3 * (y * width + x);
            memset(p, 0, 3);
            if (!round || hypot(x + 0.5 - width / 2.0, y + 0.5 - height / 2.0) <= width / 2.0) {
                expect_pixel(from_wire(pixels[y * width + x]), format, x, y, p);
            }
        }
    }
}

int picture_draw(struct panel_driver *d, const uint16_t *pixels, uint32_t lines)
{
    int status = panel_frame_begin(d);
    for (uint32_t y = 0; y < d->height && status >= 0; y += lines) {
        uint32_t n = d->height - y < lines ? d->height - y : lines;
        status = panel_rows(d, pixels + y * d->width, n);
    }
    return status < 0 ? status : panel_frame_end(d);
}

void picture_compare(const uint8_t *seen, const uint8_t *expected, uint32_t width, uint32_t height, const char *what)
{
    for (uint32_t i = 0; i < width * height; i++) {
        const uint8_t *s = seen + 3 * i;
        const uint8_t *e = expected + 3 * i;
        if (memcmp(s, e, 3) != 0) {
            fail_msg("%s: pixel (%u, %u) is %02x%02x%02x, should be %02x%02x%02x", what, i % width, i / width, s[0],
                     s[1], s[2], e[0], e[1], e[2]);
        }
    }
}

void picture_no_complaint(const struct sim *sim, const char *what)
{
    if (sim_complaint_count(sim) != 0) {
        fail_msg("%s: %u complaints, the first: %s", what, sim_complaint_count(sim), sim_complaint(sim, 0));
    }
}
