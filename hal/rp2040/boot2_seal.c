/*
 * boot2_seal: reads boot2 (256 bytes) on stdin and writes it on stdout with its checksum in the last four bytes. It
 * runs on the machine that builds.
 *
 * The checksum is that of the ROM (RP2040 datasheet 2.8.1.3.1): CRC-32 with polynomial 04C11DB7h, starts at FFFFFFFFh,
 * highest bit first, not inverted, stored little-endian.
 */
#include <stdint.h>
#include <stdio.h>

#define CODE_BYTES 252

static uint32_t checksum(const uint8_t *bytes, uint32_t n)
{
    uint32_t crc = 0xffffffff;
    for (uint32_t i = 0; i < n; i++) {
        crc ^= (uint32_t)bytes[i] << 24;
        for (int bit = 0; bit < 8; bit++) {
            crc = crc << 1 ^ (crc >> 31 != 0 ? 0x04c11db7 : 0);
        }
    }
    return crc;
}

int main(void)
{
    uint8_t boot2[CODE_BYTES + 4 + 1];
    const size_t n = fread(boot2, 1, sizeof boot2, stdin);
    if (n != CODE_BYTES + 4) {
        fprintf(stderr, "boot2_seal: boot2 must be %d bytes with its checksum\n", CODE_BYTES + 4);
        return 1;
    }
    const uint32_t crc = checksum(boot2, CODE_BYTES);
    for (int i = 0; i < 4; i++) {
        boot2[CODE_BYTES + i] = (uint8_t)(crc >> 8 * i);
    }
    return fwrite(boot2, 1, CODE_BYTES + 4, stdout) == CODE_BYTES + 4 && fflush(stdout) == 0 ? 0 : 1;
}
