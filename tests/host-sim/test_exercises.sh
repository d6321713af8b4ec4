#!/usr/bin/env bash
# The exercises and chapters of the page's lesson: their answers against arithmetic of the test's own and against pinhole-sim,
# what is said to typical wrong answers, and the addresses of the chapters. long_exercises.sh tries more of them.
# shellcheck disable=SC2317 # functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
export B=${B:-build}
command -v node >/dev/null || { echo "no node: apt-get install nodejs" && exit 77; }
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
of() { if [ -n "${LONG-}" ]; then echo "$2"; else echo "$1"; fi; } # in the short test, in the long one
page=tests/host-sim/page lesson=(host-sim/page/lesson/lesson_{fraction,exercise,exercise_{haw,pipeline,kaist,eece,lmu},exercises,chapters}.mjs)

# In the page scripts share one scope.
stand_in_one_script() {
    local others
    mapfile -t others < <(find host-sim/page -name "*.mjs" ! -name "*worker*")
    echo '@modules@' >"$dir/template"
    host-sim/page/page.sh "$dir/template" modules="${others[*]}" >"$dir/all.mjs" && node --check "$dir/all.mjs" &&
        { host-sim/page/page.sh "$dir/template" modules="${lesson[*]}" && echo 'console.log(exercises.length, chapters.length);'; } >"$dir/lesson.mjs" &&
        [ "$(node "$dir/lesson.mjs")" = '20 55' ]
}

check "fractions: what is read, sums, products, inverses" node $page/fraction.mjs
check "20 exercises: right answers in any spelling, and typical wrong ones" node $page/exercises.mjs "$(of 8 1000)"
check "... and pinhole-sim has the same numbers" node $page/exercises_sim.mjs "$B/pinhole-sim" "$(of 1 8)" "$(of 10 1)"
check "55 chapters with addresses that pinhole-sim takes" node $page/chapters.mjs "$B/pinhole-sim" "$(of 28 1)"
check "their scripts stand in one, beside those of the page" stand_in_one_script
check "no script of them has 300 lines" [ -z "$(wc -l "${lesson[@]}" | awk '$1 >= 300 && $2 != "total"')" ]
tap_end
