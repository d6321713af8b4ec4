#!/usr/bin/env bash
# The reports that tests/firmware/test_firmware_report.sh leaves out; SHARE takes a share of them.
LONG=1 exec "$(dirname "$0")/test_firmware_report.sh"
