#!/usr/bin/env bash
# The targets that tests/core/test_targets.sh leaves out; SHARE takes a share of them.
LONG=1 exec "$(dirname "$0")/test_targets.sh"
