/*
 * What an LM3S6965 takes from its port (registers/registers.h). Sources are the chapters of its data sheet, and the
 * PL022's and PL011's manuals (ARM DDI 0194, DDI 0183) where the data sheet has their text.
 *
 * Ranges of values are those whose effect the port counts on: a crystal of 8 MHz makes 50 MHz.
 */
#include "registers/registers_scs.h"

/* ---- system control --------------------------------------------------------------------------------- */

#define SYSCTL    0x400FE000u
#define RIS       (SYSCTL + 0x050)
#define RCC       (SYSCTL + 0x060)
#define RCGC1     (SYSCTL + 0x104)
#define RCGC2     (SYSCTL + 0x108)
#define PLLLRIS   (1u << 6)
#define SYSDIV    (15u << 23)
#define USESYSDIV (1u << 22)
#define PWRDN     (1u << 13)
#define BYPASS    (1u << 11)
#define XTAL      (15u << 6)
#define OSCSRC    (3u << 4)
#define IOSCDIS   2u
#define MOSCDIS   1u

#define CRYSTAL_NS 20000000u /* the crystal starts within this time: a bound of ours, StellarisWare waits longer */

static const struct register_field rcc[] = {
    {"MOSCDIS", 0, 1, 0, 1, "0: the crystal's oscillator runs"},
    {"IOSCDIS", 1, 1, 0, 1, "0: the internal oscillator runs"},
    {"OSCSRC", 4, 2, 0, 1, "0: the crystal, 1: the internal oscillator is the clock and the PLL's source"},
    {"XTAL", 6, 4, 11, 11, "as after a reset"},
    {"XTAL", 6, 4, 14, 14, "8 MHz, of which the PLL makes 200 MHz"},
    {"BYPASS", 11, 1, 0, 1, "0: the PLL is the clock"},
    {"PWRDN", 13, 1, 0, 1, "0: the PLL runs"},
    {"USESYSDIV", 22, 1, 0, 1, "the clock is divided"},
    {"SYSDIV", 23, 4, 15, 15, "as after a reset"},
    {"SYSDIV", 23, 4, 3, 3, "the PLL's 200 MHz / 4: 50 MHz, the most that the chip takes"},
};
static const struct register_when rcc_when[] = {
    {PWRDN | XTAL | OSCSRC, 0, REGISTER_IS, RCC, BYPASS, BYPASS,
     .why = "the oscillator or the PLL changes while the PLL is the clock: BYPASS is 0"},
    {OSCSRC, 0, REGISTER_IS, RCC, MOSCDIS, 0, .why = "the crystal becomes the clock while its oscillator is off",
     .clears = 1u << 4},
    {OSCSRC, 0, REGISTER_WAITED, RCC, MOSCDIS, CRYSTAL_NS,
     .why = "the crystal becomes the clock before its oscillator had 20 ms to start", .clears = 1u << 4},
    {IOSCDIS, IOSCDIS, REGISTER_IS, RCC, OSCSRC, 0,
     .why = "the internal oscillator is turned off while it is the clock"},
    {BYPASS, 0, REGISTER_SEEN, RIS, PLLLRIS, PLLLRIS, RCC, PWRDN,
     .why = "the PLL becomes the clock before PLLLRIS was read as 1", .clears = BYPASS},
    {BYPASS, 0, REGISTER_IS, RCC, SYSDIV | USESYSDIV, 3u << 23 | USESYSDIV,
     .why = "the PLL becomes the clock before SYSDIV makes 50 MHz of it", .clears = BYPASS},
};
static const struct register_field rcgc1[] = {
    {"UART0", 0, 1, 0, 1, "UART0 has a clock"},
    {"SSI0", 4, 1, 0, 1, "SSI0 has a clock"},
};
static const struct register_field rcgc2[] = {
    {"GPIOA", 0, 1, 0, 1, "the port has a clock"}, {"GPIOB", 1, 1, 0, 1, "the port has a clock"},
    {"GPIOC", 2, 1, 0, 1, "the port has a clock"}, {"GPIOD", 3, 1, 0, 1, "the port has a clock"},
    {"GPIOE", 4, 1, 0, 1, "the port has a clock"}, {"GPIOF", 5, 1, 0, 1, "the port has a clock"},
};
static const struct register_row sysctl[] = {
    {"RIS", 0x050, .kind = REGISTER_STATUS, .source = "System Control, RIS"},
    {"RCC", 0x060, .start = 0x078E3AD1, .fields = REGISTER_LIST(rcc), .when = REGISTER_LIST(rcc_when),
     .source = "System Control, RCC and Initialization and Configuration"},
    {"RCGC1", 0x104, .fields = REGISTER_LIST(rcgc1), .source = "System Control, RCGC1"},
    {"RCGC2", 0x108, .fields = REGISTER_LIST(rcgc2), .source = "System Control, RCGC2"},
};

/* A unit has its clock, and RCGC2 was read since: three clocks must pass (System Control, RCGC1 and RCGC2). */
#define CLOCKED(rcgc, bit, name)                                                                                       \
    {0, 0, REGISTER_IS, rcgc, bit, bit, .why = name " has no clock: its bit in RCGC is 0"},                            \
    {                                                                                                                  \
        0, 0, REGISTER_SEEN, RCGC2, 0, 0, rcgc, bit,                                                                   \
            .why = name " is accessed before three clocks have passed since it got its clock"                          \
    }

/* ---- GPIO ------------------------------------------------------------------------------------------ */

#define PORT_A 0x40004000u
#define PORT_B 0x40005000u
#define PORT_C 0x40006000u
#define PORT_D 0x40007000u
#define PORT_E 0x40024000u
#define PORT_F 0x40025000u
#define JTAG   15u /* pins 0 to 3 of port C after a reset */

static const struct register_field data[] = {{"DATA", 0, 8, 0, 255, "levels of the pins that the address names"}};
static const struct register_field dir[] = {{"DIR", 0, 8, 0, 255, "1: outputs"}};
static const struct register_field afsel[] = {{"AFSEL", 0, 8, 0, 255, "1: pins of a unit"}};
static const struct register_field pur[] = {{"PUE", 0, 8, 0, 255, "1: pulled up, a button's line"}};
static const struct register_field den[] = {{"DEN", 0, 8, 0, 255, "1: digital; 0: the pin is neither driven nor read"}};
static const struct register_field den_c[] = {
    {"DEN", 0, 4, 15, 15, "no pixel: JTAG"},
    {"DEN", 4, 4, 0, 15, "1: digital; 0: the pin is neither driven nor read"},
};

/* A pin becomes an output with a level, and digital with a function. */
#define DIR_NEEDS(base, pin)                                                                                           \
    {                                                                                                                  \
        1u << (pin), 1u << (pin), REGISTER_WRITTEN, (base) + (4u << (pin)),                                            \
            .why = "a pin becomes an output before DATA gives it a level"                                              \
    }
#define AFSEL_NEEDS(base, pin)                                                                                         \
    {                                                                                                                  \
        1u << (pin), 0, REGISTER_IS, (base) + 0x51C, 1u << (pin), 0, .why = "AFSEL changes while the pin is digital"   \
    }
#define EACH_PIN(base, what)                                                                                           \
    what(base, 0), what(base, 1), what(base, 2), what(base, 3), what(base, 4), what(base, 5), what(base, 6),           \
        what(base, 7)

#define PORT(name, base, bit, kept, den_fields)                                                                        \
    static const struct register_when name##_dir_when[] = {EACH_PIN(base, DIR_NEEDS)};                                 \
    static const struct register_when name##_afsel_when[] = {EACH_PIN(base, AFSEL_NEEDS)};                             \
    static const struct register_when name##_when[] = {CLOCKED(RCGC2, 1u << (bit), "the port")};                       \
    static const struct register_row name[] = {                                                                        \
        {"DATA", 0x000, .count = 256, .stride = 4, .kind = REGISTER_COMMAND, .fields = REGISTER_LIST(data),            \
         .source = "GPIO, GPIODATA"},                                                                                  \
        {"DIR", 0x400, .fields = REGISTER_LIST(dir), .when = REGISTER_LIST(name##_dir_when),                           \
         .source = "GPIO, GPIODIR"},                                                                                   \
        {"AFSEL", 0x420, .start = (kept), .fields = REGISTER_LIST(afsel), .when = REGISTER_LIST(name##_afsel_when),    \
         .source = "GPIO, GPIOAFSEL"},                                                                                 \
        {"PUR", 0x510, .start = (kept), .fields = REGISTER_LIST(pur), .source = "GPIO, GPIOPUR"},                      \
        {"DEN", 0x51C, .start = (kept), .fields = REGISTER_LIST(den_fields), .source = "GPIO, GPIODEN"},               \
    }
PORT(gpio_a, PORT_A, 0, 0, den);
PORT(gpio_b, PORT_B, 1, 0, den);
PORT(gpio_c, PORT_C, 2, JTAG, den_c);
PORT(gpio_d, PORT_D, 3, 0, den);
PORT(gpio_e, PORT_E, 4, 0, den);
PORT(gpio_f, PORT_F, 5, 0, den);

/* ---- SSI0, a PL022 ----------------------------------------------------------------------------------- */

#define SSI_AT(offset) (0x40008000u + (offset))
#define SSE            2u
#define TNF            2u
#define BSY            16u

static const struct register_field cr0[] = {
    {"DSS", 0, 4, 7, 7, "8 bits"},
    {"FRF", 4, 2, 0, 0, "Freescale's format, which is SPI"},
    {"SPO", 6, 1, 0, 1, "SPI mode"},
    {"SPH", 7, 1, 0, 1, "SPI mode"},
    {"SCR", 8, 8, 0, 255, "the clock is divided by CPSDVSR (1 + SCR)"},
};
static const struct register_when ssi_is_off[] = {
    {0, 0, REGISTER_IS, SSI_AT(0x04), SSE, 0, .why = "the unit takes another set-up only while SSE is 0"},
};
static const struct register_field cr1[] = {
    {"SSE", 1, 1, 0, 1, "the unit is on"},
    {"MS", 2, 1, 0, 0, "master"},
};
static const struct register_when cr1_when[] = {
    {SSE, SSE, REGISTER_WRITTEN, SSI_AT(0x10), .why = "the unit is turned on before CPSR is written: 0 is no divisor"},
    {SSE, SSE, REGISTER_WRITTEN, SSI_AT(0x00), .why = "the unit is turned on before CR0 is written"},
    {SSE, 0, REGISTER_SEEN, SSI_AT(0x0C), BSY, 0, SSI_AT(0x08), 0,
     .why = "the unit is turned off before BSY was read as 0: a byte may be on the wire", .clears = SSE},
};
static const struct register_field ssi_dr[] = {{"DATA", 0, 16, 0, 255, "a byte, most significant bit first"}};
static const struct register_when ssi_dr_when[] = {
    {0, 0, REGISTER_IS, SSI_AT(0x04), SSE, SSE, .why = "a byte is written while SSE is 0"},
    {0, 0, REGISTER_SEEN, SSI_AT(0x0C), TNF, TNF, SSI_AT(0x08), 0,
     .why = "a byte is written before TNF was read as 1: the FIFO may be full"},
};
static const struct register_field cpsr[] = {
    {"CPSDVSR", 1, 7, 1, 127, "the clock's divisor, an even number from 2 on"}};
static const struct register_row ssi[] = {
    {"CR0", 0x00, .fields = REGISTER_LIST(cr0), .when = REGISTER_LIST(ssi_is_off),
     .source = "SSI, SSICR0 and Initialization and Configuration"},
    {"CR1", 0x04, .fields = REGISTER_LIST(cr1), .when = REGISTER_LIST(cr1_when), .source = "SSI, SSICR1"},
    {"DR", 0x08, .kind = REGISTER_COMMAND, .fields = REGISTER_LIST(ssi_dr), .when = REGISTER_LIST(ssi_dr_when),
     .source = "SSI, SSIDR"},
    {"SR", 0x0C, .kind = REGISTER_STATUS, .source = "SSI, SSISR"},
    {"CPSR", 0x10, .fields = REGISTER_LIST(cpsr), .when = REGISTER_LIST(ssi_is_off),
     .source = "SSI, SSICPSR and Initialization and Configuration"},
};
static const struct register_when ssi_when[] = {CLOCKED(RCGC1, 1u << 4, "SSI0")};

/* ---- UART0 ----------------------------------------------------------------------------------------- */

#define UART_AT(offset) (0x4000C000u + (offset))
#define UARTEN          1u
#define TXE             (1u << 8)
#define TXFF            (1u << 5)

static const struct register_field uart_dr[] = {{"DATA", 0, 8, 0, 255, "no pixel: a character of the log"}};
static const struct register_when uart_dr_when[] = {
    {0, 0, REGISTER_IS, UART_AT(0x30), UARTEN | TXE, UARTEN | TXE,
     .why = "a character is written while the UART is off"},
    {0, 0, REGISTER_SEEN, UART_AT(0x18), TXFF, 0, UART_AT(0x00), 0,
     .why = "a character is written before TXFF was read as 0: the FIFO may be full"},
};
static const struct register_when uart_is_off[] = {
    {0, 0, REGISTER_IS, UART_AT(0x30), UARTEN, 0, .why = "the UART takes another set-up only while UARTEN is 0"},
};
static const struct register_field ibrd[] = {{"DIVINT", 0, 16, 1, 65535, "no pixel: the log's bits a second"}};
static const struct register_field fbrd[] = {{"DIVFRAC", 0, 6, 0, 63, "no pixel: the log's bits a second"}};
static const struct register_field lcrh[] = {
    {"FEN", 4, 1, 0, 1, "no pixel: the FIFOs are on"},
    {"WLEN", 5, 2, 3, 3, "no pixel: 8 bits"},
};
static const struct register_field ctl[] = {
    {"UARTEN", 0, 1, 0, 1, "no pixel: the unit is on"},
    {"TXE", 8, 1, 0, 1, "no pixel: it sends"},
    {"RXE", 9, 1, 0, 1, "no pixel: it receives"},
};
static const struct register_when ctl_when[] = {
    {3u << 8, UARTEN, REGISTER_IS, UART_AT(0x30), UARTEN, 0, .why = "CTL changes while the UART is on"},
    {UARTEN, UARTEN, REGISTER_WRITTEN, UART_AT(0x24), .why = "the UART is turned on before IBRD is written"},
    {UARTEN, UARTEN, REGISTER_WRITTEN, UART_AT(0x2C), .since = UART_AT(0x24),
     .why = "LCRH was not written after IBRD, which it puts in force"},
    {UARTEN, UARTEN, REGISTER_WRITTEN, UART_AT(0x2C), .since = UART_AT(0x28),
     .why = "LCRH was not written after FBRD, which it puts in force"},
};
static const struct register_row uart[] = {
    {"DR", 0x00, .kind = REGISTER_COMMAND, .fields = REGISTER_LIST(uart_dr), .when = REGISTER_LIST(uart_dr_when),
     .source = "UART, UARTDR"},
    {"FR", 0x18, .kind = REGISTER_STATUS, .source = "UART, UARTFR"},
    {"IBRD", 0x24, .fields = REGISTER_LIST(ibrd), .when = REGISTER_LIST(uart_is_off), .source = "UART, UARTIBRD"},
    {"FBRD", 0x28, .fields = REGISTER_LIST(fbrd), .when = REGISTER_LIST(uart_is_off), .source = "UART, UARTFBRD"},
    {"LCRH", 0x2C, .fields = REGISTER_LIST(lcrh), .when = REGISTER_LIST(uart_is_off), .source = "UART, UARTLCRH"},
    {"CTL", 0x30, .start = 0x300, .fields = REGISTER_LIST(ctl), .when = REGISTER_LIST(ctl_when),
     .source = "UART, UARTCTL"},
};
static const struct register_when uart_when[] = {CLOCKED(RCGC1, 1u, "UART0")};

/* ---- the chip -------------------------------------------------------------------------------------- */

static const struct register_block blocks[] = {
    SCS_BLOCK,
    {"SYSCTL", SYSCTL, 0x1000, .rows = REGISTER_LIST(sysctl)},
    {"GPIOA", PORT_A, 0x1000, .rows = REGISTER_LIST(gpio_a), .when = REGISTER_LIST(gpio_a_when)},
    {"GPIOB", PORT_B, 0x1000, .rows = REGISTER_LIST(gpio_b), .when = REGISTER_LIST(gpio_b_when)},
    {"GPIOC", PORT_C, 0x1000, .rows = REGISTER_LIST(gpio_c), .when = REGISTER_LIST(gpio_c_when)},
    {"GPIOD", PORT_D, 0x1000, .rows = REGISTER_LIST(gpio_d), .when = REGISTER_LIST(gpio_d_when)},
    {"GPIOE", PORT_E, 0x1000, .rows = REGISTER_LIST(gpio_e), .when = REGISTER_LIST(gpio_e_when)},
    {"GPIOF", PORT_F, 0x1000, .rows = REGISTER_LIST(gpio_f), .when = REGISTER_LIST(gpio_f_when)},
    {"SSI0", SSI_AT(0), 0x1000, .rows = REGISTER_LIST(ssi), .when = REGISTER_LIST(ssi_when)},
    {"UART0", UART_AT(0), 0x1000, .rows = REGISTER_LIST(uart), .when = REGISTER_LIST(uart_when)},
};

const struct register_chip lm3s6965_registers = {"LM3S6965", "LM3S6965 data sheet", .blocks = REGISTER_LIST(blocks)};
