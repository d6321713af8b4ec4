#!/usr/bin/env bash
# What the READMEs show works: its program compiles without a warning and prints what stands there, its commands run, its
# links lead somewhere, its numbers are those that the checks hold. (Its tables: test_readme_tables.c.)
# shellcheck disable=SC2317,SC2015 # functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
unset MAKEFLAGS
B=${B:-build}
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT

readmes=(README.md */README.md */*/README.md)

block() { # language, pattern: the first fenced block of that language in which a line matches, in any README.md
    awk -v fence="^\`\`\`$1\$" -v pattern="$2" '
        $0 ~ fence { inside = 1; text = ""; found = 0; next }
        inside && /^```$/ { if (found) { printf "%s", text; exit } inside = 0 }
        inside { text = text $0 "\n"; if ($0 ~ pattern) { found = 1 } }' "${readmes[@]}"
}

program_prints_what_is_shown() { # built by the command that stands below it
    block c 'int main' >"$dir/hello.c"
    block text '####' >"$dir/expected"
    local commands
    commands=$(block sh '-o hello' | sed "s|^sudo make install|make -s install-dev PREFIX=$dir/usr|; s|^cc|cc -std=c11 -Wall -Wextra -Werror|")
    if [ ! -s "$dir/hello.c" ] || [ ! -s "$dir/expected" ] || [ -z "$commands" ]; then
        echo "no program, no commands or no output in README.md"
        return 1
    fi
    bash -e -c "${commands%%cc*}" && (cd "$dir" && PKG_CONFIG_PATH=$dir/usr/lib/pkgconfig bash -e -c "cc${commands#*cc}") >"$dir/printed" && diff "$dir/expected" "$dir/printed"
}

# What the README's board.c and show() do on a simulated kit: the whole glass gets the background, nobody complains.
cat >"$dir/main.c" <<'END'
#include "board.h"
#include "render.h"
#include "sim.h"

#include <stdlib.h>

static int show(struct ph_renderer *r, const struct board *board, const struct hal *hal, uint16_t *pixels);
extern const struct board board_mine;
int main(void)
{
    enum { SIDE = 240, BAND = 16, BANDS = SIDE / BAND };
    static uint16_t depth[SIDE * BAND], pixels[SIDE * BAND];
    static uint8_t seen[SIDE * SIDE * 3];
    uint32_t bins[BANDS], red = 0;
    const struct ph_config config = {.width = SIDE, .height = SIDE, .band_height = BAND, .depth_format = PH_DEPTH_FIXED16,
                                     .vertices = malloc(3 * ph_vertex_bytes), .vertex_max = 3, .triangles = malloc(ph_triangle_bytes),
                                     .triangle_max = 1, .bins = bins, .bin_max = BANDS, .depth = depth};
    struct ph_projection lens;
    struct ph_renderer r;
    struct hal hal;
    struct sim *sim = sim_open(&board_mine, &hal);
    if (sim == NULL || ph_projection_perspective(&lens, FX_INT(45), FX_ONE, FX_HALF, FX_INT(10)) ||
        ph_renderer_init(&r, &config) || ph_frame_begin(&r, &ph_xform_identity, &lens, NULL, ph_rgb565(255, 0, 0)) ||
        show(&r, &board_mine, &hal, pixels)) {
        return 1;
    }
    sim_pixels(sim, board_mine.rotation, seen);
    for (uint32_t i = 0; i < SIDE * SIDE; i++) {
        red += seen[3 * i] == 255 && seen[3 * i + 1] == 0 && seen[3 * i + 2] == 0;
    }
    return red == SIDE * SIDE && sim_complaint_count(sim) == 0 ? 0 : 2;
}
END

the_arm_is_the_examples() { # which test_example_programs.sh builds and runs
    block c 'ph_pose_blend' >"$dir/arm.c"
    [ -s "$dir/arm.c" ] && sed -n '/^\/\* Finds where the joints/,/^}/p' firmware/package/examples/animation.c | diff - "$dir/arm.c"
}

board_and_show_fill_the_glass() {
    block c 'struct board board_mine' >"$dir/board.c"
    { cat "$dir/main.c" && block c 'panel_open'; } >"$dir/show.c"
    [ -s "$dir/board.c" ] && grep -q panel_frame_end "$dir/show.c" && make -s B="$B" all || return 1
    cc -std=c11 -Wall -Wextra -Werror -Ihal -Iboards -Ihost-sim/controllers -Ifirmware/core/kernels/portable -Ifirmware/core "$dir/board.c" "$dir/show.c" \
        "$B"/libpinhole-{host,app,hal}.a "$B/libpinhole.a" -o "$dir/show" && "$dir/show"
}

image_of_that_board_gets_its_memory() { # that of board.c, with a board.mk as the README tells
    mkdir -p "$dir/kits/mine" && cp boards/pico-display/board.mk "$dir/kits/mine" && block c 'struct board board_mine' >"$dir/kits/mine/board.c"
    local bytes
    bytes=$(make -s B="$dir/b" BOARD_DIR="$dir/kits" BOARD=mine "$dir/b/board-facts" && "$dir/b/board-facts" scene_bytes)
    [ "$bytes" = $((106 * 1024)) ] || { echo "board-facts says '$bytes'" && return 1; }
}

commands_run() {
    block sh '--board' | grep -E '^build/pinhole-sim [^|]*$' | grep -Ev -- '--model|--window' | sed 's/ *#.*//' >"$dir/commands"
    [ -s "$dir/commands" ] || return 1
    mkdir -p "$dir/build" && ln -sf "$(realpath "$B")/pinhole-sim" "$dir/build" && (cd "$dir" && bash -e commands)
}

anchors() { # FILE: of its headings, as GitHub names them
    # shellcheck disable=SC2016 # backquotes of Markdown
    sed -n '/^```/,/^```/!s/^##* //p' "$1" | tr 'A-Z ' 'a-z-' | sed 's/[^a-z0-9_-]//g'
}

links_exist() {
    local readme link file anchor missing=0
    for readme in "${readmes[@]}"; do
        while read -r link; do
            file=${link%%#*} anchor=${link#"${link%%#*}"}
            file=${file:+$(dirname "$readme")/$file}
            [ -e "${file:-$readme}" ] || { echo "$readme: $link" && missing=1 && continue; }
            [ -z "$anchor" ] || anchors "${file:-$readme}" | grep -qx -- "${anchor#\#}" || { echo "$readme: $link: no such heading" && missing=1; }
        done < <(grep -oE '\]\([^)]+' "$readme" | cut -c3- | grep -v '^http')
    done
    return "$missing"
}

every_paper_is_linked() { # a README.md that README.md does not name is not found
    local readme missing=0
    for readme in "${readmes[@]:1}"; do
        grep -qF "]($readme" README.md || { echo "$readme" && missing=1; }
    done
    return "$missing"
}

# The table of tests/bench/README.md is what the command prints; the row of README.md has two of its lines' numbers.
headline_is_of_the_bench() {
    tests/bench/headline.sh >"$dir/headline" && [ "$(wc -l <"$dir/headline")" = 8 ] &&
        awk '/^## The headline/ { inside = 1; next } /^## / { inside = 0 } inside && /^\|/' tests/bench/README.md | diff - "$dir/headline" &&
        awk -F' *\\| *' '/M0\+|M4F/ { text = text (text ? ", " : "") $2 " " $3 (NR == 3 ? " (best other: " : " (") $4 ")" } END { print text }' "$dir/headline" >"$dir/row" &&
        grep -qF "| $(cat "$dir/row") |" README.md || { cat "$dir/row" && return 1; }
}

# So is that of Xtensa, and firmware/README.md has its least and its most.
ratios_are_of_the_bench() {
    tests/bench/ratio.sh lx106 rv32 >"$dir/ratio" && [ "$(wc -l <"$dir/ratio")" = 10 ] &&
        awk '/^\| scene \| lx106 \|/ { inside = 1 } !/^\|/ { inside = 0 } inside' tests/bench/README.md | diff - "$dir/ratio" &&
        grep -qF "lx106 $(awk -F' *[|] *' 'NR > 2 { print $5 }' "$dir/ratio" | sort -n | sed -n '1s/$/ to/p; $p' | xargs) times" firmware/README.md
}

targets_exist() {
    local target
    while read -r target; do
        grep -qh "^$target:.*##" Makefile firmware/firmware.mk firmware/package/package.mk host-sim/page/page.mk || { echo "make $target" && return 1; }
    done < <(grep -ohE '(^|`)make [a-z][a-z-]*' "${readmes[@]}" | cut -d' ' -f2 | sort -u)
}

most() { awk -F, -v metric="$1" '$3 == metric && $4 + 0 > most + 0 { most = $4 } END { print most }' tests/golden/bench.csv; }

numbers_are_those_of_the_checks() { # budgets and counts, as the papers write them
    local paper number name missing=0
    while read -r paper number name; do
        grep -q "$(LC_ALL=C sed ':a; s/\([0-9]\)\([0-9]\{3\}\)\($\|,\)/\1,\2\3/; ta' <<<"$number") $name" "$paper" || { echo "$paper: $number $name" && missing=1; }
    done <<EOF
README.md $(sed -n 's/^BUDGET_CORE_BYTES ?= //p' Makefile) bytes of code
README.md $(sed -n 's/^stack_max=\([0-9]*\).*/\1/p' tests/firmware/long_objects.sh) bytes of stack
README.md $(wc -l <tests/golden/frames.txt) frames
README.md $((240 * 16 * 4)) bytes for colour
firmware/README.md $("$B/pinhole-sim" --list | grep -c "^demo ") demos are whole on every kit
EOF
    grep -qF "at most $(most coverage_pct) % of the covered" README.md || { echo "coverage: $(most coverage_pct)" && missing=1; }
    awk -v rms="$(most depth_rms)" 'BEGIN { exit !(rms > 0 && rms <= 1e-5) }' || { echo "depth: $(most depth_rms)" && missing=1; }
    return "$missing"
}

first_picture_is_small() { [ "$(wc -c <host-sim/gallery/first.gif)" -le 600000 ]; }

readme_is_short() { [ "$(wc -l <README.md)" -le 300 ]; }

check "the_program_prints_what_is_shown" program_prints_what_is_shown
check "the_arm_that_moves_is_that_of_the_example" the_arm_is_the_examples
check "the_board_and_show_fill_the_glass" board_and_show_fill_the_glass
check "an_image_of_that_board_gets_its_memory" image_of_that_board_gets_its_memory
check "the_commands_run" commands_run
check "the_first_picture_has_at_most_600_KB" first_picture_is_small
check "the_links_lead_somewhere" links_exist
check "every_paper_is_linked" every_paper_is_linked
check "the_README_has_at_most_300_lines" readme_is_short
check "the_headline_is_what_the_bench_says" headline_is_of_the_bench
check "what_Xtensa_takes_is_what_the_bench_says" ratios_are_of_the_bench
check "the_make_targets_exist" targets_exist
check "the_numbers_are_those_of_the_checks" numbers_are_those_of_the_checks
tap_end
