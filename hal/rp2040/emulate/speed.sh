#!/usr/bin/env bash
# Usage: speed.sh BOARD [FRAMES [DEMO...]]
# Prints frames/s of every demo on an emulated RP2040 board, with one core and with two. `the bus` is the rate of whole
# frames on the bus; `alone` is the rate if the bus took no time; load is that of each core (core 0 sleeps while core 1
# finishes its half); sent is the part of a whole frame's bytes. A demo that the cores alone draw in the time of the bus,
# but that takes over 1.03 times as long on it, is marked with !, and the exit status is 1.
# Each DEMO (all; as pinhole-sim lists them) is drawn for FRAMES frames (6, at least 5), and three of them count.
# Environment: B (build directory), CHANGES=0 (whole frames). Leaves $B/speed/BOARD.csv in us a frame.
# `make speed BOARD=x` calls it.
set -eu
cd "$(dirname "$0")/../../.."
export B=${B:-build} BOARD=$1 EVENTS_ONLY=1
each=${2:-6}
shift $(($# > 2 ? 2 : $#))
[ "$each" -ge 5 ] || { echo "speed: FRAMES: at least 5" >&2 && exit 2; }
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
[ ! -t 2 ] || echo "speed: some minutes" >&2
make -s B="$B" "$B/pinhole-sim" >&2

# Writes `first frame, frames, name` of the demos that fit, for the button passes over the others. A demo that was not asked
# for gets two frames, because a button that is held selects only once.
options=() frame=0 last=${!#}
[ $# -gt 0 ] || last=
for demo in $("$B/pinhole-sim" --list | awk '$1 == "demo" { print $2 }'); do
    "$B/pinhole-sim" --board "$BOARD" --demo "$demo" --crc >/dev/null 2>&1 || continue
    case " $* " in '  ' | *" $demo "*) n=$each ;; *) n=2 ;; esac
    [ $frame = 0 ] || options+=(--send "$((frame - 1)):s")
    echo "$frame $n $demo" >>"$dir/demos"
    frame=$((frame + n))
    [ "$demo" != "$last" ] || break
done

suffix=
[ "${CHANGES:-1}" = 1 ] || suffix=-whole
for cores in 1 2; do
    make -s B="$B" firmware BOARD="$BOARD" CORES=$cores CHANGES="${CHANGES:-1}" >&2
    elf=$B/firmware/$BOARD-demos$([ $cores = 1 ] || echo -cores$cores)$suffix.elf
    for wire in wire free-wire; do
        flag=()
        [ $wire = wire ] || flag=(--free-wire)
        CORES=$cores hal/rp2040/emulate/emulate.sh "$elf" "$dir/$cores-$wire" "$((frame + 1))" "${options[@]}" "${flag[@]}" \
            >/dev/null 2>"$dir/log" || { tail -n 3 "$dir/log" >&2 && exit 1; }
    done
done
# The first frame is whole, for it shows the panel's start, and nothing else is on the bus.
whole=$("$B/pinhole-sim" --board "$BOARD" --demo turntable --stats 2>&1 >/dev/null | sed -n 's/.*bus \([0-9]*\) us.*/\1/p')
cut -d' ' -f1-4 "$dir/1-wire/report" | paste -d' ' - <(cut -d' ' -f2 "$dir/1-free-wire/report") \
    <(cut -d' ' -f2- "$dir/2-wire/report") <(cut -d' ' -f2 "$dir/2-free-wire/report") |
    awk -v whole="$whole" -v each="$each" -v list="$dir/demos" -v csv="$dir/csv" '
    function bar(us, alone) { if (alone <= whole && us > 1.03 * whole) { bad = 1; return "!" } return " " }
    BEGIN {
        while ((getline line <list) > 0) {
            split(line, word, " ")
            order[++demos] = word[3]
            for (i = word[2] - 4; word[2] == each && i < word[2] - 1; i++) { name[word[1] + i] = word[3] }
        }
        print "demo,bus,one_core,one_core_alone,two_cores,two_cores_alone" >csv
        printf "%-12s %8s %10s %7s %6s %6s %10s %7s %6s %6s\n", "frames/s", "the bus", "one core", "alone", "load", "sent", "two cores", "alone", "load", "load"
    }
    $1 in name {
        d = name[$1]
        n[d]++; us[d] += $2; bus[d] += $3; load[d] += $4; alone[d] += $5
        us2[d] += $6; load0[d] += $8; load1[d] += $9; alone2[d] += $10
    }
    END {
        for (i = 1; i <= demos; i++) {
            d = order[i]
            if (!(d in n)) { continue }
            k = n[d]
            printf "%s,%d,%.0f,%.0f,%.0f,%.0f\n", d, whole, us[d] / k, alone[d] / k, us2[d] / k, alone2[d] / k >csv
            printf "%-12s %8.1f %9.1f%s %7.1f %4.0f %% %4.0f %% %9.1f%s %7.1f %4.0f %% %4.0f %%\n", d, 1e6 / whole, k * 1e6 / us[d],
                bar(us[d] / k, alone[d] / k), k * 1e6 / alone[d], load[d] / k, 100 * bus[d] / k / whole, k * 1e6 / us2[d],
                bar(us2[d] / k, alone2[d] / k), k * 1e6 / alone2[d], load0[d] / k, load1[d] / k
        }
        exit bad
    }' || status=$?
mkdir -p "$B/speed" && mv "$dir/csv" "$B/speed/$BOARD.csv"
exit "${status:-0}"
