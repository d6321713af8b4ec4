#!/bin/sh
# `make demo`: several demos on several kits, a few frames each, and one contact sheet. Needs the built programs only.
set -eu
B=${B:-build}
out=$B/demo

rm -rf "$out"
mkdir -p "$out"

# show DEMO BOARD START FRAMES: frames go to $out/DEMO-BOARD/, the first of them onto the sheet
sheet=
show() {
    folder=$out/$1-$2
    "$B/pinhole-sim" --demo "$1" --board "$2" --start "$3" --frames "$4" --out "$folder"
    sheet="$sheet $(printf '%s/frame-%04u.ppm' "$folder" "$3")"
    printf '  %-50s frames: %u\n' "$folder/" "$4"
}

echo "What the glass of each panel shows, as PPM:"
show hitchcock sim-ili9488 128 4
show shadow sim-ili9488 36 4
show focus sim-ili9488 32 4
show fisheye sim-ili9488 32 4
show turntable waveshare-rp2040-lcd-1in28 0 8
show snake waveshare-pico-lcd-1in3 100 8
show solar rpi-pirate-audio 40 8
show turntable lm3s6965evb 0 4
# shellcheck disable=SC2086 # names without spaces, one word each
"$B/pinhole-sheet" --width 996 --out "$out/contact-sheet.ppm" $sheet
echo "  $out/contact-sheet.ppm"

now_ms() { date +%s%N | sed 's/......$//'; } # nothing where date knows no nanoseconds
begin=$(now_ms)
"$B/pinhole-sim" --demo turntable --frames 120 --crc >"$out/speed"
end=$(now_ms)
rm "$out/speed"
case $begin$end in *[!0-9]*) ;; *) echo "This machine draws $((120000 / (end - begin + 1))) frames of 240x240 a second." ;; esac
echo "More: $B/pinhole-sim --window; make page; on a kit: boards/README.md"
