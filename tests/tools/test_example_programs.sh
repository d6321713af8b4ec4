#!/usr/bin/env bash
# The examples are built as users build them, run, and write the pictures whose CRCs tests/golden/examples.txt has; all
# compilers' are equal. Beside that: arithmetic says where the triangle lies and what is picked, and pictures with a second
# core, and with bounds, are those without. LONG=1: every program with gcc and clang at -O0, -O2 and -Os, plain and under
# sanitizers, and in 32 bits; else each in one of three ways.
# shellcheck disable=SC2317,SC2086,SC2046 # functions are called by check; words
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
unset MAKEFLAGS
B=${B:-build}
here=firmware/package/examples
golden=tests/golden/examples.txt
dir=$(mktemp -d) && trap 'rm -rf "$dir"' EXIT
make -s B="$B" "$B/libpinhole.a" >/dev/null || exit 1
mapfile -t programs < <(cut -d' ' -f1 $golden)

has() { # compiler, flag...: whether such a program runs here
    echo 'int main(void) { return 0; }' | "$1" "${@:2}" -x c - -o "$dir/probe" 2>/dev/null && "$dir/probe"
}

of() { # gcc or clang, program: the compiler for it
    case $1:$2 in gcc:*.cpp) echo g++ ;; clang:*.cpp) echo clang++ ;; *) echo "$1" ;; esac
}

# Builds programs, two at a time, and compares. Without LONG they are a third of all: those whose turn it is.
draws() { # turn, gcc or clang, flag...
    local turn=$1 cc=$2 mine=("${programs[@]}") program
    shift 2
    [ -n "${LONG-}" ] || mapfile -t mine < <(printf '%s\n' "${programs[@]}" | awk -v turn="$turn" 'NR % 3 == turn')
    for program in "${mine[@]}"; do echo "$program $(of "$cc" "$program")"; done |
        B=$B xargs -P2 -L1 bash -c "firmware/package/examples.sh run \"\$0\" '$dir/'\"\$0.ppm\" \"\$1\" $* 2>'$dir/'\"\$0.said\" || { echo \"\$0\" && cat '$dir/'\"\$0.said\"; }"
    for program in "${mine[@]}"; do echo "$program $(cksum <"$dir/$program.ppm" | cut -d' ' -f1)"; done |
        diff <(printf '%s\n' "${mine[@]}" | while read -r program; do grep "^$program " $golden; done) -
}

in_32_bits() {
    local small=$dir/m32
    make -s -j2 B="$small" CFLAGS='-O1 -m32' CPU=portable "$small/libpinhole.a" && B=$small draws 0 gcc -O1 -m32
}

every_one_is_tried() { diff <(cut -d' ' -f2 <(sed -n 's/^| !.*(\(pictures.*\)) | \[\(.*\)\](.*/x \2/p' $here/README.md)) <(printf '%s\n' "${programs[@]}"); }
the_page_is_made() { firmware/package/examples.sh readme | diff $here/README.md -; }
links_lead_somewhere() {
    local to
    grep -oE '\]\([^)]*\)' $here/README.md | tr -d '])(' | while read -r to; do [ -s "$here/$to" ] || { echo "$to" && exit 1; }; done
}
lengths() { wc -l $(printf "$here/%s " "${programs[@]}") | awk '$2 != "total" && ($1 < 20 || $1 > 80) { print; bad = 1 } END { exit bad }'; }

# With this change the program must draw the same.
same_with() { # program, sed script
    sed "$2" "$here/$1" >"$dir/copy.c"
    ! cmp -s "$dir/copy.c" "$here/$1" && B=$B firmware/package/examples.sh run "$dir/copy.c" "$dir/copy.ppm" gcc -O1 -Wno-unused &&
        cmp "$dir/copy.ppm" "$dir/$1.ppm"
}

# The rightmost and the leftmost orange column of triangle.c, from its camera: x = 120 + F X / (4 - Z), F = 90 cot 22.5.
the_triangle_lies_where_arithmetic_says() {
    tail -c $((240 * 180 * 3)) "$dir/triangle.c.ppm" | od -An -v -tu1 -w720 | awk '
        { for (x = 0; x < 240; x++) if ($(3 * x + 1) > 200 && $(3 * x + 3) == 0) { if (!n++ || x < left) left = x; if (x > right) right = x; if (!seen[NR]++) rows++ } }
        END {
            turn = 20 / 256 * 2 * 3.14159265358979; F = 90 / 0.41421356237
            for (s = -1; s <= 1; s += 2) { X = s * cos(turn); Z = -s * sin(turn); at[s] = 120 + F * X / (4 - Z); low[s] = 90 + F / (4 - Z) }
            bottom = low[1] > low[-1] ? low[1] : low[-1]; top = 90 - F / 4
            ok = left - at[-1] < 1.5 && at[-1] - left < 1.5 && right - at[1] < 1.5 && at[1] - right < 1.5 && rows - (bottom - top) < 2 && bottom - top - rows < 2
            if (!ok) { print left, right, rows, "expected", at[-1], at[1], bottom - top }
            exit !ok
        }'
}

# Object 5 of picking.c stands at (2, 0, 0): its hole lies 22 pixels left of the pixel that is asked, on its tube.
it_picks() { grep -q 'at 201, 80 lies object 5' "$dir/picking.c.said"; }

sanitize='-fsanitize=address,undefined -fno-sanitize-recover=all'
check "examples_draw_by_gcc_O2" draws 0 gcc -O2
if has gcc $sanitize; then check "examples_draw_by_gcc_O0_under_sanitizers" draws 1 gcc -O0 $sanitize; else check "examples_draw_by_gcc_O0" draws 1 gcc -O0; fi
if command -v clang >/dev/null; then check "examples_draw_by_clang_Os" draws 2 clang -Os; else check "examples_draw_by_gcc_Os" draws 2 gcc -Os; fi
for cc in ${LONG:+gcc clang}; do
    command -v $cc >/dev/null || { skip "examples_draw_by_$cc" "no $cc here" && continue; }
    for level in -O0 -O2 -Os; do
        check "examples_draw_by_${cc}_${level#-}_too" draws 0 $cc $level
        if has $cc $sanitize; then check "... under_sanitizers" draws 0 $cc $level $sanitize; else skip "... under_sanitizers" "$cc has none here"; fi
    done
done
if [ -n "${LONG-}" ]; then
    if has gcc -m32; then check "examples_draw_in_32_bits" in_32_bits; else skip "examples_draw_in_32_bits" "no gcc-multilib"; fi
fi
check "the_page_has_every_example" every_one_is_tried
check "the_page_is_what_make_examples_writes" the_page_is_made
check "its_links_lead_somewhere" links_lead_somewhere
check "an_example_has_20_to_80_lines" lengths
check "a_second_core_draws_the_same" same_with cores.c '/config.other_core\|config.cores/d'
check "bounds_draw_the_same" same_with objects.c 's/ int status = example_look/ mesh.bounds = NULL;\n&/'
check "the_triangle_lies_where_arithmetic_says" the_triangle_lies_where_arithmetic_says
check "the_picked_object_is_the_one_at_the_pixel" it_picks
tap_end
