/*
 * What the ports with a PL011 take for a byte: the RP2040 (whose uart.c the RP2350 has, too) and the LM3S6965. Their
 * registers are memory here. The bits are those of the PL011's manual (DDI 0183, 3.3.1) and of the LM3S6965's data
 * sheet (UARTDR): FE is bit 8, PE 9, BE 10, OE 11.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include <stdint.h>

#include <registers.h>

#undef REG
#define REG(address)   (*reg(address))
#define REG32(address) (*reg(address))
#define CORTEXM_START_H
static volatile uint32_t *reg(uint32_t address);
void cortexm_dark(void);
uint32_t port_start(void);
void port_bus_stop(void);
uint32_t cortexm_time_us(void *context);
void cortexm_delay_us(void *context, uint32_t us);
#include "../../hal/chips/rp2/uart.c" /* NOLINT(bugprone-suspicious-include) */
void lm3s6965_log(const char *text);
int lm3s6965_log_read(void);
#define port_log      lm3s6965_log
#define port_log_read lm3s6965_log_read
#include "../../hal/lm3s6965/lm3s6965.c" /* NOLINT(bugprone-suspicious-include) */
#undef port_log_read

static uint32_t data, flags, other; /* UARTDR, UARTFR */

static volatile uint32_t *reg(uint32_t address)
{
    return address == 0x40034000 || address == 0x4000C000   ? &data
           : address == 0x40034018 || address == 0x4000C018 ? &flags
                                                            : &other;
}

static void try_all_errors(int (*read)(void))
{
    flags = 1U << 4; /* RXFE */
    assert_int_equal(read(), -1);
    flags = 0;
    for (uint32_t errors = 0; errors < 16; errors++) {
        data = errors << 8 | 'B';
        assert_int_equal(read(), (errors & 7) == 0 ? 'B' : -1);
    }
}

static void a_damaged_byte_is_no_command_of_an_rp2040(void **state)
{
    (void)state;
    try_all_errors(port_log_read);
}

static void a_damaged_byte_is_no_command_of_an_lm3s6965(void **state)
{
    (void)state;
    kit.early = -1;
    try_all_errors(lm3s6965_log_read);
}

static void a_damaged_byte_from_before_the_start_is_none(void **state)
{
    (void)state;
    flags = 0;
    data = 1U << 8 | 'B';
    set_up_uart();
    flags = 1U << 4;
    assert_int_equal(lm3s6965_log_read(), -1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_damaged_byte_is_no_command_of_an_rp2040),
        cmocka_unit_test(a_damaged_byte_is_no_command_of_an_lm3s6965),
        cmocka_unit_test(a_damaged_byte_from_before_the_start_is_none),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* What the ports take from elsewhere. */
extern const struct board board_lm3s6965evb;
const struct board *const board_here = &board_lm3s6965evb;

void rp2_pin_function(uint32_t pin, uint32_t function)
{
    (void)pin;
    (void)function;
}

void rp2_pin_input(uint32_t pin)
{
    (void)pin;
}

void cortexm_dark(void)
{
}

uint32_t cortexm_time_us(void *context)
{
    (void)context;
    return 0;
}

void cortexm_delay_us(void *context, uint32_t us)
{
    (void)context;
    (void)us;
}
