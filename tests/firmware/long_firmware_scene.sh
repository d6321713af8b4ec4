#!/usr/bin/env bash
# test_firmware_scene.sh on both chips, with a write that is interrupted at 100 random moments.
cd "$(dirname "$0")/../.." || exit 1
export MOMENTS=100
CHIP=rp2350 tests/firmware/test_firmware_scene.sh
first=$?
CHIP=rp2040 tests/firmware/test_firmware_scene.sh && exit $first
