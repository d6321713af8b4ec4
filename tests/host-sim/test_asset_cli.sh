#!/usr/bin/env bash
# pinhole-asset: what it writes compiles and draws, byte for byte, what the simulator draws of the same data, in an
# emulated kit too; what is wrong costs one line and leaves nothing behind.
# shellcheck disable=SC2317 # functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
unset MAKEFLAGS
B=${B:-build}
asset=$B/pinhole-asset
scene=tests/host-sim/asset/scene.gltf
moving=tests/host-sim/asset/moving.gltf
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
make -s -j2 B="$B" "$asset" "$B"/pinhole-{sim,depth,emulate} || exit 1

include="-Ifirmware/core/kernels/portable -Ifirmware/core -Ifirmware/app -Ihal -Iboards -I$B/boards_all -Ihost-sim/common -Ihost-sim/picture -Ihost-sim/asset -Ihost-sim/model -Ihost-sim/sim -Ihost-sim/controllers"
strict='-std=c11 -Wall -Wextra -Wshadow -Wconversion -Wundef -Wcast-qual -Wpedantic -Werror'
read -ra libraries < <({ for l in assimp libpng libjpeg libwebp sdl2 libgpiod libusb-1.0; do pkg-config --libs "$l" 2>/dev/null; done && { [ ! -e /usr/include/meshoptimizer.h ] || echo -lmeshoptimizer; } && { [ ! -e /usr/include/gif_lib.h ] || echo -lgif; }; } | xargs)

sphere() { # rings: smooth, 4 rings^2 triangles and some
    awk -v n="$1" 'BEGIN {
        for (j = 0; j <= n; j++) { for (i = 0; i < 2 * n; i++) {
            u = i * 3.14159265358979 / n; v = (j / n - .5) * 3.14159265358979
            printf "v %.5f %.5f %.5f\n", cos(u) * cos(v), sin(v), -sin(u) * cos(v) } }
        for (j = 0; j < n; j++) { for (i = 0; i < 2 * n; i++) {
            a = 2 * n * j + i + 1; b = 2 * n * j + (i + 1) % (2 * n) + 1
            print "f", a, b, b + 2 * n, a + 2 * n } } }'
}
sphere 24 >"$dir/sphere.obj"
sphere 60 >"$dir/large.obj" # 14,400 triangles: more than any kit has room for

# shellcheck disable=SC2086 # lists of flags
compile() { # scene.c, program
    gcc $strict -O1 $include -c "$1" -o "$2.o" &&
        gcc -std=c11 -Wall -Wextra -Werror -O1 $include tests/host-sim/asset/frames.c "$2.o" "$B"/libpinhole-{host,app,hal}.a "$B/libpinhole.a" -Wl,--as-needed "${libraries[@]}" -lm -pthread -o "$2"
}

# The compiled file against what pinhole-asset has in memory, and (no fewer triangles) against the model file.
same_frames() { # model, triangles, boards...
    local model=$1 triangles=$2 board last
    "$asset" "$model" -o "$dir/same.c" --max-triangles "${triangles/4294967295/all}" --force && compile "$dir/same.c" "$dir/same" || return 1
    for board in "${@:3}"; do
        "$dir/same" "$board" 8 32 - "$model" "$triangles" 8 own >"$dir/said" || { echo "$board" && return 1; }
        last=$(tail -n 1 "$dir/said")
        echo "# $board: $last"
        [ "$(grep -c '^frame' "$dir/said")" = 8 ] || return 1
        [ "$triangles" != 4294967295 ] || [[ $last =~ ^pixels\ 0\ outline\ 0\ triangles\ ([0-9]+)\ of\ ([0-9]+)$ && $((BASH_REMATCH[1] + ${collapsed:-0})) = "${BASH_REMATCH[2]}" ]] || return 1
    done
}

sphere_frames() { collapsed=96 same_frames "$@"; } # its poles: 48 triangles each with two corners in one place

# The C file draws what the binary scene does.
studio_in_c() {
    local kind frame
    for kind in c phs; do "$asset" "$scene" -o "$dir/studio.$kind" --background 336699 --light back || return 1; done
    compile "$dir/studio.c" "$dir/studio" && "$dir/studio" pico-display 2 50 >"$dir/c.crcs" || return 1
    for frame in 0 50; do "$B/pinhole-sim" --model "$dir/studio.phs" --board pico-display --start "$frame" --crc; done >"$dir/phs.crcs"
    cmp "$dir/c.crcs" "$dir/phs.crcs" && "$asset" "$scene" -o "$dir/plain.phs" && [ "$(stat -c %s "$dir/studio.phs")" = $(($(stat -c %s "$dir/plain.phs") + 16)) ]
}

frames_move() { # a driver that draws nothing would pass otherwise
    "$asset" "$dir/sphere.obj" -o "$dir/s.c" --max-triangles 300 && compile "$dir/s.c" "$dir/s" && "$dir/s" pico-display 1 1 "$dir/pictures" >/dev/null &&
        "$dir/s" pico-display 3 50 | cut -d' ' -f4 >"$dir/crcs" && [ "$(sort -u "$dir/crcs" | wc -l)" = 3 ]
}

other_data_is_seen() {
    "$asset" "$dir/sphere.obj" -o "$dir/o.c" --max-triangles 300 && sed -i '/positions_0/,/^};/ s/{\([0-9]\)\([0-9]*\),/{1\2,/; /bounds_0/d' "$dir/o.c" && compile "$dir/o.c" "$dir/o" || return 1
    ! "$dir/o" pico-display 4 32 - "$dir/sphere.obj" 300 8 own >/dev/null 2>"$dir/said" && grep -q 'frame 0 differs' "$dir/said"
}

bounds_that_lie_are_found() { # a coordinate, the radius, the centre
    local change
    "$asset" "$dir/sphere.obj" -o "$dir/bounds.c" && "$asset" --check-bounds "$dir/bounds.c" && "$asset" "$dir/sphere.obj" -o "$dir/bounds.phs" && "$asset" --check-bounds "$dir/bounds.phs" || return 1
    for change in '/positions_0/,/^};/ s/{-*\([0-9]*\), /{1\1, /' '/bounds_0 = / s/radius = [0-9]*/radius = 60000/' '/bounds_0 = / s/centre = {/&9/'; do
        # shellcheck disable=SC2015 # says why it fails
        sed "$change" "$dir/bounds.c" >"$dir/lie.c" && ! "$asset" --check-bounds "$dir/lie.c" 2>"$dir/said" && grep -q 'lie.c: vertex [0-9]* of mesh 0 lies outside of its bounds' "$dir/said" || { echo "$change" && cat "$dir/said" && return 1; }
    done
    echo 'int main(void) { return 0; }' >"$dir/other.c" && ! "$asset" --check-bounds "$dir/other.c" 2>"$dir/said" && grep -q 'other.c: has no bounds' "$dir/said" || return 1
    cp "$dir/bounds.phs" "$dir/lie.phs" && printf x | dd of="$dir/lie.phs" bs=1 seek=500 conv=notrunc 2>/dev/null && ! "$asset" --check-bounds "$dir/lie.phs" 2>"$dir/said" && grep -q checksum "$dir/said"
}

close_to_the_model() { # simplified to a quarter: the outline differs in at most 1 % of the picture
    "$asset" "$dir/sphere.obj" -o "$dir/close.c" --max-triangles 576 && compile "$dir/close.c" "$dir/close" || return 1
    "$dir/close" rpi-waveshare-1in3 8 32 - "$dir/sphere.obj" 576 8 own | tail -n 1 | tee "$dir/said"
    awk '{ exit !($4 > 0 && $4 < 8 * 240 * 240 * .01 && $6 < $8 / 3) }' "$dir/said"
}

clang_and_arm_compile_it() { # model
    local sizes reported
    "$asset" "$1" -o "$dir/c.c" --report --board pico-display >"$dir/report" || return 1
    # shellcheck disable=SC2086 # lists of flags
    { ! command -v clang >/dev/null || clang $strict $include -c "$dir/c.c" -o "$dir/c.o"; } || return 1
    command -v arm-none-eabi-gcc >/dev/null || return 0
    # shellcheck disable=SC2086
    arm-none-eabi-gcc $strict -mcpu=cortex-m0plus -mthumb -O2 ${include/portable/armv6m} -c "$dir/c.c" -o "$dir/arm.o" || return 1
    sizes=$(arm-none-eabi-size -A "$dir/arm.o" | awk '/rodata/ { n += $2 } /^\.(data|bss)/ && $2 > 0 { print "not const" } END { print n }')
    reported=$(awk '/in all .*bytes/ { print $3; exit }' "$dir/report")
    echo "# $sizes bytes in the object, $reported in the report"
    [ "$sizes" -ge $((reported - 8)) ] && [ "$sizes" -le $((reported + 32)) ]
}

output_is_deterministic() {
    "$asset" "$dir/sphere.obj" -o "$dir/1.c" --max-triangles 300 && mkdir -p "$dir/else" && cp "$dir/sphere.obj" "$dir/else" &&
        (program=$(realpath "$asset") && cd "$dir/else" && "$program" sphere.obj -o - --max-triangles 300) >"$dir/2.c" && cmp "$dir/1.c" "$dir/2.c"
}

filters_are_in_the_file() { # and the simulator draws the same with --filter
    local filter
    for filter in nearest bilinear mipmap; do
        "$asset" "$scene" -o "$dir/$filter.c" --filter "$filter" && compile "$dir/$filter.c" "$dir/filter" && "$dir/filter" pico-display 1 1 | cut -d' ' -f4 >"$dir/$filter.crc" &&
            "$B/pinhole-sim" --model "$scene" --board pico-display --frames 1 --crc --filter "$filter" | cut -d' ' -f4 >"$dir/$filter.sim" || return 1
    done
    grep -q 'PH_FILTER_MIPMAP, .levels = 5' "$dir/mipmap.c" && grep -q '.levels = 0' "$dir/bilinear.c" && [ "$(cat "$dir"/{nearest,bilinear,mipmap}.crc | sort -u | wc -l)" = 3 ] &&
        [ "$(sort -u "$dir"/{nearest,bilinear,mipmap}.sim | wc -l)" = 3 ] && cmp "$dir/nearest.crc" "$dir/nearest.sim" && cmp "$dir/bilinear.crc" "$dir/bilinear.sim"
}

unlit='{"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],
    "materials":[{"pbrMetallicRoughness":{"baseColorFactor":[0,1,0,1]},"extensions":{"KHR_materials_unlit":{}}}],"accessors":[{"componentType":5126,"count":3,"type":"VEC3",
    "sparse":{"count":2,"indices":{"bufferView":0,"componentType":5121},"values":{"bufferView":0,"byteOffset":4,"componentType":5126}}}],
    "bufferViews":[{"buffer":0,"byteLength":28}],"buffers":[{"byteLength":28,"uri":"data:;base64,AQIAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAA=="}]}'

the_three_forms_are_one_picture() { # the file, the C scene and the binary scene: turntable, camera and textures, unlit, alpha and vertex colours
    local model apart=12 # frames; the C scene is compared in four, the binary one in all
    [ -z "${LONG-}" ] || apart=32
    echo "$unlit" >"$dir/unlit.gltf"
    for model in "$scene" "$dir/sphere.obj" "$dir/unlit.gltf" "$moving" tests/host-sim/asset/surfaces.gltf; do
        "$asset" "$model" -o "$dir/3.c" && "$asset" "$model" -o "$dir/3.phs" && compile "$dir/3.c" "$dir/3" && "$dir/3" pico-display 4 "$apart" | grep '^frame' | cut -d' ' -f4 >"$dir/3.compiled" &&
            "$B/pinhole-sim" --model "$model" --board pico-display --frames $((4 * apart)) --crc | cut -d' ' -f4 >"$dir/3.model" &&
            "$B/pinhole-sim" --model "$dir/3.phs" --board pico-display --frames $((4 * apart)) --crc | cut -d' ' -f4 >"$dir/3.binary" || return 1
        # shellcheck disable=SC2015 # each part prints or not, and a failure of any is one
        cmp "$dir/3.model" "$dir/3.binary" && [ "$(wc -l <"$dir/3.compiled")" = 4 ] && cmp "$dir/3.compiled" <(awk -v n="$apart" 'NR % n == 1' "$dir/3.binary") || { echo "$model" && return 1; }
    done
    [ "$("$B/pinhole-sim" --model "$dir/3.phs" --view turntable --size 64x64 --crc | wc -l)" = 1 ] && truncate -s -4 "$dir/3.phs" &&
        ! "$B/pinhole-sim" --model "$dir/3.phs" --crc 2>"$dir/said" && grep -q 'is not whole' "$dir/said" && [ "$(wc -l <"$dir/said")" = 1 ]
}

clip_crcs() { # model, clip
    "$B/pinhole-sim" --model "$1" ${2:+--clip "$2"} --size 120x90 --frames 24 --crc
}

clips_are_played_by_name() { # sway, hold
    "$asset" "$moving" -o "$dir/clips.phs" && "$asset" "$moving" -o "$dir/hold.phs" --clip hold && clip_crcs "$moving" hold >"$dir/hold" && clip_crcs "$moving" >"$dir/sway" || return 1
    ! cmp -s "$dir/hold" "$dir/sway" && cmp "$dir/hold" <(clip_crcs "$dir/clips.phs" hold) && cmp "$dir/hold" <(clip_crcs "$dir/hold.phs") && cmp "$dir/sway" <(clip_crcs "$dir/clips.phs") &&
        ! "$B/pinhole-sim" --model "$dir/hold.phs" --clip sway --crc 2>"$dir/said" && grep -q 'no such clip; it has hold' "$dir/said" &&
        refuses 2 "no such clip; did you mean hold? it has sway, hold" "$moving" -o "$dir/n.phs" --clip hoId
}

# hold stands still, so that behind the fade each frame is its own, whenever it began: 250 ms are 8 frames, 50 ms are 2.
clips_fade_into_each_other() {
    local form shown
    printf '3 select\n' >"$dir/keys"
    clip_crcs "$moving" >"$dir/sway" && clip_crcs "$moving" hold >"$dir/hold" && "$asset" "$moving" -o "$dir/fast.phs" --cross-fade 50 || return 1
    for form in "$moving --cross-fade 250" "$dir/clips.phs" "$moving --cross-fade 50" "$dir/fast.phs"; do
        # shellcheck disable=SC2086 # a file and an option
        "$B/pinhole-sim" --model $form --size 120x90 --frames 24 --crc --keys "$dir/keys" >"$dir/faded" || return 1
        shown=$(paste -d' ' "$dir/sway" "$dir/hold" "$dir/faded" | awk '{ printf "%s", $12 == $4 ? "s" : $12 == $8 ? "h" : "-" }')
        echo "$form: $shown"
        case $form in
        *250 | *clips.phs) [ "$shown" = "ssss-------hhhhhhhhhhhhh" ] || return 1 ;;
        *) [ "$shown" = "ssss-hhhhhhhhhhhhhhhhhhh" ] || return 1 ;;
        esac
    done
}

# Of each frame: s or h where sway or hold alone shows, and - within a fade.
in_turn_shows() { # model, options: 56 frames, and a frame is the same whichever was drawn before it
    "$B/pinhole-sim" --model "$@" --size 120x90 --frames 56 --crc >"$dir/turns" && "$B/pinhole-sim" --model "$@" --size 120x90 --start 46 --frames 10 --crc | cmp - <(tail -n 10 "$dir/turns") || return 1
    paste -d' ' "$dir/sway" "$dir/hold" "$dir/turns" | awk '{ printf "%s", $12 == $4 ? "s" : $12 == $8 ? "h" : "-" }'
}

# The simulator, the C scene, the binary scene, and those with all clips, and in another order. sway lasts 1.49 s. hold, of
# .23 s, has faded in when sway begins to do so again, at the time where sway alone repeats.
clips_take_turns() {
    local form shown
    for form in sway hold; do "$B/pinhole-sim" --model "$moving" --clip "$form" --size 120x90 --frames 56 --crc >"$dir/$form" || return 1; done
    "$asset" "$moving" -o "$dir/clips.phs" && "$asset" "$moving" -o "$dir/turns.phs" --clip sway,hold && "$asset" "$moving" -o "$dir/turns.c" --clip sway,hold && "$asset" "$moving" -o "$dir/back.phs" --clip hold,sway || return 1
    for form in "$moving --clip sway,hold" "$dir/clips.phs --clip sway,hold" "$dir/turns.phs" "$dir/back.phs --clip sway,hold"; do
        # shellcheck disable=SC2086 # a file and an option
        shown=$(in_turn_shows $form) && echo "$form: $shown" && [ "$shown" = "$(printf 's%.0s' {0..37})---------------sss" ] || return 1
    done
    # shellcheck disable=SC2015 # a failure of any is one
    shown=$(in_turn_shows "$dir/back.phs") && [ "${shown:0:9}" = "hhhhhhhh-" ] && [ "$(in_turn_shows "$dir/turns.phs" --clip hold)" = "$(printf 'h%.0s' {0..55})" ] || { echo "$shown" && return 1; }
    compile "$dir/turns.c" "$dir/t" && "$dir/t" pico-display 56 1 | grep '^frame' | cut -d' ' -f4 | cmp - <("$B/pinhole-sim" --model "$dir/turns.phs" --board pico-display --frames 56 --crc | cut -d' ' -f4) &&
        refuses 2 "no such clip; did you mean hold? it has sway, hold" "$moving" -o "$dir/n.phs" --clip sway,hoId && refuses 2 "names 'sway' twice" "$moving" -o "$dir/n.phs" --clip sway,hold,sway
}

rounding_is_reported() { # half a step: of positions in Q1.15, of times in 2^-16 s; rotations have 15 bits
    "$asset" "$moving" --report --board pico-display >"$dir/report" && cat "$dir/report" && grep -q '^motion  *8 nodes, 2 clips: sway .* plays, hold' "$dir/report" || return 1
    tr ',\n' '  ' <"$dir/report" | sed 's/.*rounding *//' | awk '{ exit !($1 == "positions" && $2 > 1e-5 && $2 <= 1.6e-5 && $5 == $2 && $0 ~ /of rotation 0\.00[1-4][0-9]* degrees/ && $0 ~ /times [4-7]\.?[0-9]*e-06 s/) }'
}

the_simulator_shows_what_the_kit_has_room_for() { # with --board, of a model that is too large
    "$asset" "$dir/large.obj" -o "$dir/fit.phs" --max-triangles fit --board pico-display 2>"$dir/said" && grep -q 'have room on pico-display' "$dir/said" &&
        "$B/pinhole-sim" --model "$dir/large.obj" --board pico-display --frames 4 --crc >"$dir/fit.sim" 2>"$dir/said" && grep -q 'have room on pico-display' "$dir/said" &&
        [ "$(wc -l <"$dir/said")" = 1 ] && "$B/pinhole-sim" --model "$dir/fit.phs" --board pico-display --frames 4 --crc | cmp - "$dir/fit.sim" || return 1
    "$B/pinhole-sim" --model "$dir/large.obj" --max-triangles 500 --stats 2>"$dir/few" && [ "$(sed -n 's/.*triangles in \([0-9]*\),.*/\1/p' "$dir/few")" -le $((500 + 192)) ] &&
        ! "$B/pinhole-sim" --model "$dir/large.obj" --max-triangles fit --crc 2>"$dir/said" && grep -q 'fit what' "$dir/said"
}

bar_is_for_terminals() { # and goes away
    PINHOLE_PROGRESS='' script -qec "'$asset' '$dir/large.obj' -o '$dir/bar.c' --max-triangles 1000" /dev/null | tr '\r' '\n' >"$dir/terminal" && grep -q '^measuring .*\[####' "$dir/terminal" &&
        [ "$(tail -n 1 "$dir/terminal" | tr -d ' ')" = "" ] && "$asset" "$dir/large.obj" -o "$dir/bar.c" --max-triangles 1000 >"$dir/said" 2>&1 && [ ! -s "$dir/said" ]
}

no_area_is_dropped_or_refused() {
    printf 'v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n' >"$dir/line.obj" && refuses 1 'has no triangle with an area' "$dir/line.obj" -o "$dir/line.c" && [ ! -e "$dir/line.c" ] || return 1
    printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 1 3\nf 2 3 3\n' >"$dir/some.obj" && "$asset" "$dir/some.obj" -o "$dir/some.c" && grep -q 'some: 1 triangles' "$dir/some.c"
}

odd_names_stay_out_of_the_c_file() {
    local odd="$dir/a*%2f\"??.obj"
    odd=${odd/\%2f/\\}
    cp "$dir/sphere.obj" "$odd" && "$asset" "$odd" -o "$dir/odd.c" && compile "$dir/odd.c" "$dir/odd" && ! grep -qF '??' "$dir/odd.c"
}

# 50,000 nodes of one mesh: of triangles that can be simplified, and of fins, three on an edge, that cannot.
nodes() { # corners' coordinates, corners of triangles: base64 of the bytes, then counts of corners and indices
    node -e 'const [, places, faces] = process.argv, p = Float32Array.from(places.split(",")), f = Uint16Array.from(faces.split(",")), b = Buffer.concat([Buffer.from(p.buffer), Buffer.from(f.buffer)]);
        console.log(JSON.stringify({asset: {version: "2.0"}, scenes: [{nodes: [...Array(50000).keys()]}], nodes: [...Array(50000).keys()].map(i => ({mesh: 0, translation: [i % 224 * 3, Math.floor(i / 224) * 3, 0]})),
            meshes: [{primitives: [{attributes: {POSITION: 0}, indices: 1}]}], accessors: [{bufferView: 0, componentType: 5126, count: p.length / 3, type: "VEC3", min: [-1, 0, -1], max: [1, 1, 1]}, {bufferView: 1, componentType: 5123, count: f.length, type: "SCALAR"}],
            bufferViews: [{buffer: 0, byteLength: p.byteLength}, {buffer: 0, byteOffset: p.byteLength, byteLength: f.byteLength}], buffers: [{byteLength: b.length, uri: "data:application/octet-stream;base64," + b.toString("base64")}]}))' "$@"
}

many_nodes_take_seconds() { # of the processor, whatever else runs
    nodes 0,0,0,1,0,0,0,1,0 0,1,2 >"$dir/nodes.gltf" && nodes 0,0,0,0,1,0,1,0,0,-1,0,1,-1,0,-1 0,1,2,0,1,3,0,1,4 >"$dir/fins.gltf" || return 1
    (ulimit -t 10 && "$B/pinhole-sim" --model "$dir/nodes.gltf" --board lm3s6965evb --crc 2>"$dir/said" && grep -q ' of its 50000 triangles have room' "$dir/said") &&
        (ulimit -t 10 && "$asset" "$dir/nodes.gltf" --report >"$dir/report") && [ "$(grep -c fits "$dir/report")" -gt 3 ] &&
        (ulimit -t 10 && "$asset" "$dir/fins.gltf" --report --max-triangles 60000 >"$dir/report") && grep -qE '^triangles +(5[0-9]{4}|60000) of 150000' "$dir/report"
}

# 20,000 meshes with a colour of their own each. Each was compared with all before it, five times: 23 s of a processor.
colours_of_their_own_take_seconds() {
    node -e 'const n = 20000, k = [...Array(n).keys()], p = Float32Array.from([0, 0, 0, 0, 1, 0, 1, 0, 0, -1, 0, 1, -1, 0, -1]), f = Uint16Array.from([0, 1, 2, 0, 1, 3, 0, 1, 4]), b = Buffer.concat([Buffer.from(p.buffer), Buffer.from(f.buffer)]);
        console.log(JSON.stringify({asset: {version: "2.0"}, scenes: [{nodes: k}], nodes: k.map(i => ({mesh: i, translation: [i % 224 * 3, Math.floor(i / 224) * 3, 0]})),
            materials: k.map(i => ({pbrMetallicRoughness: {baseColorFactor: [i % 32 / 31, (i >> 5) % 64 / 63, (i >> 11) % 32 / 31, 1]}})), meshes: k.map(i => ({primitives: [{attributes: {POSITION: 0}, indices: 1, material: i}]})),
            accessors: [{bufferView: 0, componentType: 5126, count: 5, type: "VEC3", min: [-1, 0, -1], max: [1, 1, 1]}, {bufferView: 1, componentType: 5123, count: 9, type: "SCALAR"}],
            bufferViews: [{buffer: 0, byteLength: 60}, {buffer: 0, byteOffset: 60, byteLength: 18}], buffers: [{byteLength: 78, uri: "data:application/octet-stream;base64," + b.toString("base64")}]}))' >"$dir/colours.gltf" || return 1
    (ulimit -t 10 && "$asset" "$dir/colours.gltf" -o "$dir/colours.c" --max-triangles fit --board pico-display 2>"$dir/said") && grep -q ' of its 60000 triangles have room' "$dir/said"
}

refuses() { # status, pattern, arguments...: one line on stderr, nothing on stdout
    local status=$1 pattern=$2 got=0
    shift 2
    "$asset" "$@" >"$dir/out" 2>"$dir/err" || got=$?
    if [ "$got" != "$status" ] || [ "$(wc -l <"$dir/err")" != 1 ] || [ -s "$dir/out" ] || ! grep -qe "$pattern" "$dir/err"; then
        echo "status $got: $*" && cat "$dir/err" && return 1
    fi
}

wrong_usage_is_told() {
    refuses 2 'no model named' && refuses 2 'nothing to do' x.obj && refuses 2 'name a --board' x.obj -o y.c --max-triangles fit &&
        refuses 2 "--background '33669': must be six hexadecimal digits" x.obj --background 33669 && refuses 2 "--light 'up': must be left" x.obj --light up &&
        refuses 2 'power of two' x.obj --texture-size 100 && refuses 2 'one model at a time' x.obj y.obj && refuses 2 'no such option' --turn &&
        refuses 2 'that pinhole-sim --list shows' x.obj --board none && refuses 2 '-o needs a value' x.obj -o && refuses 2 'whole number' x.obj --max-triangles 0 &&
        refuses 2 "-o 'scene.bin': must be a file that ends in .c or .phs" "$scene" -o scene.bin && refuses 2 "--out 'scene': must be" "$scene" --out scene && [ ! -e scene.bin ] && [ ! -e scene ] &&
        refuses 2 'both want stdout' x.obj --report -o - && "$asset" --help | grep -q -- '--max-triangles'
}

bad_models_are_told_and_leave_nothing() {
    rm -f "$dir/n.c" && head -c 300 "$scene" >"$dir/cut.gltf" && echo 'v 1 2 3' >"$dir/points.obj" && : >"$dir/empty.obj" || return 1
    refuses 1 'No such file' "$dir/none.obj" -o "$dir/n.c" && refuses 1 'no model that can be read' "$dir/cut.gltf" -o "$dir/n.c" &&
        refuses 1 'is empty' "$dir/empty.obj" -o "$dir/n.c" && refuses 1 '' "$dir/points.obj" -o "$dir/n.c" && refuses 1 'directory' "$dir" -o "$dir/n.c" &&
        refuses 1 'cannot be written' "$scene" -o "$dir/nowhere/n.c" && refuses 1 'no triangle remains' "$scene" -o "$dir/n.c" --max-triangles 1 && [ "$(echo "$dir"/n.c*)" = "$dir/n.c*" ]
}

a_model_stays_in_its_folder() { # with every program that reads one
    local cow=$dir/cow/cow.obj command
    mkdir -p "$dir/cow" && printf 'newmtl t\nKd 1 0 0\n' >"$dir/secret.mtl" && printf 'mtllib ../secret.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl t\nf 1 2 3\n' >"$cow" || return 1
    for command in "$asset $cow -o $dir/n.c" "$B/pinhole-sim --model $cow --crc" "$B/pinhole-depth advise --model $cow --size 16x16"; do
        $command >"$dir/out" 2>"$dir/err"
        if [ "$?,$(wc -l <"$dir/err")" != 1,1 ] || [ -s "$dir/out" ] || ! grep -q "names ../secret.mtl, which is outside of its folder; --allow-outside" "$dir/err" ||
            ! $command --allow-outside >"$dir/out" 2>"$dir/err" || [ -s "$dir/err" ]; then
            echo "$command" && cat "$dir/err" && return 1
        fi
    done
    rm -f "$dir/n.c"
    [ ! -e "$B/pinhole-panel" ] || "$B/pinhole-panel" --help | grep -q -- '--allow-outside'
}

a_file_limit_leaves_nothing() { # 1 KiB
    mkdir -p "$dir/limit" && (ulimit -f 1 && refuses 1 'n.c: cannot be written: File too large' "$scene" -o "$dir/limit/n.c") && [ -z "$(ls "$dir/limit")" ]
}

too_large_for_the_board_says_what_to_do() {
    refuses 1 'need [0-9]* bytes of memory, and pico-display has [0-9]*; [0-9]* fit: --max-triangles fit (make: SCENE_TRIANGLES=fit)' "$dir/large.obj" --board pico-display -o "$dir/n.c" &&
        refuses 1 'take [0-9]* bytes, and the flash has 15000' "$dir/large.obj" --flash 15000 -o "$dir/n.c" --board pico-display --max-triangles 1000 &&
        refuses 1 'textures take 2056 of the 1500 bytes.*--texture-size 16 has room (make: SCENE_TEXTURE=16)' "$scene" --flash 1500 -o "$dir/n.c" &&
        [ ! -e "$dir/n.c" ]
}

what_does_not_fit_is_reported() {
    ! "$asset" "$dir/large.obj" --board pico-display --report >"$dir/report" 2>"$dir/err" && grep -q '^pico-display .* [0-9][0-9]* too many$' "$dir/report" &&
        [ "$(wc -l <"$dir/err")" = 1 ] && grep -q 'need [0-9]* bytes of memory' "$dir/err"
}

as_said() { # what the lines above advise works; one line says what was done
    "$asset" "$dir/large.obj" --board pico-display -o "$dir/fit.c" --max-triangles fit --report >"$dir/report" 2>"$dir/err" && [ "$(wc -l <"$dir/err")" = 1 ] &&
        grep -q 'have room on pico-display; it was simplified' "$dir/err" && grep -q '^pico-display .* fits$' "$dir/report" && compile "$dir/fit.c" "$dir/fit" &&
        "$dir/fit" pico-display 16 16 >/dev/null && # which fails where a triangle is left out
        "$asset" "$scene" --flash 6000 --texture-size 16 -o "$dir/fit.c"
}

little_room_gets_no_platter() { # on any board; here it is the flash
    "$asset" "$dir/large.obj" --flash 6000 --board lm3s6965evb -o "$dir/small.c" --max-triangles fit 2>"$dir/err" && grep -q 'without a platter' "$dir/err" && grep -q 'arena_bytes_32 = 256' "$dir/small.c"
}

reports_every_board() {
    "$asset" "$scene" --report >"$dir/report" || return 1
    "$B/pinhole-sim" --list | awk '$1 == "board" { print $2 }' | while read -r name; do grep -q "^$name .* fits$" "$dir/report" || { echo "$name" && exit 1; }; done &&
        grep -q "^camera *the file's" "$dir/report" && "$asset" "$scene" --report --turntable | grep -q '^camera *turntable$'
}

an_image_draws_it() { # model, its name: in QEMU, as the compiled file on the simulated board
    local name=lm3s6965evb
    make_image firmware BOARD="$name" SCENE="$1" && timeout 600 "$B/pinhole-emulate" --machine "$name" --board "$name" "$B/firmware/$name-$2.elf" "$dir/emulated" 2 >"$dir/emulated.crc" || return 1
    compile "$B/firmware/$name-$2.scene.c" "$dir/image" && "$dir/image" "$name" 2 1 >"$dir/simulated.crc" && cmp "$dir/emulated.crc" "$dir/simulated.crc" &&
        [ "$(wc -l <"$dir/emulated.crc")" = 2 ]
}

# 12 triangles of a sphere of 1152 are a lump. It is not written without --force.
what_simplification_spoils_is_refused() {
    refuses 1 '[2-9][0-9][.0-9]* % of its pixels are off' "$dir/sphere.obj" -o "$dir/lump.c" --max-triangles 12 && [ ! -e "$dir/lump.c" ] &&
        "$asset" "$dir/sphere.obj" -o "$dir/lump.c" --max-triangles 12 --force && [ -s "$dir/lump.c" ] &&
        "$asset" "$dir/sphere.obj" --report --max-triangles 500 >"$dir/report" && grep -q 'radius, [0-9.]* % of its pixels are off$' "$dir/report" &&
        "$asset" "$dir/sphere.obj" --report >"$dir/report" && ! grep -q 'are off' "$dir/report"
}

an_image_too_large_is_not_made() {
    ! make_image firmware BOARD=lm3s6965evb SCENE="$dir/sphere.obj" SCENE_TRIANGLES=all >"$dir/out" 2>"$dir/err" && grep -q 'SCENE_TRIANGLES=fit' "$dir/err" &&
        [ ! -e "$B/firmware/lm3s6965evb-sphere.elf" ]
}

short "a triangle with two corners in one place is dropped, a model without an area refused" no_area_is_dropped_or_refused
short "the file, the C scene and the binary scene are one picture" the_three_forms_are_one_picture
long "... over a whole turn" the_three_forms_are_one_picture
short "a model that simplification spoils is refused" what_simplification_spoils_is_refused
short "bounds that lie are found" bounds_that_lie_are_found
short "long work shows a bar on a terminal" bar_is_for_terminals
short "the simulator shows what the kit has room for" the_simulator_shows_what_the_kit_has_room_for
short "compiled_scene_draws_the_simulators_bytes_and_those_of_the_model" same_frames "$scene" 4294967295 pico-display
long "... on other boards, too" same_frames "$scene" 4294967295 waveshare-pico-lcd-1in3 lm3s6965evb sim-ili9488
long "compiled_turntable_draws_the_simulators_bytes_and_those_of_the_model" sphere_frames "$dir/sphere.obj" 4294967295 rpi-waveshare-1in3 rpi-mini-pitft-1in14
if command -v node >/dev/null; then
    long "fifty thousand nodes take seconds" many_nodes_take_seconds
    long "twenty thousand colours take seconds" colours_of_their_own_take_seconds
else
    skip "fifty thousand nodes take seconds" "no node: apt-get install nodejs"
fi
long "simplified_scene_draws_the_simulators_bytes" same_frames "$dir/sphere.obj" 500 pico-display waveshare-pico-lcd-0in96
short "a simplified animation draws the simulator's bytes" same_frames "$moving" 36 pico-display
long "simplified_scene_is_close_to_the_model" close_to_the_model
short "frames_move" frames_move
short "background and light in C and in 16 bytes of a binary scene" studio_in_c
short "other_data_is_seen" other_data_is_seen
short "output_is_deterministic" output_is_deterministic
short "too_large_for_the_board_says_what_to_do" too_large_for_the_board_says_what_to_do
short "what does not fit is reported, and refused" what_does_not_fit_is_reported
short "what_it_says_to_do_works" as_said
short "little_room_gets_no_platter" little_room_gets_no_platter
short "clang_and_arm_gcc_compile_it_and_its_size_is_as_reported" clang_and_arm_compile_it "$scene"
long "so they do with an animation" clang_and_arm_compile_it "$moving"
short "a clip is played by its name in every form" clips_are_played_by_name
short "the select button fades into the next clip, as fast as --cross-fade says" clips_fade_into_each_other
short "several clips play in turn in every form, whichever frame is drawn first" clips_take_turns
short "the report says by how much 16-bit numbers are off" rounding_is_reported
short "filters_are_in_the_file_and_change_the_picture" filters_are_in_the_file
short "odd_names_stay_out_of_the_c_file" odd_names_stay_out_of_the_c_file
short "wrong_usage_is_told" wrong_usage_is_told
short "bad_models_are_told_and_leave_nothing" bad_models_are_told_and_leave_nothing
short "a model reads nothing outside of its folder unless it may" a_model_stays_in_its_folder
short "a_file_limit_leaves_nothing" a_file_limit_leaves_nothing
short "every_board_is_in_the_report" reports_every_board
if ! command -v arm-none-eabi-gcc >/dev/null || ! command -v qemu-system-arm >/dev/null; then
    skip "an_image_draws_it_in_an_emulated_kit" "no arm-none-eabi-gcc or no qemu-system-arm"
else
    long "an_image_draws_it_in_an_emulated_kit" an_image_draws_it "$scene" scene
    long "an_image_plays_an_animation_in_an_emulated_kit" an_image_draws_it "$moving" moving
    long "an_image_too_large_for_its_board_is_not_made" an_image_too_large_is_not_made
fi
tap_end
