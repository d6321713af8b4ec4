#!/usr/bin/env bash
# A clip runs by the kit's clock, however long a frame takes: on an emulated RP2350 with its SPI bus at three speeds it plays
# within 1 % of its speed, over two rounds of it. In the scene a triangle jumps each tenth of a second; the simulator says
# what is seen after each jump, and the emulator how much time had passed when a frame began.
# shellcheck disable=SC2317 # functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
unset MAKEFLAGS
B=${B:-build}
export B CHIP=rp2350
command -v arm-none-eabi-gcc >/dev/null || { echo "no arm-none-eabi-gcc: apt-get install gcc-arm-none-eabi libnewlib-arm-none-eabi" && exit 77; }
host-sim/emulate/emulate_rp2.sh --install 2>/dev/null || { echo "no emulator" && exit 77; }
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir" "$B/firmware/clip-speed-"*' EXIT
make -s -j2 B="$B" "$B/pinhole-asset" "$B/pinhole-sim" "$B/pinhole-wire" || exit 1

jumps=20 # in a round of 2 s

word() { # 32 bits, little endian
    local v=$1
    # shellcheck disable=SC2059 # it is octal escapes
    printf "$(printf '\\%03o\\%03o\\%03o\\%03o' $((v & 255)) $((v >> 8 & 255)) $((v >> 16 & 255)) $((v >> 24 & 255)))"
}
floats() { # numbers as 32 bits each
    local bits
    while read -r bits; do word "$bits"; done < <(awk -v list="$*" 'BEGIN { n = split(list, v, " "); for (i = 1; i <= n; i++) { s = v[i] < 0; a = s ? -v[i] : v[i]; e = 0
        if (a == 0) { print 0; continue }
        while (a >= 2) { a /= 2; e++ } while (a < 1) { a *= 2; e-- }
        printf "%.0f\n", s * 2147483648 + (e + 127) * 8388608 + int((a - 1) * 8388608 + .5) } }')
}

write_scene() { # a camera that stands, and a triangle whose place jumps along x; the last key ends the round
    local i times=() places=()
    for ((i = 0; i <= jumps; i++)); do
        times+=("$(awk -v i=$i 'BEGIN { print i / 10 }')")
        places+=("$(awk -v i=$i -v n=$jumps 'BEGIN { print (i % n - n / 2) / 8 }')" 0 0)
    done
    { floats -.7 -.7 0 .7 -.7 0 0 .7 0 && floats "${times[@]}" && floats "${places[@]}"; } >"$dir/s.bin"
    local n=$((jumps + 1))
    cat >"$dir/s.gltf" <<END
{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1]}],"cameras":[{"type":"perspective","perspective":{"yfov":0.8,"aspectRatio":1.3,"znear":0.5,"zfar":20}}],
"nodes":[{"mesh":0},{"camera":0,"translation":[0,0,3]}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
"buffers":[{"uri":"s.bin","byteLength":$((36 + 16 * n))}],
"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":$((4 * n))},{"buffer":0,"byteOffset":$((36 + 4 * n)),"byteLength":$((12 * n))}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[-0.7,-0.7,0],"max":[0.7,0.7,0]},
{"bufferView":1,"componentType":5126,"count":$n,"type":"SCALAR","min":[0],"max":[2]},{"bufferView":2,"componentType":5126,"count":$n,"type":"VEC3"}],
"animations":[{"name":"jumps","samplers":[{"input":1,"output":2,"interpolation":"STEP"}],"channels":[{"sampler":0,"target":{"node":0,"path":"translation"}}]}]}
END
    "$B/pinhole-asset" "$dir/s.gltf" -o "$dir/s.phs" --board pico2-display-2
}

# A frame in the middle of each jump's time: with 20 frames a second every second one.
pictures() {
    "$B/pinhole-sim" --model "$dir/s.phs" --board pico2-display-2 --clip-fps 20 --start 1 --frames $((2 * jumps - 1)) --crc |
        awk 'NR % 2 { print $4 }' >"$dir/pictures" && [ "$(sort -u "$dir/pictures" | wc -l)" = "$jumps" ]
}

# A board with another clock of its bus, which sends whole frames, so that the bus says how long one takes.
plays() { # Hz, frames
    local image=$B/firmware/clip-speed-demos-whole offset=$((0x80000))
    mkdir -p "$dir/boards/clip-speed"
    sed "s/board_pico2_display_2 /board_clip_speed /; s/BUDGET_RP2350,/BUDGET_RP2350, .spi_hz = $1,/" boards/pico2-display-2/board.c >"$dir/boards/clip-speed/board.c"
    cp boards/pico2-display-2/board.mk "$dir/boards/clip-speed"
    make -s firmware BOARD_DIR="$dir/boards" BOARD=clip-speed CHANGES=0 >"$dir/made" 2>&1 || { cat "$dir/made" && return 1; }
    cp "$image.elf" "$dir/a.elf"
    { cat "$image.bin" && head -c $((offset - $(stat -c %s "$image.bin"))) /dev/zero | tr '\0' '\377' && cat "$dir/s.phs"; } >"$dir/a.bin"
    BOARD=pico2-display-2 CORES=1 host-sim/emulate/emulate_rp2.sh "$dir/a.elf" "$dir/out" "$2" --limit-ms 100000 >"$dir/said" 2>&1 || { tail -n 3 "$dir/said" && return 1; }
    judge <(grep '^frame [0-9]* crc32' "$dir/said") "$dir/out/report"
}

# Each jump comes with the first frame that begins behind it, and in two rounds (4 s) that is known to 1 %.
judge() { # frames, their times
    awk -v jumps="$jumps" 'FILENAME == ARGV[1] { jump[$1] = FNR - 1; next }
        FILENAME == ARGV[2] { seen[$2] = $4; frames++; next }
        { us[$1] = $2 }
        END {
            for (n = 0; n < frames; n++) {
                if (!(seen[n] in jump)) { print "frame " n ": a picture of no jump"; exit 1 }
                while (count % jumps != jump[seen[n]]) { count++; late = n }
                if (count > 0 && late == n) {
                    at = count / 10
                    if (time < at * .99 || before >= at * 1.01) { printf "jump %d came between %.4f s and %.4f s\n", count, before, time; exit 1 }
                }
                before = time
                time += us[n] / 1e6
            }
            printf "%d frames in %.3f s, %d jumps\n", frames, before, count
            exit count < 2 * jumps || before > 6
        }' "$dir/pictures" "$1" "$2"
}

write_scene || exit 1
check "the simulator shows a picture of its own for each jump" pictures
check "a clip plays within 1 % of its speed with a bus of 62.5 MHz" plays 62500000 215
check "and with 25 MHz" plays 25000000 90
check "and with 10 MHz" plays 10000000 40
tap_end
