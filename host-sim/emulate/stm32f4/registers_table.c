/*
 * What an STM32F405 takes from its port (registers/registers.h). Sections are those of RM0090. What the chip's
 * errata sheet (ES0182) and data sheet say is named so.
 *
 * Ranges of values are those whose effect the port counts on: a crystal of 12 MHz makes 168 MHz, APB1 has a quarter.
 */
#include "registers/registers_scs.h"

#define RCC   0x40023800u
#define GPIO  0x40020000u
#define DMA1  0x40026000u
#define SPI2  0x40003800u
#define USART 0x40004800u

#define EACH_8(what)  what(0), what(1), what(2), what(3), what(4), what(5), what(6), what(7)
#define EACH_16(what) EACH_8(what), what(8), what(9), what(10), what(11), what(12), what(13), what(14), what(15)

/* ---- RCC, FLASH, SYSCFG ---------------------------------------------------------------------------- */

#define RCC_CR   (RCC + 0x00)
#define PLLCFGR  (RCC + 0x04)
#define AHB1ENR  (RCC + 0x30)
#define APB1ENR  (RCC + 0x40)
#define APB2ENR  (RCC + 0x44)
#define ACR      0x40023C00u
#define HSEON    (1u << 16)
#define HSERDY   (1u << 17)
#define PLLON    (1u << 24)
#define PLLRDY   (1u << 25)
#define SPI2EN   (1u << 14)
#define USART3EN (1u << 18)
#define DMA1EN   (1u << 21)
#define SYSCFGEN (1u << 14)

static const struct register_field cr[] = {
    {"HSION", 0, 1, 1, 1, "the internal oscillator, the clock until the PLL is, runs"},
    {"HSIRDY", 1, 1, 0, 1, "is read only"},
    {"HSICAL", 8, 8, 0, 255, "is read only"},
    {"HSEON", 16, 1, 0, 1, "the crystal's oscillator runs"},
    {"HSERDY", 17, 1, 0, 1, "is read only"},
    {"PLLON", 24, 1, 0, 1, "the PLL runs"},
    {"PLLRDY", 25, 1, 0, 1, "is read only"},
};
static const struct register_when cr_when[] = {
    {PLLON, PLLON, REGISTER_SEEN, RCC_CR, HSERDY, HSERDY, RCC_CR, HSEON,
     .why = "the PLL is turned on before HSERDY was read as 1: it is to be set up when its source is stable"},
    {PLLON, PLLON, REGISTER_WRITTEN, PLLCFGR, .why = "the PLL is turned on before PLLCFGR is written"},
};
static const struct register_field pllcfgr[] = {
    {"PLLM", 0, 6, 12, 12, "1 MHz of a crystal of 12 MHz; the PLL takes 1 to 2 MHz"},
    {"PLLN", 6, 9, 336, 336, "336 MHz; the PLL makes 100 to 432 MHz"},
    {"PLLP", 16, 2, 0, 0, "a half: 168 MHz, the most that the chip takes"},
    {"PLLSRC", 22, 1, 1, 1, "the crystal"},
    {"PLLQ", 24, 4, 7, 7, "no pixel: 48 MHz for USB, which is off"},
};
static const struct register_when pllcfgr_when[] = {
    {0, 0, REGISTER_IS, RCC_CR, PLLON, 0, .why = "PLLCFGR takes writes only while the PLL is off"},
};
static const struct register_field cfgr[] = {
    {"SW", 0, 2, 2, 2, "the PLL is the clock"},
    {"SWS", 2, 2, 0, 2, "is read only"},
    {"PPRE1", 10, 3, 5, 5, "APB1, with SPI2 and USART3, gets a quarter: 42 MHz, the most that it takes"},
    {"PPRE2", 13, 3, 4, 4, "APB2 gets a half: 84 MHz, the most that it takes"},
};
static const struct register_when cfgr_when[] = {
    {0, 2, REGISTER_SEEN, RCC_CR, PLLRDY, PLLRDY, RCC_CR, PLLON,
     .why = "the PLL becomes the clock before PLLRDY was read as 1"},
    {0, 2, REGISTER_SEEN, ACR, 7, 5, ACR, 7,
     .why =
         "the clock rises before ACR was read with 5 wait states, which 150 to 168 MHz take at 2.7 to 3.6 V (3.5.1)"},
    /* PWR_CR's VOS is 1 after a reset: scale 1, which 168 MHz takes (5.4.1, PWR_CR of the STM32F405). */
};
static const struct register_field ahb1enr[] = {
    {"GPIOAEN", 0, 1, 0, 1, "port A has a clock"}, {"GPIOBEN", 1, 1, 0, 1, "port B has a clock"},
    {"GPIOCEN", 2, 1, 0, 1, "port C has a clock"}, {"GPIODEN", 3, 1, 0, 1, "port D has a clock"},
    {"GPIOEEN", 4, 1, 0, 1, "port E has a clock"}, {"DMA1EN", 21, 1, 0, 1, "DMA1 has a clock"},
};
static const struct register_field apb1enr[] = {
    {"SPI2EN", 14, 1, 0, 1, "SPI2 has a clock"},
    {"USART3EN", 18, 1, 0, 1, "USART3 has a clock"},
};
static const struct register_field apb2enr[] = {
    {"SYSCFGEN", 14, 1, 0, 1, "SYSCFG has a clock"},
};
static const struct register_row rcc[] = {
    {"CR", 0x00, .start = 0x83, .fields = REGISTER_LIST(cr), .when = REGISTER_LIST(cr_when), .source = "7.3.1"},
    {"PLLCFGR", 0x04, .start = 0x24003010, .fields = REGISTER_LIST(pllcfgr), .when = REGISTER_LIST(pllcfgr_when),
     .source = "7.3.2"},
    {"CFGR", 0x08, .fields = REGISTER_LIST(cfgr), .when = REGISTER_LIST(cfgr_when), .source = "7.3.3"},
    {"AHB1ENR", 0x30, .start = 0x00100000, .fields = REGISTER_LIST(ahb1enr), .source = "7.3.10"},
    {"APB1ENR", 0x40, .fields = REGISTER_LIST(apb1enr), .source = "7.3.13"},
    {"APB2ENR", 0x44, .fields = REGISTER_LIST(apb2enr), .source = "7.3.14"},
};

static const struct register_field acr[] = {
    {"LATENCY", 0, 3, 5, 5, "5 wait states"},
    {"PRFTEN", 8, 1, 0, 1, "no pixel: the prefetch, for speed (revision A has none: ES0182)"},
    {"ICEN", 9, 1, 0, 1, "no pixel: the cache of instructions, for speed"},
    {"DCEN", 10, 1, 0, 1, "no pixel: the cache of data, for speed"},
};
static const struct register_row flash[] = {
    {"ACR", 0x00, .fields = REGISTER_LIST(acr), .source = "3.9.1"},
};

/* A unit has its clock, and its register was read back: ES0182, "Delay after an RCC peripheral clock enabling". */
#define CLOCKED(enr, bit, name)                                                                                        \
    {0, 0, REGISTER_IS, enr, bit, bit, .why = name " has no clock: its bit in RCC is 0"},                              \
    {                                                                                                                  \
        0, 0, REGISTER_SEEN, enr, 0, 0, enr, bit,                                                                      \
            .why = name                                                                                                \
            " is accessed before the register of its clock was read back: a clock takes two of its bus (ES0182)"       \
    }

static const struct register_field memrmp[] = {
    {"MEM_MODE", 0, 2, 1, 1, "the boot loader's memory is at 0"},
};
static const struct register_row syscfg[] = {
    {"MEMRMP", 0x00, .fields = REGISTER_LIST(memrmp), .source = "9.2.1"},
};
static const struct register_when syscfg_when[] = {CLOCKED(APB2ENR, SYSCFGEN, "SYSCFG")};

/* ---- GPIO ------------------------------------------------------------------------------------------ */

/* Registers with 2 bits for each pin. */
#define MODE_OF(pin)                                                                                                   \
    {                                                                                                                  \
        "MODER" #pin, 2 * (pin), 2, 0, 2, "input, output, alternate function"                                          \
    }
#define SPEED_OF(pin)                                                                                                  \
    {                                                                                                                  \
        "OSPEEDR" #pin, 2 * (pin), 2, 0, 3, "no pixel: how steep edges are; 2 takes 50 MHz at 40 pF (data sheet)"      \
    }
#define PULL_OF(pin)                                                                                                   \
    {                                                                                                                  \
        "PUPDR" #pin, 2 * (pin), 2, 0, 2, "no pull, up, down: a button's line"                                         \
    }
#define FUNCTION_OF(pin)                                                                                               \
    {"AFR" #pin, 4 * (pin), 4, 0, 0, "as after a reset"}, {"AFR" #pin, 4 * (pin), 4, 5, 5, "SPI2 (data sheet)"},       \
    {                                                                                                                  \
        "AFR" #pin, 4 * (pin), 4, 7, 7, "USART3 (data sheet)"                                                          \
    }
static const struct register_field moder[] = {EACH_16(MODE_OF)};
static const struct register_field ospeedr[] = {EACH_16(SPEED_OF)};
static const struct register_field pupdr[] = {EACH_16(PULL_OF)};
static const struct register_field afr[] = {EACH_8(FUNCTION_OF)};
static const struct register_field bsrr[] = {
    {"BS", 0, 16, 0, 0xFFFF, "pins get high"},
    {"BR", 16, 16, 0, 0xFFFF, "pins get low"},
};

/* A pin changes to an output or to its alternate function when its level or its function is set: no wrong edge. */
#define OUTPUT_NEEDS(port, pin)                                                                                        \
    {                                                                                                                  \
        3u << 2 * (pin), 1u << 2 * (pin), REGISTER_WRITTEN, GPIO_AT(port, 0x18),                                       \
            .since = GPIO_AT(port, 0x00), .why = "a pin becomes an output before BSRR gives it a level"                \
    }
#define ANY_OUTPUT_NEEDS(port)                                                                                         \
    {                                                                                                                  \
        0x55555555, 0x55555555, REGISTER_WRITTEN, GPIO_AT(port, 0x18),                                                 \
            .why = "a pin becomes an output before BSRR gives it a level"                                              \
    }
#define FUNCTION_NEEDS(port, pin)                                                                                      \
    {                                                                                                                  \
        3u << 2 * (pin), 2u << 2 * (pin), REGISTER_AT_LEAST, GPIO_AT(port, 0x20 + 4 * ((pin) / 8)),                    \
            15u << 4 * ((pin) % 8), 1u << 4 * ((pin) % 8),                                                             \
            .why = "a pin gets its alternate function before AFR says which"                                           \
    }
#define GPIO_AT(port, offset) (GPIO + 0x400u * (port) + (offset))
#define PORT_NEEDS(port, what)                                                                                         \
    what(port, 0), what(port, 1), what(port, 2), what(port, 3), what(port, 4), what(port, 5), what(port, 6),           \
        what(port, 7), what(port, 8), what(port, 9), what(port, 10), what(port, 11), what(port, 12), what(port, 13),   \
        what(port, 14), what(port, 15)

#define PORT(name, port, moder_start, ospeedr_start, pupdr_start)                                                      \
    static const struct register_when name##_mode_when[] = {ANY_OUTPUT_NEEDS(port), PORT_NEEDS(port, OUTPUT_NEEDS),    \
                                                            PORT_NEEDS(port, FUNCTION_NEEDS)};                         \
    static const struct register_when name##_when[] = {CLOCKED(AHB1ENR, 1u << (port), "the port")};                    \
    static const struct register_row name[] = {                                                                        \
        {"MODER", 0x00, .start = (moder_start), .fields = REGISTER_LIST(moder),                                        \
         .when = REGISTER_LIST(name##_mode_when), .source = "8.4.1"},                                                  \
        {"OSPEEDR", 0x08, .start = (ospeedr_start), .fields = REGISTER_LIST(ospeedr), .source = "8.4.3"},              \
        {"PUPDR", 0x0C, .start = (pupdr_start), .fields = REGISTER_LIST(pupdr), .source = "8.4.4"},                    \
        {"IDR", 0x10, .kind = REGISTER_STATUS, .source = "8.4.5"},                                                     \
        {"BSRR", 0x18, .kind = REGISTER_COMMAND, .fields = REGISTER_LIST(bsrr), .source = "8.4.7"},                    \
        {"AFRL", 0x20, .fields = REGISTER_LIST(afr), .source = "8.4.9"},                                               \
        {"AFRH", 0x24, .fields = REGISTER_LIST(afr), .source = "8.4.10"},                                              \
    }
PORT(gpio_a, 0, 0xA8000000, 0x0C000000, 0x64000000);
PORT(gpio_b, 1, 0x00000280, 0x000000C0, 0x00000100);
PORT(gpio_c, 2, 0, 0, 0);
PORT(gpio_d, 3, 0, 0, 0);
PORT(gpio_e, 4, 0, 0, 0);

/* ---- DMA1, stream 4: channel 0 is SPI2_TX (10.3.3, table of DMA1's requests) ----------------------------- */

#define S4CR   (DMA1 + 0x70)
#define HIFCR  (DMA1 + 0x0C)
#define S4NDTR (DMA1 + 0x74)
#define S4PAR  (DMA1 + 0x78)
#define S4M0AR (DMA1 + 0x7C)
#define EN     1u

#define STREAM_IS_OFF                                                                                                  \
    {                                                                                                                  \
        0, 0, REGISTER_SEEN, S4CR, EN, 0, S4CR, EN,                                                                    \
            .why = "the stream is set up before EN was read as 0: it first ends what it moves (10.3.17)"               \
    }
static const struct register_field hifcr[] = {
    {"CFEIF4", 0, 1, 0, 1, "clears a flag of stream 4"}, {"CDMEIF4", 2, 1, 0, 1, "clears a flag of stream 4"},
    {"CTEIF4", 3, 1, 0, 1, "clears a flag of stream 4"}, {"CHTIF4", 4, 1, 0, 1, "clears a flag of stream 4"},
    {"CTCIF4", 5, 1, 0, 1, "clears a flag of stream 4"},
};
static const struct register_field s4cr[] = {
    {"EN", 0, 1, 0, 1, "the stream runs; it turns itself off at its end"},
    {"DIR", 6, 2, 0, 1, "1: from memory to the peripheral"},
    {"MINC", 10, 1, 0, 1, "the memory's address counts up"},
    {"CHSEL", 25, 3, 0, 0, "channel 0"},
};
static const struct register_when s4cr_when[] = {
    {~EN, 0, REGISTER_IS, S4CR, EN, 0, .why = "CR's fields take writes only while EN is 0"},
    {~EN, 0, REGISTER_SEEN, S4CR, EN, 0, S4CR, EN,
     .why = "the stream is set up before EN was read as 0: it first ends what it moves (10.3.17)"},
    {EN, EN, REGISTER_WRITTEN, HIFCR, .since = S4CR, .since_mask = EN,
     .why = "the stream is turned on with the flags of its last transfer (10.3.17)"},
    {EN, EN, REGISTER_WRITTEN, S4NDTR, .since = S4CR, .since_mask = EN,
     .why = "the stream is turned on before NDTR is written"},
    {EN, EN, REGISTER_WRITTEN, S4PAR, .why = "the stream is turned on before PAR is written"},
    {EN, EN, REGISTER_WRITTEN, S4M0AR, .why = "the stream is turned on before M0AR is written"},
    {EN, EN, REGISTER_IS, S4CR, 3u << 6 | 1u << 10, 1u << 6 | 1u << 10, .why = "the stream does not send an array"},
};
static const struct register_field s4ndtr[] = {{"NDT", 0, 16, 1, 65535, "bytes of the transfer"}};
static const struct register_field s4par[] = {{"PAR", 0, 32, SPI2 + 0x0C, SPI2 + 0x0C, "SPI2_DR"}};
static const struct register_field s4m0ar[] = {
    {"M0A", 0, 32, 0x20000000, 0x2001FFFF, "SRAM1, SRAM2"},
    {"M0A", 0, 32, 0x08000000, 0x080FFFFF, "flash; the DMA does not reach CCM, at 10000000 (2.1, bus matrix)"},
};
static const struct register_field s4fcr[] = {
    {"FTH", 0, 2, 0, 3, "no pixel: not used in direct mode"},
    {"DMDIS", 2, 1, 0, 0, "direct mode"},
    {"FS", 3, 3, 0, 7, "is read only"},
};
static const struct register_when stream_when[] = {STREAM_IS_OFF};
static const struct register_row dma1[] = {
    {"HISR", 0x04, .kind = REGISTER_STATUS, .source = "10.5.2"},
    {"HIFCR", 0x0C, .kind = REGISTER_COMMAND, .fields = REGISTER_LIST(hifcr), .source = "10.5.4"},
    {"S4CR", 0x70, .fields = REGISTER_LIST(s4cr), .when = REGISTER_LIST(s4cr_when), .source = "10.5.5"},
    {"S4NDTR", 0x74, .fields = REGISTER_LIST(s4ndtr), .when = REGISTER_LIST(stream_when), .source = "10.5.6"},
    {"S4PAR", 0x78, .fields = REGISTER_LIST(s4par), .when = REGISTER_LIST(stream_when), .source = "10.5.7"},
    {"S4M0AR", 0x7C, .fields = REGISTER_LIST(s4m0ar), .when = REGISTER_LIST(stream_when), .source = "10.5.8"},
    {"S4FCR", 0x84, .start = 0x21, .fields = REGISTER_LIST(s4fcr), .when = REGISTER_LIST(stream_when),
     .source = "10.5.10"},
};
static const struct register_when dma1_when[] = {CLOCKED(AHB1ENR, DMA1EN, "DMA1")};

/* ---- SPI2 ------------------------------------------------------------------------------------------ */

#define CR1     (SPI2 + 0x00)
#define CR2     (SPI2 + 0x04)
#define SR      (SPI2 + 0x08)
#define DR      (SPI2 + 0x0C)
#define SPE     (1u << 6)
#define TXDMAEN 2u
#define TXE     2u
#define BSY     128u

static const struct register_field cr1[] = {
    {"CPHA", 0, 1, 0, 1, "SPI mode"},
    {"CPOL", 1, 1, 0, 1, "SPI mode"},
    {"MSTR", 2, 1, 1, 1, "master"},
    {"BR", 3, 3, 0, 7, "APB1's clock / 2^(BR + 1)"},
    {"SPE", 6, 1, 0, 1, "the unit is on"},
    {"SSI", 8, 1, 1, 1, "no other master has the bus; 0 would make this one a slave"},
    {"SSM", 9, 1, 1, 1, "SSI counts in the place of the pin NSS"},
};
static const struct register_when cr1_when[] = {
    {~SPE, 0, REGISTER_IS, CR1, SPE, 0, .why = "a field of CR1 changes while SPE is 1"},
    {SPE, 0, REGISTER_SEEN, SR, TXE | BSY, TXE, DR, 0,
     .why = "SPE changes before TXE was read as 1 and BSY as 0 (28.3.8)", .clears = SPE},
    {SPE, 0, REGISTER_SEEN, SR, TXE | BSY, TXE, CR2, TXDMAEN,
     .why = "SPE changes before the DMA's last byte is out (28.3.9)", .clears = SPE},
};
static const struct register_field cr2[] = {{"TXDMAEN", 1, 1, 0, 1, "TXE asks the DMA for a byte"}};
static const struct register_when cr2_when[] = {
    {TXDMAEN, TXDMAEN, REGISTER_IS, S4CR, EN, EN, .why = "SPI2 asks for bytes before the stream is on"},
};
static const struct register_field spi_dr[] = {{"DR", 0, 8, 0, 255, "a byte, most significant bit first"}};
static const struct register_when spi_dr_when[] = {
    {0, 0, REGISTER_IS, CR1, SPE, SPE, .why = "a byte is written while SPE is 0"},
    {0, 0, REGISTER_IS, CR2, TXDMAEN, 0, .why = "a byte is written while the DMA sends"},
    {0, 0, REGISTER_SEEN, SR, TXE, TXE, DR, 0,
     .why = "a byte is written over the one before: TXE was not read as 1 (28.3.7)"},
};
static const struct register_row spi2[] = {
    {"CR1", 0x00, .fields = REGISTER_LIST(cr1), .when = REGISTER_LIST(cr1_when), .source = "28.5.1"},
    {"CR2", 0x04, .fields = REGISTER_LIST(cr2), .when = REGISTER_LIST(cr2_when), .source = "28.5.2"},
    {"SR", 0x08, .kind = REGISTER_STATUS, .source = "28.5.3"},
    {"DR", 0x0C, .kind = REGISTER_COMMAND, .fields = REGISTER_LIST(spi_dr), .when = REGISTER_LIST(spi_dr_when),
     .source = "28.5.4"},
};
static const struct register_when spi2_when[] = {CLOCKED(APB1ENR, SPI2EN, "SPI2")};

/* ---- USART3 ---------------------------------------------------------------------------------------- */

#define UE          (1u << 13)
#define TE          8u
#define USART_TXE   128u
#define USART_AT(x) (USART + (x))

static const struct register_field usart_dr[] = {{"DR", 0, 9, 0, 255, "no pixel: a character of the log"}};
static const struct register_when usart_dr_when[] = {
    {0, 0, REGISTER_IS, USART_AT(0x0C), UE | TE, UE | TE, .why = "a character is written while the transmitter is off"},
    {0, 0, REGISTER_SEEN, USART_AT(0x00), USART_TXE, USART_TXE, USART_AT(0x04), 0,
     .why = "a character is written over the one before: TXE was not read as 1"},
};
static const struct register_field brr[] = {
    {"DIV", 0, 16, 16, 65535, "no pixel: 16 times the bits a second, in 16ths"}};
static const struct register_when brr_when[] = {
    {0, 0, REGISTER_IS, USART_AT(0x0C), UE, 0, .why = "BRR changes while UE is 1"},
};
static const struct register_field usart_cr1[] = {
    {"RE", 2, 1, 0, 1, "no pixel: the receiver is on"},
    {"TE", 3, 1, 0, 1, "no pixel: the transmitter is on"},
    {"UE", 13, 1, 0, 1, "no pixel: the unit is on"},
};
static const struct register_when usart_cr1_when[] = {
    {TE, TE, REGISTER_WRITTEN, USART_AT(0x08), .why = "the transmitter is turned on before BRR is written (30.3.2)"},
};
static const struct register_row usart3[] = {
    {"SR", 0x00, .kind = REGISTER_STATUS, .source = "30.6.1"},
    {"DR", 0x04, .kind = REGISTER_COMMAND, .fields = REGISTER_LIST(usart_dr), .when = REGISTER_LIST(usart_dr_when),
     .source = "30.6.2"},
    {"BRR", 0x08, .fields = REGISTER_LIST(brr), .when = REGISTER_LIST(brr_when), .source = "30.6.3"},
    {"CR1", 0x0C, .fields = REGISTER_LIST(usart_cr1), .when = REGISTER_LIST(usart_cr1_when), .source = "30.6.4"},
};
static const struct register_when usart3_when[] = {CLOCKED(APB1ENR, USART3EN, "USART3")};

/* ---- the chip -------------------------------------------------------------------------------------- */

static const struct register_block blocks[] = {
    SCS_BLOCK,
    {"RCC", RCC, 0x400, .rows = REGISTER_LIST(rcc)},
    {"FLASH", ACR, 0x400, .rows = REGISTER_LIST(flash)},
    {"SYSCFG", 0x40013800, 0x400, .rows = REGISTER_LIST(syscfg), .when = REGISTER_LIST(syscfg_when)},
    {"GPIOA", GPIO_AT(0, 0), 0x400, .rows = REGISTER_LIST(gpio_a), .when = REGISTER_LIST(gpio_a_when)},
    {"GPIOB", GPIO_AT(1, 0), 0x400, .rows = REGISTER_LIST(gpio_b), .when = REGISTER_LIST(gpio_b_when)},
    {"GPIOC", GPIO_AT(2, 0), 0x400, .rows = REGISTER_LIST(gpio_c), .when = REGISTER_LIST(gpio_c_when)},
    {"GPIOD", GPIO_AT(3, 0), 0x400, .rows = REGISTER_LIST(gpio_d), .when = REGISTER_LIST(gpio_d_when)},
    {"GPIOE", GPIO_AT(4, 0), 0x400, .rows = REGISTER_LIST(gpio_e), .when = REGISTER_LIST(gpio_e_when)},
    {"DMA1", DMA1, 0x400, .rows = REGISTER_LIST(dma1), .when = REGISTER_LIST(dma1_when)},
    {"SPI2", SPI2, 0x400, .rows = REGISTER_LIST(spi2), .when = REGISTER_LIST(spi2_when)},
    {"USART3", USART, 0x400, .rows = REGISTER_LIST(usart3), .when = REGISTER_LIST(usart3_when)},
};

const struct register_chip stm32f4_registers = {"STM32F405", "RM0090", .blocks = REGISTER_LIST(blocks)};
