#!/usr/bin/env bash
# The table of surfaces in tests/README.md says what the tests measure.
# shellcheck disable=SC2317 # functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh

the_table_is_what_is_measured() {
    local measured
    measured=$(tests/core/surfaces.sh) && diff <(awk '/^\| surface \|/ { inside = 1 } /^$/ { inside = 0 } inside' tests/README.md) - <<<"$measured"
}

check "the table of surfaces is what is measured" the_table_is_what_is_measured
tap_end
