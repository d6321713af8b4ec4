/*
 * See sim_table.h. Controllers with MIPI DBI type C option 3, on the 4-line serial interface: every register below may
 * be written asleep and awake ("Register Availability" of each section).
 *
 * GC9A01's, ILI9488's and HX8357D's registers for voltages and gamma are taken as fixed bytes, those that the makers of
 * modules publish.
 */
#include "sim_rows.h"

/* clang-format off */
static const struct sim_command common[] = {
    {0x00, 0, 0, false, "NOP", BARE},
    {0x01, 0, 0, false, "SWRESET", BARE},
    {0x10, 0, 0, false, "SLPIN", BARE},
    {0x11, 0, 0, false, "SLPOUT", BARE},
    {0x13, 0, 0, false, "NORON", BARE},
    {0x20, 0, 0, false, "INVOFF", BARE},
    {0x21, 0, 0, false, "INVON", BARE},
    {0x28, 0, 0, false, "DISPOFF", BARE},
    {0x29, 0, 0, false, "DISPON", BARE},
    {0x2A, 4, 4, false, "CASET", FIELDS(
        {1, 4, 0xFF, 0x00, 0xFF, SIM_SHOWN,   "first and last column; a memory write checks them"})},
    {0x2B, 4, 4, false, "RASET", FIELDS(
        {1, 4, 0xFF, 0x00, 0xFF, SIM_SHOWN,   "first and last row; a memory write checks them"})},
    {0x2C, SIM_PIXELS, SIM_PIXELS, false, "RAMWR", BARE},
    {0x34, 0, 0, false, "TEOFF", BARE},
    {0x35, 1, 1, false, "TEON", FIELDS(
        {1, 1, 0x01, 0x00, 0x01, SIM_UNUSED,  "M: which blanking the TE pin tells"})},
};

/* All controllers here have these bits. ML and MH turn the order of refreshing, which turns no picture. */
#define MADCTL(name)                                                                                                   \
    {0x36, 1, 1, false, name, FIELDS(                                                                                  \
        {1, 1, 0xE0, 0x00, 0xE0, SIM_SHOWN,   "MY MX MV: the way of the address"},                                     \
        {1, 1, 0x08, 0x00, 0x08, SIM_SHOWN,   "RGB/BGR: order of the colours"},                                        \
        {1, 1, 0x14, 0x00, 0x14, SIM_TIMING,  "ML MH: order of refreshing"})}

/* ---- ST7789 ------------------------------------------------------------------------------------- */

/* Sections of ST7789V's data sheet, v1.3. That of ST7789VW, v1.0, which hal/panel cites, has two more registers before
 * LCMCTRL. */

/* ST7789V 9.2.24 and 9.2.25, ST7796S 9.3.18 and 9.3.19: each voltage V0 .. V63 of the curve, and J0, J1, which bend
 * it. */
#define SITRONIX_GAMMA                                                                                                   \
        {1,  1,  0xFF, 0x00, 0xFF, SIM_VOLTAGE, "V63 V0"},                                                             \
        {2,  3,  0x3F, 0x00, 0x3F, SIM_VOLTAGE, "V1, V2"},                                                             \
        {4,  5,  0x1F, 0x00, 0x1F, SIM_VOLTAGE, "V4, V6"},                                                             \
        {6,  6,  0x3F, 0x00, 0x3F, SIM_VOLTAGE, "J0 V13"},                                                             \
        {7,  7,  0x7F, 0x00, 0x7F, SIM_VOLTAGE, "V20"},                                                                \
        {8,  8,  0x77, 0x00, 0x77, SIM_VOLTAGE, "V36 V27"},                                                            \
        {9,  9,  0x7F, 0x00, 0x7F, SIM_VOLTAGE, "V43"},                                                                \
        {10, 10, 0x3F, 0x00, 0x3F, SIM_VOLTAGE, "J1 V50"},                                                             \
        {11, 12, 0x1F, 0x00, 0x1F, SIM_VOLTAGE, "V57, V59"},                                                           \
        {13, 14, 0x3F, 0x00, 0x3F, SIM_VOLTAGE, "V61, V62"}

static const struct sim_command st7789[] = {
    MADCTL("MADCTL 9.1.28"),
    {0x26, 1, 1, false, "GAMSET 9.1.17", FIELDS(
        {1, 1, 0x0F, 0x01, 0x01, SIM_FIXED,   "GC: curve 1; the model follows no other"})},
    {0x3A, 1, 1, false, "COLMOD 9.1.32", FIELDS(
        {1, 1, 0x70, 0x50, 0x60, SIM_UNUSED,  "format of the RGB interface"},
        {1, 1, 0x07, 0x03, 0x06, SIM_SHOWN,   "format: 12, 16 or 18 bits a pixel"})},
    {0x3C, SIM_PIXELS, SIM_PIXELS, false, "WRMEMC 9.1.33", BARE},
    {0xB0, 2, 2, false, "RAMCTRL 9.2.1", FIELDS(
        {1, 1, 0x13, 0x00, 0x00, SIM_FIXED,   "RM DM: memory and display by this interface"},
        {2, 2, 0xC0, 0xC0, 0xC0, SIM_FIXED,   "1 1"},
        {2, 2, 0x30, 0x00, 0x30, SIM_SHOWN,   "EPF: lowest bit of red and blue"},
        {2, 2, 0x08, 0x00, 0x08, SIM_SHOWN,   "ENDIAN: low byte first"},
        {2, 2, 0x04, 0x00, 0x04, SIM_UNUSED,  "RIM: width of the RGB interface"},
        {2, 2, 0x03, 0x00, 0x03, SIM_UNUSED,  "MDT: pixels on 9 and 16 lines (8.8)"})},
    {0xB2, 5, 5, false, "PORCTRL 9.2.3", FIELDS(
        {1, 2, 0x7F, 0x01, 0x7F, SIM_TIMING,  "BPA, FPA: porches"},
        {3, 3, 0x01, 0x00, 0x01, SIM_TIMING,  "PSEN: other porches in idle and partial mode"},
        {4, 5, 0xF0, 0x10, 0xF0, SIM_UNUSED,  "BPB, BPC: idle and partial mode"},
        {4, 5, 0x0F, 0x01, 0x0F, SIM_UNUSED,  "FPB, FPC: idle and partial mode"})},
    {0xB7, 1, 1, false, "GCTRL 9.2.6", FIELDS(
        {1, 1, 0x70, 0x00, 0x70, SIM_VOLTAGE, "VGHS: 12.2 .. 14.97 V"},
        {1, 1, 0x07, 0x00, 0x07, SIM_VOLTAGE, "VGLS: -7.16 .. -12.5 V"})},
    {0xBB, 1, 1, false, "VCOMS 9.2.9", FIELDS(
        {1, 1, 0x3F, 0x00, 0x3F, SIM_VOLTAGE, "VCOMS: 0.1 V + 25 mV n"})},
    {0xC0, 1, 1, false, "LCMCTRL 9.2.10", FIELDS( /* 2Ch after reset; a glass is described as it is with that */
        {1, 1, 0x40, 0x00, 0x40, SIM_SHOWN,   "XMY: turns MY over"},
        {1, 1, 0x20, 0x00, 0x20, SIM_SHOWN,   "XBGR: turns RGB/BGR over"},
        {1, 1, 0x10, 0x00, 0x10, SIM_SHOWN,   "XINV: turns the inversion over"},
        {1, 1, 0x08, 0x00, 0x08, SIM_SHOWN,   "XMX: turns MX over"},
        {1, 1, 0x04, 0x00, 0x04, SIM_UNUSED,  "XMH: for the RGB interface without memory"},
        {1, 1, 0x02, 0x00, 0x02, SIM_SHOWN,   "XMV: turns MV over"},
        {1, 1, 0x01, 0x00, 0x01, SIM_SHOWN,   "XGS: turns GS of E4h over"})},
    {0xC2, 2, 2, false, "VDVVRHEN 9.2.12", FIELDS(
        {1, 1, 0x01, 0x00, 0x01, SIM_VOLTAGE, "CMDEN: VDV and VRH as commanded"},
        {2, 2, 0xFF, 0xFF, 0xFF, SIM_FIXED,   "FFh"})},
    {0xC3, 1, 1, false, "VRHS 9.2.13", FIELDS(
        {1, 1, 0x3F, 0x00, 0x27, SIM_VOLTAGE, "VRHS: highest level of the curve"})},
    {0xC4, 1, 1, false, "VDVS 9.2.14", FIELDS(
        {1, 1, 0x3F, 0x00, 0x3F, SIM_VOLTAGE, "VDVS: middle of the curve"})},
    {0xC6, 1, 1, false, "FRCTRL2 9.2.16", FIELDS(
        {1, 1, 0xE0, 0x00, 0x00, SIM_FIXED,   "NLA: dot inversion of the polarity"},
        {1, 1, 0x1F, 0x00, 0x1F, SIM_TIMING,  "RTNA: 119 .. 39 frames a second"})},
    {0xD0, 2, 2, false, "PWCTRL1 9.2.21", FIELDS(
        {1, 1, 0xFF, 0xA4, 0xA4, SIM_FIXED,   "A4h"},
        {2, 2, 0xC0, 0x00, 0x80, SIM_VOLTAGE, "AVDD: 6.4 .. 6.8 V"},
        {2, 2, 0x30, 0x00, 0x30, SIM_VOLTAGE, "AVCL: -4.4 .. -5 V"},
        {2, 2, 0x03, 0x00, 0x03, SIM_VOLTAGE, "VDS: 2.19 .. 2.51 V"})},
    {0xE0, 14, 14, false, "PVGAMCTRL 9.2.24", FIELDS(SITRONIX_GAMMA)},
    {0xE1, 14, 14, false, "NVGAMCTRL 9.2.25", FIELDS(SITRONIX_GAMMA)},
    {0xE4, 3, 3, false, "GATECTRL 9.2.28", FIELDS(
        {1, 1, 0x3F, 0x00, 0x27, SIM_SHOWN,   "NL: 8 (n + 1) lines are driven"},
        {2, 2, 0x3F, 0x00, 0x00, SIM_FIXED,   "SCN: the first line; the model follows no other"},
        {3, 3, 0x10, 0x10, 0x10, SIM_FIXED,   "1"},
        {3, 3, 0x04, 0x00, 0x00, SIM_FIXED,   "SM: as the glass is bonded"},
        {3, 3, 0x01, 0x00, 0x01, SIM_SHOWN,   "GS: lines from the last one"})},
};

/* ---- GC9A01 ------------------------------------------------------------------------------------- */

/* Registers of levels 2 and 3 are refused until FEh and EFh came one after the other. The maker's bytes are those of
 * https://github.com/adafruit/Adafruit_GC9A01A and of the modules' other libraries, which are alike. */
static const struct sim_command gc9a01[] = {
    MADCTL("MADCTL 6.2"),
    {0x3A, 1, 1, false, "COLMOD 6.2.20", FIELDS(
        {1, 1, 0x70, 0x00, 0x70, SIM_UNUSED,  "format of the RGB interface"},
        {1, 1, 0x07, 0x03, 0x06, SIM_SHOWN,   "format: 12, 16 or 18 bits a pixel"})},
    {0x3C, SIM_PIXELS, SIM_PIXELS, false, "write memory continue 6.2", BARE},
    {0xFE, 0, 0, false, "inter register enable 1, 6.5", BARE},
    {0xEF, 0, 0, false, "inter register enable 2, 6.5", BARE},
    {0xB6, 2, 2, true, "display function control 6.3", FIELDS(
        {2, 2, 0x40, 0x00, 0x40, SIM_SHOWN,   "GS: lines from the last one"},
        {2, 2, 0x20, 0x00, 0x20, SIM_SHOWN,   "SS: columns from the last one"})},
    {0xC3, 1, 1, true, "VREG1a 6.4",                 BYTES(0x13)},
    {0xC4, 1, 1, true, "VREG1b 6.4",                 BYTES(0x13)},
    {0xC9, 1, 1, true, "VREG2a 6.4",                 BYTES(0x22)},
    {0xE8, 1, 1, true, "frame rate 6.3",             BYTES(0x34)},
    {0xF0, 6, 6, true, "gamma 1, 6.4",               BYTES(0x45, 0x09, 0x08, 0x08, 0x26, 0x2A)},
    {0xF1, 6, 6, true, "gamma 2, 6.4",               BYTES(0x43, 0x70, 0x72, 0x36, 0x37, 0x6F)},
    {0xF2, 6, 6, true, "gamma 3, 6.4",               BYTES(0x45, 0x09, 0x08, 0x08, 0x26, 0x2A)},
    {0xF3, 6, 6, true, "gamma 4, 6.4",               BYTES(0x43, 0x70, 0x72, 0x36, 0x37, 0x6F)},
    {0x62, 12, 12, true, "without a description",    BYTES(0x18, 0x0D, 0x71, 0xED, 0x70, 0x70, 0x18, 0x0F, 0x71, 0xEF, 0x70, 0x70)},
    {0x63, 12, 12, true, "without a description",    BYTES(0x18, 0x11, 0x71, 0xF1, 0x70, 0x70, 0x18, 0x13, 0x71, 0xF3, 0x70, 0x70)},
    {0x64, 7, 7, true, "without a description",      BYTES(0x28, 0x29, 0xF1, 0x01, 0xF1, 0x00, 0x07)},
    {0x66, 10, 10, true, "without a description",    BYTES(0x3C, 0x00, 0xCD, 0x67, 0x45, 0x45, 0x10, 0x00, 0x00, 0x00)},
    {0x67, 10, 10, true, "without a description",    BYTES(0x00, 0x3C, 0x00, 0x00, 0x00, 0x01, 0x54, 0x10, 0x32, 0x98)},
    {0x70, 9, 9, true, "without a description",      BYTES(0x07, 0x07, 0x04, 0x0E, 0x0F, 0x09, 0x07, 0x08, 0x03)},
    {0x74, 7, 7, true, "without a description",      BYTES(0x10, 0x85, 0x80, 0x00, 0x00, 0x4E, 0x00)},
    {0x84, 1, 1, true, "without a description",      BYTES(0x40)},
    {0x85, 1, 1, true, "without a description",      BYTES(0xFF)},
    {0x86, 1, 1, true, "without a description",      BYTES(0xFF)},
    {0x87, 1, 1, true, "without a description",      BYTES(0xFF)},
    {0x88, 1, 1, true, "without a description",      BYTES(0x0A)},
    {0x89, 1, 1, true, "without a description",      BYTES(0x21)},
    {0x8A, 1, 1, true, "without a description",      BYTES(0x00)},
    {0x8B, 1, 1, true, "without a description",      BYTES(0x80)},
    {0x8C, 1, 1, true, "without a description",      BYTES(0x01)},
    {0x8D, 1, 1, true, "without a description",      BYTES(0x01)},
    {0x8E, 1, 1, true, "without a description",      BYTES(0xFF)},
    {0x8F, 1, 1, true, "without a description",      BYTES(0xFF)},
    {0x90, 4, 4, true, "without a description",      BYTES(0x08, 0x08, 0x08, 0x08)},
    {0x98, 2, 2, true, "without a description",      BYTES(0x3E, 0x07)},
    {0xAE, 1, 1, true, "without a description",      BYTES(0x77)},
    {0xBC, 1, 1, true, "without a description",      BYTES(0x00)},
    {0xBD, 1, 1, true, "without a description",      BYTES(0x06)},
    {0xBE, 1, 1, true, "without a description",      BYTES(0x11)},
    {0xCD, 1, 1, true, "without a description",      BYTES(0x63)},
    {0xDF, 3, 3, true, "without a description",      BYTES(0x21, 0x0C, 0x02)},
    {0xE1, 2, 2, true, "without a description",      BYTES(0x10, 0x0E)},
    {0xEB, 1, 1, true, "without a description",      BYTES(0x14)},
    {0xED, 2, 2, true, "without a description",      BYTES(0x1B, 0x0B)},
    {0xFF, 3, 3, true, "without a description",      BYTES(0x60, 0x01, 0x04)},
};

/* ---- ILI9341 ------------------------------------------------------------------------------------ */

/* 8.3.24: V63 at the first parameter, V0 at the last. 8.3.25 has the two halves of the eighth the other way round. */
#define ILI9341_GAMMA                                                                                                  \
        {1,  1,  0x0F, 0x00, 0x0F, SIM_VOLTAGE, "V63"},                                                                \
        {2,  3,  0x3F, 0x00, 0x3F, SIM_VOLTAGE, "V62, V61"},                                                           \
        {4,  4,  0x0F, 0x00, 0x0F, SIM_VOLTAGE, "V59"},                                                                \
        {5,  5,  0x1F, 0x00, 0x1F, SIM_VOLTAGE, "V57"},                                                                \
        {6,  6,  0x0F, 0x00, 0x0F, SIM_VOLTAGE, "V50"},                                                                \
        {7,  7,  0x7F, 0x00, 0x7F, SIM_VOLTAGE, "V43"},                                                                \
        {8,  8,  0xFF, 0x00, 0xFF, SIM_VOLTAGE, "V36 V27"},                                                            \
        {9,  9,  0x7F, 0x00, 0x7F, SIM_VOLTAGE, "V20"},                                                                \
        {10, 10, 0x0F, 0x00, 0x0F, SIM_VOLTAGE, "V13"},                                                                \
        {11, 11, 0x1F, 0x00, 0x1F, SIM_VOLTAGE, "V6"},                                                                 \
        {12, 12, 0x0F, 0x00, 0x0F, SIM_VOLTAGE, "V4"},                                                                 \
        {13, 14, 0x3F, 0x00, 0x3F, SIM_VOLTAGE, "V2, V1"},                                                             \
        {15, 15, 0x0F, 0x00, 0x0F, SIM_VOLTAGE, "V0"}

static const struct sim_command ili9341[] = {
    MADCTL("MADCTL 8.2.29"),
    {0x26, 1, 1, false, "GAMSET 8.2.17", FIELDS(
        {1, 1, 0xFF, 0x01, 0x01, SIM_FIXED,   "GC: curve 1, the only one"})},
    {0x3A, 1, 1, false, "COLMOD 8.2.33", FIELDS(
        {1, 1, 0x70, 0x00, 0x70, SIM_UNUSED,  "DPI: ignored without an RGB interface"},
        {1, 1, 0x07, 0x05, 0x06, SIM_SHOWN,   "DBI: 16 or 18 bits a pixel"})},
    {0x3C, SIM_PIXELS, SIM_PIXELS, false, "write memory continue 8.2.34", BARE},
    {0xB1, 2, 2, false, "FRMCTR1 8.3.2", FIELDS(
        {1, 1, 0x03, 0x00, 0x03, SIM_TIMING,  "DIVA: clock divided by 1 .. 8"},
        {2, 2, 0x1F, 0x10, 0x1F, SIM_TIMING,  "RTNA: 119 .. 61 frames a second"})},
    {0xB6, 3, 4, false, "DISCTRL 8.3.7", FIELDS(
        {1, 1, 0x04, 0x00, 0x00, SIM_FIXED,   "PTG: x1 is prohibited"},
        {1, 1, 0x08, 0x00, 0x08, SIM_UNUSED,  "PTG: scan of the area that partial mode leaves out"},
        {1, 1, 0x03, 0x00, 0x03, SIM_UNUSED,  "PT: output in that area"},
        {2, 2, 0x80, 0x00, 0x80, SIM_SHOWN,   "REV: liquid crystal is normally white"},
        {2, 2, 0x40, 0x00, 0x40, SIM_SHOWN,   "GS: lines from the last one"},
        {2, 2, 0x20, 0x00, 0x20, SIM_SHOWN,   "SS: columns from the last one"},
        {2, 2, 0x10, 0x00, 0x00, SIM_FIXED,   "SM: as the glass is bonded"},
        {2, 2, 0x0F, 0x00, 0x0F, SIM_UNUSED,  "ISC: interval of PTG's scan"},
        {3, 3, 0x3F, 0x00, 0x27, SIM_SHOWN,   "NL: 8 (n + 1) lines are driven"},
        {4, 4, 0x3F, 0x00, 0x3F, SIM_UNUSED,  "PCDIV: clock of the RGB interface"})},
    {0xC0, 1, 1, false, "PWCTRL1 8.3.16", FIELDS(
        {1, 1, 0x3F, 0x03, 0x3F, SIM_VOLTAGE, "VRH: GVDD 3 V and more"})},
    {0xC1, 1, 1, false, "PWCTRL2 8.3.17", FIELDS(
        {1, 1, 0x10, 0x10, 0x10, SIM_FIXED,   "1, as after reset"},
        {1, 1, 0x07, 0x00, 0x03, SIM_VOLTAGE, "BT: factors of VGH and VGL"})},
    {0xC5, 2, 2, false, "VMCTRL1 8.3.18", FIELDS(
        {1, 1, 0x7F, 0x00, 0x7F, SIM_VOLTAGE, "VMH: 2.7 V + 25 mV n"},
        {2, 2, 0x7F, 0x00, 0x64, SIM_VOLTAGE, "VML: -2.5 V + 25 mV n"})},
    {0xC7, 1, 1, false, "VMCTRL2 8.3.19", FIELDS(
        {1, 1, 0xFF, 0x00, 0xFF, SIM_VOLTAGE, "nVM VMF: offset of both"})},
    {0xE0, 15, 15, false, "PGAMCTRL 8.3.24", FIELDS(ILI9341_GAMMA)},
    {0xE1, 15, 15, false, "NGAMCTRL 8.3.25", FIELDS(ILI9341_GAMMA)},
    {0xCB, 5, 5, false, "power control A 8.4.1", FIELDS(
        {1, 1, 0xFF, 0x39, 0x39, SIM_FIXED,   "39h"},
        {2, 2, 0xFF, 0x2C, 0x2C, SIM_FIXED,   "2Ch"},
        {3, 3, 0xFF, 0x00, 0x00, SIM_FIXED,   "00h"},
        {4, 4, 0xF8, 0x30, 0x30, SIM_FIXED,   "00110"},
        {4, 4, 0x07, 0x00, 0x05, SIM_VOLTAGE, "REG_VD: core 1.4 .. 1.7 V"},
        {5, 5, 0x07, 0x00, 0x06, SIM_VOLTAGE, "VBC: DDVDH 5.2 .. 5.8 V"})},
    {0xCF, 3, 3, false, "power control B 8.4.2", FIELDS(
        {1, 1, 0xFF, 0x00, 0x00, SIM_FIXED,   "00h"},
        {2, 2, 0x87, 0x81, 0x81, SIM_FIXED,   "1xxxx001"},
        {2, 2, 0x78, 0x00, 0x78, SIM_VOLTAGE, "PCEQ, DRV_ena, power control"},
        {3, 3, 0x20, 0x20, 0x20, SIM_FIXED,   "1"},
        {3, 3, 0xDF, 0x00, 0xDF, SIM_VOLTAGE, "DRV_vml, DC_ena, DRV_vmh"})},
    {0xE8, 3, 3, false, "driver timing control A 8.4.3", FIELDS(
        {1, 1, 0xFE, 0x84, 0x84, SIM_FIXED,   "1000010"},
        {1, 1, 0x01, 0x00, 0x01, SIM_TIMING,  "NOW: gate non-overlap"},
        {2, 2, 0x11, 0x00, 0x11, SIM_TIMING,  "EQ, CR"},
        {3, 3, 0xFC, 0x78, 0x78, SIM_FIXED,   "011110"},
        {3, 3, 0x03, 0x00, 0x02, SIM_TIMING,  "PC: pre-charge"})},
    {0xEA, 2, 2, false, "driver timing control B 8.4.5", FIELDS(
        {1, 1, 0xFF, 0x00, 0xFF, SIM_TIMING,  "VG_SW_T1 .. T4"})},
    {0xED, 4, 4, false, "power on sequence control 8.4.6", FIELDS(
        {1, 1, 0xCC, 0x44, 0x44, SIM_FIXED,   "x1..x1.., with x = 0"},
        {1, 1, 0x30, 0x00, 0x30, SIM_TIMING,  "CP1 soft start"},
        {1, 1, 0x03, 0x00, 0x03, SIM_TIMING,  "CP23 soft start"},
        {2, 2, 0x33, 0x00, 0x33, SIM_TIMING,  "En_vcl, En_ddvdh: in which frame"},
        {3, 3, 0x33, 0x00, 0x33, SIM_TIMING,  "En_vgh, En_vgl: in which frame"},
        {4, 4, 0x80, 0x00, 0x80, SIM_VOLTAGE, "DDVDH_ENH"},
        {4, 4, 0x7F, 0x01, 0x01, SIM_FIXED,   "0000001"})},
    {0xF2, 1, 1, false, "enable 3G 8.4.7", FIELDS(
        {1, 1, 0xFE, 0x02, 0x02, SIM_FIXED,   "0000001"},
        {1, 1, 0x01, 0x00, 0x00, SIM_FIXED,   "3G_enb: one gamma for all colours"})},
    {0xF7, 1, 1, false, "pump ratio control 8.4.8", FIELDS(
        {1, 1, 0x30, 0x20, 0x30, SIM_VOLTAGE, "ratio: DDVDH is 2 or 3 VCI"})},
};

/* ---- ILI9488 ------------------------------------------------------------------------------------ */

/* Sections are those of 5.2 and 5.3 of the data sheet. The fixed bytes are those of
 * https://github.com/Bodmer/TFT_eSPI (TFT_Drivers/ILI9488_Init.h) and of the modules' makers. */
static const struct sim_command ili9488[] = {
    MADCTL("MADCTL 5.2"),
    {0x3A, 1, 1, false, "COLMOD 5.2.34", FIELDS(
        {1, 1, 0x70, 0x00, 0x70, SIM_UNUSED,  "DPI: format of the RGB interface"},
        {1, 1, 0x07, 0x01, 0x06, SIM_SHOWN,   "DBI: 3 or 18 bits a pixel on the serial interface (4.7.2.2)"})},
    {0x3C, SIM_PIXELS, SIM_PIXELS, false, "write memory continue 5.2", BARE},
    {0xB0, 1, 1, false, "interface mode control 5.3", BYTES(0x00)},
    {0xB1, 1, 1, false, "frame rate control 5.3",     BYTES(0xA0)},
    {0xB4, 1, 1, false, "display inversion 5.3",      BYTES(0x02)},
    {0xB6, 3, 3, false, "display function control 5.3", FIELDS(
        {1, 1, 0xFF, 0x02, 0x02, SIM_FIXED,   "memory and display by this interface; PT 2"},
        {2, 2, 0x40, 0x00, 0x40, SIM_SHOWN,   "GS: lines from the last one"},
        {2, 2, 0x20, 0x00, 0x20, SIM_SHOWN,   "SS: columns from the last one"},
        {2, 2, 0x0F, 0x00, 0x0F, SIM_UNUSED,  "ISC: scan of the area that partial mode leaves out"},
        {3, 3, 0x3F, 0x00, 0x3B, SIM_SHOWN,   "NL: 8 (n + 1) lines are driven"})},
    {0xC0, 2, 2, false, "power control 1, 5.3",       BYTES(0x17, 0x15)},
    {0xC1, 1, 1, false, "power control 2, 5.3",       BYTES(0x41)},
    {0xC5, 3, 3, false, "VCOM control 5.3",           BYTES(0x00, 0x12, 0x80)},
    {0xE0, 15, 15, false, "PGAMCTRL 5.3", BYTES(0x00, 0x03, 0x09, 0x08, 0x16, 0x0A, 0x3F, 0x78, 0x4C, 0x09, 0x0A, 0x08, 0x16, 0x1A, 0x0F)},
    {0xE1, 15, 15, false, "NGAMCTRL 5.3", BYTES(0x00, 0x16, 0x19, 0x03, 0x0F, 0x05, 0x32, 0x45, 0x46, 0x04, 0x0E, 0x0D, 0x35, 0x37, 0x0F)},
    {0xE9, 1, 1, false, "set image function 5.3", FIELDS(
        {1, 1, 0x01, 0x00, 0x00, SIM_FIXED,   "DB_EN: 24 bits a pixel are for the parallel interface"})},
    {0xF7, 4, 4, false, "adjust control 3, 5.3",      BYTES(0xA9, 0x51, 0x2C, 0x82)},
};

/* ---- ST7796S ------------------------------------------------------------------------------------ */

/*
 * "Command table 2" (9.3) is locked after reset: F0h C3h opens its part I, F0h 96h its part II, F0h 3Ch and 69h close
 * them. The data sheet does not say which part has which command, so the model wants both. Commands that program the
 * chip's NVM (D0h, D1h) are not here, nor the digital gamma (E2h, E3h).
 */
static const struct sim_command st7796[] = {
    MADCTL("MADCTL 9.2.28"),
    {0x3A, 1, 1, false, "COLMOD 9.2.32", FIELDS(
        {1, 1, 0x70, 0x50, 0x60, SIM_UNUSED,  "format of the RGB interface"},
        {1, 1, 0x07, 0x05, 0x06, SIM_SHOWN,   "format: 16 or 18 bits a pixel (8.4.2.3)"})},
    {0x3C, SIM_PIXELS, SIM_PIXELS, false, "WRMEMC 9.2.33", BARE},
    {0xB0, 1, 1, true, "IFMODE 9.3.1", FIELDS(
        {1, 1, 0x80, 0x00, 0x80, SIM_UNUSED,  "SPI_EN: the line of data back"},
        {1, 1, 0x0F, 0x00, 0x0F, SIM_UNUSED,  "VSCP HSCP PKP DEP: polarities of the RGB interface"})},
    {0xB1, 2, 2, true, "FRMCTR1 9.3.2", FIELDS(
        {1, 1, 0xF0, 0x00, 0xF0, SIM_TIMING,  "FRS: frame rate"},
        {1, 1, 0x03, 0x00, 0x03, SIM_TIMING,  "DIVA: clock divided by 1 .. 8"},
        {2, 2, 0x1F, 0x00, 0x1F, SIM_TIMING,  "RTNA: length of a line"})},
    {0xB2, 2, 2, true, "FRMCTR2 9.3.3", FIELDS(
        {2, 2, 0x1F, 0x00, 0x1F, SIM_UNUSED,  "RTNB: idle mode"})},
    {0xB3, 2, 2, true, "FRMCTR3 9.3.4", FIELDS(
        {2, 2, 0x1F, 0x00, 0x1F, SIM_UNUSED,  "RTNC: partial mode"})},
    {0xB4, 1, 1, true, "DIC 9.3.5", FIELDS(
        {1, 1, 0x03, 0x00, 0x02, SIM_TIMING,  "DINV: polarity by columns, by 1 or by 2 dots"})},
    {0xB5, 4, 4, true, "BPC 9.3.6", FIELDS(
        {1, 2, 0xFF, 0x02, 0xFF, SIM_TIMING,  "VFP, VBP: porches of 2 lines or more"},
        {4, 4, 0xFF, 0x02, 0xFF, SIM_UNUSED,  "HBP: porch of the RGB interface"})},
    {0xB6, 3, 3, true, "DFC 9.3.7", FIELDS(
        {1, 1, 0xC0, 0x00, 0xC0, SIM_UNUSED,  "BYPASS RCM: for the RGB interface"},
        {1, 1, 0x20, 0x00, 0x00, SIM_FIXED,   "RM: memory by this interface"},
        {1, 1, 0x04, 0x00, 0x00, SIM_FIXED,   "PTG: x1 is prohibited"},
        {1, 1, 0x08, 0x00, 0x08, SIM_UNUSED,  "PTG: scan of the area that partial mode leaves out"},
        {1, 1, 0x03, 0x00, 0x01, SIM_UNUSED,  "PT: output in that area"},
        {2, 2, 0x40, 0x00, 0x40, SIM_SHOWN,   "GS: lines from the last one"},
        {2, 2, 0x20, 0x00, 0x20, SIM_SHOWN,   "SS: columns from the last one"},
        {2, 2, 0x10, 0x00, 0x00, SIM_FIXED,   "SM: as the glass is bonded"},
        {2, 2, 0x0F, 0x00, 0x0F, SIM_UNUSED,  "ISC: interval of PTG's scan"},
        {3, 3, 0x3F, 0x00, 0x3B, SIM_SHOWN,   "NL: 8 (n + 1) lines are driven"})},
    {0xB7, 1, 1, true, "EM 9.3.8", FIELDS(
        {1, 1, 0xC0, 0x00, 0xC0, SIM_SHOWN,   "EPF: lowest bit of red and blue"},
        {1, 1, 0x08, 0x00, 0x00, SIM_FIXED,   "DSTB: no deep standby"},
        {1, 1, 0x06, 0x06, 0x06, SIM_FIXED,   "GON DTE: gates as in normal display"})},
    {0xC0, 2, 2, true, "PWR1 9.3.9", FIELDS(
        {1, 1, 0xC0, 0x00, 0xC0, SIM_VOLTAGE, "AVDDS: 6.2 .. 6.8 V"},
        {1, 1, 0x30, 0x00, 0x30, SIM_VOLTAGE, "AVCLS: -4.4 V and less"},
        {2, 2, 0x70, 0x00, 0x70, SIM_VOLTAGE, "VGHS: 12.5 .. 15.5 V"},
        {2, 2, 0x07, 0x00, 0x07, SIM_VOLTAGE, "VGLS: -7.2 .. -12.5 V"})},
    {0xC1, 1, 1, true, "PWR2 9.3.10", FIELDS(
        {1, 1, 0x7F, 0x00, 0x27, SIM_VOLTAGE, "VRH: 3.55 V + 50 mV n; 28h and more are reserved"})},
    {0xC2, 1, 1, true, "PWR3 9.3.11", FIELDS(
        {1, 1, 0x0C, 0x04, 0x0C, SIM_VOLTAGE, "SOP: current of the source; 0 is no operation"},
        {1, 1, 0x03, 0x01, 0x03, SIM_VOLTAGE, "GOP: current of the gamma; 0 is no operation"})},
    {0xC5, 1, 1, true, "VCMPCTL 9.3.12", FIELDS(
        {1, 1, 0x3F, 0x00, 0x3F, SIM_VOLTAGE, "VCMP: 0.3 V + 25 mV n"})},
    {0xC6, 1, 1, true, "VCM offset 9.3.13", FIELDS(
        {1, 1, 0xBF, 0x00, 0xBF, SIM_VOLTAGE, "VMFSEL, VMF_REG: offset of VCMP"})},
    {0xE0, 14, 14, true, "PGC 9.3.18", FIELDS(SITRONIX_GAMMA)},
    {0xE1, 14, 14, true, "NGC 9.3.19", FIELDS(SITRONIX_GAMMA)},
    {0xE8, 8, 8, true, "DOCA 9.3.22", FIELDS(
        {1, 1, 0xFF, 0x40, 0x40, SIM_FIXED,   "40h"},
        {2, 2, 0xFF, 0x8A, 0x8A, SIM_FIXED,   "8Ah"},
        {3, 4, 0xFF, 0x00, 0x00, SIM_FIXED,   "00h"},
        {5, 5, 0xF0, 0x20, 0x20, SIM_FIXED,   "0010"},
        {5, 5, 0x0F, 0x00, 0x0F, SIM_TIMING,  "S_END: equalizing of the source"},
        {6, 6, 0x3F, 0x00, 0x3F, SIM_TIMING,  "G_START: gate from"},
        {7, 7, 0x80, 0x00, 0x80, SIM_TIMING,  "G_EQ: equalizing of the gates"},
        {7, 7, 0x3F, 0x00, 0x3F, SIM_TIMING,  "G_END: gate to"},
        {8, 8, 0xFF, 0x33, 0x33, SIM_FIXED,   "33h"})},
    {0xF0, 1, 1, false, "CSCON 9.3.23", FIELDS( /* C3h, 96h, 3Ch, 69h; see command_set() in sim_dbi.c */
        {1, 1, 0xFF, 0x3C, 0xC3, SIM_SHOWN,   "opens and closes command table 2"})},
    {0xFB, 1, 1, true, "SPIRC 9.3.24", FIELDS(
        {1, 1, 0x1F, 0x00, 0x1F, SIM_UNUSED,  "SPI_REN SPI_CNT: reading back"})},
};

/* ---- ILI9486 behind a shift register ------------------------------------------------------------ */

/* The fixed bytes are those of Linux' drivers/gpu/drm/tiny/ili9486.c. */
static const struct sim_command ili9486[] = {
    MADCTL("MADCTL"),
    {0x3A, 1, 1, false, "COLMOD", FIELDS(
        {1, 1, 0x70, 0x50, 0x60, SIM_UNUSED,  "DPI: format of the RGB interface"},
        {1, 1, 0x07, 0x05, 0x05, SIM_FIXED,   "DBI: 16 bits a pixel, which are one word"})},
    {0x3C, SIM_PIXELS, SIM_PIXELS, false, "write memory continue", BARE},
    {0xB0, 1, 1, false, "interface mode control", BYTES(0x00)},
    {0xC2, 1, 1, false, "power control 3",        BYTES(0x44)},
    {0xC5, 4, 4, false, "VCOM control",           BYTES(0x00, 0x00, 0x00, 0x00)},
    {0xE0, 15, 15, false, "PGAMCTRL", BYTES(0x0F, 0x1F, 0x1C, 0x0C, 0x0F, 0x08, 0x48, 0x98, 0x37, 0x0A, 0x13, 0x04, 0x11, 0x0D, 0x00)},
    {0xE1, 15, 15, false, "NGAMCTRL", BYTES(0x0F, 0x32, 0x2E, 0x0B, 0x0D, 0x05, 0x47, 0x75, 0x37, 0x06, 0x10, 0x03, 0x24, 0x20, 0x00)},
};

/* ---- HX8357D ------------------------------------------------------------------------------------ */

/* SETEXTC opens the commands from B0h on. The bytes are those of Adafruit's Adafruit_HX8357.cpp, which says of SETPANEL
 * that 05h exchanges red and blue and begins with the last line: without it the glass shows what is stored without
 * that. */
static const struct sim_command hx8357d[] = {
    MADCTL("set_address_mode"),
    {0x3A, 1, 1, false, "set_pixel_format", FIELDS(
        {1, 1, 0x70, 0x00, 0x70, SIM_UNUSED,  "format of the RGB interface"},
        {1, 1, 0x07, 0x05, 0x06, SIM_SHOWN,   "format: 16 or 18 bits a pixel"})},
    {0x3C, SIM_PIXELS, SIM_PIXELS, false, "write_memory_continue", BARE},
    {0xB0, 1, 1, true, "SETOSC",     BYTES(0x68)},
    {0xB1, 6, 6, true, "SETPOWER",   BYTES(0x00, 0x15, 0x1C, 0x1C, 0x83, 0xAA)},
    {0xB3, 4, 4, true, "SETRGB",     BYTES(0x00, 0x00, 0x06, 0x06)},
    {0xB4, 7, 7, true, "SETCYC",     BYTES(0x02, 0x40, 0x00, 0x2A, 0x2A, 0x0D, 0x78)},
    {0xB6, 1, 1, true, "SETCOM",     BYTES(0x25)},
    {0xB9, 3, 3, false, "SETEXTC",   BYTES(0xFF, 0x83, 0x57)},
    {0xC0, 6, 6, true, "SETSTBA",    BYTES(0x50, 0x50, 0x01, 0x3C, 0x1E, 0x08)},
    {0xCC, 1, 1, true, "SETPANEL",   BYTES(0x05)},
    {0xE0, 34, 34, true, "SETGAMMA", BYTES(0x02, 0x0A, 0x11, 0x1D, 0x23, 0x35, 0x41, 0x4B, 0x4B, 0x42, 0x3A, 0x27, 0x1B, 0x08,
        0x09, 0x03, 0x02, 0x0A, 0x11, 0x1D, 0x23, 0x35, 0x41, 0x4B, 0x4B, 0x42, 0x3A, 0x27, 0x1B, 0x08, 0x09, 0x03, 0x00, 0x01)},
};

/* ---- ST7735S ------------------------------------------------------------------------------------ */

/* Red, green and blue of 4, 5 and 6 bits become 6 by a table (9.18) that RGBSET would fill. No driver is known that
 * does; the model takes what modules show: the highest bits are repeated. */
static const struct sim_command st7735s[] = {
    MADCTL("MADCTL 10.1.29"),
    {0x26, 1, 1, false, "GAMSET 10.1.17", FIELDS(
        {1, 1, 0x0F, 0x01, 0x01, SIM_FIXED,   "GC: curve 1; the model follows no other"})},
    {0x3A, 1, 1, false, "COLMOD 10.1.33", FIELDS(
        {1, 1, 0x70, 0x00, 0x70, SIM_UNUSED,  "VIPF: format of the RGB interface"},
        {1, 1, 0x07, 0x03, 0x06, SIM_SHOWN,   "IFPF: 12, 16 or 18 bits a pixel"})},
    {0xB1, 3, 3, false, "FRMCTR1 10.2.1", FIELDS(
        {1, 1, 0x0F, 0x00, 0x0F, SIM_TIMING,  "RTNA: length of a line"},
        {2, 3, 0x3F, 0x01, 0x3F, SIM_TIMING,  "FPA, BPA: porches, more than 0"})},
    {0xB2, 3, 3, false, "FRMCTR2 10.2.2", FIELDS(
        {1, 1, 0x0F, 0x00, 0x0F, SIM_UNUSED,  "RTNB: idle mode"},
        {2, 3, 0x3F, 0x01, 0x3F, SIM_UNUSED,  "FPB, BPB: idle mode"})},
    {0xB3, 6, 6, false, "FRMCTR3 10.2.3", FIELDS(
        {1, 1, 0x0F, 0x00, 0x0F, SIM_UNUSED,  "RTNC: partial mode"},
        {2, 3, 0x3F, 0x01, 0x3F, SIM_UNUSED,  "FPC, BPC: partial mode"},
        {4, 4, 0x0F, 0x00, 0x0F, SIM_UNUSED,  "RTND: partial mode"},
        {5, 6, 0x3F, 0x01, 0x3F, SIM_UNUSED,  "FPD, BPD: partial mode"})},
    {0xB4, 1, 1, false, "INVCTR 10.2.4", FIELDS(
        {1, 1, 0x04, 0x00, 0x04, SIM_TIMING,  "NLA: polarity by dots or columns"},
        {1, 1, 0x03, 0x00, 0x03, SIM_UNUSED,  "NLB NLC: idle and partial mode"})},
    {0xC0, 3, 3, false, "PWCTR1 10.2.5", FIELDS(
        {1, 1, 0xE0, 0x00, 0xE0, SIM_VOLTAGE, "AVDD: 4.5 .. 5.2 V"},
        {1, 1, 0x1F, 0x00, 0x1F, SIM_VOLTAGE, "VRHP: GVDD"},
        {2, 2, 0x1F, 0x00, 0x1F, SIM_VOLTAGE, "VRHN: GVCL"},
        {3, 3, 0x40, 0x00, 0x00, SIM_FIXED,   "MODE: x1 is reserved"},
        {3, 3, 0x80, 0x00, 0x80, SIM_VOLTAGE, "MODE: pump 2 times or by itself"},
        {3, 3, 0x04, 0x04, 0x04, SIM_FIXED,   "1"},
        {3, 3, 0x03, 0x00, 0x03, SIM_VOLTAGE, "VRHN5 VRHP5"})},
    {0xC1, 1, 1, false, "PWCTR2 10.2.6", FIELDS(
        {1, 1, 0xC0, 0x00, 0xC0, SIM_VOLTAGE, "VGH25: 2.1 .. 2.4 V"},
        {1, 1, 0x0C, 0x00, 0x0C, SIM_VOLTAGE, "VGLSEL: -7.5 .. -13 V"},
        {1, 1, 0x03, 0x00, 0x02, SIM_VOLTAGE, "VGHBT: factor of AVDD"})},
    {0xC2, 2, 2, false, "PWCTR3 10.2.7", FIELDS(
        {1, 1, 0xC0, 0x00, 0xC0, SIM_VOLTAGE, "DCA9 DCA8: clock of the pump"},
        {1, 1, 0x38, 0x08, 0x28, SIM_VOLTAGE, "SAPA: current, not off"},
        {1, 1, 0x07, 0x01, 0x05, SIM_VOLTAGE, "APA: current, not off"},
        {2, 2, 0xFF, 0x00, 0xFF, SIM_VOLTAGE, "DCA: clock of the pump"})},
    {0xC3, 2, 2, false, "PWCTR4 10.2.8", FIELDS(
        {1, 2, 0xFF, 0x00, 0xFF, SIM_UNUSED,  "idle mode"})},
    {0xC4, 2, 2, false, "PWCTR5 10.2.9", FIELDS(
        {1, 2, 0xFF, 0x00, 0xFF, SIM_UNUSED,  "partial mode"})},
    {0xC5, 1, 1, false, "VMCTR1 10.2.10", FIELDS(
        {1, 1, 0x3F, 0x00, 0x3F, SIM_VOLTAGE, "VCOMS: -0.425 V - 25 mV n"})},
    {0xE0, 16, 16, false, "GMCTRP1 10.2.17", FIELDS(
        {1, 16, 0x3F, 0x00, 0x3F, SIM_VOLTAGE, "VRF0P .. SELV63P"})},
    {0xE1, 16, 16, false, "GMCTRN1 10.2.18", FIELDS(
        {1, 16, 0x3F, 0x00, 0x3F, SIM_VOLTAGE, "VRF0N .. SELV63N"})},
};
/* clang-format on */

#define WAITS(command, sleep) .command_wait_ms = (command), .sleep_wait_ms = (sleep)

const struct sim_table sim_table_dbi = {"MIPI DCS", LIST(common), WAITS(0, 0)};
const struct sim_table sim_table_st7789 = {"ST7789V, Sitronix, v1.3", LIST(st7789), WAITS(5, 120)};
const struct sim_table sim_table_gc9a01 = {"GC9A01A, GalaxyCore, v1.0", LIST(gc9a01), WAITS(5, 120)};
const struct sim_table sim_table_ili9341 = {"ILI9341, Ilitek, v1.11", LIST(ili9341), WAITS(5, 120)};
const struct sim_table sim_table_ili9488 = {"ILI9488, Ilitek, v1.00", LIST(ili9488), WAITS(5, 120)};
const struct sim_table sim_table_st7796 = {"ST7796S, Sitronix, v1.2", LIST(st7796), WAITS(5, 120)};
const struct sim_table sim_table_ili9486 = {"ILI9486, Ilitek; Linux' ili9486.c", LIST(ili9486), WAITS(5, 120)};
const struct sim_table sim_table_hx8357d = {"HX8357D, Himax; Adafruit", LIST(hx8357d), WAITS(5, 120)};
const struct sim_table sim_table_st7735s = {"ST7735S, Sitronix, v1.1", LIST(st7735s), WAITS(120, 120)};
