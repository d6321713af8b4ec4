# shellcheck shell=bash disable=SC2154
# For the tests of RP2040 images; needs B, dir (a folder for the results) and tests/tools/tap.sh.
#   rp2040_here                              exits 77 where something is missing
#   emulate BOARD CORES FRAMES [KEYS] [option of emulate.mjs ...]
#                                            runs the image of all demos; KEYS is a file for pinhole-sim --keys, or -
#                                            (CHANGES=0 in the environment: the image that sends whole frames);
#                                            frames to $dir/seen, the UART to $dir/log, the wires to $dir/out/events
#   expect BOARD FRAMES [KEYS]               pinhole-sim's frames, to $dir/expected
#   sweep EACH                               keys that show every demo for EACH frames and press buttons, to $dir/keys

rp2040_here() {
    local tool
    for tool in "arm-none-eabi-gcc gcc-arm-none-eabi" "node nodejs" "npm npm"; do
        command -v "${tool% *}" >/dev/null || { echo "no ${tool% *}: apt-get install ${tool#* }" && exit 77; }
    done
    hal/rp2040/emulate/emulate.sh --install >/dev/null 2>"$dir/npm" || { cat "$dir/npm" && exit 77; }
}

image() { # board, cores
    make_image firmware BOARD="$1" CORES="$2" CHANGES="${CHANGES:-1}"
}

elf_of() { # board, cores
    local name=$1-demos
    [ "$2" = 1 ] || name=$name-cores$2
    [ "${CHANGES:-1}" = 1 ] || name=$name-whole
    echo "$B/firmware/$name.elf"
}

# A key that acts in a frame must be on the UART when the frame before begins.
letters() { # keys
    sed 's/#.*//' "$1" | awk 'NF { split($2, button, "+"); text = ""; for (i in button) { text = text substr(button[i] == "select" ? "s" : button[i], 1, 1) }
        for (f = $1; f < $1 + (NF > 2 ? $3 : 1); f++) { print "--send"; print f - 1 ":" text } }'
}

emulate() {
    local board=$1 cores=$2 frames=$3 keys=${4--} options=()
    [ "$keys" = - ] || mapfile -t options < <(letters "$keys")
    rm -rf "$dir/out"
    BOARD=$board CORES=$cores hal/rp2040/emulate/emulate.sh "$(elf_of "$board" "$cores")" "$dir/out" "$frames" "${options[@]}" "${@:5}" \
        >"$dir/said" 2>"$dir/log"
    local status=$?
    grep '^frame [0-9]* crc32' "$dir/said" >"$dir/seen"
    [ $status = 0 ] || { tail -n 5 "$dir/log" && return 1; }
}

expect() {
    local keys=()
    [ "${3--}" = - ] || keys=(--keys "$3")
    "$B/pinhole-sim" --board "$1" --frames "$2" "${keys[@]}" --crc >"$dir/expected" 2>/dev/null
}

sweep() {
    local i
    demos=$("$B/pinhole-sim" --list | grep -c '^demo')
    for ((i = 1; i < demos; i++)); do
        echo "$((i * $1)) select"
        [ "$1" -lt 4 ] || printf '%s\n' "$((i * $1 + 1)) left+up" "$((i * $1 + 2)) right+down"
    done >"$dir/keys"
}

# The mean of frames 4 .. 6 of the first demo, in us: board, cores, options of emulate.mjs.
frame_us() {
    EVENTS_ONLY=1 BOARD=$1 CORES=$2 hal/rp2040/emulate/emulate.sh "$(elf_of "$1" "$2")" "$dir/time" 8 "${@:3}" >/dev/null 2>&1 &&
        awk '$1 >= 4 && $1 <= 6 { us += $2; n++ } END { printf "%.0f\n", us / n }' "$dir/time/report"
}

same() { [ "$(wc -l <"$dir/seen")" = "$1" ] && diff "$dir/expected" "$dir/seen"; }

# Lines `demo frames/s [frames/s with two cores]` on stdin: each is within 3 % of the table in tests/bench/README.md, and there
# are N of them. (A rate below 10 is shown with two digits: one more unit of the last is allowed.)
near_the_paper() { # N
    awk -v n="$1" 'function off(now, paper) { return now > paper * 1.03 + 0.05 || now < paper * 0.97 - 0.05 }
        NR == FNR { if ($0 ~ /^\| `[a-z]*` \| [0-9]/ && NF == 23) { gsub(/`/, "", $2); one[$2] = $4; two[$2] = $14 } next }
        { seen++ }
        !($1 in one) { print $1 ": not in the table"; bad = 1; next }
        off($2, one[$1]) || (NF > 2 && off($3, two[$1])) { print $0 ": the table says " one[$1] ", " two[$1]; bad = 1 }
        END { if (seen != n) { print seen + 0 " demos" } exit bad || seen != n }' tests/bench/README.md -
}
