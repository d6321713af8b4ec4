#!/bin/sh
# Usage: host-sim/page/page.sh PAGE.html STYLE.css MODULE.wasm SCRIPT.mjs...
# Prints the page as one file. Its template has a line for each of the parts: @style@, @wasm@, @modules@. The scripts share
# one scope, so their imports go away; each comes after those that it imports.
set -eu
page=$1 style=$2 wasm=$3
shift 3
while IFS= read -r line; do
    case $line in
    @style@) cat "$style" ;;
    @wasm@) base64 -w 0 "$wasm" && echo ;;
    @modules@) for script; do sed -e '/^import /d' -e 's/^export //' "$script"; done ;;
    *) printf '%s\n' "$line" ;;
    esac
done <"$page"
