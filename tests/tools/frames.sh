# shellcheck shell=bash
# The frames whose CRCs stand in tests/golden/frames.txt: every demo, all depth formats, every wire format.
# `. tests/tools/frames.sh`, then: frames simulator-command... ; prints a line a frame.
#   frames_program folder variable=value...   makes the simulator in this build directory, with what the frames need alone

frames_program() {
    make -s -j2 B="$1" ASSIMP=noassimp MESHOPT=nomeshopt PNG=nopng GIF=nogif SDL=nosdl GPIOD=nogpiod DRM=nolibdrm USB=nousb ROOMS="common controllers model picture asset sim" "${@:2}" \
        "$1/pinhole-sim"
}

frames() {
    local demo board depth
    for demo in $("$@" --list | sed -n 's/^demo  *\([^ ]*\).*/\1/p'); do
        "$@" --demo "$demo" --size 320x240 --start 11 --frames 2 --crc | sed "s/^/$demo 320x240 auto /" || return 1
    done
    for depth in fixed16 float16 fixed24 float24 linear-w; do
        for demo in cube ground zfight materials $([ ${depth#*16} ] || echo torus wireframe fisheye); do
            "$@" --demo "$demo" --size 320x240 --start 40 --depth $depth --crc | sed "s/^/$demo 320x240 $depth /" || return 1
        done
    done
    "$@" --list | while read -r what board _; do # boards with an RP2350 have panels of those with an RP2040
        [[ $what != board || $board == *pico2-* || $board == *-rp2350-* ]] || "$@" --demo testcard --board "$board" --crc | sed "s/^/testcard $board auto /"
    done
}
