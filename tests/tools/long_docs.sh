#!/usr/bin/env bash
# `make docs` writes a site: every public symbol has a comment, every link leads somewhere, every paper, example and chapter is
# there; and the makers of the site see what is missing.
# shellcheck disable=SC2317 # functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
unset MAKEFLAGS
B=${B:-build}
command -v doxygen >/dev/null || { echo "no doxygen: apt-get install doxygen" && exit 77; }
dir=$(mktemp -d) && trap 'rm -rf "$dir"' EXIT
docs=firmware/package/docs
site=$dir/docs/html

is_written() { make -s docs B="$dir" && [ "$(find "$site" -name '*.html' | wc -l)" -gt 100 ]; }

# In a copy of the tree in which one thing is wrong, `make docs` says it in its own words and fails.
is_missed() { # file, sed script, words
    rm -rf "$dir/tree" && mkdir "$dir/tree" && cp -rs "$PWD"/{README.md,firmware,hal,boards,host-sim,tests} "$dir/tree" && rm "$dir/tree/$1" || return 1
    sed "$2" "$1" >"$dir/tree/$1"
    cmp -s "$1" "$dir/tree/$1" && echo "$2 changes nothing" && return 1
    B=$dir/tree/b "$dir/tree/$docs/docs.sh" >"$dir/said" 2>&1 && echo "nothing is missed" && return 1
    grep -q "$3" "$dir/said" || { cat "$dir/said" && return 1; }
}

# What the headers declare, found without Doxygen: each stands in the site.
every_function_is_there() {
    cat firmware/core/*.h hal/*.h boards/boards.h |
        sed -nE '/^(static inline )?(int|void|bool|fx_t|u?int[0-9]+_t|struct [a-z_0-9]+|const [a-z_ ]+)\b[^;=]*\(/s/^[^(]*[ *]((fx|ph|hal|panel|port|board)_[a-z0-9_]+)\(.*/\1/p' | sort -u >"$dir/names"
    sed -n '/class="memItemRight"/s/<[^>]*>/ /gp' "$site"/*_8h.html | grep -oE '[a-z][a-z0-9_]+' | sort -u >"$dir/told"
    [ "$(wc -l <"$dir/names")" -gt 150 ] && [ -z "$(comm -23 "$dir/names" "$dir/told" | tee /dev/stderr)" ]
}

# The papers, the examples with their pictures, and the five chapters with theirs.
every_page_is_there() {
    local file missing=0
    for file in {firmware,hal,boards,host-sim,tests,testsbench,firmwarepackageexamples,tutorial,index}.html; do [ -s "$site/$file" ] || { echo "$file" && missing=1; }; done
    for file in firmware/package/examples/pictures/*.png; do
        file=${file##*/}
        { [ -s "$site/$file" ] && grep -qF "src=\"$file\"" "$site/firmwarepackageexamples.html" && ls "$site/${file%.png}".c*; } >/dev/null || { echo "$file" && missing=1; }
    done
    return "$missing"
}

# Each chapter has one picture, and the program that draws it, which the tests build and run (golden/examples.txt).
a_chapter_has_its_program() {
    awk '/^## / { n++ } /^!\[/ { sub(/.*pictures\//, ""); sub(/\.png\)$/, ""); picture[n] = picture[n] $0 } n { text[n] = text[n] $0 }
        END { for (i = 1; i <= n; i++) print i, picture[i], (index(text[i], "(../examples/" picture[i] ".c)") > 0); exit n != 5 }' "$docs"/tutorial.md >"$dir/chapters" || return 1
    cat "$dir/chapters"
    [ "$(awk '$3 == 1' "$dir/chapters" | wc -l)" = 5 ] && while read -r _ program _; do grep -q "^$program.c " tests/golden/examples.txt || exit 1; done <"$dir/chapters"
}

a_link_to_nowhere_is_told() {
    printf '<a id="here" href="#here">x</a><a href="#away">x</a><img src="none.png"><a href="other.html#x">x</a>\n' >"$dir/a.html"
    [ "$("$docs"/links.sh "$dir" | sort | tr '\n' ' ')" = "a.html: a.html#away a.html: none.png a.html: other.html#x " ]
}

check "make_docs_writes_a_site" is_written
check "every_function_of_the_headers_is_in_it" every_function_is_there
check "every_paper_and_example_is_in_it" every_page_is_there
check "a_chapter_of_the_tutorial_has_its_program" a_chapter_has_its_program
check "a_link_to_nowhere_is_told" a_link_to_nowhere_is_told
check "a_function_without_a_comment_is_told" is_missed hal/panel_diff.h '/^\/\* Ends a frame/d' 'panel_diff_end.*is not documented'
check "a_struct_without_a_comment_is_told" is_missed firmware/core/blur.h '/^\/\* A lens with/d' 'ph_focus is not documented'
check "a_heading_that_is_gone_is_told" is_missed hal/README.md 's/^## Add a panel$/## Add panels/; s/^## A panel of your own/## A panel/' 'hal-a-panel-of-your-own'
tap_end
