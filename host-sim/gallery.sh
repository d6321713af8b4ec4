#!/bin/sh
# Usage: host-sim/gallery.sh [DIR]
# `make gallery`: the README's pictures, made by the simulator, as PNG under host-sim/gallery/ or DIR (needs ImageMagick;
# optipng makes them smaller where it is installed).
set -eu
B=${B:-build}
to=${1:-host-sim/gallery}
command -v convert >/dev/null || { echo "make gallery: convert is missing; install imagemagick" >&2 && exit 1; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$to"

save() { # NAME.ppm: to NAME.png, without times, so that the same picture is the same file
    png=$to/$(basename "$1" .ppm).png
    convert "$1" -strip -define png:exclude-chunks=date,time "$png"
    ! command -v optipng >/dev/null || optipng -quiet -o5 "$png"
}

all=
for demo in $("$B/pinhole-sim" --list | sed -n 's/^demo *\([^ ]*\).*/\1/p'); do
    "$B/pinhole-sim" --demo "$demo" --board rpi-waveshare-1in3 --start 40 --out "$work/all-$demo.ppm"
    all="$all $work/all-$demo.ppm"
done
# shellcheck disable=SC2086 # names without spaces, one word each
"$B/pinhole-sheet" --width 1524 --out "$work/demos.ppm" $all
save "$work/demos.ppm"
"$B/pinhole-depth" plot resolve --near 0.1 --far 1000 --depth fixed16,float16,fixed24,float24,linear-w,ndc-q16 --out "$to/depth.png"
B=$B host-sim/demo.sh >"$work/log"
cp "$B/demo/contact-sheet.ppm" "$work"
save "$work/contact-sheet.ppm"
"$B/pinhole-sim" --demo testcard --board pico-display --frames 1 --out "$work/card.ppm"
convert "$work/card.ppm" -sample '300%' "$work/testcard.ppm"
save "$work/testcard.ppm"
du -cb "$to"/*.png
