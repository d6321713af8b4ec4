#!/usr/bin/env bash
# tests/firmware/test_rp2350_flash.sh with the flashes and boards that it leaves out.
exec env LONG=1 "$(dirname "$0")/test_rp2350_flash.sh"
