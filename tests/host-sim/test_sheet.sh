#!/usr/bin/env bash
# pinhole-sheet puts every pixel where it belongs, and make demo leaves what it says.
# shellcheck disable=SC2317,SC2015 # functions are called by check; `A && B || { echo; return 1; }` says why it fails
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
unset MAKEFLAGS
B=${B:-build}
sheet=$B/pinhole-sheet
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT

ppm() { # name, width, height, character of all bytes
    { printf 'P6\n%d %d\n255\n' "$2" "$3" && head -c $(($2 * $3 * 3)) /dev/zero | tr '\0' "$4"; } >"$dir/$1.ppm"
}

# The sheet as letters: a character a pixel, '.' for paper.
drawn() {
    "$sheet" --out "$dir/sheet.ppm" "$@" || return 1
    local width
    width=$(sed -n 2p "$dir/sheet.ppm" | cut -d' ' -f1)
    tail -n +4 "$dir/sheet.ppm" | tr '\050\054\064' '.' | tr '\n' '?' | fold -w $((3 * width)) |
        sed 's/\(.\)../\1/g' && echo
}

rows_are_broken_at_the_width() {
    ppm a 2 1 A && ppm b 1 3 B && ppm c 3 1 C
    drawn --width 8 --gap 1 "$dir/a.ppm" "$dir/b.ppm" "$dir/c.ppm" >"$dir/drawn"
    printf '%s\n' '........' '.....B..' '..AA.B..' '.....B..' '........' '..CCC...' '........' >"$dir/expected"
    diff "$dir/expected" "$dir/drawn"
}

gap_and_width_have_an_effect() {
    drawn --width 1 --gap 0 "$dir/a.ppm" "$dir/c.ppm" >"$dir/drawn"
    printf '%s\n' 'AA.' 'CCC' | diff - "$dir/drawn"
}

a_caption_stands_below() { # an exclamation mark of 1 x 7 pixels, twice as large, in the middle of 20 rows
    ppm e 8 1 A
    LC_ALL=C drawn --gap 0 --width 8 --caption '!' "$dir/e.ppm" | LC_ALL=C tr '\377' '#' >"$dir/drawn"
    { echo AAAAAAAA; yes '...##...' | head -n 10; printf '%s\n' ........ ........ '...##...' '...##...'; yes ........ | head -n 6; } | diff - "$dir/drawn"
}

header_comments_are_read() {
    { printf 'P6 # made by hand\n2 # wide\n1\n255\n' && printf 'AAAAAA'; } >"$dir/comment.ppm"
    [ "$(drawn --width 1 --gap 0 "$dir/comment.ppm")" = AA ]
}

refuses() { # status, arguments
    local want=$1 got=0
    shift
    "$sheet" "$@" >"$dir/stdout" 2>"$dir/stderr" || got=$?
    [ "$got" = "$want" ] && [ "$(wc -l <"$dir/stderr")" = 1 ] && [ ! -s "$dir/stdout" ] || { cat "$dir/stderr" && return 1; }
}

stdout_gets_the_same() {
    "$sheet" --out "$dir/file.ppm" "$dir/a.ppm" && "$sheet" --out - "$dir/a.ppm" | cmp - "$dir/file.ppm"
}

wrong_pictures_are_refused() {
    printf 'P6\n2 2\n255\nAAA' >"$dir/short.ppm" && printf 'P3\n1 1\n255\n1 2 3\n' >"$dir/text.ppm" && : >"$dir/empty.ppm" &&
        printf 'P6\n99999 99999\n255\n' >"$dir/huge.ppm" && printf 'P6\n1 1\n65535\nAAAAAA' >"$dir/deep.ppm" || return 1
    local name
    for name in short text empty huge deep missing; do
        refuses 1 --out "$dir/x.ppm" "$dir/$name.ppm" || return 1
    done
    [ ! -e "$dir/x.ppm" ]
}

# A PNG of 31 KB that is 16,000 pixels wide and high, a PPM that says so, and pictures that are too much together.
white() { # file, width, height: a black PNG
    node -e 'const [, file, w, h] = process.argv, zlib = require("zlib"), chunk = (t, d) => { const b = Buffer.concat([Buffer.from(t), d]), n = Buffer.alloc(4), c = Buffer.alloc(4);
        n.writeUInt32BE(d.length); let crc = ~0; for (const x of b) { crc ^= x; for (let k = 0; k < 8; k++) crc = crc >>> 1 ^ (crc & 1 ? 0xEDB88320 : 0) } c.writeUInt32BE(~crc >>> 0); return Buffer.concat([n, b, c]) }
        const head = Buffer.alloc(13); head.writeUInt32BE(+w, 0); head.writeUInt32BE(+h, 4); head[8] = 1; const rows = zlib.deflateSync(Buffer.alloc((Math.ceil(w / 8) + 1) * h));
        require("fs").writeFileSync(file, Buffer.concat([Buffer.from("\x89PNG\r\n\x1a\n", "latin1"), chunk("IHDR", head), chunk("IDAT", rows), chunk("IEND", Buffer.alloc(0))]))' "$@"
}

huge_pictures_are_refused() {
    white "$dir/huge.png" 16000 16000 && white "$dir/half.png" 8192 4097 && white "$dir/thin.png" 16000 1 && printf 'P6\n16000 16000\n255\n' >"$dir/wide.ppm" || return 1
    (ulimit -v 700000 && refuses 1 --out "$dir/x.png" "$dir/huge.png" && grep -q 'huge.png: is 16000x16000, and there is room for 67108864 pixels' "$dir/stderr" &&
        refuses 1 --out "$dir/x.png" "$dir/wide.ppm" && grep -q 'is 16000x16000' "$dir/stderr" &&
        refuses 1 --out "$dir/x.png" "$dir/half.png" "$dir/half.png" && grep -q 'with it' "$dir/stderr" &&
        refuses 1 --out "$dir/x.png" --scale 16 --gap 200 "$dir/thin.png" && grep -q 'the sheet would be 262400x6416' "$dir/stderr") && [ ! -e "$dir/x.png" ] &&
        "$sheet" --gap 0 --out "$dir/thin.ppm" "$dir/thin.png" && [ "$(wc -c <"$dir/thin.ppm")" = $((3 * 16000 + 15)) ]
}

wrong_usage_is_refused() {
    refuses 2 && refuses 2 "$dir/a.ppm" && refuses 2 --out "$dir/x.ppm" && refuses 2 --out && refuses 2 --gap x --out "$dir/x.ppm" "$dir/a.ppm" &&
        refuses 2 --width 0 --out "$dir/x.ppm" "$dir/a.ppm" && refuses 2 --nonsense &&
        refuses 2 --out "$dir/x.jpg" "$dir/a.ppm" && refuses 1 --out "$dir/no/x.ppm" "$dir/a.ppm"
}

demo_leaves_what_it_says() {
    make -s B="$B" demo >"$dir/demo" || return 1
    local folder frames
    while read -r folder _ frames; do
        [ "$(find "$folder" -name 'frame-*.ppm' | wc -l)" = "$frames" ] || { echo "$folder" && return 1; }
    done < <(grep 'frames:' "$dir/demo")
    [ "$(grep -c 'frames:' "$dir/demo")" -ge 6 ] && [ -s "$B/demo/contact-sheet.ppm" ] && grep -q 'contact-sheet.ppm' "$dir/demo"
}

check rows_are_broken_at_the_width rows_are_broken_at_the_width
check gap_and_width_have_an_effect gap_and_width_have_an_effect
check a_caption_stands_below a_caption_stands_below
check header_comments_are_read header_comments_are_read
check stdout_gets_the_same stdout_gets_the_same
check wrong_pictures_are_refused wrong_pictures_are_refused
if ! command -v node >/dev/null; then
    skip huge_pictures_are_refused "no node: apt-get install nodejs"
elif ! pkg-config --exists libpng; then
    skip huge_pictures_are_refused "no libpng: apt-get install libpng-dev"
else
check huge_pictures_are_refused huge_pictures_are_refused
fi
check wrong_usage_is_refused wrong_usage_is_refused
check demo_leaves_what_it_says demo_leaves_what_it_says
check help_is_there "$sheet" --help
tap_end
