#!/usr/bin/env bash
# pinhole-flash in the virtual board, for tests/guest/long_guest_flash.sh and tests/guest/long_guest_flash_cuts.sh: sourced on the host and in
# the guest. What a run leaves in $GUEST: NAME.status, NAME.out, NAME.err; the flash of a board is a file. Environment: B.
# shellcheck source-path=SCRIPTDIR
# shellcheck disable=SC2015,SC2154 # `A && B || { echo; return 1; }` says why it fails; usb_device, guest_out, images, cut: others'
. "$(dirname "${BASH_SOURCE[0]}")/virtual_board.sh"
guest_wrap=${guest_wrap-} # valgrind, say
guest_program=${guest_program-$B/pinhole-flash}

# ---- on the host, before -------------------------------------------------------------------------

# DIR/NAME.bin, .uf2: an image of so many random bytes; its boot2 and its UF2 as `make firmware` makes them.
make_images() { # directory, then name and bytes of each
    local dir=$1 name
    cc -O1 -o "$dir/seal" hal/rp2040/boot2_seal.c && cc -O1 -o "$dir/uf2" firmware/tools/image_uf2.c || return 1
    shift
    while [ $# -gt 0 ]; do
        name=$dir/$1
        head -c 256 /dev/urandom | "$dir/seal" >"$name.bin" && head -c $(($2 - 256)) /dev/urandom >>"$name.bin" &&
            "$dir/uf2" 0xe48bff56 0x10000000 "$name.bin" "$name.uf2" || return 1
        shift 2
    done
}

# DIR/NAME.bin, .uf2: an image of so many random bytes for an RP2350, which starts what has an image definition.
make_rp2350_image() { # directory, name, bytes
    { printf '\323\336\377\377' && head -c $(($3 - 4)) /dev/urandom; } >"$1/$2.bin" && "$1/uf2" 0xe48bff59 0x10000000 "$1/$2.bin" "$1/$2.uf2"
}

# ---- in the guest --------------------------------------------------------------------------------

run() { # name, argument...
    # shellcheck disable=SC2086 # words of guest_wrap
    timeout "${guest_limit:-1000}" $guest_wrap $guest_program "${@:2}" >"$GUEST/$1.out" 2>"$GUEST/$1.err"
    echo $? >"$GUEST/$1.status"
}

plug() { usb_plug bootsel "$@"; }

pull() {
    kill "$usb_device" 2>/dev/null
    wait "$usb_device" 2>/dev/null
    usb_gone
}

# Plugs a board in with this flash and these options, runs, and pulls it.
run_on() { # name, flash, options of the board, argument...
    # shellcheck disable=SC2086 # words of $3
    plug --flash "$GUEST/$2" $3 && run "$1" "${@:4}"
    pull
}

# Sends a signal to a run once the flash has changed, which is when it writes.
run_signalled() { # name, flash, signal, argument...
    local pid i
    plug --flash "$GUEST/$2"
    cp "$GUEST/$2" "$GUEST/before"
    env --default-signal=INT "$B/pinhole-flash" "${@:4}" >"$GUEST/$1.out" 2>"$GUEST/$1.err" & # `&` ignores SIGINT
    pid=$!
    for ((i = 0; i < 100000; i++)); do
        { cmp -s "$GUEST/$2" "$GUEST/before" && kill -0 $pid; } || break
    done
    kill "-$3" $pid
    wait $pid
    echo $? >"$GUEST/$1.status"
    run "$1-list" --list
    pull
}

# Cuts a run off, by `cut NUMBER`, and runs again on the flash that was left: a line with both statuses, whether the flash
# holds what it should, and the first run's line.
cut_and_again() { # number, image, flash as it should be
    local same=no
    cp "$images/old" "$GUEST/flash"
    cut "$1" "$2"
    run_on second flash "${product-}" "$2"
    cmp -s "$GUEST/flash" "$3" && same=yes
    echo "$(cat "$GUEST/first.status") $(cat "$GUEST/second.status") $same $(cat "$GUEST/first.err")" >>"$GUEST/cuts"
}

# ---- on the host, after --------------------------------------------------------------------------

# The run ended with this status and this line on stderr ("" for none); @ stands for BUS:ADDRESS.
ended() { # name, status, line
    local status
    status=$(cat "$guest_out/$1.status" 2>&1)
    [ "$status" = "$2" ] || { echo "status $status, not $2"; cat "$guest_out/$1.err"; return 1; }
    sed -E 's/(RP2[0-9]*) [0-9]+:[0-9]+:/\1 @:/' "$guest_out/$1.err" | diff - <(if [ -n "$3" ]; then echo "pinhole-flash: $3"; fi)
}

said() { # name, line
    sed 's/[0-9]*:[0-9]*/@/' "$guest_out/$1.out" | diff - <(echo "$2")
}

# The flash holds the image, padded as its UF2 is or not at all, then erased bytes up to the sector's end, then what it
# held before.
holds() { # flash, image, zeros|erased, flash before
    local bytes pages end
    bytes=$(stat -c %s "$2")
    pages=$(((bytes + 255) / 256 * 256)) end=$(((bytes + 4095) / 4096 * 4096))
    {
        cat "$2"
        [ "$3" = zeros ] && head -c $((pages - bytes)) /dev/zero || head -c $((pages - bytes)) /dev/zero | tr '\0' '\377'
        head -c $((end - pages)) /dev/zero | tr '\0' '\377'
        tail -c +$((end + 1)) "$4"
    } | cmp - "$1"
}
