#!/usr/bin/env bash
# What the lectures ask for is changed and read by pinhole-sim: lesson.txt has the things, the runs and the numbers, which
# are worked out here in whole numbers.
# shellcheck disable=SC2317 # functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
sim=$(realpath "${B:-build}/pinhole-sim") || exit 1
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT

# Every run, as lines `RUN LABEL FRACTION DECIMAL CODE`; an element of a matrix that is printed whole has no fraction.
run_all() {
    local words scene
    while read -r -a words; do
        [ "${words[0]-}" = '$' ] || continue
        scene=(--demo cube)
        [ "${words[2]}" != --demo ] || scene=()
        echo "@ ${words[1]}" && "$sim" "${scene[@]}" "${words[@]:2}" || return 1
    done <tests/host-sim/lesson.txt >"$dir/out"
    awk '/^@/ { run = $2; next }
        /^[a-z]+$/ { matrix = $1; row = 0; next }
        /^depth/ { print run, $1, $2, $2, $2; next }
        /^[A-Za-z]/ { print run, $1, $2, $3, $4; next }
        { for (i = 1; i <= 4; i++) printf "%s %s.%d.%d - %s %d\n", run, matrix, row, i - 1, $i, $i * 65536; row++ }' "$dir/out" >"$dir/numbers"
}

# Whether LABEL of a run is over / under, as its sign says.
holds() { # run, label, sign, over, under
    local fraction decimal code over=$4 under=$5 off
    [ -n "${numbers[$1 $2]-}" ] || { echo "$1 has no $2" && return 1; }
    fraction=${numbers[$1 $2]%% *} code=${numbers[$1 $2]##* } decimal=${numbers[$1 $2]#* } decimal=${decimal% *}
    [ "$under" -gt 0 ] || { over=$((-over)) && under=$((-under)); }
    case $2$3 in
        depth*) [ "$fraction" = $((over / under)) ] ;; # a code is the whole part
        *=) [[ $fraction == */* ]] || fraction=$fraction/1
            [ $((${fraction%/*} * under)) = $((over * ${fraction#*/})) ] ;;
        *^) off=$((code * under - 65536 * over)) && [ "${off#-}" -le $((256 * under)) ] ;;
        *~) off=$((2 * (code * under - 65536 * over))) && [ "${off#-}" -le "$under" ] ;;
        *) awk -v a="$decimal" -v b="$over" -v c="$under" 'BEGIN { d = a - b / c; exit d > 1e-9 || d < -1e-9 }' ;;
    esac || { echo "$1 $2 is $fraction $decimal $code, not $over/$under" && return 1; }
}

# A thing: it is read where each of its numbers holds, and changed where a label has two values.
is_changed_and_read() { # file of its lines
    local run label sign value over under changed=no
    declare -A overs=() unders=()
    while read -r run label sign value; do
        over=$((${value% : *})) under=$((${value#* : }))
        holds "$run" "$label" "$sign" "$over" "$under" || return 1
        [ $((over * ${unders[$label]-$under})) = $((${overs[$label]-$over} * under)) ] || changed=yes
        overs[$label]=$over unders[$label]=$under
    done <"$1"
    [ "$changed" = yes ] || { echo "no label has two values" && return 1; }
}

each_document_has_its_things() {
    [ "$(cut -d ' ' -f 1 "$dir/titles" | sort | uniq -c | tr -s ' \n' ' ')" = " 9 4600 12 EECE 12 HAW 11 KAIST 11 LMU " ] &&
        [ -z "$(cut -d '|' -f 1 "$dir/titles" | sort | uniq -d)" ]
}

check the_runs_end_well run_all
declare -A numbers=()
while read -r run label number; do
    numbers["$run $label"]=$number
done <"$dir/numbers"
awk -v dir="$dir" '/^[A-Z0-9]+ [0-9]+ \|/ { file = dir "/thing-" count++; print >(dir "/titles"); next }
    /^    / { print >file }' tests/host-sim/lesson.txt
check each_document_has_its_things each_document_has_its_things
mapfile -t titles <"$dir/titles"
for i in "${!titles[@]}"; do
    check "${titles[i]/ |/:}" is_changed_and_read "$dir/thing-$i"
done
tap_end
