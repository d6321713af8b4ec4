/* crc32: the CRC-32 of zlib, PNG and Ethernet (reflected polynomial 0xEDB88320, initial and final value all ones). */
#ifndef CRC32_H
#define CRC32_H

#include <stddef.h>
#include <stdint.h>

/* CRC of n bytes that follow those with the CRC `crc`; start with 0. */
uint32_t crc32_update(uint32_t crc, const uint8_t *bytes, size_t n);

#endif
