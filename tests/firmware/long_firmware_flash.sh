#!/usr/bin/env bash
# The chips and the faults that test_firmware_flash.sh leaves out; SHARE takes a share of them.
LONG=1 exec "$(dirname "$0")/test_firmware_flash.sh"
