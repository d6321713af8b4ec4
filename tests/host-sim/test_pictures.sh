#!/usr/bin/env bash
# Pictures in files: PNG, GIF and PPM hold the same pixels, --scale, --check and --json do what --help says. ImageMagick reads
# what we write.
# shellcheck disable=SC2317,SC2015,SC2012,SC2086 # functions are called by check; || prints what was said; names have no spaces
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
tree=$PWD
B=$(realpath "${B:-build}")
sim=$B/pinhole-sim
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
cd "$dir" || exit 1

same_pixels() { # picture, picture
    [ "$(convert "$1" -depth 8 rgb:- | sha256sum)" = "$(convert "$2" -depth 8 rgb:- | sha256sum)" ] || { echo "$1 and $2 differ" && return 1; }
}

fails() { # exit status, words of its line, command
    local status
    "${@:3}" >said 2>&1
    status=$?
    [ $status = "$1" ] && grep -qF -- "$2" said || { echo "status $status:" && cat said && return 1; }
}

a_png_is_the_ppm() {
    "$sim" --demo solar --start 9 --out a.png && "$sim" --demo solar --start 9 --out a.ppm && same_pixels a.png a.ppm &&
        [ "$(identify -format '%m %wx%h' a.png)" = 'PNG 240x240' ]
}

several_pngs_are_numbered() {
    "$sim" --demo cube --start 9999 --frames 2 --out n.png && [ -e n-09999.png ] && [ -e n-10000.png ] &&
        "$sim" --demo cube --start 3 --frames 2 --out n.png && [ -e n-0003.png ] && [ -e n-0004.png ]
}

a_pixel_becomes_nine() {
    "$sim" --demo cube --size 40x30 --scale 3 --out large.png && "$sim" --demo cube --size 40x30 --out small.png &&
        convert small.png -sample 300% sampled.png && same_pixels large.png sampled.png
}

gif_frames() { # demo, frames: g.gif, and its pictures g-0.png ..
    rm -f g-*.png && "$sim" --demo "$1" --size 120x90 --frames "$2" --out g.gif && convert g.gif -coalesce +repage g-%d.png &&
        [ "$(ls g-*.png | wc -l)" = "$2" ] && [ "$(identify -format '%T ' g.gif)" = "$(yes 3 | head -n "$2" | tr '\n' ' ')" ] && grep -qa NETSCAPE2.0 g.gif
}

a_gif_of_few_colours_is_exact() {
    gif_frames wireframe 5 || return 1
    for i in 0 1 2 3 4; do "$sim" --demo wireframe --size 120x90 --start $i --check g-$i.png || return 1; done
}

a_gif_of_many_colours_is_near() { # farther than the dither is wrong
    gif_frames focus 12 && "$sim" --demo focus --size 120x90 --out h.png && [ "$(identify -format %k h.png)" -gt 255 ] || return 1
    for i in 0 5 11; do "$sim" --demo focus --size 120x90 --start $i --check g-$i.png --tolerance 40 || return 1; done
}

# 250 frames of 640x480, 230 MB, in less memory than that.
a_long_gif_takes_little_memory() {
    (ulimit -v 200000 && exec "$sim" --demo testcard --size 640x480 --frames 250 --out long.gif) && [ "$(identify long.gif | wc -l)" = 250 ] && ! ls long.gif?* 2>/dev/null
}

a_full_disk_keeps_the_frames_before() { # in 40 KiB
    local n
    ! (ulimit -f 40 && exec "$sim" --demo cube --size 64x64 --frames 100 --out full.gif) 2>said && [ "$(wc -l <said)" = 1 ] &&
        n=$(sed -n 's/.*full.gif: ends after \([0-9]*\) frames.*/\1/p' said) && [ "${n:-0}" -gt 10 ] && [ "$n" -lt 100 ] &&
        [ "$(identify full.gif | wc -l)" = "$n" ] && "$sim" --demo cube --size 64x64 --frames "$n" --out short.gif && cmp full.gif short.gif && ! ls full.gif?* 2>/dev/null
}

a_gif_is_scaled() { "$sim" --demo cube --size 40x30 --frames 2 --scale 4 --out s.gif && identify s.gif | grep -q 160x120; }

wire_and_sheet_write_png() {
    "$sim" --demo cube --out one.png && "$B/pinhole-sheet" --out sheet.png --gap 0 --width 1 one.png && same_pixels one.png sheet.png &&
        "$B/pinhole-sheet" --out sheet.ppm --scale 2 --width 1 one.png a.ppm && [ "$(identify -format %wx%h sheet.ppm)" = 528x1032 ]
}

matches() { # reference
    rm -f difference.png && "$sim" --demo torus --frames 3 --check "$1" && ! [ -e difference.png ]
}

references_match() {
    "$sim" --demo torus --frames 3 --out folder && "$sim" --demo torus --frames 3 --out ref.png && "$sim" --demo torus --frames 3 --crc >ref.crc &&
        matches folder && matches ref.png && matches ref.crc && mkdir -p pngs && for i in 0 1 2; do cp ref-000$i.png pngs/frame-000$i.png || return 1; done && matches pngs
}

# Scaled references are compared with --scale; those of the glass's size with and without; and what differs is still seen.
scaled_references_match() {
    "$sim" --demo cube --size 40x30 --frames 2 --scale 3 --out large.png && "$sim" --demo cube --size 40x30 --frames 2 --out small.png || return 1
    "$sim" --demo cube --size 40x30 --frames 2 --scale 3 --check large.png && "$sim" --demo cube --size 40x30 --frames 2 --scale 3 --check small.png &&
        fails 1 'is 40x30, but large-0000.png is 120x90' "$sim" --demo cube --size 40x30 --frames 2 --check large.png &&
        fails 1 'is 80x60, but large-0000.png is 120x90' "$sim" --demo cube --size 40x30 --frames 2 --scale 2 --check large.png &&
        convert large-0001.png -fill '#ff00ff' -draw 'point 61,47' large-0001.png &&
        fails 1 'frame 1: 1 of 10800 pixels differ from large-0001.png' "$sim" --demo cube --size 40x30 --frames 2 --scale 3 --check large.png --difference d.png &&
        fails 1 'columns 61 .. 61, rows 47 .. 47' "$sim" --demo cube --size 40x30 --frames 2 --scale 3 --check large.png --difference d.png &&
        [ "$(identify -format %wx%h d-0001.png)" = 120x90 ]
}

# One pixel is changed by 9 of 255.
a_pixel_that_differs_is_told() {
    local pixel
    "$sim" --demo cube --out right.png && pixel=$(convert right.png -crop 1x1+31+17 -format '%[fx:round(255*u.r)],%[fx:round(255*u.g)],%[fx:round(255*u.b)]' info:) &&
        convert right.png -fill "rgb($((${pixel%%,*} + 9)),${pixel#*,})" -draw 'point 31,17' wrong.png &&
        fails 1 'frame 0: 1 of 57600 pixels differ from wrong.png, by at most 9 of 255, in columns 31 .. 31, rows 17 .. 17' \
            "$sim" --demo cube --check wrong.png --difference d.png && fails 1 '1 frame is not as in wrong.png' "$sim" --demo cube --check wrong.png &&
        [ "$(convert d.png -crop 1x1+31+17 -format '%[fx:round(255*u.r)]' info:)" = 132 ] &&
        fails 1 'pixels differ' "$sim" --demo cube --check wrong.png --tolerance 8 && "$sim" --demo cube --check wrong.png --tolerance 9
}

other_references_are_refused() {
    echo hello >text && cp right.png cut.png && truncate -s 200 cut.png
    fails 1 'no-such.png: cannot be read' "$sim" --demo cube --check no-such.png &&
        fails 1 'text: is no picture' "$sim" --demo cube --check text && fails 1 'zero: is no picture' timeout -s KILL 9 "$sim" --demo cube --check /dev/zero && fails 1 'cut.png: is neither' "$sim" --demo cube --check cut.png &&
        fails 1 'is 80x80, but right.png is 240x240' "$sim" --demo cube --size 80x80 --check right.png &&
        fails 1 'has no frame 7' "$sim" --demo torus --start 7 --check ref.crc && fails 1 'crc32' "$sim" --demo cube --frames 2 --check ref.crc &&
        fails 2 'CRCs have none' "$sim" --demo torus --check ref.crc --tolerance 3 && fails 2 "--tolerance '256'" "$sim" --demo cube --check right.png --tolerance 256 &&
        fails 2 "--scale '17'" "$sim" --demo cube --scale 17 --out x.png && fails 2 '.ppm, .png and .gif' "$sim" --demo cube --out x.jpg &&
        fails 1 'cannot be written' "$sim" --demo cube --out no/such/folder.gif && ! [ -e x.png ]
}

json_is_read() { # expression of `d`, what it must be; JSON on stdin
    [ "$(node -e 'const d = JSON.parse(require("fs").readFileSync(0)); console.log(eval(process.argv[1]))' "$1")" = "$2" ]
}

the_list_is_json() {
    "$sim" --list --json >list.json && json_is_read 'd.demos.length' "$("$sim" --list | grep -c ^demo)" <list.json &&
        json_is_read 'd.boards.length' "$("$sim" --list | grep -c ^board)" <list.json && json_is_read 'd.boards.find(b => b.name == "pico-display").width' 240 <list.json &&
        json_is_read 'd.demos.find(b => b.name == "solar").views.join()' outside,sun,moon,fixed <list.json
}

stats_are_json() { # with the numbers of the other form
    "$sim" --demo torus --stats --json 2>stats.json && "$sim" --demo torus --stats 2>stats && json_is_read 'd.triangles_drawn' "$(sed -n 's/.*drawn \([0-9]*\),.*/\1/p' stats)" <stats.json &&
        json_is_read 'd.depth' float16-e4 <stats.json && json_is_read 'Object.keys(d).length' 17 <stats.json
}

crcs_are_json() { # with the numbers of the other form; a reference for --check, too
    "$sim" --demo torus --start 8 --frames 3 --crc --json >json.crc && "$sim" --demo torus --start 8 --frames 3 --crc >text.crc &&
        json_is_read "d.map(f => 'frame ' + f.frame + ' crc32 ' + f.crc32).join('\n')" "$(<text.crc)" <<<"[$(paste -sd, json.crc)]" &&
        [ "$(wc -l <json.crc)" = 3 ] && "$sim" --demo torus --start 8 --frames 3 --check json.crc && fails 1 'crc32' "$sim" --demo cube --start 8 --check json.crc &&
        "$sim" --demo torus --start 8 --crc --json --out - 2>said >/dev/null && head -n 1 json.crc | cmp - said && fails 2 '--json: of what?' "$sim" --demo cube --json --out x.png
}

# The recipe of the paper, line for line, in a repository of its own: it passes, and after a change of the scene it fails.
the_recipe_works() {
    local recipe
    recipe=$(awk '/^```sh$/ { inside = 1; text = ""; next } /^```$/ { if (inside && text ~ /--check/) { printf "%s", text; exit } inside = 0 } inside { text = text $0 "\n" }' "$tree/host-sim/README.md")
    [ -n "$recipe" ] && [ "$(wc -l <<<"$recipe")" -le 10 ] && mkdir repository && cd repository && git init -q . || return 1
    printf 'v -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n' >scene.obj
    PATH=$B:$PATH bash -e -c "$recipe" && [ "$(git ls-files golden | wc -l)" = 4 ] || return 1
    sed -i 's/v 0 1 0/v 0 1.1 0/' scene.obj
    ! PATH=$B:$PATH bash -e -c "$(grep -- --check <<<"$recipe")" && [ -e difference-0000.png ]
}

[ -n "$("$sim" --demo cube --out x.gif 2>&1)" ] && rm -f x.gif && no_gif="no giflib"
for tool in convert:imagemagick node:nodejs git:git; do
    command -v "${tool%:*}" >/dev/null || { echo "no ${tool%:*}: apt-get install ${tool#*:}" && exit 77; }
done
check "a_PNG_has_the_pixels_of_the_PPM" a_png_is_the_ppm
check "several_PNGs_have_numbers_that_sort" several_pngs_are_numbered
check "scale_3_makes_nine_pixels_of_one" a_pixel_becomes_nine
if [ -z "${no_gif-}" ]; then
    check "a_GIF_of_few_colours_is_exact" a_gif_of_few_colours_is_exact
    check "a_GIF_of_many_colours_is_near" a_gif_of_many_colours_is_near
    check "a_GIF_is_scaled" a_gif_is_scaled
    check "a_long_GIF_takes_little_memory" a_long_gif_takes_little_memory
    check "a_full_disk_ends_a_GIF_and_keeps_the_frames_before" a_full_disk_keeps_the_frames_before
else
    skip "GIFs" "$no_gif"
fi
check "pinhole-sheet_reads_and_writes_PNG" wire_and_sheet_write_png
check "every_kind_of_reference_matches" references_match
check "scaled_references_match" scaled_references_match
check "one_pixel_that_differs_is_told_drawn_and_tolerated" a_pixel_that_differs_is_told
check "wrong_references_give_one_line" other_references_are_refused
check "the_list_is_JSON" the_list_is_json
check "the_stats_are_JSON" stats_are_json
check "the_CRCs_are_JSON" crcs_are_json
check "the_recipe_for_CI_works" the_recipe_works
tap_end
