#!/usr/bin/env bash
# Usage: tests/host-sim/page/browser.sh FOLDER|'' 'USE...' BOARD...
# Shows the page in Chromium (browser.mjs) and compares it with build/pinhole-sim on these boards; it tries
# these uses of the page, with what FOLDER has for them, too. --lacks: says what is not here for that, and fails then. npm gets playwright-core into build/page-test.
set -u
cd "$(dirname "$0")/../../.." || exit 1
B=${B:-build}
dir=$B/page-test
packages=tests/host-sim/page
[ -x /usr/bin/chromium ] || { echo "no Chromium: apt-get install chromium" && exit 77; }
timeout 60 /usr/bin/chromium --headless --no-sandbox --disable-gpu --dump-dom about:blank 2>/dev/null </dev/null | grep -q '<html' ||
    { echo "Chromium does not start here: chromium --headless --no-sandbox --dump-dom about:blank" && exit 77; }
. tests/support/npm.sh
[ "${1-}" != --lacks ] || exit 0
simulator=$B/pinhole-sim
expected=$dir/expected.$$
trap 'rm -f "$expected"' EXIT
demos=$("$simulator" --list | sed -n 's/^demo  *\([^ ]*\)  *\([0-9]*\) frame.*/\1 \2/p')

# For each board and demo the frames 0 to 3 and one from the middle: `board demo frame crc32`.
for board in "${@:3}"; do
    while read -r demo frames; do
        middle=$((frames / 2 > 3 ? frames / 2 : 4))
        for start in 0 $middle; do
            "$simulator" --demo "$demo" --board "$board" --start "$start" --frames $((start > 0 ? 1 : 4)) --crc |
                sed -n "s/^frame \([0-9]*\) crc32 /$board $demo \1 /p"
        done
    done <<<"$demos"
done >"$expected"
# shellcheck disable=SC2086 # words
node tests/host-sim/page/browser.mjs "$dir/node_modules" "$B/page/index.html" "$expected" "$1" $2
