include boards/families/pico.mk
