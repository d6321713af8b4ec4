/* model_bytes: numbers in the bytes of a file. */
#ifndef MODEL_BYTES_H
#define MODEL_BYTES_H

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

/* Numbers of 2 and 4 bytes, the highest byte first or last. */
static inline uint32_t model_bytes_u16(const char *p, bool is_big)
{
    return (uint32_t)(uint8_t)p[is_big ? 1 : 0] | (uint32_t)(uint8_t)p[is_big ? 0 : 1] << 8;
}

static inline uint32_t model_bytes_u32(const char *p, bool is_big)
{
    return model_bytes_u16(p + (is_big ? 2 : 0), is_big) | model_bytes_u16(p + (is_big ? 0 : 2), is_big) << 16;
}

static inline float model_bytes_float(const char *p, bool is_big)
{
    const uint32_t bits = model_bytes_u32(p, is_big);
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static inline double model_bytes_double(const char *p, bool is_big)
{
    const uint64_t bits =
        model_bytes_u32(p + (is_big ? 4 : 0), is_big) | (uint64_t)model_bytes_u32(p + (is_big ? 0 : 4), is_big) << 32;
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

#endif
