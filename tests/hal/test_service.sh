#!/usr/bin/env bash
# What systemd says of the unit: no word is unknown, and it is rated at most 2.0 of 10 (10: exposed). tests/guest/long_guest_service.sh
# runs it.
# shellcheck disable=SC2317 # functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
unit=boards/systemd/pinhole.service
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT

wrong_options_end_it() { grep -qx 'RestartPreventExitStatus=2' "$unit"; }

every_word_is_known() {
    sed 's|^ExecStart=.*|ExecStart=/bin/true|' "$unit" >"$dir/pinhole.service" && systemd-analyze verify --man=no "$dir/pinhole.service" >"$dir/said" 2>&1
    ! grep "pinhole.service" "$dir/said"
}

is_rated_at_most_2() { systemd-analyze security --offline=yes --threshold=20 --no-pager "$unit" >"$dir/rated" || { tail -n 1 "$dir/rated" && return 1; }; }

# The rating says something: without a word for the file system and the kernel it is above.
the_rating_can_fail() {
    grep -v '^Protect\|^SystemCall\|^Capability' "$unit" >"$dir/weak.service" &&
        ! systemd-analyze security --offline=yes --threshold=20 --no-pager "$dir/weak.service" >"$dir/rated"
}

check "exit 2, a wrong option, does not start it again" wrong_options_end_it
if command -v systemd-analyze >/dev/null && systemd-analyze security --help | grep -q -- --offline; then
    check "systemd knows every word of the unit" every_word_is_known
    check "the unit is rated at most 2.0" is_rated_at_most_2
    check "a weaker unit is rated above 2.0" the_rating_can_fail
else
    skip "the unit is rated at most 2.0" "no systemd-analyze that rates files"
fi
tap_end
