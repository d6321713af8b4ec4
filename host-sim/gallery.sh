#!/bin/sh
# Usage: host-sim/gallery.sh [DIR]
# `make gallery`: the README's pictures, made by the simulator, as PNG under host-sim/gallery/ or DIR (needs ImageMagick;
# optipng makes them smaller where it is installed).
set -eu
B=${B:-build}
to=${1:-host-sim/gallery}
set --
command -v convert >/dev/null || { echo "make gallery: convert is missing; install imagemagick" >&2 && exit 1; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$to"

save() { # NAME.ppm: to NAME.png, without times, so that the same picture is the same file
    png=$to/$(basename "$1" .ppm).png
    convert "$1" -strip -define png:exclude-chunks=date,time "$png"
    ! command -v optipng >/dev/null || optipng -quiet -o5 "$png"
}

# Five demos on a kit's glass, every third frame of 42, each with its name: the README's first picture.
for show in 'shadow 30' 'snake 100' 'fisheye 30' 'solar 30' 'turntable 30'; do
    "$B/pinhole-sim" --demo "${show% *}" --board rpi-waveshare-1in3 --start "${show#* }" --frames 42 --out "$work/${show% *}"
    for frame in $(seq "${show#* }" 3 $((${show#* } + 41))); do
        "$B/pinhole-sheet" --width 1 --caption "${show% *}" --out "$work/first-$show-$frame.ppm" "$work/${show% *}/$(printf 'frame-%04u.ppm' "$frame")"
    done
    set -- "$@" "$work/first-$show-"*.ppm
done
convert -delay 9 -loop 0 "$@" -layers optimize-transparency -colors 96 "$to/first.gif"

# Each kit's glass with the demo that suits it: the table in boards/README.md. Half as large, but small glass.
mkdir -p "$to/kits"
"$B/pinhole-sim" --list | sed -n 's/^board *\([^ ]*\) *\([0-9]*\)x.*/\1 \2/p' | grep -v ^sim- | while read -r board width; do
    case $board in
    lm3s6965evb) demo=focus start=60 ;;
    *oled*) demo=wireframe start=40 ;;
    *sharp*) demo=shadow start=40 ;;
    *0in96* | *1in44*) demo=yard start=40 ;;
    *1in28*) demo=fisheye start=40 ;;
    *1in14 | pico-display | pico2-display) demo=shadow start=40 ;;
    *pico-display-2* | *pico2-display-2*) demo=snake start=104 ;;
    *mini | *2in8) demo=hitchcock start=128 ;;
    *pirate*) demo=solar start=40 ;;
    ft232h-ili9341) demo=character start=40 ;;
    feather*) demo=materials start=40 ;;
    *) demo=turntable start=40 ;;
    esac
    "$B/pinhole-sim" --demo "$demo" --board "$board" --start "$start" --frames 1 --out "$work/kit.ppm"
    convert "$work/kit.ppm" -resize "$([ "$width" -gt 160 ] && echo 50% || echo 100%)" -colors 64 -strip -define png:exclude-chunks=date,time "$to/kits/$board.png"
    ! command -v optipng >/dev/null || optipng -quiet -o5 "$to/kits/$board.png"
done

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
du -cb "$to"/*.png "$to"/*.gif "$to"/kits/*.png
