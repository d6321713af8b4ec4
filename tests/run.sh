#!/usr/bin/env bash
# Usage: tests/run.sh quick|long [VARIABLE=value for make...]
# Builds and runs the tests, each with a time limit, as many at a time as there are processors; ends with the one line
# `N passed, N failed, N skipped` and exits 1 when a test failed.
#   quick  tests/*/test_*.c plain and under sanitizers, tests/*/fuzz_*.c under sanitizers, tests/*/test_*.sh
#   long   tests/*/exhaustive_*.c, tests/*/long_*.sh, tests/*/fuzz_*.c under sanitizers with the argument `long`
# A test speaks TAP (cmocka does; tests/tools/tap.sh helps a script) or just exits: 0 passed, 77 skipped, else failed.
# What it says goes to $B/log/ and is shown when it fails.
set -u
cd "$(dirname "$0")/.." || exit 1
mode=${1-}
case "$mode" in
quick) limit_s=400 ;;
long) limit_s=1500 ;;
*) echo "usage: $0 quick|long [VARIABLE=value...]" >&2 && exit 2 ;;
esac
shift

export B=${B:-build} CC=${CC:-cc} CMOCKA_MESSAGE_OUTPUT=TAP UBSAN_OPTIONS=print_stacktrace=1 MAKEFLAGS=
export LSAN_OPTIONS=suppressions=$PWD/tests/tools/leaks.suppress:print_suppressions=0
export limit_s=${TEST_TIMEOUT:-$limit_s} results=$B/log/$mode.results
sanitize='-O1 -g -fno-omit-frame-pointer -fsanitize=address,undefined -fno-sanitize-recover=all'
processors=$(nproc)
make_args= # as one word, for the jobs
[ $# = 0 ] || printf -v make_args '%q ' "$@"
export make_args

# Counts TAP: "passed failed skipped". A plan that was not kept fails, and so does a bad exit without a failed test.
count() { # log, exit status
    awk -v status="$2" '
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
            print passed + 0, failed + 0, skipped + 0
        }' "$1"
}

# Headers of libraries that a source file asks for and this machine lacks.
lacks() {
    sed -n 's/^#include <\(.*\)>.*/#if !__has_include(<\1>)\n\1\n#endif/p' "$1" | $CC -E -P - 2>/dev/null | xargs
}

prepare() { # build directory, source: status 77 when it cannot be built here, 1 when it is broken
    local what
    [ "$1" != - ] || return 0
    what=$(lacks "$2")
    [ -z "$what" ] || { echo "not here: $what" && return 77; }
    what=$1/${2%.c}
    eval "make -s V=1 $make_args B=$1 ${CFLAGS_JOB:+CFLAGS='$CFLAGS_JOB'} $what" 2>&1 || { echo "does not build" && return 1; }
}

job() { # name, build directory (- for a script), source, [argument]
    local name=$1 log=$B/log/$1.log status=0 start=$SECONDS word=ok program passed failed skipped
    case "$2" in
    -) program=$3 ;;
    *) program=$2/${3%.c} ;;
    esac
    [[ $name != *.asan ]] || export CFLAGS_JOB=$sanitize
    prepare "$2" "$3" >"$log" || status=$?
    if [ $status = 0 ]; then
        { timeout -k 5 "$limit_s" "$program" ${4:+"$4"} </dev/null || status=$?; } >>"$log" 2>&1
        [ $status != 124 ] || echo "stopped after $limit_s s" >>"$log"
    fi
    read -r passed failed skipped < <(count "$log" $status)
    [ "$passed$failed" != 00 ] || word=skip
    [ "$failed" = 0 ] || word=FAIL
    echo "$passed $failed $skipped" >>"$results"
    {
        printf '%-4s %-32s %d passed, %d failed, %d skipped (%d s)\n' $word "$name" "$passed" "$failed" "$skipped" $((SECONDS - start))
        [ $word != ok ] || grep '# SKIP' "$log" | sed 's/^/     | /'
        [ $word = ok ] || { grep '^not ok' "$log" | head -n 20 && echo ... && tail -n 40 "$log"; } | sed 's/^/     | /'
    } >"$log.short"
    cat "$log.short"
    rm -f "$log.short"
}
export -f job prepare count lacks
export sanitize

# One line a job, the words of job()'s arguments.
list() {
    local f
    if [ "$mode" = quick ]; then
        for f in tests/*/fuzz_*.c; do echo "$(basename "$f" .c).asan $B/asan $f"; done
        for f in tests/*/test_*.sh; do echo "$(basename "$f" .sh) - $f"; done
        for f in tests/*/test_*.c; do echo "$(basename "$f" .c) $B $f"; done
        for f in tests/*/test_*.c; do echo "$(basename "$f" .c).asan $B/asan $f"; done
    else
        for f in tests/*/long_*.sh; do echo "$(basename "$f" .sh) - $f"; done
        for f in tests/*/exhaustive_*.c; do echo "$(basename "$f" .c) $B $f"; done
        for f in tests/*/fuzz_*.c; do echo "$(basename "$f" .c).long.asan $B/asan $f long"; done
    fi
}

tests/tools/packages.sh test
shopt -s nullglob
mkdir -p "$B/log"
: >"$results"
[ "$mode" = quick ] && goal=test-programs || goal=long-programs
echo "building"
make -k -s -j"$processors" "$@" B="$B" all "$goal" >"$B/log/build.log" 2>&1
make -k -s -j"$processors" "$@" B="$B/asan" CFLAGS="$sanitize" test-programs >"$B/log/build-asan.log" 2>&1
list | xargs -P "$processors" -I{} bash -c 'job {}'

awk '{ p += $1; f += $2; s += $3 } END { printf "%d passed, %d failed, %d skipped\n", p, f, s; exit f > 0 || p + f + s == 0 }' "$results"
