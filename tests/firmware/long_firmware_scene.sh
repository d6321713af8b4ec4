#!/usr/bin/env bash
# test_firmware_scene.sh with a write that is interrupted at 100 random moments.
MOMENTS=100 exec "$(dirname "$0")/test_firmware_scene.sh"
