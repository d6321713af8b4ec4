#!/usr/bin/env bash
# The checks that tests/host-sim/test_window.sh leaves out; SHARE takes a share of them.
LONG=1 exec "$(dirname "$0")/test_window.sh"
