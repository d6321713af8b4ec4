/*
 * Changed ELF files into the check of pinhole-emulate: what is taken has all of its segments in the file, and one at
 * the flash; all else is refused by one line.
 *
 *   fuzz_elf [quick | long | INPUTS [SEED]]
 */
#include "emulate.h"
#include "fuzz.h"

#include <string.h>

enum { HEADER = 52, SEGMENT = 32, SEGMENTS = 3, BYTES = 600, ROOM = 1024 };

#define FLASH 0x08000000u

static void put(uint8_t *at, uint32_t value, int n)
{
    for (int i = 0; i < n; i++) {
        at[i] = (uint8_t)(value >> 8 * i);
    }
}

static uint32_t get(const uint8_t *at, int n)
{
    uint32_t value = 0;
    for (int i = 0; i < n; i++) {
        value |= (uint32_t)at[i] << 8 * i;
    }
    return value;
}

static void make_right(uint8_t *bytes)
{
    static const uint8_t magic[] = {0x7f, 'E', 'L', 'F', 1, 1, 1};
    memset(bytes, 0, BYTES);
    memcpy(bytes, magic, sizeof magic);
    put(bytes + 16, 2, 2);  /* an executable */
    put(bytes + 18, 40, 2); /* Arm */
    put(bytes + 28, HEADER, 4);
    put(bytes + 42, SEGMENT, 2);
    put(bytes + 44, SEGMENTS, 2);
    for (uint32_t i = 0; i < SEGMENTS; i++) {
        uint8_t *const segment = bytes + HEADER + SEGMENT * i;
        put(segment, 1, 4);
        put(segment + 4, 148 + 150 * i, 4);
        put(segment + 12, FLASH + 150 * i, 4);
        put(segment + 16, 150, 4);
    }
}

/* Said by other means than the reader's: all of the file is at hand. */
static bool is_whole(const uint8_t *bytes, size_t n)
{
    bool starts = false;
    if (n < HEADER) {
        return false;
    }
    const uint32_t table = get(bytes + 28, 4), count = get(bytes + 44, 2);
    for (uint64_t i = 0; i < count; i++) {
        if (table + (i + 1) * SEGMENT > n) {
            return false;
        }
        const uint8_t *const segment = bytes + table + i * SEGMENT;
        const uint32_t at = get(segment + 4, 4), size = get(segment + 16, 4);
        if (at > n || size > n - at) {
            return false;
        }
        starts |= get(segment, 4) == 1 && size > 0 && get(segment + 12, 4) == FLASH;
    }
    return starts && get(bytes, 4) == 0x464c457f;
}

static bool one(void)
{
    uint8_t bytes[ROOM];
    make_right(bytes);
    size_t n = BYTES;
    if (fuzz_below(2) != 0) { /* where the numbers are */
        put(bytes + fuzz_below(HEADER + SEGMENT * SEGMENTS), fuzz_number(), 1 + (int)fuzz_below(4));
    } else {
        n = fuzz_change(bytes, n, ROOM);
    }
    const bool is_taken = emulate_image_check(fuzz_file(bytes, n), FLASH) == 0;
    fuzz_said(is_taken);
    if (is_taken && !is_whole(bytes, n)) {
        fuzz_fail("a part of an image was taken");
    }
    return is_taken;
}

int main(int argc, char **argv)
{
    return fuzz_main(&(struct fuzz){"fuzz_elf", 40000, 2000000, one}, argc, argv);
}
