# shellcheck shell=bash
# For shell tests: `. tests/tools/tap.sh`, then one `check` or `skip` per test and `tap_end`. Output is TAP; tests/run.sh counts it.
#   check "a name as a sentence" command [argument...]    passes when the command does; its output is shown when not, and how long it took from 2 s on
#   skip  "a name as a sentence" "reason"
#   short "a name as a sentence" command...    a check that a long test leaves out: LONG is empty
#   long  "a name as a sentence" command...    one of many alike: a long test (LONG=1) takes its share of them
#   in_share              whether the next of the things that a long test looks at is in the share that SHARE=K/N asks for
#   make_image argument...                                make of an image in $B, one at a time: tests run side by side
export PINHOLE_PROGRESS=off # lines that come because a machine is slow are no messages; test_progress.sh looks at them
tap_count=0
tap_failed=0

check() {
    local name=$1 output begin=$SECONDS
    shift
    tap_count=$((tap_count + 1))
    if output=$("$@" 2>&1); then
        echo "ok $tap_count - $name"
    else
        tap_failed=$((tap_failed + 1))
        echo "not ok $tap_count - $name"
        [ -z "$output" ] || echo "# ${output//$'\n'/$'\n'# }"
    fi
    [ $((SECONDS - begin)) -lt 2 ] || echo "# took $((SECONDS - begin)) s"
}

skip() {
    tap_count=$((tap_count + 1))
    echo "ok $tap_count - $1 # SKIP $2"
}

tap_end() {
    echo "1..$tap_count"
    [ "$tap_failed" = 0 ]
    exit
}

share_number=$(cksum <<<"${0##*/}") && share_number=${share_number%% *} # or all would begin in the first share
in_share() {
    local share=${SHARE:-1/1}
    [ $((share_number++ % ${share#*/} + 1)) = "${share%/*}" ]
}

short() { [ -n "${LONG-}" ] || check "$@"; }
long() { ! { [ -n "${LONG-}" ] && in_share; } || check "$@"; }

make_image() {
    mkdir -p "$B" && flock "$B/images.lock" make -s -j2 B="$B" "$@"
}
