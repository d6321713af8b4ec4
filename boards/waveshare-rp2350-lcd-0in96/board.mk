include boards/families/pico2.mk
