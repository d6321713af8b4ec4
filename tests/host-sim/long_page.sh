#!/usr/bin/env bash
# The page in Chromium shows every demo on every board as pinhole-sim does: frames 0 to 3, and one from the middle.
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
export B=${B:-build}
lacks=$(tests/host-sim/page/browser.sh --lacks) || { echo "$lacks" && exit 77; }
made=$(make -s B="$B" page "$B/pinhole-sim" 2>&1) || { echo "$made" && [[ $made = *'no compiler for WebAssembly'* ]] && exit 77 || exit 1; }
for board in $("$B/pinhole-sim" --list | sed -n 's/^board  *\([^ ]*\).*/\1/p'); do
    ! in_share || boards+=("$board")
done
check "the page draws what pinhole-sim draws on ${boards[*]}" tests/host-sim/page/browser.sh '' "${boards[@]}"
tap_end
