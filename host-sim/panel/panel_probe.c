/* See panel_probe.h. */
#include "panel_probe.h"

/* RDDID and RDID4 from the datasheets; of the ID bytes those that makers of glasses do not change. */
static const struct known {
    const char *name;
    bool id4;
    uint32_t id, mask; /* 24 bits */
} known[] = {
    {"ILI9341", true, 0x009341, 0xFFFFFF},  {"ILI9488", true, 0x009488, 0xFFFFFF},
    {"GC9A01", false, 0x009A01, 0xFFFFFF},  {"ST7789", false, 0x858552, 0xFFFFFF},
    {"ST7735S", false, 0x7C89F0, 0xFFFFFF},
};

int panel_probe_read(const struct hal *hal, const struct board *board, struct panel_answers *answers)
{
    const struct panel_controller *c = board->panel->controller;
    if (hal->ops->bus_read == NULL || !board->pins.data_in.wired) {
        return HAL_ENOSYS;
    }
    int status = hal->ops->bus_clock(hal->context, c->init_hz);
    if (status < 0) {
        return status;
    }
    hal->ops->pin_set(hal->context, HAL_PIN_RESET, false);
    hal->ops->delay_us(hal->context, c->reset_low_us);
    hal->ops->pin_set(hal->context, HAL_PIN_RESET, true);
    hal->ops->delay_us(hal->context, c->reset_high_us);
    status = hal->ops->bus_read(hal->context, 0x04, answers->id, PROBE_BYTES);
    return status < 0 ? status : hal->ops->bus_read(hal->context, 0xD3, answers->id4, PROBE_BYTES);
}

/* Returns 24 bits from bit `at` on. */
static uint32_t bits_at(const uint8_t bytes[PROBE_BYTES], unsigned at)
{
    uint64_t all = 0;
    for (unsigned i = 0; i < PROBE_BYTES; i++) {
        all = all << 8 | bytes[i];
    }
    return (uint32_t)(all >> (8 * PROBE_BYTES - 24 - at)) & 0xFFFFFF;
}

const char *panel_probe_name(const struct panel_answers *answers)
{
    static const unsigned dummies[] = {1, 8, 0, 9}; /* clocks before the answer: one by the datasheets, eight on some */
    for (unsigned i = 0; i < sizeof known / sizeof known[0]; i++) {
        const uint8_t *bytes = known[i].id4 ? answers->id4 : answers->id;
        for (unsigned k = 0; k < sizeof dummies / sizeof dummies[0]; k++) {
            if ((bits_at(bytes, dummies[k]) & known[i].mask) == known[i].id) {
                return known[i].name;
            }
        }
    }
    return NULL;
}

static bool varies(const uint8_t bytes[PROBE_BYTES])
{
    for (unsigned i = 0; i < PROBE_BYTES; i++) {
        if (bytes[i] != bytes[0] || (bytes[i] != 0 && bytes[i] != 0xFF)) {
            return true;
        }
    }
    return false;
}

bool panel_probe_answered(const struct panel_answers *answers)
{
    return varies(answers->id) || varies(answers->id4);
}
