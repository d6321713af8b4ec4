#!/usr/bin/env bash
# Usage: speed.sh BOARD [FRAMES]
# How fast every demo is on an emulated RP2040 board, with one core and with two: a table of frames/s and of the load of
# each core, FRAMES (4) frames a demo. The first column of numbers is what the bus allows; core 0 sleeps while core 1
# finishes its half. `B` is the build directory. `make speed BOARD=x` calls it.
set -eu
cd "$(dirname "$0")/../../.."
export B=${B:-build} BOARD=$1 EVENTS_ONLY=1
each=${2:-4}
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
[ -t 2 ] && echo "speed: some minutes" >&2
make -s B="$B" "$B/pinhole-sim" >&2
demos=()
options=()
for demo in $("$B/pinhole-sim" --list | awk '$1 == "demo" { print $2 }'); do # the button passes over what does not fit
    "$B/pinhole-sim" --board "$BOARD" --demo "$demo" --crc >/dev/null 2>&1 && demos+=("$demo")
done
for ((i = 1; i < ${#demos[@]}; i++)); do options+=(--send "$((i * each - 1)):s"); done
for cores in 1 2; do
    make -s B="$B" firmware BOARD="$BOARD" CORES=$cores >&2
    CORES=$cores hal/rp2040/emulate/emulate.sh "$B/firmware/$BOARD-demos$([ $cores = 1 ] || echo -cores$cores).elf" "$dir/$cores" \
        "$((each * ${#demos[@]}))" "${options[@]}" >/dev/null 2>"$dir/log" || { tail -n 3 "$dir/log" >&2 && exit 1; }
done
# The last frame of a demo also makes the next demo: it is left out.
paste -d' ' "$dir/1/report" "$dir/2/report" | awk -v each="$each" -v names="${demos[*]}" '
    BEGIN { split(names, name, " "); printf "%-12s %9s %9s %6s %9s %6s %6s\n", "frames/s", "the bus", "one core", "load", "two cores", "load", "load" }
    $1 % each != each - 1 { n++; bus += $3; one += $2; load += $4; two += $6; load0 += $8; load1 += $9 }
    $1 % each == each - 1 {
        printf "%-12s %9.1f %9.1f %4.0f %% %9.1f %4.0f %% %4.0f %%\n", name[int($1 / each) + 1], n * 1e6 / bus, n * 1e6 / one, load / n, n * 1e6 / two, load0 / n, load1 / n
        n = bus = one = load = two = load0 = load1 = 0
    }'
