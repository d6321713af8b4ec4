#!/usr/bin/env bash
# As tests/firmware/test_firmware_scene.sh, for an emulated RP2350.
cd "$(dirname "$0")/../.." || exit 1
SCENE_BOARD=pico2-display CHIP=rp2350 exec tests/firmware/test_firmware_scene.sh
