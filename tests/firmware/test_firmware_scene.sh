#!/usr/bin/env bash
# A binary scene in the flash of an emulated RP2350 with two cores (CHIP=rp2040: an RP2040 with one): the image draws the
# simulator's frames of it, in which clips run by frames. MOMENTS=100 (long_firmware_scene.sh, both chips): it says what is
# wrong with a damaged one, and shows its own demos then, at whatever of 100 moments the writing was interrupted.
# shellcheck disable=SC2317 # functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
unset MAKEFLAGS
B=${B:-build}
MOMENTS=${MOMENTS-}
export CHIP=${CHIP:-rp2350}
if [ "$CHIP" = rp2040 ]; then board=pico-display cores=1 made=pico-display-demos-fps30; else board=pico2-display-2 cores=2 made=pico2-display-2-demos-cores2-fps30; fi
offset=$((0x80000))
command -v arm-none-eabi-gcc >/dev/null || { echo "no arm-none-eabi-gcc: apt-get install gcc-arm-none-eabi libnewlib-arm-none-eabi" && exit 77; }
host-sim/emulate/emulate_rp2.sh --install 2>/dev/null || { echo "no rp2040js: needs node, npm and its registry" && exit 77; }
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
make -s -j2 B="$B" "$B/pinhole-asset" "$B/pinhole-sim" "$B/pinhole-wire" || exit 1
make_image firmware BOARD="$board" CORES="$cores" CLIP_FPS=30 >/dev/null || exit 1
cp "$B/firmware/$made.elf" "$dir/a.elf" || exit 1
"$B/pinhole-asset" tests/host-sim/asset/scene.gltf -o "$dir/scene.phs" --board "$board" || exit 1
"$B/pinhole-asset" tests/host-sim/asset/moving.gltf -o "$dir/moving.phs" --board "$board" || exit 1
"$B/pinhole-asset" tests/host-sim/asset/moving.gltf -o "$dir/turns.phs" --board "$board" --clip hold,sway || exit 1
printf 'v -1 0 -1\nv 1 0 -1\nv 1 0 1\nv 0 1 0\nf 1 2 3\nf 1 4 2\nf 2 4 3\nf 3 4 1\n' >"$dir/older.obj"
"$B/pinhole-asset" "$dir/older.obj" -o "$dir/older.phs" 2>/dev/null || exit 1

erased() { head -c "$1" /dev/zero | tr '\0' '\377'; }

emulate() { # scene, frames, options of the emulator: what the image says, and the frames' checksums
    local image="$B/firmware/$made.bin"
    { cat "$image" && erased $((offset - $(stat -c %s "$image"))) && cat "$1"; } >"$dir/a.bin"
    B=$B BOARD=$board CORES=$cores host-sim/emulate/emulate_rp2.sh "$dir/a.elf" "$dir/out" "$2" "${@:3}" 2>&1
}

draws_the_simulators_frames() { # scene, demo's name: and they differ
    emulate "$1" 4 >"$dir/said" && "$B/pinhole-sim" --model "$1" --board "$board" --frames 4 --crc >"$dir/expected" || return 1
    grep '^frame' "$dir/said" | diff - "$dir/expected" && grep -q "^demo $2" "$dir/said"
}

plays_the_clip() { # also the file itself
    draws_the_simulators_frames "$dir/moving.phs" moving && "$B/pinhole-sim" --model tests/host-sim/asset/moving.gltf --board "$board" --frames 4 --crc | cmp - "$dir/expected" &&
        "$B/pinhole-sim" --model "$dir/moving.phs" --clip hold --board "$board" --frames 4 --crc >"$dir/hold" && ! cmp -s "$dir/hold" "$dir/expected"
}

# 's' in frame 3 fades into the other clip until frame 10 (250 ms); in frame 12 there is no other: the first demo comes.
select_goes_through_the_clips() {
    printf '3 select\n12 select\n' >"$dir/keys"
    emulate "$dir/moving.phs" 14 --send 2:s --send 11:s >"$dir/said" &&
        "$B/pinhole-sim" --model "$dir/moving.phs" --board "$board" --frames 14 --keys "$dir/keys" --crc >"$dir/expected" &&
        "$B/pinhole-sim" --model "$dir/moving.phs" --board "$board" --frames 14 --crc | head -n 3 | cmp - <(head -n 3 "$dir/expected") || return 1
    grep '^frame [0-9]* crc' "$dir/said" | diff - "$dir/expected" && grep -o '^\(demo\|clip\) [a-z]*' "$dir/said" | paste -sd, | grep -x 'demo moving,clip hold,demo turntable'
}

# hold plays until frame 7 (250 ms), then sway fades in until frame 15; 's' in frame 12 takes the first demo.
clips_take_turns() {
    printf '12 select\n' >"$dir/keys"
    emulate "$dir/turns.phs" 14 --send 11:s >"$dir/said" && "$B/pinhole-sim" --model "$dir/turns.phs" --board "$board" --frames 14 --keys "$dir/keys" --crc >"$dir/expected" &&
        "$B/pinhole-sim" --model tests/host-sim/asset/moving.gltf --clip hold,sway --board "$board" --frames 12 --crc | cmp - <(head -n 12 "$dir/expected") &&
        [ "$("$B/pinhole-sim" --model "$dir/turns.phs" --clip hold --board "$board" --frames 12 --crc | grep -cxFf "$dir/expected")" = 8 ] || return 1
    grep '^frame [0-9]* crc' "$dir/said" | diff - "$dir/expected" && grep -o '^\(demo\|clip\) [a-z]*' "$dir/said" | paste -sd, | grep -x 'demo moving,demo turntable'
}

own_demo() { # scene: the image's first frame is its own, and it says this, or (empty) nothing about a scene
    emulate "$1" 1 >"$dir/said" || return 1
    if [ -n "$2" ]; then grep -q "^the scene in flash $2" "$dir/said"; else ! grep -q 'scene' "$dir/said"; fi &&
        grep -q '^demo turntable' "$dir/said" && grep '^frame' "$dir/said" | diff - "$dir/own"
}

damage_is_told() {
    "$B/pinhole-sim" --board "$board" --crc >"$dir/own" && erased 4096 >"$dir/none" && own_demo "$dir/none" '' || return 1
    { head -c 1000 "$dir/scene.phs" && printf X && tail -c +1002 "$dir/scene.phs"; } >"$dir/damaged"
    own_demo "$dir/damaged" 'has a wrong checksum: write it again'
}

# Sectors are erased and written in their order, over an older scene: up to the moment the new bytes, erased ones to the
# end of their sector, then the older ones.
interrupted() { # moment, in bytes
    local end=$((($1 / 4096 + 1) * 4096)) older
    older=$(stat -c %s "$dir/older.phs")
    { head -c "$1" "$dir/scene.phs" && erased $((end - $1)) && { [ "$older" -le "$end" ] || tail -c +$((end + 1)) "$dir/older.phs"; } } >"$dir/part"
    if [ "$1" = 0 ]; then own_demo "$dir/part" ''; else own_demo "$dir/part" '[ih]'; fi # is .., has a wrong checksum
}

interrupted_writes() {
    local i moment size
    size=$(stat -c %s "$dir/scene.phs")
    "$B/pinhole-sim" --board "$board" --crc >"$dir/own"
    RANDOM=20261123
    for ((i = 0; i < MOMENTS; i++)); do
        moment=$(((RANDOM * 32768 + RANDOM) % (size - 64) / 4 * 4))
        interrupted "$moment" || { echo "interrupted after $moment bytes" && cat "$dir/said" && return 1; }
    done
}

check "a scene in flash gives the simulator's frames" draws_the_simulators_frames "$dir/scene.phs" scene
check "an animation in flash plays as in the simulator" plays_the_clip
check "the select button fades into the next clip, and takes the next demo behind the last, as in the simulator" select_goes_through_the_clips
check "clips that play in turn do so as in the simulator" clips_take_turns
if [ -n "$MOMENTS" ]; then
    check "without one, or with a damaged one, the demos come, and the UART says why" damage_is_told
    check "a write that was interrupted leaves the demos ($MOMENTS moments)" interrupted_writes
fi
tap_end
