#!/usr/bin/env bash
# 1,000 scenes of two cores, and clang's sanitizer; SHARE takes a share of them.
LONG=1 exec "$(dirname "$0")/test_sanitizers.sh"
