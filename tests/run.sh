#!/usr/bin/env bash
# Usage: tests/run.sh check|test|long [VARIABLE=value for make...]
# Builds and runs the tests, one more at a time than there are processors, those that take longest first; ends with the
# one line `N passed, N failed, N skipped` and exits 1 when a test failed.
#   check  for every edit: the unit tests tests/*/test_*.c, also a folder deeper, and the scripts that take seconds; installs nothing
#   test   tests/*/test_*.c under sanitizers, plain those that are slow so, but not long_units; tests/*/fuzz_*.c under sanitizers, tests/*/test_*.sh
#   long   tests/*/exhaustive_*.c, tests/*/long_*.sh, tests/*/fuzz_*.c under sanitizers with the argument `long`, and
#          tests/*/test_*.c in the way that `test` leaves out; SHARE=K/N in the environment (K: 1 .. N) runs a share: tests that know
#          SHARE take every N-th of what they look at, the others run in one of the N
# A test speaks TAP (cmocka does; tests/tools/tap.sh helps a script) or just exits: 0 passed, 77 skipped, else failed.
# TEST_TIMEOUT seconds end a test that hangs. What a test says goes to $B/log/ and is shown when it fails.
set -u
cd "$(dirname "$0")/.." || exit 1
mode=${1-}
case "$mode" in
check | test) limit_s=3000 ;;
long) limit_s=6000 ;;
*) echo "usage: $0 check|test|long [VARIABLE=value...]" >&2 && exit 2 ;;
esac
shift
export SHARE=${SHARE:-1/1}
if ! [[ $SHARE =~ ^[1-9][0-9]*/[1-9][0-9]*$ ]] || [ "${SHARE%/*}" -gt "${SHARE#*/}" ]; then
    echo "$0: SHARE=$SHARE: K/N with K from 1 to N" >&2 && exit 2
fi

# Unit tests that are too slow for `check`, and those that are too slow under sanitizers for `test` (they run so in `long`), by
# the processor time that they took.
slow_units='test_panel_diff test_ft232h test_runner test_quality test_depth_slopes test_depth_planes'
slow_sanitized="$slow_units test_cores test_fisheye test_wire test_depth_mpfr test_levels test_watertight"
slow_sanitized+=' test_depth test_demos test_gif_out test_ahead test_depth_mesa test_fx_math test_shadow test_panel_tiles'
slow_sanitized+=' test_fx test_vertices test_counters test_sim_table test_dither test_texture test_demo_views test_coverage'
slow_sanitized+=' test_model_load test_depth_separation test_sim_page test_points'
long_units='test_depth_slopes test_depth_planes test_ahead test_wire' # of slow_sanitized; `test` leaves them out
unit_tests='tests/*/test_*.c tests/*/*/test_*.c'
quick_scripts='test_house test_flash_make test_panel_cli test_sheet test_sim_cli test_wire_cli'
# What takes longest, or has steps that only one processor can take, comes first.
first='test_size test_asset_cli test_kernels test_small test_targets
test_house test_sim_cli test_readme test_firmware_scene
long_boards_rp2040 long_firmware_rp2350 exhaustive_fx_math exhaustive_fx long_guest_soak long_guest_panel_boards long_mutants long_proof
long_debian13 long_bare long_guest_backends long_guest_flash_cuts long_guest_usb long_guest_panel long_make long_firmware_rp2040 long_firmware_rp2350_emulated long_firmware long_firmware_lm3s long_guest_flash'

export B=${B:-build} CC=${CC:-cc} CMOCKA_MESSAGE_OUTPUT=TAP UBSAN_OPTIONS=print_stacktrace=1 MAKEFLAGS=
export MALLOC_PERTURB_=165 # memory that a program forgets to set is never 0 (glibc)
export LSAN_OPTIONS=suppressions=$PWD/tests/tools/leaks.suppress:print_suppressions=0
export limit_s=${TEST_TIMEOUT:-$limit_s} results=$B/log/$mode.results running=$B/log/running
sanitize='-O1 -g1 -fno-omit-frame-pointer -fsanitize=address,undefined -fno-sanitize-recover=all'
! command -v ld.gold >/dev/null || sanitize+=' -fuse-ld=gold' # links 200 programs in half of the time
processors=$(nproc)
export bare=-Itests/support/bare # where cmocka is missing
! pkg-config --exists cmocka 2>/dev/null || bare=
make_args= # as one word, for the jobs
[ $# = 0 ] || printf -v make_args '%q ' "$@"
export make_args

# Counts TAP: "passed failed skipped". A plan that was not kept fails, and so does a bad exit without a failed test. Then the
# processor time of what `times` in bash wrote.
count() { # log, exit status, times
    awk -v status="$2" '
        FILENAME == ARGV[2] { if (FNR == 2) { gsub(/[ms]/, " "); cpu_s = 60 * $1 + $2 + 60 * $3 + $4 } next }
        /^1\.\.[0-9]+/ { planned += substr($1, 4) }
        /^(not )?ok [0-9]+.*# SKIP/ { skipped++; next }
        /^ok [0-9]/ { passed++ }
        /^not ok [0-9]/ { failed++ }
        END {
            seen = passed + failed + skipped
            if (planned > seen) { failed += planned - seen }
            else if (seen == 0 && status == 77) { skipped++ }
            else if (seen == 0 && status == 0) { passed++ }
            else if (status != 0 && failed == 0) { failed++ }
            printf "%d %d %d %.0f\n", passed, failed, skipped, cpu_s
        }' "$1" "$3"
}

# Headers of libraries that a source file, or what it includes of the tests' own, asks for and this machine lacks.
lacks() {
    local own
    own=$(sed -n 's:^#include "\(.*\)":tests/oracle/\1 tests/support/\1:p' "$1")
    # shellcheck disable=SC2086 # words; headers that are elsewhere are no matter
    cat "$1" $own 2>/dev/null | sed -n 's/^#include <\(.*\)>.*/#if !__has_include(<\1>)\n\1\n#endif/p' | $CC -E -P $bare - 2>/dev/null | xargs
}

prepare() { # build directory, source: status 77 when it cannot be built here, 1 when it is broken
    local what
    [[ " - $built " != *" $1 "* ]] || return 0 # everything was
    what=$(lacks "$2")
    [ -z "$what" ] || { echo "not here: $what" && return 77; }
    what=$1/${2%.c}
    eval "make -s V=1 $make_args B=$1 ${CFLAGS_JOB:+CFLAGS='$CFLAGS_JOB'} $what" 2>&1 || { echo "does not build" && return 1; }
}

# Few processes: there are hundreds of jobs, and many tests take less than a process does.
job() { # name, build directory (- for a script), source, [argument]
    local name=$1 log=$B/log/$1.log status=0 start=$SECONDS word=ok program=$3 passed failed skipped cpu_s so_far line
    : >"$running/$name"
    [ "$2" = - ] || program=$2/${3%.c}
    [[ $name != *.asan ]] || export CFLAGS_JOB=$sanitize
    prepare "$2" "$3" >"$log" || status=$?
    if [ $status = 0 ]; then
        { timeout -k 5 "$limit_s" "$program" ${4:+"$4"} </dev/null || status=$?; } >>"$log" 2>&1
        [ $status != 124 ] || echo "stopped after $limit_s s" >>"$log"
    fi
    times >"$running/$name"
    read -r passed failed skipped cpu_s < <(count "$log" $status "$running/$name")
    [ "$passed$failed" != 00 ] || word=skip
    [ "$failed" = 0 ] || word=FAIL
    echo "$passed $failed $skipped" >>"$results"
    mapfile -t so_far <"$results"
    printf -v line '%-4s %3d/%d %-32s %d passed, %d failed, %d skipped (%d s, processor %d s)' $word ${#so_far[@]} "$jobs" \
        "$name" "$passed" "$failed" "$skipped" $((SECONDS - start)) "$cpu_s"
    if [ $word != ok ]; then
        line+=$'\n'$({ grep '^not ok' "$log" | head -n 20 && echo ... && tail -n 40 "$log"; } | sed 's/^/     | /')
    elif [ "$skipped" != 0 ]; then
        line+=$'\n'$(grep '# SKIP' "$log" | sed 's/^/     | /')
    fi
    printf '%s\n' "$line"
    rm -f "$running/$name"
}

# Says every half a minute how many jobs are done, and for how long which have been running.
still_running() {
    local f now line
    while sleep 30 >/dev/null 2>&1; do # which nobody waits for when the tests have ended
        line='' now=$(date +%s)
        for f in "$running"/*; do
            line+="${line:+, }${f##*/} $((now - $(stat -c %Y "$f" 2>/dev/null || echo "$now"))) s"
        done
        echo "     $(wc -l <"$results") of $jobs done; running: $line"
    done
}
export -f job prepare count lacks
export sanitize

is_one_of() { [[ " $2 " = *" $(basename "$1" .c) "* ]]; }

plain() { echo "$(basename "$1" .c) $B $1"; }
sanitized() { echo "$(basename "$1" .c).asan $B/asan $1"; }
one_way() { if is_one_of "$1" "$2"; then plain "$1"; else sanitized "$1"; fi; }   # test, the slow ones
other_way() { if is_one_of "$1" "$2"; then sanitized "$1"; else plain "$1"; fi; } # test, the slow ones

# One line a job, the words of job()'s arguments.
list() {
    local f
    case $mode in
    check)
        for f in $quick_scripts; do f=$(echo tests/*/"$f".sh) && [ ! -e "$f" ] || echo "$(basename "$f" .sh) - $f"; done
        for f in $unit_tests; do is_one_of "$f" "$slow_units" || plain "$f"; done
        ;;
    test)
        for f in tests/*/fuzz_*.c; do echo "$(basename "$f" .c).asan $B/asan $f"; done
        for f in tests/*/test_*.sh; do echo "$(basename "$f" .sh) - $f"; done
        for f in $unit_tests; do is_one_of "$f" "$long_units" || one_way "$f" "$slow_sanitized"; done
        ;;
    long)
        for f in $unit_tests; do other_way "$f" "$slow_sanitized"; done
        for f in tests/*/long_*.sh; do echo "$(basename "$f" .sh) - $f"; done
        for f in tests/*/exhaustive_*.c; do echo "$(basename "$f" .c) $B $f"; done
        for f in tests/*/fuzz_*.c; do echo "$(basename "$f" .c).long.asan $B/asan $f long"; done
        ;;
    esac
}

# What the jobs need of a build directory.
programs() { list | awk -v dir="$1" '$2 == dir { sub(/\.c$/, "", $3); print $2 "/" $3 }'; } # build directory

# Prints the jobs of this share. A test that knows SHARE takes its own share of what it looks at.
shared() {
    local line i=0 source
    while read -r line; do
        read -r _ _ source _ <<<"$line"
        if ! grep -q 'SHARE\|in_share\|LONG=1' "$source"; then
            [ $((i++ % ${SHARE#*/})) = $((${SHARE%/*} - 1)) ] || continue
        fi
        echo "$line"
    done
}

# Dozens of images compile the same files in the same way: ccache compiles them once. Few are made by `test`: what is saved
# there is less than what ccache itself takes.
through_ccache() {
    local name
    CCACHE_PATH=$PATH
    CCACHE_DIR=$(realpath -m "$B/ccache")
    mkdir -p "$CCACHE_DIR/bin"
    for name in arm-none-eabi-gcc riscv64-unknown-elf-gcc; do ln -sf "$PWD/tests/tools/ccache.sh" "$CCACHE_DIR/bin/$name"; done
    PATH=$CCACHE_DIR/bin:/usr/lib/ccache:$PATH
    export PATH CCACHE_PATH CCACHE_DIR
}

# Sorts jobs: those in $first in its order, then the others as they come.
longest_first() { awk -v first="$first" 'BEGIN { n = split(first, name, /[ \n]+/); for (i = 1; i <= n; i++) { rank[name[i]] = i } }
    { print ($1 in rank ? rank[$1] : n + 1), NR, $0 }' | sort -n -k1,1 -k2,2 | cut -d' ' -f3-; }

if [ "$mode" != check ]; then
    tests/tools/packages.sh test || exit
    [ "$mode" = test ] || ! command -v ccache >/dev/null || through_ccache
fi
shopt -s nullglob
rm -rf "$running" && mkdir -p "$running"
: >"$results"
begin=$SECONDS
goals="all $(programs "$B")"
[ "$mode" != long ] || { goals="all test-programs long-programs" && echo "share $SHARE of the long tests"; }
echo "building"
export built= # build directories in which everything was built; what lacks a library is tried again alone
# shellcheck disable=SC2086 # words
make -k -s -j"$processors" "$@" B="$B" $goals >"$B/log/build.log" 2>&1 && built=$B
if [ "$mode" != check ]; then
    # shellcheck disable=SC2046 # words
    make -k -s -j"$processors" "$@" B="$B/asan" CFLAGS="$sanitize" $(programs "$B/asan") >"$B/log/build-asan.log" 2>&1 && built="$built $B/asan"
fi
BUILT="$B $B/asan $(realpath -m "$B")" # no test builds anew beneath another
export BUILT
todo=$(list | longest_first | if [ "$mode" = long ]; then shared; else cat; fi)
export jobs
jobs=$(wc -l <<<"$todo")
still_running &
trap 'kill '$! EXIT
xargs -P "$((processors + 1))" -I{} bash -c 'job {}' <<<"$todo"

echo "$((SECONDS - begin)) s"
awk '{ p += $1; f += $2; s += $3 } END { printf "%d passed, %d failed, %d skipped\n", p, f, s; exit f > 0 || p + f + s == 0 }' "$results"
