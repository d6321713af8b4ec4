#!/usr/bin/env bash
# What a function's tier (firmware/core/kernels/portable/tier.h) does in an image: it moves with the function, whatever the
# function's name is, and what the bus's interrupt runs lies in RAM.
# shellcheck disable=SC2317 # functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
B=${B:-build}
command -v arm-none-eabi-gcc >/dev/null || { echo "no arm-none-eabi-gcc: apt-get install gcc-arm-none-eabi libnewlib-arm-none-eabi" && exit 77; }
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
export CCACHE_DISABLE=1 # which leaves no call graph

image() { # folder
    make -s -j2 -C "$1" B=build firmware BOARD=pico-display >"$dir/said" 2>&1 || { tail -n 3 "$dir/said" && return 1; }
}

# "NAME SECTION SIZE" of each function and table of an image but the linker's own, and "SECTION SIZE" of each section that it loads.
layout() { # image
    arm-none-eabi-objdump -t "$1" | sed -n 's/^[0-9a-f]* ..*[FO] \([^ \t]*\)\t\([0-9a-f]*\) \(.hidden \)*\(.*\)/\4 \1 \2/p' | grep -v '_veneer '
    arm-none-eabi-size -A "$1" | awk '$1 ~ /^\./ && $1 !~ /debug|comment|attributes/ { print $1, $2 }'
}

copy() { # name, of a copy of the tree
    mkdir -p "$dir/$1" && cp -r Makefile firmware hal boards host-sim "$dir/$1"
}

# `enter_draw`, static, lies in RAM by its tier; the DMA's interrupt calls `go_on`; `ph_line_pixels` draws pixels.
renaming='s/\benter_draw\b/begin_draw/g; s/\bgo_on\b/carry_on/g; s/\bph_line_pixels\b/ph_dots_of_line/g'

rename_three() {
    copy renamed && find "$dir/renamed/firmware" "$dir/renamed/hal" -name '*.[chS]' -exec sed -i "$renaming" {} + &&
        for name in enter_draw go_on ph_line_pixels; do ! grep -rqw "$name" "$dir/renamed/firmware/core" "$dir/renamed/hal" || return 1; done
}

as_before() { # folder
    image "$dir/$1" && layout "$dir/tree/build/firmware/pico-display-demos.elf" | sed "$renaming" | sort >"$dir/before" &&
        layout "$dir/$1/build/firmware/pico-display-demos.elf" | sed "$renaming" | sort >"$dir/after" && [ "$(wc -l <"$dir/before")" -gt 500 ] &&
        diff "$dir/before" "$dir/after"
}

in_ram() { # name...: sections of the first image
    local name
    for name; do grep -q "^$name \.ram_text " "$dir/layout" || { echo "$name: $(grep "^$name " "$dir/layout")" && return 1; }; done
}

loses_a_tier() {
    copy loses && sed -i 's/HAL_TIER(interrupt) static void go_on/static void go_on/' "$dir/loses/hal/chips/rp2/spi.c" &&
        ! cmp -s hal/chips/rp2/spi.c "$dir/loses/hal/chips/rp2/spi.c" && image "$dir/loses" && ! as_before loses && ! reached_lies_in_ram loses
}

# What the interrupt runs, by gcc's call graph: none of it lies elsewhere.
reached_lies_in_ram() { # folder
    local graph=$dir/$1/build/firmware/pico-display-objects/hal/chips/rp2/spi.ci
    layout "$dir/$1/build/firmware/pico-display-demos.elf" >"$dir/layout"
    awk -F'"' '/^edge:/ { from[++n] = $2; to[n] = $4 }
        END {
            reached["rp2_bus_interrupt"]
            for (more = 1; more;) { more = 0; for (i = 1; i <= n; i++) { if (from[i] in reached && !(to[i] in reached)) { reached[to[i]]; more = 1 } } }
            for (f in reached) { sub(/.*:/, "", f); print f }
        }' "$graph" >"$dir/reached"
    mapfile -t names <"$dir/reached"
    [ ${#names[@]} -ge 3 ] && in_ram "${names[@]}"
}

no_such_tier() {
    copy odd && sed -i 's/PH_TIER(loop) uint32_t ph_draw_triangle/PH_TIER(lop) uint32_t ph_draw_triangle/' "$dir/odd/firmware/core/render/raster.c" &&
        ! cmp -s firmware/core/render/raster.c "$dir/odd/firmware/core/render/raster.c" && ! image "$dir/odd" && grep -q 'a tier that PORT_TIERS does not name' "$dir/said"
}

copy tree && image "$dir/tree" || exit 1
check "what the bus's interrupt runs lies in RAM" reached_lies_in_ram tree
check "three functions that the scripts might know are renamed" rename_three
check "... and every function stays in its section, and every section keeps its size" as_before renamed
check "... a function that loses its tier is seen" loses_a_tier
check "a tier that the port does not know is refused" no_such_tier
tap_end
