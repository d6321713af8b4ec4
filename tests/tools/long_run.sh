#!/usr/bin/env bash
# tests/run.sh counts what really happened: dummy tests that pass, fail, crash, hang, do not compile, overrun a buffer.
# shellcheck disable=SC2317 # functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
unset SHARE # of the tests that this one is among
mkdir -p "$dir/tests/tools" "$dir/tests/core" && cp tests/run.sh "$dir/tests" && cp tests/tools/packages.sh tests/tools/tap.sh "$dir/tests/tools" && : >"$dir/tests/tools/packages"

# A Makefile of dummies, which takes a moment.
cat >"$dir/Makefile" <<'END'
test-programs: $(patsubst %.c,$(B)/%,$(wildcard tests/*/test_*.c))
$(B)/tests/%: tests/%.c
	@mkdir -p $(@D)
	$(CC) -O2 -g $(CFLAGS) $< $$(pkg-config --libs cmocka 2>/dev/null) -o $@
all long-programs:
.PHONY: all test-programs long-programs
END

# Runs the one dummy test that stdin holds; the last line must be as expected.
counts() { # file, expected last line
    local out
    rm -rf "$dir"/tests/core/* "$dir/build"
    cat >"$dir/tests/core/$1"
    chmod +x "$dir/tests/core/$1"
    out=$(cd "$dir" && env -u MAKEFLAGS B=build TEST_TIMEOUT="${limit:-600}" tests/run.sh "${mode:-test}" 2>&1)
    [ "$(tail -n 1 <<<"$out")" = "$2" ] || { echo "$out" && return 1; }
}

cmocka='#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <setjmp.h>
#include <cmocka.h>
static void good(void **state) { (void)state; assert_true(1); }
static void bad(void **state) { (void)state; %s; }
int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(good), cmocka_unit_test(bad), cmocka_unit_test(good)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}'
unit() { # body of the second test, expected
    # shellcheck disable=SC2059 # the format is the program
    printf "$cmocka" "$1" | counts test_dummy.c "$2"
}

unit_in_check() {
    counts test_dummy.c "1 passed, 0 failed, 0 skipped" <<<'int main(void) { return 0; }'
}

# Three long tests, one in each share; a fourth that knows SHARE runs in all of them.
shares_of_the_long_tests() {
    local k name
    rm -rf "$dir"/tests/core/* "$dir/build"
    for name in a b c; do printf '#!/bin/sh\necho ran >>%s\n' "$dir/ran-$name" >"$dir/tests/core/long_$name.sh"; done
    # shellcheck disable=SC2016 # the made script's
    printf '#!/bin/sh\necho $SHARE >>%s\n' "$dir/ran-all" >"$dir/tests/core/long_all.sh"
    chmod +x "$dir"/tests/core/*.sh
    for k in 1 2 3; do
        (cd "$dir" && env -u MAKEFLAGS B=build SHARE="$k/3" tests/run.sh long 2>&1) | tail -n 1 | grep -qx '2 passed, 0 failed, 0 skipped' || return 1
    done
    cat "$dir"/ran-{a,b,c,all} | tr '\n' ' ' | grep -x 'ran ran ran 1/3 2/3 3/3 '
}

# What runs long is named while it runs.
says_what_runs() {
    rm -rf "$dir"/tests/core/* "$dir/build"
    printf '#!/bin/sh\nsleep 33\n' >"$dir/tests/core/long_sleep.sh" && chmod +x "$dir/tests/core/long_sleep.sh"
    (cd "$dir" && env -u MAKEFLAGS B=build tests/run.sh long 2>&1) | tee "$dir/said"
    grep -q '^     0 of 1 done; running: long_sleep [23][0-9] s$' "$dir/said" && grep -q '^ok     1/1 long_sleep ' "$dir/said"
}

wrong_shares() {
    local share
    for share in 0/3 4/3 1 x; do
        ! (cd "$dir" && SHARE=$share tests/run.sh long) 2>/dev/null || return 1
    done
}

if pkg-config --exists cmocka 2>/dev/null; then
    check "tests_that_pass_are_counted" unit "assert_true(1)" "3 passed, 0 failed, 0 skipped"
    check "a_test_that_fails_is_counted_alone" unit "assert_true(0)" "2 passed, 1 failed, 0 skipped"
    check "a_skipped_test_is_no_passed_test" unit "skip()" "2 passed, 0 failed, 1 skipped"
    check "after_a_crash_the_tests_that_did_not_run_fail" unit "abort()" "1 passed, 2 failed, 0 skipped"
    limit=5 check "a_test_that_hangs_is_stopped_and_fails" unit "for (;;) {}" "1 passed, 2 failed, 0 skipped"
    check "a_test_that_does_not_compile_fails" unit "no such thing" "0 passed, 1 failed, 0 skipped"
    check "an_overrun_is_seen_by_the_sanitizers" unit \
        "volatile char *p = malloc(4); assert_true(p[4] + 1000 > 0); free((void *)p)" "1 passed, 2 failed, 0 skipped"
else
    skip "unit_tests_are_counted" "no libcmocka-dev"
fi
mode=check check "for_every_edit_the_sanitizers_do_not_run" unit_in_check
mode=long check "a_share_of_the_long_tests_is_a_share" shares_of_the_long_tests
mode=long check "what_runs_and_for_how_long_is_told" says_what_runs
check "a_share_that_cannot_be_is_refused" wrong_shares
check "a_missing_library_skips_the_program" counts test_dummy.c "0 passed, 0 failed, 1 skipped" <<<'#include <no_such_library.h>'
check "a_script_may_just_succeed" counts test_dummy.sh "1 passed, 0 failed, 0 skipped" <<<'#!/bin/sh'
check "a_script_may_just_fail" counts test_dummy.sh "0 passed, 1 failed, 0 skipped" <<<'#!/bin/sh
exit 3'
check "a_script_may_skip_itself" counts test_dummy.sh "0 passed, 0 failed, 1 skipped" <<<'#!/bin/sh
exit 77'
check "lines_of_TAP_are_counted_one_by_one" counts test_dummy.sh "1 passed, 1 failed, 1 skipped" <<<'#!/usr/bin/env bash
. tests/tools/tap.sh
check "true" true
check "false" false
skip "neither" "no reason"
tap_end'
check "a_bad_exit_after_good_lines_fails" counts test_dummy.sh "1 passed, 1 failed, 0 skipped" <<<'#!/bin/sh
echo "1..1"; echo "ok 1 - fine"; exit 1'
tap_end
