/* See record.h. Words that follow each other without a pause make one transfer. */
#include "record.h"

#include <inttypes.h>

#define TRANSFER_BYTES 4096
#define WAITING_MOST   16

static struct {
    FILE *to;
    const struct chip *chip;
    uint32_t levels_at_start;                      /* of the word on its way */
    uint32_t waiting[WAITING_MOST], waiting_count; /* levels that changed during it */
    bool open;
    uint64_t start, end;
    double hz;
    uint32_t mode, levels, levels_at_end, bytes;
    uint8_t byte[TRANSFER_BYTES];
} record;

static uint64_t ns(uint64_t time)
{
    return (time + FS_PER_NS / 2) / FS_PER_NS;
}

void record_open(FILE *to, const struct chip *chip)
{
    record.to = to;
    record.chip = chip;
}

void record_name(uint32_t pin, const char *name)
{
    fprintf(record.to, "0 name %u %s\n", pin, name);
}

static void flush(void)
{
    if (!record.open) {
        return;
    }
    fprintf(record.to, "%" PRIu64 " spi - %.0f %.0f %x 8 %x %x %" PRIu64 " ", ns(record.start), record.hz, record.hz,
            record.mode, record.levels, record.levels_at_end, ns(record.end));
    for (uint32_t i = 0; i < record.bytes; i++) {
        static const char digits[] = "0123456789abcdef";
        putc(digits[record.byte[i] >> 4], record.to);
        putc(digits[record.byte[i] & 15], record.to);
    }
    putc('\n', record.to);
    record.open = false;
}

static void put_levels(uint64_t time, uint32_t levels)
{
    fprintf(record.to, "%" PRIu64 " level %x\n", ns(time), levels);
}

void record_levels(void)
{
    const struct chip *chip = record.chip;
    if ((chip->spi[0].busy || chip->spi[1].busy) && record.waiting_count < WAITING_MOST) {
        record.waiting[record.waiting_count++] = chip->levels;
        return;
    }
    flush();
    put_levels(chip->now, chip->levels);
}

void record_word_start(void)
{
    record.levels_at_start = record.chip->levels;
}

static void put_waiting(uint64_t time)
{
    flush();
    for (uint32_t i = 0; i < record.waiting_count; i++) {
        put_levels(time, record.waiting[i]);
    }
    record.waiting_count = 0;
}

void record_word(const struct spi *spi, uint32_t bits)
{
    if (record.open && (record.hz != spi->hz || record.end != spi->start || record.bytes + 2 > TRANSFER_BYTES)) {
        flush();
    }
    if (!record.open) {
        record.open = true;
        record.start = spi->start;
        record.hz = spi->hz;
        record.mode = (spi->cr0 >> 6 & 1) * 2 + (spi->cr0 >> 7 & 1);
        record.levels = record.levels_at_start;
        record.bytes = 0;
    }
    if (bits == 16) {
        record.byte[record.bytes++] = (uint8_t)(spi->word >> 8);
    }
    record.byte[record.bytes++] = (uint8_t)spi->word;
    record.end = spi->end;
    record.levels_at_end = record.chip->levels;
    if (record.waiting_count > 0) {
        put_waiting(spi->end);
    }
}

void record_note(const char *text)
{
    flush();
    fprintf(record.to, "%" PRIu64 " note %s\n", ns(record.chip->now), text);
}

bool record_close(void)
{
    put_waiting(record.chip->now);
    return fflush(record.to) == 0 && ferror(record.to) == 0;
}
