#!/usr/bin/env bash
# The page's module, which is the simulator compiled to WebAssembly, draws in node what the simulator draws; and in Debian's
# Chromium the page shows it, is used by keys and pointer, and asks for nothing. playwright-core (npm) drives Chromium.
# shellcheck disable=SC2317 # functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
export B=${B:-build}
command -v node >/dev/null || { echo "no node: apt-get install nodejs" && exit 77; }
made=$(make -s -j2 B="$B" page "$B/pinhole-sim" "$B/pinhole-asset" 2>&1) || { echo "$made" && [[ $made = *'no compiler for WebAssembly'* ]] && exit 77 || exit 1; }
try=$(mktemp -d) || exit 1
trap 'rm -rf "$try"' EXIT

golden() { node tests/host-sim/page/golden.mjs "$B/wasm/page.wasm" "$1"; }

sees() { # pattern, command that must fail and print it
    local said
    said=$("${@:2}") && echo "it passed: $said" && return 1
    grep -q -- "$1" <<<"$said" || { echo "says: $said" && return 1; }
}

check "every golden frame is the same in WebAssembly" golden tests/golden/frames.txt
sed -n '1s/.$/-/p' tests/golden/frames.txt >"$try/wrong.txt"
check "... a frame that differs is seen" sees '1 differ' golden "$try/wrong.txt"

words_are_the_tools() { # the runs of the lesson, and matrices that are wrong
    local is name line
    while read -r is name line; do
        [ "$is" != '$' ] || { [[ $line = *--demo* ]] && echo "$line"; } || echo "--demo cube $line"
    done <tests/host-sim/lesson.txt >"$try/words"
    local lens=1,0,0,0,0,1,0,0,0,0,-1.5,-5,0,0,1,0 # w has the other sign
    printf -- '--demo cube --size 64x48 --camera eye=2,1,5 %s--projection-matrix %s\n' '' "$lens" '--anyway ' "$lens" >>"$try/words"
    echo '--demo cube --projection fisheye --show depth' >>"$try/words"
    while read -r -a words; do
        "$B/pinhole-sim" "${words[@]}" --crc 2>"$try/said"
        sed 's/^pinhole-sim: /# /' "$try/said"
    done <"$try/words" >"$try/words.tool"
    node tests/host-sim/page/words.mjs "$B/wasm/page.wasm" <"$try/words" | diff "$try/words.tool" -
}
check "what its module prints for a command line, and says, and draws, is what pinhole-sim does" words_are_the_tools
check "the page takes at most 1.5 MB" [ "$(wc -c <"$B/page/index.html")" -le 1500000 ]
check "no script of it has 300 lines" [ -z "$(wc -l host-sim/page/*.mjs host-sim/page/lesson/*.mjs | awk '$1 >= 300 && $2 != "total"')" ]

if lacks=$(tests/host-sim/page/browser.sh --lacks); then
    simulator=$B/pinhole-sim
    printf '5 right 1\n' >"$try/keys"
    "$simulator" --demo turntable --board pico-display --start 5 --keys "$try/keys" --crc | sed 's/.* //' >"$try/keys.crc"
    "$simulator" --demo turntable --size 320x240 --start 11 --crc | sed 's/.* //' >"$try/size.crc"
    check "models, and what the tools make of them" tests/host-sim/page/models.sh "$try"
    check "the page works in Chromium" tests/host-sim/page/browser.sh "$try" 'kit model lesson host' waveshare-rp2040-lcd-1in28
    check "... and the picture that it saved is the simulator's" \
        "$simulator" --demo solar --view moon --depth fixed24 --board waveshare-rp2040-lcd-1in28 --start 7 --check "$try/saved.png"
else
    skip "the page works in Chromium" "$lacks"
fi
tap_end
