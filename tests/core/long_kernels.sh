#!/usr/bin/env bash
# The broken loops that tests/core/test_kernels.sh leaves out; SHARE takes a share of them.
LONG=1 exec "$(dirname "$0")/test_kernels.sh"
