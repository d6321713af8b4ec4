/*
 * registers_scs: the rows that the tables of Cortex-M3 and M4 chips share (registers/registers.h): SysTick, system
 * control and MPU, which start.c writes. Source: ARMv7-M Architecture Reference Manual, ARM DDI 0403E.
 */
#ifndef REGISTERS_SCS_H
#define REGISTERS_SCS_H

#include "registers/registers.h"

#define SCS_AT(offset) (0xE000E000u + (offset))

static const struct register_field scs_csr[] = {
    {"ENABLE", 0, 1, 0, 1, "SysTick counts"},
    {"TICKINT", 1, 1, 1, 1, "an interrupt each time that it reaches 0: the clock of hal.h"},
    {"CLKSOURCE", 2, 1, 1, 1, "it counts the CPU's clock; 0 is another one, which the port does not know"},
};
static const struct register_when scs_csr_when[] = {
    {1, 1, REGISTER_WRITTEN, SCS_AT(0x14),
     .why = "SysTick is turned on before RVR is written: it is unknown after a reset"},
    {1, 1, REGISTER_WRITTEN, SCS_AT(0x18),
     .why = "SysTick is turned on before CVR is written: it is unknown after a reset"},
};
static const struct register_field scs_rvr[] = {
    {"RELOAD", 0, 24, 1, 0xFFFFFF, "the clocks of a millisecond, less one"},
};
static const struct register_field scs_cvr[] = {
    {"CURRENT", 0, 32, 0, UINT32_MAX, "any write sets the counter to 0"},
};
static const struct register_field scs_vtor[] = {
    {"TBLOFF", 7, 25, 0, (1u << 25) - 1, "where the vectors lie; the ports have 16, so that a multiple of 128 will do"},
};
static const struct register_field scs_aircr[] = {
    {"SYSRESETREQ", 2, 1, 1, 1, "a reset: the boot loader is entered after it"},
    {"VECTKEY", 16, 16, 0x05FA, 0x05FA, "without it the write is ignored"},
};
static const struct register_field scs_shcsr[] = {
    {"MEMFAULTENA", 16, 1, 0, 1, "no pixel: a handler of its own for a fault"},
    {"BUSFAULTENA", 17, 1, 0, 1, "no pixel: a handler of its own for a fault"},
    {"USGFAULTENA", 18, 1, 0, 1, "no pixel: a handler of its own for a fault"},
};
static const struct register_field scs_mpu_ctrl[] = {
    {"PRIVDEFENA, HFNMIENA, ENABLE", 0, 3, 0, 0, "no MPU"},
    {"PRIVDEFENA, HFNMIENA, ENABLE", 0, 3, 5, 5, "the regions count, and all other memory is as without an MPU"},
};
static const struct register_when scs_mpu_ctrl_when[] = {
    {1, 1, REGISTER_WRITTEN, SCS_AT(0xDA0), .why = "the MPU is turned on before a region is set"},
};
static const struct register_field scs_mpu_rnr[] = {
    {"REGION", 0, 8, 0, 7, "which region RBAR and RASR set; the chips have 8"},
};
static const struct register_field scs_mpu_rbar[] = {
    {"ADDR", 7, 25, 0x20000000u >> 7, 0x2001FFFFu >> 7, "the guard below the stack: a multiple of its 128 bytes"},
};
static const struct register_field scs_mpu_rasr[] = {
    {"ENABLE", 0, 1, 1, 1, "the region counts"},
    {"SIZE", 1, 5, 6, 6, "128 bytes"},
};
static const struct register_when scs_mpu_region_when[] = {
    {0, 0, REGISTER_IS, SCS_AT(0xD94), 1, 0, .why = "a region is set while the MPU is on"},
    {0, 0, REGISTER_WRITTEN, SCS_AT(0xD98), .why = "RNR is unknown after a reset, and was not written"},
};

static const struct register_row scs_rows[] = {
    {"SYST_CSR", 0x10, .start = 4, .fields = scs_csr, .field_count = 3, .when = scs_csr_when, .when_count = 2,
     .source = "ARM DDI 0403E, B3.3.3"},
    {"SYST_RVR", 0x14, .fields = scs_rvr, .field_count = 1, .source = "ARM DDI 0403E, B3.3.4"},
    {"SYST_CVR", 0x18, .kind = REGISTER_COMMAND, .fields = scs_cvr, .field_count = 1,
     .source = "ARM DDI 0403E, B3.3.5"},
    {"ICSR", 0xD04, .kind = REGISTER_STATUS, .source = "ARM DDI 0403E, B3.2.4"},
    {"VTOR", 0xD08, .fields = scs_vtor, .field_count = 1, .source = "ARM DDI 0403E, B3.2.5"},
    {"AIRCR", 0xD0C, .kind = REGISTER_COMMAND, .fields = scs_aircr, .field_count = 2,
     .source = "ARM DDI 0403E, B3.2.6"},
    {"SHCSR", 0xD24, .fields = scs_shcsr, .field_count = 3, .source = "ARM DDI 0403E, B3.2.13"},
    {"CFSR", 0xD28, .kind = REGISTER_STATUS, .source = "ARM DDI 0403E, B3.2.15"},
    {"BFAR", 0xD38, .kind = REGISTER_STATUS, .source = "ARM DDI 0403E, B3.2.18"},
    {"MPU_CTRL", 0xD94, .fields = scs_mpu_ctrl, .field_count = 2, .when = scs_mpu_ctrl_when, .when_count = 1,
     .source = "ARM DDI 0403E, B3.5.5"},
    {"MPU_RNR", 0xD98, .fields = scs_mpu_rnr, .field_count = 1, .source = "ARM DDI 0403E, B3.5.7"},
    {"MPU_RBAR", 0xD9C, .fields = scs_mpu_rbar, .field_count = 1, .when = scs_mpu_region_when, .when_count = 2,
     .source = "ARM DDI 0403E, B3.5.8"},
    {"MPU_RASR", 0xDA0, .fields = scs_mpu_rasr, .field_count = 2, .when = scs_mpu_region_when, .when_count = 2,
     .source = "ARM DDI 0403E, B3.5.9"},
};

#define SCS_BLOCK                                                                                                      \
    {                                                                                                                  \
        "SCS", SCS_AT(0), 0x1000, .rows = scs_rows, .row_count = sizeof scs_rows / sizeof *scs_rows                    \
    }

#endif
