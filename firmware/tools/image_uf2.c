/*
 * Usage: image-uf2 FAMILY ADDRESS IMAGE.bin IMAGE.uf2
 * Packs a flash image into UF2 blocks (https://github.com/microsoft/uf2). A block has 512 bytes, 256 of them payload,
 * and the chip's family number. This program runs on the computer that builds the image.
 *
 * A file for an RP2350 begins with one block more, as picotool writes it: the boot loader of revision A2 sets up the
 * flash only when it writes a block of the family "absolute" (erratum RP2350-E10). Without that it refuses a file that
 * is dropped on its drive if the flash has a partition table. Later revisions skip the block, because its extension tag
 * says so.
 */
#include <errno.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define PAYLOAD 256
#define BLOCK   512

#define RP2350_ARM_S    0xE48BFF59U
#define RP2350_RISCV    0xE48BFF5AU
#define RP2350_ABSOLUTE 0xE48BFF57U
#define FLASH_LAST_PAGE 0x10FFFF00U /* of the largest flash; a smaller one repeats in the address space */
#define TAG_IGNORE      0x9957E304U /* extension: 4 bytes in all, type 9957E3h */

static void put32(uint8_t *to, uint32_t value)
{
    for (int i = 0; i < 4; i++) {
        to[i] = (uint8_t)(value >> (8 * i));
    }
}

static void fill(uint8_t block[BLOCK], uint32_t number, uint32_t count, uint32_t address, uint32_t family)
{
    put32(block, 0x0A324655);
    put32(block + 4, 0x9E5D5157);
    put32(block + 8, 0x00002000); /* a family number is present */
    put32(block + 12, address);
    put32(block + 16, PAYLOAD);
    put32(block + 20, number);
    put32(block + 24, count);
    put32(block + 28, family);
    put32(block + BLOCK - 4, 0x0AB16F30);
}

/* The block against erratum E10. The boot loader takes it for the first of two, and so waits for the rest. */
static void fill_first(uint8_t block[BLOCK])
{
    memset(block + 32, 0xEF, PAYLOAD);
    fill(block, 0, 2, FLASH_LAST_PAGE, RP2350_ABSOLUTE);
    put32(block + 8, 0x0000A000); /* a family number and extension tags are present */
    put32(block + 32 + PAYLOAD, TAG_IGNORE);
}

static int pack(FILE *in, FILE *out, uint32_t family, uint32_t address)
{
    if (fseek(in, 0, SEEK_END) != 0) {
        return -1;
    }
    const long size = ftell(in);
    const uint32_t count = (uint32_t)((size + PAYLOAD - 1) / PAYLOAD);
    rewind(in);
    if (family == RP2350_ARM_S || family == RP2350_RISCV) {
        uint8_t block[BLOCK] = {0};
        fill_first(block);
        if (fwrite(block, BLOCK, 1, out) != 1) {
            return -1;
        }
    }
    for (uint32_t i = 0; i < count; i++) {
        uint8_t block[BLOCK] = {0};
        if (fread(block + 32, 1, PAYLOAD, in) == 0) {
            return -1;
        }
        fill(block, i, count, address + i * PAYLOAD, family);
        if (fwrite(block, BLOCK, 1, out) != 1) {
            return -1;
        }
    }
    return 0;
}

int main(int argc, char *argv[])
{
    if (argc != 5) {
        fprintf(stderr, "usage: image-uf2 FAMILY ADDRESS IMAGE.bin IMAGE.uf2\n");
        return 2;
    }
    FILE *in = fopen(argv[3], "rb"), *out = in != NULL ? fopen(argv[4], "wb") : NULL;
    int status =
        out != NULL ? pack(in, out, (uint32_t)strtoul(argv[1], NULL, 0), (uint32_t)strtoul(argv[2], NULL, 0)) : -1;
    if (out != NULL && fclose(out) != 0) {
        status = -1;
    }
    if (in != NULL) {
        fclose(in);
    }
    if (status != 0) {
        fprintf(stderr, "image-uf2: %s: %s\n", argv[out != NULL ? 4 : 3], strerror(errno));
        remove(argv[4]);
    }
    return status == 0 ? 0 : 1;
}
