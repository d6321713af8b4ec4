#!/usr/bin/env bash
# Usage: emulate_rp2.sh IMAGE.elf DIR FRAMES [option of emulate.mjs ...] | --install
# Runs an image of an RP2040 board in rp2040js, or with CHIP=rp2350 of an RP2350 board in host-sim/emulate/rp2350. pinhole-wire
# makes its frames, DIR/frame-NNNN.ppm, from the chip's wires.
# Prints their checksums and how fast they came. DIR/events and DIR/report stay (see emulate.mjs). An access to a register
# that silicon would not take (registers/) ends it.
# An RP2040 needs node and npm. npm gets rp2040js (package.json has the version) into the build directory; --install does
# only that.
# Environment: B (build directory), BOARD, BOARD_HOME, CORES (of the chip; 2), EVENTS_ONLY=1 (no pictures), HOSTCC.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
cd "$here/../.."
B=${B:-build}

stop() {
    echo "emulate: $1" >&2
    exit 1
}

node='' checker='' new='' unfinished=''
leave() { # no node goes on, no half-written file stays
    [ -z "$node" ] || kill "$node" 2>/dev/null || true
    [ -z "$checker" ] || kill "$checker" 2>/dev/null || true
    rm -f "${accesses-}"
    [ -z "$new" ] || rm -rf "$new"
    [ -z "$unfinished" ] || rm -f "$unfinished/events" "$unfinished/report"
}
trap leave EXIT
trap 'stop interrupted' INT TERM HUP

install_rp2040js() {
    command -v node >/dev/null || stop "no node here: apt-get install nodejs"
    modules=$B/rp2040js
    if ! cmp -s "$here/rp2040/package.json" "$modules/package.json" || [ ! -e "$modules/node_modules/rp2040js/package.json" ]; then
        command -v npm >/dev/null || stop "no npm here: apt-get install npm"
        new=$(mktemp -d)
        cp "$here/rp2040/package.json" "$new/"
        timeout 120 npm install --prefix "$new" --no-package-lock --ignore-scripts --no-audit --no-fund --fetch-retries=1 \
            >"$new/log" 2>&1 || stop "npm did not get rp2040js: $(grep -m1 'npm.*ERR\|npm error' "$new/log")"
        rm -rf "$modules" && mkdir -p "$modules"
        mv "$new/node_modules" "$new/package.json" "$modules/"
    fi
}
if [ "${CHIP-}" = rp2350 ]; then
    emulator=("$B/rp2350-emulate")
    env -u BOARD make -s B="$B" "${emulator[@]}" >&2
else
    install_rp2040js
    emulator=(node "$here/rp2040/emulate.mjs" --modules "$modules/node_modules")
    env -u BOARD make -s B="$B" "$B/rp2040-registers" >&2
fi
[ "$1" != --install ] || exit 0
[ $# -ge 3 ] || stop "IMAGE.elf DIR FRAMES are wanted: see the head of $here/emulate_rp2.sh"
elf=$1 out=$2 frames=$3
shift 3
[ -x "$B/pinhole-wire" ] || make -s B="$B" "$B/pinhole-wire" >&2

board=$("${HOSTCC:-cc}" -E -P -Ihal -Iboards "${BOARD_HOME:-boards/$BOARD}/board.c") || stop "$BOARD: its board.c is wrong"
pin() { sed -n "s/.*\.$1 = { *1, *[01], *(\([0-9]*\)).*/\1/p" <<<"$board"; } # { wired, active low, (number), line }
i2c=$(sed -n 's/.*\.i2c_address = 0x\([0-9A-Fa-f]*\).*/\1/p' <<<"$board")
if [ -n "$i2c" ]; then
    panel=(--i2c "$i2c,$(pin clock),$(pin data)")
else
    [ -n "$(pin dc)" ] || stop "$BOARD: no D/C pin (.dc = BOARD_PIN(n)) in its board.c"
    panel=(--dc "$(pin dc)")
    case $board in
    *'.panel = &panel_ls0'*) ;; # a memory LCD, whose SCS is D/C
    *)
        [ -n "$(pin select)" ] || stop "$BOARD: has no chip select (.select = BOARD_PIN_LOW(n)), without which its transfers are not told apart"
        panel+=(--select "$(pin select)")
        ;;
    esac
fi

# The functions that begin a frame and write to the bus; a program other than the demos may have none.
calls=$("${CROSS-arm-none-eabi-}nm" "$elf" 2>/dev/null | awk '{ at[$3] = $1 } END { if ("runner_send" in at) { print at["runner_send"] "," at["rp2_bus_write"] "," at["rp2_bus_write_rows"] "," at["runner_scene"] "," at["runner_ahead"] } }')
mkdir -p "$out"
unfinished=$out
if [ "${CHIP-}" != rp2350 ]; then
    accesses=$out/accesses
    rm -f "$accesses" && mkfifo "$accesses"
    "$B/rp2040-registers" <"$accesses" &
    checker=$!
    emulator+=(--accesses "$accesses")
fi
"${emulator[@]}" "${panel[@]}" --cores "${CORES:-2}" \
    --frames "$frames" --events "$out/events" --report "$out/report" ${calls:+--calls "$calls"} "$@" "${elf%.elf}.bin" &
node=$!
wait "$node" || { node='' && exit 1; }
node=''
[ -z "$checker" ] || wait "$checker" || { checker='' && exit 1; }
checker='' unfinished=''
[ "${EVENTS_ONLY-}" = 1 ] || "$B/pinhole-wire" --board "$BOARD" ${calls:+--notes} --out "$out" "$out/events"
awk '{ us += $2; bus += $3; load += $5; load1 += $6 }
    END { if (NR > 0) { printf "%.1f frames/s: %.2f ms a frame, %.2f of them on the bus; load of core 0 %.0f %%", NR * 1e6 / us, us / NR / 1e3, bus / NR / 1e3, load / NR
                        if (NF > 5) { printf ", core 1 %.0f %%", load1 / NR }
                        printf "\n" } }' "$out/report"
