/*
 * rows: what the tables of the RP2040 and the RP2350 are written with (registers_table.c, peripherals_rows.h).
 */
#ifndef RP2040_ROWS_H
#define RP2040_ROWS_H

#include <registers.h>
#include "registers/registers.h"

/* Parts of a struct register_when. */
#define IS(at, bits, is)       .need = REGISTER_IS, .address = (at), .mask = (bits), .value = (is)
#define AT_LEAST(at, bits, is) .need = REGISTER_AT_LEAST, .address = (at), .mask = (bits), .value = (is)
#define SEEN(at, bits, is)     .need = REGISTER_SEEN, .address = (at), .mask = (bits), .value = (is)
#define WAITED(at, bits, ns)   .need = REGISTER_WAITED, .address = (at), .mask = (bits), .value = (ns)
#define WRITTEN(at)            .need = REGISTER_WRITTEN, .address = (at)
#define SINCE(at, bits)        .since = (at), .since_mask = (bits)

#define XOSC_ENABLE    0xfff000
#define SYS_SRC        1U
#define AUXSRC         (7U << 5) /* of clk_sys and of clk_peri */
#define PERI_ENABLE    (1U << 11)
#define PLL_VCO_OFF    (1U << 5 | 1) /* VCOPD, PD */
#define PLL_POST_OFF   (1U << 3)     /* POSTDIVPD */
#define CRYSTAL_STABLE SEEN(XOSC_STATUS, 1U << 31, 1U << 31), SINCE(XOSC_CTRL, XOSC_ENABLE)

#define CRYSTAL_RUNS  CRYSTAL_STABLE, .why = "the crystal was not seen to be STABLE"
#define PLL_RUNS(pll) IS(PLL_PWR(pll), PLL_VCO_OFF | PLL_POST_OFF, 0), .why = "the PLL or its post dividers are off"
#define REF_IS_CRYSTAL                                                                                                 \
    SEEN(CLK_REF_SELECTED, 15, 4), SINCE(CLK_REF_CTRL, 3), .why = "SELECTED did not say that clk_ref is the crystal"

/* Two needs before any access to a block. */
#define OUT_OF_RESET(bit)                                                                                              \
    {IS(RESETS_RESET, (bit), 0), .why = "the block is in reset"},                                                      \
    {                                                                                                                  \
        SEEN(RESETS_RESET_DONE, (bit), (bit)), SINCE(RESETS_RESET, (bit)),                                             \
            .why = "RESET_DONE was not seen since the block left reset"                                                \
    }

static const struct register_field any_fields[] = {{"all bits", 0, 32, 0, UINT32_MAX, "a number or an address"}};

/* Where a chip has a register for each pin: a bit each, of the 30. */
static const struct register_field pins_fields[] = {{"pins", 0, 30, 0, 0x3fffffff, "a level or a direction each"}};

static const struct register_field bit_fields[] = {{"bit 0", 0, 1, 0, 1, "on or off"}};

#endif
