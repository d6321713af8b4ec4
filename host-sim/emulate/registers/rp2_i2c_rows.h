/*
 * rp2_i2c_rows: the registers of I2C0 (DW_apb_i2c) in the tables of RP2040 and RP2350, as in rp2_peripherals_rows.h.
 * The unit is a master that only writes.
 */
#ifndef RP2_I2C_ROWS_H
#define RP2_I2C_ROWS_H

#include "registers/rp2_rows.h"

#define I2C_SOURCE    S("4.3.17", "12.2.17")
#define I2C(offset)   (I2C0_BASE + (offset))
#define I2C_TFNF      (1U << 1)
#define I2C_TX_EMPTY  (1U << 4)
#define I2C_TX_ABRT   (1U << 6)
#define I2C_INTR_STAT I2C(0x2c)
#define I2C_INTR_MASK I2C(0x30)
#define I2C_STATUS    I2C(0x70)
#define I2C_DATA_CMD  I2C(0x10)

static const struct register_field ic_con_fields[] = {
    {"MASTER_MODE", 0, 1, 1, 1, "a master"},
    {"SPEED", 1, 2, 2, 2, "the counts of fast mode"},
    {"IC_10BITADDR_MASTER, .._SLAVE", 3, 2, 0, 0, "addresses of 7 bits"},
    {"IC_RESTART_EN", 5, 1, 1, 1, "as after a reset"},
    {"IC_SLAVE_DISABLE", 6, 1, 1, 1, "no slave"},
    {"TX_EMPTY_CTRL", 8, 1, 0, 0, "TX_EMPTY tells of the FIFO alone"},
};
static const struct register_field ic_tar_fields[] = {
    {"IC_TAR", 0, 10, 8, 0x77, "an address that no other use has"},
};
static const struct register_field ic_data_fields[] = {
    {"DAT", 0, 8, 0, 255, "a byte to send"},
    {"CMD", 8, 1, 0, 0, "a write"},
    {"STOP", 9, 1, 0, 1, "a stop behind the byte"},
};
static const struct register_field ic_high_fields[] = {
    {"IC_FS_SCL_HCNT", 0, 16, 6, 0xffff, "HCNT + SPKLEN + 7 cycles"}};
static const struct register_field ic_low_fields[] = {{"IC_FS_SCL_LCNT", 0, 16, 8, 0xffff, "LCNT + 1 cycles"}};
static const struct register_field ic_mask_fields[] = {
    {"M_TX_EMPTY", 4, 1, 0, 1, "an interrupt when few words are in the FIFO"},
    {"M_TX_ABRT", 6, 1, 1, 1, "an interrupt when nobody acknowledges"},
    {"the others", 0, 4, 0, 0, "off"},
    {"M_RD_REQ", 5, 1, 0, 0, "off"},
    {"the others", 7, 6, 0, 0, "off"},
};
static const struct register_field ic_level_fields[] = {{"TX_TL", 0, 8, 0, 15, "so many words are few"}};
static const struct register_field ic_hold_fields[] = {{"IC_SDA_TX_HOLD", 0, 16, 1, 0xffff, "cycles that data stays"}};
static const struct register_field ic_spike_fields[] = {{"IC_FS_SPKLEN", 0, 8, 1, 255, "cycles of the longest spike"}};

static const struct register_when ic_off_when[] = {
    {IS(I2C(0x6c), 1, 0), .why = "the unit is on (IC_ENABLE) and ignores it"},
};
#define I2C_SET_UP(offset, text)                                                                                       \
    {                                                                                                                  \
        .changes = 1, .sets = 1, WRITTEN(I2C(offset)), .why = (text)                                                   \
    }
static const struct register_when ic_enable_when[] = {
    I2C_SET_UP(0x00, "IC_CON has not been written"),
    I2C_SET_UP(0x04, "IC_TAR has not been written"),
    I2C_SET_UP(0x1c, "IC_FS_SCL_HCNT has not been written"),
    I2C_SET_UP(0x20, "IC_FS_SCL_LCNT has not been written"),
    I2C_SET_UP(0x30, "IC_INTR_MASK, which a reset leaves with all interrupts on, has not been written"),
    I2C_SET_UP(0x7c, "IC_SDA_HOLD has not been written"),
    I2C_SET_UP(0xa0, "IC_FS_SPKLEN has not been written"),
    {.changes = 1,
     .clears = 1,
     SEEN(I2C_STATUS, 1U << 2 | 1U << 5, 1U << 2),
     SINCE(I2C_DATA_CMD, 0),
     .why = "a message may be on its way: IC_STATUS did not say that the FIFO is empty and the master idle"},
};
static const struct register_when ic_data_when[] = {
    {IS(I2C(0x6c), 1, 1), .why = "the unit is off (IC_ENABLE)"},
    {SEEN(I2C_STATUS, I2C_TFNF, I2C_TFNF), SINCE(I2C_DATA_CMD, 0), .why = "the FIFO may be full: TFNF was not seen"},
};
static const struct register_when i2c_when[] = {OUT_OF_RESET(RESET_I2C0)};

static const struct register_row i2c_rows[] = {
    {"IC_CON", 0x00, .start = 0x65, REGISTER_LIST(ic_con_fields), REGISTER_LIST(ic_off_when), I2C_SOURCE},
    {"IC_TAR", 0x04, .start = 0x55, REGISTER_LIST(ic_tar_fields), REGISTER_LIST(ic_off_when), I2C_SOURCE},
    {"IC_DATA_CMD", 0x10, .kind = REGISTER_COMMAND, .start = 0, REGISTER_LIST(ic_data_fields),
     REGISTER_LIST(ic_data_when), I2C_SOURCE},
    {"IC_FS_SCL_HCNT", 0x1c, .start = 6, REGISTER_LIST(ic_high_fields), REGISTER_LIST(ic_off_when), I2C_SOURCE},
    {"IC_FS_SCL_LCNT", 0x20, .start = 13, REGISTER_LIST(ic_low_fields), REGISTER_LIST(ic_off_when), I2C_SOURCE},
    {"IC_INTR_STAT", 0x2c, .kind = REGISTER_STATUS, .source = I2C_SOURCE},
    {"IC_INTR_MASK", 0x30, .start = 0x8ff, REGISTER_LIST(ic_mask_fields), .source = I2C_SOURCE},
    {"IC_TX_TL", 0x3c, .start = 0, REGISTER_LIST(ic_level_fields), .source = I2C_SOURCE},
    {"IC_CLR_TX_ABRT", 0x54, .kind = REGISTER_STATUS, .source = I2C_SOURCE},
    {"IC_ENABLE", 0x6c, .start = 0, REGISTER_LIST(bit_fields), REGISTER_LIST(ic_enable_when), I2C_SOURCE},
    {"IC_STATUS", 0x70, .kind = REGISTER_STATUS, .source = I2C_SOURCE},
    {"IC_SDA_HOLD", 0x7c, .start = 1, REGISTER_LIST(ic_hold_fields), REGISTER_LIST(ic_off_when), I2C_SOURCE},
    {"IC_FS_SPKLEN", 0xa0, .start = 7, REGISTER_LIST(ic_spike_fields), REGISTER_LIST(ic_off_when), I2C_SOURCE},
};

#endif
