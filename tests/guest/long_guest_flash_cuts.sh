#!/usr/bin/env bash
# pinhole-flash in the virtual board, at length: boards that are pulled at 100 random moments and runs that are killed at
# 40, after each of which a second run completes; valgrind with its count of open files. SEED=n for the same moments.
# shellcheck disable=SC2317,SC2015,SC2016 # functions are called by check; `A && B || { echo; return 1; }` says why it fails
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
. tests/guest/flash_in_guest.sh
guest_begin "a virtual RP2040 is pulled at any moment" libusb-1.0
make -s B="$B" all && guest_build || exit 1
make_images "$dir" a 40000 && make_rp2350_image "$dir" pico2 40000 || exit 1
head -c 2097152 /dev/urandom >"$dir/old"
expected() { # image
    cat "$1" && head -c $((40192 - 40000)) /dev/zero && head -c $((40960 - 40192)) /dev/zero | tr '\0' '\377'
    tail -c +40961 "$dir/old"
}
expected "$dir/a.bin" >"$dir/expected" && expected "$dir/pico2.bin" >"$dir/expected-pico2"
seed=${SEED:-$RANDOM}

in_guest() { # name, script
    guest_out=$dir/$1
    mkdir -p "$guest_out"
    printf 'images=%q\nRANDOM=%q\n. tests/guest/flash_in_guest.sh\ncd $GUEST\n%s\n' "$dir" "$seed" "$2" >"$guest_out/in_guest"
    tests/guest/guest.sh --icount --timeout 4000 "${@:3}" --out "$guest_out" -- bash "$guest_out/in_guest" >"$guest_out/log" 2>&1 || cat "$guest_out/log"
}

# So many first runs, all of which ended as they may; not too many of them came through; every second one was right.
cuts_are_mended() { # how many, statuses that a cut may have, pattern of the cut's line
    awk -v all="$1" -v statuses="$2" -v pattern="$3" '
        { line = $0; sub(/^[^ ]* [^ ]* [^ ]* /, "", line) }
        $2 != 0 || $3 != "yes" { print "second run: " $0; bad = 1 }
        $1 == 0 { through++; next }
        index(" " statuses " ", " " $1 " ") == 0 || line !~ pattern { print "first run: " $0; bad = 1 }
        END { if (NR != all || through > all / 2) { print NR " runs, " through + 0 " came through"; bad = 1 }
              exit bad }' "$guest_out/cuts"
}

# 42,016 bytes go to a board with 10 sectors of image: 33 commands of 32 bytes, 10 sectors.
by_bytes='
    cut() {
        local after=$(((RANDOM * 32768 + RANDOM) % 42016))
        [ $(($1 % 3)) != 0 ] || after=$((42016 - RANDOM % 352)) # while it is read back
        run_on first flash "--unplug-after $after $product" "$2"
    }
    for i in {1..60}; do cut_and_again $i $images/$image.uf2 $images/$wanted; done
'
by_time='
    cut() {
        plug --flash $GUEST/flash $product
        (sleep 0.$(printf %03d $((RANDOM % 250))) && kill $usb_device) &
        run first "$2"
        wait
    }
    for i in {1..40}; do cut_and_again $i $images/$image.uf2 $images/$wanted; done
'
by_signal='
    cut() {
        local signals=(INT TERM KILL KILL)
        plug --flash $GUEST/flash
        env --default-signal=INT $B/pinhole-flash "$2" >$GUEST/first.out 2>$GUEST/first.err &
        sleep 0.$(printf %03d $((RANDOM % 250)))
        kill -${signals[$1 % 4]} $! 2>/dev/null
        wait $!
        echo $? >$GUEST/first.status
        pull
    }
    for i in {1..40}; do cut_and_again $i $images/a.uf2 $images/expected; done
'
checked='
    guest_wrap="valgrind --error-exitcode=99 --leak-check=full --errors-for-leak-kinds=all --track-fds=yes"
    guest_limit=3000
    run none $images/a.uf2
    run_on good flash "" $images/a.uf2
    run_on pulled flash "--unplug-after 9000" $images/a.uf2
    run_on refused flash "--stall-after 9000" $images/a.uf2
'
unplugged='^pinhole-flash: (RP2[0-9]+ [0-9]+:[0-9]+: unplugged|no RP2[0-9]+ in its boot loader|RP2[0-9]+ [0-9]+:[0-9]+: cannot be opened)'
pulled() { # chip, product of the virtual board, image, flash as it should be
    local options="product='$2' image=$3 wanted=$4"
    if in_share; then
        in_guest "bytes-$3" "$options$by_bytes"
        check "60 times an $1, each pulled after a random number of bytes (SEED=$seed): a line, and a second run completes" \
            cuts_are_mended 60 1 "$unplugged"
    fi
    if in_share; then
        in_guest "time-$3" "$options$by_time"
        check "40 times an $1, each pulled after a random time: a line, and a second run completes" cuts_are_mended 40 1 "$unplugged"
    fi
}
pulled RP2040 '' a expected
pulled RP2350 '--product f' pico2 expected-pico2
if in_share; then
    in_guest signals "$by_signal"
    check "40 runs, each ended by a signal at a random time: a line or killed, and a second run completes" \
        cuts_are_mended 40 "130 143 137" '^$|^pinhole-flash: RP2040 [0-9]+:[0-9]+: stopped before'
fi

valgrind_finds_nothing() { # name, status
    [ "$(cat "$guest_out/$1.status")" = "$2" ] && grep -q 'ERROR SUMMARY: 0 errors' "$guest_out/$1.err" &&
        grep -Eq 'FILE DESCRIPTORS: ([0-9]+) open \(\1 (std|inherited)\)|FILE DESCRIPTORS: 3 open' "$guest_out/$1.err" ||
        { cat "$guest_out/$1.status" "$guest_out/$1.err" && return 1; }
}
if ! in_share; then
    :
elif command -v valgrind >/dev/null; then
    in_guest checked "$checked" --memory 1000
    check "valgrind finds no error, no leak and no open file: a run" valgrind_finds_nothing good 0
    for name in none pulled refused; do
        check "valgrind finds no error, no leak and no open file: $name" valgrind_finds_nothing $name 1
    done
else
    skip "valgrind finds no error, no leak and no open file" "it is not installed"
fi
tap_end
