/*
 * A program for long_rp2350_flash.sh: how long an emulated RP2350's reads of flash take, in us of its timer, how many
 * of them its cache does not have, and what rp2_flash_measure() tells. It runs from RAM.
 */
#include "port.h"
#include "chips/rp2/flash.h"

#define TIMERAWL (*(volatile uint32_t *)0x400b0028)
#define CTR_HIT  (*(volatile uint32_t *)0x400c800c)
#define CTR_ACC  (*(volatile uint32_t *)0x400c8010)
#define FLASH    0x10100000
#define READS    1000

static uint32_t from = FLASH;

static void put(const char *name, uint32_t value)
{
    char text[12], *at = text + sizeof text;
    *--at = '\0';
    do {
        *--at = (char)('0' + value % 10);
        value /= 10;
    } while (value != 0);
    port_log(name);
    port_log(" ");
    port_log(at);
    port_log("\r\n");
}

static __attribute__((noinline)) uint32_t walk(uint32_t stride, uint32_t count, uint32_t pause)
{
    const uint32_t start = TIMERAWL;
    for (uint32_t i = 0; i < count; i++) {
        (void)*(const volatile uint32_t *)(uintptr_t)(from + i * stride);
        for (uint32_t k = 0; k < pause; k++) {
            __asm volatile("");
        }
    }
    return TIMERAWL - start;
}

/* us of misses alone: what a walk takes longer than the next one over lines that are there. */
static void cost(const char *name, uint32_t stride, uint32_t pause)
{
    const uint32_t first = walk(stride, READS, pause);
    put(name, first - walk(stride, READS, pause));
    from += 0x100000;
}

/* Misses of eight walks over so many KB, when others have gone before. */
static void loop(const char *name, uint32_t kb)
{
    for (uint32_t i = 0; i < 32; i++) {
        (void)walk(8, 128 * kb, 0);
    }
    CTR_HIT = 0;
    CTR_ACC = 0;
    for (uint32_t i = 0; i < 8; i++) {
        (void)walk(8, 128 * kb, 0);
    }
    put(name, CTR_ACC - CTR_HIT);
    from += 0x100000;
}

int main(void)
{
    struct rp2_flash_facts facts;
    cost("soon", 24, 0);
    cost("late", 24, 60);
    cost("next", 8, 0);
    loop("8KB", 8);
    loop("16KB", 16);
    loop("24KB", 24);
    loop("32KB", 32);
    rp2_flash_measure(&facts);
    put("id", (uint32_t)facts.id[0] << 16 | (uint32_t)facts.id[1] << 8 | facts.id[2]);
    put("command", facts.command);
    put("divider", facts.divider);
    put("delay", facts.delay);
    put("good", facts.good_delays);
    cost("soon", 24, 0);
    port_exit(0);
    return 0;
}
