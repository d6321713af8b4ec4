#!/usr/bin/env bash
# Usage: firmware/package/docs/links.sh FOLDER      says which links of its pages lead nowhere, and fails if one does
set -eu
cd "$1"
find . -type f | sed 's|^\./||' | awk '
    FILENAME == "-" { there[$0] = 1; next }
    { text = $0
      while (match(text, /(id|name|href|src)="[^"]*"/)) {
          page = FILENAME; sub(/^\.\//, "", page)
          word = substr(text, RSTART, RLENGTH); text = substr(text, RSTART + RLENGTH)
          value = word; sub(/^[a-z]+="/, "", value); sub(/"$/, "", value)
          if (word ~ /^(id|name)=/) { there[page "#" value] = 1 }
          else if (value !~ /^[a-z]+:|^$|[$]/) { asked[page " " (value ~ /^#/ ? page : "") value] = 1 }
      } }
    END {
        for (ask in asked) {
            split(ask, a, " "); file = a[2]; sub(/#.*/, "", file)
            if (!(file in there) || (a[2] ~ /#/ && !(a[2] in there))) { print a[1] ": " a[2]; bad = 1 }
        }
        exit bad
    }' - ./*.html
