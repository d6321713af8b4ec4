#!/usr/bin/env bash
# An image of the small profile, which its linker script holds to 32 KB of flash and 4 KB of RAM, draws a torus of 96
# vertices on a Cortex-M0 in QEMU: on its 128x64 OLED, and with 128x128 pixels. All frames are the whole library's, and
# the linker leaves room for the deepest stack that the call graph has.
# shellcheck disable=SC2317,SC2015,SC2094 # functions are called by check; `A && B || { cat; return 1; }` says why it fails; the log is read while it grows
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
unset MAKEFLAGS
B=${B:-build}
command -v arm-none-eabi-gcc >/dev/null || { echo "no arm-none-eabi-gcc: apt-get install gcc-arm-none-eabi" && exit 77; }
command -v qemu-system-arm >/dev/null || { echo "no qemu-system-arm: apt-get install qemu-system-arm" && exit 77; }
dir=$(mktemp -d) && trap 'rm -rf "$dir"' EXIT
small=$B/m0-small
core=(-Ifirmware/core -Ifirmware/core/kernels/portable -Itests/size/small "-I$dir")
flags=(-mcpu=cortex-m0 -mthumb -Os -ffreestanding -ffunction-sections -fdata-sections -fcallgraph-info=su)

make -s -j2 B="$B" "$B/libpinhole.a" "$B/pinhole-wire" || exit 1
make -s -j2 B="$small" PROFILE=small CC=arm-none-eabi-gcc KIT= CFLAGS="${flags[*]}" "$small/libpinhole.a" || exit 1
cc -O2 "${core[@]}" tests/size/small/torus_mesh.c "$B/libpinhole.a" -o "$dir/mesh" && "$dir/mesh" >"$dir/torus_mesh.h" || exit 1

image() { # height, panel: image and reference
    cc -O2 -Wall -Wextra "-DHEIGHT=$1" "${core[@]}" tests/size/small/torus_host.c "$B/libpinhole.a" -o "$dir/host" &&
        "$dir/host" >"$dir/expected" 2>"$dir/greys" &&
        arm-none-eabi-gcc -std=c11 "${flags[@]}" -Wall -Wextra "-DHEIGHT=$1" -DPH_PROFILE_SMALL -Ifirmware/core/render/small \
            "${core[@]}" -c tests/size/small/image.c -o "$dir/image.o" && arm-none-eabi-gcc -std=c11 "${flags[@]}" -Wall -Wextra "-DHEIGHT=$1" \
            -DPH_PROFILE_SMALL -Ifirmware/core/render/small "${core[@]}" -c "tests/size/small/$2.c" -o "$dir/panel.o" &&
        find "$dir" "$small" -name '*.ci' -exec awk -v library=48 -v list=1 -v of=start -f firmware/tools/stack.awk {} + |
        sed -n 's/^worst \([0-9]*\) start$/\1/p' >"$dir/stack" && stack=$(cat "$dir/stack") &&
        arm-none-eabi-gcc "${flags[@]}" -nostartfiles --specs=nano.specs -T tests/size/small/small.ld \
            "-Wl,--gc-sections,--fatal-warnings,--defsym=stack_least=$stack" "$dir/image.o" "$dir/panel.o" "$small/libpinhole.a" -o "$dir/image.elf"
}

# Runs the image until it says that it is done, and takes the picture of the panel.
run() {
    : >"$dir/log"
    {
        for _ in $(seq 600); do
            grep -qE '^(done|failed|fault)' "$dir/log" && break
            sleep 0.1
        done
        echo "screendump $dir/screen.ppm"
        echo quit
    } | timeout 100 qemu-system-arm -M lm3s6965evb -cpu cortex-m0 -display none -monitor stdio -serial none -nic none \
        -semihosting-config enable=on,target=native -icount shift=5,sleep=off -kernel "$dir/image.elf" >>"$dir/log" 2>&1
    grep -q '^done' "$dir/log" || { tail -n 5 "$dir/log" && return 1; }
}

frames_are_equal() { image "$@" && run && [ -s "$dir/expected" ] && tr -d '\r' <"$dir/log" | grep '^frame ' | diff - "$dir/expected"; }

# The screen has blocks of 4x4 pixels, each of a grey times 17.
panel_shows_the_last_frame() {
    tail -c $((512 * 256 * 3)) "$dir/screen.ppm" | od -An -v -tu1 -w1536 | awk '
        NR % 4 == 1 { for (i = 1; i <= NF; i += 12) { printf "%x", $i / 17 } print "" }' | diff - "$dir/greys" >"$dir/differ" ||
        { head -n 4 "$dir/differ" && return 1; }
}

# The events on the wires, as an ST7735S takes them; the upper four bits of green are the greys.
wire_has_the_last_frame() {
    tr -d '\r' <"$dir/log" | grep -E '^[0-9]+ (level|spi) ' | "$B/pinhole-wire" --board rpi-waveshare-1in44 --rotate 0 --last --out "$dir/wire.ppm" >"$dir/wires" || return 1
    cat "$dir/wires" && tail -c $((128 * 128 * 3)) "$dir/wire.ppm" | od -An -v -tu1 -w384 | awk '
        { for (i = 2; i <= NF; i += 3) { printf "%x", $i / 16 } print "" }' | diff - "$dir/greys" >"$dir/differ" ||
        { head -n 4 "$dir/differ" && return 1; }
}

stack_fits() {
    local used=$((16#$(tr -d '\r' <"$dir/log" | sed -n 's/^stack //p'))) most
    most=$(cat "$dir/stack")
    echo "$used bytes of stack are used, the call graph has $most" && [ "$used" -gt 100 ] && [ "$used" -le "$most" ]
}

check "oled_128x64_has_the_frames_of_the_whole_library" frames_are_equal 64 oled
check "... and QEMU's panel shows the last of them" panel_shows_the_last_frame
check "... and its stack stays below the bound" stack_fits
check "128x128_has_the_frames_of_the_whole_library" frames_are_equal 128 st7735s
check "... and the wire of its ST7735S shows the last of them" wire_has_the_last_frame
check "... and its stack stays below the bound" stack_fits
tap_end
