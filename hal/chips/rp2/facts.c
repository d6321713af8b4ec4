/* See port.h: what the chip says of itself. Registers: datasheets' sections as in registers.h. */
#include "port.h"
#include <registers.h>
#include "flash.h"

#define CRYSTAL_KHZ 12000
#define COUNT_LOG2  12    /* FC0 counts for about 2^12 us, which is right to 1 kHz (RP2040 2.15.6.2, RP2350 8.1.6.2) */
#define PATIENCE_US 20000 /* a clock that stands is never counted */

struct reason {
    uint32_t bits;
    const char *text;
};

static void put_text(port_put put, const char *text) /* calls fact */
{
    put(text, 0, PORT_TEXT);
}

static bool fc0_becomes(uint32_t bit, uint32_t wanted)
{
    const uint32_t from = REG(TIMER_TIMERAWL);
    while ((REG(FC0_STATUS) & bit) != wanted) {
        if (REG(TIMER_TIMERAWL) - from > PATIENCE_US) {
            return false;
        }
    }
    return true;
}

/* Measures a clock in kHz, by the crystal, which clk_ref comes from. 0: the clock stands. */
static uint32_t measured_khz(uint32_t source)
{
    if (!fc0_becomes(FC0_RUNNING, 0)) {
        return 0;
    }
    REG(FC0_REF_KHZ) = CRYSTAL_KHZ;
    REG(FC0_INTERVAL) = COUNT_LOG2;
    REG(FC0_SRC) = source;
    const uint32_t khz = fc0_becomes(FC0_DONE, FC0_DONE) ? (REG(FC0_RESULT) + 16) >> 5 : 0;
    REG(FC0_SRC) = 0;
    return khz;
}

static void put_clocks(port_put put) /* calls fact */
{
    put("clocks by the 12 MHz crystal, kHz: sys ", measured_khz(FC0_SRC_CLK_SYS), PORT_DECIMAL);
    put(", peri ", measured_khz(FC0_SRC_CLK_PERI), PORT_DECIMAL);
    put(", ring ", measured_khz(FC0_SRC_ROSC), PORT_DECIMAL);
    put_text(put, "\n");
}

/* REASON is 0 after every other reset than the watchdog's. A start after the watchdog of this image has bitten never
 * comes here (start.c), so that a boot loader let it run out. */
static void put_start(port_put put) /* calls fact */
{
    static const struct reason reasons[] = {CHIP_RESETS};
    const uint32_t watchdog = REG(WATCHDOG_REASON), reset = REG(CHIP_RESET);
    put_text(put, "started by: ");
    if (watchdog != 0) {
        put_text(put, (watchdog & REASON_FORCE) != 0 ? "a reset by software" : "a boot loader, through the watchdog");
    }
    for (uint32_t i = 0; i < sizeof reasons / sizeof reasons[0] && watchdog == 0; i++) {
        if ((reset & reasons[i].bits) != 0) {
            put_text(put, reasons[i].text);
        }
    }
    put(" (reasons ", watchdog, PORT_HEX);
    put(" ", reset, PORT_HEX);
    put_text(put, ")");
    put_text(put, "\n");
}

static void put_flash(port_put put) /* calls fact */
{
    struct rp2_flash_facts f;
    rp2_flash_measure(&f);
    put("flash id ", (uint32_t)f.id[0] << 16 | (uint32_t)f.id[1] << 8 | f.id[2], PORT_HEX);
    put(", read by ", f.command, PORT_HEX);
    put("h at sys/", f.divider, PORT_DECIMAL);
    put(", sample delay ", f.delay, PORT_DECIMAL);
    put_text(put, "; right at");
    for (uint32_t i = 0; i < 32; i++) {
        if ((f.good_delays >> i & 1) != 0) {
            put(" ", i, PORT_DECIMAL);
        }
    }
    put_text(put, f.good_delays == 0 ? " none" : "");
    put_text(put, "\n");
}

void port_facts(port_put put) /* calls fact */
{
    const uint32_t id = REG(SYSINFO_CHIP_ID);
    put("chip " CHIP_NAME ", id ", id, PORT_HEX);
    put(", revision ", id >> 28, PORT_DECIMAL);
    put_text(put, "\n");
    put_start(put);
    put_clocks(put);
    put_flash(put);
}
