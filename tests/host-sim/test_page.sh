#!/usr/bin/env bash
# The page's module, which is the simulator compiled to WebAssembly, draws in node what the simulator draws.
# shellcheck disable=SC2317 # functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
export B=${B:-build}
command -v node >/dev/null || { echo "no node: apt-get install nodejs" && exit 77; }
made=$(make -s B="$B" "$B/wasm/page.wasm" 2>&1) || { echo "$made" && [[ $made = *'no compiler for WebAssembly'* ]] && exit 77 || exit 1; }
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT

golden() { node tests/host-sim/page/golden.mjs "$B/wasm/page.wasm" "$1"; }

sees() { # pattern, command that must fail and print it
    local said
    said=$("${@:2}") && echo "it passed: $said" && return 1
    grep -q -- "$1" <<<"$said" || { echo "says: $said" && return 1; }
}

check "every golden frame is the same in WebAssembly" golden tests/golden/frames.txt
sed -n '1s/.$/-/p' tests/golden/frames.txt >"$dir/wrong.txt"
check "... a frame that differs is seen" sees '1 differ' golden "$dir/wrong.txt"
tap_end
