#!/usr/bin/env bash
# The README's two commands on a bare machine: Debian 12 and 13 with gcc, make, libc6-dev and git, and nothing else.
# `make test` in such a root takes as long as here, and first fetches what it needs, and what runs under load holds up all
# else: only the whole of the long tests has these, SHARE leaves them out. By hand, one of them: SUITES=trixie
# tests/tools/long_bare.sh
# shellcheck disable=SC2317,SC2016 # functions are called by check; the inner shell's variables
set -u
cd "$(dirname "$0")/../.." || exit 1
unset MAKEFLAGS
. tests/tools/tap.sh
. tests/debian13/root.sh
why=$(debian_cannot)
[ -z "$why" ] || { skip "Pinhole on a bare machine" "$why" && tap_end; }
mkdir -p "$B/bare"
dir=$(mktemp -d "$B/bare/XXXXXX") && dir=$(realpath "$dir") || exit 1
trap 'rm -rf "$dir"' EXIT

root_is_made() { # suite
    mkdir "$dir/sources-$1" && debian_sources "$1" "$dir/sources-$1" &&
        { mmdebstrap --variant=minbase --include=gcc,make,libc6-dev,git --dpkgopt=force-unsafe-io --aptopt='APT::Install-Recommends "false"' \
            "$1" "$dir/$1" "$dir/sources-$1"/* >"$dir/log" 2>&1 </dev/null || { tail -n 20 "$dir/log" && return 1; }; } &&
        debian_copy "$dir/$1"
}

bare() { debian_run "$dir/$suite" "$@"; }

demo_is_drawn() { bare make demo && [ "$(find "$dir/$suite/pinhole/build/demo" -name '*.ppm' -size +8k | wc -l)" -gt 30 ]; }

nothing_failed() { # at least so many passed
    tee "$dir/log" | tail -n 20
    grep -A 20 '^FAIL' "$dir/log"
    tail -n 1 "$dir/log" | awk -v least="$1" '{ exit !($1 >= least && $2 == "passed," && $3 == 0) }'
}

check_is_green() { bare make check 2>&1 | nothing_failed 700; }

# Eight loops, half the usual files and stack.
under_load() { bare bash -c 'ulimit -n 512 -s 4096 && for i in 1 2 3 4 5 6 7 8; do while :; do :; done & done; "$@" 2>&1' - "$@"; }

test_passes() { # command to run make with
    "$@" make test 2>&1 | nothing_failed 2000 && grep -q '^packages: [0-9]* are missing: ' "$dir/log" && grep -q '^packages: Need to get' "$dir/log"
}

whole() { [ "${SHARE:-1/1}" != 1/1 ] || check "$@"; }

for suite in ${SUITES:-bookworm trixie}; do
    in_share || continue
    check "a_bare_${suite}_is_made" root_is_made "$suite"
    check "make_demo_draws_on_it" demo_is_drawn
    check "make_check_is_green_on_it" check_is_green
    bare make clean
    whole "make_demo_draws_under_load" under_load make demo
    whole "make_check_is_green_under_load" eval 'under_load make check | nothing_failed 700'
    whole "make_test_says_what_it_wants_installs_it_and_passes" test_passes bare
    rm -rf "${dir:?}/$suite"
done
suite=bookworm
whole "make_test_passes_under_load" eval 'root_is_made "$suite" && test_passes under_load'
tap_end
