#!/usr/bin/env bash
# pinhole-sim's command line: every option has an effect, every wrong one gives one line and exit 2, what is written is
# whole or not there, and other programs read it.
# shellcheck disable=SC2317,SC2015 # functions are called by check; `A && B || { echo; return 1; }` says why it fails
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
sim=$(realpath "${B:-build}/pinhole-sim") || exit 1
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
small=(--size 48x40)

# ---- helpers

# What takes long looks at every Nth of the lines on stdin here, and at all of them in long_sim_cli.sh.
few() { # N
    if [ -n "${LONG-}" ]; then cat; else awk -v n="$1" 'NR % n == 1'; fi
}
thorough() { short "$1" "$1" && long "$1, of all" "$1"; }

crcs() { # options...: the CRCs of its frames, without their numbers
    local lines
    "$sim" "$@" --crc >"$dir/crcs" && mapfile -t lines <"$dir/crcs" && [ ${#lines[@]} -gt 0 ] && printf '%s\n' "${lines[@]##* }"
}

# Draws with the options before and behind `--`; both must succeed.
draw_two() {
    local one=()
    while [ "$1" != -- ]; do one+=("$1") && shift; done
    shift
    crcs "${one[@]}" >"$dir/one" && crcs "$@" >"$dir/two" && [ -s "$dir/one" ] && [ -s "$dir/two" ]
}

differ() {
    draw_two "$@" || return 1
    ! cmp -s "$dir/one" "$dir/two"
}

same() {
    draw_two "$@" || return 1
    diff "$dir/one" "$dir/two"
}

# Exit status, one line on stderr that matches the pattern, nothing on stdout.
refuses() { # status, pattern, options...
    local status=$1 pattern=$2 got=0 said
    shift 2
    timeout 1000 "$sim" "$@" >"$dir/stdout" 2>"$dir/stderr" || got=$?
    mapfile said <"$dir/stderr"
    [ "$got" = "$status" ] && [ ${#said[@]} = 1 ] && [[ ${said[0]} == *$'\n' ]] && [ ! -s "$dir/stdout" ] &&
        grep -q "^pinhole-sim: .*$pattern" "$dir/stderr" || { echo "exit $got:" "$@" && head -n 5 "$dir/stderr" && return 1; }
}

stat_of() { # name, options...: a number from --stats
    local name=$1
    shift
    "$sim" "$@" --stats 2>&1 | sed -n "s/.* $name \([0-9][0-9]*\).*/\1/p" | head -n 1
}

# ---- each option has an effect

deep=(--demo turntable "${small[@]}" --near .001 --far 500)

depth_in_use() { # format, options...
    "$sim" --demo cube "${small[@]}" --stats "${@:2}" 2>&1 | grep -q "depth $1;"
}

depth_auto_is_fixed16_up_to_64_times_near() {
    depth_in_use fixed16 --near 1 --far 64 && depth_in_use float16-e4 --near 1 --far 64.001 &&
        depth_in_use fixed16 --near .01 --far 100 --projection ortho && depth_in_use float16-e3 --depth float16 --near 1 --far 2 &&
        depth_in_use linear-w --depth linear-w && depth_in_use float24-e4 --depth float24 && depth_in_use fixed24 --depth fixed24
}

depth_exponent_is_what_the_lens_needs_or_as_asked() {
    depth_in_use float16-e4 --near .5 --far 8192 && depth_in_use float16-e5 --near .5 --far 8192.01 && depth_in_use float24-e5 --depth float24 --near .1 --far 10000 &&
        depth_in_use float16-e6 --depth float16-e6 && depth_in_use float24-e3 --depth float24-e3 --near .1 --far 10000
}

depth_of_other_widths_is_refused() {
    local depth
    for depth in float16-e2 float16-e7 float16-e float16-e5x float16-e05 fixed16-e4 linear-w-e4 float16-E4; do
        refuses 2 "depth '$depth': must be" --crc --depth "$depth" || return 1
    done
}

help_names_every_option() {
    local option
    "$sim" --help >"$dir/help" || return 1
    for option in demo model board size frames start out rotate camera fov focal near far projection convention view-matrix projection-matrix flatten depth band crc \
        view keys window matrix stats list help; do
        grep -q "^  --$option\b" "$dir/help" || { echo "$option" && return 1; }
    done
}

list_has_one_line_for_each() {
    "$sim" --list >"$dir/list" || return 1
    ! grep -vE '^(demo  +[a-z0-9-]+ +[0-9]+ frames?|board  +[a-z0-9-]+ +[0-9]+x[0-9]+) +[^ ]' "$dir/list" && [ "$(grep -c ^demo "$dir/list")" -ge 8 ] &&
        [ "$(grep -c ^board "$dir/list")" -ge 5 ]
}

loops_are_as_long_as_the_list_says() {
    local name frames
    while read -r _ name frames _; do
        same --demo "$name" "${small[@]}" -- --demo "$name" "${small[@]}" --start "$frames" || { echo "$name $frames" && return 1; }
        [ "$frames" = 1 ] || differ --demo "$name" "${small[@]}" --start 1 -- --demo "$name" "${small[@]}" --start $((frames / 2 + 1)) || return 1
    done < <("$sim" --list | grep -E '^demo +(turntable|testcard|torus|cube|fill|wireframe) ' | few 3)
}

everything_on_the_list_can_be_drawn() {
    local kind name
    while read -r kind name _; do
        case $kind in
        demo) set -- --demo "$name" "${small[@]}" ;;
        *) set -- --demo testcard --board "$name" ;;
        esac
        "$sim" "$@" --crc >"$dir/crc" 2>"$dir/stderr" || { echo "$@" && cat "$dir/stderr" && return 1; }
        grep -q 'Hz is above\|^$' "$dir/stderr" || [ ! -s "$dir/stderr" ] || { echo "$@" && cat "$dir/stderr" && return 1; }
    done < <("$sim" --list | few 7)
}

board_has_its_own_size() {
    "$sim" --list | grep ^board >"$dir/boards"
    local name size
    while read -r _ name size _; do
        "$sim" --board "$name" --demo testcard --out "$dir/board.ppm" 2>/dev/null || return 1
        [ "$(sed -n 2p "$dir/board.ppm" | head -c 20 | tr ' ' x)" = "$size" ] || { echo "$name $size" && return 1; }
    done < <(head -n 3 "$dir/boards")
}

size_is_the_picture_s() {
    "$sim" --size 33x21 --out "$dir/size.ppm" && [ "$(head -c 13 "$dir/size.ppm" | tr '\n' ' ')" = "P6 33 21 255 " ] &&
        [ "$(wc -c <"$dir/size.ppm")" = $((13 + 33 * 21 * 3)) ]
}

frames_and_start_count() {
    local lines
    lines=$("$sim" --demo torus "${small[@]}" --start 7 --frames 3 --crc) || return 1
    [ "$(cut -d' ' -f1-3 <<<"$lines" | tr '\n' ,)" = "frame 7 crc32,frame 8 crc32,frame 9 crc32," ] || { echo "$lines" && return 1; }
    [ "$(tail -n 1 <<<"$lines")" = "$("$sim" --demo torus "${small[@]}" --start 9 --crc)" ]
}

the_highest_count_is_followed_by_0() {
    "$sim" --demo torus "${small[@]}" --start 4294967295 --frames 2 --crc --out "$dir/high" >"$dir/said" &&
        [ "$(cut -d' ' -f1-3 "$dir/said" | tr '\n' ,)" = "frame 4294967295 crc32,frame 0 crc32," ] && [ "$(cd "$dir/high" && echo *)" = "frame-0000000000.ppm frame-4294967295.ppm" ] &&
        [ "$(tail -n 1 "$dir/said")" = "$("$sim" --demo torus "${small[@]}" --crc)" ]
}

near_cuts() { differ --demo torus "${small[@]}" --near 0.5 -- --demo torus "${small[@]}" --near 2.9; }
far_cuts() { differ --demo torus "${small[@]}" --far 100 -- --demo torus "${small[@]}" --far 2.9; }

rotations_show_the_same_upright_picture() { # on a panel that is not square
    same --demo testcard --size 60x40 --rotate 0 -- --demo testcard --size 60x40 --rotate 180 &&
        same --demo testcard --size 60x40 --rotate 90 -- --demo testcard --size 60x40 --rotate 270 &&
        same --demo testcard --size 60x40 --rotate 90 -- --demo testcard --size 40x60 --rotate 0 &&
        differ --demo testcard --size 60x40 --rotate 0 -- --demo testcard --size 60x40 --rotate 90
}

bands_do_not_change_the_picture() {
    local lines
    for lines in 7 16 40 1024; do
        same --demo turntable "${small[@]}" --frames 2 --band 1 -- --demo turntable "${small[@]}" --frames 2 --band "$lines" || return 1
    done
}

bands_are_what_is_sent_at_a_time() {
    local one forty
    one=$(stat_of writes --demo cube "${small[@]}" --band 1) && forty=$(stat_of writes --demo cube "${small[@]}" --band 40) &&
        [ "$one" -gt $((forty + 30)) ] || { echo "$one $forty" && return 1; }
}

stats_add_up() { # the bus has 62.5 MHz
    local bytes us
    bytes=$(stat_of wire --demo torus --size 64x64) && us=$(stat_of bus --demo torus --size 64x64) &&
        [ "$bytes" -ge $((64 * 64 * 2)) ] && [ "$bytes" -lt $((64 * 64 * 2 + 64)) ] &&
        [ "$(stat_of in --demo torus --size 64x64)" = 1024 ] && [ "$(stat_of vertices --demo torus --size 64x64)" = 512 ] &&
        [ "$(stat_of dropped --demo torus --size 64x64)" = 0 ] &&
        [ "$us" = $(((bytes * 8 * 1000 + 31250) / 62500)) ] || { echo "$bytes $us" && return 1; }
}

crc_is_the_one_of_gzip() {
    local expected
    "$sim" --demo cube "${small[@]}" --out "$dir/crc.ppm" --crc >"$dir/crc" || return 1
    expected=$(tail -c $((48 * 40 * 3)) "$dir/crc.ppm" | gzip -c | tail -c 8 | head -c 4 | od -An -tx1 | awk '{ print toupper($4 $3 $2 $1) }')
    [ "$(cat "$dir/crc")" = "frame 0 crc32 $expected" ] || { cat "$dir/crc" && echo "$expected" && return 1; }
}

# With any option of the camera all that is not given is what --help says, and not the demo's own.
lens_is_the_documented_one_or_the_demo_s() {
    local demo one lens=(--fov 60 --near 0.5 --far 100 --projection perspective)
    for demo in $(printf '%s\n' turntable torus cube wireframe | few 4); do
        for one in --fov=60 --near=0.5 --far=100 --projection=perspective; do
            same --demo "$demo" "${small[@]}" "$one" -- --demo "$demo" "${small[@]}" "${lens[@]}" || return 1
        done
        for one in eye=0,2,9 eye=0,0,.9; do
            same --demo "$demo" "${small[@]}" --camera "$one" -- --demo "$demo" "${small[@]}" --camera "$one" "${lens[@]}" || return 1
        done
        [ "$(stat_of drawn --demo "$demo" "${small[@]}" --camera eye=0,5,15)" -gt 0 ] || { echo "$demo: empty" && return 1; }
        differ --demo "$demo" "${small[@]}" -- --demo "$demo" "${small[@]}" --near 2.9 || return 1
    done
    differ --demo turntable "${small[@]}" -- --demo turntable "${small[@]}" --fov 60
}

h_is_help() {
    "$sim" -h | cmp - <("$sim" --help)
}

frustum_without_window_is_the_perspective() {
    same --demo torus --size 40x40 --projection frustum --fov 50 -- --demo torus --size 40x40 --projection perspective --fov 50 &&
        differ --demo torus --size 40x40 --projection frustum=-.5,.5,-.5,.5 -- --demo torus --size 40x40 --projection frustum=-.2,.5,-.5,.5
}

grid() { # side: a wrinkled sheet of that many points by as many
    awk -v n="$1" 'BEGIN { for (i = 0; i < n; i++) for (j = 0; j < n; j++) print "v", i, (i * j) % 3, j
                           for (i = 1; i < n; i++) for (j = 1; j < n; j++) print "f", n * i + j, n * i + j + 1, n * (i - 1) + j + 1, n * (i - 1) + j }'
}

the_smallest_pictures_are_drawn() {
    local demo size
    for demo in $("$sim" --list | awk '$1 == "demo" { print $2 }' | few 8); do
        for size in 1x1 1x2 2x1; do
            "$sim" --demo "$demo" --size "$size" --crc >"$dir/stdout" || { echo "$demo $size" && return 1; }
        done
    done
}

a_model_too_large_names_what_helps() {
    local bytes
    grid 48 >"$dir/grid.obj" && grid 60 >"$dir/grid60.obj"
    bytes=$(($(sed -n 's/^#define BUDGET_RP2040 .*scene_bytes = //p' boards/budgets.h)))
    "$sim" --model "$dir/grid.obj" --board pico-display --max-triangles all --crc 2>"$dir/stderr" >"$dir/stdout" && [ "$(wc -l <"$dir/stderr")" = 1 ] &&
        grep -q "do not fit pico-display's $bytes bytes and are left out; leave --max-triangles out, or say --max-triangles fit$" "$dir/stderr" &&
        refuses 1 "its $bytes bytes do not hold .*/grid60.obj; leave --max-triangles out, or say --max-triangles fit$" --model "$dir/grid60.obj" --board pico-display --max-triangles all --crc
}

bar_is_for_terminals() { # and goes away
    PINHOLE_PROGRESS='' script -qec "'$sim' --size 16x16 --frames 30 --out '$dir/bar'" /dev/null >"$dir/terminal" && grep -q 'frames .*\[####' "$dir/terminal" &&
        [ "$(tr '\r' '\n' <"$dir/terminal" | tail -n 1 | tr -d ' \n')" = "" ] &&
        "$sim" --size 16x16 --frames 30 --out "$dir/bar" >"$dir/stdout" 2>"$dir/stderr" && [ ! -s "$dir/stdout" ] && [ ! -s "$dir/stderr" ]
}

model_has_an_effect() {
    printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >"$dir/one.obj"
    differ --model "$dir/one.obj" "${small[@]}" -- --demo turntable "${small[@]}" &&
        differ --model "$dir/one.obj" "${small[@]}" --start 0 -- --model "$dir/one.obj" "${small[@]}" --start 32 &&
        [ "$(stat_of dropped --model "$dir/one.obj" "${small[@]}")" = 0 ] && printf 'v 1 2 3\nv 3 2 1\nv 2 2 2\np 1 2 3\n' >"$dir/points.obj" &&
        refuses 1 'no triangles' --model "$dir/points.obj" --crc &&
        printf 'v 0 0 0\nv 1 1 0\nv 2 2 0\nf 1 2 3\n' >"$dir/thin.obj" && refuses 1 'no triangle with an area' --model "$dir/thin.obj" --crc
}

focus_blurs() { # a strength of 0 is sharp at every distance
    differ --demo focus "${small[@]}" --focus 3 -- --demo focus "${small[@]}" --focus 8 &&
        differ --demo focus "${small[@]}" --focus 3,4 -- --demo focus "${small[@]}" --focus 3,2 &&
        same --demo focus "${small[@]}" --focus 3,0 -- --demo focus "${small[@]}" --focus 8,0
}

fisheye_sees_behind_itself() { # beyond what a perspective can
    differ --demo torus "${small[@]}" --projection fisheye --fov 120 -- --demo torus "${small[@]}" --projection perspective --fov 120 &&
        differ --demo torus "${small[@]}" --projection fisheye --fov 240 -- --demo torus "${small[@]}" --projection fisheye --fov 180 &&
        same --demo torus "${small[@]}" --projection fisheye -- --demo torus "${small[@]}" --projection fisheye --fov 180
}

# A camera at an odd place, so that a sign that is lost somewhere shows.
odd=(--demo cube "${small[@]}" --camera "eye=1,.75,2,target=.25,.1,-.5,up=.1,1,.2")

conventions_draw_the_same_bytes() {
    local convention projection
    for projection in $(printf '%s\n' perspective ortho=-2,2.5,-1,1 frustum=-.5,.25,-.5,.5 fisheye | few 2); do
        for convention in d3d lmu reversed; do
            same "${odd[@]}" --projection "$projection" --near 1.5 --far 3 -- "${odd[@]}" --projection "$projection" --near 1.5 --far 3 --convention "$convention" || return 1
        done
    done
    same "${odd[@]}" -- "${odd[@]}" --convention d3d
}

matrices() { # rows first..last, options...: those rows of --matrix
    local rows=$1
    shift
    "$sim" --matrix "$@" | sed -n "${rows}p"
}

matrices_are_the_documents() { # HAW exercise 6; the others by hand: 4600 f/(f-n), -fn/(f-n); LMU (n+f)/(n-f), 2nf/(f-n)
    local camera=(--camera "eye=0,0,5" --fov 90 --near 2 --far 10 --size 200x100) convention expected
    while read -r convention expected; do
        [ "$(matrices 6,10 "${camera[@]}" --convention "$convention" | tr '\n' ' ')" = "projection $expected " ] ||
            { echo "$convention: expected $expected" && matrices 6,10 "${camera[@]}" --convention "$convention" && return 1; }
    done <<'END'
gl 0.5 0 0 0 0 1 0 0 0 0 -1.5 -5 0 0 -1 0
d3d 0.5 0 0 0 0 1 0 0 0 0 1.25 -2.5 0 0 1 0
lmu -0.5 0 0 0 0 -1 0 0 0 0 -1.5 -5 0 0 1 0
reversed 0.5 0 0 0 0 1 0 0 0 0 0.25 2.5 0 0 -1 0
END
    [ "$(matrices 1,5 "${camera[@]}" | tr '\n' ' ')" = "view 1 0 0 0 0 1 0 0 0 0 1 -5 0 0 0 1 " ] &&
        [ "$(matrices 4 "${camera[@]}" --convention d3d)" = "0 0 -1 5" ] &&
        [ "$(matrices 11,15 "${camera[@]}" | tr '\n' ' ')" = "viewport 100 0 0 100 0 -50 0 50 0 0 1 0 0 0 0 1 " ] &&
        [ "$(matrices 13 "${camera[@]}" --convention lmu)" = "0 50 0 50" ] && [ "$("$sim" --matrix "${camera[@]}" | wc -l)" = 15 ]
}

# LMU's planes are coordinates: n = -2, f = -10. And 4600's simplest camera, whose world is left-handed as it is: 5 before the
# origin, which it sees as ours does from (0,0,5).
each_convention_is_typed_as_it_is_written() {
    same "${odd[@]}" --near 2 --far 10 -- "${odd[@]}" --convention lmu --near -2 --far -10 &&
        same --demo cube "${small[@]}" --camera eye=0,0,5 -- --demo cube "${small[@]}" --convention d3d --view-matrix 1,0,0,0,0,1,0,0,0,0,1,5,0,0,0,1 &&
        [ "$(matrices 2,5 --convention d3d --view-matrix 1,0,0,0,0,1,0,0,0,0,1,5,0,0,0,1 | tr '\n' ' ')" = "1 0 0 0 0 1 0 0 0 0 1 5 0 0 0 1 " ] &&
        same --demo cube "${small[@]}" --camera eye=5,0,0 -- --demo cube "${small[@]}" --convention d3d --view-matrix 0,0,1,0,0,1,0,0,-1,0,0,5,0,0,0,1
}

# A wrong matrix is refused with its mistake, and drawn --anyway: HAW's projection onto z = -2 has a lens's picture.
a_wrong_matrix_is_explained_and_drawn() {
    local camera=(--demo cube "${small[@]}" --camera "eye=2,1,5")
    refuses 2 'row 2, column 3 has the other sign: near goes to 4, not -1' "${camera[@]}" --crc --projection-matrix .5,0,0,0,0,1,0,0,0,0,-1.5,5,0,0,-1,0 &&
        refuses 2 'handedness: determinant -1' --demo cube --crc --view-matrix 1,0,0,0,0,1,0,0,0,0,-1,-5,0,0,0,1 &&
        [ "$("$sim" "${camera[@]}" --crc --anyway --projection-matrix 2,0,0,0,0,2,0,0,0,0,2,0,0,0,-1,0 2>"$dir/stderr")" = \
            "$("$sim" "${camera[@]}" --crc --projection frustum=-.05,.05,-.05,.05 --near .1 --far 1000)" ] && grep -q 'flattens: no depth' "$dir/stderr" &&
        [ "$("$sim" "${camera[@]}" --crc --anyway --projection-matrix .5,0,0,0,0,1,0,0,0,0,-1.5,5,0,0,-1,0 2>"$dir/stderr")" = \
            "$("$sim" "${camera[@]}" --crc --near 100 --far 101)" ] && grep -q 'nothing is visible' "$dir/stderr"
}

# HAW's exercise 6 from (0,0,5): (1,2,-1) lies 6 before the eye: z_ndc = 3/2 - 5/6. An object at (1,0,-1) whose z points at +x.
a_point_is_told_at_every_stage() {
    local camera=(--camera "eye=0,0,5" --fov 90 --near 2 --far 10 --size 200x100)
    "$sim" "${camera[@]}" --point 1,2,-1 >"$dir/point" && grep -q '^ndc.z 2/3 0.666666666667 43691 +0.333$' "$dir/point" &&
        grep -q '^clip.x 1/2 ' "$dir/point" && grep -q '^pixel.x 325/3 ' "$dir/point" && [ "$(grep -c '^depth\.' "$dir/point")" = 5 ] &&
        "$sim" "${camera[@]}" --point 0,2,0 --object 1,0,-1 | grep -qx 'ndc.z 2/3 0.666666666667 43691 +0.333' &&
        "$sim" "${camera[@]}" --point 0,0,2 --object 1,0,-1,target=5,0,-1 | grep -q '^world.x 3 ' &&
        [ "$(matrices 1,5 "${camera[@]}" --object 1,0,-1,target=5,0,-1 | tr '\n' ' ')" = "object 0 0 1 1 0 1 0 0 -1 0 0 -1 0 0 0 1 " ]
}

# The moon of solar is 4.9 from the sun in frame 0; after a quarter of a year the earth is at (0,0,-4), and the month at its start.
a_camera_rides_on_a_mesh() {
    local moon=(--demo solar --camera "eye=0,0,2" --parent 2 --size 48x40)
    [ "$("$sim" "${moon[@]}" --matrix factors | awk '/^camera.*3 / { print $4 }' | tr '\n' ' ')" = "321126 0 131072 " ] &&
        [ "$("$sim" "${moon[@]}" --start 256 --matrix factors | awk '/^camera.*3 / { print $4 }' | tr '\n' ' ')" = "58982 0 -131072 " ] &&
        same "${moon[@]}" -- --demo solar "${small[@]}" --camera eye=4.89999,0,2,target=4.89999,0,0 &&
        differ "${moon[@]}" -- --start 3 "${moon[@]}" &&
        refuses 2 'frame 0 has 6 meshes' --demo solar --camera eye=0,0,2 --parent 6 --crc
}

# The depth buffer has greys only (as far as RGB565 has them), differs by format, and goes the way to any kit's glass.
depth_is_shown_in_greys() {
    differ --demo cube "${small[@]}" --show depth -- --demo cube "${small[@]}" &&
        differ --demo cube "${small[@]}" --show depth --depth fixed16 -- --demo cube "${small[@]}" --show depth --depth float16 &&
        same --demo focus "${small[@]}" --show depth --band 7 -- --demo focus "${small[@]}" --show depth && crcs --demo solar --board waveshare-rp2040-lcd-1in28 --show depth &&
        "$sim" --demo cube "${small[@]}" --show depth --out - | od -An -v -tu1 -w3 -j13 |
        awk '{ most = $1 > $2 ? $1 - $2 : $2 - $1; wrong += $1 != $3 || most > 8; bright += $1 > 0 } END { exit wrong > 0 || bright < 100 }'
}

# Each command for teachers (host-sim/README.md) draws or prints something; the one that shows a mistake is refused.
the_teachers_commands_work() {
    local words status
    # shellcheck disable=SC2016 # backquotes of the paper
    sed -n '/^## For teachers/,/^## pinhole-asset/s/`\(pinhole-sim [^`]*\)`/\n\1\n/gp' host-sim/README.md | grep '^pinhole-sim ' >"$dir/commands"
    [ "$(wc -l <"$dir/commands")" -ge 25 ] || return 1
    while read -ra words; do
        status=0
        "$sim" "${words[@]:1}" --scale 1 --crc >"$dir/stdout" 2>"$dir/stderr" || status=$?
        case "$status ${words[*]}" in
        "2 pinhole-sim --crc --projection-matrix"*) grep -q 'row 2, column 3 has the other sign' "$dir/stderr" ;;
        0*) [ -s "$dir/stdout" ] ;;
        *) false ;;
        esac || { echo "${words[*]}" && cat "$dir/stderr" && return 1; }
    done < <(sed 's/ --window//' "$dir/commands" | few 4)
}

# 16:9 at 60 degrees: cot 30 9/16 = 63850.32 / 65536.
a_picture_of_16_to_9_has_its_own_width() { [ "$(matrices 7 --size 320x180 --fov 60)" = "0.974273681640625 0 0 0" ]; }

# conventions: four quarters, whose shifts say which (6 of 16 parts of the height each: the rest is the labels'); cube: one camera, as ever
all_cameras_of_a_demo_are_printed() {
    local demo
    "$sim" --matrix --demo conventions >"$dir/matrix" && [ "$(grep -cx view "$dir/matrix")" = 4 ] &&
        [ "$(awk 'NR % 16 == 8 || NR % 16 == 9 { print $3 }' "$dir/matrix" | tr '\n' ' ')" = '0.5 -0.625 -0.5 -0.625 0.5 0.625 -0.5 0.625 ' ] &&
        [ "$(grep ^camera "$dir/matrix" | tr '\n' ' ')" = 'camera 1 of 4 camera 2 of 4 camera 3 of 4 camera 4 of 4 ' ] || return 1
    for demo in zoom parallel; do [ "$("$sim" --matrix --demo "$demo" | grep -c '^camera [12] of 2$')" = 2 ] || return 1; done
    ! "$sim" --matrix --demo cube | grep camera
}

# One camera in the words of several documents: HAW's exercise 2 (at (5,0,0), its axes in columns), PHIGS of EECE, LMU's quaternion.
ways_to_state_a_view_agree() {
    local way
    for way in vrp=5,0,0,vpn=1,0,0 vpn=2,0,0,vup=0,3,0,vrp=5,0,0 ypr=90,0,0,eye=5,0,0 ypr=450,0,0,eye=5,0,0 quat=1,0,1,0,eye=5,0,0 \
        quat=-.5,0,-.5,0,eye=5,0,0; do
        same --demo cube "${small[@]}" --camera eye=5,0,0 -- --demo cube "${small[@]}" --camera "$way" || { echo "$way" && return 1; }
    done
    [ "$(matrices 2,5 --camera quat=1,0,1,0,eye=5,0,0 | tr '\n' ' ')" = "0 0 -1 0 0 1 0 0 1 0 0 -5 0 0 0 1 " ] &&
        [ "$(matrices 2,5 --camera ypr=0,90,0 | tr '\n' ' ')" = "1 0 0 0 0 0 1 0 0 -1 0 0 0 0 0 1 " ] && # looks up the y axis
        [ "$(matrices 2,5 --camera ypr=0,0,90 | tr '\n' ' ')" = "0 1 0 0 -1 0 0 0 0 0 1 0 0 0 0 1 " ]   # its right is up
}

# KAIST 4.10, 4600: y' = y f / z: an image 2 high at the distance 1 sees 90 degrees; HAW: behind the hole it is upside down.
focal_is_the_distance_of_the_image() {
    same "${odd[@]}" --fov 90 -- "${odd[@]}" --focal 1 && same "${odd[@]}" --fov 90 -- "${odd[@]}" --focal 3,6 &&
        differ "${odd[@]}" --focal 1 -- "${odd[@]}" --focal 1,1 &&
        same --demo cube "${small[@]}" --camera eye=2,1,5,up=0,-1,0 --fov 90 -- --demo cube "${small[@]}" --camera eye=2,1,5 --focal -1
}

# One camera between the ground and the sky, with much behind it, in the matrices of the documents, by hand. LMU's w is
# negative for what is visible, and a matrix may be multiplied by anything above 0.
matrices_of_all_conventions_draw_the_same() {
    local camera=(--demo ground --size 200x100) view=1,0,0,0,0,1,0,-1,0,0 below=0,0,0,1 convention z lens
    while read -r convention z lens; do
        same "${camera[@]}" --camera eye=0,1,-3,target=0,1,-4 --fov 90 --near 2 --far 10 -- \
            "${camera[@]}" --convention "$convention" --view-matrix "$view,$z,$below" --projection-matrix "$lens" ||
            { echo "$convention" && return 1; }
    done <<'END'
gl 1,3 .5,0,0,0,0,1,0,0,0,0,-1.5,-5,0,0,-1,0
gl 1,3 1,0,0,0,0,2,0,0,0,0,-3,-10,0,0,-2,0
d3d -1,-3 .5,0,0,0,0,1,0,0,0,0,1.25,-2.5,0,0,1,0
lmu 1,3 -.5,0,0,0,0,-1,0,0,0,0,-1.5,-5,0,0,1,0
reversed 1,3 .5,0,0,0,0,1,0,0,0,0,.25,2.5,0,0,-1,0
END
    differ "${camera[@]}" --convention gl --projection-matrix .5,0,0,0,0,1,0,0,0,0,-1.5,-5,0,0,-1,0 -- \
        "${camera[@]}" --convention gl --projection-matrix .5,0,.25,0,0,1,.5,0,0,0,-1.5,-5,0,0,-1,0 || return 1
    # off-axis (EECE's glFrustum) and parallel (KAIST 4.8), with a view of odd numbers: what is printed is read again
    for lens in frustum=-.5,.25,-.5,.5 ortho=-2,2.5,-1,1; do
        "$sim" "${odd[@]}" --projection "$lens" --near 1 --far 3 --matrix >"$dir/matrix" || return 1
        view=$(sed -n 2,5p "$dir/matrix" | tr ' \n' ,,) lens=$(sed -n 7,10p "$dir/matrix" | tr ' \n' ,,)
        "$sim" "${small[@]}" --view-matrix "${view%,}" --projection-matrix "${lens%,}" --matrix | cmp - "$dir/matrix" || return 1
    done
}

flattening_matrices_are_the_documents() {
    local flat expected
    while read -r flat expected; do
        [ "$(matrices 16,20 --flatten "$flat" | tr '\n' ' ')" = "flatten $expected " ] || { matrices 16,20 --flatten "$flat" && return 1; }
    done <<'END'
kaist-4.7 1 0 0 0 0 1 0 0 0 0 0 0 0 0 0 1
kaist-4.11 1 0 0 0 0 1 0 0 0 0 0 0 0 0 1 0
eece=4 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0.25 0
plane=0,2,0,3 3 0 0 0 0 3 0 0 0 0 3 0 0 -1 0 0
END
}

matrices_round_trip() { # what is printed is a whole number of 65536ths, exactly
    "$sim" --matrix --demo cube --start 17 --size 77x31 "${odd[@]:4}" | grep '[0-9] ' | tr ' ' '\n' >"$dir/numbers" && [ "$(wc -l <"$dir/numbers")" = 48 ] &&
        awk '{ if ($1 * 65536 != int($1 * 65536)) { print; exit 1 } }' "$dir/numbers"
}

matrix_of_a_demo_is_its_own() { # 60 degrees: 1 / tan 30, nearest of Q16.16
    local scale
    scale=$(matrices 8 --demo cube --size 64x64 | cut -d' ' -f2) && [ "$scale" = 1.7320556640625 ] || { echo "$scale" && return 1; }
}

matrix_needs_no_picture_and_takes_one() {
    [ "$("$sim" --matrix "${small[@]}" --frames 5 | wc -l)" = 15 ] && [ "$("$sim" --matrix "${small[@]}" --crc --frames 5 | wc -l)" = 20 ] &&
        "$sim" --matrix "${small[@]}" --out - 2>"$dir/stderr" | cmp - <("$sim" "${small[@]}" --out -) && [ "$(wc -l <"$dir/stderr")" = 15 ]
}

# ---- views and buttons

views_are_different_pictures() {
    same --demo solar "${small[@]}" -- --demo solar "${small[@]}" --view outside &&
        differ --demo solar "${small[@]}" --view moon -- --demo solar "${small[@]}" --view sun
}

list_names_the_views() {
    "$sim" --list | grep -q '^demo  *solar .*--view outside sun moon fixed$'
}

# Presses the lines of $1 (; between them) in 40 frames of the turntable.
pressed() {
    "$sim" --demo turntable "${small[@]}" --frames 40 --crc --keys <(tr ';' '\n' <<<"$1")
}

without_presses_nothing_changes() {
    diff <("$sim" --demo turntable "${small[@]}" --frames 40 --crc) <(pressed '# nothing;  ;50 up+left 9 # too late')
}

buttons_change_frames_from_their_own_on() { # and what goes there and back is where it was
    local button
    for button in left right up down; do
        cmp <(pressed "#") <(pressed "10 $button 3") >"$dir/cmp"
        [ "$(sed 's/.*line //' "$dir/cmp")" = 11 ] || { echo "$button" && cat "$dir/cmp" && return 1; }
    done
    diff <(pressed '#' | tail -n 10) <(pressed '5 left 4;20 right;22 right;24 right;26 right' | tail -n 10) &&
        diff <(pressed '#' | tail -n 20) <(pressed '5 left+up 4; 9 down+right 4' | tail -n 20) &&
        diff <(pressed '#' | tail -n 20) <(pressed '5 left+right 4' | tail -n 20)
}

lines_of_a_script_add_up() {
    diff <(pressed '10 left;12 left;11	left') <(pressed '10 left 3') && diff <(pressed '10 left+up 2') <(pressed '10 up 2;10 left 2') &&
        ! cmp -s <(pressed '10 left 3') <(pressed '10 left 2')
}

left_is_the_other_way_than_right() {
    ! cmp -s <(pressed '10 left') <(pressed '10 right') && ! cmp -s <(pressed '10 up') <(pressed '10 down')
}

select_takes_the_next_demo_on_the_list() { # those by name only left out; and after the last the first; once, however long it is held
    local demos n
    mapfile -t demos < <("$sim" --list | sed -n '/; by name only$/d; s/^demo *\([^ ]*\).*/\1/p')
    n=${#demos[@]}
    seq 1 2 $((2 * n)) | sed 's/$/ select 1/' >"$dir/round"
    "$sim" "${small[@]}" --demo "${demos[0]}" --keys "$dir/round" --frames $((2 * n + 1)) --crc >"$dir/round.crc" || return 1
    local i
    for ((i = 1; i <= n; i++)); do
        [ "$(sed -n $((2 * i))p "$dir/round.crc")" = "$("$sim" "${small[@]}" --demo "${demos[i % n]}" --start $((2 * i - 1)) --crc)" ] ||
            { echo "${demos[i % n]}" && return 1; }
    done
    diff <(pressed '10 select') <(pressed '10 select 20')
}

wrong_scripts_are_told() {
    local line
    for line in 1 'x up' '1 up 0' '1 up+' '1 +up' '1 up++left' '1 up left' '-1 up' '1 up 2 3' '1 fire' '1 Up' '1.5 up' '4294967297 up' \
        '1 up 1x'; do
        printf '# a comment\n\n2 up\n%s\n' "$line" >"$dir/wrong"
        refuses 2 "wrong:4: " --crc --keys "$dir/wrong" || { echo "$line" && return 1; }
    done
    printf '1 up\0 2\n' >"$dir/wrong" && refuses 2 "wrong:1: " --crc --keys "$dir/wrong" &&
        refuses 1 "No such file" --crc --keys "$dir/missing" && refuses 1 "directory" --crc --keys "$dir" &&
        (ulimit -v 4000000 && refuses 2 "zero:1: " --crc --keys /dev/zero) # no line in it is ever complete
}

# ---- where frames go

directory_gets_a_file_a_frame() {
    "$sim" --demo cube "${small[@]}" --start 9 --frames 2 --out "$dir/a/b" && [ "$(cd "$dir/a/b" && echo *)" = "frame-0009.ppm frame-0010.ppm" ] &&
        "$sim" --demo cube "${small[@]}" --start 10 --out "$dir/one.ppm" && cmp "$dir/one.ppm" "$dir/a/b/frame-0010.ppm"
}

several_frames_get_numbered_files() {
    mkdir "$dir/several" && "$sim" --demo cube "${small[@]}" --frames 2 --out "$dir/several/x.ppm" &&
        [ "$(cd "$dir/several" && echo *)" = "x-0000.ppm x-0001.ppm" ]
}

stream_is_the_files_one_after_the_other() {
    "$sim" --demo cube "${small[@]}" --frames 3 --out "$dir/stream" && "$sim" --demo cube "${small[@]}" --frames 3 --crc --out - 2>"$dir/stderr" |
        cmp - <(cat "$dir/stream"/*.ppm) && [ "$(grep -c crc32 "$dir/stderr")" = 3 ]
}

imagemagick_reads_the_stream() {
    [ "$("$sim" --demo cube "${small[@]}" --frames 3 --out - | identify -format '%m %w %h\n' ppm:-)" = "$(printf 'PPM 48 40\n%.0s' 1 2 3)" ]
}

ffmpeg_reads_the_stream() {
    local frames
    frames=$("$sim" --demo cube "${small[@]}" --frames 3 --out - | ffmpeg -loglevel error -f image2pipe -c:v ppm -i - -f framecrc - | grep -c '^0,') &&
        [ "$frames" = 3 ] || { echo "$frames" && return 1; }
}

names_with_a_dot_are_directories_when_they_say_so() {
    mkdir -p "$dir/v1.5" && "$sim" --demo cube "${small[@]}" --out "$dir/v1.5" && [ -s "$dir/v1.5/frame-0000.ppm" ] &&
        "$sim" --demo cube "${small[@]}" --out "$dir/v1.6/" && [ -s "$dir/v1.6/frame-0000.ppm" ] &&
        "$sim" --demo cube "${small[@]}" --out "$dir/.hidden" && [ -s "$dir/.hidden/frame-0000.ppm" ] &&
        refuses 2 "pictures are written" --out "$dir/foo.jpg" --demo cube && [ ! -e "$dir/foo.jpg" ]
}

a_signal_leaves_no_part_of_a_file() { # signal, exit status
    local pid i
    env --default-signal=INT "$sim" --demo torus "${small[@]}" --frames 1000000 --out "$dir/$1" & # else `&` ignores it
    pid=$!
    for ((i = 0; i < 10000 && $(find "$dir/$1" -name '*.ppm' 2>/dev/null | wc -l) < 3; i++)); do sleep .05; done
    kill -s "$1" "$pid"
    wait "$pid"
    [ $? = "$2" ] && [ -z "$(find "$dir/$1" -type f ! -size 5773c)" ] && [ -n "$(find "$dir/$1" -name '*.ppm')" ]
}

an_ignored_signal_stays_ignored() { # signal: all frames come, and the program is done
    local pid i
    env --ignore-signal="$1" "$sim" --demo torus "${small[@]}" --frames 400 --out "$dir/ignored-$1" &
    pid=$!
    for ((i = 0; i < 10000; i++)); do
        [ ! -e "$dir/ignored-$1/frame-0002.ppm" ] || break # counting them takes so long that a busy machine draws all
        sleep .01
    done
    kill -s "$1" "$pid" && wait "$pid" && [ "$(find "$dir/ignored-$1" -name '*.ppm' | wc -l)" = 400 ]
}

a_closed_pipe_ends_it() {
    local status
    timeout 600 "$sim" --demo torus "${small[@]}" --frames 1000000 --out - | head -c 100 >"$dir/head"
    status=${PIPESTATUS[0]}
    [ "$status" = 141 ] || [ "$status" = 1 ] || { echo "exit $status" && return 1; }
}

a_file_limit_leaves_nothing() { # 10 KiB, the picture takes 48
    local status=0
    mkdir -p "$dir/limit" && (ulimit -f 10 && exec "$sim" --demo cube --size 128x128 --out "$dir/limit/a.ppm") 2>"$dir/stderr" || status=$?
    [ "$status" = 1 ] && [ "$(wc -l <"$dir/stderr")" = 1 ] && [ -z "$(ls "$dir/limit")" ]
}

# A first frame that cannot be written, or drawn, takes the directories away that were made for it, and no other.
a_failure_leaves_no_directory() {
    grid 60 >"$dir/grid60.obj" && mkdir -p "$dir/old"
    ! (ulimit -f 10 && exec "$sim" --demo cube --size 128x128 --out "$dir/new/deep/er") 2>"$dir/stderr" && [ ! -e "$dir/new" ] &&
        ! (ulimit -f 10 && exec "$sim" --demo cube --size 128x128 --out "$dir/old/new/") 2>"$dir/stderr" && [ -d "$dir/old" ] && [ -z "$(ls "$dir/old")" ] &&
        ! "$sim" --model "$dir/grid60.obj" --board pico-display --max-triangles all --out "$dir/new" 2>"$dir/stderr" && [ ! -e "$dir/new" ] &&
        ! "$sim" --demo cube --out "$dir/stderr/new" 2>/dev/null && "$sim" --demo cube --size 8x8 --out "$dir/old/new" && [ -s "$dir/old/new/frame-0000.ppm" ] || return 1
    ! (ulimit -f 10 && exec "$sim" --demo cube --size 128x128 --out "$dir/old/new") 2>"$dir/stderr" && [ -s "$dir/old/new/frame-0000.ppm" ]
}

a_pipe_stays_a_pipe() { # and gets the picture; a file put in its place would break whoever reads it
    rm -f "$dir/pipe.ppm"
    mkfifo "$dir/pipe.ppm" && { cat "$dir/pipe.ppm" >"$dir/read.ppm" & } || return 1
    "$sim" --demo cube "${small[@]}" --out "$dir/pipe.ppm" && wait && [ -p "$dir/pipe.ppm" ] &&
        "$sim" --demo cube "${small[@]}" --out "$dir/file.ppm" && cmp "$dir/read.ppm" "$dir/file.ppm"
}

a_full_disk_is_told() {
    local status=0
    "$sim" --demo cube "${small[@]}" --out - >/dev/full 2>"$dir/stderr" || status=$?
    [ "$status" = 1 ] && [ "$(wc -l <"$dir/stderr")" = 1 ] || { cat "$dir/stderr" && return 1; }
    status=0
    "$sim" --demo cube "${small[@]}" --crc >/dev/full 2>"$dir/stderr" || status=$?
    [ "$status" = 1 ] && [ "$(wc -l <"$dir/stderr")" = 1 ] || { cat "$dir/stderr" && return 1; }
}

impossible_places_are_told() {
    touch "$dir/file" && mkdir -p "$dir/folder.ppm" &&
        refuses 1 directory --out "$dir/file" && refuses 1 'folder.ppm' --out "$dir/folder.ppm" &&
        refuses 1 missing --out "$dir/missing/x.ppm" && [ -z "$(find "$dir" -name '*.part')" ]
}

short help_names_every_option help_names_every_option
short list_has_one_line_for_each list_has_one_line_for_each
thorough loops_are_as_long_as_the_list_says
short h_is_help h_is_help
thorough everything_on_the_list_can_be_drawn
short demo_has_an_effect differ --demo cube "${small[@]}" -- --demo torus "${small[@]}"
short turntable_is_the_default same "${small[@]}" -- --demo turntable "${small[@]}"
thorough the_smallest_pictures_are_drawn
short bar_is_for_terminals bar_is_for_terminals
short model_has_an_effect model_has_an_effect
short a_model_too_large_names_what_helps a_model_too_large_names_what_helps
short board_has_its_own_size board_has_its_own_size
short size_is_the_picture_s size_is_the_picture_s
short without_a_board_it_is_240x240 same --demo cube -- --demo cube --size 240x240
short frames_and_start_count frames_and_start_count
short the_highest_count_is_followed_by_0 the_highest_count_is_followed_by_0
short frames_move differ --demo torus "${small[@]}" --start 0 -- --demo torus "${small[@]}" --start 5
short overlay_has_an_effect differ --demo torus --size 160x60 --overlay -- --demo torus --size 160x60
short overlay_does_not_depend_on_bands same --demo torus --size 160x60 --overlay --band 1 -- --demo torus --size 160x60 --overlay --band 60
short camera_has_an_effect differ --demo torus "${small[@]}" --camera eye=0,0,1 -- --demo torus "${small[@]}" --camera eye=2,0,2
short camera_target_has_an_effect differ --demo torus "${small[@]}" --camera eye=0,0,2 -- --demo torus "${small[@]}" --camera eye=0,0,2,target=.5,0,-3
short camera_up_has_an_effect differ --demo torus "${small[@]}" --camera eye=0,0,1 -- --demo torus "${small[@]}" --camera up=1,0,0,eye=0,0,1
short camera_at_its_own_target_is_drawn "$sim" "${small[@]}" --camera eye=0,0,0,target=0,0,0,up=0,0,0 --crc
short each_convention_is_typed_as_it_is_written each_convention_is_typed_as_it_is_written
short a_wrong_matrix_is_explained_and_drawn a_wrong_matrix_is_explained_and_drawn
short a_point_is_told_at_every_stage a_point_is_told_at_every_stage
short a_camera_rides_on_a_mesh a_camera_rides_on_a_mesh
short depth_is_shown_in_greys depth_is_shown_in_greys
thorough the_teachers_commands_work
short a_picture_of_16_to_9_has_its_own_width a_picture_of_16_to_9_has_its_own_width
short all_cameras_of_a_demo_are_printed all_cameras_of_a_demo_are_printed
short ways_to_state_a_view_agree ways_to_state_a_view_agree
short focal_is_the_distance_of_the_image focal_is_the_distance_of_the_image
short matrices_of_all_conventions_draw_the_same matrices_of_all_conventions_draw_the_same
short flattening_matrices_are_the_documents flattening_matrices_are_the_documents
short fov_has_an_effect differ --demo torus "${small[@]}" --fov 60 -- --demo torus "${small[@]}" --fov 30
thorough lens_is_the_documented_one_or_the_demo_s
short near_cuts near_cuts
short far_cuts far_cuts
short projection_has_an_effect differ --demo torus "${small[@]}" --projection ortho -- --demo torus "${small[@]}" --projection perspective
short frustum_without_window_is_the_perspective frustum_without_window_is_the_perspective
short fisheye_sees_behind_itself fisheye_sees_behind_itself
short focus_blurs focus_blurs
thorough conventions_draw_the_same_bytes
short matrices_are_the_documents matrices_are_the_documents
short matrices_round_trip matrices_round_trip
short matrix_of_a_demo_is_its_own matrix_of_a_demo_is_its_own
short matrix_needs_no_picture_and_takes_one matrix_needs_no_picture_and_takes_one
short convention_gl_is_the_default same --demo torus "${small[@]}" -- --demo torus "${small[@]}" --convention gl
for format in float16 fixed24 float24 linear-w; do
    short "depth_has_an_effect: $format" differ "${deep[@]}" --depth fixed16 -- "${deep[@]}" --depth $format
done
short depth_is_auto_by_default same "${deep[@]}" -- "${deep[@]}" --depth auto
short depth_auto_is_fixed16_up_to_64_times_near depth_auto_is_fixed16_up_to_64_times_near
short depth_exponent_is_what_the_lens_needs_or_as_asked depth_exponent_is_what_the_lens_needs_or_as_asked
short depth_of_other_widths_is_refused depth_of_other_widths_is_refused
short dither_has_an_effect differ --demo ball "${small[@]}" --depth fixed16 --dither -- --demo ball "${small[@]}" --depth fixed16
short rotations_show_the_same_upright_picture rotations_show_the_same_upright_picture
short bands_do_not_change_the_picture bands_do_not_change_the_picture
short bands_are_what_is_sent_at_a_time bands_are_what_is_sent_at_a_time
short stats_add_up stats_add_up
short crc_is_the_one_of_gzip crc_is_the_one_of_gzip
short a_value_may_follow_an_equals_sign same --demo=cube --size=48x40 -- --demo cube "${small[@]}"
short views_are_different_pictures views_are_different_pictures
short list_names_the_views list_names_the_views
short without_presses_nothing_changes without_presses_nothing_changes
short buttons_change_frames_from_their_own_on buttons_change_frames_from_their_own_on
short lines_of_a_script_add_up lines_of_a_script_add_up
short left_is_the_other_way_than_right left_is_the_other_way_than_right
short select_takes_the_next_demo_on_the_list select_takes_the_next_demo_on_the_list
short wrong_scripts_are_told wrong_scripts_are_told
short directory_gets_a_file_a_frame directory_gets_a_file_a_frame
short names_with_a_dot_are_directories_when_they_say_so names_with_a_dot_are_directories_when_they_say_so
short several_frames_get_numbered_files several_frames_get_numbered_files
short stream_is_the_files_one_after_the_other stream_is_the_files_one_after_the_other
if [ -n "${LONG-}" ]; then :; elif command -v identify >/dev/null; then short imagemagick_reads_the_stream imagemagick_reads_the_stream; else skip imagemagick_reads_the_stream "no ImageMagick"; fi
if [ -n "${LONG-}" ]; then :; elif command -v ffmpeg >/dev/null; then short ffmpeg_reads_the_stream ffmpeg_reads_the_stream; else skip ffmpeg_reads_the_stream "no ffmpeg"; fi
short sigint_leaves_no_part_of_a_file a_signal_leaves_no_part_of_a_file INT 130
short nohup_keeps_it_alive an_ignored_signal_stays_ignored HUP
short an_ignored_sigint_stays_ignored an_ignored_signal_stays_ignored INT
short sigterm_leaves_no_part_of_a_file a_signal_leaves_no_part_of_a_file TERM 143
short a_closed_pipe_ends_it a_closed_pipe_ends_it
short a_window_off_the_middle_is_wrong_usage refuses 2 "off the middle" --crc --projection frustum=5,6,5,6
short a_file_limit_leaves_nothing a_file_limit_leaves_nothing
short a_failure_leaves_no_directory a_failure_leaves_no_directory
short a_pipe_stays_a_pipe a_pipe_stays_a_pipe
short a_full_disk_is_told a_full_disk_is_told
short impossible_places_are_told impossible_places_are_told

# ---- wrong usage: option and value, and what the line must name. A third of them here, all in long_sim_cli.sh
usage=0
while IFS='|' read -r pattern options; do
    IFS=' ' read -ra words <<<"$options"
    [ $((usage++ % 3)) != 0 ] || short "wrong_usage: $options" refuses 2 "$pattern" "${words[@]}"
    long "wrong_usage: $options, of all" refuses 2 "$pattern" "${words[@]}"
done <<'LIST'
nothing to do|
no such option; did you mean --frames? |--frame 3 --crc
no such option; did you mean --depth? |--formt fixed16 --crc
no such demo; did you mean turntable? |--demo turntabel --crc
no such board; did you mean pico-display? |--board pico-dislpay --crc
no such demo; --list|--demo nothinglikeit --crc
must be y or z|--model x.obj --up x --crc
no such option|cube --crc
no such option|-x
no such option|--
needs a value|--crc --frames
takes no value|--crc=1
exclude|--demo cube --model x.obj --crc
exclude|--board x --size 8x8 --crc
--list|--demo nonsense --crc
--list|--board nonsense --crc
--demo|--demo= --crc
--size|--size 0x10 --crc
--size|--size 10x0 --crc
--size|--size 1025x10 --crc
--size|--size 10 --crc
--size|--size 10x --crc
--size|--size x10 --crc
--size|--size 10x10x --crc
--size|--size -1x10 --crc
--size|--size 10X10 --crc
--frames|--frames 0 --crc
--frames|--frames -1 --crc
--frames|--frames 1.5 --crc
--frames|--frames 1e3 --crc
--frames|--frames 4294967297 --crc
--frames|--frames 99999999999999999999 --crc
--frames|--frames +1 --crc
--frames|--frames= --crc
--start|--start x --crc
--start|--start 1x --crc
--start|--start 4294967296 --crc
--aa: pictures of at most 512x512 pixels, not 513x10$|--aa --size 513x10 --crc
--aa: pictures of at most 512x512 pixels, not 10x513$|--aa --size 513x10 --rotate 90 --crc
--aa: pictures of at most 512x512 pixels, not 600x600$|--aa --size 600x600 --window
--rotate|--rotate 45 --crc
--rotate|--rotate 360 --crc
--rotate|--rotate 090 --crc
--up: of which model|--up z --crc
--two-sided: of which model|--two-sided --crc
--texture: of which model|--texture x.png --crc
--allow-outside: of which model|--allow-outside --crc
--max-triangles: of which model|--max-triangles 100 --crc
--clip: of which model|--clip walk --crc
--filter: of which model|--demo cube --filter bilinear --crc
--camera|--camera 0,0,3 --crc
--camera|--camera vrp=0,0,3 --crc
--camera|--camera vrp=0,0,3,vpn=0,0,1,up=0,1,0 --crc
--camera|--camera quat=0,0,0,0 --crc
--camera|--camera quat=1,0,0 --crc
--camera|--camera ypr=1,2,3,target=0,0,0 --crc
--view-matrix|--view-matrix 1,0,0,0,0,1,0,0,0,0,1,0,0,0,0 --crc
--view-matrix|--view-matrix 1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1,0 --crc
--view-matrix|--view-matrix 1,0,0,0,0,1,0,0,0,0,0x1,0,0,0,0,1 --crc
--view-matrix|--view-matrix 1,0,0,0,0,1,0,0,0,0,-1,0,0,0,0,1 --crc
--view-matrix|--view-matrix 2,0,0,0,0,2,0,0,0,0,2,0,0,0,0,1 --crc
--view-matrix|--view-matrix 1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1 --camera eye=0,0,1 --crc
--projection-matrix|--projection-matrix .5,0,0,0,0,1,0,0,0,0,-1.5,-5,0,0,1,0 --crc
--projection-matrix|--projection-matrix .5,0,0,0,0,1,0,0,0,0,-1.5,-5,0,0,-1,0 --convention lmu --crc
--projection-matrix|--projection-matrix .5,0,0,0,0,1,0,0,0,0,-1.5,-5,0,0,-1,nan --crc
--projection-matrix|--projection-matrix .5,.1,0,0,0,1,0,0,0,0,-1.5,-5,0,0,-1,0 --crc
--projection-matrix|--projection-matrix .5,0,0,0,0,1,0,0,0,0,-1.5,-5,0,0,-1,0 --near 1 --crc
which view? give --camera or --view-matrix|--anyway --projection-matrix 2,0,0,0,0,2,0,0,0,0,2,0,0,0,-1,0 --crc
of which matrix|--anyway --crc
does not fit fixed point|--anyway --camera eye=0,0,5 --projection-matrix 9000,0,0,0,0,2,0,0,0,0,2,0,0,0,-1,0 --crc
--point|--point 1,2
--point|--point 1,2,3,
the fisheye does not see it|--projection fisheye --camera eye=0,0,5 --point 0,0,5
--focus|--demo focus --focus 0 --crc
--focus|--demo focus --focus 3,65 --crc
--focus|--demo focus --focus 3, --crc
cube has no depth of field|--demo cube --focus 3 --crc
beside the eye|--camera eye=0,0,5 --point 1,0,5
--object: of what|--object 1,2,3 --crc
--object|--object 1,2 --matrix
--object|--object 1,2,3,up=0,1,0 --matrix
--focal|--focal 0 --crc
--focal|--focal 1,0 --crc
--focal|--focal -1 --crc
--focal|--focal 1 --fov 60 --crc
--flatten|--flatten eece=0 --matrix
--flatten|--flatten plane=0,0,0,1 --matrix
--flatten|--flatten kaist-4.7 --crc
--camera|--camera eye=0,0 --crc
--camera|--camera eye=0,0,3, --crc
--camera|--camera eye=0,0,3,eye=0,0,2 --crc
--camera|--camera eye=0,0,3,4 --crc
--camera|--camera eye=0,0,nan --crc
--camera|--camera target=0,0,0 --crc
--camera|--camera eye=0,0,40000 --crc
--camera|--camera eye=0,,0 --crc
--fov|--fov 0 --crc
--fov|--fov 180 --crc
--fov|--fov -10 --crc
--fov|--fov nan --crc
--fov|--fov inf --crc
--fov|--fov 60deg --crc
--fov|--fov 1e9 --crc
--fov|--fov 0x10 --crc
--near|--near= --crc
--near|--near 0 --crc
--near|--near -1 --crc
--near|--near 1,5 --crc
--far|--far 40000 --crc
below 0 they are in --convention lmu|--near -1 --far 5 --crc
write both in the same way|--near -1 --far 5 --convention lmu --crc
write both in the same way|--near 1 --far -5 --convention lmu --crc
--near, --far: near must|--near -5 --far -1 --convention lmu --crc
--far|--far -32768 --convention lmu --crc
--near, --far: near must|--near 5 --far 5 --crc
--near, --far: near must|--near 5 --far 4 --crc
--projection, --fov|--projection frustum=1,1,0,1 --crc
.gif pictures are written|--out foo.jpg
.gif pictures are written|--out foo.PNG
--projection|--projection frustum=0,1,0 --crc
--projection|--projection frustum=0,1,0,1x --crc
--projection|--projection perspective=0,1,0,1 --crc
frustum|--projection fisheye=0,1,0,1 --crc
--fov|--projection fisheye --fov 9 --crc
--fov|--projection fisheye --fov 240.5 --crc
--fov|--fov 200 --projection ortho --crc
--near|--projection ortho --near -1 --crc
fisheye|--projection fisheye --matrix
--matrix|--matrix --near 1 --far 1.00001
--matrix|--matrix shift
the views outside sun moon fixed|--demo solar --view pluto --crc
but one view|--demo cube --view outside --crc
--view|--view= --crc
--keys|--keys= --crc
takes no value|--window=1
must be gl|--convention opengl --crc
must be gl|--convention= --crc
fixed16|--depth fixed32 --crc
fixed16|--depth linear --crc
fixed16|--depth= --crc
--band '0': must be a whole number of lines, 1 .. 1024$|--band 0 --crc
--band|--band 1025 --crc
--band|--band 16px --crc
LIST
short "wrong_usage: an empty argument" refuses 2 "no such option" ""
short "wrong_usage: a line break in an argument stays one line" refuses 2 "no such option" $'--a\nb'
tap_end
