#!/bin/sh
# Usage: host-sim/page/page.sh PAGE.html NAME='FILE...'...
# Prints the page as one file. In place of each line @NAME@ of its template stand these files: modules of WebAssembly as
# base64 of gzip. Scripts share one scope, so their imports go away; each comes after those that it imports.
set -eu
page=$1
shift
while IFS= read -r line; do
    files=
    for part; do
        [ "$line" != "@${part%%=*}@" ] || files=${part#*=}
    done
    [ "$files" ] || printf '%s\n' "$line"
    for file in $files; do
        case $file in
        *.wasm) gzip -9n <"$file" | base64 -w 0 && echo ;;
        *.mjs) sed -e '/^import /d' -e 's/^export //' "$file" ;;
        *) cat "$file" ;;
        esac
    done
done <"$page"
