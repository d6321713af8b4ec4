/* A stand-in: the display is that of LovyanGFX.hpp. */
