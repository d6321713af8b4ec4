/*
 * The binary information of an image: what `picotool info` shows of a file or of a chip. A header in marks, within 256
 * bytes after boot2 or the first 1024 bytes of an RP2350's flash, names a table of pointers to entries. Format:
 * pico-sdk, pico_binary_info/structure.h. firmware.mk includes the macros IMAGE_... and BOARD_... before this file's
 * first line.
 */
#include <registers.h>

#ifdef BOARD_PINS /* make lint reads this file without a board */

#define RASPBERRY_PI ('R' | 'P' << 8) /* who defines the types and the numbers below */

enum { ID_AND_INT = 5, ID_AND_STRING = 6, PINS_WITH_FUNCTION = 8, PINS_WITH_NAME = 9 };
enum { SEVERAL_PINS = 2 };

#define BINARY_END      0x68f465deU
#define PROGRAM_NAME    0x02031c86U
#define PROGRAM_VERSION 0x11a9bc3aU
#define PROGRAM_FEATURE 0xa1f4b453U
#define BUILD_ATTRIBUTE 0x4275f0d3U
#define BOARD           0xb63cffbbU
#define BOOT2_NAME      0x7f8882e1U

struct entry {
    uint16_t type, tag;
    uint32_t id; /* or the pins: a mask for a name, numbers of five bits for a function */
    const void *value;
};

extern const uint32_t ld_flash_end[]; /* by the linker script */

#define ENTRY(type, id, value)                                                                                         \
    &(const struct entry)                                                                                              \
    {                                                                                                                  \
        (type), RASPBERRY_PI, (id), (value)                                                                            \
    }
#define PIN(number, name) ENTRY(PINS_WITH_NAME, 1U << (number), name),
#define TWO_PINS(function, a, b)                                                                                       \
    ENTRY(PINS_WITH_FUNCTION,                                                                                          \
          SEVERAL_PINS | (function) << 3 | (uint32_t)(a) << 7 | (uint32_t)(b) << 12 | (uint32_t)(b) << 17, 0)

static const struct entry *const table[] = {
    ENTRY(ID_AND_STRING, PROGRAM_NAME, "Pinhole " IMAGE_NAME),
    ENTRY(ID_AND_STRING, PROGRAM_VERSION, IMAGE_VERSION),
    ENTRY(ID_AND_STRING, BOARD, BOARD_NAME),
    ENTRY(ID_AND_STRING, CHIP_INFO, CHIP_INFO_TEXT),
    ENTRY(ID_AND_STRING, BUILD_ATTRIBUTE, IMAGE_ATTRIBUTES),
#ifdef IMAGE_SCENE
    ENTRY(ID_AND_STRING, PROGRAM_FEATURE, "takes a scene at " IMAGE_SCENE), /* pinhole-flash --at-scene looks for it */
#endif
    ENTRY(ID_AND_INT, BINARY_END, ld_flash_end),
    TWO_PINS(FUNCTION_UART, 0, 1),
    TWO_PINS(BOARD_BUS, BOARD_CLOCK_PIN, BOARD_DATA_PIN),
    BOARD_PINS /* the port's log needs no names */
};

static const uint32_t no_copies[1]; /* memory that entries point to and that a start copies from flash: none */

/* The header of the binary information, which readers find by its marks. */
__attribute__((section(".binary_info"), used)) static const struct {
    uint32_t begin;
    const struct entry *const *first, *const *end;
    const uint32_t *copies;
    uint32_t finish;
} header = {0x7188ebf2, table, table + sizeof table / sizeof *table, no_copies, 0xe71aa390};

#endif
