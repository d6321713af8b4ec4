#!/usr/bin/env bash
# Images of every RP2350 board, for each instruction set, with one core and with two: see test_boot_rom_rp2350.sh.
LONG=1 exec "$(dirname "$0")/test_boot_rom_rp2350.sh"
