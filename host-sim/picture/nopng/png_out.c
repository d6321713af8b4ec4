/* See png_out.h. PNG without a library, not compressed. Sources: PNG (ISO/IEC 15948), RFC 1950 (zlib), RFC 1951
 * (deflate: stored blocks). */
#include "png_out.h"

#include "crc32.h"

#include <stdlib.h>
#include <string.h>

#define STORED_MAX 65535u /* bytes of a stored block */

struct out {
    uint8_t *at;
    uint32_t adler_a, adler_b; /* of the zlib stream so far */
};

static void put_u32(struct out *out, uint32_t v)
{
    for (int shift = 24; shift >= 0; shift -= 8) {
        *out->at++ = (uint8_t)(v >> shift);
    }
}

/* Puts length and name of a chunk; returns the place of the name, where its CRC begins. */
static uint8_t *begin_chunk(struct out *out, size_t length, const char *name)
{
    put_u32(out, (uint32_t)length);
    uint8_t *const start = out->at;
    memcpy(out->at, name, 4);
    out->at += 4;
    return start;
}

static void end_chunk(struct out *out, const uint8_t *start)
{
    put_u32(out, crc32_update(0, start, (size_t)(out->at - start)));
}

/* Puts one byte of the picture; each stored block of deflate (65535 bytes) begins with a header. */
static void store(struct out *out, uint8_t byte, size_t index, size_t total)
{
    if (index % STORED_MAX == 0) {
        const size_t left = total - index;
        const uint32_t n = left < STORED_MAX ? (uint32_t)left : STORED_MAX;
        const uint8_t head[] = {left <= STORED_MAX, (uint8_t)n, (uint8_t)(n >> 8), (uint8_t)~n, (uint8_t)(~n >> 8)};
        memcpy(out->at, head, sizeof head);
        out->at += sizeof head;
    }
    *out->at++ = byte;
    out->adler_a = (out->adler_a + byte) % 65521;
    out->adler_b = (out->adler_b + out->adler_a) % 65521;
}

static void put_rows(struct out *out, const struct ppm *picture)
{
    const size_t stride = (size_t)picture->width * 3, total = (stride + 1) * picture->height;
    *out->at++ = 0x78; /* zlib: deflate, 32 KB window, no dictionary */
    *out->at++ = 0x01;
    for (size_t i = 0; i < total; i++) { /* each row begins with its filter: none */
        const size_t row = i / (stride + 1), column = i % (stride + 1);
        store(out, column == 0 ? 0 : picture->rgb[row * stride + column - 1], i, total);
    }
    put_u32(out, out->adler_b << 16 | out->adler_a);
}

uint8_t *png_out_bytes(const struct ppm *picture, size_t *length)
{
    static const uint8_t magic[8] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'}, rgb8[5] = {8, 2, 0, 0, 0};
    const size_t total = ((size_t)picture->width * 3 + 1) * picture->height;
    const size_t data = 2 + total + (total + STORED_MAX - 1) / STORED_MAX * 5 + 4;
    *length = sizeof magic + 12 + 13 + 12 + data + 12;
    uint8_t *const bytes = malloc(*length);
    if (bytes == NULL) {
        return NULL;
    }
    struct out out = {bytes + sizeof magic, 1, 0};
    memcpy(bytes, magic, sizeof magic);
    const uint8_t *start = begin_chunk(&out, 13, "IHDR");
    put_u32(&out, picture->width);
    put_u32(&out, picture->height);
    memcpy(out.at, rgb8, sizeof rgb8);
    out.at += sizeof rgb8;
    end_chunk(&out, start);
    start = begin_chunk(&out, data, "IDAT");
    put_rows(&out, picture);
    end_chunk(&out, start);
    start = begin_chunk(&out, 0, "IEND");
    end_chunk(&out, start);
    return bytes;
}
