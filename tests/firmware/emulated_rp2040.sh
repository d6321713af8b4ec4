# shellcheck shell=bash disable=SC2154
# For the tests of RP2040 images; needs B, dir (a folder for the results) and tests/tools/tap.sh.
#   rp2040_here                              exits 77 where something is missing
#   emulate BOARD CORES FRAMES [KEYS] [option of emulate.mjs ...]
#                                            runs the image of all demos; KEYS is a file for pinhole-sim --keys, or -
#                                            (in the environment CHANGES=0: the image that sends whole frames, ISA=riscv,
#                                            DITHER=4: the one that dithers light);
#                                            frames to $dir/seen, the UART to $dir/log, the wires to $dir/out/events
#   expect BOARD FRAMES [KEYS]               pinhole-sim's frames, to $dir/expected
#   sweep EACH                               keys that show every demo for EACH frames and press buttons, to $dir/keys

rp2040_here() {
    local tool
    for tool in "arm-none-eabi-gcc gcc-arm-none-eabi" "node nodejs" "npm npm"; do
        command -v "${tool% *}" >/dev/null || { echo "no ${tool% *}: apt-get install ${tool#* }" && exit 77; }
    done
    host-sim/emulate/emulate_rp2.sh --install >/dev/null 2>"$dir/npm" || { cat "$dir/npm" && exit 77; }
}

image() { # board, cores
    make_image firmware BOARD="$1" CORES="$2" CHANGES="${CHANGES:-1}" DITHER="${DITHER:-0}"
}

elf_of() { # board, cores
    local name=$1-demos
    [ "${ISA:-arm}" = arm ] || name=$name-$ISA
    [ "$2" = 1 ] || name=$name-cores$2
    [ "${CHANGES:-1}" = 1 ] || name=$name-whole
    [ "${DITHER:-0}" = 0 ] || name=$name-dither$DITHER
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
    BOARD=$board CORES=$cores host-sim/emulate/emulate_rp2.sh "$(elf_of "$board" "$cores")" "$dir/out" "$frames" "${options[@]}" "${@:5}" \
        >"$dir/said" 2>"$dir/log"
    local status=$?
    grep '^frame [0-9]* crc32' "$dir/said" >"$dir/seen"
    [ $status = 0 ] || { tail -n 5 "$dir/log" && return 1; }
}

expect() {
    local keys=()
    [ "${3--}" = - ] || keys=(--keys "$3")
    [ "${DITHER:-0}" = 0 ] || keys+=(--dither)
    "$B/pinhole-sim" --board "$1" --frames "$2" "${keys[@]}" --crc >"$dir/expected" 2>/dev/null
}

sweep() {
    local i
    demos=$("$B/pinhole-sim" --list | grep '^demo' | grep -vc '; by name only$')
    for ((i = 1; i < demos; i++)); do
        echo "$((i * $1)) select"
        [ "$1" -lt 4 ] || printf '%s\n' "$((i * $1 + 1)) left+up" "$((i * $1 + 2)) right+down"
    done >"$dir/keys"
}

# The mean of frames 4 .. 6 of the first demo, in us: board, cores, options of emulate.mjs.
frame_us() {
    EVENTS_ONLY=1 BOARD=$1 CORES=$2 host-sim/emulate/emulate_rp2.sh "$(elf_of "$1" "$2")" "$dir/time" 8 "${@:3}" >/dev/null 2>&1 &&
        awk '$1 >= 4 && $1 <= 6 { us += $2; n++ } END { printf "%.0f\n", us / n }' "$dir/time/report"
}

same() { [ "$(wc -l <"$dir/seen")" = "$1" ] && diff "$dir/expected" "$dir/seen"; }

# Runs speed_rp2.sh for a board and demos (in the environment CHIP and ISA), and compares its CSV file with the table of this chip in
# tests/bench/README.md: each rate is within
# 3 %, and at least 90 % of that with ideal flash; there are rows for N demos. (A rate below 10 is shown with few digits: one
# more unit of the last is allowed.)
speed_agrees() { # N, arguments of speed_rp2.sh
    host-sim/emulate/speed_rp2.sh "${@:2}" >"$dir/speed" 2>&1 || { cat "$dir/speed" && return 1; }
    speed_as_in tests/bench/README.md "$1" <"$B/speed/$2.csv" || { cat "$dir/speed" && return 1; }
}

speed_as_in() { # paper, N; stdin: the CSV file
    local cells=14 one=3 two=8 # of the RP2040's table; the RP2350's has all four rates of both instruction sets
    [ "${CHIP-}" != rp2350 ] || { cells=11 && [ "${ISA:-arm}" = arm ] && one=3 two=5 || one=7 two=9; }
    awk -v n="$2" -v cells="$cells" -v one="$one" -v two="$two" 'function off(now, paper) { return now > paper * 1.03 + 0.05 || now < paper * 0.97 - 0.05 }
        FILENAME != "-" { if ($0 ~ /^\| `[a-z]*` \| [0-9]/ && split($0, cell, "|") == cells) { gsub(/[` ]/, "", cell[2]); fps[cell[2], 1] = cell[one]; fps[cell[2], 2] = cell[two] } next }
        FNR == 1 { next }
        { split($0, word, ","); seen += word[2] == 1 }
        !((word[1], word[2]) in fps) { print word[1] ": not in the table"; bad = 1; next }
        word[4] != "" && word[3] < 0.9 * word[4] { print $0 ": flash costs over a tenth"; bad = 1 }
        off(word[3], fps[word[1], word[2]] + 0) { print $0 ": the table says " fps[word[1], word[2]]; bad = 1 }
        END { if (seen != n) { print seen + 0 " demos" } exit bad || seen != n }' "$1" -
}
