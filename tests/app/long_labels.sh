#!/usr/bin/env bash
# tests/app/test_labels.c in every frame of every demo's cycle, on every kit.
cd "$(dirname "$0")/../.." || exit 1
B=${B:-build}
. tests/tools/tap.sh
check "labels_lie_on_nothing_that_is_drawn_in_any_frame_of_a_cycle" "$B/tests/app/test_labels" all
tap_end
