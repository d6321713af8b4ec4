#!/usr/bin/env bash
# tests/tools/packages.sh leaves the system whole: it says what it wants first, never ends apt, never removes a package.
# An apt-get of our own plays apt, for nothing here may change this machine.
# shellcheck disable=SC2317,SC2015,SC2016 # functions are called by check; the made script expands $name
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
dir=$(mktemp -d) && trap 'rm -rf "$dir"' EXIT
[ "$(id -u)" = 0 ] || { echo "only root installs packages" && exit 77; }
mkdir "$dir/bin" && cp tests/tools/packages.sh "$dir/"
there() { echo "test | $1 | test -e '$dir/has-$1' | what $1 is for"; }
{ there one && there two && there three; } >"$dir/packages"

# Notes its arguments. `install` takes a second, and fails where it is asked for two.
cat >"$dir/bin/apt-get" <<END
#!/bin/sh
echo "apt-get \$*" >>"$dir/calls"
case " \$* " in
*' --assume-no '*) printf 'Need to get 7 MB of archives.\nAfter this operation, 9 MB more.\n' && exit 1 ;;
*' install '*) ;;
*) exit 0 ;;
esac
echo begun >>"$dir/calls" && sleep 1
echo whole >>"$dir/calls"
for word; do [ "\$word" != two ] || exit 100; done
for word; do case \$word in one | three) touch "$dir/has-\$word" ;; esac; done
END
printf '#!/bin/sh\nfor name; do :; done; ! grep -qx "$name" "%s/strange"\n' "$dir" >"$dir/bin/apt-cache"
: >"$dir/strange"
chmod +x "$dir/bin/apt-get" "$dir/bin/apt-cache"

fresh() { rm -f "$dir"/has-* "$dir/calls"; }
packages() { PATH="$dir/bin:$PATH" "$dir/packages.sh" test >"$dir/said" 2>&1; }

says_what_it_wants_first() {
    fresh && packages && cat "$dir/said" &&
        [ "$(head -n 1 "$dir/said")" = 'packages: 3 are missing: one two three' ] && grep -q '^packages: Need to get 7 MB' "$dir/said"
}

one_does_not_keep_the_others_out() {
    fresh && packages && cat "$dir/said" "$dir/calls" && [ -e "$dir/has-one" ] && [ -e "$dir/has-three" ] &&
        [ "$(tail -n 1 "$dir/said")" = 'packages: two is missing, so this is skipped: what two is for' ]
}

a_strange_one_does_not_hide_the_sizes() {
    local status=0
    fresh && echo three >"$dir/strange"
    packages && cat "$dir/said" "$dir/calls" && grep -qx "packages: this machine's sources have no three" "$dir/said" &&
        grep -q '^packages: Need to get 7 MB' "$dir/said" && ! grep -w three "$dir/calls" || status=1
    : >"$dir/strange"
    return "$status"
}

nothing_is_removed() { fresh && packages && ! grep ' install ' "$dir/calls" | grep -v -e --no-remove; }

# The signal goes, as Ctrl-C does, to all of the group.
is_whole_after() { # signal
    local status=0
    fresh
    PATH=$dir/bin:$PATH setsid env --default-signal=INT "$dir/packages.sh" test >"$dir/said" 2>&1 &
    until grep -q begun "$dir/calls" 2>/dev/null; do sleep 0.05; done
    kill -s "$1" -- -$!
    wait $! || status=$?
    cat "$dir/said" "$dir/calls"
    [ "$status" = 130 ] && [ "$(tail -n 1 "$dir/calls")" = whole ] && [ "$(grep -c begun "$dir/calls")" = 1 ] && grep -q '^packages: interrupted' "$dir/said"
}

only_says_the_command() {
    fresh && PACKAGES_INSTALL=0 packages && cat "$dir/said" && [ ! -e "$dir/calls" ] &&
        grep -qx 'packages: to install them: sudo apt-get install --no-install-recommends one two three' "$dir/said"
}

check "it_says_what_it_wants_and_how_much_that_takes_first" says_what_it_wants_first
check "a_package_that_cannot_be_had_does_not_keep_the_others_out" one_does_not_keep_the_others_out
check "a_name_that_the_sources_do_not_have_does_not_hide_how_much_the_others_take" a_strange_one_does_not_hide_the_sizes
check "no_package_is_removed" nothing_is_removed
check "SIGTERM_leaves_the_system_whole" is_whole_after TERM
check "Ctrl-C_leaves_the_system_whole" is_whole_after INT
check "without_the_right_to_install_it_says_the_command" only_says_the_command
tap_end
