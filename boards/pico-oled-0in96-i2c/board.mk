PORT_BUS = i2c
include boards/families/pico.mk
