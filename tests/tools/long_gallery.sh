#!/usr/bin/env bash
# The pictures of the READMEs are those that `make gallery` makes.
# shellcheck disable=SC2317 # functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
unset MAKEFLAGS
B=${B:-build}
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
for tool in convert:imagemagick gnuplot:gnuplot-nox; do
    command -v "${tool%:*}" >/dev/null || { echo "no ${tool%:*}: apt-get install ${tool#*:}" && exit 77; }
done

gallery_makes_the_pictures() { # pixel by pixel; the plot of depth is drawn by gnuplot, whose fonts differ
    local picture made shown=0
    B="$B" host-sim/gallery.sh "$dir/gallery" >"$dir/log" || return 1
    while read -r picture; do
        made=$dir/gallery/$picture
        [ -s "$made" ] || { echo "$picture is not made" && return 1; }
        [ "$picture" = depth.png ] || cmp <(convert "host-sim/gallery/$picture" ppm:-) <(convert "$made" ppm:-) || return 1
        shown=$((shown + 1))
    done < <(grep -ohE 'gallery/[a-z0-9/-]+\.(png|gif)' -- README.md */README.md */*/README.md | cut -d/ -f2- | sort -u)
    [ "$shown" -ge 30 ]
}

make -s -j2 B="$B" all || exit 1
check "the_gallery_makes_the_pictures" gallery_makes_the_pictures
tap_end
