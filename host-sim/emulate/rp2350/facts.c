/* What the emulated RP2350 says of itself: its id (datasheet 12.15), why it was reset (6.4), the frequency counter
 * (8.1.6.2). */
#include "chip.h"

#include <stdlib.h>
#include <string.h>

#define ID_A2      0x20004927 /* revision 2 */
#define HAD_POR    (1U << 16)
#define RING_HZ    11e6
#define CRYSTAL_HZ 12e6

enum { REF_KHZ, MIN_KHZ, MAX_KHZ, DELAY, INTERVAL, SRC, STATUS, RESULT }; /* words of the counter */
enum { PASS = 1, DONE = 1 << 4, RUNNING = 1 << 8, SLOW = 1 << 20, FAST = 1 << 24, DIED = 1 << 28 };

void facts_init(struct chip *chip)
{
    chip->facts = (struct facts){.ring_hz = RING_HZ, .id = ID_A2, .reset = HAD_POR};
}

bool facts_set(struct chip *chip, const char *text)
{
    while (*text != '\0') {
        char *end = NULL;
        const char *const equals = strchr(text, '=');
        const uint32_t value = equals != NULL ? (uint32_t)strtoul(equals + 1, &end, 0) : 0;
        if (equals == NULL || (*end != ',' && *end != '\0')) {
            return false;
        }
        if (strncmp(text, "ring=", 5) == 0) {
            chip->facts.ring_hz = value;
        } else if (strncmp(text, "id=", 3) == 0) {
            chip->facts.id = value;
        } else if (strncmp(text, "reset=", 6) == 0) {
            chip->facts.reset = value;
        } else if (strncmp(text, "reason=", 7) == 0) {
            chip->watchdog_reason = value;
        } else {
            return false;
        }
        text = *end == ',' ? end + 1 : end;
    }
    return true;
}

void facts_reset(struct chip *chip)
{
    memset(chip->facts.counter, 0, sizeof chip->facts.counter);
    chip->facts.counter[MAX_KHZ] = 0x1ffffff;
    chip->facts.counter[DELAY] = 1;
    chip->facts.counter[INTERVAL] = 8;
    chip->facts.counted_at = 0;
}

/* The frequency of the counter's source in Hz; 0: it stands. */
static double source_hz(struct chip *chip, uint32_t source)
{
    switch (source) {
    case 3:
        return chip->facts.ring_hz;
    case 5:
        return CRYSTAL_HZ;
    case 8:
        return chip->ref_hz;
    case 9:
        return chip->sys_hz;
    case 10:
        return chip->peri_hz;
    default:
        chip_warn(chip, "the frequency counter's source %u is not modelled", source);
        return 0;
    }
}

/* Counts the clock's edges during so many cycles of clk_ref as make 2^INTERVAL us if REF_KHZ is right. */
static void count(struct chip *chip)
{
    uint32_t *const word = chip->facts.counter;
    const double us = 1U << word[INTERVAL], seconds = us * 1e-3 * word[REF_KHZ] / chip->ref_hz,
                 hz = source_hz(chip, word[SRC]), khz = (double)(uint64_t)(hz * seconds) / us * 1e3;
    if (word[REF_KHZ] == 0) {
        chip_warn(chip, "the frequency counter is not told the frequency of clk_ref");
    }
    word[RESULT] = (uint32_t)(khz * 32);
    word[STATUS] = hz == 0               ? (uint32_t)DIED
                   : khz < word[MIN_KHZ] ? (uint32_t)(DONE | SLOW)
                   : khz > word[MAX_KHZ] ? (uint32_t)(DONE | FAST)
                                         : (uint32_t)(DONE | PASS);
    chip->facts.counted_at = chip->now + (hz == 0 ? 0 : (uint64_t)(seconds * 1e15));
}

uint32_t counter_read(const struct chip *chip, uint32_t number)
{
    const bool runs = chip->now < chip->facts.counted_at;
    return number < STATUS || !runs ? chip->facts.counter[number] : number == STATUS ? (uint32_t)RUNNING : 0;
}

void counter_write(struct chip *chip, uint32_t number, uint32_t value)
{
    static const uint32_t bits[] = {0xfffff, 0x1ffffff, 0x1ffffff, 7, 15, 0xff, 0, 0};
    if ((value & ~bits[number]) != 0 || number >= STATUS) {
        chip_warn(chip, "a write of %x to word %u of the frequency counter", value, number);
    } else if (chip->now < chip->facts.counted_at) {
        chip_warn(chip, "the frequency counter is set up while it counts");
    }
    chip->facts.counter[number] = value;
    if (number == SRC) {
        chip->facts.counter[STATUS] = chip->facts.counter[RESULT] = 0;
        if (value != 0) {
            count(chip);
        }
    }
}
