/* See emulate.h. Source: System V Application Binary Interface, chapters 4 and 5 (ELF). */
#define _XOPEN_SOURCE 700

#include "emulate.h"

#include "complain.h"

#include <errno.h>
#include <string.h>
#include <sys/stat.h>

enum { HEADER_BYTES = 52, SEGMENT_BYTES = 32, TYPE_EXECUTABLE = 2, CPU_ARM = 40, SEGMENT_LOAD = 1 };

static uint32_t get(const uint8_t *bytes, int n)
{
    uint32_t value = 0;
    for (int i = n - 1; i >= 0; i--) {
        value = value << 8 | bytes[i];
    }
    return value;
}

static bool read_at(FILE *in, uint64_t at, uint8_t *bytes, size_t n)
{
    return fseeko(in, (off_t)at, SEEK_SET) == 0 && fread(bytes, 1, n, in) == n;
}

/* Checks that all segments are in the file and that one of them begins where the chip starts. */
static int check_segments(const char *path, FILE *in, uint64_t size, const uint8_t *header, uint32_t flash)
{
    const uint64_t table = get(header + 28, 4);
    const uint32_t count = get(header + 44, 2);
    uint8_t segment[SEGMENT_BYTES];
    bool starts = false;
    for (uint32_t i = 0; i < count; i++) {
        const bool read = read_at(in, table + (uint64_t)i * SEGMENT_BYTES, segment, sizeof segment);
        if (!read || (uint64_t)get(segment + 4, 4) + get(segment + 16, 4) > size) {
            return complain("%s: only a part of an image; make it again", path);
        }
        const bool loaded = get(segment, 4) == SEGMENT_LOAD && get(segment + 16, 4) > 0;
        starts = starts || (loaded && get(segment + 12, 4) == flash);
    }
    return starts ? 0 : complain("%s: an image for another chip: this one's flash is at %08X", path, (unsigned)flash);
}

static int check(const char *path, FILE *in, uint64_t size, uint32_t flash)
{
    static const uint8_t magic[] = {0x7F, 'E', 'L', 'F', 1, 1}; /* 32 bits, little-endian */
    uint8_t header[HEADER_BYTES];
    if (!read_at(in, 0, header, sizeof header) || memcmp(header, magic, sizeof magic) != 0 ||
        get(header + 16, 2) != TYPE_EXECUTABLE || get(header + 18, 2) != CPU_ARM ||
        get(header + 42, 2) != SEGMENT_BYTES) {
        return complain("%s: not the ELF of an Arm image; make firmware makes it", path);
    }
    return check_segments(path, in, size, header, flash);
}

int emulate_image_check(const char *path, uint32_t flash)
{
    struct stat file;
    if (stat(path, &file) == 0 && !S_ISREG(file.st_mode)) {
        return complain("%s: not a file; make firmware makes one", path);
    }
    FILE *in = fopen(path, "rb");
    if (in == NULL) {
        return complain("'%s': cannot be read: %s", path, strerror(errno));
    }
    const int status = check(path, in, (uint64_t)file.st_size, flash);
    fclose(in);
    return status;
}
