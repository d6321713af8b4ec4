/*
 * See sim_model.h: what a controller takes from an I2C bus (SSD1306 8.1.5; SH1106, "I2C-bus interface"). A message is a
 * start, the address 3Ch with a 0 for writing, then control bytes and what follows them: with Co (bit 7) one byte, else
 * all up to the stop. Bit 6 of a control byte is D/C; the others are 0.
 */
#include "sim_model.h"

enum { ADDRESS = 0x3C, CONTINUED = 0x80, IS_DATA = 0x40 };

void sim_i2c_start(struct sim *sim)
{
    sim->i2c = (struct sim_i2c){.expects = SIM_I2C_ADDRESS};
}

bool sim_i2c_byte(struct sim *sim, uint8_t byte)
{
    struct sim_i2c *i2c = &sim->i2c;
    switch (i2c->expects) {
    case SIM_I2C_ADDRESS:
        i2c->expects = sim->glass.model->i2c_hz != 0 && byte == ADDRESS << 1 ? SIM_I2C_CONTROL : SIM_I2C_STOP;
        break;
    case SIM_I2C_CONTROL:
        if ((byte & ~(CONTINUED | IS_DATA)) != 0) {
            sim_complain(sim, SIM_BAD_PARAMETER, "control byte %02Xh: bits 3Fh must be 0", byte);
        }
        i2c->dc = (byte & IS_DATA) != 0 ? HAL_DATA : HAL_COMMAND;
        i2c->continued = (byte & CONTINUED) != 0;
        i2c->expects = SIM_I2C_BYTE;
        break;
    case SIM_I2C_BYTE:
        sim_take_byte(sim, i2c->dc, byte);
        i2c->expects = i2c->continued ? SIM_I2C_CONTROL : SIM_I2C_BYTE;
        break;
    case SIM_I2C_STOP: /* somebody else's message */
        break;
    }
    return i2c->expects != SIM_I2C_STOP;
}
