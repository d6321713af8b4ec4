#!/usr/bin/env bash
# Usage: firmware/package/docs/docs.sh      `make docs` calls it
# Writes a site by Doxygen: the public headers, the folders' papers, the examples with their pictures, the tutorial. Fails
# where a public symbol has no comment, or a link leads nowhere.
# Environment: B (build directory), VERSION.
set -eu
cd "$(dirname "$0")/../../.."
command -v doxygen >/dev/null || { echo 'make docs: no doxygen here: apt-get install doxygen' >&2; exit 1; }
docs=firmware/package/docs
out=${B:-build}/docs
headers=$(echo firmware/core/*.h hal/*.h boards/boards.h firmware/app/{demo,image,runner,runner_config}.h)
papers=$(echo README.md {firmware,hal,boards,host-sim,tests,tests/bench,firmware/package/examples}/README.md $docs/tutorial.md)
rm -rf "$out" && mkdir -p "$out/papers"
# shellcheck disable=SC2086 # words
awk -v TO="$out/papers" -v HEADERS="$headers" -f $docs/paper.awk $papers
{
    cat $docs/Doxyfile
    echo "INPUT = $out/papers $headers"
    echo "OUTPUT_DIRECTORY = $out"
    echo "PROJECT_NUMBER = ${VERSION-}"
    echo "FILTER_PATTERNS = *.h=\"awk -f $docs/header.awk\""
} >"$out/Doxyfile"
doxygen "$out/Doxyfile" 2>"$out/said" >&2 || { sed "s|$PWD/||" "$out/said" >&2 && exit 1; }

# The pictures of the papers, which have names of their own.
# shellcheck disable=SC2086 # words
grep -ohE '!\[[^]]*\]\([^)]*\)' $papers | sed 's/.*(//; s/)$//; s|.*/||' | sort -u | while read -r picture; do
    found=$(find host-sim firmware -name "$picture")
    [ "$(wc -l <<<"$found")" = 1 ] || { echo "$picture: $found" >&2 && exit 1; } # two of one name, or none
    cp "$found" "$out/html"
done
cp firmware/package/examples/*.{c,h,cpp,ino} "$out/html"
$docs/links.sh "$out/html"
rm -rf "$out/Doxyfile" "$out/said" "$out/papers"
echo "$out/html/index.html: $(find "$out/html" -name '*.html' | wc -l) pages"
