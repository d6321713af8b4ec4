#!/usr/bin/env bash
# The house rules that a tool can check: what the libraries export, who may include whom, how large folders, functions and
# the README may be, how comments begin. Each check is tried on an example that breaks its rule, too.
# shellcheck disable=SC2317,SC2016 # functions are called by check; $0 is awk's
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
unset MAKEFLAGS
B=${B:-build}
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
product=(firmware hal host-sim boards)

none() { # command that prints what breaks a rule
    local found
    found=$("$@")
    [ -z "$found" ] || { head -n 30 <<<"$found" && return 1; }
}

sees() { # pattern, command that must print it
    local found
    found=$("${@:2}")
    grep -q -- "$1" <<<"$found" || { echo "says: '$found'" && return 1; }
}

# ---- exported symbols ----------------------------------------------------------------------------

# Prefixes that a library may use: the names of its folders and of its source files, of which a symbol takes one. A room
# that is named after what it holds many of gives the singular, too.
prefixes() { # folder...
    { find "$@" \( -type d -o -name '*.[ch]' \) && find "$@" -type d -name '*s' | sed 's|s$||'; } |
        sed 's|.*/||; s|\.[ch]$||; s|-|_|g' | sort -u
}

# Exported symbols that begin with none of the prefixes on stdin.
symbols_without() { # library or object
    awk 'NR == FNR { allowed[$1]; next }
        NF == 3 && $2 ~ /^[A-Z]$/ {
            for (n = length($3); n > 0; n--) {
                if ((n == length($3) || substr($3, n + 1, 1) == "_") && substr($3, 1, n) in allowed) { next }
            }
            print $3
        }' - <(nm -g --defined-only "$1" 2>/dev/null)
}

foreign_symbols() { # library, folder...
    prefixes "${@:2}" | symbols_without "$1"
}

core_symbols() { printf '%s\n' ph fx | symbols_without "$B/libpinhole.a"; }

a_foreign_symbol() { # C text, folder... whose names it may have; none: those of the core
    echo "$1" | cc -c -x c - -o "$dir/symbol.o" &&
        if [ $# -gt 1 ]; then foreign_symbols "$dir/symbol.o" "${@:2}"; else printf '%s\n' ph fx | symbols_without "$dir/symbol.o"; fi
}

# ---- circles -------------------------------------------------------------------------------------

# "FROM TO" for each include between modules. A module is a source with the header of its name beside it; a public header,
# which lies a folder above what is behind it, is a module of its own. Of a name that is found twice (a file of a CPU
# replaces the portable one) both count.
includes() { # folder...
    local files=(find "$@" -name '*.[chS]')
    {
        "${files[@]}" -printf 'file %p\n'
        "${files[@]}" -exec awk 'sub(/^ *# *include "/, "") && sub(/".*/, "") { print "include", FILENAME, $0 }' {} +
    } | awk '
        function stem(path) { sub(/\.[chS]$/, "", path); return path }
        function folder(path) { return match(path, /.*\//) ? substr(path, 1, RLENGTH - 1) : "" }
        function base(path) { sub(/.*\//, "", path); return path }
        $1 == "file" { here[$2]; named[base($2)] = named[base($2)] " " $2; next }
        { from[++n] = $2; what[n] = $3 }
        END {
            for (i = 1; i <= n; i++) {
                beside = folder(from[i]) "/" what[i]
                for (j = split(named[base(what[i])], path, " "); j > 0; j--) {
                    if (beside in here ? path[j] == beside : substr(path[j], length(path[j]) - length(what[i])) == "/" what[i]) {
                        if (stem(from[i]) != stem(path[j])) { print stem(from[i]), stem(path[j]) }
                    }
                }
            }
        }' | sort -u
}

circles() { includes "$@" | tsort 2>&1 >/dev/null | sed 's/^tsort: //'; }

# Circles of the objects of a library, each of which needs what the next one defines. A header that declares what several
# sources define hides none from this.
object_circles() { # library
    nm -A -g "$1" | sed 's/^[^:]*://' | awk '
        { object = $1; sub(/:.*/, "", object) }
        $(NF - 1) == "U" { needs[object " " $NF]; next }
        { owner[$NF] = object }
        END {
            for (one in needs) {
                split(one, word, " ")
                if (word[2] in owner && owner[word[2]] != word[1]) { print word[1], owner[word[2]] }
            }
        }' | sort -u | tsort 2>&1 >/dev/null | sed 's/^tsort: //'
}

an_object_circle() {
    echo 'int b(void); int a(void) { return b(); }' | cc -x c -c -o "$dir/circle/a.o" - &&
        echo 'int a(void); int b(void) { return a(); }' | cc -x c -c -o "$dir/circle/b.o" - &&
        rm -f "$dir/circle/ab.a" && ar rc "$dir/circle/ab.a" "$dir/circle/a.o" "$dir/circle/b.o" && object_circles "$dir/circle/ab.a"
}

a_circle() {
    mkdir -p "$dir/circle" && echo '#include "b.h"' >"$dir/circle/a.c" && : >"$dir/circle/a.h"
    echo '#include "a.h"' >"$dir/circle/b.c" && : >"$dir/circle/b.h"
    circles "$dir/circle"
}

# ---- sizes and words -----------------------------------------------------------------------------

too_many() { # folder, how many entries it may have
    local n
    n=$(find "$1" -mindepth 1 -maxdepth 1 | wc -l)
    [ "$n" -le "$2" ] || echo "$1 has $n entries, $2 are allowed"
}

long_functions() { # lines, folder...
    find "${@:2}" -name '*.[ch]' -exec awk -v most="$1" '
        FNR == 1 { open = head = 0 }
        /^[a-zA-Z].*\(/ && !/;$/ { head = FNR; name = $0 }
        /^{/ { open = head ? head : FNR }
        /^}/ { if (open && FNR - open + 1 > most) { print FILENAME ":" open ": " FNR - open + 1 " lines: " name } open = head = 0 }' {} +
}

a_long_function() { # lines
    {
        echo 'int f(int a)' && echo '{'
        yes '    a++;' | head -n $(($1 - 3))
        echo '}'
    } >"$dir/circle/long.c"
    long_functions 60 "$dir/circle"
}

long_readme() { awk 'END { if (NR > 300) { print FILENAME " has " NR " lines, 300 are allowed" } }' "$1"; }

odd_beginnings() { # folder...: comments that have to be read twice
    grep -rnE --include='*.[chSs]' --include='*.sh' --include='*.mk' --include='*.awk' --include='*.mjs' --include='*.ld' --include=Makefile \
        '(/\*+|//|^ *#|^ *\*) *(What of|Of (this|a|an|the|its)|Those of|The same (for|as)|Both (for|of)|Below it)\b' "$@"
}

# Notes "called as NAME" (firmware/tools/stack.awk) of which no call has the name: such a function's stack would not count.
misspelt() { # folder...
    local name
    grep -rhoE --include='*.[ch]' '/\* called as [a-z_0-9, ]+' "$@" | sed 's/.*called as //' | tr -s ', ' '\n' | sort -u | while read -r name; do
        case $name in '' | vector | rom) continue ;; esac
        grep -rqE --include='*.[ch]' "(->|\\.|\\(\\*|[ (!])$name\\)?\\(|/\\* calls [a-z_0-9, ]*\\b$name\\b" "$@" || echo "called as $name: no pointer of that name is called"
    done
}

# ---- totality -------------------------------------------------------------------------------------

# Functions of these headers, but of the renderer's, that a test does not name.
uncalled() { # test, header...
    find "${@:2}" ! -name render.h ! -name scene.h -exec grep -hoE '^[a-z][a-z0-9_ ]*[ *](fx|ph)_[a-z0-9_]+\(' {} + | grep -oE '[a-z0-9_]+\($' | tr -d '(' | sort -u |
        grep -vxFf <(grep -oE '[A-Za-z0-9_]+' "$1") | sed "s|^|$1 does not call |"
}

an_uncalled_function() {
    printf 'struct fx_vec3 fx_vec3_new(int a);\nint32_t *ph_b(void);\n' >"$dir/circle/new.h"
    echo 'ph_b();' >"$dir/circle/new.c"
    uncalled "$dir/circle/new.c" "$dir/circle/new.h"
}

# ---- names as configuration ----------------------------------------------------------------------

# Functions' names outside C and assembly: code that moves, or a rule that ends, in silence when one is renamed. A linker
# objects to an entry that is missing, and to a function that is wrapped.
functions() { # folder...
    find "$@" -name '*.[chS]' ! -path '*/emulate/*' -exec cat {} + | grep -oE '^[A-Za-z_][A-Za-z0-9_ *(),]*[ *][a-z][a-z0-9]*_[a-z0-9_]*\(' | grep -oE '[a-z0-9_]+\($' | tr -d '(' | sort -u
}

named() { # Makefile, linker script, awk program...
    awk 'FNR == NR { functions[$1]; next }
        {
            sub(/ENTRY\([a-z0-9_]*\)|--wrap=[a-z_]*,--defsym=[a-z_=]*/, "")
            sub(/\/\*.*\*\//, "")
            sub(/(^| )#.*/, "")
            for (text = $0; match(text, /\.(text|rodata)\.[a-z_][A-Za-z0-9_.]*/); text = substr(text, RSTART + RLENGTH)) {
                print FILENAME ": " substr(text, RSTART, RLENGTH)
            }
            for (text = $0; match(text, /[a-z][a-z0-9]*_[a-z0-9_]*/); text = substr(text, RSTART + RLENGTH)) {
                if (substr(text, RSTART, RLENGTH) in functions) { print FILENAME ": " substr(text, RSTART, RLENGTH) }
            }
        }' "$dir/functions" "$@" | sort -u
}

scripts() { { git ls-files Makefile '*.mk' '*.ld' '*.awk' 2>/dev/null | grep . || find Makefile firmware hal boards tests -name Makefile -o -name '*.mk' -o -name '*.ld' -o -name '*.awk'; } | xargs ls 2>/dev/null; }

a_named_function() { # text
    echo "$1" >"$dir/named.ld"
    named "$dir/named.ld"
}

# ---- walls ---------------------------------------------------------------------------------------

# A source file of a room that includes a header of another must not compile, for want of the header and nothing else. One make
# tries all of them. stdin: rooms and headers.
wall() {
    local n=0 room header goals=() house=$dir/house
    [ -e "$house" ] || { mkdir "$house" && cp -r Makefile firmware hal boards host-sim "$house"; } || return 1
    cat >"$dir/walls"
    while read -r room header; do
        n=$((n + 1))
        printf '#include "%s"\nextern int nothing;\n' "$header" >"$house/$room/wrong$n.c"
        goals+=("walls/$room/wrong$n.o")
    done <"$dir/walls"
    make -k -s -j2 -C "$house" B=walls "${goals[@]}" >"$dir/wall" 2>&1
    n=0
    while read -r room header; do
        rm "$house/$room/wrong$((++n)).c"
        [ ! -e "$house/walls/$room/wrong$n.o" ] || { echo "$room can include $header" && return 1; }
        grep -q "^$room/wrong$n.c:1.* $header: No such file" "$dir/wall" || { cat "$dir/wall" && return 1; }
    done <"$dir/walls"
    [ "$n" -gt 0 ]
}

# A header of a folder, the folder's own first.
header_of() { find "$1" -maxdepth 1 -name '*.h' | sort | sed -n '1s|.*/||p'; }

walls() {
    wall <<END
firmware/core/render hal.h
firmware/core/geom runner.h
firmware/core/fx $(header_of firmware/core/render)
firmware/core/geom $(header_of firmware/core/render)
firmware/app/demos $(header_of firmware/core/render)
firmware/app/demos options.h
hal/panel runner.h
hal/linux render.h
boards/pico-display runner.h
host-sim/sheet $(header_of host-sim/sim)
host-sim/sheet sim.h
host-sim/flash $(header_of host-sim/model)
host-sim/common $(header_of host-sim/model)
host-sim/emulate/rp2350 hal.h
host-sim/emulate/registers complain.h
host-sim/depth $(header_of firmware/core/kernels)
END
}

# Lines of lists of wrong writes and mutants (long_wrong_writes.sh, long_mutants.sh, long_proof.sh) whose sed expression changes nothing.
idle_changes() { # list...
    local line what file change before after
    local -A text
    grep -hv '^#' "$@" | while IFS= read -r line; do
        what=${line%% | *} line=${line#* | * | }
        file=${line%% | *} change=${line#* | }
        [ -n "${text[$file]-}" ] || text[$file]=$(<"$file")
        before=${text[$file]} after=$(sed -e "$change" "$file")
        [ "$before" != "$after" ] || echo "changes nothing: $what"
    done
}

a_hole() { wall <<<"firmware/core/render render.h"; } # which every room of the core may include

make -s -j2 B="$B" all >"$dir/made" 2>&1 || { cat "$dir/made" && exit 1; }
check "libpinhole.a exports names with ph_ and fx_ only" none core_symbols
check "... another name is seen" sees '^other$' a_foreign_symbol 'int other, ph_this; int fx_that(void); int fx_that(void) { return 0; }'
check "... and one that only begins alike" sees '^phone$' a_foreign_symbol 'int phone;'
check "libpinhole-app.a exports names of its rooms and modules only" none foreign_symbols "$B/libpinhole-app.a" firmware/app
check "... a room's singular is allowed" none a_foreign_symbol 'int model_a, models_b;' firmware/app
check "... and no other part of its name" sees '^mode_a$' a_foreign_symbol 'int mode_a, model_b;' firmware/app
check "libpinhole-hal.a exports names of its rooms and modules only" none foreign_symbols "$B/libpinhole-hal.a" hal boards
check "libpinhole-host.a exports names of its rooms and modules only" none foreign_symbols "$B/libpinhole-host.a" host-sim
check "libpinhole-tools.a exports names of its rooms and modules only" none foreign_symbols "$B/libpinhole-tools.a" host-sim
check "... another library's are seen" sees . foreign_symbols "$B/libpinhole-host.a" boards
check "no two modules include each other, however many lie between" none circles "${product[@]}"
check "... two that do are seen" sees 'circle/a$' a_circle
check "no two sources of the core need each other, however many lie between" none object_circles "$B/libpinhole.a"
check "... two that do are seen" sees '^b\.o$' an_object_circle
check "host-sim has at most 20 entries" none too_many host-sim 20
check "hal has at most 20 entries" none too_many hal 20
check "tests has at most 24 entries" none too_many tests 24
check "firmware/core has at most 16 entries" none too_many firmware/core 16
check "... one more is seen" sees 'has [0-9]* entries' too_many boards 1
check "no function has more than 60 lines" none long_functions 60 "${product[@]}" tests
check "... one of 61 is seen" sees '61 lines: int f' a_long_function 61
check "... and none of 60" none a_long_function 60
check "the README has at most 300 lines" none long_readme README.md
yes | head -n 301 >"$dir/long.md"
check "... 301 are seen" sees 'has 301 lines' long_readme "$dir/long.md"
check "no comment begins with words that have to be read twice" none odd_beginnings "${product[@]}" tests Makefile
printf 'int a;\n/* %s of a line is drawn. */\n' What >"$dir/circle/odd.c"
check "... one that does is seen" sees 'odd.c:2' odd_beginnings "$dir/circle"
check "what a function is called as is called" none misspelt firmware hal
printf 'static void f(void) /* called as rnu */\n' >"$dir/circle/odd.c"
check "... a misspelt name is seen" sees 'called as rnu' misspelt "$dir/circle"
check "fuzz_total calls every public function but the renderer's own" none uncalled tests/core/fuzz_total.c firmware/core/*.h
check "... one that it leaves out is seen" sees 'does not call fx_vec3_new$' an_uncalled_function
functions firmware hal boards >"$dir/functions"
# shellcheck disable=SC2046 # names are words
check "no linker script, Makefile or awk program has a function's name" none named $(scripts)
check "... a section's is seen" sees 'named.ld: .text.merge$' a_named_function '*render/bands.o(.text.merge .text.*)'
check "... and any other" sees 'named.ld: ph_draw_band$' a_named_function 'from ph_draw_band on'
check "... but no tier" none a_named_function '*(.tier.mesh.*) *(.text .text.*)'
check "each wrong write and each mutant changes its file" none idle_changes tests/hal/wrong_writes/*.txt tests/{core,proof}/mutants.txt
echo 'nothing | board | Makefile | s/^no such line$//' >"$dir/idle.txt"
check "... one that does not is seen" sees '^changes nothing: nothing$' idle_changes "$dir/idle.txt"
check "no room can include what is another's" walls
check "... a wall with a hole is seen" sees 'can include render.h' a_hole
tap_end
