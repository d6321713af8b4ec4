#!/usr/bin/env bash
# Usage: speed_rp2.sh BOARD [POINTS [DEMO...]]
# Prints frames/s of every demo on an emulated RP2040 board, or with CHIP=rp2350 (and ISA=arm|riscv) on an RP2350's, with one core and with two, as rows of a Markdown table, each as
# soon as its demo has been drawn. "ideal flash" is the rate if flash were as fast as RAM; load is that of each core (core 0
# sleeps while core 1 finishes its half); sent are the bytes of a frame, where a whole one is 1.00 (more: the commands of windows);
# left out are triangles and vertices.
# Each DEMO (all that the select button reaches) is drawn at POINTS (6) points of its cycle, evenly spaced: two frames, or six at
# the first one, so that what was sent before and the first trial of whole frames count no more, and two frames whose mean
# counts.
# A frame for which the cores alone work no longer than a whole one takes on the bus should take no longer than that. A demo
# whose frames are late by over 3 % of that time is marked with !, and the exit status is 1.
# Environment: FIRST_DEMO (only that one, in an image that begins with it: fill, which no button reaches), B (build directory), CHANGES=0 (whole frames), CORES ("1 2"), IDEAL=0 (flash as it is only).
# Leaves $B/speed/BOARD.csv, and the same as JSON in $B/speed/BOARD.json. `make speed BOARD=x` calls it.
set -eu
cd "$(dirname "$0")/../.."
export B=${B:-build} BOARD=$1 EVENTS_ONLY=1
points=${2:-6}
shift $(($# > 2 ? 2 : $#))
case $points in '' | 0* | *[!0-9]*) echo "speed: POINTS: a whole number" >&2 && exit 2 ;; esac
dir=$(mktemp -d) children=()
leave() {
    [ ${#children[@]} = 0 ] || kill "${children[@]}" 2>/dev/null || true
    rm -rf "$dir"
}
trap leave EXIT
trap 'exit 1' INT TERM HUP
echo "speed: $BOARD, ${*:-all demos}: some minutes" >&2
make -s B="$B" "$B/pinhole-sim" "$B/pinhole-wire" >&2 # what the emulators share, because they run at the same time
host-sim/emulate/emulate_rp2.sh --install

# Writes `first frame, frames, name` of the demos that fit, for the button passes over the others, and `frame, demo` of the
# frames that count. A demo that was not asked for gets two frames, because a button that is held selects only once. The last
# frames of one that was asked for are held, so that the image writes a line about them.
options=() frame=0 left=$# # how many of those asked for are to come
by_button() {
    "$B/pinhole-sim" --list | awk -v first="${FIRST_DEMO-}" '$1 == "demo" && (first == "" ? !/; by name only$/ : $2 == first) { print $2, $3 }'
}
for demo; do
    if ! by_button | grep -q "^$demo " || ! "$B/pinhole-sim" --board "$BOARD" --demo "$demo" --crc >/dev/null; then
        echo "speed: $demo cannot be measured on $BOARD" >&2
        exit 2
    fi
done
while read -r demo loop; do
    "$B/pinhole-sim" --board "$BOARD" --demo "$demo" --crc >/dev/null 2>&1 || continue
    [ $frame = 0 ] || options+=(--send "$((frame - 1)):s")
    first=$frame
    case " $* " in
    '  ' | *" $demo "*)
        [ "$loop" -gt 1 ] && n=$points || n=1
        frame=$((frame + 4))
        for ((i = 0; i < n; i++, frame += 4)); do
            [ "$loop" = 1 ] || options+=(--jump "$((i == 0 ? first : frame)):$(((2 * i + 1) * loop / (2 * n)))")
            printf '%s\n' "$((frame + 2)) $demo" "$((frame + 3)) $demo" >>"$dir/count"
        done
        options+=(--send "$((frame - 1)):HG")
        left=$((left - 1)) ;;
    esac
    frame=$((frame + 2))
    echo "$first $((frame - first)) $demo" >>"$dir/demos"
    [ "$left" != 0 ] || break
done < <(by_button)

suffix=
[ "${CHANGES:-1}" = 1 ] || suffix=-whole
for cores in ${CORES:-1 2}; do
    make -s B="$B" firmware BOARD="$BOARD" CORES="$cores" CHANGES="${CHANGES:-1}" >/dev/null
    elf=$B/firmware/$BOARD-demos$([ "${ISA:-arm}" = arm ] || echo "-$ISA")$([ "$cores" = 1 ] || echo "-cores$cores")$suffix.elf
    for flash in real $([ "${IDEAL:-1}" = 0 ] || echo ideal); do
        flag=()
        [ "$flash" = real ] || flag=(--free-flash)
        mkdir "$dir/$cores-$flash"
        CORES=$cores host-sim/emulate/emulate_rp2.sh "$elf" "$dir/$cores-$flash" "$((frame + 1))" "${options[@]}" "${flag[@]}" \
            --events /dev/null --limit-ms 1000000 >/dev/null 2>"$dir/$cores-$flash/log" &
        children+=($!)
    done
done

whole=$("$B/pinhole-sim" --board "$BOARD" --demo turntable --stats 2>&1 >/dev/null | sed -n 's/.*bus \([0-9]*\) us.*/\1/p')

# Means of the frames that count: fps, bus us, us too late, load of core 0 and of core 1, left out.
means() { # folder, demo, first frame, frames
    sed -n 's/^frame \([0-9]*\), .*left out \([0-9]*\) triangles \([0-9]*\) vertices.*/\1 \2 \3/p' "$1/log" |
        awk -v demo="$2" -v first="$3" -v end="$(($3 + $4))" -v whole="$whole" '
            FILENAME == "-" { if ($1 >= first && $1 < end) { out = $2 + $3 } next }
            FILENAME ~ /count$/ { counts[$1] = $2; next }
            counts[$1] == demo { n++; us += $2; bus += $3; late += $2 - $4 <= whole && $2 > whole ? $2 - whole : 0; load += $5; load1 += $6 }
            END { print n * 1e6 / us, bus / n, late / n, load / n, load1 / n, out + 0 }' - "$dir/count" "$1/report"
}

has() { awk -v frame="$2" '$1 >= frame { found = 1 } END { exit !found }' "$1/report" 2>/dev/null; } # folder, frame

wait_for() { # folder, frame; of an emulator that has failed the last lines are shown
    until has "$1" "$2"; do
        kill -0 "${children[@]}" 2>/dev/null || has "$1" "$2" || { tail -n 3 "$1/log" >&2 && exit 1; }
        sleep 0.2
    done
}

echo "demo,cores,fps,fps_flash_ideal,load0,load1,sent_pct,dropped" >"$dir/csv"
printf '| frames/s; the bus %.1f |%s\n' "$(awk "BEGIN { print 1e6 / $whole }")" "$(for cores in ${CORES:-1 2}; do
    echo -n " $cores core$([ "$cores" = 1 ] || echo s) | ideal flash | load |"; [ "$cores" = 1 ] || echo -n " load |"
    echo -n " sent (whole: 1.00) | left out |"
done)"
while read -r first n demo; do
    [ "$n" -gt 2 ] || continue
    row="| \`$demo\` |"
    for cores in ${CORES:-1 2}; do
        for folder in "$dir/$cores"-*; do wait_for "$folder" "$((first + n - 1))"; done
        read -r fps bus late load0 load1 out < <(means "$dir/$cores-real" "$demo" "$first" "$n")
        ideal=
        [ "${IDEAL:-1}" = 0 ] || read -r ideal _ < <(means "$dir/$cores-ideal" "$demo" "$first" "$n")
        row+=$(awk -v cores="$cores" -v fps="$fps" -v ideal="$ideal" -v late="$late" -v bus="$bus" -v load0="$load0" \
            -v load1="$load1" -v out="$out" -v whole="$whole" -v demo="$demo" -v csv="$dir/csv" 'BEGIN {
            printf "%s,%d,%.2f,%s,%.1f,%.1f,%.1f,%d\n", demo, cores, fps, ideal == "" ? "" : sprintf("%.2f", ideal), load0, load1,
                100 * bus / whole, out >>csv
            printf " %.1f%s | %s | %.0f %% |", fps, (late > 0.03 * whole ? " !" : ""), ideal == "" ? "" : sprintf("%.1f", ideal), load0
            if (cores > 1) { printf " %.0f %% |", load1 }
            printf " %.2f | %d |", bus / whole, out }')
    done
    echo "$row" | tee -a "$dir/table"
done <"$dir/demos"
mkdir -p "$B/speed" && mv "$dir/csv" "$B/speed/$BOARD.csv"
awk -f firmware/tools/json.awk "$B/speed/$BOARD.csv" >"$B/speed/$BOARD.json"
! grep -q ' ! |' "$dir/table"
